// Signals of the module: what an engine asks for is made, and nothing else is.
#include <algorithm>
#include <limits>

#include "ModuleTestTools.h"

namespace Lantern
{
namespace
{

using ::testing::AnyOf;
using ::testing::Contains;
using ::testing::Each;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsSupersetOf;
using ::testing::Not;
using ::testing::StartsWith;

class FModuleSignalTest : public FModuleTest
{
protected:
	void SetUp() override
	{
		FModuleTest::SetUp();
		ASSERT_OK(AddObject(AddOpaqueMesh(), Solid));
		ASSERT_OK(SetSun(-1.0));
		Motion = MakeTexture(ERTFormat::RGBA32_FLOAT, 64);
		BaseColor = MakeTexture(ERTFormat::RGBA8_SRGB, 64);
		Material = MakeTexture(ERTFormat::RGBA8_UNORM, 64);
	}
	void TearDown() override
	{
		for (TRTRef<IRTTexture>* Texture : {&Motion, &BaseColor, &Material}) { Texture->Reset(); }
		FModuleTest::TearDown();
	}
	FRTModuleFrame DescribeAll()
	{
		FRTModuleFrame Frame = DescribeFrame();
		Frame.Motion = Motion.Get();
		Frame.BaseColor = BaseColor.Get();
		Frame.Material = Material.Get();
		Frame.Wanted = {ESignal::SunShadow, ESignal::AmbientOcclusion, ESignal::DiffuseGI, ESignal::Reflections};
		return Frame;
	}
	/// Calls are those of this frame.
	void RenderAndEnd(const FRTModuleFrame& Frame)
	{
		Precache(Frame);
		Mock().ClearCalls();
		ASSERT_OK(Renderer->RenderFrame(Frame, &Outputs));
		ASSERT_OK(Renderer->EndFrame(nullptr));
	}
	/// Frames until all that Frame asks for is there.
	void RenderUntilComplete(FRTModuleFrame Frame)
	{
		Outputs = {};
		const auto Step = [&] {
			Frame.Commands = DescribeFrame().Commands;
			RenderAndEnd(Frame);
			GiveWay();
		};
		ASSERT_TRUE(WaitUntil(
		    "a complete frame", [&] { return Outputs.bComplete; }, Step));
	}
	std::vector<std::string> GetPasses()
	{
		std::vector<std::string> Names;
		for (const FRTMockCall& Call : Mock().FindCalls(ERTMockCall::BeginMarker)) { Names.push_back(Call.Name); }
		return Names;
	}

