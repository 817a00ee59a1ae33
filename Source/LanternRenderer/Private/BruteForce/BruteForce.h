// Indirect light by brute force: paths from every pixel through one lobe of its surface. It is the baseline that every later
// method must beat.
#pragma once

#include "RayPath.h"

namespace Lantern
{

/// One signal's variables. Static storage.
struct FBruteForcePass
{
	ESignal Signal;
	const TRTConsoleVariable<bool>& Enable;
	const TRTConsoleVariable<int32_t>& Samples; ///< paths per pixel
	/// Surfaces that may reflect light before it reaches the one that is lit.
	const TRTConsoleVariable<int32_t>& Bounces;
	/// Rougher surfaces are not traced; null: all are.
	const TRTConsoleVariable<float>* MaxRoughness = nullptr;
};

ERayPath ChooseBruteForcePath(const FBruteForcePass& Settings, const FPassQuery& Query);
FPassRays ChooseBruteForceRays(const FBruteForcePass& Settings, const FPassQuery& Query);
/// Reads Depth and Normals of the G-buffer, and BaseColor and Material if FSignalInfo::bNeedsSurface says so.
FGraphTexture AddBruteForcePass(const FBruteForcePass& Settings, FFrameContext& Context, const FGBuffer& GBuffer);

} // namespace Lantern
