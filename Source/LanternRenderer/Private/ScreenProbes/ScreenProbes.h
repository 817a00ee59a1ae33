// Screen probes: points on the surfaces of a grid of tiles of the screen, which find the light from all directions for the pixels around
// them (Shaders/ScreenProbes/). Their rays are launched as those of a brute-force pass (BruteForce/BruteForce.h).
#pragma once

#include "PassTools.h"
#include "ScreenProbeTypes.h"
#include "TwoFrames.h"

namespace Lantern
{

/// The probes of one frame.
struct FScreenProbes
{
	FTwoFrames Kept;         ///< FScreenProbe
	FGraphBuffer Work;       ///< FScreenProbePlan and FScreenProbeRay of this frame
	FScreenProbeGrid Grid{}; ///< without addresses
	FUploadSlice GridData;
	IRTPipeline *Plan = nullptr, *Resolve = nullptr, *Project = nullptr, *Gather = nullptr;
	uint32_t NearRays = 0; ///< short rays of pixels
	bool IsValid() const { return Gather != nullptr; }
	/// Size of the launch: rows of pixels' rays lie below those of the probes.
	uint32_t GetLaunchWidth() const { return Grid.Columns * uint32_t(SCREEN_PROBE_TEXELS); }
	uint32_t GetLaunchHeight() const { return Grid.Rows + DivideUp(NearRays, GetLaunchWidth()); }
};

constexpr const char* ScreenProbesDefine = "SCREEN_PROBES";
/// Adds what the shader of the rays is compiled with, and lists the shaders of the other passes. bSecondLobe: see FBruteForcePass::Second.
void AddScreenProbeShaders(bool bSecondLobe, FShaderDefines& InOutDefines, std::vector<FShaderSource>& OutCompute);

/// Returns the look-ups of radiance cells that may vote, of a frame whose paths start at probes.
uint32_t CountScreenProbeVoters(const FFrameContext& Context);
/// Makes the probes of the frame's view. Invalid: shaders are being compiled, or there is no memory, which the context then has as an error.
FScreenProbes MakeScreenProbes(FFrameContext& Context, bool bSecondLobe);
/// Adds the pass that places probes and plans their rays.
void AddScreenProbePlan(FFrameContext& Context, const FGBuffer& GBuffer, const FScreenProbes& Probes);
/// Declares that a pass traces the rays.
void DeclareScreenProbeRays(FPassBuilder& Builder, const FScreenProbes& Probes);
/// Returns FScreenProbeGrid's address, while a pass that declares the probes is recorded.
FAddress WriteScreenProbeGrid(FPassContext& Pass, const FScreenProbes& Probes);
/// Adds the passes that light pixels by what the rays have found. Second: of the second lobe; invalid: there is none.
void AddScreenProbeGather(
    FFrameContext& Context, const FGBuffer& GBuffer, const FScreenProbes& Probes, FGraphTexture Output, FGraphTexture Second);

} // namespace Lantern
