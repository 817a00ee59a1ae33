// Shadows in frames of engines with conventions of their own, against rays of double precision from the exact surfaces.
#include <filesystem>
#include <mutex>
#include <type_traits>

#include <vulkan/vulkan_core.h>

#include "EngineFixture.h"
#include "LanternRHIVulkan/VulkanDevice.h"
#include "Support/SharedFiles.h"
#include "Support/SynchronizationMessages.h"

namespace Lantern
{
namespace
{

TEST_F(FConventionTest, CourtyardIsLitWhereTheSunReachesIt)
{
	ASSERT_NO_FATAL_FAILURE(LoadSoup("courtyard"));
	ASSERT_NO_FATAL_FAILURE(Open());
	CheckTable(20000);
}

TEST_F(FConventionTest, SponzaIsLitWhereTheSunReachesIt)
{
	const std::filesystem::path Scene = GetSharedFolder() / "scenes/sponza/Sponza.gltf";
	if (!std::filesystem::exists(Scene)) { GTEST_SKIP() << "no shared scenes"; }
	ASSERT_NO_FATAL_FAILURE(LoadSoup(Scene.string()));
	Camera = {{0, 8, 0}, glm::normalize(glm::dvec3(-8, -7, 3)), {0, 1, 0}, 1.22};
	ASSERT_NO_FATAL_FAILURE(Open());
	CheckTable(10000);
}

TEST_F(FBoxesTest, EveryProjectionAndDepthFormat)
{
	ASSERT_NO_FATAL_FAILURE(Open());
	using enum ERTFormat;
	const FEngineConventions Rows[] = {
	    {.Name = "reversed, finite, y up", .Near = 0.1, .Far = 500, .Jitter = {0.3f, 0.4f}, .bClipYUp = true},
	    {.Name = "D24S8, near 0.1, far 1024", .DepthFormat = D24_UNORM_S8_UINT, .bReversed = false, .Near = 0.1, .Far = 1024},
	    {.Name = "D24S8, reversed and infinite", .DepthFormat = D24_UNORM_S8_UINT, .Near = 0.1},
	    {.Name = "D16, near 1, far 100", .DepthFormat = D16_UNORM, .bReversed = false, .Near = 1, .Far = 100},
	    {.Name = "D16, normals from the engine's one",
	        .DepthFormat = D16_UNORM,
	        .bReversed = false,
	        .Near = 1,
	        .Far = 100,
	        .Normals = EEngineNormals::View},
	    {.Name = "orthographic, D32S8", .DepthFormat = D32_FLOAT_S8_UINT, .bReversed = false, .Near = -5, .Far = 60, .bOrthographic = true},
	    {.Name = "orthographic, reversed, y up, jitter",
	        .Near = 1,
	        .Far = 60,
	        .Jitter = {0.45f, 0.2f},
	        .bClipYUp = true,
	        .bOrthographic = true}};
	for (const FEngineConventions& Row : Rows)
	{
		const FVerdict Verdict = RenderAndJudge(Row);
		EXPECT_GE(Verdict.Lit, 20000u) << Row.Name;
		EXPECT_LE(Verdict.GetDarkShare(), 0.0005) << Row.Name;
		// The price of 16 bits: what lies nearer to its blocker than depth can tell is lit.
		EXPECT_LE(Verdict.GetLitShare(), Row.DepthFormat == D16_UNORM ? 0.1 : 0.01) << Row.Name;
	}
}

// No ray of such a surface meets the surface itself, so that only its normal can say that it turns away from the sun.
TEST_F(FBoxesTest, SurfacesThatCastNoShadowTurnAwayFromTheSun)
{
	bCastsShadow = false;
	ASSERT_NO_FATAL_FAILURE(Open());
	for (const bool bViewNormals : {false, true})
	{
		const FVerdict Verdict = RenderAndJudge({.Name = bViewNormals ? "no shadows, geometric normals from depth" : "no shadows",
		    .DepthFormat = ERTFormat::D32_FLOAT_S8_UINT,
		    .bReversed = false,
		    .Near = 0.1,
		    .Far = 1024,
		    .Jitter = {0.3f, -0.2f},
		    .Normals = bViewNormals ? EEngineNormals::View : EEngineNormals::Native});
		EXPECT_GE(Verdict.Lit, 20000u);
		EXPECT_GE(Verdict.Pixels - Verdict.Lit, 1000u) << "the test could not fail";
		EXPECT_LE(Verdict.GetDarkShare(), 0.0005);
		// A strip that is one pixel wide has no neighbours that confirm its normal, so its rays are traced.
		EXPECT_LE(Verdict.GetLitShare(), bViewNormals ? 0.01 : 0.0005);
	}
}

// Directions, positions, transforms and the sun of an engine with other axes, mirrored, in centimetres.
TEST_F(FBoxesTest, UnrealsWorldIsTheSame)
{
	FEngineConventions As;
	As.Normals = EEngineNormals::View;
	ASSERT_NO_FATAL_FAILURE(Open());
	const std::vector<float> Own = RenderPicture(As);
	Renderer.Reset();
	const FRTModuleRendererDesc World = MakeUnrealWorld();
	ASSERT_NO_FATAL_FAILURE(Open(World));
	Raster->Change = [&](FRTModuleFrame& Frame) {
		const auto Turn = [&](auto& V, double Scale) {
			const glm::dvec3 Turned = ToEngine(World, glm::dvec3(V[0], V[1], V[2])) * Scale;
			for (int Axis = 0; Axis < 3; ++Axis) { V[Axis] = static_cast<std::remove_reference_t<decltype(V[0])>>(Turned[Axis]); }
		};
		Turn(Frame.View.Position, 1.0 / double(World.MetersPerUnit));
		Turn(Frame.View.Forward, 1.0);
		Turn(Frame.View.Up, 1.0);
		// View space in centimetres: the near plane is 100 times as far.
		Frame.View.Projection.ViewToClip[11] *= 100.0f;
	};
	const double Different = CountDifferent(RenderPicture(As), Own);
	std::printf("[  figure  ] pixels that differ in Unreal's world: %.4f %%\n", 100 * Different);
	EXPECT_LE(Different, 0.0005) << "rounding decides at the edges of shadows";
	Raster->Change = {};
	EXPECT_GT(CountDifferent(RenderPicture(As), Own), 0.01) << "the test could not fail";
}

// Dynamic resolution and split screen: the view is a part of larger textures.
TEST_F(FBoxesTest, PartOfLargerTexturesIsTheSame)
{
	ASSERT_NO_FATAL_FAILURE(Open());
	FEngineConventions As;
	const std::vector<float> Whole = RenderPicture(As);
	As.Offset = {37, 22};
	EXPECT_LE(CountDifferent(RenderPicture(As), Whole), 0.001) << "the raster's grid and rounding";
	As.DepthFormat = ERTFormat::D32_FLOAT_S8_UINT;
	As.Normals = EEngineNormals::View;
	EXPECT_LE(CountDifferent(RenderPicture(As), Whole), 0.002);
	Raster->Change = [](FRTModuleFrame& Frame) { Frame.OffsetX += 9; };
	EXPECT_GT(CountDifferent(RenderPicture(As), Whole), 0.01) << "the test could not fail";
}

/// With synchronization validation: what the plugin does between the engine's own uses of its textures is ordered.
class FSynchronizationTest : public FBoxesTest
{
protected:
	void TearDown() override
	{
		bCountsMessages = false;
		FBoxesTest::TearDown();
		EXPECT_EQ(Messages.Others, std::vector<std::string>());
	}
	std::mutex Mutex;
	FSynchronizationMessages Messages;

