// The module's frame, on top of FRenderer: from the engine's textures and view to the signals that it wants.
#include <algorithm>
#include <cmath>
#include <iterator>

#include "ArgumentChecks.h"
#include "FrameChecks.h"
#include "HostShadowChecks.h"
#include "LanternCore/Config/ConsoleVariables.h"
#include "LanternCore/Tasks/TaskTrace.h"
#include "ModuleRenderer.h"

namespace Lantern
{

namespace
{

/// Places a view in Lantern's world. Width and Height of Out are set.
FRTStatus ToView(const FRTModuleView& From, const FModuleWorld& World, FView& Out, FHostDepth& OutDepth)
{
	Out.Position = World.ToPosition(From.Position);
	Out.Forward = glm::vec3(World.ToDirection(From.Forward));
	Out.Up = glm::vec3(World.ToDirection(From.Up));
	Out.Jitter = {From.Jitter[0], From.Jitter[1]};
	FHostProjection Projection;
	std::copy(std::begin(From.Projection.ViewToClip), std::end(From.Projection.ViewToClip), Projection.ViewToClip);
	Projection.bViewYDown = From.Projection.bViewYDown;
	Projection.bViewZForward = From.Projection.bViewZForward;
	Projection.bClipYUp = From.Projection.bClipYUp;
	Projection.MetersPerUnit = World.GetMetersPerUnit();
	const FRTStatus Status = ReadProjection(Projection, Out, OutDepth);
	return Status ? Status : FRTStatus::Error(Status.Code, "FRTModuleView::Projection: %s", Status.Message);
}

FView MakeFrameView(const FRTModuleFrame& Frame, uint32_t FrameIndex)
{
	FView View;
	const FRTTextureDesc& Whole = Frame.Depth->GetDesc();
	View.Width = Frame.Width != 0 ? Frame.Width : Whole.Width - Frame.OffsetX;
	View.Height = Frame.Height != 0 ? Frame.Height : Whole.Height - Frame.OffsetY;
	View.FrameIndex = FrameIndex;
	View.Seed = Frame.Seed;
	View.DeltaSeconds = Frame.DeltaSeconds;
	View.bCut = Frame.bCut;
	View.bExposureKnown = Frame.Exposure > 0.0f;
	if (View.bExposureKnown) { View.Exposure = std::log2(Frame.Exposure); }
	return View;
}

/// Columns: axes of the space that the engine's normals are in, in Lantern's world.
glm::mat3 MakeNormalAxes(const FRTModuleFrame& Frame, const FModuleWorld& World, const FView& View)
{
	if (!Frame.Layout.bViewSpaceNormals) { return glm::mat3(World.GetAxes()); }
	const FRTModuleProjection& Projection = Frame.View.Projection;
	const float W = Projection.ViewToClip[14]; // of z: which way a perspective looks
	const bool bZForward = W != 0.0f ? W > 0.0f : Projection.bViewZForward;
	const glm::vec3 Forward = glm::normalize(View.Forward), Right = glm::normalize(glm::cross(Forward, View.Up));
	const glm::vec3 Up = glm::cross(Right, Forward);
	return {Right, Projection.bViewYDown ? -Up : Up, bZForward ? Forward : -Forward};
}

bool IsUnsigned(const FRTModuleFrame& Frame)
{
	if (Frame.Layout.NormalRange != ERTModuleRange::ByFormat) { return Frame.Layout.NormalRange == ERTModuleRange::Unsigned; }
	switch (Frame.Normals->GetDesc().Format)
	{
	case ERTFormat::RG8_UNORM:
	case ERTFormat::RGBA8_UNORM:
	case ERTFormat::BGRA8_UNORM:
	case ERTFormat::RGB10A2_UNORM:
	case ERTFormat::RG16_UNORM:
	case ERTFormat::RGBA16_UNORM: return true;
	default: return false;
	}
}

/// What the textures mean; they are not imported yet.
FHostSurface DescribeSurface(const FRTModuleFrame& Frame, const FModuleWorld& World, const FView& View, FHostDepth Depth)
{
	const FRTModuleGBufferLayout& Layout = Frame.Layout;
	if (Layout.Depth == ERTModuleDepth::Linear)
	{
		const double Unit = World.GetMetersPerUnit();
		Depth = {Unit, View.Far > 0.0 ? View.Far / Unit : 1e30, Depth.bOrthographic, true, Depth.bReversed};
	}
	FHostSurface Out;
	Out.DepthMeaning = Depth;
	Out.bOctahedral = Layout.Normals == ERTModuleNormals::Octahedral;
	Out.bUnsigned = IsUnsigned(Frame);
	Out.bGeometricInZw = Out.bOctahedral && Layout.bGeometricInZw;
	Out.NormalAxes = MakeNormalAxes(Frame, World, View);
	Out.bNativeMotion = Layout.Motion == ERTModuleMotion::Native;
	Out.bMotionInUV = Layout.Motion == ERTModuleMotion::UV;
	Out.bMotionDistance = Layout.bMotionDistance;
	Out.bMotionPartial = Layout.bMotionPartial;
	Out.MotionScale = {Layout.MotionScale[0], Layout.MotionScale[1]};
	Out.MotionOffset = {Layout.MotionOffset[0], Layout.MotionOffset[1]};
	Out.bUnrealMaterial = Layout.Material == ERTModuleMaterialLayout::Unreal;
	Out.bBackAlbedo = Frame.BackAlbedo != nullptr;
	Out.Offset = {Frame.OffsetX, Frame.OffsetY};
	return Out;
}

/// Invalid for null.
FGraphTexture ImportTexture(FFrameGraph& Graph, IRTTexture* Texture, ERTAccess Access, const char* Name)
{
	const ERTAccess After = Access == ERTAccess::External ? ERTAccess::External : ERTAccess::ShaderRead;
	return Texture != nullptr ? Graph.ImportTexture(Texture, Access, After, Name) : FGraphTexture();
}

void ImportTextures(FFrameGraph& Graph, const FRTModuleFrame& Frame, FHostSurface& Out)
{
	const auto Import = [&](IRTTexture* Texture, ERTAccess Access, const char* Name) {
		return ImportTexture(Graph, Texture, Access, Name);
	};
	Out.Depth = Import(Frame.Depth, Frame.DepthAccess, "EngineDepth");
	Out.Normals = Import(Frame.Normals, Frame.NormalsAccess, "EngineNormals");
	if (!Out.bGeometricInZw)
	{
		Out.GeometricNormals = Import(Frame.GeometricNormals, Frame.GeometricNormalsAccess, "EngineGeometricNormals");
	}
	Out.Motion = Import(Frame.Motion, Frame.MotionAccess, "EngineMotion");
	Out.BaseColor = Import(Frame.BaseColor, Frame.BaseColorAccess, "EngineBaseColor");
	Out.Material = Import(Frame.Material, Frame.MaterialAccess, "EngineMaterial");
	Out.BackAlbedo = Import(Frame.BackAlbedo, Frame.BackAlbedoAccess, "EngineBackAlbedo");
}

uint32_t ToMask(ERTModuleCasters Held)
{
	uint32_t Mask = 0;
	if (HasAny(Held, ERTModuleCasters::Still)) { Mask |= MASK_SUN; }
	if (HasAny(Held, ERTModuleCasters::Moving)) { Mask |= MASK_SUN_MOVING; }
	if (HasAny(Held, ERTModuleCasters::Characters)) { Mask |= MASK_CHARACTER; }
	if (HasAny(Held, ERTModuleCasters::Others)) { Mask |= HOST_SHADOW_OTHERS; }
	return Mask;
}
/// Imports the textures of the map, and places it in Lantern's world.
FHostShadow ImportHostShadow(FFrameGraph& Graph, const FRTModuleHostShadow& Shadow, const FModuleWorld& World)
{
	FHostShadow Out;
	Out.CascadeCount = Shadow.CascadeCount;
	Out.Held = ToMask(Shadow.Held);
	Out.ShaderData = Shadow.ShaderData;
	for (uint32_t I = 0; I < Shadow.CascadeCount; ++I)
	{
		const FRTModuleShadowCascade& From = Shadow.Cascades[I];
		FHostShadowCascade& Cascade = Out.Cascades[I];
		const ERTAccess After = From.Access == ERTAccess::External ? ERTAccess::External : ERTAccess::ShaderRead;
		Cascade.Map = Graph.ImportTexture(From.Texture, From.Access, After, "EngineShadowMap");
		Cascade.OffsetX = From.OffsetX;
		Cascade.OffsetY = From.OffsetY;
		Cascade.Width = From.Width;
		Cascade.Height = From.Height;
		for (int Row = 0; Row < 3; ++Row)
		{
			const glm::dvec3 Axis = World.ToDirection(From.WorldToMap + 4 * Row) / World.GetMetersPerUnit();
			for (int Column = 0; Column < 3; ++Column) { Cascade.WorldToMap[4 * Row + Column] = Axis[Column]; }
			Cascade.WorldToMap[4 * Row + 3] = From.WorldToMap[4 * Row + 3];
		}
		Cascade.TexelSize = static_cast<float>(World.ToMeters(From.TexelSize));
		Cascade.DepthBias = static_cast<float>(World.ToMeters(From.DepthBias));
	}
	return Out;
}

} // namespace

/// Begins the frame and adds its passes.
FRTStatus FModuleRenderer::AddPasses(const FRTModuleFrame& Frame, const FFrameViews& Views)
{
	FFrameFeatures Features = MakeFeatures(Frame, NeedsHostSurfacePass(Views.Surface));
	Features.PreviousView = Views.Previous;
	++FrameIndex;
	if (const FRTStatus Status = On->Renderer.BeginFrame(On->Scene, Views.View, Features); !Status) { return Status; }
	FFrameContext& Context = On->Renderer.GetContext();
	FHostSurface Surface = Views.Surface;
	ImportTextures(Context.Graph, Frame, Surface);
	FGBuffer GBuffer = AddHostSurfacePass(Context, Surface);
	GBuffer.Classes = ImportTexture(Context.Graph, Frame.Classes, Frame.ClassesAccess, "EngineClasses");
	GBuffer.Channels = ImportTexture(Context.Graph, Frame.Channels, Frame.ChannelsAccess, "EngineChannels");
	GBuffer.ToonNumbers = ImportTexture(Context.Graph, Frame.ToonNumbers, Frame.ToonNumbersAccess, "EngineToonNumbers");
	GBuffer.ClassesOffset = {Frame.OffsetX, Frame.OffsetY};
	if (Frame.HostShadow != nullptr) { Context.HostShadow = ImportHostShadow(Context.Graph, *Frame.HostShadow, World); }
	if (!GBuffer.Depth.IsValid()) { return FRTStatus::Success(); } // shaders are missing: there is nothing to trace from
	FFrameOutputs Made;
	Made.Fog = AddFogShadowPass(Context);
	AddFogDepthPass(Context, GBuffer);
	Made.Transmission = AddTransmissionPass(Context, GBuffer);
	Made.IndirectVolume = AddIndirectVolumePass(Context, GBuffer);
	for (const FSignalInfo& Info : SignalInfos)
	{
		if (Context.Signals.Wanted.Has(Info.Signal)) { Made.Get(Info.Signal) = AddSignalPass(Context, Info.Signal, GBuffer); }
	}
	Made.LightMask = AddLightMaskPass(Context, GBuffer);
	HandToEngine(Made);
	return FRTStatus::Success();
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
	if (Made.LightMask.IsValid()) { Handed.push_back({Made.LightMask.Visibility, &LightMask.Visibility}); }
	if (Made.Transmission.IsValid())
	{
		Handed.push_back({Made.Transmission.Light, &Transmission.Light});
		Handed.push_back({Made.Transmission.Transmittance, &Transmission.Transmittance});
		Handed.push_back({Made.Transmission.Looks, &Transmission.Looks});
	}
	FFrameGraph& Graph = On->Renderer.GetContext().Graph;
	for (const auto& [Texture, Held] : Handed) { Graph.AddUsage(Texture, ERTTextureUsage::CopySource); }
	// Histories have that usage.
	if (Made.Fog.Visibility.IsValid()) { Handed.push_back({Made.Fog.Visibility, &Fog.Visibility}); }
	if (Made.LightMask.IsValid()) { Handed.push_back({Made.LightMask.Lights, &LightMask.Lights}); }
	if (Made.Fog.Light.IsValid()) { Handed.push_back({Made.Fog.Light, &Fog.Light}); }
	Fog.Grid = Made.Fog.Grid;
	if (Made.IndirectVolume.IsValid())
	{
		Handed.push_back({Made.IndirectVolume.Light, &IndirectVolume.Light});
		Handed.push_back({Made.IndirectVolume.Moment, &IndirectVolume.Moment});
	}
	IndirectVolume.Grid = Made.IndirectVolume.Grid;
	if (Handed.empty()) { return; }
	Graph.AddPass("HandToEngine", [&](FPassBuilder& Builder) -> FPassExecute {
		for (const auto& [Texture, Held] : Handed) { Builder.Read(Texture, ERTAccess::ShaderRead); }
		Builder.NeverCull();
		return [Handed](FPassContext& Pass) {
			for (const auto& [Texture, Held] : Handed) { *Held = TRTRef<IRTTexture>(Pass.GetTexture(Texture)); }
		};
	});
}

void FModuleRenderer::ReleaseOutputs()
{
	Outputs.fill(nullptr);
	Fog = {};
	IndirectVolume = {};
	LightMask = {};
	Transmission = {};
}

FRTStatus FModuleRenderer::ReadViews(const FRTModuleFrame& Frame, FFrameViews& Out) const
{
	Out.View = MakeFrameView(Frame, FrameIndex);
	FHostDepth Depth;
	if (const FRTStatus Status = ToView(Frame.View, World, Out.View, Depth); !Status) { return Status; }
	Out.Surface = DescribeSurface(Frame, World, Out.View, Depth);
	if (Frame.PreviousView == nullptr) { return FRTStatus::Success(); }
	FHostDepth Ignored;
	const FRTStatus Status = ToView(*Frame.PreviousView, World, Out.Previous.emplace(Out.View), Ignored);
	return Status ? Status : FRTStatus::Error(Status.Code, "FRTModuleFrame::PreviousView: %s", Status.Message);
}

FFrameFeatures FModuleRenderer::MakeFeatures(const FRTModuleFrame& Frame, bool bHostSurface) const
{
	FFrameFeatures Features;
	Features.bBuildAll = Features.bWaitForPipelines = false;
	Features.bMotion = false; // the engine draws: nothing of the plugin's reads how its objects moved
	Features.Signals.bNothingElse = true;
	Features.ViewIndex = Frame.ViewIndex;
	const bool bSurface = Frame.BaseColor != nullptr && Frame.Material != nullptr;
	for (const FSignalInfo& Info : SignalInfos)
	{
		const bool bMakes = Info.Signal != ESignal::Frame && (bSurface || !Info.bNeedsSurface);
		if (bMakes && Frame.Wanted.Has(Info.Signal)) { Features.Signals.Wanted.Add(Info.Signal); }
	}
	Features.Signals.bFog = Frame.bFog;
	Features.Signals.bIndirectVolume = Frame.bIndirectVolume;
	Features.Signals.FogPhase = Frame.FogPhase;
	Features.Signals.bLightMask = Frame.bLightMask;
	Features.Signals.bTransmission = Frame.bTransmission;
	Features.bHostSurface = bHostSurface;
	Features.bCameraMotion = Frame.Motion == nullptr;
	Features.bHostShadow = Frame.HostShadow != nullptr;
	Features.BackAlbedo = Frame.BackAlbedo != nullptr ? EBackAlbedo::Always : EBackAlbedo::None;
	return Features;
}

FRTStatus FModuleRenderer::Precache(const FRTModuleFrame& Frame, FRTModuleProgress Progress, void* User)
{
	std::unique_lock<std::mutex> Lock;
	if (const FRTStatus Status = Enter("Precache", Lock); !Status) { return Status; }
	if (Recorded) { return FRTStatus::Error(ERTResult::InvalidArgument, "Precache: EndFrame was not called after RenderFrame"); }
	if (const FRTStatus Status = CheckPrecache(Frame); !Status) { return Status; }
	if (const FRTStatus Status = CheckHostShadow(Frame, *On->Device, HasHostShadowHeader(Desc.ShaderHeaders)); !Status) { return Status; }
	if (Frame.Depth != nullptr && Frame.Normals != nullptr)
	{
		FFrameViews Views;
		if (const FRTStatus Status = ReadViews(Frame, Views); !Status) { return Status; }
	}
	FConsoleVariables::Get().BeginFrame();
	bArrivalsLeft = Calls.Take(0, Commands); // the scene is what the engine has called for so far
	On->State.Apply(Commands);
	const auto Report = [=](float Done) { Progress(User, Done); };
	// A frame to be precached may lack what tells whether its G-buffer must be converted; then it may have to be.
	FFrameViews Views;
	const bool bKnown = Frame.Depth != nullptr && Frame.Normals != nullptr && ReadViews(Frame, Views);
	const FFrameFeatures Features = MakeFeatures(Frame, !bKnown || NeedsHostSurfacePass(Views.Surface));
	return On->Renderer.Precache(On->Scene, Features, Progress != nullptr ? std::function<void(float)>(Report) : nullptr);
}

/// Changes the scene as the engine's calls since the last frame say.
void FModuleRenderer::TakeOver()
{
	FTraceScope Trace("Take over calls");
	bArrivalsLeft = Calls.Take(FRTScene::GetMostArrivals(), Commands);
	On->State.Apply(Commands);
}

FRTStatus FModuleRenderer::RecordFrame(const FRTModuleFrame& Frame, const FFrameViews& Views, FRTFence& OutAhead)
{
	if (Frame.bSubmitAhead) { return RecordAhead(Frame, Views, OutAhead); }
	// Before BeginFrame, which asks the scene whether anything in it has changed.
	if (const FRTStatus Status = On->State.Record(*Frame.Commands); !Status) { return Status; }
	if (const FRTStatus Status = AddPasses(Frame, Views); !Status) { return Status; }
	const FRTStatus Status = On->Renderer.EndFrame(*Frame.Commands);
	if (!Status)
	{
		On->Renderer.FrameSubmitted(0); // it never will be
	}
	return Status;
}

FRTStatus FModuleRenderer::RecordAhead(const FRTModuleFrame& Frame, const FFrameViews& Views, FRTFence& OutAhead)
{
	FAheadWork Work;
	Work.Queue = FindAheadQueue(*On->Device);
	if (const FRTStatus Status = On->AheadLists.Begin(Work.Queue, Work.First); !Status) { return Status; }
	FRTStatus Status = On->State.Record(*Work.First);
	const FRTStatus Ended = Work.First->End();
	if (Status) { Status = Ended; }
	// Vertices that the engine's GPU writes are on its own queue.
	if (Status && Work.Queue != ERTQueue::Graphics && On->State.HasEngineVertices())
	{
		Status = On->Device->NotifyExternalSubmit(nullptr, 0, &Work.WaitFor);
	}
	if (Status) { Status = AddPasses(Frame, Views); }
	if (!Status) { return Status; }
	Status = On->Renderer.EndFrame(*Frame.Commands, Work, OutAhead);
	if (!Status) { On->Renderer.FrameSubmitted(0); }
	else { On->AheadLists.Submitted(OutAhead); }
	return Status;
}

FRTModuleIndirectVolume FModuleRenderer::MakeIndirectVolume() const
{
	if (!IndirectVolume.Light) { return {}; }
	const FFogGrid& Grid = IndirectVolume.Grid;
	return {IndirectVolume.Light.Get(), IndirectVolume.Moment.Get(), Grid.PixelSize, Grid.Columns, Grid.Rows, Grid.Slices, Grid.PerRow,
	    Grid.Distance};
}

FRTModuleFog FModuleRenderer::MakeFog() const
{
	if (!Fog.Visibility && !Fog.Light) { return {}; }
	const FFogGrid& Grid = Fog.Grid;
	return {Fog.Visibility.Get(), Fog.Light.Get(), Grid.PixelSize, Grid.Columns, Grid.Rows, Grid.Slices, Grid.PerRow, Grid.Distance};
}

FRTModuleWait FModuleRenderer::MakeWait() const
{
	if (Ahead == 0) { return {}; }
	return {On->Device->GetNative(ERTNative::ComputeTimeline), GetFenceValue(Ahead)};
}

FRTStatus FModuleRenderer::RenderFrame(const FRTModuleFrame& Frame, FRTModuleOutputs* Out)
{
	if (Out == nullptr) { return RefuseNull("RenderFrame", "Out"); }
	*Out = {};
	std::unique_lock<std::mutex> Lock;
	if (const FRTStatus Status = Enter("RenderFrame", Lock); !Status) { return Status; }
	if (Recorded) { return FRTStatus::Error(ERTResult::InvalidArgument, "RenderFrame: EndFrame was not called after the last one"); }
	if (const FRTStatus Status = CheckFrame(Frame, *On->Device); !Status) { return Status; }
	if (const FRTStatus Status = CheckHostShadow(Frame, *On->Device, HasHostShadowHeader(Desc.ShaderHeaders)); !Status) { return Status; }
	FFrameViews Views;
	if (const FRTStatus Status = ReadViews(Frame, Views); !Status) { return Status; }
	if (bLost)
	{
		return FRTStatus::Error(ERTResult::DeviceLost, "RenderFrame: the device is lost; Recreate takes the scene to another one");
	}
	ReleaseOutputs();
	FConsoleVariables::Get().BeginFrame(); // what is taken over follows them, too
	TakeOver();
	Ahead = 0;
	const FRTStatus Status = Watch(RecordFrame(Frame, Views, Ahead));
	if (!Status)
	{
		ReleaseOutputs();
		On->State.EndFrame(0);
		return Status;
	}
	Recorded = TRTRef<IRTCommandList>(Frame.Commands);
	for (size_t I = 0; I < SignalCount; ++I) { Out->Signals[I] = Outputs[I].Get(); }
	Out->Fog = MakeFog();
	Out->IndirectVolume = MakeIndirectVolume();
	Out->Transmission = {Transmission.Light.Get(), Transmission.Transmittance.Get(), Transmission.Looks.Get()};
	Out->LightMask = {LightMask.Visibility.Get(), LightMask.Lights.Get()};
	if (GetFenceQueue(Ahead) == ERTQueue::Graphics) { Ahead = 0; } // one queue runs in order
	Out->Wait = MakeWait();
	Out->bShadersReady = On->Renderer.AreShadersReady();
	Out->bCallsTaken = !bArrivalsLeft;
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
	FTraceScope Trace("EndFrame");
	const FRTStatus Status = Watch(On->Device->NotifyExternalSubmit(&List, 1, &Fence, &Ahead, Ahead != 0 ? 1 : 0));
	On->Renderer.FrameSubmitted(Fence);
	On->State.EndFrame(Fence);
	Recorded = nullptr;
	if (OutFence != nullptr) { *OutFence = Fence; }
	return Status;
}

} // namespace Lantern
