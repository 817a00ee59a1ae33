// A million objects that all move at once.
#include <glm/gtc/matrix_transform.hpp>

#include "Support/SceneTestTools.h"

namespace Lantern
{
namespace
{

using FObjectMotionLargeTest = FSceneTest;

TEST_F(FObjectMotionLargeTest, AMillionMoveAndStop)
{
	constexpr uint32_t Count = 1'000'000;
	FSceneUse Use;
	Use.bRays = false;
	Use.bMotion = true;
	const uint32_t Material = Scene->AddMaterial(MakeMaterial());
	const FRTGeometryRef Tree = MakeGeometry("Tree", 1);
	std::vector<FRTObjectId> Ids;
	for (uint32_t I = 0; I < Count; ++I) { Ids.push_back(Add(Tree, {Material}, {I % 1000, 0, I / 1000})); }
	Frame({}, Use);
	EXPECT_EQ(Scene->GetMotions().GetTable().Num(), 0u);
	for (const FRTObjectId Id : Ids) { Scene->SetTransform(Id, glm::translate(glm::dmat4(1.0), {Id.Index % 1000, 1, Id.Index / 1000})); }
	Frame({}, Use);
	ASSERT_EQ(Scene->GetMotions().GetTable().Num(), Count);
	EXPECT_EQ(Scene->GetStats().BytesCopied, uint64_t(Count) * (sizeof(FObjectData) + sizeof(FObjectMotion)));
	for (const uint32_t I : {0u, 1u, 499'999u, Count - 1})
	{
		const uint32_t Entry = Read<FObjectData>(Scene->GetConstants().Objects, Ids[I].Index).Motion;
		ASSERT_LT(Entry, Count);
		EXPECT_EQ(Read<FObjectMotion>(Scene->GetConstants().ObjectMotions, Entry).PreviousObjectToWorld[1].w, 0.0f);
	}
	// One goes on.
	Scene->SetTransform(Ids[123'456], glm::dmat4(1.0));
	Frame({}, Use);
	ASSERT_EQ(Scene->GetMotions().GetTable().Num(), 1u);
	EXPECT_EQ(Read<FObjectData>(Scene->GetConstants().Objects, 123'456).Motion, 0u);
	EXPECT_EQ(Read<FObjectData>(Scene->GetConstants().Objects, 0).Motion, NO_MOTION);
	Frame({}, Use);
	Frame({}, Use);
	EXPECT_FALSE(bUpdated);
}

} // namespace
} // namespace Lantern
