// Emissive triangles where they are no longer what the CPU knows: meshes that deform, and materials that light otherwise than they look.
#include <algorithm>
#include <cmath>

#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/quaternion.hpp>

#include "SignalFixture.h"

namespace Lantern
{

namespace
{
class FEmissiveMeshesTest : public FSignalTest
{
protected:
	void SetUp() override
	{
		FSignalTest::SetUp();
		SetVariable("r.RT.Lights.Denoise", "0"); // the filter weighs outliers less
	}
	static FRTScene& GetWorld() { return GetScene().GetScene(); }
	/// A floor in stripes: rough ones and smooth ones, which the G-buffer holds exactly.
	static FTestScene MakeStage(const std::vector<float>& Roughnesses = {38.0f / 255.0f, 64.0f / 255.0f, 102.0f / 255.0f, 1.0f})
	{
		FTestScene Scene("stage");
		std::vector<FTestScene::FQuad> Floor;
		const float Width = 8.0f / float(Roughnesses.size());
		for (const float Roughness : Roughnesses)
		{
			FHostMaterial Material;
			Material.BaseColor = glm::vec4(0.6f, 0.4f, 0.3f, 1.0f);
			Material.Metallic = 0.0f;
			Material.Roughness = Roughness;
			const float X = -4.0f + Width * float(Floor.size());
			Floor.push_back({Scene.AddMaterial(Material), {{X, 0, 2}, {X + Width, 0, 2}, {X + Width, 0, -2}, {X, 0, -2}}});
		}
		Scene.AddNode(Scene.AddMesh(Floor));
		return Scene;
	}
	/// A bright band, 2 m high, hung on three joints. It is bent to one side at the start and to the other after two seconds.
	static void AddBand(FTestScene& Scene, const glm::vec3& Emission)
	{
		const int32_t Material = Scene.AddLambert(glm::vec3(0), Emission, true);
		std::vector<FTestScene::FQuad> Quads;
		for (int I = 0; I < 10; ++I)
		{
			const float Y = 0.2f * float(I);
			Quads.push_back({Material, {{-0.2f, Y, 0}, {0.2f, Y, 0}, {0.2f, Y + 0.2f, 0}, {-0.2f, Y + 0.2f, 0}}});
		}
		const int32_t Mesh = Scene.AddMesh(Quads), Node = Scene.AddNode(Mesh);
		FHostMesh& Host = Scene.Scene.Meshes[size_t(Mesh)];
		for (const glm::vec3& P : Host.Positions)
		{
			const float Place = std::clamp(P.y, 0.0f, 1.999f);
			const auto Joint = static_cast<uint16_t>(Place);
			FSkinWeights Weights;
			Weights.Joints = {Joint, uint16_t(Joint + 1), 0, 0};
			Weights.Weights = {float(Joint) + 1.0f - Place, Place - float(Joint), 0, 0};
			Host.Skin.push_back(Weights);
		}
		FHostSkin Skin;
		FHostAnimation Animation;
		Animation.Duration = 2.0f; // and then again
		for (int J = 0; J < 3; ++J)
		{
			FHostNode Joint;
			Joint.Name = "joint";
			Joint.Parent = J == 0 ? -1 : static_cast<int32_t>(Scene.Scene.Nodes.size()) - 1;
			Joint.Translation = {0, J == 0 ? 0.3 : 1.0, 0};
			Skin.Joints.push_back(static_cast<int32_t>(Scene.Scene.Nodes.size()));
			Skin.InverseBind.push_back(glm::translate(glm::mat4(1), glm::vec3(0, -J, 0)));
			FHostChannel Channel;
			Channel.Node = Skin.Joints.back();
			Channel.Path = EAnimationPath::Rotation;
			Channel.Times = {0.0f, 2.0f};
			for (const float Angle : {0.6f, -0.6f})
			{
				const glm::quat Turn = glm::angleAxis(Angle, glm::vec3(0, 0, 1));
				Channel.Values.push_back({Turn.x, Turn.y, Turn.z, Turn.w});
			}
			Animation.Channels.push_back(Channel);
			Scene.Scene.Nodes.push_back(Joint);
		}
		Scene.Scene.Skins.push_back(Skin);
		Scene.Scene.Animations.push_back(Animation);
		Scene.Scene.Nodes[size_t(Node)].Skin = 0;
	}
	static FTestScene::FQuad MakePanel(int32_t Material, float Half, float Height, glm::vec2 Center, bool bUp = false)
	{
		FTestScene::FQuad Quad = FTestScene::MakeFloor(Material, Half, Height, Center);
		if (!bUp) { std::reverse(std::begin(Quad.P), std::end(Quad.P)); }
		return Quad;
	}
	[[nodiscard]] bool LoadDark(FTestScene& Scene)
	{
		if (!Load(std::move(Scene.Scene))) { return false; }
		SetSun(0.0, 0.0f);
		SetSky(glm::vec3(0));
		return true;
	}
	[[nodiscard]] bool LoadBand(const glm::vec3& Emission = {9, 7, 5})
	{
		FTestScene Scene = MakeStage();
		AddBand(Scene, Emission);
		return LoadDark(Scene);
	}
	/// A dim-looking panel over a floor.
	[[nodiscard]] bool LoadLamp(const glm::vec3& Seen, std::optional<glm::vec3> Light, const std::vector<float>& Roughnesses)
	{
		FTestScene Scene = MakeStage(Roughnesses);
		const int32_t Lamp = Scene.AddLambert(glm::vec3(0), Seen, true);
		Scene.Scene.Materials[size_t(Lamp)].LightEmissive = Light;
		Scene.AddNode(Scene.AddMesh({{Lamp, {{-2, 0.5f, -1}, {2, 0.5f, -1}, {2, 1.1f, -1}, {-2, 1.1f, -1}}}}));
		return LoadDark(Scene);
	}
	static FView LookAtStage(uint32_t Width, uint32_t Height) { return LookAt({0, 2.2, 4.2}, {0, 0.3, 0}, 0.9f, Width, Height); }
};

TEST_F(FEmissiveMeshesTest, BentBandAsTheReference)
{
	ASSERT_TRUE(LoadBand());
	const FView View = LookAtStage(48, 27);
	EXPECT_EQ((HasSignal(ESignal::LocalDiffuse, View), GetWorld().GetFacts().EmissiveTriangles), 20u);
	ExpectUnbiased("bent band", ESignal::LocalDiffuse, View, 64, 256, 1, 0.005);
}

// Paths find the band by chance as well, wherever lists say that it is.
TEST_F(FEmissiveMeshesTest, SumOfSignalsOfABentBandAsTheWholeFrame)
{
	ASSERT_TRUE(LoadBand());
	const FView View = LookAtStage(64, 36);
	SetIndirect(4, 1);
	ExpectUnbiased("bent band, all signals", ESignal::Frame, View, 32, 256, 2, 0.005);
	// The whole frame by rays that know nothing of lists.
	const FEstimate Right = EstimateSignal(ESignal::Frame, View, 256, 2, 6);
	SetVariable("r.RT.Lights.Emissive", "0");
	const FEstimate Blind = EstimateFrames(ESignal::Frame, View, 32, 6);
	EXPECT_NEAR(Blind.Mean, Right.Mean, 0.005 * Right.Mean + 3.0 * std::hypot(Blind.StandardError, Right.StandardError));
}

TEST_F(FEmissiveMeshesTest, LightFollowsThePose)
{
	ASSERT_TRUE(LoadBand());
	const FView View = LookAtStage(64, 36);
	const auto SumHalf = [](const FImage& Image, uint32_t First) {
		double Sum = 0.0;
		for (uint32_t Y = 0; Y < Image.Height; ++Y)
		{
			for (uint32_t X = First; X < First + 32; ++X) { Sum += Image.Pixels[(size_t(Y) * Image.Width + X) * Image.Channels]; }
		}
		return Sum;
	};
	const auto Lean = [&](double Time) {
		const FImage Picture = RenderSignal(ESignal::LocalDiffuse, View, 4, 0, Time);
		return SumHalf(Picture, 0) / SumHalf(Picture, 32);
	};
	const double Left = Lean(0.0), Right = Lean(1.999);
	PrintFigure(fmt::format("light of the left half by that of the right: {:.3f}, then {:.3f}", Left, Right));
	EXPECT_GT(Left, 1.3);
	EXPECT_NEAR(Left * Right, 1.0, 0.05);
	SetVariable("r.RT.Debug.Lights.EmissiveFollow", "0");
	EXPECT_LT(Lean(0.0), 1.0) << "where the band was";
}

// A floodlight turned away, of 2^31 times the power: fp32 sums of power leave nothing of what is dim beside it.
TEST_F(FEmissiveMeshesTest, DimBesideAFloodlightAsTheReference)
{
	for (const bool bOneMesh : {false, true})
	{
		FTestScene Scene = MakeStage();
		const int32_t Flood = Scene.AddLambert(glm::vec3(0), glm::vec3(4e6f)), Dim = Scene.AddLambert(glm::vec3(0), glm::vec3(20));
		const std::vector<FTestScene::FQuad> Lamps = {MakePanel(Flood, 10.0f, 9.0f, {0, 0}, true), MakePanel(Dim, 0.1f, 1.0f, {0, 0})};
		if (bOneMesh)
		{
			Scene.AddNode(Scene.AddMesh(Lamps));
			// So many triangles that those four are one cluster; they shine away from the floor.
			for (int I = 0; I < 800; ++I) { Scene.AddNode(Scene.AddMesh({MakePanel(Dim, 0.001f, 8.0f, {0.01f * float(I), 0}, true)})); }
		}
		else
		{
			for (const FTestScene::FQuad& Lamp : Lamps) { Scene.AddNode(Scene.AddMesh({Lamp})); }
		}
		ASSERT_TRUE(LoadDark(Scene));
		const FView View = LookAtStage(32, 18);
		const char* const What = bOneMesh ? "floodlight, dim panel, one mesh" : "floodlight, dim panel";
		ExpectUnbiased(What, ESignal::LocalDiffuse, View, 64, 1024, 1, 0.02);
		SetVariable("r.RT.Debug.Lights.EmissiveFloor", "0");
		ASSERT_OK(GetEngine().GetRenderer().WaitForAll());
		// What moves has its clusters done again, however little it is.
		for (const uint32_t Node : {1u, 2u}) { GetScene().SetTransform(Node, glm::translate(glm::dmat4(1), glm::dvec3(1e-6, 0, 0))); }
		EXPECT_EQ(MeanGreen(TraceSignal(ESignal::LocalDiffuse, View, 64, 1)), 0.0) << What;
		SetVariable("r.RT.Debug.Lights.EmissiveFloor", "1");
	}
}

// The floor is lit by 510 where the camera sees 1.
TEST_F(FEmissiveMeshesTest, LooksDimAndLightsBright)
{
	const FView View = LookAtStage(48, 27);
	ASSERT_TRUE(LoadLamp(glm::vec3(510), {}, {1.0f}));
	const double Bright = EstimateSignal(ESignal::LocalDiffuse, View, 768, 1, 4).Mean;
	const double BrightFrame = EstimateSignal(ESignal::DiffuseGI, View, 256, 2, 4).Mean;
	ASSERT_TRUE(LoadLamp(glm::vec3(1), glm::vec3(510), {1.0f}));
	EXPECT_TRUE((HasSignal(ESignal::LocalDiffuse, View), GetWorld().GetFacts().bLightEmission));
	ExpectUnbiased("looks like 1, lights with 510", ESignal::LocalDiffuse, View, 128, 768, 1, 0.005);
	EXPECT_NEAR(EstimateFrames(ESignal::LocalDiffuse, View, 128, 4).Mean / Bright, 1.0, 0.005);
	EXPECT_NEAR(EstimateSignal(ESignal::DiffuseGI, View, 256, 2, 4).Mean / BrightFrame, 1.0, 0.02);
	const FView Close = LookAt({0, 0.8, 0.5}, {0, 0.8, -1}, 0.2f, 16, 9);
	for (const FImage& Seen : {RenderLighting(Close), TraceReference(Close, 4, 0)})
	{
		EXPECT_NEAR(ComputeMeans(Seen).MaxLuminance, 1.0, 1e-3);
		EXPECT_NEAR(MeanGreen(Seen), 1.0, 1e-3);
	}
	SetVariable("r.RT.Debug.Lights.LightEmission", "0");
	EXPECT_LT(EstimateFrames(ESignal::LocalDiffuse, View, 8, 2).Mean / Bright, 0.01) << "lit by what the camera sees";
}

// A mirror shows 1 as well, a rough floor the light of 510, and what lies between shares them.
TEST_F(FEmissiveMeshesTest, MirrorsShowWhatCamerasSee)
{
	const FView View = LookAtStage(48, 27);
	ASSERT_TRUE(LoadLamp(glm::vec3(1), glm::vec3(510), {0.0f}));
	SetIndirect(4, 1);
	const FImage Mirrored = RenderSignal(ESignal::Reflections, View, 4);
	EXPECT_LT(ComputeMeans(Mirrored).MaxLuminance, 1.0);
	EXPECT_GT(ComputeMeans(Mirrored).MaxLuminance, 0.03);
	ASSERT_TRUE(LoadLamp(glm::vec3(8, 1, 1), glm::vec3(20, 40, 40), {38.0f / 255.0f, 64.0f / 255.0f, 102.0f / 255.0f, 1.0f}));
	ExpectUnbiased("light emission, specular", ESignal::LocalSpecular, View, 128, 768, 1, 0.01);
	ExpectUnbiased("light emission, reflections", ESignal::Reflections, View, 128, 768, 2, 0.01);
	ExpectUnbiased("light emission, all signals", ESignal::Frame, View, 64, 512, 2, 0.005);
}

} // namespace
} // namespace Lantern
