// Choices of a frame that depend on console variables.
#include "FrameChoices.h"

#include "DebugView/DebugView.h"
#include "HeightFog/HeightFog.h"
#include "LanternCore/Config/ConsoleVariables.h"
#include "SignalPasses.h"

namespace Lantern
{

namespace
{
TRTConsoleVariable<bool> CVarAlphaTest(
    "r.RT.AlphaTest", true, "Alpha tests of masked materials, in raster and under rays. Off: masked surfaces are solid.");
TRTConsoleVariable<int32_t> CVarMaterialOverride("r.RT.Material.Override", 0,
    "0: the scene's materials. 1: each a Lambert of its base colour, alpha test kept. 2: each a "
    "Lambert of 0.5.",
    {0, 2});
} // namespace

void ApplySceneVariables(FRTScene& Scene)
{
	Scene.SetAlphaTest(CVarAlphaTest.GetOnRenderThread());
	Scene.SetMaterialOverride(static_cast<uint32_t>(CVarMaterialOverride.GetOnRenderThread()));
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
	if (HasHeightFog())
	{
		Requests.bFog = true;
		Requests.FogPhase = GetHeightFogPhase();
	}
	return Requests;
}

FSceneFacts AddFrameFacts(FSceneFacts Facts, const FFrameFeatures& Features, const FSignalRequests& Requests)
{
	Facts.bHostShadow = Features.bHostShadow;
	Facts.bLightMask = Requests.bLightMask && Facts.Lights > 0;
	Facts.bMaskAlone = Facts.bLightMask && !IsAnyMadeBesideLightMask(Requests);
	return Facts;
}

bool WaitsForPipelines(const FFrameFeatures& Features)
{
	return Features.bWaitForPipelines || Features.bReference || GetPipelineFallback() == ERTFallback::Wait;
}

} // namespace Lantern
