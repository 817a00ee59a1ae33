// A scene of a million objects: what each kind of frame costs in calls and bytes, and that both ways of gathering agree.
#include <random>

#include "LanternCore/Config/ConsoleVariables.h"
#include "Support/SceneTestTools.h"

namespace Lantern
{
namespace
{

class FGatherLargeTest : public FSceneTest
{
protected:
	static constexpr uint32_t ObjectCount = 1'000'000;
	void TearDown() override
	{
		FConsoleVariables::Get().ResetAll();
		FConsoleVariables::Get().BeginFrame();
		FSceneTest::TearDown();
	}
	void Fill()
	{
		std::vector<uint32_t> Materials;
		std::vector<FRTGeometryRef> Geometries;
		for (int I = 0; I < 20; ++I)
		{
			Materials.push_back(Scene->AddMaterial(MakeMaterial()));
			FRTGeometryInfo Info = MakeInfo("G" + std::to_string(I), 1);
			Info.BoundsRadius = 0.5f * static_cast<float>(1 + I);
			EXPECT_TRUE(Scene->CreateGeometry(std::move(Info), Geometries.emplace_back()));
		}
		std::mt19937 Random(8);
		std::exponential_distribution<double> Distance(1.0 / 3000.0);
		std::uniform_real_distribution<double> Angle(0.0, 6.2831853);
		for (uint32_t I = 0; I < ObjectCount; ++I)
		{
			const double At = Distance(Random), Turn = Angle(Random);
			Ids.push_back(Add(Geometries[I % 20], {Materials[I / 20 % 20]}, {At * std::cos(Turn), 0, At * std::sin(Turn)}));
		}
	}
	std::vector<FRTInstance> GetSorted()
	{
		std::vector<FRTInstance> Out;
		for (const FRTMockInstance& Item : GetInstances()) { Out.push_back(Item.Instance); }
		std::sort(Out.begin(), Out.end(), [](const FRTInstance& A, const FRTInstance& B) {
			return (A.CustomIndexAndMask & 0xffffff) < (B.CustomIndexAndMask & 0xffffff);
		});
		return Out;
	}
	std::vector<FRTObjectId> Ids;
};

TEST_F(FGatherLargeTest, AMillionObjects)
{
	Fill();
	Settle();
	EXPECT_EQ(Scene->GetFacts().Objects, ObjectCount);
	EXPECT_EQ(Scene->GetSections().GetRangeCount(), 400u);
	const std::vector<FRTInstance> Fast = GetSorted();
	EXPECT_GT(Fast.size(), ObjectCount / 20);
	EXPECT_LT(Fast.size(), ObjectCount / 2);
	FConsoleVariables::Get().Set("r.RT.Scene.Gather", "0", ERTSetBy::Console, "test");
	FConsoleVariables::Get().BeginFrame();
	Frame();
	const std::vector<FRTInstance> Plain = GetSorted();
	ASSERT_EQ(Fast.size(), Plain.size());
	EXPECT_EQ(std::memcmp(Fast.data(), Plain.data(), Fast.size() * sizeof(FRTInstance)), 0);
	FConsoleVariables::Get().Set("r.RT.Scene.Gather", "1", ERTSetBy::Console, "test");
	FConsoleVariables::Get().BeginFrame();
	Settle(); // the scratch memory of the builds goes some frames later

	Mock().ClearCalls();
	Frame();
	EXPECT_FALSE(bUpdated);
	EXPECT_EQ(Mock().CountCalls(ERTMockCall::CopyBuffer) + Mock().CountCalls(ERTMockCall::BuildScene), 0u);
	Frame({900, 0, 0}); // the origin moves
	EXPECT_EQ(Mock().CountCalls(ERTMockCall::BuildScene), 1u);
	EXPECT_EQ(Scene->GetStats().BytesCopied, 0u) << "and rewrites no table";
	for (uint32_t I = 0; I < ObjectCount; I += 100)
	{
		glm::dmat4 Transform = Scene->GetObject(Ids[I]).Transform;
		Transform[3].y += 1.0;
		Scene->SetTransform(Ids[I], Transform);
	}
	Frame({900, 0, 0});
	EXPECT_LE(Scene->GetStats().BytesCopied, uint64_t(ObjectCount) / 100 * FGpuTableBase::ChunkEntries * sizeof(FObjectData));
	for (const FRTObjectId Id : Ids) { Scene->RemoveObject(Id); }
	Frame();
	EXPECT_EQ(GetInstances().size(), 0u);
	EXPECT_EQ(Scene->GetInstances().GetBucketCount(), 0u);
}

} // namespace
} // namespace Lantern
