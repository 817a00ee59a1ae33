// Reflections: paths through the specular lobe of each pixel's surface.
#include "Reflections/Reflections.h"

#include "BruteForce/BruteForce.h"
#include "SignalPasses.h"

namespace Lantern
{

namespace
{
TRTConsoleVariable<bool> CVarEnable(
    "r.RT.Reflections", false, "Traces reflections by paths, without a filter. If off, unoccluded light of the sky stands in.");
TRTConsoleVariable<int32_t> CVarSamples("r.RT.Reflections.Samples", 1, "Number of reflection paths per pixel.", {1, 64});
TRTConsoleVariable<int32_t> CVarBounces("r.RT.Reflections.Bounces", 1,
    "Number of surfaces that may reflect light before it reaches the one that mirrors it. The reference of as many bounces has one "
    "scattering event more, the last.",
    {1, 4});
TRTConsoleVariable<float> CVarMaxRoughness("r.RT.Reflections.MaxRoughness", 1.0f,
    "Surfaces that are rougher have no reflections traced; the sky's ambient light stands in. 1: all are traced.", {0.0, 1.0});
constexpr FBruteForcePass BruteForce{
    ESignal::Reflections, "r.RT.Reflections", [] { return CVarEnable.GetOnRenderThread(); }, CVarSamples, CVarBounces, &CVarMaxRoughness};
} // namespace

float GetReflectedRoughness(const FPassQuery& Query)
{
	const bool bTraced = IsMade(ESignal::Reflections, Query.Requests) && ChooseBruteForcePath(BruteForce, Query) != ERayPath::None;
	return bTraced ? CVarMaxRoughness.GetOnRenderThread() : -1.0f;
}

float GetReflectedRoughnessInReference()
{
	return IsRayTracingEnabled() && CVarEnable.GetOnRenderThread() ? CVarMaxRoughness.GetOnRenderThread() : -1.0f;
}

FPassRays ChooseReflectionsRays(const FPassQuery& Query) { return ChooseBruteForceRays(BruteForce, Query); }

FGraphTexture AddReflectionsPass(FFrameContext& Context, const FGBuffer& GBuffer)
{
	return AddBruteForcePass(BruteForce, Context, GBuffer).Lobe;
}

} // namespace Lantern
