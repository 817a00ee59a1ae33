// Several renderers over one scene, in turn: each one's rays reach the records of what the scene is now.
#include <array>
#include <cstring>
#include <memory>
#include <random>

#include <glm/gtc/matrix_transform.hpp>

#include "Support/MockReads.h"
#include "Support/RendererTestTools.h"

namespace Lantern
{
namespace
{

class FRendererSharingTest : public FRendererTest
{
protected:
	void SetUp() override
	{
		FRendererTest::SetUp();
		Set("r.RT.Shadow.Path", "1"); // rays reach records
		LoadAndRender({.bMasked = true, .bEmissive = true, .bSky = true});
		FRendererDesc Desc;
		Desc.ShaderFolders = {GetShaderFolder()};
		Desc.CacheFolder = LANTERN_TEST_CACHE;
		for (std::unique_ptr<FRenderer>& Other : Others) { Other = std::make_unique<FRenderer>(*Device, Desc); }
	}
	void TearDown() override
	{
		for (std::unique_ptr<FRenderer>& Other : Others) { Other.reset(); }
		FRendererTest::TearDown();
	}
	FRTScene& Scene() { return Engine->GetScene().GetScene(); }
	/// 0: the engine's own.
	FRenderer& GetRenderer(size_t Index) { return Index == 0 ? Engine->GetRenderer() : *Others[Index - 1]; }
	size_t GetCount() const { return Others.size() + 1; }
	void Show(size_t Index, bool bSubmit = true)
	{
		if (Index == 0) { return Render(); }
		FRenderer& Renderer = GetRenderer(Index);
		FFrameFeatures Features;
		Features.bRays = Features.Signals.bMotion = true;
		FConsoleVariables::Get().BeginFrame();
		const FRTStatus Begun = Renderer.BeginFrame(Scene(), LookAt({0, 0, 9}, {0, 0, 0}, 1.0f, 40, 24), Features);
		ASSERT_TRUE(Begun) << Begun.Message;
		bHasPrevious = Renderer.GetContext().PreviousView != nullptr;
		if (!bSubmit) { return Renderer.FrameSubmitted(0); }
		const FRTStatus Ended = Renderer.EndFrame(nullptr);
		ASSERT_TRUE(Ended) << Ended.Message;
		ASSERT_TRUE(Renderer.WaitForAll());
	}
	/// Whatever a ray of this renderer's newest frame reaches is as the scene has it.
	void ExpectRecords(size_t Index)
	{
		FRenderer& Renderer = GetRenderer(Index);
		const FRTPSO* const Pipeline = Renderer.GetRayPipeline();
		ASSERT_TRUE(Pipeline);
		IRTShaderTable* const Table = Unwrap(Renderer.GetShaderTable().GetTable());
		const FSectionTable& Sections = Scene().GetSections();
		const uint32_t RayTypes = Pipeline->GetRayTypeCount();
		const auto Instances = Mock().GetSceneInstances(Unwrap(Scene().GetStructure()));
		ASSERT_FALSE(Instances.empty());
		for (const FRTMockInstance& Instance : Instances)
		{
			for (uint32_t Type = 0; Type < RayTypes; ++Type)
			{
				const FRTMockRecord Record = Mock().ResolveHit(Table, Instance.Instance, 0, Type, RayTypes);
				ASSERT_TRUE(Record.IsGood()) << "renderer " << Index << ": " << Record.Error;
				const uint32_t Section = Record.Index / RayTypes;
				ASSERT_GE(Record.Data.size(), sizeof(FSectionData));
				EXPECT_EQ(std::memcmp(Record.Data.data(), &Sections.Get(Section), sizeof(FSectionData)), 0)
				    << "renderer " << Index << ", section " << Section;
				EXPECT_EQ(!Record.AnyHit.empty(), (Sections.Get(Section).Flags & SECTION_MASKED) != 0)
				    << "renderer " << Index << ", section " << Section;
			}
		}
	}
	void Flip(uint32_t Material, uint32_t Flag)
	{
		FMaterialData Data = Scene().GetMaterials()[Material];
		Data.Flags ^= Flag;
		Scene().SetMaterial(Material, Data);
	}
	/// Where the newest frame's motion has the object in the frame before: x.
	double ReadPreviousX(FRTObjectId Id)
	{
		const FSceneConstants Constants = Scene().GetConstants();
		const uint32_t Entry = ReadMockEntry<FObjectData>(Mock(), Constants.Objects, Id.Index).Motion;
		if (Entry == NO_MOTION) { return -1.0; }
		const auto Motion = ReadMockEntry<FObjectMotion>(Mock(), Constants.ObjectMotions, Entry);
		return CellCenter(Motion.PreviousCell).x + Motion.PreviousObjectToWorld[0].w;
	}
	/// An object beside the others, with the geometry of an old one.
	void Add(std::mt19937& Random)
	{
		const FRTObjectInfo* const Old = Scene().FindObject(0);
		ASSERT_TRUE(Old);
		FRTObjectInfo Info = *Old;
		const auto Count = static_cast<uint32_t>(Scene().GetMaterials().Num());
		for (uint32_t& Material : Info.Materials) { Material = Random() % Count; }
		Added.push_back(Scene().AddObject(Info));
	}
	void Remove(std::mt19937& Random)
	{
		if (Added.empty()) { return; }
		std::swap(Added[Random() % Added.size()], Added.back());
		Scene().RemoveObject(Added.back());
		Added.pop_back();
	}

