// The frame's table of contents.
#include "LanternRenderer/Frame.h"

#include "AmbientOcclusion/AmbientOcclusion.h"
#include "DebugView/DebugView.h"
#include "DiffuseGI/DiffuseGI.h"
#include "HeightFog/HeightFog.h"
#include "Lighting/DirectLighting.h"
#include "LocalLights/LocalLights.h"
#include "Reflections/Reflections.h"
#include "SunShadow/SunShadow.h"
#include "Transmission/Transmission.h"

namespace Lantern
{

FFrameOutputs AddFramePasses(FFrameContext& Context, const FGBuffer& GBuffer)
{
	FFrameOutputs Out;
	Out.Fog = AddFogShadowPass(Context);
	AddFogDepthPass(Context, GBuffer);
	Out.Get(ESignal::SunShadow) = AddSunShadowPass(Context, GBuffer);
	Out.Get(ESignal::LocalDiffuse) = AddLocalDiffusePass(Context, GBuffer);
	Out.Get(ESignal::LocalSpecular) = AddLocalSpecularPass(Context, GBuffer);
	Out.LightMask = AddLightMaskPass(Context, GBuffer);
	Out.Get(ESignal::AmbientOcclusion) = AddAmbientOcclusionPass(Context, GBuffer);
	Out.Get(ESignal::Reflections) = AddReflectionsPass(Context, GBuffer);
	Out.Transmission = AddTransmissionPass(Context, GBuffer);
	Out.IndirectVolume = AddIndirectVolumePass(Context, GBuffer);
	Out.Get(ESignal::DiffuseGI) = AddDiffuseGIPass(Context, GBuffer);
	Out.Get(ESignal::RoughSpecular) = AddRoughSpecularPass(Context, GBuffer);
	Out.Lighting =
	    AddDirectLightingPass(Context, {GBuffer, Out.Get(ESignal::SunShadow), Out.Get(ESignal::AmbientOcclusion),
	                                       Out.Get(ESignal::DiffuseGI), Out.Get(ESignal::Reflections), Out.Get(ESignal::RoughSpecular),
	                                       Out.Get(ESignal::LocalDiffuse), Out.Get(ESignal::LocalSpecular)});
	Out.Lighting = AddTransmissionComposite(Context, Out.Lighting, Out.Transmission);
	Out.Lighting = AddHeightFogPass(Context, GBuffer, Out.Lighting, Out.Fog, Out.IndirectVolume);
	Out.Display = AddToneMapPass(Context, Out.Lighting);
	Out.Display = AddDebugView(Context, GBuffer, Out);
	return Out;
}

} // namespace Lantern
