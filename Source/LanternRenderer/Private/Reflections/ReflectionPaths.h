// Reflections whose paths end in radiance cells, filtered by what they show (Shaders/Reflections/).
#pragma once

#include "RayPath.h"
#include "ReflectionTypes.h"

namespace Lantern
{

/// What Reflections.cpp's variables ask for.
struct FReflectionPathSettings
{
	ERayPath Path = ERayPath::None;
	uint32_t Samples = 1, Bounces = 1; ///< Bounces: of paths that end in no cell
	float MaxRoughness = 1.0f;         ///< rougher surfaces are not traced
};

/// Returns the roughness up to which reflections count in full. From there on they fade out: neither materials nor textures show where they
/// end. Mirrors always count.
float GetFullRoughness(float MaxRoughness);
/// Returns the sampled indices of the G-buffer.
FReflectionPixels GetReflectionPixels(FPassContext& Pass, const FGBuffer& GBuffer);
FPassRays ChooseReflectionPaths(const FReflectionPathSettings& Settings, const FPassQuery& Query);
bool AreReflectionPathsFiltered();
void ListReflectionPathFilters(const FReflectionPathSettings& Settings, std::vector<FShaderSource>& Out);
/// Adds the passes, and returns the signal. Invalid: shaders are being compiled, or an error, which the context then has.
FGraphTexture AddReflectionPaths(const FReflectionPathSettings& Settings, FFrameContext& Context, const FGBuffer& GBuffer);

} // namespace Lantern