	std::array<std::unique_ptr<FRenderer>, 2> Others;
	std::vector<FRTObjectId> Added;
	bool bHasPrevious = false; ///< the last Show of another renderer than the engine's
};

TEST_F(FRendererSharingTest, EachFollowsMotionFromItsOwnLastFrame)
{
	std::mt19937 Random(5);
	ASSERT_NO_FATAL_FAILURE(Add(Random));
	const FRTObjectId Id = Added.front();
	double Place = 0.0, Shown[3] = {};
	const auto Move = [&] { Scene().SetTransform(Id, glm::translate(glm::dmat4(1.0), {Place += 0.25, 0.0, 0.0})); };
	for (const size_t Index : {1u, 2u}) { ASSERT_NO_FATAL_FAILURE(Show(Index)); }
	Shown[1] = Shown[2] = Scene().GetObject(Id).Transform[3].x;
	for (const size_t Index : {1u, 2u, 1u, 2u, 2u, 1u, 1u})
	{
		Move();
		ASSERT_NO_FATAL_FAILURE(Show(Index));
		EXPECT_TRUE(bHasPrevious) << "renderer " << Index << " lost its history";
		EXPECT_EQ(ReadPreviousX(Id), Shown[Index]) << "renderer " << Index;
		Shown[Index] = Place;
	}
	// A lost frame has shown nothing.
	Move();
	ASSERT_NO_FATAL_FAILURE(Show(2, false));
	Move();
	ASSERT_NO_FATAL_FAILURE(Show(1));
	EXPECT_EQ(ReadPreviousX(Id), Shown[1]);
	ASSERT_NO_FATAL_FAILURE(Show(2));
	EXPECT_EQ(ReadPreviousX(Id), Shown[2]);
}

TEST_F(FRendererSharingTest, ARendererSeesWhatChangedInAnothersFrame)
{
	Show(1);
	ExpectRecords(1);
	Flip(0, MATERIAL_DOUBLE_SIDED);
	Show(0);
	ExpectRecords(0);
	Show(1);
	ExpectRecords(1);
	// A frame that never ran, of a renderer that saw the change.
	Flip(0, MATERIAL_DOUBLE_SIDED);
	Show(1, false);
	Show(0);
	ExpectRecords(0);
	Show(1);
	ExpectRecords(1);
}

TEST_F(FRendererSharingTest, AnyOrderOfChangesAndFramesGivesRightRecords)
{
	std::mt19937 Random(12);
	for (int Step = 0; Step < 250; ++Step)
	{
		SCOPED_TRACE("step " + std::to_string(Step));
		for (uint32_t Changes = Random() % 3; Changes > 0; --Changes)
		{
			switch (Random() % 4)
			{
			case 0: Add(Random); break;
			case 1: Remove(Random); break;
			case 2: Flip(Random() % Scene().GetMaterials().Num(), MATERIAL_DOUBLE_SIDED); break;
			default: Flip(1, MATERIAL_MASKED); break; // of the leaves
			}
		}
		// One of them shows the scene seldom.
		const size_t Index = Random() % 20 == 0 ? GetCount() - 1 : Random() % (GetCount() - 1);
		ASSERT_NO_FATAL_FAILURE(Show(Index));
		ASSERT_NO_FATAL_FAILURE(ExpectRecords(Index));
		if (Random() % 10 == 0) { ASSERT_NO_FATAL_FAILURE(Show(1, false)); }
	}
}

/// Who renders publishes variables once for all views and renderers of a frame.
TEST_F(FRendererSharingTest, AViewsNextFrameNeedsThatSetVariablesArePublished)
{
	GTEST_FLAG_SET(death_test_style, "threadsafe");
	const auto Begin = [&](size_t Index, uint32_t View) {
		FFrameFeatures Features;
		Features.ViewIndex = View;
		const FRTStatus Begun = GetRenderer(Index).BeginFrame(Scene(), LookAt({0, 0, 9}, {0, 0, 0}, 1.0f, 40, 24), Features);
		ASSERT_TRUE(Begun) << Begun.Message;
	};
	const auto Draw = [&](size_t Index, uint32_t View) {
		ASSERT_NO_FATAL_FAILURE(Begin(Index, View));
		ASSERT_TRUE(GetRenderer(Index).EndFrame(nullptr));
	};
	FConsoleVariables::Get().BeginFrame();
	ASSERT_NO_FATAL_FAILURE(Draw(1, 0));
	Set("r.RT.Shadow", "0"); // another thread's, for the next frame
	EXPECT_TRUE(FConsoleVariables::Get().HasUnpublished());
	ASSERT_NO_FATAL_FAILURE(Draw(1, 1));
	ASSERT_NO_FATAL_FAILURE(Draw(2, 0));
	EXPECT_DEATH(Begin(1, 0), "FConsoleVariables::BeginFrame was not called");
	EXPECT_DEATH(Begin(2, 0), "FConsoleVariables::BeginFrame was not called");
	FConsoleVariables::Get().BeginFrame();
	EXPECT_FALSE(FConsoleVariables::Get().HasUnpublished());
	ASSERT_NO_FATAL_FAILURE(Draw(1, 0));
	ASSERT_NO_FATAL_FAILURE(Draw(1, 0)); // nothing was set
}

} // namespace
} // namespace Lantern
