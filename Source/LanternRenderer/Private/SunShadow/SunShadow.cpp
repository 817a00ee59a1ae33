// Ray-traced sun shadows: for every pixel, the fraction of the sun's disk that it sees.
#include "SunShadow/SunShadow.h"
#include "Denoise/Denoise.h"
#include "LanternCore/Config/ConsoleVariables.h"
#include "LanternCore/Text/Log.h"
#include "LanternRenderer/AnyHitCounter.h"
#include "LanternRenderer/Frame.h"
#include "PassTools.h"
#include "RayPrograms.h"
#include "SunShadowTypes.h"

namespace Lantern
{

namespace
{
TRTConsoleVariable<bool> CVarShadow("r.RT.Shadow", true, "Ray-traced sun shadows. Off: the sun is unshadowed unless the host shadows it.");
TRTConsoleVariable<int32_t> CVarSamples("r.RT.Shadow.Samples", 1, "Sun shadow rays per pixel. Hard shadows need one only.", {1, 64});
TRTConsoleVariable<int32_t> CVarPath("r.RT.Shadow.Path", 0, "0: what the device does best. 1: ray-tracing pipeline. 2: ray query.", {0, 2});
TRTConsoleVariable<float> CVarMaxDistance("r.RT.Shadow.MaxDistance", 100000.0f, "Length of sun shadow rays, metres.", {0.01, 1e9});
TRTConsoleVariable<bool> CVarSoft("r.RT.Shadow.Soft", true, "Penumbrae of the sun's disk. Off: hard shadows from its centre.");
TRTConsoleVariable<bool> CVarCullFront("r.RT.Shadow.CullFrontFaces", false,
    "Sun shadow rays ignore faces turned towards the sun, as shadow maps drawn with front-face culling do. Objects "
    "all of whose materials are double-sided still cast.");
TRTConsoleVariable<int32_t> CVarMask(
    "r.RT.Shadow.InstanceMask", MaskCastsShadow, "Only objects that share a bit with this mask cast sun shadows.", {0, 255});
TRTConsoleVariable<bool> CVarDenoise("r.RT.Shadow.Denoise", true,
    "Soft sun shadows are accumulated over frames and smoothed along surfaces. Off: as the frame's rays see them.");
TRTConsoleVariable<float> CVarHistory(
    "r.RT.Shadow.HistorySeconds", 0.5f, "Time constant of what r.RT.Shadow.Denoise accumulates. 0: nothing is.", {0.0, 60.0});
TRTConsoleVariable<int32_t> CVarPasses(
    "r.RT.Shadow.FilterPasses", 4, "Passes of the filter of r.RT.Shadow.Denoise; n of them reach 2^n - 1 pixels.", {0, 5});
TRTConsoleVariable<float> CVarSigma(
    "r.RT.Shadow.FilterSigma", 2.0f, "Which differences the filter takes for noise, in standard deviations.", {0.0, 100.0});
TRTConsoleVariable<float> CVarReach(
    "r.RT.Shadow.FilterReach", 0.25f, "How much of a penumbra's width the filter reaches over.", {0.001, 100.0});
TRTConsoleVariable<float> CVarClamp("r.RT.Shadow.ClampSigma", 7.0f,
    "Accumulated shadows stay within what the neighbourhood says now, give or take this many standard deviations. 0: any.", {0.0, 100.0});
TRTConsoleVariable<float> CVarChange("r.RT.Shadow.ChangeSigma", 2.0f,
    "Accumulation starts anew where shadows have changed by more than this many standard errors. 0: never.", {0.0, 100.0});
TRTConsoleVariable<float> CVarResampling("r.RT.Shadow.Resampling", 0.5f,
    "How much of the difference between neighbours counts as error where accumulated shadows are resampled between them.", {0.0, 100.0});

// A ray towards the sun sees the backs of faces that are turned towards it. gl_RayFlagsCullBackFacingTrianglesEXT
constexpr uint32_t RayFlagCullTowardsSun = 0x10;

bool IsSoft(const FFrameContext& Context) { return CVarSoft.GetOnRenderThread() && Context.Scene.GetSun().AngularDiameter > 0.0f; }

FSunShadowConstants MakeConstants(const FFrameContext& Context, bool bSoft)
{
	FSunShadowConstants C{};
	C.Pass = Context.Pass;
	C.SamplesPerPixel = bSoft ? static_cast<uint32_t>(CVarSamples.GetOnRenderThread()) : 1u;
	C.MaxDistance = CVarMaxDistance.GetOnRenderThread();
	C.RayFlags = CVarCullFront.GetOnRenderThread() ? RayFlagCullTowardsSun : 0u;
	C.InstanceMask = static_cast<uint32_t>(CVarMask.GetOnRenderThread());
	C.bSoft = bSoft ? 1u : 0u;
	return C;
}

FGraphTexture Denoise(FFrameContext& Context, const FSunShadowInputs& Inputs, FGraphTexture Visibility, FGraphTexture Penumbra)
{
	FDenoiseInputs Denoise;
	Denoise.Name = "SunShadow";
	Denoise.Signal = Visibility;
	Denoise.RaysPerPixel = static_cast<uint32_t>(CVarSamples.GetOnRenderThread());
	Denoise.Extent = Penumbra;
	Denoise.Depth = Inputs.Depth;
	Denoise.Normals = Inputs.Normals;
	Denoise.Motion = Inputs.Motion;
	Denoise.Settings.HistorySeconds = CVarHistory.GetOnRenderThread();
	Denoise.Settings.ClampSigma = CVarClamp.GetOnRenderThread();
	Denoise.Settings.ChangeSigma = CVarChange.GetOnRenderThread();
	Denoise.Settings.Resampling = CVarResampling.GetOnRenderThread();
	Denoise.Settings.Passes = static_cast<uint32_t>(CVarPasses.GetOnRenderThread());
	Denoise.Settings.SigmaValue = CVarSigma.GetOnRenderThread();
	Denoise.Settings.ReachExtent = CVarReach.GetOnRenderThread();
	return AddDenoisePasses(Context, Denoise);
}

bool IsFiltered() { return CVarSoft.GetOnRenderThread() && CVarDenoise.GetOnRenderThread(); }
} // namespace

ESunShadowPath ChooseSunShadowPath(const FRTCapabilities& Capabilities, const FSceneFacts& Facts)
{
	if (!Facts.bSun || !IsRayTracingEnabled() || !CVarShadow.GetOnRenderThread()) { return ESunShadowPath::None; }
	const int32_t Wanted = CVarPath.GetOnRenderThread();
	if (Wanted == 1 && Capabilities.bRayTracingPipeline) { return ESunShadowPath::Pipeline; }
	if (Wanted == 2 && Capabilities.bRayQuery) { return ESunShadowPath::Query; }
	if (Wanted == 1)
	{
		LogOnce(ERTLogLevel::Warning, "r.RT.Shadow.Path=1: this device has no ray-tracing pipelines; ray queries are used");
	}
	if (Wanted == 2)
	{
		LogOnce(ERTLogLevel::Warning, "r.RT.Shadow.Path=2: this device has no ray queries; the ray-tracing pipeline is used");
	}
	// Inline rays know the standard program alone.
	if (Facts.bOwnShapes && Capabilities.bRayTracingPipeline) { return ESunShadowPath::Pipeline; }
	// Measured on lavapipe: inline rays are 10–20 % faster for a payload this small; NVIDIA's driver here has pipelines only.
	if (Capabilities.bRayQuery) { return ESunShadowPath::Query; }
	if (Capabilities.bRayTracingPipeline) { return ESunShadowPath::Pipeline; }
	LogOnce(ERTLogLevel::Warning, "sun shadows are off: this device has neither ray queries nor ray-tracing pipelines");
	return ESunShadowPath::None;
}

std::vector<std::pair<std::string, std::string>> MakeSunShadowDefines()
{
	std::vector<std::pair<std::string, std::string>> Defines;
	if (CVarSamples.GetOnRenderThread() == 1 || !CVarSoft.GetOnRenderThread()) { Defines.emplace_back("ONE_SAMPLE", "1"); }
	if (IsFiltered()) { Defines.emplace_back("WITH_PENUMBRA", "1"); }
	return Defines;
}

std::optional<FPassRays> ChooseSunShadowRays(const FRTCapabilities& Capabilities, const FSceneFacts& Facts)
{
	if (ChooseSunShadowPath(Capabilities, Facts) != ESunShadowPath::Pipeline) { return std::nullopt; }
	FPassRays Rays = MakePassRays("SunShadow/SunShadow.rgen", MakeSunShadowDefines(), false);
	Rays.bBlockers = IsFiltered();
	return Rays;
}

bool AreSunShadowsFiltered(const FFrameContext& Context)
{
	return CVarDenoise.GetOnRenderThread() && IsSoft(Context) &&
	       ChooseSunShadowPath(Context.Device.GetCapabilities(), Context.Facts) != ESunShadowPath::None;
}

FSunShadowOutputs AddSunShadowPass(FFrameContext& Context, const FSunShadowInputs& Inputs)
{
	const ESunShadowPath Path = ChooseSunShadowPath(Context.Device.GetCapabilities(), Context.Facts);
	if (Path == ESunShadowPath::None) { return {}; }
	if (Path == ESunShadowPath::Pipeline && Context.GetRayGen(EFrameRayGen::SunShadow) == NoRayGen) { return {}; } // still being compiled
	IRTPipeline* Compute = nullptr;
	if (Path == ESunShadowPath::Query)
	{
		std::vector<std::pair<std::string, std::string>> Defines = MakeSunShadowDefines();
		if (Context.Facts.bMasked)
		{
			Defines.emplace_back("HAS_MASKED", "1");
			for (auto& Define : FAnyHitCounter::GetDefines()) { Defines.push_back(std::move(Define)); }
		}
		Compute = RequireCompute(Context, "SunShadow/SunShadow.comp", std::move(Defines));
		if (!Compute) { return {}; }
	}
	Context.RequireRays();
	FSunShadowOutputs Out;
	Out.Visibility = Context.Graph.CreateTexture(
	    {Context.Width, Context.Height, ERTFormat::R16_FLOAT, ERTTextureUsage::CopySource}, "SunShadowVisibility"); // engines copy it
	FGraphTexture Penumbra;
	if (IsFiltered())
	{
		Penumbra = Context.Graph.CreateTexture({Context.Width, Context.Height, ERTFormat::R16_FLOAT}, "SunShadowPenumbra");
	}
	const bool bSoft = IsSoft(Context);
	const FFrameContext* const Frame = &Context;
	Context.Graph.AddPass("SunShadow", [&](FPassBuilder& Builder) -> FPassExecute {
		Builder.Read(Inputs.Depth, ERTAccess::ShaderRead);
		Builder.Read(Inputs.Normals, ERTAccess::ShaderRead);
		Builder.Write(Out.Visibility, ERTAccess::StorageWrite);
		if (Penumbra.IsValid()) { Builder.WriteIfRead(Penumbra, ERTAccess::StorageWrite); }
		return [=](FPassContext& Pass) {
			FSunShadowConstants Constants = MakeConstants(*Frame, bSoft);
			Constants.Depth = Pass.GetTexture(Inputs.Depth)->GetSampledIndex();
			Constants.Normals = Pass.GetTexture(Inputs.Normals)->GetSampledIndex();
			Constants.Output = Pass.GetTexture(Out.Visibility)->GetStorageIndex();
			IRTTexture* const Wide = Penumbra.IsValid() ? Pass.GetTexture(Penumbra) : nullptr;
			Constants.OutPenumbra = Wide ? Wide->GetStorageIndex() : NO_TEXTURE;
			Pass.CountRays(uint64_t(Frame->Width) * Frame->Height * Constants.SamplesPerPixel);
			if (Compute)
			{
				Dispatch2D(Pass, Compute, Constants, Frame->Width, Frame->Height, SUN_SHADOW_GROUP_SIZE);
				return;
			}
			Pass.Commands().SetPipeline(Frame->RayPipeline->GetPipeline());
			Pass.Commands().PushConstants(&Constants, sizeof(Constants));
			Pass.Commands().TraceRays(
			    Frame->RayBindings->GetTable(), Frame->GetRayGen(EFrameRayGen::SunShadow), Frame->Width, Frame->Height, 1);
		};
	});
	if (AreSunShadowsFiltered(Context)) { Out.Visibility = Denoise(Context, Inputs, Out.Visibility, Penumbra); }
	return Out;
}

} // namespace Lantern
