// ESignal::SunShadow: the sun's disk, seen or not, by shadow rays.
#pragma once

#include "Rays/ShadowRays.h"

namespace Lantern
{

FPassRays ChooseSunShadowRays(const FPassQuery& Query);
bool AskSunShadowRays(FFrameContext& Context, const FRayDispatch& Dispatch, FShadowRayWishes& InOut);
/// Reads Depth, Normals and, if there is any, Motion of the G-buffer.
FGraphTexture AddSunShadowPass(FFrameContext& Context, const FGBuffer& GBuffer);
/// Returns whether the pass needs motion vectors: for its filter, or for what they name.
bool FollowsSunShadowMotion(const FRTScene& Scene);
/// Returns whether the scene's sun shadows, if there are any, are filtered over frames.
bool IsSunShadowFiltered(const FRTScene& Scene);
void ListSunShadowFilters(const FRTScene& Scene, const FPassQuery& Query, std::vector<FShaderSource>& Out);

} // namespace Lantern
