// Acceleration structures on the Vulkan device: compaction and coarser levels leave pictures what they were, and the
// measure of refits tells loose from tight.
#include <cstring>
#include <random>

#include "LanternCore/Config/ConsoleVariables.h"
#include "LanternHost/VertexPacking.h"
#include "Skinning/RefitQuality.h"
#include "Support/RenderFixture.h"
#include "Support/TestScene.h"

namespace Lantern
{
namespace
{

/// Hills of 2 · Cells² triangles over 20 × 20 metres.
FSceneDescription MakeHills(uint32_t Cells)
{
	FTestScene Test("hills");
	FHostMesh Mesh;
	Mesh.Name = "Hills";
	const auto Height = [](float X, float Z) { return 0.8f * std::sin(0.9f * X) * std::cos(0.7f * Z); };
	for (uint32_t Z = 0; Z <= Cells; ++Z)
	{
		for (uint32_t X = 0; X <= Cells; ++X)
		{
			const glm::vec2 At = 20.0f * glm::vec2(X, Z) / float(Cells) - 10.0f;
			Mesh.Positions.emplace_back(At.x, Height(At.x, At.y), At.y);
			FVertexAttributes A{};
			const glm::vec3 N(
			    Height(At.x - 0.01f, At.y) - Height(At.x + 0.01f, At.y), 0.02f, Height(At.x, At.y - 0.01f) - Height(At.x, At.y + 0.01f));
			A.Normal = PackUnitVector(glm::normalize(N));
			A.Color = ~0u;
			Mesh.Attributes.push_back(A);
		}
	}
	for (uint32_t Z = 0; Z < Cells; ++Z)
	{
		for (uint32_t X = 0; X < Cells; ++X)
		{
			const uint32_t A = Z * (Cells + 1) + X, B = A + 1, C = A + Cells + 1, D = C + 1;
			Mesh.Indices.insert(Mesh.Indices.end(), {A, C, B, B, C, D});
		}
	}
	Mesh.Sections = {{0, static_cast<uint32_t>(Mesh.Indices.size()), Test.AddLambert(glm::vec3(0.5f))}};
	Mesh.BoundsMin = glm::vec3(-10, -1, -10);
	Mesh.BoundsMax = glm::vec3(10, 1, 10);
	Test.Scene.Meshes.push_back(std::move(Mesh));
	Test.AddNode(0);
	return std::move(Test.Scene);
}

class FGeometryBudgetTest : public FRenderTest
{
protected:
	static const FGeometryStoreStats& Stats() { return GetScene().GetScene().GetGeometries().GetStats(); }
	static FView View()
	{
		FView View = MakeView(64, 48);
		View.Position = {0.0, 9.0, 14.0};
		View.Forward = glm::normalize(glm::dvec3(0.0, -0.6, -1.0));
		return View;
	}
};

TEST_F(FGeometryBudgetTest, CompactedStructuresGiveTheSamePicture)
{
	FImage Pictures[2];
	uint64_t Bytes[2] = {};
	for (const bool bCompact : {false, true})
	{
		SetVariable("r.RT.Build.Compaction", bCompact ? "1" : "0");
		ASSERT_TRUE(Load(MakeHills(120)));
		SetSky(glm::vec3(1));
		for (int Frame = 0; Frame < 5; ++Frame) { (void)TraceReference(View(), 1, 1); }
		Pictures[bCompact] = TraceReference(View(), 16, 2);
		Bytes[bCompact] = GetDevice().GetMemoryStats().Geometry;
	}
	PrintFigure(fmt::format("28,800 triangles: {} bytes, compacted {} ({} saved)", Bytes[0], Bytes[1], Stats().CompactionSavedBytes));
	EXPECT_LE(Bytes[1], Bytes[0]);
	EXPECT_EQ(Pictures[0].Pixels, Pictures[1].Pixels);
}

TEST_F(FGeometryBudgetTest, CoarserLevelLooksAlikeInLessMemory)
{
	ASSERT_TRUE(Load(MakeHills(240))); // 115,200 triangles
	SetSky(glm::vec3(1));
	const FImage Full = TraceReference(View(), 64, 2);
	const uint64_t FullBytes = GetDevice().GetMemoryStats().Geometry;
	SetVariable("r.RT.Build.MemoryMB", "4");
	ASSERT_TRUE(Load(MakeHills(240)));
	SetSky(glm::vec3(1));
	const FImage Coarse = TraceReference(View(), 64, 2);
	EXPECT_EQ(Stats().Coarse, 1u);
	EXPECT_LE(Stats().LiveBytes + Stats().ScratchBytes, 4u << 20);
	PrintFigure(fmt::format("115,200 triangles: {} bytes; within 4 MiB: {}; mean {:.4f} and {:.4f}, {:.4f} of the pixels differ by a tenth",
	    FullBytes, Stats().LiveBytes, MeanGreen(Full), MeanGreen(Coarse), FractionDiffering(Full, Coarse, 0.1)));
	EXPECT_NEAR(MeanGreen(Coarse) / MeanGreen(Full), 1.0, 0.01);
	EXPECT_LT(FractionDiffering(Full, Coarse, 0.1), 0.05);
}

TEST_F(FGeometryBudgetTest, BuildBudgetFillsThePictureOverFrames)
{
	FTestScene Tiles("tiles");
	const int32_t Grey = Tiles.AddLambert(glm::vec3(0.5f));
	for (int Tile = 0; Tile < 16; ++Tile)
	{
		Tiles.AddNode(Tiles.AddMesh({FTestScene::MakeFloor(Grey, 0.4f, 0.0f, {Tile % 4 - 1.5f, Tile / 4 - 1.5f})}));
	}
	ASSERT_TRUE(Load(std::move(Tiles.Scene)));
	SetVariable("r.RT.Build.TrianglesPerFrame", "8");
	FConsoleVariables::Get().BeginFrame();
	FRenderer& Renderer = GetEngine().GetRenderer();
	FFrameFeatures Features;
	Features.bRays = true;
	Features.bBuildAll = false;
	std::vector<uint32_t> Built;
	for (int Frame = 0; Frame < 5; ++Frame)
	{
		FView Above = MakeView(16, 16);
		ASSERT_OK(Renderer.BeginFrame(GetScene().GetScene(), Above, Features));
		Built.push_back(Stats().Built);
		ASSERT_OK(Renderer.EndFrame(nullptr));
	}
	EXPECT_EQ(Built, (std::vector<uint32_t>{4, 4, 4, 4, 0}));
	ASSERT_OK(Renderer.WaitForAll());
}

// ---------------------------------------------------------------------------------------------------- refit quality

/// Sums by the plain loop.
FRefitQualitySum MeasureBrute(
    const std::vector<glm::vec3>& Positions, const std::vector<uint32_t>& Indices, uint32_t First, uint32_t Triangles)
{
	FRefitQualitySum Sum{};
	for (uint32_t Group = 0; Group < Triangles; Group += REFIT_GROUP_TRIANGLES)
	{
		glm::vec3 Low(3e38f), High(-3e38f);
		for (uint32_t T = Group; T < std::min(Triangles, Group + REFIT_GROUP_TRIANGLES); ++T)
		{
			glm::vec3 P[3];
			for (uint32_t Corner = 0; Corner < 3; ++Corner)
			{
				P[Corner] = Positions[Indices[First + 3 * T + Corner]];
				Low = glm::min(Low, P[Corner]);
				High = glm::max(High, P[Corner]);
			}
			Sum.TriangleArea += glm::length(glm::cross(P[1] - P[0], P[2] - P[0]));
		}
		const glm::vec3 Size = High - Low;
		Sum.BoxArea += Size.x * Size.y + Size.y * Size.z + Size.z * Size.x;
	}
	return Sum;
}

class FRefitQualityTest : public FRenderTest
{
protected:
	template <class T>
	static TRTRef<IRTBuffer> Upload(const std::vector<T>& Values)
	{
		FUploader Uploader(GetDevice());
		TRTRef<IRTBuffer> Out;
		EXPECT_OK(Uploader.CreateBuffer("Test", ERTBufferUsage::Storage, Values.data(), Values.size() * sizeof(T), Out));
		EXPECT_OK(Uploader.Flush());
		return Out;
	}
	/// The shader's sums, added up.
	static FRefitQualitySum Measure(FRefitQualityConstants C)
	{
		IRTPipeline* Pipeline = nullptr;
		EXPECT_OK(GetEngine().GetRenderer().GetPipelines().Get({"Skinning/RefitQuality.comp", ERTShaderStage::Compute, {}, {}}, Pipeline));
		const uint32_t Groups = FRefitQuality::CountGroups(C.TriangleCount);
		TRTRef<IRTBuffer> Results;
		EXPECT_OK(GetDevice().CreateBuffer(
		    {Groups * sizeof(FRefitQualitySum), ERTBufferUsage::Storage, ERTMemory::Readback, "Sums"}, Results.ReleaseAndGetAddress()));
		C.Sums = Results->GetDeviceAddress();
		Dispatch(Pipeline, &C, sizeof(C), Groups, 1, Results.Get());
		FRefitQualitySum Sum{};
		for (uint32_t Group = 0; Group < Groups; ++Group)
		{
			const auto& Part = static_cast<const FRefitQualitySum*>(Results->GetMapped())[Group];
			Sum.BoxArea += Part.BoxArea;
			Sum.TriangleArea += Part.TriangleArea;
		}
		return Sum;
	}
	static uint32_t GetRebuilds() { return Rebuilds; }
	/// Frames of the animation; counts rebuilds.
	static void Play(int Frames, double Step)
	{
		Rebuilds = 0;
		for (int Frame = 0; Frame < Frames; ++Frame)
		{
			ASSERT_OK(GetEngine().RenderFrame(MakeView(64, 48), Step * Frame, {}, nullptr));
			ASSERT_OK(GetEngine().GetRenderer().WaitForAll());
			Rebuilds += GetScene().GetScene().GetGeometries().GetStats().Rebuilt;
		}
	}
	static inline uint32_t Rebuilds = 0;
};

TEST_F(FRefitQualityTest, ShaderEqualsThePlainLoop)
{
	std::mt19937 Random(3);
	std::uniform_real_distribution<float> Uniform(-2.0f, 5.0f);
	std::vector<glm::vec3> Positions(1000);
	for (glm::vec3& P : Positions) { P = {Uniform(Random), Uniform(Random), Uniform(Random)}; }
	std::vector<uint32_t> Indices(3 * 4000 + 6);
	for (uint32_t& Index : Indices) { Index = Random() % 1000; }
	const std::vector<uint16_t> Short(Indices.begin(), Indices.end());
	const TRTRef<IRTBuffer> P = Upload(Positions), Long32 = Upload(Indices), Short16 = Upload(Short);
	for (const bool b16 : {false, true})
	{
		for (const uint32_t Triangles : {1u, 31u, 33u, 1023u, 1024u, 1025u, 4000u})
		{
			for (const uint32_t First : {0u, 3u})
			{
				FRefitQualityConstants C{};
				C.Positions = P->GetDeviceAddress();
				C.Indices = (b16 ? Short16 : Long32)->GetDeviceAddress();
				C.FirstIndex = First;
				C.TriangleCount = Triangles;
				C.Flags = b16 ? REFIT_INDEX_16 : 0u;
				const FRefitQualitySum Sum = Measure(C), Brute = MeasureBrute(Positions, Indices, First, Triangles);
				EXPECT_NEAR(Sum.BoxArea / Brute.BoxArea, 1.0, 1e-4) << Triangles;
				EXPECT_NEAR(Sum.TriangleArea / Brute.TriangleArea, 1.0, 1e-4) << Triangles;
			}
		}
	}
}

// A walking figure hardly loosens; with a threshold just above 1 it is rebuilt where it does, and looks the same.
TEST_F(FRefitQualityTest, LooseFiguresAreRebuilt)
{
	REQUIRE_SCENE(Scene, "brainstem/BrainStem.glb");
	uint32_t Counts[3] = {};
	FImage Pictures[3];
	const char* const Thresholds[] = {"0", "1.02", "2"};
	for (int I = 0; I < 3; ++I)
	{
		ASSERT_TRUE(Load(Scene));
		SetSun(0.0, 4.0f, {0.25, -1, -0.6});
		SetVariable("r.RT.Skinning.RebuildInterval", "1000");
		SetVariable("r.RT.Skinning.RebuildQuality", Thresholds[I]);
		Play(20, 0.1);
		Counts[I] = GetRebuilds();
		Pictures[I] = RenderSunShadow(MakeView(64, 48), 1, 0, 2.0);
	}
	PrintFigure(fmt::format("brainstem, 20 frames: {} rebuilds, {} above 1.02, {} above 2", Counts[0], Counts[1], Counts[2]));
	EXPECT_EQ(Counts[0], 0u);
	EXPECT_GT(Counts[1], 0u);
	EXPECT_LT(Counts[2], Counts[1]);
	EXPECT_EQ(Pictures[0].Pixels, Pictures[1].Pixels);
	EXPECT_EQ(Pictures[0].Pixels, Pictures[2].Pixels);
}

} // namespace
} // namespace Lantern