	FRTStatus OpenDevice() override
	{
		FRTVulkanDeviceDesc Desc;
		Desc.bValidation = Desc.bSynchronizationValidation = true;
		Desc.MessageUser = this;
		Desc.MessageCallback = [](void* User, ERTVulkanMessage Severity, const char* Text) {
			auto& Self = *static_cast<FSynchronizationTest*>(User);
			const std::lock_guard Lock(Self.Mutex);
			if (Severity != ERTVulkanMessage::Info) { Self.Messages.Add(Text); }
		};
		return CreateVulkanDevice(Desc, Device.ReleaseAndGetAddress());
	}
};

TEST_F(FSynchronizationTest, TexturesInTheEnginesOwnLayouts)
{
	ASSERT_NO_FATAL_FAILURE(Open());
	FEngineConventions As;
	const std::vector<float> Plain = RenderPicture(As);
	As.bExternal = true;
	EXPECT_EQ(CountDifferent(RenderPicture(As), Plain), 0.0);
	As.DepthFormat = ERTFormat::D32_FLOAT_S8_UINT;
	As.Normals = EEngineNormals::View;
	As.Offset = {8, 8};
	EXPECT_LE(CountDifferent(RenderPicture(As), Plain), 0.002);
	ASSERT_OK(Module->SetConsoleVariable("r.RT.Shadow.Soft", "1"));
	FRTModuleSun Soft;
	Soft.Direction[0] = 0.3;
	Soft.Irradiance = 1.0f;
	Soft.AngularDiameter = 0.1f;
	ASSERT_OK(Renderer->SetSun(Soft)); // filtered, with histories
	(void)RenderPicture(As);
}

TEST_F(FSynchronizationTest, ImpossibleStatesAreRefused)
{
	TRTRef<IRTTexture> Own, Imported;
	const FRTTextureDesc Desc{8, 8, 1, 1, ERTFormat::R32_FLOAT, ERTTextureUsage::Sampled, "Mine"};
	ASSERT_OK(Device->CreateTexture(Desc, Own.ReleaseAndGetAddress()));
	ASSERT_OK(Device->ImportTexture(Desc, Own->GetNative(ERTNative::Image), Imported.ReleaseAndGetAddress()));
	const FRTExternalState Good{VK_IMAGE_LAYOUT_GENERAL, VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT, VK_ACCESS_2_MEMORY_READ_BIT};
	const auto Expect = [&](IRTTexture& Texture, FRTExternalState From, FRTExternalState To, const char* Why) {
		const FRTStatus Status = Texture.SetExternalState(From, To);
		EXPECT_EQ(Status.Code, ERTResult::InvalidArgument);
		EXPECT_NE(std::string(Status.Message).find(Why), std::string::npos) << Status.Message;
	};
	Expect(*Own, Good, Good, "not imported");
	Expect(*Imported, {VK_IMAGE_LAYOUT_UNDEFINED, 1, 0}, Good, "From.Layout");
	Expect(*Imported, Good, {VK_IMAGE_LAYOUT_PREINITIALIZED, 1, 0}, "To.Layout");
	Expect(*Imported, {VK_IMAGE_LAYOUT_GENERAL, 0, 0}, Good, "Stages is 0");
	EXPECT_TRUE(Imported->SetExternalState(Good, Good).IsOk());
}

} // namespace
} // namespace Lantern
