// The module's frame, on top of FRenderer: from the engine's textures and view to the signals that it wants.
#include "ArgumentChecks.h"
#include "FrameChecks.h"
#include "LanternCore/Config/ConsoleVariables.h"
#include "ModuleRenderer.h"

namespace Lantern
{

namespace
{

FView ToView(const FRTModuleFrame& Frame, uint32_t FrameIndex)
{
	const FRTModuleView& From = Frame.View;
	FView View;
	View.Position = {From.Position[0], From.Position[1], From.Position[2]};
	View.Forward = {From.Forward[0], From.Forward[1], From.Forward[2]};
	View.Up = {From.Up[0], From.Up[1], From.Up[2]};
	View.FovY = From.FovY;
	View.Near = From.Near;
	View.Width = Frame.Depth->GetDesc().Width;
	View.Height = Frame.Depth->GetDesc().Height;
	View.FrameIndex = FrameIndex;
	View.Seed = Frame.Seed;
	View.DeltaSeconds = Frame.DeltaSeconds;
	View.bCut = Frame.bCut;
	return View;
}

FGBuffer ImportGBuffer(FFrameGraph& Graph, const FRTModuleFrame& Frame)
{
	const auto Import = [&](IRTTexture* Texture, ERTAccess Access, const char* Name) {
		return Texture != nullptr ? Graph.ImportTexture(Texture, Access, ERTAccess::ShaderRead, Name) : FGraphTexture();
	};
	FGBuffer Out;
	Out.Depth = Import(Frame.Depth, Frame.DepthAccess, "EngineDepth");
	Out.Normals = Import(Frame.Normals, Frame.NormalsAccess, "EngineNormals");
	Out.Motion = Import(Frame.Motion, Frame.MotionAccess, "EngineMotion");
	Out.BaseColor = Import(Frame.BaseColor, Frame.BaseColorAccess, "EngineBaseColor");
	Out.Material = Import(Frame.Material, Frame.MaterialAccess, "EngineMaterial");
	return Out;
}

} // namespace

void FModuleRenderer::AddPasses(const FRTModuleFrame& Frame)
{
	FFrameContext& Context = On->Renderer.GetContext();
	const FGBuffer GBuffer = ImportGBuffer(Context.Graph, Frame);
	FFrameOutputs Made;
	for (const FSignalInfo& Info : SignalInfos)
	{
		if (Context.Signals.Wanted.Has(Info.Signal)) { Made.Get(Info.Signal) = AddSignalPass(Context, Info.Signal, GBuffer); }
	}
	HandToEngine(Made);
}

/// The engine reads them after the graph has ended: the last pass leaves them readable and holds on to them.
void FModuleRenderer::HandToEngine(const FFrameOutputs& Made)
{
	struct FHandOver
	{
		FGraphTexture Texture;
		TRTRef<IRTTexture>* Held;
	};
	std::vector<FHandOver> Handed;
	for (size_t I = 0; I < SignalCount; ++I)
	{
		if (Made.Signals[I].IsValid()) { Handed.push_back({Made.Signals[I], &Outputs[I]}); }
	}
	if (Handed.empty()) { return; }
	FFrameGraph& Graph = On->Renderer.GetContext().Graph;
	for (const auto& [Texture, Held] : Handed) { Graph.AddUsage(Texture, ERTTextureUsage::CopySource); }
	Graph.AddPass("HandToEngine", [&](FPassBuilder& Builder) -> FPassExecute {
		for (const auto& [Texture, Held] : Handed) { Builder.Read(Texture, ERTAccess::ShaderRead); }
		Builder.NeverCull();
		return [Handed](FPassContext& Pass) {
			for (const auto& [Texture, Held] : Handed) { *Held = TRTRef<IRTTexture>(Pass.GetTexture(Texture)); }
		};
	});
}

void FModuleRenderer::ReleaseOutputs() { Outputs.fill(nullptr); }

FFrameFeatures FModuleRenderer::MakeFeatures(const FRTModuleFrame& Frame)
{
	// Before BeginFrame, which asks the scene whether anything in it has changed.
	if (const FRTStatus Status = On->State.Record(*Frame.Commands); !Status) { return Status; }
	FFrameFeatures Features;
	Features.bBuildAll = Features.bWaitForPipelines = false;
	Features.bMotion = false; // the engine draws: nothing of the plugin's reads how its objects moved
	Features.Signals.bNothingElse = true;
	const bool bSurface = Frame.BaseColor != nullptr && Frame.Material != nullptr;
	for (const FSignalInfo& Info : SignalInfos)
	{
		const bool bMakes = Info.Signal != ESignal::Frame && (bSurface || !Info.bNeedsSurface);
		if (bMakes && Frame.Wanted.Has(Info.Signal)) { Features.Signals.Wanted.Add(Info.Signal); }
	}
	if (const FRTStatus Status = On->Renderer.BeginFrame(On->Scene, ToView(Frame, FrameIndex++), Features); !Status) { return Status; }
	AddPasses(Frame);
	const FRTStatus Status = On->Renderer.EndFrame(*Frame.Commands);
	if (!Status)
	{
		On->Renderer.FrameSubmitted(0); // it never will be
	}
	return Status;
}

FRTStatus FModuleRenderer::RenderFrame(const FRTModuleFrame& Frame, FRTModuleOutputs* Out)
{
	if (Out == nullptr) { return RefuseNull("RenderFrame", "Out"); }
	*Out = {};
	std::unique_lock<std::mutex> Lock;
	if (const FRTStatus Status = Enter("RenderFrame", Lock); !Status) { return Status; }
	if (Recorded) { return FRTStatus::Error(ERTResult::InvalidArgument, "RenderFrame: EndFrame was not called after the last one"); }
	if (const FRTStatus Status = CheckFrame(Frame); !Status) { return Status; }
	if (bLost)
	{
		return FRTStatus::Error(ERTResult::DeviceLost, "RenderFrame: the device is lost; Recreate takes the scene to another one");
	}
	ReleaseOutputs();
	FConsoleVariables::Get().BeginFrame(); // what is taken over follows them, too
	bArrivalsLeft = Calls.Take(FRTScene::GetMostArrivals(), Commands);
	On->State.Apply(Commands);
	const FRTStatus Status = Watch(RecordFrame(Frame));
	if (!Status)
	{
		ReleaseOutputs();
		On->State.EndFrame(0);
		return Status;
	}
	Recorded = TRTRef<IRTCommandList>(Frame.Commands);
	for (size_t I = 0; I < SignalCount; ++I) { Out->Signals[I] = Outputs[I].Get(); }
	Out->bShadersReady = On->Renderer.AreRayProgramsReady();
	Out->bComplete = Out->bShadersReady && !bArrivalsLeft && On->Scene.GetGeometries().GetStats().Pending == 0;
	return Status;
}

FRTStatus FModuleRenderer::EndFrame(FRTFence* OutFence)
{
	std::unique_lock<std::mutex> Lock;
	if (const FRTStatus Status = Enter("EndFrame", Lock); !Status) { return Status; }
	if (!Recorded) { return FRTStatus::Error(ERTResult::InvalidArgument, "EndFrame: RenderFrame recorded nothing"); }
	IRTCommandList* List = Recorded.Get();
	FRTFence Fence = 0;
	const FRTStatus Status = Watch(On->Device->NotifyExternalSubmit(&List, 1, &Fence));
	On->Renderer.FrameSubmitted(Fence);
	On->State.EndFrame(Fence);
	Recorded = nullptr;
	if (OutFence != nullptr) { *OutFence = Fence; }
	return Status;
}

} // namespace Lantern
