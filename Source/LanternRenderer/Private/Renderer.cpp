// The frame from BeginFrame to EndFrame.
#include "LanternRenderer/Renderer.h"

#include <algorithm>
#include <atomic>
#include <cassert>
#include <cstring>
#include <utility>

#include "Feedback/AnyHitCounter.h"
#include "Feedback/PathRayCounter.h"
#include "Feedback/PixelExplainer.h"
#include "Feedback/RadianceAuditor.h"
#include "Feedback/RadianceCellCounter.h"
#include "Feedback/ReflectionCounter.h"
#include "Feedback/StandInFeedback.h"
#include "FrameChoices.h"
#include "HalfFrame/HalfFrame.h"
#include "LanternCore/Config/ConsoleVariables.h"
#include "LanternCore/FrameGraph/History.h"
#include "LanternCore/Tasks/TaskTrace.h"
#include "LanternCore/Tasks/WaitAwake.h"
#include "LanternCore/Text/Log.h"
#include "LanternRenderer/Frame.h"
#include "Lights/EmissiveTriangles.h"
#include "Lights/LightCells.h"
#include "RadianceCells/RadianceEvents.h"
#include "RayPrograms.h"
#include "Rays/RayQueueCounter.h"
#include "Rays/RayQueueDemand.h"
#include "SignalPasses.h"
#include "Skinning/RefitQuality.h"
#include "Sky/SkyBake.h"
#include "Tiles/MovedCasters.h"

