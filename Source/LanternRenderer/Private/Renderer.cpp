#include "LanternRenderer/Renderer.h"

#include <cassert>
#include <chrono>
#include <cstring>

#include "LanternCore/ConsoleVariables.h"
#include "LanternCore/Log.h"
#include "LanternRenderer/Frame.h"
#include "PassTools.h"
#include "RayPrograms.h"

namespace Lantern
{

namespace
{
TRTConsoleVariable<bool> CVarAlphaTest("r.RT.AlphaTest", true, "Alpha tests of masked materials, in raster and under rays. Off: masked surfaces are solid.");
TRTConsoleVariable<int32_t> CVarMaterialOverride("r.RT.Material.Override", 0,
                                                 "0: the scene's materials. 1: each a Lambert of its base colour, alpha test kept. 2: each a "
                                                 "Lambert of 0.5.",
                                                 {0, 2});
constexpr uint64_t WaitNs = 120'000'000'000ull;
} // namespace

FRenderer::FRenderer(IRTDevice& InDevice, FRendererDesc Desc)
    : Device(InDevice), Compiler(FShaderCompilerDesc{std::move(Desc.ShaderFolders), std::move(Desc.CacheFolder)}), Pipelines(InDevice, Compiler),
      Uploads(InDevice), GraphResources(InDevice), Bindings(InDevice)
{
}

FRenderer::~FRenderer()
{
	// A lost device has nothing left to wait for.
	(void)WaitForAll();
}

FRTStatus FRenderer::WaitForAll()
{
	for (const FRTFence Fence : Fences)
	{
		if (FRTStatus S = Device.WaitFor(Fence, WaitNs); !S) { return S; }
	}
	return FRTStatus::Success();
}

FRTStatus FRenderer::WaitForSlot()
{
	Slot = (Slot + 1) % MaxInFlight;
	if (FRTStatus S = Device.WaitFor(Fences[Slot], WaitNs); !S) { return S; }
	if (Lists[Slot]) { return FRTStatus::Success(); }
	return Device.CreateCommandList("Frame", Lists[Slot].ReleaseAndGetAddress());
}

FRTStatus FRenderer::PrepareRayPipeline(const FFrameFeatures& Features)
{
	Context->RayPipeline = nullptr;
	const FRayPrograms Wanted = ChooseRayPrograms(Device.GetCapabilities(), Context->Facts, Features);
	if (Wanted.Desc.RayGens.empty())
	{
		RayPipeline.reset();
		return FRTStatus::Success();
	}
	FRayPipelineEntry& Entry = RayPipelines[MakeRayProgramsKey(Wanted.Desc)];
	// What the compiler refused once it refuses again; what failed for want of memory may be tried again.
	if (Entry.Status.Code == ERTResult::CompileFailed) { return Entry.Status; }
	if (!Entry.Pipeline)
	{
		const auto Start = std::chrono::steady_clock::now();
		auto Pipeline = std::make_shared<FRTPSO>();
		Entry.Status = FRTPSO::Create(Device, Compiler, Programs, Wanted.Desc, *Pipeline);
		if (!Entry.Status) { return Entry.Status; }
		Entry.Pipeline = std::move(Pipeline);
		LastPipelineMs = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - Start).count();
	}
	RayPipeline = Entry.Pipeline;
	Context->RayPipeline = RayPipeline.get();
	Context->RayBindings = &Bindings;
	Context->SunShadowRayGen = Wanted.SunShadowRayGen;
	Context->ReferenceRayGen = Wanted.ReferenceRayGen;
	Context->Scene.SetRayTypes(RayPipeline->GetRayTypeCount());
	return FRTStatus::Success();
}

FRTStatus FRenderer::BeginFrame(FRTScene& Scene, const FView& View, const FFrameFeatures& Features)
{
	assert(!Graph && "EndFrame was not called");
	bFrameLost = true;
	FConsoleVariables::Get().BeginFrame();
	if (FRTStatus S = WaitForSlot(); !S) { return S; }
	Scene.SetAlphaTest(CVarAlphaTest.GetOnRenderThread());
	Scene.SetMaterialOverride(static_cast<uint32_t>(CVarMaterialOverride.GetOnRenderThread()));
	FrameStatus = FRTStatus::Success();
	Graph = std::make_unique<FFrameGraph>(GraphResources);
	Context.reset(new FFrameContext{Device, *Graph, Scene, Pipelines, Scene.RefreshFacts()});
	Context->View = View;
	Context->Width = View.Width;
	Context->Height = View.Height;
	Context->Status = &FrameStatus;
	FRTStatus Status = PrepareRayPipeline(Features);
	if (Status) { Status = AddSceneUpdate(View, Features); }
	if (!Status)
	{
		Graph.reset();
		Context.reset();
		Uploads.EndFrame(0); // nothing reads them
	}
	return Status;
}

