// Exponential height fog with light shafts, over the composite.
#include "HeightFog/HeightFog.h"

#include "HeightFogTypes.h"
#include "Lighting/DirectLighting.h"
#include "PassTools.h"
#include "Sky/SkyLight.h"

namespace Lantern
{

namespace
{
TRTConsoleVariable<float> CVarDensity(
    "r.Fog.Density", 0.0f, "Fog of the sample engine: extinction at the height r.Fog.Height, per metre. 0: there is no fog.", {0, 100});
TRTConsoleVariable<float> CVarFalloff("r.Fog.HeightFalloff", 0.1f,
    "Rate, per metre, at which the fog thins out upwards: exp(-rate * height). 0: it is as dense everywhere.", {0, 10});
TRTConsoleVariable<float> CVarHeight("r.Fog.Height", 0.0f, "Height in the world at which the fog has its density, in metres.", {-1e5, 1e5});
TRTConsoleVariable<float> CVarAlbedo("r.Fog.Albedo", 0.9f, "Share of the light that fog scatters rather than absorbs.", {0, 1});
TRTConsoleVariable<float> CVarPhase(
    "r.Fog.Phase", 0.5f, "How forward the fog scatters: g of Henyey and Greenstein (1941). 0: alike in all directions.", {-0.99, 0.99});
TRTConsoleVariable<float> CVarSky("r.Fog.Sky", 1.0f,
    "Share of the sky's light that reaches the fog, which nothing shadows. Does not count where r.RT.GI.Volume says what arrives.", {0, 1});

FHeightFogConstants MakeConstants(const FFrameContext& Context)
{
	FHeightFogConstants C{};
	C.Pass = Context.Pass;
	C.Density = CVarDensity.GetOnRenderThread();
	C.Falloff = CVarFalloff.GetOnRenderThread();
	C.BaseHeight = static_cast<float>(double(CVarHeight.GetOnRenderThread()) - Context.Scene.GetOrigin().y);
	C.Albedo = CVarAlbedo.GetOnRenderThread();
	C.Phase = CVarPhase.GetOnRenderThread();
	C.Sky = CVarSky.GetOnRenderThread();
	return C;
}

/// A grid for marching alone.
FFogGrid MakeBareGrid()
{
	FFogGrid Grid{1, 1, 64, 8, 1, 250.0f};
	return Grid;
}
} // namespace

bool HasHeightFog() { return CVarDensity.GetOnRenderThread() > 0.0f; }
float GetHeightFogPhase() { return CVarPhase.GetOnRenderThread(); }

FShaderSource MakeHeightFogSource(const FSceneFacts& Facts)
{
	FShaderDefines Defines;
	if (Facts.bSun) { Defines.emplace_back("HAS_SUN", "1"); }
	if (HasSkyAmbient(Facts)) { Defines.emplace_back("HAS_SKY", "1"); }
	return MakeComputeSource("HeightFog/HeightFog.comp", std::move(Defines));
}

FGraphTexture AddHeightFogPass(
    FFrameContext& Context, const FGBuffer& GBuffer, FGraphTexture Lighting, const FFogAtlas& Fog, const FIndirectVolume& Volume)
{
	if (!HasHeightFog() || !Lighting.IsValid()) { return Lighting; }
	IRTPipeline* const Pipeline = RequireCompute(Context, MakeHeightFogSource(Context.Facts));
	if (!Pipeline) { return Lighting; }
	const FGraphTexture SkyLight = HasSkyAmbient(Context.Facts) ? AddSkyLightPass(Context) : FGraphTexture();
	const FGraphTexture Output = Context.Graph.CreateTexture({Context.Width, Context.Height, ERTFormat::RGBA32_FLOAT}, "HeightFog");
	const FFrameContext* const Frame = &Context;
	FHeightFogConstants Constants = MakeConstants(Context);
	Constants.Grid = Fog.IsValid() ? Fog.Grid : MakeBareGrid();
	Context.Graph.AddPass("HeightFog", [&](FPassBuilder& Builder) -> FPassExecute {
		for (const FGraphTexture Texture : {GBuffer.Depth, Lighting, SkyLight, Fog.Visibility, Fog.Light, Volume.Light, Volume.Moment})
		{
			if (Texture.IsValid()) { Builder.Read(Texture, ERTAccess::ShaderRead); }
		}
		Builder.Write(Output, ERTAccess::StorageWrite);
		return [=](FPassContext& Pass) {
			FHeightFogConstants C = Constants;
			C.Visibility = GetSampledIndex(Pass, Fog.Visibility);
			C.Light = GetSampledIndex(Pass, Fog.Light);
			C.VolumeGrid = Volume.Grid;
			C.VolumeLight = GetSampledIndex(Pass, Volume.Light);
			C.VolumeMoment = GetSampledIndex(Pass, Volume.Moment);
			C.Depth = GetSampledIndex(Pass, GBuffer.Depth);
			C.Lighting = GetSampledIndex(Pass, Lighting);
			C.SkyLight = GetSampledIndex(Pass, SkyLight);
			C.Output = GetStorageIndex(Pass, Output);
			Dispatch2D(Pass, Pipeline, C, Frame->Width, Frame->Height, HEIGHT_FOG_GROUP_SIZE);
		};
	});
	return Output;
}

} // namespace Lantern
