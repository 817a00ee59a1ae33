#include "ModuleRenderer.h"

#include <algorithm>

#include "ArgumentChecks.h"
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
		for (int Column = 0; Column < 4; ++Column)
		{
			Matrix[Column][Row] = Rows[Row * 4 + Column];
		}
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
	return View;
}

} // namespace

FModuleRenderer::FModuleRenderer(IRTModule& InOwner, IRTDevice& InDevice, FRendererDesc Desc)
    : Owner(&InOwner),
      Device(&InDevice),
      Scene(InDevice),
      Renderer(InDevice, std::move(Desc)),
      Uploader(InDevice),
      VertexUploads(InDevice)
{
}

FModuleRenderer::~FModuleRenderer()
{
	// Environment: a lost device can no longer be waited for, and has nothing in flight.
	(void)Renderer.WaitForAll();
}

FRTStatus FModuleRenderer::UploadMesh(const FRTModuleMesh& Mesh, const std::vector<FVertexAttributes>& Attributes,
                                      FRTGeometryInfo& Out)
{
	constexpr ERTBufferUsage Usage = ERTBufferUsage::GeometryInput | ERTBufferUsage::Storage;
	const uint64_t PositionBytes = uint64_t(Mesh.VertexCount) * 12;
	FRTStatus Status = Uploader.CreateBuffer(Mesh.Name, Usage, Mesh.Positions, PositionBytes, Out.Positions);
	if (Status)
	{
		Status = Uploader.CreateBuffer(Mesh.Name, Usage, Attributes.data(),
		                               Attributes.size() * sizeof(FVertexAttributes), Out.Attributes);
	}
	if (Status)
	{
		Status = Uploader.CreateBuffer(Mesh.Name, Usage | ERTBufferUsage::Index, Mesh.Indices,
		                               uint64_t(Mesh.IndexCount) * 4, Out.Indices);
	}
	return Status.IsOk() ? Uploader.Flush() : Status;
}

FRTStatus FModuleRenderer::AddMesh(const FRTModuleMesh& Mesh, ERTMeshHandle* Out)
{
	*Out = ERTMeshHandle::None;
	if (const FRTStatus Status = CheckMesh(Mesh); !Status)
	{
		return Status;
	}
	FRTGeometryInfo Info;
	Info.Name = Mesh.Name;
	Info.VertexCount = Mesh.VertexCount;
	Info.Sections = MakeSections(Mesh);
	Info.bDynamic = Mesh.bDeformable;
	std::vector<FVertexAttributes> Attributes = PackAttributes(Mesh);
	FRTStatus Status = UploadMesh(Mesh, Attributes, Info);
	FMesh Added;
	if (Status)
	{
		Status = Scene.CreateGeometry(std::move(Info), Added.Geometry);
	}
	if (Status)
	{
		if (Mesh.bDeformable)
		{
			Added.Deformable = std::make_unique<FDeformableMesh>(Mesh, std::move(Attributes), Added.Geometry);
		}
		*Out = Meshes.Add(std::move(Added));
	}
	return Status;
}

FRTStatus FModuleRenderer::UpdateMeshVertices(ERTMeshHandle Handle, const float* Positions, const float* Normals)
{
	FMesh* const Mesh = Meshes.Find(Handle);
	if (Mesh == nullptr)
	{
		return RefuseMesh("UpdateMeshVertices", Handle);
	}
	if (!Mesh->Deformable)
	{
		return FRTStatus::Error(ERTResult::InvalidArgument, "mesh \"%s\" was added without bDeformable",
		                        Mesh->Geometry->GetInfo().Name.c_str());
	}
	return Mesh->Deformable->SetVertices(Positions, Normals);
}