FRTStatus FRenderer::AddSceneUpdate(const FView& View, const FFrameFeatures& Features)
{
	FUploadSlice SceneSlice, ViewSlice;
	if (FRTStatus S = Uploads.Allocate(sizeof(FSceneConstants), SceneSlice); !S) { return S; }
	if (FRTStatus S = Uploads.Allocate(sizeof(FViewConstants), ViewSlice); !S) { return S; }
	Context->Pass = {SceneSlice.Address, ViewSlice.Address};
	FFrameContext* const Frame = Context.get();
	const auto WriteConstants = [=] {
		const FSceneConstants SceneConstants = Frame->Scene.GetConstants();
		const FViewConstants ViewConstants = MakeViewConstants(View, Frame->Scene.GetOrigin());
		std::memcpy(SceneSlice.Data, &SceneConstants, sizeof(SceneConstants));
		std::memcpy(ViewSlice.Data, &ViewConstants, sizeof(ViewConstants));
	};
	if (FRTStatus S = AddSkinningPass(*Frame, Uploads, Features.Skinning); !S) { return S; }
	const bool bQueries = ChooseSunShadowPath(Device.GetCapabilities(), Frame->Facts) == ESunShadowPath::Query;
	const FSceneUse Use{Features.bRays || bQueries || Frame->RayPipeline, Features.bReference};
	if (Frame->Scene.NeedsUpdate(View.Position, Use))
	{
		Graph->AddPass("SceneUpdate", [&](FPassBuilder& Builder) -> FPassExecute {
			Builder.NeverCull();
			return [=, this](FPassContext& Pass) {
				if (FRTStatus S = Frame->Scene.Update(Pass.Commands(), Uploads, View.Position, Use); !S) { Frame->Fail(S); }
				WriteConstants();
			};
		});
	}
	else { WriteConstants(); }
	if (Frame->RayPipeline)
	{
		Graph->AddPass("ShaderTable", [&](FPassBuilder& Builder) -> FPassExecute {
			Builder.NeverCull();
			return [=, this](FPassContext& Pass) {
				if (FRTStatus S = Bindings.Sync(Pass.Commands(), *Frame->RayPipeline, Frame->Scene.GetSections()); !S) { Frame->Fail(S); }
			};
		});
	}
	return FRTStatus::Success();
}

FFrameContext& FRenderer::GetContext()
{
	assert(Context && "only between BeginFrame and EndFrame");
	return *Context;
}

FRTStatus FRenderer::Execute(IRTCommandList& List)
{
	assert(Graph);
	FRTStatus Status = FrameStatus;
	if (Status) { Status = Graph->Execute(List, &FrameStatus); }
	if (Status) { LastDump = Graph->Dump(); }
	Graph.reset();
	return Status;
}

FRTStatus FRenderer::EndFrame(FRTFence* OutFence)
{
	IRTCommandList& List = *Lists[Slot];
	FRTStatus Status = List.Begin();
	if (Status)
	{
		Status = Execute(List);
		const FRTStatus Ended = List.End();
		if (Status) { Status = Ended; }
	}
	Graph.reset();
	FRTFence Fence = 0;
	if (Status)
	{
		IRTCommandList* const Submitted[] = {&List};
		Status = Device.Submit(Submitted, 1, &Fence);
	}
	FrameSubmitted(Fence);
	if (OutFence) { *OutFence = Fence; }
	return Status;
}

FRTStatus FRenderer::EndFrame(IRTCommandList& List) { return Execute(List); }

void FRenderer::FrameSubmitted(FRTFence Fence)
{
	Fences[Slot] = Fence;
	Uploads.EndFrame(Fence);
	Context->Scene.EndFrame(Fence != 0);
	Context.reset();
	bFrameLost = Fence == 0;
	if (!bFrameLost) { return; }
	Bindings.Invalidate();
	// The pool believes that its textures are in the layouts which the lost list would have left them in.
	GraphResources.Trim(0);
}

std::string FRenderer::DumpGraph() const { return LastDump; }

} // namespace Lantern
