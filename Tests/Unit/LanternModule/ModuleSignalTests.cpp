// Signals of the module: what an engine asks for is made, and nothing else is.
#include <algorithm>
#include <limits>

#include "ModuleSignalFixture.h"

namespace Lantern
{
namespace
{

using ::testing::AnyOf;
using ::testing::Contains;
using ::testing::Each;
using ::testing::HasSubstr;
using ::testing::IsSupersetOf;
using ::testing::Not;
using ::testing::StartsWith;

TEST_F(FModuleSignalTest, EverySignalOfTheRegistryIsAnOutput)
{
	const float Sky[3] = {1, 1, 1};
	ASSERT_OK(Renderer->SetSky(Sky));
	FRTModuleLight Lamp;
	ERTLightHandle LampHandle = ERTLightHandle::None;
	ASSERT_OK(Renderer->AddLight(Lamp, &LampHandle));
	SetVariable("r.RT.GI", "1");
	SetVariable("r.RT.Reflections", "1");
	SetVariable("r.RT.Reflections.MaxRoughness", "0.5"); // and rough lobes take other paths
	for (const FSignalInfo& Info : SignalInfos)
	{
		if (Info.Signal == ESignal::Frame) { continue; }
		FRTModuleFrame Frame = DescribeAll();
		Frame.Wanted = {Info.Signal};
		RenderUntilComplete(Frame);
		for (const FSignalInfo& Other : SignalInfos)
		{
			EXPECT_EQ(Outputs.Get(Other.Signal) != nullptr, Other.Signal == Info.Signal) << Other.Name;
		}
		ASSERT_NE(Outputs.Get(Info.Signal), nullptr) << Info.Name;
		EXPECT_EQ(Outputs.Get(Info.Signal)->GetDesc().Format, Info.Format) << Info.Name;
	}
}

TEST_F(FModuleSignalTest, ByDefaultThereAreSunShadowsOnly)
{
	const float Sky[3] = {1, 1, 1};
	ASSERT_OK(Renderer->SetSky(Sky));
	RenderAndEnd(DescribeFrame());
	EXPECT_NE(Outputs.Get(ESignal::SunShadow), nullptr);
	EXPECT_EQ(Outputs.Get(ESignal::AmbientOcclusion), nullptr);
	EXPECT_EQ(Outputs.Get(ESignal::DiffuseGI), nullptr);
	EXPECT_EQ(Outputs.Get(ESignal::Reflections), nullptr);
	EXPECT_THAT(GetPasses(), Not(Contains(AnyOf(StartsWith("Ambient"), StartsWith("DiffuseGI"), StartsWith("Reflections")))));
	EXPECT_THAT(Mock().GetCreatedPipelines(), Not(Contains(HasSubstr("Ambient"))));
}

TEST_F(FModuleSignalTest, NothingAskedForIsNothingMade)
{
	FRTModuleFrame Frame = DescribeAll();
	Frame.Wanted = {};
	RenderAndEnd(Frame);
	EXPECT_EQ(Outputs.Get(ESignal::SunShadow), nullptr);
	EXPECT_TRUE(Outputs.bComplete);
	EXPECT_THAT(GetPasses(), Each("SceneUpdate")) << "the scene's tables";
	for (const ERTMockCall Kind : {ERTMockCall::CreateComputePipeline, ERTMockCall::CreateRayTracingPipeline, ERTMockCall::CreateTexture,
	         ERTMockCall::BuildGeometry, ERTMockCall::BuildScene})
	{
		EXPECT_EQ(Mock().CountCalls(Kind), 0u) << static_cast<int>(Kind);
	}
}

TEST_F(FModuleSignalTest, AmbientOcclusionAloneNeedsNoSunAndNoSky)
{
	for (const char* Path : {"1", "2"})
	{
		SetVariable("r.RT.AO.Path", Path);
		ASSERT_OK(SetSun(-1.0, 0.0f));
		FRTModuleFrame Frame = DescribeFrame();
		Frame.Wanted = {ESignal::SunShadow, ESignal::AmbientOcclusion};
		RenderUntilComplete(Frame);
		EXPECT_EQ(Outputs.Get(ESignal::SunShadow), nullptr) << "no sun";
		ASSERT_NE(Outputs.Get(ESignal::AmbientOcclusion), nullptr);
		EXPECT_EQ(Outputs.Get(ESignal::AmbientOcclusion)->GetDesc().Format, ERTFormat::R16_FLOAT);
		EXPECT_EQ(Outputs.Get(ESignal::AmbientOcclusion)->GetDesc().Width, 64u);
		EXPECT_TRUE(HasAny(Outputs.Get(ESignal::AmbientOcclusion)->GetDesc().Usage, ERTTextureUsage::CopySource));
		EXPECT_THAT(GetPasses(), Contains("AmbientOcclusion"));
		EXPECT_THAT(GetPasses(), Not(Contains("SunShadow")));
	}
	SetVariable("r.RT.AO", "0");
	FRTModuleFrame Frame = DescribeFrame();
	Frame.Wanted.Add(ESignal::AmbientOcclusion);
	RenderAndEnd(Frame);
	EXPECT_EQ(Outputs.Get(ESignal::AmbientOcclusion), nullptr);
	EXPECT_TRUE(Outputs.bComplete) << "off is not missing";
}

TEST_F(FModuleSignalTest, IndirectLightIsGivenWhereItIsAskedForAndOn)
{
	const float Sky[3] = {1, 1, 1};
	ASSERT_OK(Renderer->SetSky(Sky));
	RenderUntilComplete(DescribeAll());
	EXPECT_EQ(Outputs.Get(ESignal::DiffuseGI), nullptr) << "off by default";
	EXPECT_EQ(Outputs.Get(ESignal::Reflections), nullptr);
	EXPECT_NE(Outputs.Get(ESignal::AmbientOcclusion), nullptr);
	SetVariable("r.RT.GI", "1");
	SetVariable("r.RT.Reflections", "1");
	RenderUntilComplete(DescribeAll());
	ASSERT_TRUE(Outputs.Get(ESignal::DiffuseGI) && Outputs.Get(ESignal::Reflections));
	for (IRTTexture* const Texture : {Outputs.Get(ESignal::DiffuseGI), Outputs.Get(ESignal::Reflections)})
	{
		EXPECT_EQ(Texture->GetDesc().Format, ERTFormat::RGBA16_FLOAT);
		EXPECT_TRUE(HasAny(Texture->GetDesc().Usage, ERTTextureUsage::CopySource));
	}
	EXPECT_NE(Outputs.Get(ESignal::AmbientOcclusion), nullptr) << "asked for beside it";
	EXPECT_THAT(GetPasses(), IsSupersetOf({"SunShadow", "AmbientOcclusion", "Reflections", "DiffuseGI"}));
	FRTModuleFrame Frame = DescribeAll();
	Frame.BaseColor = nullptr;
	RenderUntilComplete(Frame);
	EXPECT_EQ(Outputs.Get(ESignal::Reflections), nullptr) << "an input is missing";
	EXPECT_NE(Outputs.Get(ESignal::DiffuseGI), nullptr);
	EXPECT_THAT(GetPasses(), Not(Contains("Reflections")));
}

// Reflections ask for radiance cells: their votes must be there before the cells are brought up to date, in whatever order signals are added.
TEST_F(FModuleSignalTest, ReflectionsVoteForCellsBeforeTheseAreKept)
{
	const float Sky[3] = {1, 1, 1};
	ASSERT_OK(Renderer->SetSky(Sky));
	SetVariable("r.RT.GI", "3");
	SetVariable("r.RT.Reflections", "1");
	RenderUntilComplete(DescribeAll());
	ASSERT_TRUE(Outputs.Get(ESignal::DiffuseGI) && Outputs.Get(ESignal::Reflections));
	const std::vector<std::string> Passes = GetPasses();
	const auto Find = [&](const char* Name) { return std::find(Passes.begin(), Passes.end(), Name); };
	const auto Traced = Find("Reflections"), Kept = Find("RadianceCellsVotes");
	ASSERT_TRUE(Traced != Passes.end() && Kept != Passes.end());
	EXPECT_LT(Traced, Kept);
	EXPECT_EQ(std::count(Passes.begin(), Passes.end(), "Reflections"), 1);
}

TEST_F(FModuleSignalTest, WithoutMotionThatOfTheCameraStandsIn)
{
	FRTModuleFrame Frame = DescribeFrame();
	Frame.Wanted = {ESignal::AmbientOcclusion};
	RenderUntilComplete(Frame);
	Frame.Commands = DescribeFrame().Commands;
	RenderAndEnd(Frame);
	EXPECT_THAT(GetPasses(), Contains("CameraMotion")) << "a history is followed";
	Frame = DescribeAll();
	Frame.Wanted = {ESignal::AmbientOcclusion};
	RenderAndEnd(Frame);
	EXPECT_THAT(GetPasses(), Not(Contains("CameraMotion")));
	EXPECT_THAT(GetPasses(), Contains("AmbientOcclusionTemporal"));
}

TEST_F(FModuleSignalTest, MotionOfObjectsIsLeftToTheEngine)
{
	RenderAndEnd(DescribeFrame());
	double Moved[12] = {1, 0, 0, 5, 0, 1, 0, 0, 0, 0, 1, 0};
	ASSERT_OK(Renderer->SetObjectTransform(Object, Moved));
	RenderAndEnd(DescribeAll());
	EXPECT_THAT(Mock().GetCreatedBuffers(), Not(Contains(HasSubstr("Motion"))));
}

// Channels of pixels are the engine's: they are read where a lamp is not of channel 0, and nowhere else.
TEST_F(FModuleSignalTest, ChannelsOfPixelsAreReadWhereLampsHaveSome)
{
	TRTRef<IRTTexture> Channels = MakeTexture(ERTFormat::R8_UNORM, 64);
	FRTModuleFrame Frame = DescribeAll();
	Frame.Wanted = {ESignal::LocalDiffuse};
	Frame.Channels = Channels.Get();
	FRTModuleLight Lamp;
	Lamp.Color[0] = 1.0f;
	ERTLightHandle Handle{};
	ASSERT_OK(Renderer->AddLight(Lamp, &Handle));
	RenderUntilComplete(Frame);
	EXPECT_THAT(GetPasses(), Not(Contains("PixelChannels")));
	Lamp.Channels = 2;
	ASSERT_OK(Renderer->SetLight(Handle, Lamp));
	ASSERT_TRUE(WaitUntil(
	    "channels", [&] { return ::testing::Value(GetPasses(), Contains("PixelChannels")); }, [&] { RenderUntilComplete(Frame); }));
	Frame.Channels = nullptr;
	RenderUntilComplete(Frame);
	EXPECT_THAT(GetPasses(), Not(Contains("PixelChannels"))) << "all pixels are of channel 0";
	Channels.Reset();
}

TEST_F(FModuleSignalTest, WrongInputsAreNamed)
{
	FRTModuleFrame Frame = DescribeAll();
	for (const float Seconds : {0.0f, -1.0f, std::numeric_limits<float>::infinity(), std::numeric_limits<float>::quiet_NaN()})
	{
		Frame.DeltaSeconds = Seconds;
		EXPECT_REFUSED(Renderer->RenderFrame(Frame, &Outputs), "DeltaSeconds");
	}
	Frame = DescribeAll();
	for (const float Factor : {-1.0f, std::numeric_limits<float>::infinity(), std::numeric_limits<float>::quiet_NaN()})
	{
		Frame.Exposure = Factor;
		EXPECT_REFUSED(Renderer->RenderFrame(Frame, &Outputs), "Exposure");
	}
	Frame = DescribeAll();
	Frame.Motion = Normals.Get();
	EXPECT_REFUSED(Renderer->RenderFrame(Frame, &Outputs), "the motion texture must be RGBA32_FLOAT");
	Frame = DescribeAll();
	Frame.MotionAccess = ERTAccess::None;
	EXPECT_REFUSED(Renderer->RenderFrame(Frame, &Outputs), "MotionAccess");
	Frame = DescribeAll();
	Frame.Classes = Normals.Get();
	EXPECT_REFUSED(Renderer->RenderFrame(Frame, &Outputs), "the classes texture must be R8_UNORM");
	Frame = DescribeAll();
	Frame.Channels = Normals.Get();
	EXPECT_REFUSED(Renderer->RenderFrame(Frame, &Outputs), "the channels texture must be R8_UNORM");
	Frame = DescribeAll();
	Frame.ToonNumbers = Normals.Get();
	EXPECT_REFUSED(Renderer->RenderFrame(Frame, &Outputs), "the toon numbers texture must be R8_UNORM");
	Frame = DescribeAll();
	Frame.BackAlbedo = Normals.Get();
	EXPECT_REFUSED(Renderer->RenderFrame(Frame, &Outputs), "the back albedo texture must be RGBA8_SRGB");
	Frame.BackAlbedo = BaseColor.Get();
	Frame.Material = nullptr;
	EXPECT_REFUSED(Renderer->RenderFrame(Frame, &Outputs), "BackAlbedo needs BaseColor and Material");
	Frame = DescribeAll();
	Frame.BaseColor = Material.Get();
	EXPECT_REFUSED(Renderer->RenderFrame(Frame, &Outputs), "the base colour texture must be RGBA8_SRGB");
	Frame = DescribeAll();
	const TRTRef<IRTTexture> Small = MakeTexture(ERTFormat::RGBA8_UNORM, 32);
	Frame.Material = Small.Get();
	EXPECT_REFUSED(Renderer->RenderFrame(Frame, &Outputs), "the material texture is 32 x 32, depth is 64 x 64");
	for (const float Bad : {-1.0f, std::numeric_limits<float>::infinity(), std::numeric_limits<float>::quiet_NaN()})
	{
		const float Sky[3] = {1, Bad, 1};
		EXPECT_REFUSED(Renderer->SetSky(Sky), "the sky's radiance");
	}
	RenderAndEnd(DescribeAll());
}

// Paths shade what they hit: what is not a number in a material would be none in the outputs.
TEST_F(FModuleSignalTest, ImpossibleMaterialsAreNamed)
{
	const auto Refuse = [&](const FRTModuleMaterial& Bad, const char* Part) {
		ERTMaterialHandle Added = ERTMaterialHandle::None;
		EXPECT_REFUSED(Renderer->AddMaterial(Bad, &Added), Part);
		EXPECT_EQ(Added, ERTMaterialHandle::None);
	};
	const float NaN = std::numeric_limits<float>::quiet_NaN();
	for (const float Value : {NaN, std::numeric_limits<float>::infinity(), -1.0f})
	{
		FRTModuleMaterial Bad;
		Bad.BaseColor[1] = Value;
		Refuse(Bad, "BaseColor");
		Bad = {};
		Bad.Emissive[2] = Value;
		Refuse(Bad, "Emissive");
		Bad = {};
		Bad.LightEmissive[0] = Value;
		Refuse(Bad, "LightEmissive");
		Bad = {};
		Bad.Metallic = Value;
		Refuse(Bad, "Metallic");
		Bad = {};
		Bad.Roughness = Value;
		Refuse(Bad, "Roughness");
		Bad = {};
		Bad.DiffuseTransmissionColor[2] = Value;
		Refuse(Bad, "DiffuseTransmissionColor[2]");
	}
	FRTModuleMaterial Bad;
	Bad.AlphaCutoff = NaN;
	Refuse(Bad, "AlphaCutoff");
	Bad = {};
	Bad.Roughness = 1.5f;
	Refuse(Bad, "Roughness must lie between 0 and 1, is 1.5");
	EXPECT_REFUSED(Renderer->SetSky(nullptr), "the sky's radiance");
	EXPECT_REFUSED(Renderer->SetObjectTransform(Object, nullptr), "transform");
}

TEST_F(FModuleSignalTest, ACutAndALostFrameEndTheHistory)
{
	FRTModuleFrame Frame = DescribeFrame();
	Frame.Wanted = {ESignal::AmbientOcclusion};
	RenderUntilComplete(Frame);
	const auto HasHistory = [&] { return Mock().CountCalls(ERTMockCall::BeginMarker, "CameraMotion") > 0; };
	Frame.Commands = DescribeFrame().Commands;
	RenderAndEnd(Frame);
	EXPECT_TRUE(HasHistory());
	Frame.Commands = DescribeFrame().Commands;
	Frame.bCut = true;
	RenderAndEnd(Frame);
	EXPECT_FALSE(HasHistory());
	Frame.Commands = DescribeFrame().Commands;
	Frame.bCut = false;
	RenderAndEnd(Frame);
	EXPECT_TRUE(HasHistory());
	Mock().FailEveryAllocation(1); // another size needs memory
	Depth = MakeTexture(ERTFormat::D32_FLOAT, 32);
	Normals = MakeTexture(ERTFormat::RGBA16_SNORM, 32);
	Frame = DescribeFrame();
	Frame.Wanted.Add(ESignal::AmbientOcclusion);
	EXPECT_FALSE(Renderer->RenderFrame(Frame, &Outputs).IsOk());
	Mock().FailEveryAllocation(0);
	Frame.Commands = DescribeFrame().Commands;
	RenderAndEnd(Frame);
	EXPECT_FALSE(HasHistory());
	EXPECT_EQ(Outputs.Get(ESignal::AmbientOcclusion)->GetDesc().Width, 32u);
}

} // namespace
} // namespace Lantern
