// Choices of a frame that depend on console variables.
#include "FrameChoices.h"

#include "DebugView/DebugView.h"
#include "HeightFog/HeightFog.h"
#include "LanternCore/Config/ConsoleVariables.h"
#include "SignalPasses.h"
#include "Sky/SkyBake.h"

namespace Lantern
{

namespace
{
TRTConsoleVariable<bool> CVarAlphaTest(
    "r.RT.AlphaTest", true, "Alpha tests of masked materials, in raster and under rays. Off: masked surfaces are solid.");
TRTConsoleVariable<bool> CVarTransmission("r.RT.Transmission", true,
    "Light shines through materials that say so (glTF: transmission), in the picture, under rays, and to what lies behind. Blended ones "
    "(glTF: BLEND) show their layers. Off: the first are opaque, and the others are cut at half their opacity.");
TRTConsoleVariable<bool> CVarDiffuseTransmission("r.RT.DiffuseTransmission", true,
    "Light scatters through leaves, paper and cloth to their other side, where materials say so (glTF: "
    "KHR_materials_diffuse_transmission). "
    "Off: all their diffuse light leaves on the side that it arrives on.");
TRTConsoleVariable<bool> CVarScattering("r.RT.Transmission.Scattering", true,
    "Light is scattered within water and other volumes whose materials say so (glTF: KHR_materials_volume_scatter). Off: they absorb it.");
TRTConsoleVariable<int32_t> CVarMaterialOverride("r.RT.Material.Override", 0,
    "0: the scene's materials. 1: each a Lambert of its base colour, alpha test kept. 2: each a "
    "Lambert of 0.5.",
    {0, 2});
TRTConsoleVariable<bool> CVarPointShadows(
    "r.RT.Lights.Shadows.Point", true, "Point lights, spheres and tubes cast shadows. If off, they shine through everything.");
TRTConsoleVariable<bool> CVarSpotShadows("r.RT.Lights.Shadows.Spot", true,
    "Spot lights cast shadows: point lights, spheres and tubes with a cone. If off, they shine through everything.");
TRTConsoleVariable<bool> CVarRectShadows(
    "r.RT.Lights.Shadows.Rect", true, "Rectangles and disks cast shadows, with a cone or without. If off, they shine through everything.");

/// Bits of the kinds of lights that cast shadows. They tell the scene, and not the rays alone: the reference, fog and global illumination
/// have to agree with the shadows of local lights.
uint32_t GetCastingKinds()
{
	uint32_t Kinds = ~0u;
	const auto Drop = [&](const TRTConsoleVariable<bool>& Variable, ELightKind Kind) {
		if (!Variable.GetOnRenderThread()) { Kinds &= ~(1u << uint32_t(Kind)); }
	};
	Drop(CVarPointShadows, ELightKind::Point);
	Drop(CVarSpotShadows, ELightKind::Spot);
	Drop(CVarRectShadows, ELightKind::Rect);
	return Kinds;
}
} // namespace

void ApplySceneVariables(FRTScene& Scene)
{
	Scene.SetAlphaTest(CVarAlphaTest.GetOnRenderThread());
	Scene.SetTransmission(CVarTransmission.GetOnRenderThread());
	Scene.SetMaterialOverride(static_cast<uint32_t>(CVarMaterialOverride.GetOnRenderThread()));
	Scene.SetCastingLights(GetCastingKinds());
}

FSignalSet AllSignals()
{
	FSignalSet All;
	for (const FSignalInfo& Info : SignalInfos) { All.Add(Info.Signal); }
	return All;
}

FSignalRequests CompleteRequests(FSignalRequests Requests)
{
	if (Requests.bNothingElse) { return Requests; }
	Requests.Wanted.Add(GetDebugView());
	Requests.bTransmission = true;
	if (HasHeightFog())
	{
		Requests.bFog = Requests.bIndirectVolume = true;
		Requests.FogPhase = GetHeightFogPhase();
	}
	return Requests;
}

FSceneFacts AddFrameFacts(FSceneFacts Facts, const FFrameFeatures& Features, const FSignalRequests& Requests)
{
	Facts.bHostShadow = Features.bHostShadow;
	const bool bScatters = CVarDiffuseTransmission.GetOnRenderThread(), bInScene = bScatters && Facts.bDiffuseTransmission;
	Facts.bBackPixels = Features.BackAlbedo == EBackAlbedo::OfScene ? bInScene : bScatters && Features.BackAlbedo == EBackAlbedo::Always;
	Facts.bDiffuseTransmission = bInScene;
	Facts.bScattering = Facts.bScattering && CVarScattering.GetOnRenderThread();
	Facts.bSkyInPlace = Facts.bSkyProgram && (Features.bReference || !IsSkyBaked());
	Facts.bLightMask = Requests.bLightMask && Facts.Lights > 0;
	Facts.bMaskAlone = Facts.bLightMask && !IsAnyMadeBesideLightMask(Requests);
	return Facts;
}

bool WaitsForPipelines(const FFrameFeatures& Features)
{
	return Features.bWaitForPipelines || Features.bReference || GetPipelineFallback() == ERTFallback::Wait;
}

} // namespace Lantern
