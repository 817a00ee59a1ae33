// Several viewers of one scene: whose previous frame motions lead back to.
#include <map>

#include "ObjectMotionTestTools.h"

namespace Lantern
{
namespace
{

TEST_F(FObjectMotionTest, EachViewerHasAPreviousFrameOfItsOwn)
{
	const FRTObjectId Id = Add(Tree, {Material}, {1, 2, 3}), Once = Add(Tree, {Material}, {9, 9, 9});
	std::map<uint64_t, double> Shown;
	for (const uint64_t Viewer : {7u, 9u})
	{
		EXPECT_FALSE(Scene->SetViewer(Viewer)) << "its first frame";
		Rest();
		Shown[Viewer] = 1;
	}
	Move(Once, {10, 9, 9});
	double Place = 1;
	std::map<uint64_t, int> Seen;
	for (const uint64_t Viewer : {7u, 9u, 7u, 9u, 9u, 9u, 7u, 7u, 9u})
	{
		Move(Id, {++Place, 2, 3});
		EXPECT_TRUE(Scene->SetViewer(Viewer));
		Show();
		ASSERT_TRUE(HasMotion(Id));
		EXPECT_EQ(GetPreviousPlace(ReadMotion(Id)), glm::dvec3(Shown[Viewer], 2, 3)) << "viewer " << Viewer;
		Shown[Viewer] = Place;
		EXPECT_EQ(HasMotion(Once), Seen[Viewer]++ == 0) << "what each has seen is over";
		EXPECT_EQ(Scene->GetMotions().GetTable().Num(), Seen[Viewer] == 1 ? 2u : 1u);
	}
}

TEST_F(FObjectMotionTest, AViewerIsForgottenAfterManyFramesOfOthers)
{
	const FRTObjectId Id = Add(Tree, {Material}, {1, 2, 3});
	for (const uint64_t Viewer : {7u, 9u})
	{
		(void)Scene->SetViewer(Viewer);
		Rest();
	}
	for (uint32_t Frame = 0; Frame < FObjectMotions::KeptFrames; ++Frame) { Show(); }
	Move(Id, {2, 2, 3});
	EXPECT_FALSE(Scene->SetViewer(7));
	Show();
	EXPECT_FALSE(HasMotion(Id)) << "to it the object is new";
	EXPECT_TRUE(Scene->SetViewer(9));
	Show();
	EXPECT_EQ(GetPreviousPlace(ReadMotion(Id)), glm::dvec3(1, 2, 3));
}

TEST_F(FObjectMotionTest, AShapeIsFollowedInTheFramesThatDeformIt)
{
	const FRTGeometryRef Cloth = MakeDeformable("Cloth");
	(void)Add(Cloth, {Material});
	for (const uint64_t Viewer : {7u, 9u})
	{
		(void)Scene->SetViewer(Viewer);
		Rest();
	}
	const auto Deform = [&](uint64_t Viewer) {
		const bool bFollowed = Scene->SetViewer(Viewer);
		Scene->MarkDeformed(Cloth);
		Show();
		return bFollowed;
	};
	EXPECT_TRUE(Deform(7));
	EXPECT_TRUE(Deform(7));
	EXPECT_FALSE(Scene->SetViewer(9)) << "the vertices that it saw are gone";
	Show();
	EXPECT_TRUE(Scene->SetViewer(9));
	EXPECT_TRUE(Deform(7)) << "nothing was deformed since";
}

} // namespace
} // namespace Lantern