	TRTRef<IRTTexture> Motion, BaseColor, Material;
};

TEST_F(FModuleSignalTest, GlassIsAnOutputOfItsOwn)
{
	FRTModuleFrame Frame = DescribeFrame();
	Frame.Wanted = {};
	Frame.bTransmission = true;
	RenderUntilComplete(Frame);
	EXPECT_EQ(Outputs.Transmission.Light, nullptr) << "light shines through nothing";
	EXPECT_THAT(GetPasses(), Not(Contains(StartsWith("Transmission"))));
	FRTModuleMaterial Glass;
	Glass.Transmission = 1.0f;
	ERTMaterialHandle Handle{};
	ASSERT_OK(Renderer->AddMaterial(Glass, &Handle));
	ASSERT_OK(AddObject(AddOpaqueMesh(), Handle));
	RenderUntilComplete(Frame);
	ASSERT_NE(Outputs.Transmission.Light, nullptr);
	ASSERT_NE(Outputs.Transmission.Transmittance, nullptr);
	ASSERT_NE(Outputs.Transmission.Looks, nullptr);
	EXPECT_EQ(Outputs.Transmission.Light->GetDesc().Format, ERTFormat::RGBA16_FLOAT);
	EXPECT_EQ(Outputs.Transmission.Transmittance->GetDesc().Format, ERTFormat::RGBA8_UNORM);
	EXPECT_EQ(Outputs.Transmission.Looks->GetDesc().Format, ERTFormat::RGBA32_UINT);
	EXPECT_EQ(Outputs.Transmission.Looks->GetDesc().Width, 64u);
	Frame.bTransmission = false;
	RenderUntilComplete(Frame);
	EXPECT_EQ(Outputs.Transmission.Light, nullptr) << "nobody asks";
	Frame.bTransmission = true;
	Glass.Transmission = 0.0f;
	ASSERT_OK(Renderer->SetMaterial(Handle, Glass));
	RenderUntilComplete(Frame);
	EXPECT_EQ(Outputs.Transmission.Light, nullptr) << "the glass has become opaque";
}

TEST_F(FModuleSignalTest, FogIsAnOutputOfItsOwn)
{
	FRTModuleFrame Frame = DescribeFrame();
	Frame.Wanted = {};
	RenderUntilComplete(Frame);
	EXPECT_EQ(Outputs.Fog.Visibility, nullptr) << "nobody asks";
	EXPECT_EQ(Outputs.Fog.ColumnCount, 0u);
	EXPECT_THAT(GetPasses(), Not(Contains(StartsWith("Fog"))));
	Frame.bFog = true;
	Frame.FogPhase = 0.5f;
	RenderUntilComplete(Frame);
	ASSERT_NE(Outputs.Fog.Visibility, nullptr);
	EXPECT_EQ(Outputs.Fog.Light, nullptr) << "there are no lamps";
	EXPECT_EQ(Outputs.Fog.Visibility->GetDesc().Format, ERTFormat::R8_UNORM);
	EXPECT_EQ(Outputs.Fog.Visibility->GetDesc().Width, Outputs.Fog.ColumnCount * Outputs.Fog.SlicesPerRow);
	EXPECT_EQ(Outputs.Fog.Visibility->GetDesc().Height, Outputs.Fog.RowCount * (Outputs.Fog.SliceCount / Outputs.Fog.SlicesPerRow));
	EXPECT_EQ(Outputs.Fog.ColumnCount, (64 + Outputs.Fog.PixelSize - 1) / Outputs.Fog.PixelSize);
	EXPECT_GT(Outputs.Fog.Distance, 0.0f);
	FRTModuleLight Lamp;
	Lamp.Color[0] = 1.0f;
	ERTLightHandle Handle{};
	ASSERT_OK(Renderer->AddLight(Lamp, &Handle));
	ASSERT_TRUE(WaitUntil(
	    "light in fog", [&] { return Outputs.Fog.Light != nullptr; }, [&] { RenderUntilComplete(Frame); }));
	EXPECT_EQ(Outputs.Fog.Light->GetDesc().Format, ERTFormat::RGBA16_FLOAT);
	Frame = DescribeFrame();
	for (const float Bad : {1.0f, -1.0f, std::numeric_limits<float>::quiet_NaN()})
	{
		Frame.FogPhase = Bad;
		const FRTStatus Status = Renderer->RenderFrame(Frame, &Outputs);
		EXPECT_EQ(Status.Code, ERTResult::InvalidArgument);
		EXPECT_THAT(Status.Message, HasSubstr("FRTModuleFrame::FogPhase"));
	}
}

TEST_F(FModuleSignalTest, TheLightMaskIsAnOutputOfItsOwn)
{
	FRTModuleLight Lamp;
	Lamp.Color[0] = 1.0f;
	ERTLightHandle Handle{};
	ASSERT_OK(Renderer->AddLight(Lamp, &Handle));
	FRTModuleFrame Frame = DescribeFrame(); // without base colours
	Frame.Wanted = {};
	RenderUntilComplete(Frame);
	EXPECT_EQ(Outputs.LightMask.Visibility, nullptr) << "nobody asks";
	EXPECT_EQ(Outputs.LightMask.Lights, nullptr);
	EXPECT_THAT(GetPasses(), Not(Contains(HasSubstr("Mask"))));
	Frame.bLightMask = true;
	RenderUntilComplete(Frame);
	ASSERT_NE(Outputs.LightMask.Visibility, nullptr);
	ASSERT_NE(Outputs.LightMask.Lights, nullptr);
	EXPECT_EQ(Outputs.LightMask.Visibility->GetDesc().Format, ERTFormat::R32_UINT);
	EXPECT_EQ(Outputs.LightMask.Visibility->GetDesc().Width, 64u);
	EXPECT_EQ(Outputs.LightMask.Lights->GetDesc().Format, ERTFormat::R32_UINT);
	EXPECT_EQ(Outputs.LightMask.Lights->GetDesc().Width, 64u);
	EXPECT_EQ(Outputs.LightMask.Lights->GetDesc().Height, (Outputs.LightMask.Visibility->GetDesc().Height + 7) / 8);
	EXPECT_EQ(Outputs.Get(ESignal::LocalDiffuse), nullptr) << "nobody asks for it";
	EXPECT_THAT(GetPasses(), Contains("ShadowLightsMask"));
	ASSERT_OK(Renderer->RemoveLight(Handle));
	RenderUntilComplete(Frame);
	EXPECT_EQ(Outputs.LightMask.Visibility, nullptr) << "there are no lamps";
}

TEST_F(FModuleSignalTest, TheLightMaskAndTheRestComeTogether)
{
	FRTModuleLight Lamp;
	std::vector<ERTLightHandle> Handles(12);
	for (ERTLightHandle& Handle : Handles) { ASSERT_OK(Renderer->AddLight(Lamp, &Handle)); }
	FRTModuleFrame Frame = DescribeAll();
	Frame.Wanted = {ESignal::LocalDiffuse, ESignal::LocalSpecular};
	Frame.bLightMask = true;
	const auto Step = [&] {
		Frame.Commands = DescribeFrame().Commands;
		ASSERT_OK(Renderer->RenderFrame(Frame, &Outputs));
		ASSERT_OK(Renderer->EndFrame(nullptr));
		const bool bMask = Outputs.LightMask.Visibility != nullptr;
		EXPECT_EQ(Outputs.Get(ESignal::LocalDiffuse) != nullptr, bMask) << "else light is missing, or counted twice";
		EXPECT_EQ(Outputs.Get(ESignal::LocalSpecular) != nullptr, bMask);
	};
	ASSERT_TRUE(WaitUntil(
	    "a complete frame", [&] { return Outputs.bComplete; }, Step));
	EXPECT_NE(Outputs.LightMask.Visibility, nullptr);
}

// Lower bits serve as an index, and upper ones tell a light from one before it.
TEST_F(FModuleSignalTest, LightNumbersAreSmallAndNotUsedTwice)
{
	FRTModuleLight Lamp;
	std::vector<uint32_t> Numbers;
	ERTLightHandle Handle{};
	for (int I = 0; I < 3; ++I)
	{
		ASSERT_OK(Renderer->AddLight(Lamp, &Handle));
		Numbers.push_back(GetLightNumber(Handle));
	}
	EXPECT_EQ(GetLightNumber(ERTLightHandle::None), 0u);
	EXPECT_EQ(Numbers, (std::vector<uint32_t>{1, 2, 3}));
	ASSERT_OK(Renderer->RemoveLight(Handle));
	ASSERT_OK(Renderer->AddLight(Lamp, &Handle));
	EXPECT_EQ(GetLightNumber(Handle), 3u | 1u << 24);
}

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
