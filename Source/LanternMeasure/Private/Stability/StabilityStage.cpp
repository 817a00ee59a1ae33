// The stage of a stability case: scene, engine, frames and limits.
#include "LanternMeasure/Stability/StabilityStage.h"

#include <algorithm>
#include <cmath>

#include "LanternCore/FrameGraph/History.h"
#include "LanternHost/SceneLoader.h"

namespace Lantern
{

void FStabilityStage::Begin(ESignal InSignal, uint32_t InSeed, const FStabilityFault* InFault)
{
	Signal = InSignal;
	Seed = InSeed;
	Fault = InFault;
	Strip.clear();
}

FRTStatus FStabilityStage::Load(const std::string& Name)
{
	if (Name != LoadedScene)
	{
		LoadedScene.clear();
		FLoadResult Result = LoadScene(Name);
		if (!Result.Scene) { return FRTStatus::Error(ERTResult::InvalidArgument, "%s", Result.Error.c_str()); }
		Exposure = Result.Scene->DefaultExposure;
		if (FRTStatus S = Engine.Load(std::move(*Result.Scene)); !S) { return S; }
		LoadedScene = Name;
		(void)Engine.MoveTo(0.0); // so that a first frame of time 0 moves nothing that a case has moved
	}
	ResetState();
	return FRTStatus::Success();
}

FRTStatus FStabilityStage::LoadLit(const std::string& Scene)
{
	const bool bLamps = Signal == ESignal::LocalDiffuse || Signal == ESignal::LocalSpecular;
	return Load(Scene + (bLamps ? ":1" : ":0"));
}

void FStabilityStage::ResetState()
{
	FHostScene& Scene = Engine.GetScene();
	const FSceneDescription& Description = Scene.GetDescription();
	FSunLight Sun;
	Sun.AngularDiameter = glm::radians(Description.DefaultSunDiameter);
	if (Description.DefaultSun)
	{
		Sun.Direction = glm::dvec3(*Description.DefaultSun);
		Sun.Irradiance = Description.DefaultSun->w;
	}
	Scene.SetSun(Sun);
	Scene.GetScene().SetSky(Description.DefaultSky.value_or(glm::vec3(0)));
	if (Scene.IsAnimated()) { return; } // the time of each frame places what is in it
	const FScenePose Pose = EvaluatePose(Description, 0.0);
	for (size_t I = 0; I < Scene.GetInstanceCount(); ++I)
	{
		if (!Scene.IsSkinned(I)) { Scene.SetTransform(I, Pose.World[static_cast<size_t>(Scene.GetNode(I))]); }
	}
}

FView FStabilityStage::MakeView() const
{
	FView View = Engine.GetScene().MakeDefaultView(Settings.Width, Settings.Height);
	View.Seed = Seed;
	return View;
}

FView FStabilityStage::MakeView(glm::dvec3 Position, glm::dvec3 Target, float FovYDegrees) const
{
	FView View = LookAt(Position, Target, glm::radians(FovYDegrees), Settings.Width, Settings.Height);
	View.Near = Engine.GetScene().NearPlane();
	View.Seed = Seed;
	return View;
}

FRTStatus FStabilityStage::Play(const std::vector<FStabilityShot>& Shots, std::vector<FImage>& OutFrames, int Run)
{
	FMethodScope Broken;
	if (Fault && !Fault->Settings.empty())
	{
		const std::vector<std::string> Refused = Broken.Apply(Fault->Settings);
		if (!Refused.empty()) { return FRTStatus::Error(ERTResult::InvalidArgument, "planted fault: %s", Refused[0].c_str()); }
	}
	OutFrames.assign(Shots.size(), {});
	if (FRTStatus S = Engine.GetRenderer().WaitForAll(); !S) { return S; }
	Engine.GetRenderer().ClearHistories();
	Engine.SetFrameIndex(0);
	FFrameCapture Capture;
	Capture.Signals.Add(Signal);
	for (size_t I = 0; I < Shots.size(); ++I)
	{
		const FStabilityShot& Shot = Shots[I];
		if (Shot.Change) { Shot.Change(Engine.GetScene()); }
		if (!Shot.Poison.empty()) { Engine.GetRenderer().GetGraphResources().PoisonHistory(Shot.Poison == "*" ? "" : Shot.Poison); }
		FView View = Shot.View;
		View.Seed = Seed + 1000u * static_cast<uint32_t>(Run);
		View.bCut = View.bCut || I == 0;
		FCapturedFrame Frame;
		if (FRTStatus S = Engine.RenderFrame(View, Shot.Time, Capture, &Frame); !S) { return S; }
		if (!Shot.bKeep) { continue; }
		OutFrames[I] = std::move(Frame.Get(Signal));
		if (OutFrames[I].IsEmpty()) { return FRTStatus::Error(ERTResult::Unsupported, "the frame has no such signal"); }
	}
	bKeepsHistory = Engine.GetRenderer().GetHistoryBytes() > 0;
	return FRTStatus::Success();
}

FRTStatus FStabilityStage::GetReference(const FView& View, double Time, FSignalReference& Out, uint32_t Bounces)
{
	FSignalReferenceDesc Desc;
	Desc.View = View;
	Desc.View.Seed = 0;
	Desc.Time = Time;
	Desc.Signal = Signal;
	Desc.Samples = Settings.ReferenceSamples;
	Desc.Bounces = std::max(Settings.Bounces, Bounces);
	Desc.CacheFolder = Settings.CacheFolder;
	return GetSignalReference(Engine, Desc, Out);
}

void FStabilityStage::AddToStrip(const FImage& Frame, const FImage& Reference) { Strip.emplace_back(Frame, Reference); }

} // namespace Lantern
