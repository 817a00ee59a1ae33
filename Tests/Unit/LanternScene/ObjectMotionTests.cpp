// Where objects were in the frame before: which have an entry, what it holds on the device, and what it costs.
#include <map>
#include <random>
#include <set>

#include "ObjectMotionTestTools.h"

namespace Lantern
{
namespace
{

TEST_F(FObjectMotionTest, WhoSeesAnObjectIsNoMotionAndEndsNone)
{
	const FRTObjectId Id = Add(Tree, {Material});
	Rest();
	Move(Id, {3, 0, 0});
	Scene->SetMask(Id, MaskVisible);
	Show();
	ASSERT_TRUE(HasMotion(Id)) << "its past went with its mask";
	EXPECT_EQ(GetPreviousPlace(ReadMotion(Id)), glm::dvec3(0));
	const std::vector<FRTMockInstance> Instances = Mock().GetSceneInstances(Scene->GetStructure());
	ASSERT_EQ(Instances.size(), 1u);
	EXPECT_EQ(Instances[0].Instance.CustomIndexAndMask >> 24, uint32_t(MaskVisible));
	Scene->SetMask(Id, MaskDefault);
	Show();
	EXPECT_FALSE(HasMotion(Id)) << "it stands still";
}

TEST_F(FObjectMotionTest, AnotherGeometryIsNoMotionAndEndsNone)
{
	const FRTGeometryRef Bush = MakeGeometry("Bush", 1), Cloth = MakeDeformable("Cloth");
	const FRTObjectId Id = Add(Tree, {Material}), Other = Add(Bush, {Material}), Waving = Add(Cloth, {Material});
	Rest();
	Scene->SetGeometry(Other, Tree, {Material});
	Move(Id, {3, 0, 0});
	Scene->SetGeometry(Id, Bush, {Material});
	Show();
	EXPECT_FALSE(HasMotion(Other)) << "it stands still";
	ASSERT_TRUE(HasMotion(Id)) << "its past went with its geometry";
	EXPECT_EQ(GetPreviousPlace(ReadMotion(Id)), glm::dvec3(0));
	Rest();
	// What was deformed belongs to the geometry: objects follow the one that they have.
	Scene->MarkDeformed(Cloth);
	Show();
	Scene->SetGeometry(Waving, Tree, {Material});
	Scene->SetGeometry(Other, Cloth, {Material});
	Scene->MarkDeformed(Cloth);
	Show();
	EXPECT_FALSE(HasMotion(Waving));
	ASSERT_TRUE(HasMotion(Other));
	EXPECT_EQ(ReadMotion(Other).PreviousPositions, PreviousPositionsOf(Cloth));
	Scene->RemoveObject(Waving);
	Scene->RemoveObject(Other);
	Show();
}

TEST_F(FObjectMotionTest, StillObjectsHaveNoTable)
{
	const FRTObjectId Id = Add(Tree, {Material}, {1, 2, 3});
	Rest();
	EXPECT_FALSE(HasMotion(Id)) << "a new object comes from nowhere";
	EXPECT_EQ(Scene->GetConstants().ObjectMotions, 0u);
	EXPECT_EQ(Scene->GetMotions().GetTable().GetAddress(), 0u) << "no buffer";
	Mock().ClearCalls();
	Show();
	EXPECT_FALSE(bUpdated);
	EXPECT_EQ(Mock().CountCalls(ERTMockCall::CopyBuffer) + Mock().CountCalls(ERTMockCall::CreateBuffer), 0u);
}

TEST_F(FObjectMotionTest, AMoveIsSeenForOneFrame)
{
	const FRTObjectId Id = Add(Tree, {Material}, {1, 2, 3}), Still = Add(Tree, {Material}, {9, 9, 9});
	Rest();
	Move(Id, {5, 2, 3});
	Show();
	ASSERT_TRUE(HasMotion(Id));
	EXPECT_FALSE(HasMotion(Still));
	EXPECT_EQ(GetPreviousPlace(ReadMotion(Id)), glm::dvec3(1, 2, 3));
	EXPECT_EQ(ReadMotion(Id).PreviousPositions, 0u);
	EXPECT_EQ(Scene->GetMotions().GetTable().GetCopiedBytes(), sizeof(FObjectMotion));
	Move(Id, {6, 2, 3});
	Move(Id, {7, 2, 3}); // twice in a frame
	Show();
	EXPECT_EQ(GetPreviousPlace(ReadMotion(Id)), glm::dvec3(5, 2, 3));
	// It stands: one frame to say so, then nothing.
	Show();
	EXPECT_TRUE(bUpdated);
	EXPECT_FALSE(HasMotion(Id));
	EXPECT_EQ(Scene->GetConstants().ObjectMotions, 0u);
	Mock().ClearCalls();
	Show();
	EXPECT_FALSE(bUpdated);
	EXPECT_EQ(Mock().CountCalls(ERTMockCall::CopyBuffer), 0u);
}

TEST_F(FObjectMotionTest, WhoComesBackDidNotMove)
{
	const FRTObjectId Id = Add(Tree, {Material}, {1, 2, 3});
	Rest();
	Move(Id, {5, 2, 3});
	Move(Id, {1, 2, 3});
	Show();
	EXPECT_FALSE(HasMotion(Id));
	Scene->SetMaterials(Id, {Material});
	Show();
	EXPECT_FALSE(HasMotion(Id)) << "other materials are no motion";
}

TEST_F(FObjectMotionTest, OthersMaterialsKeepTheEntry)
{
	const FRTObjectId Id = Add(Tree, {Material}, {1, 2, 3});
	const uint32_t Other = Scene->AddMaterial(MakeMaterial());
	Rest();
	Move(Id, {5, 2, 3});
	Scene->SetMaterials(Id, {Other});
	Show();
	ASSERT_TRUE(HasMotion(Id));
	Move(Id, {6, 2, 3});
	Scene->SetMaterials(Id, {Material});
	Show();
	EXPECT_EQ(GetPreviousPlace(ReadMotion(Id)), glm::dvec3(5, 2, 3));
}

// The frame before is the last one that ran.
TEST_F(FObjectMotionTest, LostFramesAreNoFrames)
{
	const FRTObjectId Id = Add(Tree, {Material}, {1, 2, 3});
	Rest();
	Move(Id, {2, 2, 3});
	Lose();
	Move(Id, {3, 2, 3});
	Lose();
	Show();
	ASSERT_TRUE(HasMotion(Id));
	EXPECT_EQ(GetPreviousPlace(ReadMotion(Id)), glm::dvec3(1, 2, 3));
	Lose(); // one in which the entry would go
	Show();
	EXPECT_FALSE(HasMotion(Id));
	const FRTObjectId New = Add(Tree, {Material}, {4, 4, 4});
	Lose();
	Move(New, {5, 5, 5});
	Show();
	EXPECT_FALSE(HasMotion(New)) << "no frame has shown it";
}

TEST_F(FObjectMotionTest, SlotsDoNotInherit)
{
	const FRTObjectId Other = Add(Tree, {Material}), Old = Add(Tree, {Material}, {1, 2, 3});
	Rest();
	Move(Old, {5, 5, 5});
	Move(Other, {7, 7, 7});
	Show();
	ASSERT_TRUE(HasMotion(Old));
	Move(Old, {6, 5, 5});
	Scene->RemoveObject(Old);
	EXPECT_EQ(Scene->GetMotions().GetTable().Num(), 1u) << "its entry goes with it";
	const FRTObjectId New = Add(Tree, {Material}, {9, 9, 9});
	ASSERT_EQ(New.Index, Old.Index);
	Move(New, {8, 8, 8});
	Move(Other, {8, 7, 7});
	Show();
	EXPECT_FALSE(HasMotion(New));
	EXPECT_EQ(GetPreviousPlace(ReadMotion(Other)), glm::dvec3(7, 7, 7)) << "another's entry stays right";
	Move(New, {1, 1, 1});
	Show();
	EXPECT_EQ(GetPreviousPlace(ReadMotion(New)), glm::dvec3(8, 8, 8));
}

TEST_F(FObjectMotionTest, NobodyWhoReadsItNobodyWhoPays)
{
	const FRTObjectId Id = Add(Tree, {Material}, {1, 2, 3});
	Frame({}, MakeUse(false));
	Settle({}, MakeUse(false));
	for (int I = 0; I < 3; ++I)
	{
		Move(Id, {2 + I, 0, 0});
		Frame({}, MakeUse(false));
		EXPECT_FALSE(HasMotion(Id));
		EXPECT_EQ(Scene->GetMotions().GetTable().GetAddress(), 0u);
	}
	// Whoever asks later gets the frame before.
	Move(Id, {9, 0, 0});
	Show();
	EXPECT_EQ(GetPreviousPlace(ReadMotion(Id)), glm::dvec3(4, 0, 0));
	Frame({}, MakeUse(false));
	EXPECT_FALSE(HasMotion(Id));
}

TEST_F(FObjectMotionTest, CellsAreKeptExactly)
{
	const glm::dvec3 Far(16'384.0 + 511.9990234375, 100.0, -16'384.0);
	const FRTObjectId Id = Add(Tree, {Material}, Far);
	Show(Far);
	Settle(Far, MakeUse());
	Move(Id, Far + glm::dvec3(0.25, 0, 0)); // into the next cell
	Show(Far + glm::dvec3(1200, 0, 0));     // and the origin follows the camera
	const FObjectMotion Motion = ReadMotion(Id);
	EXPECT_NE(Motion.PreviousCell, ReadObject(Id).Cell);
	EXPECT_EQ(GetPreviousPlace(Motion), Far);
}

TEST_F(FObjectMotionTest, DeformationPointsToThePositionsBefore)
{
	const FRTGeometryRef Body = MakeDeformable("Body");
	const FRTObjectId A = Add(Body, {Material}), B = Add(Body, {Material}, {3, 0, 0});
	Rest();
	Scene->MarkDeformed(Body);
	EXPECT_FALSE(Body->WasDeformed());
	Show();
	EXPECT_FALSE(HasMotion(A)) << "what it was before its first deformation, nobody has seen";
	Scene->MarkDeformed(Body);
	Show();
	ASSERT_TRUE(HasMotion(A) && HasMotion(B));
	EXPECT_EQ(ReadMotion(A).PreviousPositions, PreviousPositionsOf(Body));
	EXPECT_EQ(GetPreviousPlace(ReadMotion(B)), glm::dvec3(3, 0, 0));
	// While it goes on, nothing of it travels.
	Scene->MarkDeformed(Body);
	Show();
	EXPECT_TRUE(HasMotion(A));
	EXPECT_EQ(Scene->GetStats().BytesCopied, 0u);
	// Both at once.
	Scene->MarkDeformed(Body);
	Move(B, {4, 0, 0});
	Show();
	EXPECT_EQ(ReadMotion(B).PreviousPositions, PreviousPositionsOf(Body));
	EXPECT_EQ(GetPreviousPlace(ReadMotion(B)), glm::dvec3(3, 0, 0));
	// Then it moves stiffly, then stands.
	Move(B, {5, 0, 0});
	Show();
	EXPECT_EQ(ReadMotion(B).PreviousPositions, 0u);
	EXPECT_FALSE(HasMotion(A));
	Show();
	EXPECT_FALSE(HasMotion(B));
}

TEST_F(FObjectMotionTest, ADeformationThatNeverRanIsNone)
{
	const FRTGeometryRef Body = MakeDeformable("Body");
	const FRTObjectId Id = Add(Body, {Material});
	Rest();
	Scene->MarkDeformed(Body);
	Lose();
	Scene->MarkDeformed(Body);
	Show();
	EXPECT_FALSE(HasMotion(Id)) << "still its first";
	Scene->MarkDeformed(Body);
	Lose();
	Show();
	EXPECT_FALSE(HasMotion(Id)) << "the positions are those of the frame before";
}

TEST_F(FObjectMotionTest, MemoryOfACrowdIsGivenBack)
{
	std::vector<FRTObjectId> Ids;
	for (int I = 0; I < 20'000; ++I) { Ids.push_back(Add(Tree, {Material}, {I % 100, 0, I / 100})); }
	Rest();
	for (const FRTObjectId Id : Ids) { Move(Id, {0, 1, Id.Index}); }
	Show();
	EXPECT_EQ(Scene->GetMotions().GetTable().Num(), Ids.size());
	EXPECT_EQ(Scene->GetMotions().GetTable().GetCopiedBytes(), Ids.size() * sizeof(FObjectMotion));
	Show();
	EXPECT_EQ(Scene->GetMotions().GetTable().Num(), 0u);
	EXPECT_EQ(Scene->GetMotions().GetTable().GetAddress(), 0u);
	for (const FRTObjectId Id : Ids) { ASSERT_FALSE(HasMotion(Id)); }
}

// Not only if all of it stops at once: the last ones to stand must not hold the memory of those before them.
TEST_F(FObjectMotionTest, MemoryOfACrowdThatComesToRestBitByBitIsGivenBack)
{
	std::vector<FRTObjectId> Ids;
	for (int I = 0; I < 20'000; ++I) { Ids.push_back(Add(Tree, {Material}, {I % 100, 0, I / 100})); }
	Rest();
	for (const size_t Moving : {size_t(20'000), size_t(100), size_t(0)})
	{
		for (size_t I = 0; I < Moving; ++I) { Move(Ids[I], {1, Moving, I}); }
		Show();
		EXPECT_EQ(Scene->GetMotions().GetTable().Num(), Moving);
	}
	EXPECT_EQ(Scene->GetMotions().GetTable().GetAddress(), 0u);
	Move(Ids[0], {7, 7, 7});
	Show();
	EXPECT_EQ(GetPreviousPlace(ReadMotion(Ids[0])), glm::dvec3(1, 100, 0));
}

/// All that can happen, at random, against a plain record of what the last frame showed.
class FObjectMotionWalk : public FObjectMotionTest
{
protected:
	struct FKnown
	{
		FRTObjectId Id;
		glm::dvec3 Place{0};
		FRTGeometryRef Body; // null: a tree
	};
	static constexpr size_t MostObjects = 12; // few enough to be picked twice in a frame
	int Pick(int Count) { return static_cast<int>(Random() % static_cast<uint32_t>(Count)); }
	glm::dvec3 MakePlace() { return {Pick(4096), Pick(4), Pick(4096)}; }
	void Change()
	{
		const int What = Pick(10);
		if ((What < 2 && Known.size() < MostObjects) || Known.empty())
		{
			FKnown New;
			New.Place = MakePlace();
			if (Pick(2) == 0) { New.Body = Bodies[static_cast<size_t>(Pick(3))]; }
			New.Id = Add(New.Body ? New.Body : Tree, {Material}, New.Place);
			Known.push_back(New);
			return;
		}
		const auto Index = static_cast<size_t>(Pick(static_cast<int>(Known.size())));
		if (What <= 2)
		{
			Scene->RemoveObject(Known[Index].Id);
			Known.erase(Known.begin() + static_cast<std::ptrdiff_t>(Index));
		}
		else if (What < 4)
		{
			const FRTGeometryRef& Body = Bodies[static_cast<size_t>(Pick(3))];
			Scene->MarkDeformed(Body);
			Marked.insert({Body.get(), true});
		}
		else { Move(Known[Index].Id, Known[Index].Place = MakePlace()); }
	}
	/// Says whose frame the next one is.
	void Choose(uint64_t InViewer)
	{
		Viewer = InViewer;
		ASSERT_EQ(Scene->SetViewer(Viewer), ShownTo.contains(Viewer) && !Outdated.contains(Viewer)) << "viewer " << Viewer;
	}
	void Check()
	{
		const std::map<std::pair<uint32_t, uint32_t>, glm::dvec3>& Shown = ShownTo[Viewer];
		size_t Moving = 0;
		for (const FKnown& Object : Known)
		{
			const auto Before = Shown.find({Object.Id.Index, Object.Id.Generation});
			const bool bDeforms = Object.Body && Marked.contains(Object.Body.get()) && Deformed.contains(Object.Body.get());
			const bool bExpected = Before != Shown.end() && (Before->second != Object.Place || bDeforms);
			ASSERT_EQ(HasMotion(Object.Id), bExpected) << "object " << Object.Id.Index;
			if (!bExpected) { continue; }
			++Moving;
			const FObjectMotion Motion = ReadMotion(Object.Id);
			ASSERT_EQ(GetPreviousPlace(Motion), Before->second);
			ASSERT_EQ(Motion.PreviousPositions, bDeforms ? PreviousPositionsOf(Object.Body) : 0);
		}
		ASSERT_EQ(Scene->GetMotions().GetTable().Num(), Moving) << "and no entry for anything else";
	}
	void Keep()
	{
		auto& Shown = ShownTo[Viewer];
		Shown.clear();
		for (const FKnown& Object : Known) { Shown[{Object.Id.Index, Object.Id.Generation}] = Object.Place; }
		if (!Marked.empty()) { Outdated = {0, 1, 2}; }
		Outdated.erase(Viewer);
		Deformed.insert(Marked.begin(), Marked.end());
		Marked.clear();
	}

	std::mt19937 Random{7};
	std::vector<FRTGeometryRef> Bodies;
	std::vector<FKnown> Known;
	uint64_t Viewer = 0;
	std::map<uint64_t, std::map<std::pair<uint32_t, uint32_t>, glm::dvec3>> ShownTo; // by viewer; by index and generation
	std::set<uint64_t> Outdated;                                                     // viewers; others deformed something since
	std::map<const FRTGeometry*, bool> Marked, Deformed;
};

TEST_F(FObjectMotionWalk, AgreesWithAPlainRecord)
{
	for (const char* Name : {"A", "B", "C"}) { Bodies.push_back(MakeDeformable(Name)); }
	size_t Most = 0;
	for (int Step = 0; Step < 2000 && !HasFatalFailure(); ++Step)
	{
		const int Changes = Pick(3) == 0 ? 0 : Pick(12);
		for (int I = 0; I < Changes; ++I) { Change(); }
		Most = std::max(Most, Known.size());
		Choose(Random() % 3);
		if (Pick(8) == 0)
		{
			Lose();
			Marked.clear();
			continue;
		}
		const bool bWanted = Pick(10) != 0;
		Frame({}, MakeUse(bWanted));
		if (bWanted) { Check(); }
		Keep();
	}
	EXPECT_EQ(Most, MostObjects);
}

} // namespace
} // namespace Lantern
