// The module's scene, on top of FRTScene. ModuleFrame.cpp has the frame.
#include "ModuleRenderer.h"

#include <algorithm>
#include <atomic>

#include "ArgumentChecks.h"
#include "LanternRHI/RTText.h"
#include "MeshData.h"

namespace Lantern
{

FModuleRenderer::FModuleRenderer(IRTModule& InOwner, IRTDevice& InDevice, const FModuleWorld& InWorld, FRendererDesc Desc)
    : Owner(&InOwner),
      Device(&InDevice),
      World(InWorld),
      Scene(InDevice),
      Renderer(InDevice, std::move(Desc)),
      Uploader(InDevice),
      VertexUploads(InDevice)
{}

uint32_t FModuleRenderer::MakeTag()
{
	static std::atomic<uint32_t> Count{0};
	return Count++ % TSlotTable<FMesh, ERTMeshHandle>::MaxTag + 1;
}

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
	if (Out == nullptr) { return RefuseNull("AddMesh", "Out"); }
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
	if (Out == nullptr) { return RefuseNull("AddObject", "Out"); }
	*Out = ERTObjectHandle::None;
	FMesh* const Mesh = Meshes.Find(Object.Mesh);
	if (Mesh == nullptr) { return RefuseMesh("AddObject", Object.Mesh); }
	FRTObjectInfo Info;
	Info.Geometry = Mesh->Geometry;
	FRTStatus Status = CheckTransform(Object.Transform);
	if (Status) { Status = ResolveMaterials(Info.Geometry->GetInfo(), Object.Materials, Object.MaterialCount, Info.Materials); }
	if (Status)
	{
		Info.Transform = World.ToTransform(Object.Transform);
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
	if (Status) { Scene.SetTransform(Object->Id, World.ToTransform(Transform)); }
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
	Light.Direction = World.ToDirection(Sun.Direction);
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

} // namespace Lantern
