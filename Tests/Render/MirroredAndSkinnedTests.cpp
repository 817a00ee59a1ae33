// Objects whose transform mirrors, and objects that bend: raster and rays must see the same surfaces.
#include <cmath>

#include <glm/gtc/matrix_inverse.hpp>
#include <glm/gtc/matrix_transform.hpp>

#include "LanternHost/VertexPacking.h"
#include "LanternImage/ImageStatistics.h"
#include "Support/RenderFixture.h"
#include "Support/TestScene.h"

namespace Lantern
{

namespace
{

class FMirroredTest : public FRenderTest
{
protected:
	/// A corner of single-sided walls without symmetry, one of them shining. Mirrored by the node's transform, or in
	/// its vertices.
	bool LoadCorner(bool bByTransform)
	{
		FTestScene Corner("corner");
		const int32_t Grey = Corner.AddBumpyLambert(glm::vec3(0.5f)), Red = Corner.AddBumpyLambert({0.7f, 0.2f, 0.1f});
		const int32_t Light = Corner.AddLambert(glm::vec3(0), {4, 3, 2});
		const int32_t Mesh = Corner.AddMesh({
		    FTestScene::MakeFloor(Grey, 1.5f),
		    {Red, {{1.5f, 0, 1.5f}, {1.5f, 0, -1.5f}, {1.5f, 1, -1.5f}, {1.5f, 1, 1.5f}}},        // faces −x
		    {Grey, {{-1.5f, 0, -1.5f}, {-0.5f, 0, -1.5f}, {-0.5f, 2, -1.5f}, {-1.5f, 2, -1.5f}}}, // faces +z
		    {Grey, {{-1.0f, 0, 1.0f}, {-1.0f, 1, 1.0f}, {0.0f, 1, 1.2f}, {0.0f, 0, 1.2f}}},       // shows its back: culled
		    {Light, {{0.2f, 0.2f, -1.0f}, {1.0f, 0.2f, -1.2f}, {1.0f, 0.9f, -1.2f}, {0.2f, 0.9f, -1.0f}}},
		});
		if (!bByTransform) { Corner.Scene.Meshes[0] = MakeMirrored(std::move(Corner.Scene.Meshes[0])); }
		Corner.AddNode(Mesh, bByTransform ? glm::scale(glm::dmat4(1), {-1, 1, 1}) : glm::dmat4(1));
		return Load(std::move(Corner.Scene));
	}
	static FView MakeCornerView() { return LookAt({0.4, 1.6, 4.0}, {0, 0.4, 0}, 0.9f, 128, 80); }
	static constexpr glm::dvec3 SunDirection{0.4, -1.0, -0.6};
};

TEST_F(FMirroredTest, RasterAndShadowsEqualMirroredVertices)
{
	FImage Lighting[2], Shadow[2], Culled[2];
	// Mirrored triangles are sampled at other points, so that pictures lit by them differ in noise.
	SetVariable("r.RT.Lights.Emissive", "0");
	for (const bool bByTransform : {false, true})
	{
		ASSERT_TRUE(LoadCorner(bByTransform));
		SetSun(0.0, 4.0f, SunDirection);
		SetVariable("r.RT.Shadow.CasterFaces", "0");
		Lighting[bByTransform] = RenderLighting(MakeCornerView());
		Shadow[bByTransform] = RenderSunShadow(MakeCornerView());
		SetVariable("r.RT.Shadow.CasterFaces", "2");
		Culled[bByTransform] = RenderSunShadow(MakeCornerView());
	}
	const double Mean = ComputeMeans(Shadow[0]).Channel[0];
	EXPECT_TRUE(Mean > 0.3 && Mean < 0.99) << "there must be shadows to compare: " << Mean;
	EXPECT_GT(FractionDiffering(Shadow[0], Culled[0], 0.5), 0.005) << "culling must change something";
	// Normals are stored in 16 bits and mirrored before or after: the last digit may differ.
	EXPECT_LE(FractionDiffering(Lighting[0], Lighting[1], 2e-3), 0.002);
	EXPECT_LE(FractionDiffering(Shadow[0], Shadow[1], 0.0), 0.002);
	EXPECT_LE(FractionDiffering(Culled[0], Culled[1], 0.0), 0.002);
}

// The triangle's points and its front follow the mirror.
TEST_F(FMirroredTest, EmitterLightsAsMirroredVertices)
{
	double Mean[2];
	for (const bool bByTransform : {false, true})
	{
		ASSERT_TRUE(LoadCorner(bByTransform));
		SetSun(0.0, 0.0f);
		SetSky(glm::vec3(0));
		SetVariable("r.RT.Lights.Denoise", "0");
		Mean[bByTransform] = MeanGreen(RenderSignal(ESignal::LocalDiffuse, MakeCornerView(), 32));
	}
	EXPECT_GT(Mean[0], 0.001) << "the emitter must light something";
	// Rays of 32 frames at 10,240 pixels: their error is far below that.
	EXPECT_NEAR(Mean[0], Mean[1], 0.01 * Mean[0]);
}

TEST_F(FMirroredTest, ReferenceEqualsMirroredVertices)
{
	FImage Sun[2], Seen[2];
	FEstimate Emission[2];
	for (const bool bByTransform : {false, true})
	{
		ASSERT_TRUE(LoadCorner(bByTransform));
		Seen[bByTransform] = TraceReference(MakeCornerView(), 4, 0);
		Emission[bByTransform] = EstimateMean(MakeCornerView(), 8, 2);
		// The emitter shines on the floor, and not backwards through itself.
		SetSun(0.0, 4.0f, SunDirection);
		Sun[bByTransform] = TraceReference(MakeCornerView(), 4, 1);
	}
	EXPECT_GT(ComputeMeans(Seen[0]).MaxLuminance, 2.0) << "the emitter must be seen from its front";
	EXPECT_LE(FractionDiffering(Seen[0], Seen[1], 1e-3), 0.002);
	const double Sigma = std::hypot(Emission[0].StandardError, Emission[1].StandardError);
	PrintFigure(fmt::format(
	    "mirrored emitter: {:.5f} by vertices, {:.5f} by transform (statistical error {:.5f})", Emission[0].Mean, Emission[1].Mean, Sigma));
	EXPECT_NEAR(Emission[0].Mean, Emission[1].Mean, 3.5 * Sigma);
	EXPECT_LT(Sigma, 0.01 * Emission[0].Mean);
	EXPECT_NEAR(MeanGreen(Sun[0]), MeanGreen(Sun[1]), 0.01 * MeanGreen(Sun[0]));
}

// Raster and reference cull the same backs.
TEST_F(FMirroredTest, RasterEqualsReference)
{
	ASSERT_TRUE(LoadCorner(true));
	SetSun(0.0, 4.0f, SunDirection);
	const FImage Raster = RenderLightingFine(MakeCornerView(), 4);
	// Without the light of the emitter on the walls, which the raster has not.
	SetSun(0.0, 4.0f, SunDirection);
	const FImage Reference = TraceReference(MakeCornerView(), 32, 0);
	double Worst = 0.0;
	for (uint32_t Y = 0; Y < Raster.Height; ++Y)
	{
		for (uint32_t X = 0; X < Raster.Width; ++X)
		{
			const bool bEmitter = Reference.At(X, Y, 0) >= 4.0f * 0.999f;
			Worst = std::max(Worst, bEmitter ? std::abs(Raster.At(X, Y, 0) - 4.0) : 0.0);
		}
	}
	EXPECT_LT(Worst, 0.02);
}

class FSkinnedTest : public FRenderTest
{
protected:
	/// What lies before the sky: in the raster by fractions of a fine picture, in the reference by samples. Surfaces
	/// are black, the sky is 1.
	FImage RasterSky(const FView& View, double Time)
	{
		SetVariable("r.RT.SkyAmbient", "0");
		return RenderLightingFine(View, 4, Time);
	}
};

/// A ribbon of 12 quads hung on four joints, each vertex on all four, which turn against each other.
FSceneDescription MakeRibbon()
{
	FTestScene Ribbon("ribbon");
	std::vector<FTestScene::FQuad> Quads;
	const int32_t Material = Ribbon.AddLambert(glm::vec3(0.5f), glm::vec3(0), true);
	for (int I = 0; I < 12; ++I)
	{
		const float Y = 0.25f * float(I);
		Quads.push_back({Material, {{-0.4f, Y, 0}, {0.4f, Y, 0}, {0.4f, Y + 0.25f, 0}, {-0.4f, Y + 0.25f, 0}}});
	}
	const int32_t Mesh = Ribbon.AddMesh(Quads), Node = Ribbon.AddNode(Mesh);
	FSceneDescription& Scene = Ribbon.Scene;
	FHostMesh& Host = Scene.Meshes[static_cast<size_t>(Mesh)];
	for (const glm::vec3& P : Host.Positions)
	{
		FSkinWeights Weights;
		float Sum = 0.0f;
		for (int J = 0; J < 4; ++J)
		{
			Weights.Joints[J] = static_cast<uint16_t>(3 - J);
			Weights.Weights[J] = 1.0f / (0.1f + std::abs(P.y - float(3 - J)));
			Sum += Weights.Weights[J];
		}
		for (float& Weight : Weights.Weights) { Weight /= Sum; }
		Host.Skin.push_back(Weights);
	}
	FHostSkin Skin;
	FHostAnimation Animation;
	Animation.Duration = 2.0f;
	for (int J = 0; J < 4; ++J)
	{
		FHostNode Joint;
		Joint.Name = "joint";
		Joint.Parent = J == 0 ? -1 : static_cast<int32_t>(Scene.Nodes.size()) - 1;
		Joint.Translation = {0, J == 0 ? 0.0 : 1.0, 0};
		Skin.Joints.push_back(static_cast<int32_t>(Scene.Nodes.size()));
		Skin.InverseBind.push_back(glm::translate(glm::mat4(1), glm::vec3(0, -J, 0)));
		FHostChannel Channel;
		Channel.Node = Skin.Joints.back();
		Channel.Path = EAnimationPath::Rotation;
		Channel.Times = {0.0f, 2.0f};
		const glm::quat Turn = glm::angleAxis(0.5f + 0.2f * float(J), glm::normalize(glm::vec3(J % 2, 0.3f, 1 - J % 2)));
		Channel.Values = {{0, 0, 0, 1}, {Turn.x, Turn.y, Turn.z, Turn.w}};
		Animation.Channels.push_back(Channel);
		Scene.Nodes.push_back(Joint);
	}
	Scene.Skins.push_back(Skin);
	Scene.Animations.push_back(Animation);
	Scene.Nodes[static_cast<size_t>(Node)].Skin = 0;
	return Scene;
}

/// The ribbon as it hangs at Time, bent on the CPU (glTF 2.0, 3.7.3.3).
FSceneDescription BakeRibbon(double Time)
{
	FSceneDescription Scene = MakeRibbon();
	const std::vector<glm::mat4> Joints = EvaluateJoints(Scene, EvaluatePose(Scene, Time), 0);
	FHostMesh& Mesh = Scene.Meshes[0];
	for (size_t I = 0; I < Mesh.Positions.size(); ++I)
	{
		glm::mat4 M(0);
		for (int J = 0; J < 4; ++J) { M += Mesh.Skin[I].Weights[J] * Joints[Mesh.Skin[I].Joints[J]]; }
		Mesh.Positions[I] = glm::vec3(M * glm::vec4(Mesh.Positions[I], 1));
		const glm::vec3 Normal = glm::inverseTranspose(glm::mat3(M)) * UnpackUnitVector(Mesh.Attributes[I].Normal);
		Mesh.Attributes[I].Normal = PackUnitVector(glm::normalize(Normal));
	}
	Mesh.Skin.clear();
	Scene.Nodes[0].Skin = -1;
	Scene.Animations.clear();
	return Scene;
}

// Positions and normals out of the skinning shader are those of the formula: equal pictures of raster and reference, but
// for the last digit at edges.
TEST_F(FSkinnedTest, GpuSkinningEqualsCpu)
{
	FImage Raster[2], Traced[2];
	const FView View = LookAt({1.0, 2.0, 5.0}, {-0.5, 1.2, 0}, 0.8f, 128, 128);
	for (const bool bBaked : {false, true})
	{
		ASSERT_TRUE(Load(bBaked ? BakeRibbon(1.4) : MakeRibbon()));
		SetSun(0.0, 4.0f, {-0.3, -0.5, -1});
		if (!bBaked)
		{
			ASSERT_OK(GetEngine().RenderFrame(View, 0.2, {}, nullptr)); // another pose before
		}
		Raster[bBaked] = RenderLighting(View, 1.4);
		Traced[bBaked] = TraceReference(View, 2, 1, 1.4);
	}
	EXPECT_GT(MeanGreen(Raster[1]), 0.03);
	EXPECT_LE(FractionDiffering(Raster[0], Raster[1], 2e-3), 0.003);
	EXPECT_LE(FractionDiffering(Traced[0], Traced[1], 2e-3), 0.003);
}

// The silhouette of the bent model at several moments: pixels that are all sky or all model in one are so in the other.
TEST_F(FSkinnedTest, RasterSilhouetteEqualsReference)
{
	REQUIRE_SCENE(Scene, "brainstem/BrainStem.glb");
	ASSERT_TRUE(Load(Scene));
	SetSun(0.0, 0.0f);
	SetSky(glm::vec3(1));
	SetVariable("r.RT.Material.Override", "2");
	const FView View = MakeView(128, 96);
	FImage First;
	for (const double Time : {0.0, 1.3, 7.9})
	{
		const FImage Raster = RasterSky(View, Time);
		const FImage Reference = TraceReference(View, 16, 0, Time);
		size_t Wrong = 0, Inside = 0;
		for (size_t I = 0; I < Raster.GetPixelCount(); ++I)
		{
			// 16 samples all miss what covers 40 % of a pixel once in 3,500 times.
			const float Sky = Reference.Pixels[3 * I];
			Inside += Sky == 0.0f ? 1 : 0;
			Wrong += (Sky == 0.0f && Raster.Pixels[3 * I] > 0.4f) || (Sky == 1.0f && Raster.Pixels[3 * I] < 0.6f) ? 1 : 0;
		}
		PrintFigure(fmt::format("brainstem at {} s: {} pixels inside, {} wrong, covers {:.4f} and {:.4f}", Time, Inside, Wrong,
		    1.0 - MeanGreen(Raster), 1.0 - MeanGreen(Reference)));
		EXPECT_GT(Inside, 500u);
		EXPECT_LE(Wrong, 2u);
		EXPECT_NEAR(MeanGreen(Raster), MeanGreen(Reference), 0.002);
		if (Time > 0.0) { EXPECT_GT(FractionDiffering(First, Raster, 0.5), 0.01) << "it must have moved"; }
		else { First = Raster; }
	}
}

// After many refits the shadows are those of a structure built anew.
TEST_F(FSkinnedTest, RefitEqualsRebuild)
{
	REQUIRE_SCENE(Scene, "brainstem/BrainStem.glb");
	FImage Pictures[2];
	for (const bool bRebuild : {false, true})
	{
		ASSERT_TRUE(Load(Scene));
		SetSun(0.0, 4.0f, {0.25, -1, -0.6});
		SetVariable("r.RT.Skinning.RebuildInterval", bRebuild ? "1" : "1000");
		const FView View = MakeView(128, 96);
		for (int Frame = 0; Frame < 20; ++Frame) { ASSERT_OK(GetEngine().RenderFrame(View, 0.1 * Frame, {}, nullptr)); }
		Pictures[bRebuild] = RenderSunShadow(View, 1, 0, 2.0);
	}
	const double Mean = ComputeMeans(Pictures[0]).Channel[0];
	EXPECT_TRUE(Mean > 0.3 && Mean < 0.999) << Mean;
	EXPECT_EQ(Pictures[0].Pixels, Pictures[1].Pixels);
}

// Shadows follow the pose of this frame, not of the last: the reference at the same time agrees.
TEST_F(FSkinnedTest, ShadowsFollowThePose)
{
	REQUIRE_SCENE(Scene, "brainstem/BrainStem.glb");
	ASSERT_TRUE(Load(Scene));
	SetSun(0.0, 4.0f, {0.25, -1, -0.6});
	SetVariable("r.RT.Material.Override", "2");
	const FView View = MakeView(128, 96);
	ASSERT_OK(GetEngine().RenderFrame(View, 0.0, {}, nullptr));
	const FImage Raster = RenderLightingFine(View, 6, 3.1);
	const FImage Reference = TraceReference(View, 64, 1, 3.1);
	const FImage Stale = TraceReference(View, 32, 1, 2.6);
	const auto Error = [&](const FImage& Other) {
		double Sum = 0.0;
		for (size_t I = 0; I < Raster.Pixels.size(); ++I) { Sum += std::abs(Raster.Pixels[I] - Other.Pixels[I]); }
		return Sum / double(Raster.Pixels.size()) / MeanGreen(Reference);
	};
	PrintFigure(fmt::format("brainstem under sun: mean difference {:.4f}, half a second earlier {:.4f}", Error(Reference), Error(Stale)));
	// Edges of a model this fine leave the noise of 36 and 64 samples in most of its pixels.
	EXPECT_LT(Error(Reference), 0.08);
	EXPECT_GT(Error(Stale), 5.0 * Error(Reference));
}

} // namespace
} // namespace Lantern
