// How a pass traces: through the frame's ray-tracing pipeline, or by ray queries in a compute shader.
//
// A signal's shaders lie in Shaders/<Pass>/: <Pass>.rgen for the pipeline, <Pass>.comp for ray queries. They trace the same
// rays and share push constants. A signal whose rays go through a queue names the queue's shaders instead (FPassRays::Shaders).
#pragma once

#include "PassTools.h"

namespace Lantern
{

enum class ERayPath : uint8_t
{
	None, ///< the pass is off, or the device can trace neither way
	Pipeline,
	Query,
};

/// Whose program a pass's rays run where they hit a material that has one of its own.
enum class EHitPrograms : uint8_t
{
	Own,
	OwnWhereSeen, ///< the material's where a camera or mirrors alone see it, and the standard one where it only lights
	Standard,
};

/// What the passes of one frame are chosen by.
struct FPassQuery
{
	const FRTCapabilities& Capabilities;
	const FSceneFacts& Facts;
	const FSignalRequests& Requests;
	/// Another signal of this frame serves instead (FSignalPass::ReplacedBy): the pass runs only if somebody asks for it.
	bool bReplaced = false;
};

/// What one pass wants of the frame's RTPSO, or of a compute pipeline.
struct FPassRays
{
	ERayPath Path = ERayPath::None;
	FShaderDefines Defines; ///< of its shaders, on either path
	/// Its rays shade what they hit and may sample the scene's emissive triangles (Shaders/Rays/PathTracing.glsl). If
	/// false, it casts shadow rays only, and the RTPSO needs no closest-hit shader for it.
	bool bShadesHits = false;
	EHitPrograms HitPrograms = EHitPrograms::Own; ///< with bShadesHits; see SetHitPrograms
	bool bLightSampling = false;                  ///< its other shaders sample emissive triangles
	bool bTraces = true;                          ///< false: the scene leaves nothing to trace, and only passes around the rays are made
	bool bBlockers = false;                       ///< its shadow rays report the distance of the blocker
	/// Its paths end in radiance cells (RadianceCells/RadianceCells.h). Those that meet none go on in a second launch of its shader, with
	/// MakeDeferredRays (BruteForce/BruteForce.h).
	bool bRadianceCells = false;
	/// Path of the shaders that trace, without suffix. Empty: the signal's own.
	std::string Shaders;
	/// Compute shaders of the passes before and behind the rays. Filters have a list of their own (FSignalPass::ListFilters).
	std::vector<FShaderSource> Compute;
};

/// Returns the path of the shader that traces Signal. Suffix: ".rgen" or ".comp".
std::string GetRayShaderPath(ESignal Signal, const FPassRays& Rays, const char* Suffix);

/// Chooses the path. Wanted is a console variable: 0 for the faster one, 1 for the pipeline, 2 for ray queries. Logs once if
/// the device lacks what was asked for. What names the pass in messages: "sun shadows are".
ERayPath ChooseRayPath(const FPassQuery& Query, const TRTConsoleVariable<int32_t>& Wanted, const char* What);
/// Chooses for passes whose rays shade hits. 0 means the pipeline where there is one: by ray queries, all materials are seen as the
/// standard program shows them. Wanted, What: as above.
ERayPath ChooseShadingRayPath(const FPassQuery& Query, const TRTConsoleVariable<int32_t>& Wanted, const char* What);
/// Chooses for those that have no shader for ray queries. Variable: name of what switches the pass, for the message.
ERayPath ChoosePipelinePath(const FPassQuery& Query, const std::string& Variable);

/// Adds the define REORDER for ray generation shaders whose rays run material shaders, if r.RT.Reorder is on and the device can. Logs
/// once if it cannot.
void AddReorderDefine(const FRTCapabilities& Capabilities, FShaderDefines& Defines);
/// Adds what shaders whose rays have cones are compiled with (Shaders/Rays/RayCone.glsl).
void AddRayConeDefine(FShaderDefines& InOut);

/// Sets whose programs the rays of a pipeline run, unless r.RT.GI.Materials says that each material runs its own. Ray queries know the
/// standard program alone.
void SetHitPrograms(EHitPrograms Wanted, FPassRays& InOut);

/// One pass's pipeline in this frame.
struct FRayDispatch
{
	IRTPipeline* Compute = nullptr; ///< null: through the frame's RTPSO
	uint32_t RayGen = NoRayGen;     ///< of the frame's RTPSO
	/// Defines of the shader that runs. While another variant is compiled, they are those of the variant that serves.
	FShaderDefines Defines;
	bool Has(const char* Define) const;
};

/// Makes the source of the compute shader that traces by ray queries. Path: without suffix.
FShaderSource MakeQuerySource(const FSceneFacts& Facts, const std::string& Path, const FPassRays& Rays);
FShaderSource MakeQuerySource(const FSceneFacts& Facts, ESignal Signal, const FPassRays& Rays);

/// Finds the pipeline by which Signal is traced in this frame, and requires the frame's acceleration structures. nullopt: Rays.Path
/// is None, or shaders are still being compiled, or an error, which the context then has.
std::optional<FRayDispatch> RequireRayDispatch(const FFrameContext& Context, ESignal Signal, const FPassRays& Rays);
/// Does so for a pass that makes no signal. RayGen: its ray generation shader. Query: from MakeQuerySource.
std::optional<FRayDispatch> RequireRayDispatch(
    const FFrameContext& Context, const FPassRays& Rays, uint32_t RayGen, const FShaderSource& Query);

/// Traces Width × Height rays through the ray-generation shader RayGen of the frame's RTPSO.
template <class T>
void TraceFrameRays(FPassContext& Pass, const FFrameContext& Frame, uint32_t RayGen, const T& Constants, uint32_t Width, uint32_t Height)
{
	Pass.Commands().SetPipeline(Frame.RayPipeline->GetPipeline());
	Pass.Commands().PushConstants(&Constants, sizeof(Constants));
	Pass.Commands().TraceRays(Frame.RayTable->GetTable(), RayGen, Width, Height, 1);
}

/// Runs a pass for each pixel of the frame, on either path. Compute shaders have groups of RAY_QUERY_GROUP_SIZE².
template <class T>
void DispatchRays(FPassContext& Pass, const FFrameContext& Frame, const FRayDispatch& Dispatch, const T& Constants)
{
	if (Dispatch.Compute) { return Dispatch2D(Pass, Dispatch.Compute, Constants, Frame.Width, Frame.Height, RAY_QUERY_GROUP_SIZE); }
	TraceFrameRays(Pass, Frame, Dispatch.RayGen, Constants, Frame.Width, Frame.Height);
}

} // namespace Lantern
