// ESignal::LocalDiffuse and ESignal::LocalSpecular: shadowed light of lights other than the sun. One pass shades for either.
#pragma once

#include "Rays/ShadowRays.h"
#include "ReferenceTypes.h"

namespace Lantern
{

/// Returns how shadow rays to local lights are traced. None: none are.
ERayPath ChooseLocalLightPath(const FPassQuery& Query);
/// r.RT.Lights.
bool AreLocalLightsShadowed();
/// Returns whether the half frame has their rays (r.RT.Lights.HalfResolution). Either context of a frame has the same answer.
bool AreLocalLightsHalf(const FFrameContext& Context);
FPassRays ChooseLocalLightRays(const FPassQuery& Query);
bool AskLocalRays(FFrameContext& Context, const FRayDispatch& Dispatch, FShadowRayWishes& InOut);
/// Read Depth, Normals, BaseColor, Material and, if there is any, Motion of the G-buffer.
FGraphTexture AddLocalDiffusePass(FFrameContext& Context, const FGBuffer& GBuffer);
FGraphTexture AddLocalSpecularPass(FFrameContext& Context, const FGBuffer& GBuffer);
/// Returns the time constant of what is accumulated of local lights, seconds; 0: nothing is (r.RT.Lights.Denoise, .HistorySeconds).
float GetLocalHistorySeconds();
/// Returns whether the light of local lights, if there is any, is filtered over frames.
bool AreLocalLightsFiltered(const FRTScene& Scene);
/// Tells references which pixels trace reflections, where the two signals share emission.
void SetLocalSpecularReference(FReferenceConstants& Constants);
void ListLocalLightFilters(const FRTScene& Scene, const FPassQuery& Query, std::vector<FShaderSource>& Out);

} // namespace Lantern
