// FRenderer between frames: which shaders frames will run, and all of them compiled at load.
#include <cassert>

#include "DebugView/DebugView.h"
#include "FrameChoices.h"
#include "HeightFog/HeightFog.h"
#include "LanternCore/Config/ConsoleVariables.h"
#include "Lighting/DirectLighting.h"
#include "Lights/LightCells.h"
#include "Lights/LightCellsView.h"
#include "RayPrograms.h"
#include "Sky/SkyBake.h"
#include "Sky/SkyLight.h"
#include "ToneMap/ToneMap.h"
#include "Toon/Toon.h"
#include "Transmission/Transmission.h"

namespace Lantern
{

namespace
{
/// What AddFramePasses adds beside the signals.
void ListCompositeShaders(const FSceneFacts& Facts, std::vector<FShaderSource>& Out)
{
	Out.push_back(MakeLightingSource(Facts));
	ListLightCellShaders(Facts, Out);
	ListToonShaders(Facts, false, Out);
	ListTransmissionComposite(Facts, Out);
	if (HasHeightFog()) { Out.push_back(MakeHeightFogSource(Facts)); }
	Out.push_back(MakeToneMapSource());
	if (NeedsSkyLight(Facts) && HasSkyAmbient(Facts)) { Out.push_back(MakeSkyLightSource(Facts)); }
	if (GetDebugView() != ESignal::Frame) { Out.push_back(MakeDebugViewSource()); }
	if (IsDebugPicture(LightCellsPicture)) { Out.push_back(MakeLightCellsViewSource()); }
}
} // namespace

FRayPrograms FRenderer::ChoosePrograms(FRTScene& Scene, const FFrameFeatures& Features)
{
	assert(!Graph && "between frames");
	ApplySceneVariables(Scene);
	Scene.RefreshFacts();
	return ChooseRayPrograms(Device.GetCapabilities(), Scene, Features, CompleteRequests(Features.Signals), AllSignals());
}

FRTPSODesc FRenderer::GetRayPrograms(FRTScene& Scene, const FFrameFeatures& Features) { return ChoosePrograms(Scene, Features).Desc; }

bool FRenderer::FollowsMotion(FRTScene& Scene, const FFrameFeatures& Features) { return ChoosePrograms(Scene, Features).bMotion; }

bool FRenderer::HasBackPixels(FRTScene& Scene, const FFrameFeatures& Features)
{
	return AddFrameFacts(Scene.RefreshFacts(), Features, Features.Signals).bBackPixels;
}

FRTStatus FRenderer::Precache(FRTScene& Scene, const FFrameFeatures& Features, const std::function<void(float)>& Progress)
{
	FRayPrograms Wanted = ChoosePrograms(Scene, Features);
	if (!Features.bReference && !Features.Signals.bNothingElse)
	{
		ListCompositeShaders(AddFrameFacts(Scene.GetFacts(), Features, CompleteRequests(Features.Signals)), Wanted.Compute);
	}
	if (!Features.bReference) { ListSkyShaders(Scene.GetFacts(), Wanted.Compute); }
	Pipelines.Want(Wanted.Compute); // beside the ray-tracing pipeline
	const FRTPSODesc& Rays = Wanted.Desc;
	const size_t RayCount = Rays.RayGens.size() + Rays.RayTypes.size() * (1 + Rays.HitPrograms.size());
	const float RayShare = RayCount == 0 ? 0.0f : float(RayCount) / float(RayCount + Wanted.Compute.size());
	const auto Report = [&](float Begin, float Share) {
		return Progress ? std::function<void(float)>([=, &Progress](float Done) { Progress(Begin + Share * Done); }) : nullptr;
	};
	FRTStatus Status;
	if (!Rays.RayGens.empty()) { Status = RayCompiler.Finish(Rays, Report(0.0f, RayShare), !WaitsForPipelines(Features)); }
	const FRTStatus Compute = Pipelines.Finish(Wanted.Compute, Report(RayShare, 1.0f - RayShare));
	return Status ? Compute : Status;
}

std::string FRenderer::GetRayShaderKey(FRTScene& Scene, const FFrameFeatures& Features)
{
	const std::vector<FShaderSource> Sources = ListShaders(GetRayPrograms(Scene, Features), Programs);
	std::string Key;
	for (const FShaderSource& Source : Sources) { Key += Compiler.GetKey(Source) + "/"; }
	return Key;
}

} // namespace Lantern
