// A million instances, on the mock: limits are of the specification, not of ours.
#include "StreamingWorld.h"
#include "Support/RendererTestTools.h"

namespace Lantern
{
namespace
{

class FManyInstancesTest : public FRendererTest
{};

TEST_F(FManyInstancesTest, AMillionObjectsOfOneTree)
{
	Set("r.RT.Shadow.Path", "1");
	Set("r.RT.Culling", "0");
	ASSERT_TRUE(Load({.bMasked = true}));
	Mock().SetCallRecording(false);
	FRTScene& Scene = Engine->GetScene().GetScene();
	const FRTObjectInfo Tree = Scene.GetObject(Engine->GetScene().GetDraws().back().Object);
	constexpr uint32_t Count = 1'000'000;
	std::vector<FRTObjectId> Objects;
	for (uint32_t Index = 0; Index < Count; ++Index)
	{
		FRTObjectInfo Info = Tree;
		Info.Transform[3] = glm::dvec4(32.0 * (Index % 1000) - 16'000.0, 0.0, 32.0 * (Index / 1000) - 16'000.0, 1.0);
		Objects.push_back(Scene.AddObject(std::move(Info)));
	}
	ASSERT_NO_FATAL_FAILURE(Render());
	IRTScene* const Structure = Unwrap(Scene.GetStructure());
	EXPECT_EQ(Mock().GetSceneInstances(Structure).size(), Count + 2);
	// One range of records serves them all.
	EXPECT_LE(Engine->GetRenderer().GetShaderTable().GetTable()->GetDesc().HitCount, 1000u);

	Set("r.RT.Culling", "1");
	ASSERT_NO_FATAL_FAILURE(Render());
	const size_t Kept = Mock().GetSceneInstances(Structure).size();
	EXPECT_LT(Kept, Count / 2);
	EXPECT_GT(Kept, 0u);

	for (const FRTObjectId Object : Objects) { Scene.RemoveObject(Object); }
	ASSERT_NO_FATAL_FAILURE(Render());
	EXPECT_EQ(Mock().GetSceneInstances(Unwrap(Scene.GetStructure())).size(), 2u);
}

} // namespace
} // namespace Lantern
