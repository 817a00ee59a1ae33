// The choice between ray-tracing pipeline and ray queries, the same for all passes.
#include "RayPath.h"

#include <algorithm>

#include "Feedback/AnyHitCounter.h"
#include "LanternCore/Text/Log.h"

namespace Lantern
{

namespace
{
TRTConsoleVariable<bool> CVarReorder("r.RT.Reorder", false,
    "Sorts threads by what their rays hit before material shaders run (shader execution reordering), in the reference, diffuse global "
    "illumination and reflections. Needs a device that can.");
TRTConsoleVariable<bool> CVarCones("r.RT.Rays.Cones", true,
    "Mirrors, and what light shines through, show textures at the level of detail of what a pixel covers there. If off, at the finest one, "
    "which shimmers.");
TRTConsoleVariable<int32_t> CVarMaterials("r.RT.GI.Materials", 0,
    "What indirect light (r.RT.GI 2 and 3) sees of materials with a program of their own. 0: what their standard parameters say, by one "
    "hit shader for all. Rays then take no longer because there are many. What cameras and mirrors see runs the program. 1: the program, "
    "everywhere.",
    {0, 1});
} // namespace

void SetHitPrograms(EHitPrograms Wanted, FPassRays& InOut)
{
	if (InOut.Path != ERayPath::Pipeline || CVarMaterials.GetOnRenderThread() != 0) { return; }
	InOut.HitPrograms = Wanted;
	if (Wanted == EHitPrograms::Standard) { InOut.Defines.emplace_back("STANDARD_HITS", "1"); }
	if (Wanted == EHitPrograms::OwnWhereSeen) { InOut.Defines.emplace_back("STANDARD_HITS_UNSEEN", "1"); }
}

void AddRayConeDefine(FShaderDefines& InOut)
{
	if (!CVarCones.GetOnRenderThread()) { InOut.emplace_back("NO_RAY_CONES", "1"); }
}

void AddReorderDefine(const FRTCapabilities& Capabilities, FShaderDefines& Defines)
{
	if (!CVarReorder.GetOnRenderThread()) { return; }
	if (Capabilities.bReorder)
	{
		Defines.emplace_back("REORDER", "1");
		return;
	}
	LogOnce(ERTLogLevel::Warning,
	    CVarReorder.GetName() + "=1: this device has no shader execution reordering; hits are shaded in the order of pixels");
}

ERayPath ChooseRayPath(const FPassQuery& Query, const TRTConsoleVariable<int32_t>& Wanted, const char* What)
{
	const bool bPipeline = Query.Capabilities.bRayTracingPipeline, bQuery = Query.Capabilities.bRayQuery;
	const int32_t Value = Wanted.GetOnRenderThread();
	if (Value == 1 && bPipeline) { return ERayPath::Pipeline; }
	if (Value == 2 && bQuery) { return ERayPath::Query; }
	if (!bPipeline && !bQuery)
	{
		LogOnce(ERTLogLevel::Warning, std::string(What) + " off: this device has neither ray queries nor ray-tracing pipelines");
		return ERayPath::None;
	}
	if (Value == 1)
	{
		LogOnce(ERTLogLevel::Warning, Wanted.GetName() + "=1: this device has no ray-tracing pipelines; ray queries are used");
	}
	if (Value == 2)
	{
		LogOnce(ERTLogLevel::Warning, Wanted.GetName() + "=2: this device has no ray queries; the ray-tracing pipeline is used");
	}
	// Inline rays know the standard program alone.
	if (Query.Facts.bOwnShapes && bPipeline) { return ERayPath::Pipeline; }
	// Measured on lavapipe: inline rays are 10–20 % faster for a payload this small. NVIDIA's driver here has pipelines only.
	return bQuery ? ERayPath::Query : ERayPath::Pipeline;
}

ERayPath ChooseShadingRayPath(const FPassQuery& Query, const TRTConsoleVariable<int32_t>& Wanted, const char* What)
{
	const bool bAnyPipeline = Wanted.GetOnRenderThread() == 0 && Query.Capabilities.bRayTracingPipeline;
	return bAnyPipeline ? ERayPath::Pipeline : ChooseRayPath(Query, Wanted, What);
}

ERayPath ChoosePipelinePath(const FPassQuery& Query, const std::string& Variable)
{
	if (Query.Capabilities.bRayTracingPipeline) { return ERayPath::Pipeline; }
	LogOnce(ERTLogLevel::Warning,
	    Variable + " is off: paths run material shaders where they hit, and this device has no ray-tracing pipelines");
	return ERayPath::None;
}

std::string GetRayShaderPath(ESignal Signal, const FPassRays& Rays, const char* Suffix)
{
	return Rays.Shaders.empty() ? MakeShaderPath(Signal, Suffix) : Rays.Shaders + Suffix;
}

FShaderSource MakeQuerySource(const FSceneFacts& Facts, ESignal Signal, const FPassRays& Rays)
{
	return MakeQuerySource(Facts, GetRayShaderPath(Signal, Rays, ""), Rays);
}

FShaderSource MakeQuerySource(const FSceneFacts& Facts, const std::string& Path, const FPassRays& Rays)
{
	FShaderDefines Defines = Rays.Defines;
	if (Facts.bMasked)
	{
		Defines.emplace_back("HAS_MASKED", "1");
		for (auto& Define : FAnyHitCounter::GetDefines()) { Defines.push_back(std::move(Define)); }
	}
	const bool bTold = std::any_of(Defines.begin(), Defines.end(), [](const auto& Define) { return Define.first == "HAS_TRANSMISSION"; });
	if (!bTold) { AddTransmissionDefine(Facts, Defines); }
	return MakeComputeSource(Path + ".comp", std::move(Defines));
}

bool FRayDispatch::Has(const char* Define) const
{
	return std::any_of(Defines.begin(), Defines.end(), [=](const auto& Entry) { return Entry.first == Define; });
}

std::optional<FRayDispatch> RequireRayDispatch(const FFrameContext& Context, ESignal Signal, const FPassRays& Rays)
{
	return RequireRayDispatch(Context, Rays, Context.GetRayGen(Signal), MakeQuerySource(Context.Facts, Signal, Rays));
}

std::optional<FRayDispatch> RequireRayDispatch(
    const FFrameContext& Context, const FPassRays& Rays, uint32_t RayGen, const FShaderSource& Query)
{
	FRayDispatch Dispatch;
	if (Rays.Path == ERayPath::None) { return std::nullopt; }
	if (!Rays.bTraces)
	{
		Dispatch.Defines = Rays.Defines;
		return Dispatch;
	}
	if (Rays.Path == ERayPath::Pipeline)
	{
		Dispatch.RayGen = RayGen;
		if (Dispatch.RayGen == NoRayGen) { return std::nullopt; } // still being compiled
		Dispatch.Defines = Context.RayPipeline->GetRayGen(Dispatch.RayGen).Defines;
	}
	else
	{
		Dispatch.Defines = Query.Defines;
		Dispatch.Compute = RequireCompute(Context, Query);
		if (!Dispatch.Compute) { return std::nullopt; }
	}
	Context.RequireRays();
	return Dispatch;
}

} // namespace Lantern
