// Diffuse global illumination: paths through a white Lambert lobe about the shading normal. Rough specular lobes take the same paths.
#include "DiffuseGI/DiffuseGI.h"

#include <algorithm>

#include "BruteForce/BruteForce.h"
#include "Denoise/Denoise.h"
#include "Feedback/RadianceAuditor.h"
#include "HalfFrame/HalfFrame.h"
#include "Lights/LightCells.h"
#include "MovedShare/MovedShare.h"
#include "RadianceCells/Explain.h"
#include "RadianceCells/RadianceCells.h"
#include "RadianceCells/RadianceCellsView.h"
#include "Reflections/Reflections.h"
#include "SignalPasses.h"
#include "Toon/Toon.h"

namespace Lantern
{

namespace
{
TRTConsoleVariable<int32_t> CVarRoute("r.RT.GI", 0,
    "Diffuse global illumination. 0: off, and ambient light of the sky stands in. 1: paths of r.RT.GI.Bounces, by brute force. 2: screen "
    "probes, whose rays end in radiance cells that hold the light of all further bounces. 3: rays of pixels, which end there as well.",
    {0, 3});
TRTConsoleVariable<int32_t> CVarSamples(
    "r.RT.GI.Samples", 1, "Number of diffuse global illumination paths per pixel. Screen probes (r.RT.GI 2) trace 64 each.", {1, 64});
TRTConsoleVariable<int32_t> CVarBounces("r.RT.GI.Bounces", 1,
    "Number of surfaces that may reflect light before it reaches the one that is lit. The reference of as many bounces has one "
    "scattering event more, the last.",
    {1, 4});
TRTConsoleVariable<int32_t> CVarRate("r.RT.GI.Rate", 0,
    "Pixels that trace diffuse global illumination in a frame. 0: all. 1: every other pixel, in turn. 2: one of four, in turn. The others "
    "take what neighbours on their plane found.",
    {0, 2});
TRTConsoleVariable<bool> CVarHalf("r.RT.GI.HalfResolution", false,
    "Finds and filters diffuse global illumination and rough specular light for one pixel of each 2 x 2. The others take it along "
    "surfaces. r.RT.GI.Rate is then of these pixels. With r.RT.GI 3.");
TRTConsoleVariable<int32_t> CVarPath("r.RT.GI.Path", 0,
    "How diffuse global illumination traces. 0: by the pipeline where there is one. 1: ray-tracing pipeline. 2: ray queries, which see all "
    "materials as the standard program shows them, and no own shapes.",
    {0, 2});
TRTConsoleVariable<bool> CVarGuide("r.RT.GI.Guide", false,
    "Up to half of the paths go where earlier paths of the neighbourhood found light. Saves noise where light comes from few places.");
TRTConsoleVariable<bool> CVarReuse("r.RT.GI.Reuse", true,
    "Paths of r.RT.GI 3 light the pixels around as well, each by its own normal, if r.RT.GI.Samples is 1. If off, pixels without a path "
    "take the mean of their "
    "neighbours. Light then changes as the scene says alone: r.RT.GI.ChangeSigma and .ClampSigma do not count.");
TRTConsoleVariable<bool> CVarRoughSpecular("r.RT.GI.RoughSpecular", true,
    "Paths of diffuse global illumination light the specular lobes of surfaces whose reflections are not traced. If off, diffuse light and "
    "the sky stand in.");
// Where one path in a hundred finds a lamp, most neighbourhoods are dark in a frame, and a clamp to them would lose its light.
const FDenoiseVariables Denoise("r.RT.GI", FDenoiseDefaults{.SigmaValue = 3.0f, .bColor = true, .ClampSigma = 0.0f});
constexpr int32_t FirstCachedRoute = 2;
constexpr uint32_t MostProbePasses = 2; // of the wavelet: probes have spread their light already

constexpr uint32_t MostReusePasses = 3;     // paths have been shared already
constexpr float KnownChangesHistory = 2.0f; // Docs/Performance.md, "History of shared paths"
constexpr uint32_t ReuseStep = 2;           // pixels, from one path to the next where one pixel of four traces

bool IsProbeRoute() { return CVarRoute.GetOnRenderThread() == 2; }
/// Screen probes are few by themselves.
bool IsHalfWanted() { return CVarRoute.GetOnRenderThread() == 3 && CVarHalf.GetOnRenderThread(); }
/// Pixels with many paths of their own know enough. A correction may be negative, which paths that are shared cannot be.
bool IsReused()
{
	return CVarRoute.GetOnRenderThread() == 3 && CVarReuse.GetOnRenderThread() && CVarSamples.GetOnRenderThread() == 1 &&
	       GetResidual() != EResidual::Corrected;
}

/// The filter takes negative values for none, which would leave corrections too bright.
bool IsFiltered() { return Denoise.IsEnabled() && GetResidual() != EResidual::Corrected; }

EPixelRate GetTraceRate() { return static_cast<EPixelRate>(CVarRate.GetOnRenderThread()); }
/// Rate of pixels that have a value of their own.
EPixelRate GetValueRate() { return IsProbeRoute() || IsReused() ? EPixelRate::Full : GetTraceRate(); }

constexpr FBruteForcePass BruteForce{ESignal::DiffuseGI, "r.RT.GI", [] { return CVarRoute.GetOnRenderThread() != 0; }, CVarSamples,
    CVarBounces, nullptr, [] { return CVarRoute.GetOnRenderThread() >= FirstCachedRoute; }, &CVarRate, &CVarPath,
    [] { return CVarGuide.GetOnRenderThread(); }, "diffuse global illumination is", ESignal::RoughSpecular,
    [](const FPassQuery& Query) { return ChooseRoughSpecularRays(Query).Path != ERayPath::None; }, IsProbeRoute, IsReused, true};

/// A filter that remembers longer than the cells may would undo what they know of changes.
FDenoiseSettings GetFilter(const FFrameContext& Context)
{
	FDenoiseSettings Settings = Denoise.Get();
	if (IsProbeRoute())
	{
		// Neighbours share their noise, which looks like change, and like a picture without noise.
		Settings.ChangeSigma = 0.0f;
		Settings.Passes = std::min(Settings.Passes, MostProbePasses);
	}
	if (IsReused())
	{
		// Each pixel has a value in each frame, and as few paths in a second as one that has a value in its turn. The scene says what has
		// changed, so that history may last longer than where the picture must show it.
		const uint32_t PixelsPerPath = GetTurnFrames(GetTraceRate()) * (Context.bHalf ? 4 : 1);
		Settings.HistorySeconds *= KnownChangesHistory * static_cast<float>(PixelsPerPath);
		Settings.Passes = std::min(Settings.Passes, MostReusePasses);
		if (GetTraceRate() != EPixelRate::Full) { Settings.FirstStep = ReuseStep; }
	}
	if (const FRadianceCells* const Cells = Context.World->RadianceCells.get())
	{
		Settings.HistorySeconds = std::min(Settings.HistorySeconds, Cells->EventFrames * Context.View.DeltaSeconds);
	}
	return Settings;
}

/// Whether the lobes are filtered in the same passes.
bool IsPair(const FPassQuery& Query)
{
	return IsMade(ESignal::DiffuseGI, Query.Requests) && ChooseRoughSpecularRays(Query).Path != ERayPath::None;
}

FDenoiseInputs MakeInputs(ESignal Signal, FGraphTexture Lobe, FGraphTexture MovedShare, bool bKnownNoise)
{
	FDenoiseInputs Inputs;
	Inputs.Name = GetSignalInfo(Signal).Pass;
	Inputs.Signal = Lobe;
	Inputs.Rate = GetValueRate();
	Inputs.ChangedShare = MovedShare;
	Inputs.bKnownNoise = bKnownNoise;
	return Inputs;
}

FLobes FilterLobes(FFrameContext& Context, const FGBuffer& GBuffer, const FBruteForceOutputs& Made)
{
	FLobes Lobes{Made.Lobe, Made.Second};
	if (!IsFiltered() || (!Lobes.Diffuse.IsValid() && !Lobes.Specular.IsValid())) { return Lobes; }
	const FDenoiseSettings Settings = GetFilter(Context);
	const FGraphTexture Moved = AddMovedShare(Context, GBuffer, ELightFrom::Around, {}, Made.Changes);
	const FDenoiseInputs Diffuse = MakeInputs(ESignal::DiffuseGI, Lobes.Diffuse, Moved, Made.bKnownNoise);
	const FDenoiseInputs Specular = MakeInputs(ESignal::RoughSpecular, Lobes.Specular, Moved, Made.bKnownNoise);
	const bool bDiffuse = Lobes.Diffuse.IsValid() && IsMade(ESignal::DiffuseGI, Context.Signals);
	if (bDiffuse && Lobes.Specular.IsValid()) { return AddDenoisePair(Context, GBuffer, Diffuse, Specular, Settings); }
	if (bDiffuse) { Lobes.Diffuse = AddDenoise(Context, GBuffer, Diffuse, Settings); }
	if (Lobes.Specular.IsValid()) { Lobes.Specular = AddDenoise(Context, GBuffer, Specular, Settings); }
	return Lobes;
}

FLobes AddLobes(FFrameContext& Context, const FGBuffer& GBuffer)
{
	// The filter tells surfaces apart by the normals that they have, in the frame before as well.
	return FilterLobes(Context, GBuffer, AddBruteForcePass(BruteForce, Context, RequireToonSurface(Context, GBuffer)));
}

FLobes AddHalfLobes(FFrameContext& Context, const FGBuffer& GBuffer, ERayPath Path)
{
	FHalfFrame* const Half = RequireHalfFrame(Context, GBuffer);
	if (!Half) { return {}; }
	(void)RequireLightCells(Context, GBuffer);
	(void)RequireRadianceCells(Context, Path);
	FLobes Lobes = AddLobes(Half->Context, Half->GBuffer);
	if (!IsMade(ESignal::DiffuseGI, Context.Signals)) { Lobes.Diffuse = {}; } // its rays serve the other lobe alone
	return AddUpsample(Context, RequireToonSurface(Context, GBuffer), "DiffuseGIUpsample", Lobes);
}

const FLobes& RequireLobes(FFrameContext& Context, const FGBuffer& GBuffer)
{
	if (Context.IndirectLobes) { return *Context.IndirectLobes; }
	(void)AddReflectionsPass(Context, GBuffer); // they ask for cells as well, before these are brought up to date
	const FPassQuery Query{Context.Device.GetCapabilities(), Context.Facts, Context.Signals};
	const ERayPath Path = ChooseBruteForcePath(BruteForce, Query);
	const bool bHalf = Path != ERayPath::None && IsHalfWanted() && AreHalfFrameShadersReady(Context, IsPair(Query));
	FLobes Lobes = bHalf ? AddHalfLobes(Context, GBuffer, Path) : AddLobes(Context, GBuffer);
	const bool bHorizon = !IsProbeRoute(); // probes make up for what lies below a surface
	Lobes.Diffuse = AddToonGrade(Context, GBuffer, Lobes.Diffuse, bHorizon, IsFiltered());
	Context.IndirectLobes = Lobes;
	AddRadianceCellsView(Context, GBuffer);
	AddExplainPass(Context, GBuffer);
	return *Context.IndirectLobes;
}
} // namespace

FPassRays ChooseDiffuseGIRays(const FPassQuery& Query)
{
	FPassRays Rays = ChooseBruteForceRays(BruteForce, Query);
	if (Rays.bRadianceCells)
	{
		ListRadianceCellsViewShaders(Rays.Compute);
		ListExplainShaders(Rays.Compute);
	}
	if (Rays.Path != ERayPath::None) { ListToonShaders(Query.Facts, false, Rays.Compute); }
	if (Rays.Path != ERayPath::None && IsHalfWanted()) { ListHalfFrameShaders(Query.Facts, IsPair(Query), Rays.Compute); }
	return Rays;
}

ERayPath ChooseCachedLightPath(const FPassQuery& Query)
{
	return BruteForce.EndsInRadianceCells() ? ChooseBruteForcePath(BruteForce, Query) : ERayPath::None;
}

bool IsDiffuseGIFiltered(const FRTScene&) { return IsFiltered(); }

void ListDiffuseGIFilters(const FRTScene&, const FPassQuery& Query, std::vector<FShaderSource>& Out)
{
	if (!IsFiltered()) { return; }
	ListDenoiseShaders({.bColor = true, .bPair = IsPair(Query), .Rate = GetValueRate(), .bKnownNoise = IsReused()}, Denoise.Get(), Out);
	ListMovedShareShaders(Out);
}

FGraphTexture AddDiffuseGIPass(FFrameContext& Context, const FGBuffer& GBuffer) { return RequireLobes(Context, GBuffer).Diffuse; }

FPassRays ChooseRoughSpecularRays(const FPassQuery& Query)
{
	FPassRays Rays;
	Rays.bTraces = false;
	if (!CVarRoughSpecular.GetOnRenderThread() || GetReflectedRoughness(Query) >= 1.0f) { return Rays; }
	if (IsMade(ESignal::RoughSpecular, Query.Requests)) { Rays.Path = ChooseBruteForcePath(BruteForce, Query); }
	return Rays;
}

FGraphTexture AddRoughSpecularPass(FFrameContext& Context, const FGBuffer& GBuffer)
{
	if (ChooseSignalRays(Context, ESignal::RoughSpecular).Path == ERayPath::None) { return {}; }
	return RequireLobes(Context, GBuffer).Specular;
}

} // namespace Lantern