FRTStatus FModuleRenderer::RemoveMesh(ERTMeshHandle Handle)
{
	const FMesh* const Mesh = Meshes.Find(Handle);
	if (Mesh == nullptr)
	{
		return RefuseMesh("RemoveMesh", Handle);
	}
	std::string Name = Mesh->Geometry->GetInfo().Name;
	if (Mesh->Users > 0)
	{
		return FRTStatus::Error(ERTResult::InvalidArgument, "RemoveMesh: %u objects still use mesh \"%s\"", Mesh->Users,
		                        Name.c_str());
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
	return FRTStatus::Error(ERTResult::InvalidArgument, "%s: no such mesh: \"%s\" was removed", Function,
	                        RemovedMeshes[Slot].Name.c_str());
}

FRTStatus FModuleRenderer::AddObject(const FRTModuleObject& Object, ERTObjectHandle* Out)
{
	*Out = ERTObjectHandle::None;
	FMesh* const Mesh = Meshes.Find(Object.Mesh);
	if (Mesh == nullptr)
	{
		return RefuseMesh("AddObject", Object.Mesh);
	}
	FRTObjectInfo Info;
	Info.Geometry = Mesh->Geometry;
	FRTStatus Status = CheckTransform(Object.Transform);
	if (Status)
	{
		Status = ResolveMaterials(Info.Geometry->GetInfo(), Object.Materials, Object.MaterialCount, Info.Materials);
	}
	if (Status)
	{
		Info.Transform = ToMatrix(Object.Transform);
		Info.Mask = Object.bCastsShadow ? MaskAll : MaskVisible;
		const std::vector<uint32_t> Used = Info.Materials;
		const FRTObjectId Id = Scene.AddObject(std::move(Info));
		if (!Id.IsValid())
		{
			return FRTStatus::Error(ERTResult::Unsupported,
			                        "AddObject: the scene has as many objects as instances can name");
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
	const FRTStatus Status =
	    Object != nullptr ? CheckTransform(Transform) : RefuseHandle("SetObjectTransform", "object");
	if (Status)
	{
		Scene.SetTransform(Object->Id, ToMatrix(Transform));
	}
	return Status;
}

FRTStatus FModuleRenderer::SetObjectCastsShadow(ERTObjectHandle Handle, bool bCastsShadow)
{
	FObject* const Object = Objects.Find(Handle);
	if (Object == nullptr)
	{
		return RefuseHandle("SetObjectCastsShadow", "object");
	}
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
	if (Object == nullptr)
	{
		return RefuseHandle("RemoveObject", "object");
	}
	RemoveUsers(Scene.GetObject(Object->Id).Materials);
	Scene.RemoveObject(Object->Id);
	--Meshes.Find(Object->Mesh)->Users; // it cannot have been removed
	Objects.Remove(Handle);
	return FRTStatus::Success();
}

FRTStatus FModuleRenderer::SetSun(const FRTModuleSun& Sun)
{
	if (const FRTStatus Status = CheckSun(Sun); !Status)
	{
		return Status;
	}
	FSunLight Light;
	Light.Direction = {Sun.Direction[0], Sun.Direction[1], Sun.Direction[2]};
	Light.Color = {Sun.Color[0], Sun.Color[1], Sun.Color[2]};
	Light.Irradiance = Sun.Irradiance;
	Light.AngularDiameter = Sun.AngularDiameter;
	Scene.SetSun(Light);
	return FRTStatus::Success();
}

void FModuleRenderer::AddPasses(const FRTModuleFrame& Frame)
{
	FFrameContext& Context = Renderer.GetContext();
	FFrameGraph& Graph = Context.Graph;
	FSunShadowInputs Inputs;
	Inputs.Depth = Graph.ImportTexture(Frame.Depth, Frame.DepthAccess, ERTAccess::ShaderRead, "EngineDepth");
	Inputs.Normals = Graph.ImportTexture(Frame.Normals, Frame.NormalsAccess, ERTAccess::ShaderRead, "EngineNormals");
	const FGraphTexture Visibility = AddSunShadowPass(Context, Inputs).Visibility;
	if (!Visibility.IsValid())
	{
		return;
	}
	// The engine reads it after the graph has ended: the last pass leaves it readable and holds on to it.
	Graph.AddPass("HandToEngine",
	              [this, Visibility](FPassBuilder& Builder) -> FPassExecute
	              {
		              Builder.Read(Visibility, ERTAccess::ShaderRead);
		              Builder.NeverCull();
		              return [this, Visibility](FPassContext& Pass)
		              { SunShadow = TRTRef<IRTTexture>(Pass.GetTexture(Visibility)); };
	              });
}

FRTStatus FModuleRenderer::RecordVertices(IRTCommandList& List)
{
	FRTStatus Status = FRTStatus::Success();
	Meshes.ForEach(
	    [&](FMesh& Mesh)
	    {
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
	Meshes.ForEach(
	    [&](FMesh& Mesh)
	    {
		    if (Mesh.Deformable)
		    {
			    Mesh.Deformable->EndFrame(Fence != 0);
		    }
	    });
}

FRTStatus FModuleRenderer::RecordFrame(const FRTModuleFrame& Frame)
{
	// Before BeginFrame, which asks the scene whether anything in it has changed.
	if (const FRTStatus Status = RecordVertices(*Frame.Commands); !Status)
	{
		return Status;
	}
	FFrameFeatures Features;
	Features.bBuildAll = Features.bWaitForPipelines = false;
	// Structures are built while the shaders that trace them are compiled, so that shadows come with all that casts them.
	const ESunShadowPath Path = ChooseSunShadowPath(Device->GetCapabilities(), Scene.RefreshFacts());
	Features.bRays = Features.bLateRays = Path != ESunShadowPath::None;
	if (const FRTStatus Status = Renderer.BeginFrame(Scene, ToView(Frame, FrameIndex++), Features); !Status)
	{
		return Status;
	}
	AddPasses(Frame);
	const FRTStatus Status = Renderer.EndFrame(*Frame.Commands);
	if (!Status)
	{
		Renderer.FrameSubmitted(0); // it never will be
	}
	return Status;
}

bool FModuleRenderer::AreShadersReady()
{
	if (ChooseSunShadowPath(Device->GetCapabilities(), Scene.GetFacts()) != ESunShadowPath::Pipeline)
	{
		return true;
	}
	const FRTPSO* const Pipeline = Renderer.GetRayPipeline();
	const std::vector<FHitProgram> Programs = Scene.GetSections().GetHitPrograms();
	const auto IsReady = [&](FHitProgram Program) { return Pipeline->GetState(Program) == ERTHitState::Ready; };
	const bool bAll = Pipeline != nullptr && std::all_of(Programs.begin(), Programs.end(), IsReady);
	// What does not compile never will be ready.
	return bAll || (SunShadow && !Renderer.GetRayCompiler().GetStats().bBusy);
}

FRTStatus FModuleRenderer::RenderFrame(const FRTModuleFrame& Frame, FRTModuleOutputs* Out)
{
	*Out = {};
	if (Recorded)
	{
		return FRTStatus::Error(ERTResult::InvalidArgument, "RenderFrame: EndFrame was not called after the last one");
	}
	if (const FRTStatus Status = CheckFrame(Frame); !Status)
	{
		return Status;
	}
	SunShadow = nullptr;
	const FRTStatus Status = RecordFrame(Frame);
	if (!Status)
	{
		SunShadow = nullptr;
		FinishVertices(0);
		return Status;
	}
	Recorded = TRTRef<IRTCommandList>(Frame.Commands);
	Out->SunShadow = SunShadow.Get();
	Out->bShadersReady = AreShadersReady();
	Out->bComplete = Out->bShadersReady && Scene.GetGeometries().GetStats().Pending == 0;
	return Status;
}

FRTStatus FModuleRenderer::EndFrame(FRTFence* OutFence)
{
	if (!Recorded)
	{
		return FRTStatus::Error(ERTResult::InvalidArgument, "EndFrame: RenderFrame recorded nothing");
	}
	IRTCommandList* List = Recorded.Get();
	FRTFence Fence = 0;
	const FRTStatus Status = Device->NotifyExternalSubmit(&List, 1, &Fence);
	Renderer.FrameSubmitted(Fence);
	FinishVertices(Fence);
	ReplacedTextures.clear();
	Recorded = nullptr;
	if (OutFence != nullptr)
	{
		*OutFence = Fence;
	}
	return Status;
}

} // namespace Lantern
