// ESignal::AmbientOcclusion: what is near about a surface's normal, by shadow rays of random length.
#pragma once

#include "RayPath.h"
#include "ReferenceTypes.h"

namespace Lantern
{

FPassRays ChooseAmbientOcclusionRays(const FPassQuery& Query);
/// Reads Depth, Normals and, if there is any, Motion of the G-buffer.
FGraphTexture AddAmbientOcclusionPass(FFrameContext& Context, const FGBuffer& GBuffer);
/// Returns whether ambient occlusion, if there is any, is filtered over frames.
bool IsAmbientOcclusionFiltered(const FRTScene& Scene);
void ListAmbientOcclusionFilters(const FRTScene& Scene, const FPassQuery& Query, std::vector<FShaderSource>& Out);
/// Fills radius and mask.
void SetAmbientOcclusionReference(FReferenceConstants& Constants);

} // namespace Lantern
