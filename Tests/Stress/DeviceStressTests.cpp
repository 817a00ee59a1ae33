// Streaming on a real driver under validation: after a flight with builds on a budget, pipelines in the background and
// settings that change, the picture is that of a world that was loaded where the flight ended.
#include <random>

#include "LanternCore/Config/ConsoleVariables.h"
#include "LanternHost/VertexPacking.h"
#include "StreamingWorld.h"
#include "Support/RenderFixture.h"

namespace Lantern
{
namespace
{

class FDeviceStressTest : public FRenderTest
{
protected:
	static constexpr uint32_t Width = 96, Height = 54;
	/// Ground on which the streamed objects' shadows fall: they are in the scene that rays see, not in the raster's draws.
	[[nodiscard]] static FSceneDescription MakeGround(glm::dvec3 Center)
	{
		FHostMesh Mesh;
		Mesh.Name = "Ground";
		constexpr float Half = 600.0f;
		Mesh.Positions = {{-Half, 0, Half}, {Half, 0, Half}, {Half, 0, -Half}, {-Half, 0, -Half}};
		FVertexAttributes Up{};
		Up.Normal = PackUnitVector({0, 1, 0});
		Up.Color = ~0u;
		Mesh.Attributes.assign(4, Up);
		Mesh.Indices = {0, 1, 2, 0, 2, 3};
		Mesh.Sections = {{0, 6, 0}};
		Mesh.BoundsMin = Mesh.Positions[3];
		Mesh.BoundsMax = Mesh.Positions[1];
		std::swap(Mesh.BoundsMin.z, Mesh.BoundsMax.z);
		FSceneDescription Scene;
		Scene.Name = "Ground";
		Scene.Materials.resize(1);
		Scene.Meshes.push_back(std::move(Mesh));
		Scene.Nodes.emplace_back();
		Scene.Nodes[0].Name = "Ground";
		Scene.Nodes[0].Mesh = 0;
		Scene.Nodes[0].Translation = glm::dvec3(Center.x, 0.0, Center.z);
		return Scene;
	}
	void TearDown() override
	{
		GetEngine().bRealTime = false;
		FRenderTest::TearDown();
	}
	static FView MakeFlightView(double Seconds)
	{
		const glm::dvec3 Camera = FStreamingWorld::FlightAt(Seconds), Ahead = FStreamingWorld::FlightAt(Seconds + 1.0);
		return LookAt(Camera, glm::dvec3(Ahead.x, 20.0, Ahead.z), 1.0f, Width, Height);
	}
};

TEST_F(FDeviceStressTest, FlightEndsWithThePictureOfAFreshStart)
{
	constexpr double End = 20.0;
	const FStreamingSettings Settings{.TileSize = 128.0, .Radius = 400.0, .ObjectsPerTile = 24};
	FImage Flown, Fresh;
	{
		ASSERT_TRUE(Load(MakeGround(FStreamingWorld::FlightAt(End))));
		SetSun(0.5);
		SetVariable("r.RT.Build.TrianglesPerFrame", "2000");
		FStreamingWorld World(GetDevice(), GetScene().GetScene(), Settings);
		GetEngine().bRealTime = true;
		std::mt19937 Random(3);
		const char* const Toggles[] = {"r.RT.Shadow.Soft", "r.RT.AlphaTest", "r.RT.SBT.Mode", "r.RT.SBT.Prebind", "r.RT.Scene.Hoist",
		    "r.RT.Scene.Gather", "r.RT.Culling", "r.RT.Build.Compaction", "r.RT.Pipeline.Libraries"};
		for (int Frame = 0; Frame <= 80; ++Frame)
		{
			const double Seconds = End * Frame / 80.0;
			SetVariable("r.RT.Shadow.Path", Random() % 2 ? "1" : "2");
			SetVariable(Toggles[Random() % std::size(Toggles)], Random() % 2 ? "1" : "0");
			ASSERT_OK(World.MoveTo(FStreamingWorld::FlightAt(Seconds)));
			FCapturedFrame Unused;
			ASSERT_OK(GetEngine().RenderFrame(MakeFlightView(Seconds), 0.0, {}, &Unused));
		}
		World.Trim(FStreamingWorld::FlightAt(End));
		FConsoleVariables::Get().ResetAll();
		GetEngine().bRealTime = false;
		GetEngine().SetFrameIndex(0);
		Flown = RenderLighting(MakeFlightView(End));
	}
	{
		ASSERT_TRUE(Load(MakeGround(FStreamingWorld::FlightAt(End))));
		SetSun(0.5);
		FStreamingWorld World(GetDevice(), GetScene().GetScene(), Settings);
		ASSERT_OK(World.MoveTo(FStreamingWorld::FlightAt(End)));
		GetEngine().SetFrameIndex(0);
		Fresh = RenderLighting(MakeFlightView(End));
	}
	// Their origins differ by what the one has followed its camera, which may turn a ray at an edge.
	EXPECT_LE(FractionDiffering(Flown, Fresh, 0.01), 0.002);
	EXPECT_GT(FractionDiffering(Flown, FImage(Width, Height, 3), 0.01), 0.3) << "the ground is seen";
}

} // namespace
} // namespace Lantern
