// "Model no more than the scene needs": a frame of a scene that lacks something holds no pass, pipeline, buffer or
// dispatch for it.
#include "LanternHost/ReferenceRenderer.h"
#include "LanternRenderer/Frame.h"
#include "Support/MockReads.h"
#include "Support/RendererTestTools.h"

namespace Lantern
{
namespace
{

using ::testing::AllOf;
using ::testing::Contains;
using ::testing::Each;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

class FRendererContentTest : public FRendererTest
{
protected:
	uint32_t Count(ERTMockCall Kind) { return Mock().CountCalls(Kind); }
	std::vector<std::string> GetDispatched()
	{
		std::vector<std::string> Names;
		for (const FRTMockCall& Call : Mock().GetCalls())
		{
			if (Call.Kind == ERTMockCall::Dispatch || Call.Kind == ERTMockCall::DispatchIndirect) { Names.push_back(Call.Name); }
		}
		return Names;
	}
	FRTStatus RenderReferenceOnce(uint32_t Samples = 1)
	{
		FReferenceSettings Settings;
		Settings.View = LookAt({0, 0, 5}, {0, 0, 0}, 1.0f, 16, 8);
		Settings.Samples = Samples;
		FReferenceResult Result;
		Mock().ClearCalls();
		const FRTStatus Status = RenderReference(*Engine, Settings, Result);
		EXPECT_TRUE(!Status || Result.Radiance.Width == 16);
		return Status;
	}
};

TEST_F(FRendererContentTest, EverythingAtOnce)
{
	LoadAndRender({.bMasked = true, .bSkinned = true, .bLights = true, .bTexture = true, .bEmissive = true, .bSky = true});
	EXPECT_THAT(GetPasses(),
	    ElementsAre("Skinning", "SceneUpdate", "EmissiveTriangles", "GBuffer", "Structures", "ShadowTiles", "ShadowQueue", "ShadowEmitters",
	        "ShadowChoosers", "ShadowLights", "ShadowChoosersOrder", "ShadowLightsChoose", "ShadowLightsShare", "ShadowDemand",
	        "ShadowRays", "Surface", "ShadowMoreAsk", "ShadowMoreQueue", "ShadowMoreRays", "SunShadow", "SunShadowTemporal",
	        "SunShadowFilter0", "SunShadowFilter1", "ShadowLightsShade", "ChangedLamps", "ChangedEmitters", "LocalDiffuseTemporal",
	        "LocalDiffuseFilter0", "LocalDiffuseFilter1", "LocalSpecularTemporal", "LocalSpecularFilter0", "LocalSpecularFilter1",
	        "AmbientOcclusion", "AmbientOcclusionTemporal", "AmbientOcclusionFilter0", "AmbientOcclusionFilter1", "AmbientOcclusionFilter2",
	        "AmbientOcclusionFilter3", "DirectLighting", "ToneMap"));
	std::vector<std::string> Dispatched = GetDispatched();
	std::erase_if(Dispatched, [](const std::string& Name) { return Name.rfind("Denoise/", 0) == 0; });
	EXPECT_THAT(Dispatched,
	    ElementsAre("Skinning/Skin.comp", "Skinning/RefitQuality.comp", "Lights/EmissiveTriangles.comp", "Lights/EmissivePowers.comp",
	        "Tiles/Tiles.comp", "Tiles/QueueSun.comp", "LocalLights/EmitterClusters.comp",
	        "LocalLights/Requests.comp HAS_LIGHTS MANY_LIGHTS LOCAL_EMISSIVE GUIDED HAS_MASKED LISTS_CHOOSERS", "Rays/OrderThreads.comp",
	        "LocalLights/Choose.comp HAS_LIGHTS MANY_LIGHTS LOCAL_EMISSIVE GUIDED HAS_MASKED", "LocalLights/ShareRequests.comp",
	        AllOf(StartsWith("Rays/ShadowQueue.comp"), HasSubstr("HAS_MASKED")), "Tiles/MoreRays.comp", "Tiles/QueueSun.comp",
	        AllOf(StartsWith("Rays/ShadowQueue.comp"), HasSubstr("HAS_MASKED")), "SunShadow/SunShadow.comp",
	        "LocalLights/Shade.comp HAS_LIGHTS MANY_LIGHTS LOCAL_EMISSIVE GUIDED HAS_MASKED", "LocalLights/ListEmitters.comp",
	        AllOf(StartsWith("AmbientOcclusion/AmbientOcclusion.comp"), HasSubstr("HAS_MASKED")),
	        "Lighting/DirectLighting.comp HAS_SUN HAS_SKY HAS_LIGHTS LOCAL_EMISSIVE", "ToneMap/ToneMap.comp"));
	EXPECT_EQ(Count(ERTMockCall::DrawIndexed), 4u);
	EXPECT_EQ(Count(ERTMockCall::BuildGeometry), 4u);
	EXPECT_THAT(Mock().GetCreatedBuffers(), Contains("Lights"));
}

TEST_F(FRendererContentTest, SecondFrameOfAStaticSceneCopiesAndBuildsNothing)
{
	LoadAndRender({.bMasked = true, .bSkinned = true, .bLights = true, .bSky = true});
	for (int Frame = 0; Frame < 8; ++Frame) { Render(); } // what was built is compacted
	EXPECT_THAT(GetPassesWithoutFilters(), ElementsAre("GBuffer", "ShadowTiles", "ShadowQueue", "ShadowLights", "ShadowRays", "SunShadow",
	                                           "ShadowLightsShade", "AmbientOcclusion", "DirectLighting", "ToneMap"));
	for (const ERTMockCall Kind : {ERTMockCall::CopyBuffer, ERTMockCall::BuildGeometry, ERTMockCall::BuildScene, ERTMockCall::CreateTexture,
	         ERTMockCall::CreateComputePipeline})
	{
		EXPECT_EQ(Count(Kind), 0u) << static_cast<int>(Kind);
	}
	EXPECT_THAT(Mock().GetCreatedBuffers(), Each("Capture"));
}

TEST_F(FRendererContentTest, WithoutAlphaTestsThereIsNoAnyHit)
{
	Set("r.RT.Shadow.Denoise", "0"); // which wants to know how far off what blocks is
	Set("r.RT.Shadow.Path", "1");
	LoadAndRender({});
	ASSERT_TRUE(GetRTPSO());
	EXPECT_EQ(GetRTPSO()->GetHitGroupCount(), 1u);
	uint64_t Shaders = 0;
	for (const FRTMockCall& Call : Mock().FindCalls(ERTMockCall::CreateRayTracingPipeline)) { Shaders += Call.Numbers[0]; }
	EXPECT_EQ(Shaders, 2u) << "ray generation and miss";
	EXPECT_EQ(Resolve(0, 0).AnyHit, "");
	EXPECT_THAT(Mock().GetCreatedPipelines(), Not(Contains("GBufferMasked")));
	Set("r.RT.Shadow.Path", "2");
	Render();
	EXPECT_THAT(GetDispatched(), Contains(StartsWith("Rays/ShadowQueue.comp")));
	EXPECT_THAT(GetDispatched(), Not(Contains(HasSubstr("HAS_MASKED"))));

	Set("r.RT.Shadow.Path", "1");
	LoadAndRender({.bMasked = true});
	EXPECT_EQ(GetRTPSO()->GetHitGroupCount(), 2u);
	EXPECT_EQ(Resolve(0, 0).AnyHit, "") << "an opaque object beside a masked one";
	EXPECT_EQ(Resolve(1, 0).AnyHit, "Rays/AlphaTest.rahit");
	EXPECT_THAT(Mock().GetCreatedPipelines(), Contains("GBufferMasked"));
}

TEST_F(FRendererContentTest, WithoutTheReferenceThereIsNoClosestHitAndNoMaterialRay)
{
	Set("r.RT.Shadow.Denoise", "0"); // which wants to know how far off what blocks is
	Set("r.RT.Shadow.Path", "1");
	LoadAndRender({.bMasked = true});
	EXPECT_EQ(GetRTPSO()->GetRayTypeCount(), 1u);
	EXPECT_EQ(Resolve(1, 0).ClosestHit, "");
	EXPECT_LE(Mock().FindCalls(ERTMockCall::CreateRayTracingPipeline).at(0).Numbers[3], 4u) << "payload bytes";
	ASSERT_TRUE(RenderReferenceOnce());
	EXPECT_EQ(GetRTPSO()->GetRayTypeCount(), 2u);
	EXPECT_EQ(Resolve(1, 0).ClosestHit, "");
	EXPECT_EQ(Resolve(1, 1).ClosestHit, "Rays/Material.rchit");
	EXPECT_EQ(Resolve(0, 1).AnyHit, "");
	EXPECT_LE(Mock().FindCalls(ERTMockCall::CreateRayTracingPipeline).at(0).Numbers[3], 36u) << "payload bytes";
	Render();
	EXPECT_EQ(GetRTPSO()->GetRayTypeCount(), 1u);
	EXPECT_TRUE(Resolve(1, 0).IsGood()) << Resolve(1, 0).Error;
	EXPECT_EQ(Resolve(1, 0).AnyHit, "Rays/AlphaTest.rahit");
}

// The program of a material is not compiled for light that is only received.
TEST_F(FRendererContentTest, IndirectLightNeedsNoProgram)
{
	Set("r.RT.GI", "3");
	Set("r.RT.GI.Path", "1");
	Set("r.RT.Shadow.Denoise", "0");
	ASSERT_TRUE(Load({.bMasked = true, .bSky = true}));
	const char* const Text = "#include \"Materials/Standard.glsl\"\n#define MATERIAL_STANDARD_OPACITY\n"
	                         "FMaterialSurface EvaluateMaterial(FMaterialData M, FMaterialInputs I, uint Override)\n"
	                         "{ return EvaluateStandard(M, I, Override); }\n";
	Engine->GetScene().GetScene().SetMaterialProgram(0, Engine->GetRenderer().GetPrograms().Add({.Name = "Paint", .Text = Text}));
	ASSERT_TRUE(RenderFrame());
	ASSERT_TRUE(GetRTPSO());
	EXPECT_EQ(GetRTPSO()->GetRayTypeCount(), 2u) << "shadow rays, and those of light";
	EXPECT_EQ(Resolve(0, 1).ClosestHit, "Rays/Material.rchit");
	EXPECT_THAT(Mock().GetCreatedPipelines(), Not(Contains(HasSubstr("Paint"))));
	Set("r.RT.Reflections", "1");
	Set("r.RT.Reflections.Path", "1");
	ASSERT_TRUE(RenderFrame());
	EXPECT_EQ(GetRTPSO()->GetRayTypeCount(), 3u) << "mirrors show programs";
	EXPECT_EQ(Resolve(0, 1).ClosestHit, "Rays/Material.rchit (Paint)");
	EXPECT_EQ(Resolve(0, 2).ClosestHit, "Rays/Material.rchit");
	Set("r.RT.GI.Materials", "1");
	ASSERT_TRUE(RenderFrame());
	EXPECT_EQ(GetRTPSO()->GetRayTypeCount(), 2u) << "all rays run them";
	EXPECT_EQ(Resolve(0, 1).ClosestHit, "Rays/Material.rchit (Paint)");
}

TEST_F(FRendererContentTest, WithoutSkinningThereIsNoSkinningPass)
{
	LoadAndRender({});
	EXPECT_FALSE(HasPass("Skinning"));
	EXPECT_THAT(Mock().GetCreatedPipelines(), Not(Contains(HasSubstr("Skin"))));
	EXPECT_EQ(Mock().FindCalls(ERTMockCall::BuildGeometry).at(0).Numbers[1], 0u);
	LoadAndRender({.bSkinned = true});
	EXPECT_TRUE(HasPass("Skinning"));
	Render();
	EXPECT_FALSE(HasPass("Skinning")) << "the pose has not changed";
	Render(0.5);
	EXPECT_TRUE(HasPass("Skinning"));
	EXPECT_EQ(Count(ERTMockCall::BuildGeometry), 1u) << "of two geometries one is deformed";
	EXPECT_EQ(Mock().FindCalls(ERTMockCall::BuildGeometry).at(0).Numbers[1], 1u) << "a refit";
}

TEST_F(FRendererContentTest, WithoutLightsThereIsNoLightBuffer)
{
	LoadAndRender({.bSky = true});
	EXPECT_THAT(Mock().GetCreatedBuffers(), Not(Contains("Lights")));
	EXPECT_THAT(GetDispatched(), Contains("Lighting/DirectLighting.comp HAS_SUN HAS_SKY"));
	EXPECT_EQ(Engine->GetScene().GetScene().GetConstants().Lights, 0u);
}

TEST_F(FRendererContentTest, WithoutASunNoRayIsTraced)
{
	Set("r.RT.Shadow.Path", "1");
	Set("r.RT.AO", "0"); // has rays of its own where there is a sky
	Set("r.RT.Shadow.MoreRays", "0");
	LoadAndRender({.bMasked = true, .bSun = false, .bSky = true});
	EXPECT_THAT(GetPasses(), ElementsAre("SceneUpdate", "GBuffer", "DirectLighting", "ToneMap"));
	EXPECT_THAT(GetDispatched(), Contains("Lighting/DirectLighting.comp HAS_SKY"));
	EXPECT_EQ(GetRTPSO(), nullptr);
	EXPECT_TRUE(Captured.Get(ESignal::SunShadow).IsEmpty());
	for (const ERTMockCall Kind : {ERTMockCall::CreateRayTracingPipeline, ERTMockCall::CreateShaderTable, ERTMockCall::CreateGeometry,
	         ERTMockCall::CreateScene, ERTMockCall::BuildScene})
	{
		EXPECT_EQ(Count(Kind), 0u) << static_cast<int>(Kind);
		for (const FRTMockCall& Call : LoadCalls) { EXPECT_NE(Call.Kind, Kind) << "while loading"; }
	}
	EXPECT_THAT(Mock().GetCreatedTextures(), Not(Contains("SunShadowVisibility")));
	ApplySky({.bSun = true, .bSky = true});
	Render();
	EXPECT_THAT(GetPassesWithoutFilters(), ElementsAre("GBuffer", "Structures", "ShaderTable", "ShadowTiles", "ShadowQueue", "ShadowRays",
	                                           "SunShadow", "DirectLighting", "ToneMap"));
	EXPECT_EQ(Count(ERTMockCall::BuildGeometry), 2u);
	EXPECT_EQ(Count(ERTMockCall::TraceRaysIndirect), 1u);
}

TEST_F(FRendererContentTest, WithoutASkyItIsNotEvaluated)
{
	LoadAndRender({});
	EXPECT_THAT(GetDispatched(), Contains("Lighting/DirectLighting.comp HAS_SUN"));
}

TEST_F(FRendererContentTest, EmptySceneIsACorrectEmptyFrame)
{
	for (const bool bSun : {true, false})
	{
		LoadAndRender({.bObjects = false, .bSun = bSun, .bSky = true});
		EXPECT_EQ(Count(ERTMockCall::DrawIndexed), 0u);
		EXPECT_TRUE(HasPass("GBuffer")) << "the targets are cleared";
		EXPECT_EQ(Count(ERTMockCall::BeginRasterPass), 1u);
		EXPECT_EQ(Count(ERTMockCall::BuildScene), bSun ? 1u : 0u);
		EXPECT_EQ(Captured.Get(ESignal::SunShadow).IsEmpty(), !bSun);
		Render();
		ASSERT_TRUE(RenderReferenceOnce());
	}
}

TEST_F(FRendererContentTest, NothingInViewDrawsNothing)
{
	LoadAndRender({});
	FFrameCapture Capture;
	Capture.bDisplay = true;
	Mock().ClearCalls();
	const FView Away = LookAt({0, 0, 5}, {0, 0, 10}, 1.0f, 32, 32);
	ASSERT_TRUE(Engine->RenderFrame(Away, 0.0, Capture, &Captured));
	EXPECT_EQ(Captured.Display.Width, 32u);
	EXPECT_EQ(Count(ERTMockCall::DrawIndexed), 0u);
	EXPECT_TRUE(HasPass("SunShadow")) << "what is out of view still casts shadows";
}

TEST_F(FRendererContentTest, PassesThatNobodyReadsAreCulled)
{
	LoadAndRender({});
	for (int Frame = 0; Frame < 8; ++Frame) { Render(); } // what was built is compacted
	Mock().ClearCalls();
	ASSERT_TRUE(Engine->RenderFrame(LookAt({0, 0, 5}, {0, 0, 0}, 1.0f, 40, 24), 0.0, {}, nullptr));
	EXPECT_THAT(GetPasses(), ElementsAre()) << "no output was wanted";
	FFrameCapture Capture;
	Capture.Signals.Add(ESignal::SunShadow);
	Mock().ClearCalls();
	ASSERT_TRUE(Engine->RenderFrame(LookAt({0, 0, 5}, {0, 0, 0}, 1.0f, 40, 24), 0.0, Capture, &Captured));
	EXPECT_THAT(
	    GetPasses(), ElementsAre("GBuffer", "ShadowTiles", "ShadowQueue", "ShadowRays", "Surface", "ShadowMoreAsk", "ShadowMoreQueue",
	                     "ShadowMoreRays", "SunShadow", "SunShadowTemporal", "SunShadowFilter0", "SunShadowFilter1"))
	    << "a host that lights by itself";
}

TEST_F(FRendererContentTest, WhatIsCarriedOverOutlivesAnothersFrames)
{
	LoadAndRender({});
	bool bHasPrevious = false;
	Engine->ExtraPasses = [&](FFrameContext& Context, const FGBuffer&, const FFrameOutputs&) {
		bHasPrevious = Context.PreviousView != nullptr;
	};
	Render();
	EXPECT_TRUE(bHasPrevious);
	FRendererDesc Desc;
	Desc.ShaderFolders = {GetShaderFolder()};
	Desc.CacheFolder = LANTERN_TEST_CACHE;
	FRenderer Other(*Device, Desc);
	const auto ShowByOther = [&](bool bSubmit) {
		FConsoleVariables::Get().BeginFrame();
		const FRTStatus Status = Other.BeginFrame(Engine->GetScene().GetScene(), LookAt({0, 0, 9}, {0, 0, 0}, 1.0f, 40, 24), {});
		ASSERT_TRUE(Status) << Status.Message;
		if (!bSubmit) { return Other.FrameSubmitted(0); }
		ASSERT_TRUE(Other.EndFrame(nullptr));
		ASSERT_TRUE(Other.WaitForAll());
	};
	const auto Move = [&] {
		const glm::dmat4 Transform = Engine->GetScene().GetScene().FindObject(0)->Transform;
		Engine->GetScene().SetTransform(0, glm::translate(Transform, glm::dvec3(0.1, 0.0, 0.0)));
	};
	ShowByOther(true);
	Render();
	EXPECT_TRUE(bHasPrevious) << "nothing moved in the frame between";
	Move();
	Render();
	EXPECT_TRUE(bHasPrevious) << "what moves in its own frames does no harm";
	Move();
	ShowByOther(true);
	Render();
	EXPECT_TRUE(bHasPrevious) << "motions lead back to its own last frame";
	Move();
	ShowByOther(false);
	Render();
	EXPECT_TRUE(bHasPrevious) << "a lost frame has shown nothing";
}

// Each view over a scene has the frame before of its own, also if the other views' frames lie in between.
TEST_F(FRendererContentTest, ViewsTakeTurnsAndKeepWhatIsTheirs)
{
	LoadAndRender({});
	FRendererDesc Desc;
	Desc.ShaderFolders = {GetShaderFolder()};
	Desc.CacheFolder = LANTERN_TEST_CACHE;
	FRenderer Host(*Device, Desc);
	const auto Show = [&](uint32_t ViewIndex, double X, std::optional<FView> Previous = {}) {
		FFrameFeatures Features;
		Features.bMotion = false;
		Features.ViewIndex = ViewIndex;
		Features.PreviousView = Previous;
		FConsoleVariables::Get().BeginFrame();
		const FRTStatus Status = Host.BeginFrame(Engine->GetScene().GetScene(), LookAt({X, 0, 9}, {X, 0, 0}, 1.0f, 40, 24), Features);
		EXPECT_TRUE(Status) << Status.Message;
		const FView* const Before = Host.GetContext().PreviousView;
		const double Found = Before ? Before->Position.x : -1.0;
		EXPECT_TRUE(Host.EndFrame(nullptr));
		return Found;
	};
	EXPECT_EQ(Show(0, 1.0), -1.0);
	EXPECT_EQ(Show(7, 2.0), -1.0) << "the other view's";
	EXPECT_EQ(Show(0, 3.0), 1.0);
	EXPECT_EQ(Show(7, 4.0), 2.0);
	EXPECT_EQ(Show(7, 5.0, LookAt({40, 0, 9}, {40, 0, 0}, 1.0f, 40, 24)), 40.0) << "the host's own word";
	for (int Frame = 0; Frame < 70; ++Frame) { (void)Show(7, 6.0); }
	EXPECT_EQ(Show(0, 8.0), -1.0) << "too long ago";
	EXPECT_TRUE(Host.WaitForAll());
}

// Frame numbers count those of all views. Samplers of two views in turn would know half of their numbers, and pixels no turn.
TEST_F(FRendererContentTest, ShadersCountTheFramesOfTheirView)
{
	LoadAndRender({});
	FRendererDesc Desc;
	Desc.ShaderFolders = {GetShaderFolder()};
	Desc.CacheFolder = LANTERN_TEST_CACHE;
	FRenderer Host(*Device, Desc);
	const auto Show = [&](uint32_t ViewIndex, uint32_t FrameIndex) {
		FFrameFeatures Features;
		Features.bMotion = false;
		Features.ViewIndex = ViewIndex;
		FView View = LookAt({0, 0, 9}, {0, 0, 0}, 1.0f, 40, 24);
		View.FrameIndex = FrameIndex;
		FConsoleVariables::Get().BeginFrame();
		EXPECT_TRUE(Host.BeginFrame(Engine->GetScene().GetScene(), View, Features));
		const FAddress Constants = Host.GetContext().Pass.View;
		EXPECT_TRUE(Host.EndFrame(nullptr));
		return ReadMockEntry<FViewConstants>(Mock(), Constants, 0).FrameIndex;
	};
	std::vector<uint32_t> Left, Right;
	for (uint32_t Frame = 10; Frame < 18; Frame += 2)
	{
		Left.push_back(Show(0, Frame));
		Right.push_back(Show(3, Frame + 1));
	}
	EXPECT_EQ(Left, (std::vector<uint32_t>{10, 11, 12, 13}));
	EXPECT_EQ(Right, (std::vector<uint32_t>{11, 12, 13, 14}));
	EXPECT_EQ(Show(0, 18), 14u);
	EXPECT_EQ(Show(0, 19), 15u);
	EXPECT_EQ(Show(0, 5), 5u) << "a caller that starts again gets the same numbers again";
	EXPECT_TRUE(Host.WaitForAll());
}

// What one emitter of many costs that moves: a work group for its cluster, and the sum over all.
TEST_F(FRendererContentTest, MovedEmittersAreFoundAnewAlone)
{
	constexpr uint32_t Panels = 40;
	FSceneDescription Scene = MakeDescription({.bEmissive = true});
	for (uint32_t I = 1; I < Panels; ++I) { Scene.Nodes.push_back(Scene.Nodes.back()); }
	ASSERT_TRUE(Engine->Load(std::move(Scene)));
	const auto CountGroups = [&] {
		Mock().ClearCalls();
		Render();
		uint64_t Groups = 0;
		for (const FRTMockCall& Call : Mock().FindDispatches("Lights/EmissiveTriangles.comp")) { Groups += Call.Numbers[0]; }
		return Groups;
	};
	EXPECT_EQ(CountGroups(), Panels);
	EXPECT_EQ(CountGroups(), 0u);
	Engine->GetScene().SetTransform(7, glm::dmat4(2.0));
	EXPECT_EQ(CountGroups(), 1u);
	EXPECT_LE(
	    Engine->GetScene().GetScene().GetStats().BytesCopied, FGpuTableBase::ChunkEntries * sizeof(FObjectData) + sizeof(FObjectMotion));
	EXPECT_EQ(CountGroups(), 0u);
}

TEST_F(FRendererContentTest, ReferenceKeepsEmittersAndFactsOfItsScene)
{
	Set("r.RT.Lights.Emissive", "0"); // frames would list them as well
	LoadAndRender({.bEmissive = true});
	EXPECT_EQ(Engine->GetScene().GetScene().GetConstants().EmissiveTriangleCount, 0u);
	ASSERT_TRUE(RenderReferenceOnce(2));
	EXPECT_EQ(Engine->GetScene().GetScene().GetConstants().EmissiveTriangleCount, 2u);
	EXPECT_THAT(Mock().GetCreatedBuffers(), Contains("EmissiveTriangles"));
	EXPECT_THAT(GetDispatched(), ElementsAre("Lights/EmissiveTriangles.comp", "Lights/EmissivePowers.comp"))
	    << "once, and no real-time pass runs";
	ASSERT_TRUE(Load({}));
	ASSERT_TRUE(RenderReferenceOnce());
	EXPECT_THAT(Mock().GetCreatedBuffers(), Not(Contains("EmissiveTriangles")));
}

TEST_F(FRendererContentTest, ReferenceNeedsPipelinesAndSaysSo)
{
	FRTMockDesc Desc;
	Desc.Rung = ERTRung::RayQuery;
	Open(Desc);
	ASSERT_TRUE(Load({}));
	const FRTStatus Status = RenderReferenceOnce();
	EXPECT_EQ(Status.Code, ERTResult::Unsupported);
	EXPECT_THAT(std::string(Status.Message), HasSubstr("ray-tracing pipelines"));
	Render();
	EXPECT_TRUE(HasPass("SunShadow")) << "ray queries go on";
}

TEST_F(FRendererContentTest, LadderChoosesThePathAndTheLastRungGoesWithout)
{
	struct FRung
	{
		ERTRung Rung;
		bool bRayQuery;
		uint32_t Traces, Passes;
	};
	for (const FRung& Case : {FRung{ERTRung::Pipeline, true, 0, 1}, FRung{ERTRung::Pipeline, false, 1, 1},
	         FRung{ERTRung::RayQuery, true, 0, 1}, FRung{ERTRung::None, false, 0, 0}})
	{
		FRTMockDesc Desc;
		Desc.Rung = Case.Rung;
		Desc.bRayQuery = Case.bRayQuery;
		Open(Desc);
		for (const char* Path : {"0", "1", "2"})
		{
			Set("r.RT.Shadow.Path", Path);
			Set("r.RT.Shadow.MoreRays", "0");
			LoadAndRender({.bMasked = true});
			EXPECT_EQ(HasPass("SunShadow"), Case.Passes > 0);
			const bool bWanted = Path[0] == '1' && Case.Rung >= ERTRung::Pipeline;
			EXPECT_EQ(Count(ERTMockCall::TraceRaysIndirect), bWanted ? 1u : Case.Traces);
			EXPECT_EQ(Count(ERTMockCall::TraceRaysIndirect) + Count(ERTMockCall::DispatchIndirect), Case.Passes);
		}
	}
}

} // namespace
} // namespace Lantern