namespace Lantern
{

namespace
{
TRTConsoleVariable<float> CVarAwakeMs("r.RT.Pipeline.AwakeMs", 20.0f,
    "Longest time, in milliseconds, for which a frame waits for the GPU without sleep while pipelines compile. A thread that sleeps "
    "beside compiling threads can be woken milliseconds late. 0: the frame sleeps. CPU devices always sleep.",
    {0, 1000});
TRTConsoleVariable<bool> CVarPrebind("r.RT.SBT.Prebind", true,
    "Shader records are written by a task beside the frame. Off: on the render thread, where the table is recorded.");
TRTConsoleVariable<int32_t> CVarPoisonHistory("r.RT.Debug.PoisonHistory", 0,
    "Every N-th frame overwrites all that frames keep for later ones with bits that are not-a-number: a test "
    "of what guards against them. 0: never.",
    {0, 1000000});
// A hang, surely: drivers that have a watchdog report a lost device long before, and a CPU takes minutes for what is brute force.
constexpr uint64_t WaitNs = 1'200'000'000'000ull;
} // namespace

FRenderer::FRenderer(IRTDevice& InDevice, FRendererDesc Desc)
    : Device(InDevice),
      Compiler(FShaderCompilerDesc{std::move(Desc.ShaderFolders), Desc.CacheFolder, std::move(Desc.ShaderHeaders)}),
      Pipelines(InDevice, Compiler),
      Uploads(InDevice),
      GraphResources(InDevice),
      RefitQuality(std::make_unique<FRefitQuality>(InDevice)),
      ShaderTable(InDevice),
      AnyHits(std::make_unique<FAnyHitCounter>(InDevice)),
      CellCounter(std::make_unique<FRadianceCellCounter>(InDevice)),
      CellAuditor(std::make_unique<FRadianceAuditor>(InDevice)),
      ReflectionCounter(std::make_unique<FReflectionCounter>(InDevice)),
      PathRayCounter(std::make_unique<FPathRayCounter>(InDevice)),
      Explainer(std::make_unique<FPixelExplainer>(InDevice)),
      Sky(std::make_unique<FSkyBake>(InDevice)),
      RayCompiler(InDevice, Compiler, Programs),
      StandIns(std::make_unique<FStandInFeedback>(InDevice)),
      QueueDemand(std::make_unique<FRayQueueDemand>(InDevice)),
      RayCounter(std::make_unique<FRayQueueCounter>(InDevice))
{
	StartWorkers(); // not in the first frame
	if (!FTaskTrace::HasFolder()) { FTaskTrace::SetFolder(Desc.CacheFolder); }
	FTaskTrace::StartIfWanted();
}

FRenderer::~FRenderer()
{
	// A lost device has nothing left to wait for.
	(void)WaitForAll();
	FTaskTrace::Flush();
}

FRTStatus FRenderer::WaitForAll()
{
	PrebindTask.Wait();
	for (const FRTFence Fence : Fences)
	{
		if (FRTStatus S = Device.WaitFor(Fence, WaitNs); !S) { return S; }
	}
	AnyHits->TakeAll();
	CellCounter->TakeAll();
	CellAuditor->TakeAll();
	ReflectionCounter->TakeAll();
	PathRayCounter->TakeAll();
	Explainer->TakeAll();
	RayCounter->TakeAll();
	return FRTStatus::Success();
}

const FAnyHitCounts& FRenderer::GetAnyHits() const { return AnyHits->Get(); }
const FRadianceCellCounts& FRenderer::GetRadianceCells() const { return CellCounter->Get(); }
const FRadianceAudit& FRenderer::GetRadianceAudit() const { return CellAuditor->Get(); }
const FReflectionCounts& FRenderer::GetReflectionCounts() const { return ReflectionCounter->Get(); }
const FPathRayCounts& FRenderer::GetPathRayCounts() const { return PathRayCounter->Get(); }
const FPixelExplanation& FRenderer::GetPixelExplanation() const { return Explainer->Get(); }
const FRayCounts& FRenderer::GetRayCounts() const { return RayCounter->Get(); }

FRTStatus FRenderer::WaitForFlight()
{
	static_assert(MaxInFlight == TReadbackRing<int>::FramesInFlight);
	FlightIndex = (FlightIndex + 1) % MaxInFlight;
	const FRTFence Fence = Fences[FlightIndex];
	if (RayCompiler.GetStats().bBusy && !Device.GetCapabilities().bIsCpu)
	{
		WaitAwake([&] { return Device.GetCompletedFence(GetFenceQueue(Fence)) >= Fence; }, CVarAwakeMs.GetOnRenderThread());
	}
	return Device.WaitFor(Fence, WaitNs);
}

namespace
{
FSignalSet GetReadySignals(const FFrameContext& Context)
{
	FSignalSet Ready;
	ForEachSignalPass([&](const FSignalPass& Pass) {
		if (Context.GetRayGen(Pass.Signal) != NoRayGen) { Ready.Add(Pass.Signal); }
	});
	return Ready;
}

} // namespace

FRTStatus FRenderer::PrepareRayPipeline(const FRayPrograms& Wanted)
{
	Context->RayPipeline = nullptr;
	bStandIns = false;
	bRaysReady = Wanted.Desc.RayGens.empty();
	if (bRaysReady)
	{
		RayPipeline.reset();
		Context->Scene.SetMissingPrograms({}); // ray queries run none
		return FRTStatus::Success();
	}
	if (Context->bWaitForPipelines)
	{
		if (FRTStatus S = RayCompiler.Finish(Wanted.Desc); !S) { return S; }
	}
	else
	{
		RayCompiler.SetPriorities(StandIns->GetPriorities());
		RayCompiler.Update(Wanted.Desc);
	}
	RayPipeline = RayCompiler.GetCurrent();
	if (!RayPipeline)
	{
		Context->Scene.SetMissingPrograms({});
		return FRTStatus::Success();
	}
	const auto IsReady = [&](FHitProgram Program) { return RayPipeline->GetState(Program) == ERTHitState::Ready; };
	bStandIns = !std::all_of(Wanted.Desc.HitPrograms.begin(), Wanted.Desc.HitPrograms.end(), IsReady);
	std::vector<FHitProgram> Missing = Wanted.Desc.HitPrograms;
	std::erase_if(Missing, [&](FHitProgram Program) { return !RayPipeline->IsMissing(Program); });
	Context->Scene.SetMissingPrograms(std::move(Missing));
	Context->RayPipeline = RayPipeline.get();
	Context->RayTable = &ShaderTable;
	// Until a variant for this frame's settings is ready, the one before serves.
	for (size_t I = 0; I < Wanted.RayGens.size(); ++I)
	{
		if (!Wanted.RayGens[I]) { continue; }
		const bool bExact = I == ToIndex(ESignal::Frame); // the reference
		Context->RayGens[I] = bExact ? RayPipeline->FindRayGen(*Wanted.RayGens[I]) : RayPipeline->FindRayGenVariant(*Wanted.RayGens[I]);
	}
	for (size_t I = 0; I < PassRayGenCount; ++I)
	{
		if (Wanted.PassRayGens[I]) { Context->PassRayGens[I] = RayPipeline->FindRayGenVariant(*Wanted.PassRayGens[I]); }
	}
	const auto HasRayGen = [&](const FShaderSource& RayGen) { return RayPipeline->FindRayGen(RayGen) != NoRayGen; };
	bRaysReady = !bStandIns && std::all_of(Wanted.Desc.RayGens.begin(), Wanted.Desc.RayGens.end(), HasRayGen);
	Context->Scene.SetRayTypes(RayPipeline->GetRayTypeCount());
	return FRTStatus::Success();
}

const std::vector<FProgramPriority>& FRenderer::GetProgramPriorities() const { return StandIns->GetPriorities(); }

FRTStatus FRenderer::BeginFrame(FRTScene& Scene, const FView& View, const FFrameFeatures& Features)
{
	assert(!Context && "EndFrame, or FrameSubmitted behind it, was not called");
	bFrameLost = true;
	FTaskTrace::BeginFrame(View.FrameIndex);
	FTraceScope Trace("BeginFrame");
	if (FRTStatus S = WaitForFlight(); !S) { return S; }
	for (const FFrameTiming& Timing : GraphResources.TakeFrameTimings()) { RayCompiler.FrameDone(Timing.Frame, Timing.GpuMs); }
	ApplySceneVariables(Scene);
	FrameStatus = FRTStatus::Success();
	Graph = std::make_unique<FFrameGraph>(GraphResources);
	Context.reset(new FFrameContext{{}, Device, *Graph, Scene, Pipelines, Scene.RefreshFacts()});
	Context->Signals = CompleteRequests(Features.Signals);
	Context->Facts = AddFrameFacts(Context->Facts, Features, Context->Signals);
	Context->World = std::make_shared<FWorldOfFrame>();
	Context->View = View;
	Context->Width = View.Width;
	Context->Height = View.Height;
	Context->Status = &FrameStatus;
	Context->Owner = this;
	Context->QueueDemand = QueueDemand.get();
	Context->RayCounter = RayCounter.get();
	Context->Tokens = {Graph->CreateToken("Tables"), Graph->CreateToken("Vertices"), Graph->CreateToken("Structures"),
	    Graph->CreateToken("Records"), Graph->CreateToken("Sky")};
	Context->bWaitForPipelines = WaitsForPipelines(Features);
	Pipelines.BeginFrame();
	FindPreviousView(Scene, Features);
	const bool bSameWorld = State->LastScene == Scene.GetSections().GetIdentity();
	for (FHistoryResources* const History : {State->History.get(), State->HalfHistory.get()})
	{
		History->BeginFrame(*Graph, Context->PreviousView != nullptr, bSameWorld);
	}
	const int32_t PoisonEvery = CVarPoisonHistory.GetOnRenderThread();
	if (PoisonEvery > 0 && View.FrameIndex % static_cast<uint32_t>(PoisonEvery) == 0) { GraphResources.PoisonHistory(""); }
	bUpdating = bRayPassesAdded = false;
	BeginFeedback();
	const FRayPrograms Wanted =
	    ChooseRayPrograms(Device.GetCapabilities(), Scene, Features, Context->Signals, Context->bWaitForPipelines ? AllSignals() : Ready);
	if (!Context->bWaitForPipelines) { Pipelines.Want(Wanted.Compute); } // all at once, not one when its pass is added
	FRTStatus Status = PrepareRayPipeline(Wanted);
	Ready = GetReadySignals(*Context);
	bSkinningLeftOut = !Features.Skinning.empty() && !IsSkinningReady(*Context);
	if (Status) { Status = FrameStatus; }
	if (Status) { Status = StartUpdate(View, Wanted, Features); }
	if (Status) { Status = AllocateConstants(); }
	if (Status) { Status = Sky->AddPasses(*Context, Uploads, Features.ViewIndex, !Context->Signals.bNothingElse || Wanted.bLightSampling); }
	if (Status && !bSkinningLeftOut) { Status = AddSkinningPass(*Context, Uploads, Features.Skinning, FrameUse.bMotion); }
	if (!Status)
	{
		DropFrame();
		return Status;
	}
	StartCounting();
	AddTables();
	if (FRTStatus S = AddEmissivePass(*Context, Uploads); !S) { Context->Fail(S); }
	if (Features.bRays && !Features.bLateRays) { AddRayPasses(); }
	return FRTStatus::Success();
}

/// As early as can be: what it starts has the rest of the frame's making to be done in.
FRTStatus FRenderer::StartUpdate(const FView& View, const FRayPrograms& Wanted, const FFrameFeatures& Features)
{
	FRTScene& Scene = Context->Scene;
	if (!bSkinningLeftOut)
	{
		for (const FSkinningInputs& Item : Features.Skinning) { Scene.MarkDeformed(Item.Geometry); }
	}
	FrameUse = {};
	// Structures are built while the shaders that trace them are compiled.
	FrameUse.bRays = Features.bRays || Wanted.bQueries || !Wanted.Desc.RayGens.empty();
	FrameUse.bLightSampling = Wanted.bLightSampling && AreEmissiveShadersReady(*Context);
	FrameUse.bCull = !Features.bReference;
	FrameUse.bMotion = Context->bMotion = Wanted.bMotion;
	FrameUse.bBuildAll = Features.bBuildAll || Features.bReference;
	const FGatherView Gather = MakeGatherView(View);
	bUpdating = Scene.NeedsUpdate(Gather, FrameUse);
	if (bUpdating)
	{
		if (FRTStatus S = Scene.BeginUpdate(Gather, FrameUse); !S) { return S; }
	}
	StartPrebind();
	return FRTStatus::Success();
}

void FRenderer::StartPrebind()
{
	Prebind = !Context->RayPipeline ? EPrebind::None : CVarPrebind.GetOnRenderThread() ? EPrebind::Running : EPrebind::InLine;
	if (Prebind != EPrebind::Running) { return; }
	PrebindTask.Run([this, Pipeline = RayPipeline, Sections = &Context->Scene.GetSections()] {
		FTraceScope Trace("Prebind");
		PrebindStatus = ShaderTable.Prepare(*Pipeline, *Sections);
	});
}

FRTStatus FRenderer::FinishPrebind()
{
	if (Prebind == EPrebind::InLine)
	{
		FTraceScope Trace("Shader records");
		PrebindStatus = ShaderTable.Prepare(*RayPipeline, Context->Scene.GetSections());
	}
	else if (Prebind == EPrebind::Running)
	{
		FTraceScope Trace("Wait for prebind");
		PrebindTask.Wait();
	}
	Prebind = EPrebind::None;
	return PrebindStatus;
}

FRTStatus FRenderer::AllocateConstants()
{
	if (FRTStatus S = Uploads.Allocate(sizeof(FSceneConstants), SceneConstants); !S) { return S; }
	if (FRTStatus S = Uploads.Allocate(sizeof(FViewConstants), ViewConstants); !S) { return S; }
	Context->Pass = {SceneConstants.Address, ViewConstants.Address};
	return FRTStatus::Success();
}

void FRenderer::WriteConstants()
{
	FSceneConstants OfScene = Context->Scene.GetConstants();
	OfScene.AnyHitCounter = AnyHits->GetCounters().GetAddress();
	OfScene.PathRayStatistics = PathRayCounter->GetCounters().GetAddress();
	OfScene.LightCells = Context->World->LightCells.Address;
	Sky->FillConstants(OfScene);
	OfScene.StandInHits = StandIns->GetCounters().GetAddress();
	FViewConstants OfView = MakeViewConstants(Context->View, Context->Scene.GetOrigin(), Context->PreviousView);
	OfView.FrameIndex = State->Turn;
	std::memcpy(SceneConstants.Data, &OfScene, sizeof(OfScene));
	std::memcpy(ViewConstants.Data, &OfView, sizeof(OfView));
	if (Context->Half) { WriteHalfConstants(*Context->Half, OfView.FrameIndex); }
}

void FRenderer::KeepHistory(bool bSubmitted)
{
	State->History->EndFrame(bSubmitted);
	State->HalfHistory->EndFrame(bSubmitted);
	Sky->EndFrame(bSubmitted);
	State->Casters->EndFrame(bSubmitted);
	State->RadianceEvents->EndFrame(bSubmitted);
	State->LastScene = bSubmitted ? Context->Scene.GetSections().GetIdentity() : 0;
	State->LastView = Context->View;
	if (bSubmitted) { State->Published = FConsoleVariables::Get().GetPublishCount(); }
	for (auto& [Index, Other] : Views) { Other.IdleFrames = &Other == State ? 0 : Other.IdleFrames + 1; }
	std::erase_if(Views, [](const auto& Entry) { return Entry.second.IdleFrames >= KeptIdleFrames; });
	State = nullptr;
}

FRenderer::FViewState& FRenderer::GetView(uint32_t Index)
{
	FViewState& View = Views[Index];
	if (!View.History)
	{
		static std::atomic<uint64_t> LastViewer = 0; // 0 is nobody's
		View.History = std::make_unique<FHistoryResources>(Device);
		View.HalfHistory = std::make_unique<FHistoryResources>(Device);
		View.LightCells = std::make_unique<FLightCells>(Device);
		View.Casters = std::make_unique<FMovedCasters>();
		View.RadianceEvents = std::make_unique<FRadianceEvents>();
		View.Viewer = ++LastViewer;
	}
	return View;
}

void FRenderer::ClearHistories(uint32_t ViewIndex)
{
	GetView(ViewIndex).History->Clear();
	GetView(ViewIndex).HalfHistory->Clear();
}

std::vector<std::pair<std::string, uint64_t>> FRenderer::GetHistoryParts(uint32_t ViewIndex)
{
	std::vector<std::pair<std::string, uint64_t>> Parts = GetView(ViewIndex).History->GetParts();
	for (auto& [Name, Bytes] : GetView(ViewIndex).HalfHistory->GetParts()) { Parts.emplace_back(Name + ".Half", Bytes); }
	return Parts;
}

uint64_t FRenderer::GetHistoryBytes(uint32_t ViewIndex)
{
	return GetView(ViewIndex).History->GetBytes() + GetView(ViewIndex).HalfHistory->GetBytes();
}

/// Where the motion of objects is followed, motions must lead back to this view's own last frame. A host with motion vectors of its
/// own knows by itself.
void FRenderer::FindPreviousView(FRTScene& Scene, const FFrameFeatures& Features)
{
	State = &GetView(Features.ViewIndex);
	// Of two views in turn each has every other number, and samplers and turns of pixels would know but half of theirs.
	const bool bNext = State->LastView.Width > 0 && Context->View.FrameIndex - State->LastView.FrameIndex == State->IdleFrames + 1;
	State->Turn = bNext ? State->Turn + 1 : Context->View.FrameIndex;
	[[maybe_unused]] const FConsoleVariables& Variables = FConsoleVariables::Get();
	assert((Variables.GetPublishCount() != State->Published || !Variables.HasUnpublished()) &&
	       "FConsoleVariables::BeginFrame was not called since the view's last frame");
	const bool bFollowed = Scene.SetViewer(State->Viewer);
	const bool bSameScene = State->LastScene == Scene.GetSections().GetIdentity() && (bFollowed || !Features.bMotion);
	PreviousView = Features.PreviousView.value_or(State->LastView);
	PreviousView.Width = State->LastView.Width;
	PreviousView.Height = State->LastView.Height;
	const bool bUsable = bSameScene && State->LastView.Width > 0 && !Context->View.bCut && !Features.bReference;
	Context->PreviousView = bUsable ? &PreviousView : nullptr;
	Context->History = Context->World->History = State->History.get();
	Context->HalfHistory = State->HalfHistory.get();
	Context->World->LightCells.OfView = State->LightCells.get();
	Context->MovedCasters = State->Casters.get();
	Context->RadianceEvents = State->RadianceEvents.get();
}

/// Before anything of the frame can fail: what the GPU has left is taken, and the next frame finds its place.
void FRenderer::BeginFeedback()
{
	AnyHits->BeginFrame(FlightIndex);
	CellCounter->BeginFrame(FlightIndex);
	CellAuditor->BeginFrame(FlightIndex);
	ReflectionCounter->BeginFrame(FlightIndex);
	PathRayCounter->BeginFrame(FlightIndex);
	Explainer->BeginFrame(FlightIndex);
	StandIns->BeginFrame(FlightIndex, Context->Scene);
	QueueDemand->BeginFrame(FlightIndex);
	State->LightCells->BeginFrame(FlightIndex);
	RayCounter->BeginFrame(FlightIndex);
	RefitQuality->BeginFrame(FlightIndex, Context->Scene.GetGeometries());
}

/// A counter without memory counts nothing; the frame goes on.
void FRenderer::StartCounting()
{
	FRTStatus Status = AnyHits->Start();
	if (Status) { Status = CellCounter->Start(AreRadianceCellsCounted()); }
	if (Status) { Status = CellAuditor->Start(); }
	if (Status) { Status = ReflectionCounter->Start(ArePathEndsCounted()); }
	if (Status) { Status = PathRayCounter->Start(ArePathRaysCounted()); }
	if (Status) { Status = Explainer->Start(GetExplainedPixel().has_value()); }
	if (Status && bStandIns) { Status = StandIns->Start(Context->Scene, Context->View.Position); }
	if (!Status) { LogOnce(ERTLogLevel::Warning, std::string("rays are not counted: ") + Status.Message); }
	AnyHits->GetCounters().AddClear(*Graph);
	CellCounter->GetCounters().AddClear(*Graph);
	Context->RadianceCellStatistics = CellCounter->GetCounters().GetAddress();
	CellAuditor->GetCounters().AddClear(*Graph);
	Context->RadianceAudit = CellAuditor->GetCounters().GetAddress();
	ReflectionCounter->GetCounters().AddClear(*Graph);
	PathRayCounter->GetCounters().AddClear(*Graph);
	Context->ReflectionStatistics = ReflectionCounter->GetCounters().GetAddress();
	Explainer->GetCounters().AddClear(*Graph);
	Context->ExplainedPixel = Explainer->GetCounters().GetAddress();
	StandIns->GetCounters().AddClear(*Graph);
}

void FRenderer::EndFeedback(bool bSubmitted)
{
	AnyHits->GetCounters().EndFrame(bSubmitted);
	CellCounter->GetCounters().EndFrame(bSubmitted);
	CellAuditor->GetCounters().EndFrame(bSubmitted);
	ReflectionCounter->GetCounters().EndFrame(bSubmitted);
	PathRayCounter->GetCounters().EndFrame(bSubmitted);
	Explainer->GetCounters().EndFrame(bSubmitted);
	StandIns->GetCounters().EndFrame(bSubmitted);
	QueueDemand->EndFrame(bSubmitted);
	State->LightCells->EndFrame(bSubmitted);
	RayCounter->EndFrame(bSubmitted);
	RefitQuality->EndFrame(Context->Scene.GetGeometries(), bSubmitted);
}

/// A frame that was begun and cannot go on.
void FRenderer::DropFrame()
{
	PrebindTask.Wait();
	Graph.reset();
	if (bUpdating) { Context->Scene.EndFrame(false); }
	EndFeedback(false);
	KeepHistory(false);
	Context.reset();
	Uploads.EndFrame(0); // nothing reads them
}

FFrameContext& FRenderer::GetContext()
{
	assert(Context && "only between BeginFrame and EndFrame");
	return *Context;
}

void FRenderer::FrameSubmitted(FRTFence Fence)
{
	// A frame that ended before anything of it was recorded still has them.
	PrebindTask.Wait();
	Graph.reset();
	Fences[FlightIndex] = Fence;
	if (Fence != 0) { LastGraph = Fence; }
	if (Fence != 0) { RayCompiler.FrameSubmitted(GraphResources.GetFrame()); }
	Uploads.EndFrame(Fence);
	Context->Scene.EndFrame(Fence != 0, Fence);
	EndFeedback(Fence != 0);
	KeepHistory(Fence != 0);
	Context.reset();
	bFrameLost = Fence == 0;
	if (!bFrameLost) { return; }
	ShaderTable.Invalidate();
	// The pool believes that its textures are in the layouts which the lost list would have left them in.
	GraphResources.Trim(0);
}

} // namespace Lantern
