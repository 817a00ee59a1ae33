// Our own composite for hosts that have none: direct light, emission, indirect light or the sky's ambient instead.
#include "Lighting/DirectLighting.h"

#include "LanternCore/Config/ConsoleVariables.h"
#include "LightingTypes.h"
#include "Lights/LightCells.h"
#include "Lights/PixelChannels.h"
#include "LocalLights/Emitters.h"
#include "PassTools.h"
#include "Sky/SkyLight.h"
#include "Toon/Toon.h"

namespace Lantern
{

namespace
{
TRTConsoleVariable<bool> CVarLocalLights(
    "r.RT.LocalLights", true, "Direct light of the scene's lights other than the sun; r.RT.Lights shadows it.");
TRTConsoleVariable<bool> CVarSkyAmbient("r.RT.SkyAmbient", true, "Ambient light of the sky, where indirect light is not traced.");
TRTConsoleVariable<float> CVarSurroundings("r.RT.SkyAmbient.Surroundings", 0.15f,
    "Share of light that surroundings reflect, where they stand in for global illumination and reflections that are not traced. What hides "
    "the sky from a surface is taken to be as open to sky and sun as the surface is. 0: it is black.",
    {0, 1});
} // namespace

bool HasLocalLight() { return CVarLocalLights.GetOnRenderThread(); }

bool HasSkyAmbient(const FSceneFacts& Facts) { return Facts.bSky && CVarSkyAmbient.GetOnRenderThread(); }

FShaderSource MakeLightingSource(FSceneFacts Facts)
{
	const bool bLights = CVarLocalLights.GetOnRenderThread();
	Facts.Lights = bLights ? Facts.Lights : 0;
	Facts.bAreaLights &= bLights;
	Facts.bLightProfiles &= bLights;
	Facts.bSky &= CVarSkyAmbient.GetOnRenderThread();
	Facts.bMasked = Facts.bSkyInPlace = Facts.bDiffuseTransmission = false; // nothing of it reaches lighting
	FShaderDefines Defines = MakeFactDefines(Facts);
	if (Facts.bSkyProgram) { Defines.emplace_back("SKY_IN_PLACE", "1"); } // a camera sees more than a map's texels
	if (bLights) { AddEmitterDefines(Facts, Defines); }
	if (Facts.bToon && AreToonStylesOn()) { Defines.emplace_back("HAS_TOON", "1"); }
	return MakeComputeSource("Lighting/DirectLighting.comp", std::move(Defines));
}

FGraphTexture AddDirectLightingPass(FFrameContext& Context, const FDirectLightingInputs& Inputs)
{
	IRTPipeline* const Pipeline = RequireCompute(Context, MakeLightingSource(Context.Facts));
	if (!Pipeline) { return {}; }
	const FGraphTexture SkyLight = HasSkyAmbient(Context.Facts) ? AddSkyLightPass(Context) : FGraphTexture();
	const FGraphTexture Output = Context.Graph.CreateTexture({Context.Width, Context.Height, ERTFormat::RGBA32_FLOAT}, "Lighting");
	// Either lobe without the other would be half of the light.
	const bool bShadowed = HasLocalLight() && Inputs.LightsDiffuse.IsValid() && Inputs.LightsSpecular.IsValid();
	const FGraphTexture LightsDiffuse = bShadowed ? Inputs.LightsDiffuse : FGraphTexture();
	const FGraphTexture LightsSpecular = bShadowed ? Inputs.LightsSpecular : FGraphTexture();
	const bool bVisitsLights = HasLocalLight() && !bShadowed;
	if (bVisitsLights) { RequireLightCells(Context, Inputs.GBuffer); }
	const FGraphTexture Channels = RequirePixelChannels(Context, Inputs.GBuffer);
	(void)RequireToonSurface(Context, Inputs.GBuffer);
	const FToonOfFrame Toon = Context.Toon;
	const FPassConstants PassConstants = Context.Pass;
	const float Surroundings = CVarSurroundings.GetOnRenderThread();
	const uint32_t Width = Context.Width, Height = Context.Height;
	Context.Graph.AddPass("DirectLighting", [&](FPassBuilder& Builder) -> FPassExecute {
		const FGBuffer& G = Inputs.GBuffer;
		for (const FGraphTexture Texture : {G.Depth, G.Normals, G.BaseColor, G.Material, G.Emissive})
		{
			Builder.Read(Texture, ERTAccess::ShaderRead);
		}
		for (const FGraphTexture Texture : {Inputs.SunVisibility, Inputs.SkyVisibility, Inputs.IndirectDiffuse, Inputs.IndirectSpecular,
		         Inputs.IndirectRough, SkyLight, LightsDiffuse, LightsSpecular, Channels, Toon.Normals, Toon.Pixels, G.BackAlbedo})
		{
			if (Texture.IsValid()) { Builder.Read(Texture, ERTAccess::ShaderRead); }
		}
		if (bVisitsLights) { ReadLightCells(Builder, Context.World->LightCells, false); }
		Builder.Write(Output, ERTAccess::StorageWrite);
		return [=](FPassContext& Pass) {
			const auto Sampled = [&](FGraphTexture Texture) { return GetSampledIndex(Pass, Texture); };
			FLightingConstants C{};
			C.Pass = PassConstants;
			C.Depth = Sampled(Inputs.GBuffer.Depth);
			C.Normals = Sampled(Inputs.GBuffer.Normals);
			C.BaseColor = Sampled(Inputs.GBuffer.BaseColor);
			C.Material = Sampled(Inputs.GBuffer.Material);
			C.Emissive = Sampled(Inputs.GBuffer.Emissive);
			C.SunVisibility = Sampled(Inputs.SunVisibility);
			C.SkyVisibility = Sampled(Inputs.SkyVisibility);
			C.IndirectDiffuse = Sampled(Inputs.IndirectDiffuse);
			C.IndirectSpecular = Sampled(Inputs.IndirectSpecular);
			C.IndirectRough = Sampled(Inputs.IndirectRough);
			C.SkyLight = Sampled(SkyLight);
			C.LightsDiffuse = Sampled(LightsDiffuse);
			C.LightsSpecular = Sampled(LightsSpecular);
			C.Channels = Sampled(Channels);
			C.ToonNormals = Sampled(Toon.Normals);
			C.ToonPixels = Sampled(Toon.Pixels);
			C.BackAlbedo = Sampled(Inputs.GBuffer.BackAlbedo);
			C.Surroundings = Surroundings;
			C.Output = Pass.GetTexture(Output)->GetStorageIndex();
			Dispatch2D(Pass, Pipeline, C, Width, Height, LIGHTING_GROUP_SIZE);
		};
	});
	return Output;
}

} // namespace Lantern
