// Motion vectors against the projection of the same point of the surface in double precision, at every pixel: cameras
// that move and turn, objects that move, turn, grow and are mirrored, skinned meshes, far from the world's origin and
// across borders of its cells. 1/100 of a pixel is what the project promises.
#include <cmath>

#include <glm/gtc/matrix_transform.hpp>

#include "MotionFixture.h"
#include "Support/TestScene.h"

namespace Lantern
{

namespace
{
const glm::dvec3 BorderOfCell(0.5 * CellSize - 0.2, 0, 0);
/// The room that a camera leaves an origin of 0 from.
const glm::dvec3 WhereOriginMoves(0.75 * FRTScene::OriginStep - 0.4, 0, 0);

class FMotionTest : public FMotionTestBase
{
protected:
	/// Floor, wall and three boxes of which one is mirrored; all about Center. Instances: 0 floor, 1 wall, 2 … 4 boxes.
	bool LoadRoom(const glm::dvec3& Center)
	{
		FTestScene Room("room");
		const int32_t Grey = Room.AddLambert(glm::vec3(0.5f), glm::vec3(0), true);
		const int32_t Floor = Room.AddMesh({FTestScene::MakeFloor(Grey, 6.0f)});
		const int32_t Wall = Room.AddMesh({{Grey, {{-6, 0, -4}, {6, 0, -4}, {6, 5, -4}, {-6, 5, -4}}}});
		const int32_t Box = Room.AddMesh({{Grey, {{-0.5f, 0, 0.5f}, {0.5f, 0, 0.5f}, {0.5f, 1, 0.4f}, {-0.5f, 1, 0.4f}}},
		    {Grey, {{0.5f, 0, 0.5f}, {0.5f, 0, -0.5f}, {0.5f, 1, -0.5f}, {0.5f, 1, 0.4f}}},
		    {Grey, {{-0.5f, 1, 0.4f}, {0.5f, 1, 0.4f}, {0.5f, 1, -0.5f}, {-0.5f, 1, -0.5f}}}});
		for (const int32_t Mesh : {Floor, Wall}) { Room.AddNode(Mesh, glm::translate(glm::dmat4(1), Center)); }
		for (int I = 0; I < 3; ++I) { Room.AddNode(Box, MakeBoxTransform(Center, I, 0.0)); }
		return Load(std::move(Room.Scene));
	}
	/// Time: a number of frames.
	static glm::dmat4 MakeBoxTransform(const glm::dvec3& Center, int Box, double Time)
	{
		const glm::dvec3 Place = Center + glm::dvec3(1.6 * (Box - 1) + 0.11 * Time, 0.2 + 0.03 * Time, 0.07 * Time * Box);
		const glm::dmat4 Turned =
		    glm::rotate(glm::translate(glm::dmat4(1), Place), 0.3 + 0.05 * Time * (Box + 1), glm::normalize(glm::dvec3(0.2, 1, 0.1 * Box)));
		return glm::scale(Turned, glm::dvec3(Box == 2 ? -1.0 : 1.0, 1.0 + 0.04 * Time, 1.0));
	}
	static FView MakeRoomView(const glm::dvec3& Center, double Time, glm::uvec2 Size = {Width, Height})
	{
		return MakeCamera(
		    Center + glm::dvec3(0.13 * Time, 2.0 + 0.02 * Time, 5.0 - 0.09 * Time), Center + glm::dvec3(0.05 * Time, 0.8, 0), Size);
	}
	static void MoveBoxes(const glm::dvec3& Center, double Time)
	{
		for (int I = 0; I < 3; ++I) { GetScene().SetTransform(static_cast<size_t>(2 + I), MakeBoxTransform(Center, I, Time)); }
	}
	struct FRun
	{
		glm::dvec3 Center{0};
		int First = 1, Last = 3; ///< frames that are looked at; one before them is rendered
		glm::uvec2 Size{Width, Height};
	};
	/// Frames in which camera and boxes move. Returns in how many of those that are looked at the scene's origin moved.
	int ExpectRoomExact(const char* What, const FRun& Run)
	{
		EXPECT_TRUE(LoadRoom(Run.Center));
		FMotionSnapshot Before;
		int OriginMoves = 0;
		for (int Frame = Run.First - 1; Frame <= Run.Last; ++Frame)
		{
			MoveBoxes(Run.Center, Frame);
			const FView View = MakeRoomView(Run.Center, Frame, Run.Size);
			const glm::dvec3 Origin = GetScene().GetScene().GetOrigin();
			const FMotionPicture Picture = Render(View);
			const FMotionSnapshot Now = TakeSnapshot(GetScene(), View);
			if (Frame >= Run.First)
			{
				ExpectExact(fmt::format("{}, {}x{}", What, Run.Size.x, Run.Size.y).c_str(), Before, Now, Picture);
				OriginMoves += GetScene().GetScene().GetOrigin() != Origin ? 1 : 0;
			}
			Before = Now;
		}
		return OriginMoves;
	}
};

TEST_F(FMotionTest, WhatStandsStillDoesNotMoveAtAll)
{
	ASSERT_TRUE(LoadRoom({0, 0, 0}));
	const FView View = MakeRoomView({0, 0, 0}, 0);
	for (int Frame = 0; Frame < 3; ++Frame)
	{
		const FMotionPicture Picture = Render(View);
		const FMotionSnapshot Now = TakeSnapshot(GetScene(), View);
		ExpectExact("still", Now, Now, Picture);
		for (const glm::vec4& Motion : Picture.OfHost) { ASSERT_EQ(glm::vec2(Motion), glm::vec2(0)); }
	}
}

// Also from depth alone, with the host's depth and with that of a raster which makes no motion itself.
TEST_F(FMotionTest, CameraThatMovesAndTurns)
{
	ASSERT_TRUE(LoadRoom({0, 0, 0}));
	FMotionSnapshot Before;
	for (int Frame = 0; Frame < 4; ++Frame)
	{
		const FView View = MakeRoomView({0, 0, 0}, 3 * Frame);
		const FMotionPicture Picture = Render(View, 0.0, Frame % 2 == 1);
		const FMotionSnapshot Now = TakeSnapshot(GetScene(), View);
		const FMotionSnapshot& From = Frame == 0 ? Now : Before; // the first has nothing before it
		ExpectExact("camera, raster", From, Now, Picture);
		ExpectExact("camera, from depth", From, Now, Picture, Picture.OfCamera);
		Before = Now;
	}
}

TEST_F(FMotionTest, ObjectsThatMove) { ExpectRoomExact("objects", {}); }
TEST_F(FMotionTest, FarFromTheOrigin) { ExpectRoomExact("16 km away", {.Center = {16'000.3, 500.1, 16'000.7}}); }

// Boxes and camera pass the border of a cell, and then the camera passes the place where the origin follows.
TEST_F(FMotionTest, AcrossCells)
{
	for (const glm::uvec2 Size : {glm::uvec2(Width, Height), glm::uvec2(333, 187), glm::uvec2(640, 360)})
	{
		ExpectRoomExact("border of a cell", {.Center = BorderOfCell, .Last = 8, .Size = Size});
		EXPECT_EQ(ExpectRoomExact("origin moves", {.Center = WhereOriginMoves, .Last = 8, .Size = Size}), 1);
	}
}

// So fine that a face seen nearly edge-on, which the sixth frame has, fills a pixel.
TEST_F(FMotionTest, AcrossCellsAtFullSize)
{
	const glm::uvec2 Size(1920, 1080);
	ExpectRoomExact("border of a cell", {.Center = BorderOfCell, .First = 5, .Last = 7, .Size = Size});
	EXPECT_EQ(ExpectRoomExact("origin moves", {.Center = WhereOriginMoves, .First = 3, .Last = 6, .Size = Size}), 1);
}

TEST_F(FMotionTest, MotionEndsWithTheMove)
{
	ASSERT_TRUE(LoadRoom({0, 0, 0}));
	const FView View = MakeRoomView({0, 0, 0}, 0);
	(void)Render(View);
	MoveBoxes({0, 0, 0}, 1);
	(void)Render(View);
	const FMotionPicture Picture = Render(View);
	for (const glm::vec4& Motion : Picture.OfHost) { ASSERT_EQ(glm::vec2(Motion), glm::vec2(0)); }
}

TEST_F(FMotionTest, AnObjectInAnothersPlaceComesFromNowhere)
{
	ASSERT_TRUE(LoadRoom({0, 0, 0}));
	const FView First = MakeRoomView({0, 0, 0}, 0), Second = MakeRoomView({0, 0, 0}, 1);
	(void)Render(First);
	FMotionSnapshot Before = TakeSnapshot(GetScene(), First);
	// Moved, removed, and another in its slot: drawn in its stead, since the raster goes by slots.
	FRTScene& Scene = GetScene().GetScene();
	const FRTObjectId Old = GetScene().GetDraws()[3].Object;
	FRTObjectInfo Info = Scene.GetObject(Old);
	MoveBoxes({0, 0, 0}, 1);
	Scene.RemoveObject(Old);
	Info.Transform = glm::translate(Info.Transform, {0.3, 0.4, 0.5});
	ASSERT_EQ(Scene.AddObject(Info).Index, Old.Index);
	const FMotionPicture Picture = Render(Second);
	std::erase_if(Before.Objects, [&](const FMotionSnapshot::FObject& Object) { return Object.Index == Old.Index; });
	ExpectExact("another in its slot", Before, TakeSnapshot(GetScene(), Second), Picture);
}

TEST_F(FMotionTest, ACutCarriesNothingOver)
{
	ASSERT_TRUE(LoadRoom({0, 0, 0}));
	(void)Render(MakeRoomView({0, 0, 0}, 0));
	MoveBoxes({0, 0, 0}, 1);
	FView View = MakeRoomView({0, 0, 0}, 20);
	View.bCut = true;
	const FMotionPicture Picture = Render(View);
	const FMotionSnapshot Now = TakeSnapshot(GetScene(), View);
	ExpectExact("cut", Now, Now, Picture);
	ExpectExact("cut, from depth", Now, Now, Picture, Picture.OfCamera);
	for (const glm::vec4& Motion : Picture.OfHost) { ASSERT_EQ(glm::vec2(Motion), glm::vec2(0)); }
}

// What was behind the camera was on no screen, however near to it its mirror image would be projected.
TEST_F(FMotionTest, WhatWasBehindTheCameraPointsOffTheScreen)
{
	ASSERT_TRUE(LoadRoom({0, 0, 0}));
	const FView View = MakeRoomView({0, 0, 0}, 0);
	FView Away = View;
	Away.Forward = -View.Forward;
	(void)Render(Away);
	const FMotionPicture Picture = Render(View);
	size_t Seen = 0;
	for (uint32_t Pixel = 0; Pixel < Width * Height; ++Pixel)
	{
		if (Picture.OfHost[Pixel].w == 0.0f) { continue; }
		++Seen;
		for (const glm::vec4& Motion : {Picture.OfHost[Pixel], Picture.OfCamera[Pixel]})
		{
			ASSERT_TRUE(std::isfinite(Motion.x + Motion.y + Motion.z));
			const glm::vec2 Previous = glm::vec2(Pixel % Width, Pixel / Width) + 0.5f + glm::vec2(Motion);
			ASSERT_TRUE(Previous.x < 0 || Previous.y < 0 || Previous.x > Width || Previous.y > Height);
			ASSERT_EQ(Motion.z, 0.0f);
		}
	}
	EXPECT_GT(Seen, Width * Height / 4);
}

/// A ribbon of 10 quads, one above the other, whose vertices hang on three joints; the whole also moves along.
FSceneDescription MakeRibbon(const glm::dvec3& Center)
{
	FTestScene Ribbon("ribbon");
	const int32_t Material = Ribbon.AddLambert(glm::vec3(0.5f), glm::vec3(0), true);
	std::vector<FTestScene::FQuad> Quads;
	for (int I = 0; I < 10; ++I)
	{
		const float Y = 0.2f * float(I);
		Quads.push_back({Material, {{-0.7f, Y, 0}, {0.7f, Y, 0}, {0.7f, Y + 0.2f, 0}, {-0.7f, Y + 0.2f, 0}}});
	}
	const int32_t Mesh = Ribbon.AddMesh(Quads), Node = Ribbon.AddNode(Mesh);
	FSceneDescription& Scene = Ribbon.Scene;
	FHostMesh& Host = Scene.Meshes[static_cast<size_t>(Mesh)];
	for (const glm::vec3& P : Host.Positions)
	{
		FSkinWeights Weights;
		const float Upper = std::clamp(P.y - 0.5f, 0.0f, 1.0f);
		Weights.Joints = {0, 1, 2, 0};
		Weights.Weights = {1.0f - Upper, 0.6f * Upper, 0.4f * Upper, 0.0f};
		Host.Skin.push_back(Weights);
	}
	FHostSkin Skin;
	FHostAnimation Animation;
	Animation.Duration = 2.0f;
	for (int J = 0; J < 3; ++J)
	{
		FHostNode Joint;
		Joint.Name = "joint";
		Joint.Parent = J == 0 ? -1 : static_cast<int32_t>(Scene.Nodes.size()) - 1;
		Joint.Translation = J == 0 ? Center : glm::dvec3(0, 0.7, 0);
		Skin.Joints.push_back(static_cast<int32_t>(Scene.Nodes.size()));
		Skin.InverseBind.push_back(glm::translate(glm::mat4(1), glm::vec3(0, -0.7f * float(J), 0)));
		const glm::quat Turn = glm::angleAxis(0.9f, glm::normalize(glm::vec3(J % 2, 0.4f, 1 - J % 2)));
		Animation.Channels.push_back({Skin.Joints.back(), EAnimationPath::Rotation, EInterpolation::Linear, {0.0f, 2.0f},
		    {{0, 0, 0, 1}, {Turn.x, Turn.y, Turn.z, Turn.w}}});
		Scene.Nodes.push_back(Joint);
	}
	const glm::vec4 From(glm::vec3(Center), 0);
	Animation.Channels.push_back(
	    {Skin.Joints[0], EAnimationPath::Translation, EInterpolation::Linear, {0.0f, 2.0f}, {From, From + glm::vec4(1, 0.5f, -1, 0)}});
	Scene.Skins.push_back(Skin);
	Scene.Animations.push_back(Animation);
	Scene.Nodes[static_cast<size_t>(Node)].Skin = 0;
	Scene.Nodes[static_cast<size_t>(Node)].Matrix = glm::translate(glm::dmat4(1), Center);
	return std::move(Ribbon.Scene);
}

// It starts, goes on, stands for two frames, and goes on: at 0 its first deformation has no past.
TEST_F(FMotionTest, SkinnedMeshes)
{
	const glm::dvec3 Center(256.0, 16.0, 0.0); // what fp32 holds: joints are relative to the node
	ASSERT_TRUE(Load(MakeRibbon(Center)));
	FMotionSnapshot Before;
	int Frame = 0;
	for (const double Time : {0.0, 0.05, 0.1, 0.1, 0.1, 0.2, 0.3})
	{
		const FView View = MakeCamera(Center + glm::dvec3(0.2, 1.2, 2.4 - 0.01 * Frame), Center + glm::dvec3(0, 0.9, 0));
		const FMotionPicture Picture = Render(View, Time);
		const FMotionSnapshot Now = TakeSnapshot(GetScene(), View);
		ExpectExact(fmt::format("skinned, {} s", Time).c_str(), Frame == 0 ? Now : Before, Now, Picture);
		Before = Now;
		++Frame;
	}
}

} // namespace
} // namespace Lantern
