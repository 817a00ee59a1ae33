// The module's scene and frame, on top of FRTScene and FRenderer.
#include "ModuleRenderer.h"

#include <algorithm>

#include "ArgumentChecks.h"
#include "LanternRHI/RTText.h"
#include "MeshData.h"

namespace Lantern
{

namespace
{

glm::dmat4 ToMatrix(const double Rows[12])
{
	glm::dmat4 Matrix(1.0);
	for (int Row = 0; Row < 3; ++Row)
	{
		for (int Column = 0; Column < 4; ++Column) { Matrix[Column][Row] = Rows[Row * 4 + Column]; }
	}
	return Matrix;
}

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

FModuleRenderer::FModuleRenderer(IRTModule& InOwner, IRTDevice& InDevice, FRendererDesc Desc)
    : Owner(&InOwner),
      Device(&InDevice),
      Scene(InDevice),
      Renderer(InDevice, std::move(Desc)),
      Uploader(InDevice),
      VertexUploads(InDevice)
{}

FModuleRenderer::~FModuleRenderer()
{
	// Environment: a lost device can no longer be waited for, and has nothing in flight.
	(void)Renderer.WaitForAll();
}

FRTStatus FModuleRenderer::UploadMesh(const FRTModuleMesh& Mesh, const std::vector<FVertexAttributes>& Attributes, FRTGeometryInfo& Out)
{
	constexpr ERTBufferUsage Usage = ERTBufferUsage::GeometryInput | ERTBufferUsage::Storage;
	const uint64_t PositionBytes = uint64_t(Mesh.VertexCount) * 12;
	FRTStatus Status = Uploader.CreateBuffer(Mesh.Name, Usage, Mesh.Positions, PositionBytes, Out.Positions);
	if (Status)
	{
		Status = Uploader.CreateBuffer(Mesh.Name, Usage, Attributes.data(), Attributes.size() * sizeof(FVertexAttributes), Out.Attributes);
	}
	if (Status)
	{
		Status = Uploader.CreateBuffer(Mesh.Name, Usage | ERTBufferUsage::Index, Mesh.Indices, uint64_t(Mesh.IndexCount) * 4, Out.Indices);
	}
	return Status.IsOk() ? Uploader.Flush() : Status;
}

FRTStatus FModuleRenderer::AddMesh(const FRTModuleMesh& Mesh, ERTMeshHandle* Out)
{
	*Out = ERTMeshHandle::None;
	if (const FRTStatus Status = CheckMesh(Mesh); !Status) { return Status; }
	FRTGeometryInfo Info;
	Info.Name = Mesh.Name;
	Info.VertexCount = Mesh.VertexCount;
	Info.Sections = MakeSections(Mesh);
	Info.bDynamic = Mesh.bDeformable;
	std::vector<FVertexAttributes> Attributes = PackAttributes(Mesh);
	FRTStatus Status = UploadMesh(Mesh, Attributes, Info);
	FMesh Added;
	if (Status) { Status = Scene.CreateGeometry(std::move(Info), Added.Geometry); }
	if (Status)
	{
		if (Mesh.bDeformable) { Added.Deformable = std::make_unique<FDeformableMesh>(Mesh, std::move(Attributes), Added.Geometry); }
		*Out = Meshes.Add(std::move(Added));
	}
	return Status;
}

FRTStatus FModuleRenderer::UpdateMeshVertices(ERTMeshHandle Handle, const float* Positions, const float* Normals)
{
	FMesh* const Mesh = Meshes.Find(Handle);
	if (Mesh == nullptr) { return RefuseMesh("UpdateMeshVertices", Handle); }
	if (!Mesh->Deformable)
	{
		return FRTStatus::Error(
		    ERTResult::InvalidArgument, "mesh \"%s\" was added without bDeformable", FRTShown(Mesh->Geometry->GetInfo().Name.c_str()).Text);
	}
	return Mesh->Deformable->SetVertices(Positions, Normals);
}

FRTStatus FModuleRenderer::RemoveMesh(ERTMeshHandle Handle)
{
	const FMesh* const Mesh = Meshes.Find(Handle);
	if (Mesh == nullptr) { return RefuseMesh("RemoveMesh", Handle); }
	std::string Name = Mesh->Geometry->GetInfo().Name;
	if (Mesh->Users > 0)
	{
		return FRTStatus::Error(
		    ERTResult::InvalidArgument, "RemoveMesh: %u objects still use mesh \"%s\"", Mesh->Users, FRTShown(Name.c_str()).Text);
	}
	const uint32_t Slot = Meshes.GetSlot(Handle);
	RemovedMeshes.resize(std::max<size_t>(RemovedMeshes.size(), Slot + 1));
	RemovedMeshes[Slot] = {Handle, std::move(Name)};
	Meshes.Remove(Handle);
	return FRTStatus::Success();
}

FRTStatus FModuleRenderer::RefuseMesh(const char* Function, ERTMeshHandle Handle) const
{
	const uint32_t Slot = Meshes.GetSlot(Handle);
	if (Slot >= RemovedMeshes.size() || RemovedMeshes[Slot].Handle != Handle || Handle == ERTMeshHandle::None)
	{
		return RefuseHandle(Function, "mesh");
	}
	return FRTStatus::Error(
	    ERTResult::InvalidArgument, "%s: no such mesh: \"%s\" was removed", Function, FRTShown(RemovedMeshes[Slot].Name.c_str()).Text);
}

FRTStatus FModuleRenderer::AddObject(const FRTModuleObject& Object, ERTObjectHandle* Out)
{
	*Out = ERTObjectHandle::None;
	FMesh* const Mesh = Meshes.Find(Object.Mesh);
	if (Mesh == nullptr) { return RefuseMesh("AddObject", Object.Mesh); }
	FRTObjectInfo Info;
	Info.Geometry = Mesh->Geometry;
	FRTStatus Status = CheckTransform(Object.Transform);
	if (Status) { Status = ResolveMaterials(Info.Geometry->GetInfo(), Object.Materials, Object.MaterialCount, Info.Materials); }
	if (Status)
	{
		Info.Transform = ToMatrix(Object.Transform);
		Info.Mask = Object.bCastsShadow ? MaskAll : MaskVisible;
		const std::vector<uint32_t> Used = Info.Materials;
		const FRTObjectId Id = Scene.AddObject(std::move(Info));
		if (!Id.IsValid())
		{
			return FRTStatus::Error(ERTResult::Unsupported, "AddObject: the scene has as many objects as instances can name");
		}
		*Out = Objects.Add({Id, Object.Mesh});
		++Mesh->Users;
		AddUsers(Used);
	}
	return Status;
}

FRTStatus FModuleRenderer::SetObjectTransform(ERTObjectHandle Handle, const double Transform[12])
{
	const FObject* const Object = Objects.Find(Handle);
	const FRTStatus Status = Object != nullptr ? CheckTransform(Transform) : RefuseHandle("SetObjectTransform", "object");
	if (Status) { Scene.SetTransform(Object->Id, ToMatrix(Transform)); }
	return Status;
}

FRTStatus FModuleRenderer::SetObjectCastsShadow(ERTObjectHandle Handle, bool bCastsShadow)
{
	FObject* const Object = Objects.Find(Handle);
	if (Object == nullptr) { return RefuseHandle("SetObjectCastsShadow", "object"); }
	// The scene's objects keep their mask for life. All instances are written again after any change, so that a new
	// object costs what a new mask would.
	FRTObjectInfo Info = Scene.GetObject(Object->Id);
	Info.Mask = bCastsShadow ? MaskAll : MaskVisible;
	Scene.RemoveObject(Object->Id);
	Object->Id = Scene.AddObject(std::move(Info));
	return FRTStatus::Success();
}

FRTStatus FModuleRenderer::RemoveObject(ERTObjectHandle Handle)
{
	const FObject* const Object = Objects.Find(Handle);
	if (Object == nullptr) { return RefuseHandle("RemoveObject", "object"); }
	RemoveUsers(Scene.GetObject(Object->Id).Materials);
	Scene.RemoveObject(Object->Id);
	--Meshes.Find(Object->Mesh)->Users; // it cannot have been removed
	Objects.Remove(Handle);
	return FRTStatus::Success();
}

FRTStatus FModuleRenderer::SetSun(const FRTModuleSun& Sun)
{
	if (const FRTStatus Status = CheckSun(Sun); !Status) { return Status; }
	FSunLight Light;
	Light.Direction = {Sun.Direction[0], Sun.Direction[1], Sun.Direction[2]};
	Light.Color = {Sun.Color[0], Sun.Color[1], Sun.Color[2]};
	Light.Irradiance = Sun.Irradiance;
	Light.AngularDiameter = Sun.AngularDiameter;
	Scene.SetSun(Light);
	return FRTStatus::Success();
}

FRTStatus FModuleRenderer::SetSky(const float Radiance[3])
{
	const FRTStatus Status = CheckSky(Radiance);
	if (Status) { Scene.SetSky({Radiance[0], Radiance[1], Radiance[2]}); }
	return Status;
}

void FModuleRenderer::AddPasses(const FRTModuleFrame& Frame)
{
	FFrameContext& Context = Renderer.GetContext();
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
	FFrameGraph& Graph = Renderer.GetContext().Graph;
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

FRTStatus FModuleRenderer::RecordVertices(IRTCommandList& List)
{
	FRTStatus Status = FRTStatus::Success();
	Meshes.ForEach([&](FMesh& Mesh) {
		if (Status && Mesh.Deformable && Mesh.Deformable->IsPending())
		{
			Status = Mesh.Deformable->Record(List, VertexUploads);
			Scene.MarkDeformed(Mesh.Geometry);
		}
	});
	return Status;
}

void FModuleRenderer::FinishVertices(FRTFence Fence)
{
	VertexUploads.EndFrame(Fence);
	Meshes.ForEach([&](FMesh& Mesh) {
		if (Mesh.Deformable) { Mesh.Deformable->EndFrame(Fence != 0); }
	});
}

FRTStatus FModuleRenderer::RecordFrame(const FRTModuleFrame& Frame)
{
	// Before BeginFrame, which asks the scene whether anything in it has changed.
	if (const FRTStatus Status = RecordVertices(*Frame.Commands); !Status) { return Status; }
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
	if (const FRTStatus Status = Renderer.BeginFrame(Scene, ToView(Frame, FrameIndex++), Features); !Status) { return Status; }
	AddPasses(Frame);
	const FRTStatus Status = Renderer.EndFrame(*Frame.Commands);
	if (!Status)
	{
		Renderer.FrameSubmitted(0); // it never will be
	}
	return Status;
}

FRTStatus FModuleRenderer::RenderFrame(const FRTModuleFrame& Frame, FRTModuleOutputs* Out)
{
	*Out = {};
	if (Recorded) { return FRTStatus::Error(ERTResult::InvalidArgument, "RenderFrame: EndFrame was not called after the last one"); }
	if (const FRTStatus Status = CheckFrame(Frame); !Status) { return Status; }
	ReleaseOutputs();
	const FRTStatus Status = RecordFrame(Frame);
	if (!Status)
	{
		ReleaseOutputs();
		FinishVertices(0);
		return Status;
	}
	Recorded = TRTRef<IRTCommandList>(Frame.Commands);
	for (size_t I = 0; I < SignalCount; ++I) { Out->Signals[I] = Outputs[I].Get(); }
	Out->bShadersReady = Renderer.AreRayProgramsReady();
	Out->bComplete = Out->bShadersReady && Scene.GetGeometries().GetStats().Pending == 0;
	return Status;
}

FRTStatus FModuleRenderer::EndFrame(FRTFence* OutFence)
{
	if (!Recorded) { return FRTStatus::Error(ERTResult::InvalidArgument, "EndFrame: RenderFrame recorded nothing"); }
	IRTCommandList* List = Recorded.Get();
	FRTFence Fence = 0;
	const FRTStatus Status = Device->NotifyExternalSubmit(&List, 1, &Fence);
	Renderer.FrameSubmitted(Fence);
	FinishVertices(Fence);
	ReplacedTextures.clear();
	Recorded = nullptr;
	if (OutFence != nullptr) { *OutFence = Fence; }
	return Status;
}

} // namespace Lantern
