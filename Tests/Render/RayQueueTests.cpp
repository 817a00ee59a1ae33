// Tiles and the queue of shadow rays: pictures of odd sizes, queues without room, and repetition to the bit.
#include "LanternCore/Config/ConsoleVariables.h"
#include "Support/CoreTestTools.h"
#include "Support/RenderFixture.h"
#include "Support/TestScene.h"

namespace Lantern
{

namespace
{
class FRayQueueTest : public FRenderTest
{
protected:
	static constexpr uint32_t Width = 131, Height = 73;

	void SetUp() override
	{
		FRenderTest::SetUp();
		SetVariable("r.RT.Shadow.Denoise", "0");
	}
	/// A floor under a roof: every pixel asks for a ray, and none sees the sun.
	void LoadDarkFloor()
	{
		FTestScene Scene("dark");
		const int32_t Lambert = Scene.AddLambert(glm::vec3(0.5f));
		Scene.AddNode(Scene.AddMesh({FTestScene::MakeFloor(Lambert, 4.0f)}));
		ASSERT_TRUE(Load(std::move(Scene.Scene)));
		SetSun(0.5, 4.0f, {0, -1, 0});
		FRTObjectInfo Roof = GetScene().GetScene().GetObject(GetScene().GetDraws()[0].Object);
		Roof.Transform[3].y = 2.0;
		GetScene().GetScene().AddObject(Roof);
	}
	static FView LookAtFloor(uint32_t InWidth, uint32_t InHeight) { return LookAt({0, 1.0, 0}, {0, 0, 0}, 0.2f, InWidth, InHeight); }
	/// Frames 0 … Count − 1 of the courtyard, after a frame whose queue had room.
	std::vector<FImage> Play(const char* PerPixel, int Count)
	{
		const FView View = MakeView(Width, Height);
		SetVariable("r.RT.Rays.QueuePerPixel", "2");
		GetEngine().SetFrameIndex(0);
		EXPECT_OK(GetEngine().RenderFrame(MakeView(8, 8), 0.0, {}, nullptr)); // another size: nothing to keep
		std::vector<FImage> Pictures;
		SetVariable("r.RT.Rays.QueuePerPixel", PerPixel);
		for (int Frame = 0; Frame < Count; ++Frame) { Pictures.push_back(RenderSunShadow(View, 1, uint32_t(Frame))); }
		return Pictures;
	}
};

// A view changes its size in each frame. A pixel whose tile is missing has no answer, and is lit.
TEST_F(FRayQueueTest, OddSizes)
{
	ASSERT_NO_FATAL_FAILURE(LoadDarkFloor());
	for (const char* Path : {"1", "2"})
	{
		SetVariable("r.RT.Shadow.Path", Path);
		for (const auto& [X, Y] : {std::pair{1u, 1u}, {7u, 3u}, {8u, 8u}, {9u, 1u}, {1u, 17u}, {131u, 73u}, {64u, 65u}})
		{
			const FImage Shadow = RenderSunShadow(LookAtFloor(X, Y));
			for (const float Value : Shadow.Pixels) { ASSERT_EQ(Value, 0.0f) << X << " x " << Y << ", path " << Path; }
		}
	}
}

// The disk's centre is on the horizon. A tile that asked about the centre alone would call the floor dark.
TEST_F(FRayQueueTest, HalfOfTheDiskIsSeen)
{
	FTestScene Flat("flat");
	const int32_t Lambert = Flat.AddLambert(glm::vec3(0.5f));
	Flat.AddNode(Flat.AddMesh({FTestScene::MakeFloor(Lambert, 4.0f)}));
	ASSERT_TRUE(Load(std::move(Flat.Scene)));
	SetSun(20.0, 4.0f, {1, 0, 0});
	SetVariable("r.RT.Shadow.Samples", "16");
	for (const char* Path : {"1", "2"})
	{
		SetVariable("r.RT.Shadow.Path", Path);
		EXPECT_NEAR(MeanGreen(RenderSunShadow(LookAtFloor(64, 64))), 0.5, 0.01) << "path " << Path;
	}
	SetSun(20.0, 4.0f, {1, 1, 0});
	EXPECT_EQ(MeanGreen(RenderSunShadow(LookAtFloor(64, 64))), 0.0) << "all of it is behind the floor";
}

// Room for 1 % of the rays: nothing is traced in two frames, then the queue is as large as it must be.
TEST_F(FRayQueueTest, QueueWithoutRoomRecovers)
{
	ASSERT_TRUE(Load("courtyard"));
	for (const char* Path : {"1", "2"})
	{
		SetVariable("r.RT.Shadow.Path", Path);
		const std::vector<FImage> Right = Play("2", 4);
		EXPECT_LT(MeanGreen(Right[0]), 0.9) << "there is a shadow to lose";
		const std::vector<FImage> Small = Play("0.01", 4);
		EXPECT_GT(MeanGreen(Small[0]), MeanGreen(Right[0])) << "pixels without a frame before are lit";
		EXPECT_EQ(Small[1].Pixels, Small[0].Pixels) << "nothing was traced, and the frame before is kept";
		EXPECT_EQ(Small[2].Pixels, Right[2].Pixels) << "path " << Path;
		EXPECT_EQ(Small[3].Pixels, Right[3].Pixels) << "path " << Path;
	}
}

// Half of the rays have room. Which ones does not depend on the order in which tiles come.
TEST_F(FRayQueueTest, WhatHasNoRoomRepeats)
{
	ASSERT_TRUE(Load("courtyard"));
	SetVariable("r.RT.Shadow.Soft", "0"); // all frames then show the same
	const std::vector<FImage> Right = Play("2", 3), First = Play("0.3", 3), Second = Play("0.3", 3);
	for (size_t Frame = 0; Frame < First.size(); ++Frame) { EXPECT_EQ(First[Frame].Pixels, Second[Frame].Pixels) << Frame; }
	const double Wrong = FractionDiffering(First[0], Right[0], 0.0);
	EXPECT_GT(Wrong, 0.0) << "all had room";
	for (size_t Pixel = 0; Pixel < First[0].Pixels.size(); ++Pixel)
	{
		const float Value = First[0].Pixels[Pixel];
		ASSERT_TRUE(Value == Right[0].Pixels[Pixel] || Value == 1.0f) << Pixel;
	}
	// Other pixels have their turn in the second frame, and those of the first keep what they had.
	EXPECT_LT(FractionDiffering(First[1], Right[0], 0.0), Wrong);
	for (size_t Pixel = 0; Pixel < First[0].Pixels.size(); ++Pixel)
	{
		if (First[0].Pixels[Pixel] != Right[0].Pixels[Pixel]) { continue; }
		ASSERT_EQ(First[1].Pixels[Pixel], Right[0].Pixels[Pixel]) << Pixel;
	}
	EXPECT_EQ(First[2].Pixels, Right[2].Pixels);
}
} // namespace
} // namespace Lantern
