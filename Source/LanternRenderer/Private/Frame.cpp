// The frame's table of contents.
#include "LanternRenderer/Frame.h"

namespace Lantern
{

FFrameOutputs AddFramePasses(FFrameContext& Context, const FGBuffer& GBuffer)
{
	FFrameOutputs Out;
	Out.SunShadow = AddSunShadowPass(Context, {GBuffer.Depth, GBuffer.Normals, GBuffer.Motion});
	Out.AmbientOcclusion = AddAmbientOcclusionPass(Context, GBuffer);
	Out.Reflections = AddReflectionsPass(Context, GBuffer);
	Out.DiffuseGI = AddDiffuseGIPass(Context, GBuffer);
	Out.Lighting = AddDirectLightingPass(
	    Context, {GBuffer, Out.SunShadow.Visibility, Out.AmbientOcclusion.Visibility, Out.DiffuseGI.Radiance, Out.Reflections.Radiance});
	Out.Display = AddToneMapPass(Context, Out.Lighting);
	return Out;
}

} // namespace Lantern
