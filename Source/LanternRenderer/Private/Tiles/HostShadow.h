// The host's shadow map as tiles read it: its cascades, and a pyramid over each of them.
#pragma once

#include "PassTools.h"

namespace Lantern
{

struct FSunRays;

/// The map of one frame.
struct FHostShadowMap
{
	FHostShadow Host;
	FGraphBuffer Pyramid;  ///< of all cascades, see FHostShadowCascadeData; invalid for a host's own shader
	float Diameter = 0.0f; ///< of the disk that rays go to, radians
	/// The map is there in this frame. If not, all rays are traced.
	bool IsValid() const { return Host.IsGiven(); }
	/// Declares what Push needs of a pass.
	void Read(FPassBuilder& Builder) const;
	/// Returns the address of the data for shaders; 0 if there is no map.
	FAddress Push(FPassContext& Pass, const FFrameContext& Frame) const;
};

FShaderSource MakePyramidSource();
/// Returns the define of shaders that ask the map, if the host has one.
FShaderDefines MakeHostShadowDefines(const FSceneFacts& Facts);

/// Adds the pass that makes the pyramid. Without a map, or while its shader is compiled, the result is not valid. Leaves to the map
/// what it holds: changes the casters that Rays trace.
FHostShadowMap AddHostShadowPass(FFrameContext& Context, FSunRays& Rays);

} // namespace Lantern
