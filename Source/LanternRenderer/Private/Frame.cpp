// The frame's table of contents.
#include "LanternRenderer/Frame.h"

namespace Lantern
{

FFrameOutputs AddFramePasses(FFrameContext& Context, const FGBuffer& GBuffer)
{
	FFrameOutputs Out;
	Out.SunShadow = AddSunShadowPass(Context, {GBuffer.Depth, GBuffer.Normals});
	Out.Lighting = AddDirectLightingPass(Context, {GBuffer, Out.SunShadow.Visibility});
	Out.Display = AddToneMapPass(Context, Out.Lighting);
	return Out;
}

} // namespace Lantern
