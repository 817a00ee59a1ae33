// Reflections: paths through the specular lobe of each pixel's surface.
#include "Reflections/Reflections.h"

#include "BruteForce/BruteForce.h"
#include "Reflections/ReflectingToon.h"
#include "Reflections/ReflectionPaths.h"
#include "SignalPasses.h"

namespace Lantern
{

namespace
{
TRTConsoleVariable<int32_t> CVarRoute("r.RT.Reflections", 0,
    "Reflections. 0: off, and paths of global illumination or unoccluded light of the sky stand in. 1: paths that end in the radiance "
    "cells "
    "of r.RT.GI 2 and 3, with a filter that follows what mirrors show. 2: paths of r.RT.Reflections.Bounces, by brute force.",
    {0, 2});
TRTConsoleVariable<int32_t> CVarSamples("r.RT.Reflections.Samples", 1, "Number of reflection paths per pixel.", {1, 64});
TRTConsoleVariable<int32_t> CVarBounces("r.RT.Reflections.Bounces", 1,
    "Number of surfaces that may reflect light before it reaches the one that mirrors it. The reference of as many bounces has one "
    "scattering event more, the last. Does not count where radiance cells hold the light of further surfaces.",
    {1, 4});
TRTConsoleVariable<float> CVarMaxRoughness("r.RT.Reflections.MaxRoughness", 1.0f,
    "Surfaces that are rougher have no reflections traced: paths of global illumination stand in, or the sky's ambient light. With "
    "r.RT.Reflections 1, reflections fade out over the last 0.1 before. 1: all are traced.",
    {0.0, 1.0});
TRTConsoleVariable<int32_t> CVarPath("r.RT.Reflections.Path", 0,
    "How reflections of r.RT.Reflections 1 trace. 0: by the pipeline where there is one. 1: ray-tracing pipeline. 2: ray queries, which "
    "see "
    "all materials as the standard program shows them, and no own shapes.",
    {0, 2});
constexpr int32_t PathRoute = 1, BruteForceRoute = 2;
constexpr FBruteForcePass BruteForce{ESignal::Reflections, "r.RT.Reflections",
    [] { return CVarRoute.GetOnRenderThread() == BruteForceRoute; }, CVarSamples, CVarBounces, &CVarMaxRoughness};

bool IsPathRoute() { return CVarRoute.GetOnRenderThread() == PathRoute; }

FReflectionPathSettings GetPathSettings(const FPassQuery& Query)
{
	FReflectionPathSettings Settings;
	const bool bAny = IsRayTracingEnabled() && Query.Facts.Objects > 0 && HasAnyLight(Query.Facts);
	if (bAny) { Settings.Path = ChooseShadingRayPath(Query, CVarPath, "reflections are"); }
	Settings.Samples = static_cast<uint32_t>(CVarSamples.GetOnRenderThread());
	Settings.Bounces = static_cast<uint32_t>(CVarBounces.GetOnRenderThread());
	Settings.MaxRoughness = CVarMaxRoughness.GetOnRenderThread();
	return Settings;
}

float GetEmissionRoughness()
{
	const float MaxRoughness = CVarMaxRoughness.GetOnRenderThread();
	return IsPathRoute() ? GetFullRoughness(MaxRoughness) : MaxRoughness;
}
} // namespace

float GetReflectedRoughness(const FPassQuery& Query)
{
	if (!IsMade(ESignal::Reflections, Query.Requests)) { return -1.0f; }
	const ERayPath Path = IsPathRoute() ? GetPathSettings(Query).Path : ChooseBruteForcePath(BruteForce, Query);
	return Path != ERayPath::None ? GetEmissionRoughness() : -1.0f;
}

float GetReflectedRoughnessInReference()
{
	return IsRayTracingEnabled() && CVarRoute.GetOnRenderThread() != 0 ? GetEmissionRoughness() : -1.0f;
}

FPassRays ChooseReflectionsRays(const FPassQuery& Query)
{
	FPassRays Rays = IsPathRoute() ? ChooseReflectionPaths(GetPathSettings(Query), Query) : ChooseBruteForceRays(BruteForce, Query);
	if (Rays.Path != ERayPath::None) { ListReflectingToonShaders(Query.Facts, Rays.Compute); }
	return Rays;
}

FGBuffer AddReflectingSurface(FFrameContext& Context, const FGBuffer& GBuffer)
{
	return AddReflectingToon(Context, GBuffer, GetEmissionRoughness());
}

bool AreReflectionsFiltered(const FRTScene&) { return IsPathRoute() && AreReflectionPathsFiltered(); }

void ListReflectionFilters(const FRTScene&, const FPassQuery& Query, std::vector<FShaderSource>& Out)
{
	if (IsPathRoute()) { ListReflectionPathFilters(GetPathSettings(Query), Out); }
}

FGraphTexture AddReflectionsPass(FFrameContext& Context, const FGBuffer& GBuffer)
{
	if (Context.ReflectedLight) { return *Context.ReflectedLight; }
	const FPassQuery Query{Context.Device.GetCapabilities(), Context.Facts, Context.Signals};
	FGraphTexture Light;
	if (GetReflectedRoughness(Query) >= 0.0f)
	{
		const FGBuffer Styled = AddReflectingSurface(Context, GBuffer);
		Light = IsPathRoute() ? AddReflectionPaths(GetPathSettings(Query), Context, Styled)
		                      : AddBruteForcePass(BruteForce, Context, Styled).Lobe;
	}
	Context.ReflectedLight = Light;
	return Light;
}

} // namespace Lantern
