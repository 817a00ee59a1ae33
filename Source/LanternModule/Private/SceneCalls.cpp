// FSceneCalls: meshes, objects and lights. Materials are in SceneCallsMaterials.cpp.
#include "SceneCalls.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <iterator>
#include <utility>

#include "ArgumentChecks.h"
#include "LanternRHI/RTText.h"
#include "LanternScene/Geometry/GeometryStore.h"

namespace Lantern
{

namespace
{

FSceneLight ToSceneLight(const FModuleWorld& World, const FRTModuleLight& From)
{
	static_assert(uint32_t(ERTModuleLight::Point) == LIGHT_POINT && uint32_t(ERTModuleLight::Spot) == LIGHT_SPOT);
	static_assert(uint32_t(ERTModuleLight::Directional) == LIGHT_DIRECTIONAL);
	FSceneLight Light{};
	Light.WorldPosition = World.ToPosition(From.Position);
	Light.Data.Type = static_cast<uint32_t>(From.Type);
	if (From.Type != ERTModuleLight::Point) { Light.Data.Direction = glm::vec3(normalize(World.ToDirection(From.Direction))); }
	Light.Data.Range = static_cast<float>(World.ToMeters(double(From.Range)));
	Light.Data.Color = {From.Color[0], From.Color[1], From.Color[2]};
	// As KHR_lights_punctual says.
	const float CosOuter = std::cos(From.OuterCone);
	Light.Data.SpotScale = 1.0f / std::max(0.001f, std::cos(From.InnerCone) - CosOuter);
	Light.Data.SpotOffset = -CosOuter * Light.Data.SpotScale;
	return Light;
}

/// Buffer: its name is the mesh's.
FRTStatus CreateMeshBuffer(IRTDevice& Device, const FRTModuleMesh& Mesh, const FMeshData& Data, FRTGeometryInfo& Out)
{
	constexpr ERTBufferUsage Usage =
	    ERTBufferUsage::GeometryInput | ERTBufferUsage::Storage | ERTBufferUsage::Index | ERTBufferUsage::CopyDest;
	const FRTBufferDesc Desc{Data.GetBytes(), Usage, ERTMemory::Device, Mesh.Name};
	const FRTStatus Status = Device.CreateBuffer(Desc, Out.Positions.ReleaseAndGetAddress());
	Out.Attributes = Out.Indices = Out.Positions;
	Out.AttributesOffset = Data.GetAttributesOffset();
	Out.IndicesOffset = Data.GetIndicesOffset();
	return Status;
}

uint32_t MakeTag()
{
	static std::atomic<uint32_t> Count{0};
	return Count++ % TSlotTable<int, ERTMeshHandle>::MaxTag + 1;
}

} // namespace

FSceneCalls::FSceneCalls(IRTDevice& InDevice, const FModuleWorld& InWorld, FBufferUploads& InUploads)
    : World(InWorld),
      Device(&InDevice),
      Uploads(&InUploads),
      Tag(MakeTag())
{}

// ---------------------------------------------------------------------------------------------------- commands

FSceneCalls::FTicket FSceneCalls::AddArrival(FSceneCommand Command)
{
	Arrivals.push_back(std::move(Command));
	return ++LastArrival;
}

void FSceneCalls::AddUpdate(FSceneCommand Command, FTicket Needs, FTicket& InOutTicket)
{
	if (std::max(Needs, InOutTicket) <= LastTaken) { Updates.push_back(std::move(Command)); }
	else { InOutTicket = AddArrival(std::move(Command)); }
}

bool FSceneCalls::Take(uint32_t MostArrivals, std::vector<FSceneCommand>& Out)
{
	std::lock_guard Lock(Mutex);
	// Updates concern what the scene has already, so that arrivals cannot be what they wait for.
	std::move(Updates.begin(), Updates.end(), std::back_inserter(Out));
	Updates.clear();
	const size_t Count = MostArrivals > 0 ? std::min<size_t>(MostArrivals, Arrivals.size()) : Arrivals.size();
	const auto End = Arrivals.begin() + static_cast<ptrdiff_t>(Count);
	std::move(Arrivals.begin(), End, std::back_inserter(Out));
	Arrivals.erase(Arrivals.begin(), End);
	LastTaken += Count;
	return !Arrivals.empty();
}

// ---------------------------------------------------------------------------------------------------- meshes

FRTStatus FSceneCalls::MakeMesh(IRTDevice& On, FBufferUploads& By, const FRTModuleMesh& Mesh, FMesh& Out, FAddMeshCommand& OutCommand)
{
	if (const FRTStatus Status = CheckMesh(Mesh); !Status) { return Status; }
	const std::shared_ptr<FMeshData> Data = PackMesh(Mesh);
	OutCommand.Info = std::make_unique<FRTGeometryInfo>(DescribeGeometry(Mesh, *Data));
	FRTStatus Status = CreateMeshBuffer(On, Mesh, *Data, *OutCommand.Info);
	if (Status) { Status = FGeometryStore::Check(*OutCommand.Info, On.GetCapabilities()); }
	if (!Status) { return Status; }
	Out.Name = Mesh.Name;
	for (const FRTSectionInfo& Section : OutCommand.Info->Sections) { Out.IsOpaque.push_back(Section.bOpaque); }
	if (Mesh.bDeformable) { Out.Deformable = std::make_shared<FDeformableMesh>(Mesh, *Data); }
	Out.bHasBounds = Mesh.BoundsRadius >= 0.0f;
	OutCommand.Deformable = Out.Deformable;
	OutCommand.Upload = Out.Upload = std::make_shared<FBufferUpload>();
	OutCommand.Upload->Bytes = Data->GetBytes();
	OutCommand.Upload->Buffer = OutCommand.Info->Positions;
	OutCommand.Upload->Copy = [Data](uint64_t Offset, uint64_t Size, uint8_t* To) { Data->Copy(Offset, Size, To); };
	return By.Add(OutCommand.Upload);
}

FRTStatus FSceneCalls::AddMesh(const FRTModuleMesh& Mesh, ERTMeshHandle* Out)
{
	if (Out == nullptr) { return RefuseNull("AddMesh", "Out"); }
	*Out = ERTMeshHandle::None;
	FMesh Added;
	FAddMeshCommand Command;
	std::shared_lock DeviceLock(DeviceMutex);
	if (const FRTStatus Status = MakeMesh(*Device, *Uploads, Mesh, Added, Command); !Status) { return Status; }

	std::lock_guard Lock(Mutex);
	*Out = Meshes.Add(std::move(Added));
	Command.Slot = Meshes.GetSlot(*Out);
	const FTicket Ticket = AddArrival(std::move(Command));
	Meshes.Find(*Out)->Ticket = Ticket;
	return FRTStatus::Success();
}

FRTStatus FSceneCalls::CheckDeformable(const char* Function, ERTMeshHandle Handle)
{
	const FMesh* const Mesh = Meshes.Find(Handle);
	if (Mesh == nullptr) { return RefuseMesh(Function, Handle); }
	if (Mesh->Deformable) { return FRTStatus::Success(); }
	return FRTStatus::Error(
	    ERTResult::InvalidArgument, "%s: mesh \"%s\" was added without bDeformable", Function, FRTShown(Mesh->Name.c_str()).Text);
}

FRTStatus FSceneCalls::UpdateMeshVertices(ERTMeshHandle Handle, const float* Positions, const float* Normals)
{
	FDeformableMeshRef Deformable;
	{
		std::lock_guard Lock(Mutex);
		if (const FRTStatus Status = CheckDeformable("UpdateMeshVertices", Handle); !Status) { return Status; }
		Deformable = Meshes.Find(Handle)->Deformable;
	}
	bool bNew = false;
	const FRTStatus Status = Deformable->SetVertices(Positions, Normals, bNew);
	if (!Status || !bNew) { return Status; }
	std::lock_guard Lock(Mutex);
	FMesh* const Mesh = Meshes.Find(Handle);
	if (Mesh != nullptr) { AddUpdate(FVerticesCommand{Meshes.GetSlot(Handle)}, 0, Mesh->Ticket); }
	return Status; // without an effect if another thread has removed the mesh meanwhile
}

FRTStatus FSceneCalls::GetMeshBuffer(ERTMeshHandle Handle, FRTModuleMeshBuffer* Out)
{
	if (Out == nullptr) { return RefuseNull("GetMeshBuffer", "Out"); }
	*Out = {};
	std::lock_guard Lock(Mutex);
	if (const FRTStatus Status = CheckDeformable("GetMeshBuffer", Handle); !Status) { return Status; }
	const FMesh& Mesh = *Meshes.Find(Handle);
	if (!Mesh.bHasBounds)
	{
		return FRTStatus::Error(
		    ERTResult::InvalidArgument, "GetMeshBuffer: mesh \"%s\" was added without BoundsRadius", FRTShown(Mesh.Name.c_str()).Text);
	}
	if (Mesh.Upload && Mesh.Upload->bFilled) { Out->Buffer = Mesh.Upload->Buffer.Get(); }
	return FRTStatus::Success();
}

FRTStatus FSceneCalls::MarkMeshDeformed(ERTMeshHandle Handle)
{
	std::lock_guard Lock(Mutex);
	const FRTStatus Status = CheckDeformable("MarkMeshDeformed", Handle);
	if (Status) { AddUpdate(FDeformedCommand{Meshes.GetSlot(Handle)}, 0, Meshes.Find(Handle)->Ticket); }
	return Status;
}

FRTStatus FSceneCalls::RemoveMesh(ERTMeshHandle Handle)
{
	std::lock_guard Lock(Mutex);
	FMesh* const Mesh = Meshes.Find(Handle);
	if (Mesh == nullptr) { return RefuseMesh("RemoveMesh", Handle); }
	if (Mesh->Users > 0)
	{
		return FRTStatus::Error(
		    ERTResult::InvalidArgument, "RemoveMesh: %u objects still use mesh \"%s\"", Mesh->Users, FRTShown(Mesh->Name.c_str()).Text);
	}
	const uint32_t Slot = Meshes.GetSlot(Handle);
	RemovedMeshes.resize(std::max<size_t>(RemovedMeshes.size(), Slot + 1));
	RemovedMeshes[Slot] = {Handle, std::move(Mesh->Name)};
	Meshes.Remove(Handle);
	AddArrival(FRemoveMeshCommand{Slot});
	return FRTStatus::Success();
}

FRTStatus FSceneCalls::RefuseMesh(const char* Function, ERTMeshHandle Handle) const
{
	const uint32_t Slot = Meshes.GetSlot(Handle);
	if (Slot >= RemovedMeshes.size() || RemovedMeshes[Slot].Handle != Handle || Handle == ERTMeshHandle::None)
	{
		return RefuseHandle(Function, "mesh");
	}
	return FRTStatus::Error(
	    ERTResult::InvalidArgument, "%s: no such mesh: \"%s\" was removed", Function, FRTShown(RemovedMeshes[Slot].Name.c_str()).Text);
}

// ---------------------------------------------------------------------------------------------------- objects

FRTStatus FSceneCalls::CheckObject(const FRTModuleObject& Object)
{
	const FMesh* const Mesh = Meshes.Find(Object.Mesh);
	if (Mesh == nullptr) { return RefuseMesh("AddObject", Object.Mesh); }
	const FRTStatus Status = CheckTransform(Object.Transform);
	return Status ? CheckMaterials(*Mesh, Object.Materials, Object.MaterialCount) : Status;
}

ERTObjectHandle FSceneCalls::AddOne(const FRTModuleObject& Object)
{
	FObject Added;
	Added.Mesh = Object.Mesh;
	Added.Materials.assign(Object.Materials, Object.Materials + Object.MaterialCount);
	Added.bVisible = Object.bVisible;
	Added.bCastsShadow = Object.bCastsShadow;
	AddUsers(Added);
	++Meshes.Find(Object.Mesh)->Users;
	++ObjectCount;
	FAddObjectCommand Command;
	Command.Mesh = Meshes.GetSlot(Object.Mesh);
	Command.Materials = GetSlots(Added.Materials);
	Command.Mask = Added.GetMask();
	Command.Transform = World.ToTransform(Object.Transform);
	const ERTObjectHandle Handle = Objects.Add(std::move(Added));
	Command.Slot = Objects.GetSlot(Handle);
	const FTicket Ticket = AddArrival(std::move(Command));
	Objects.Find(Handle)->Ticket = Ticket;
	return Handle;
}

FRTStatus FSceneCalls::AddObjects(const FRTModuleObject* Added, uint32_t Count, ERTObjectHandle* Out)
{
	if (Count > 0 && Added == nullptr) { return RefuseNull("AddObjects", "Objects"); }
	if (Count > 0 && Out == nullptr) { return RefuseNull("AddObjects", "Out"); }
	std::fill_n(Out, Count, ERTObjectHandle::None);
	std::lock_guard Lock(Mutex);
	for (uint32_t I = 0; I < Count; ++I)
	{
		const FRTStatus Status = CheckObject(Added[I]);
		if (Status) { continue; }
		return Count == 1 ? Status : FRTStatus::Error(Status.Code, "object %u: %s", I, Status.Message);
	}
	if (Count > uint64_t(MaxInstanceIndex) + 1 - ObjectCount)
	{
		return FRTStatus::Error(ERTResult::Unsupported, "AddObject: the scene has as many objects as instances can name");
	}
	std::transform(Added, Added + Count, Out, [this](const FRTModuleObject& Object) { return AddOne(Object); });
	return FRTStatus::Success();
}

FRTStatus FSceneCalls::SetObjectTransform(ERTObjectHandle Handle, const double Transform[12])
{
	const FRTStatus Status = CheckTransform(Transform);
	std::lock_guard Lock(Mutex);
	FObject* const Object = Objects.Find(Handle);
	if (Object == nullptr) { return RefuseHandle("SetObjectTransform", "object"); }
	if (Status) { AddUpdate(FTransformCommand{Objects.GetSlot(Handle), World.ToTransform(Transform)}, 0, Object->Ticket); }
	return Status;
}

FRTStatus FSceneCalls::SetMask(const char* Function, ERTObjectHandle Handle, bool FObject::*Member, bool bValue)
{
	std::lock_guard Lock(Mutex);
	FObject* const Object = Objects.Find(Handle);
	if (Object == nullptr) { return RefuseHandle(Function, "object"); }
	Object->*Member = bValue;
	AddUpdate(FMaskCommand{Objects.GetSlot(Handle), Object->GetMask()}, 0, Object->Ticket);
	return FRTStatus::Success();
}

FRTStatus FSceneCalls::SetObjectCastsShadow(ERTObjectHandle Handle, bool bCastsShadow)
{
	return SetMask("SetObjectCastsShadow", Handle, &FObject::bCastsShadow, bCastsShadow);
}

FRTStatus FSceneCalls::SetObjectVisible(ERTObjectHandle Handle, bool bVisible)
{
	return SetMask("SetObjectVisible", Handle, &FObject::bVisible, bVisible);
}

FRTStatus FSceneCalls::RemoveObject(ERTObjectHandle Handle)
{
	std::lock_guard Lock(Mutex);
	const FObject* const Object = Objects.Find(Handle);
	if (Object == nullptr) { return RefuseHandle("RemoveObject", "object"); }
	RemoveUsers(*Object);
	--Meshes.Find(Object->Mesh)->Users; // it cannot have been removed
	--ObjectCount;
	Objects.Remove(Handle);
	AddArrival(FRemoveObjectCommand{Objects.GetSlot(Handle)});
	return FRTStatus::Success();
}

// ---------------------------------------------------------------------------------------------------- lights

FRTStatus FSceneCalls::AddLight(const FRTModuleLight& Light, ERTLightHandle* Out)
{
	if (Out == nullptr) { return RefuseNull("AddLight", "Out"); }
	*Out = ERTLightHandle::None;
	if (const FRTStatus Status = CheckLight(Light); !Status) { return Status; }
	std::lock_guard Lock(Mutex);
	*Out = Lights.Add({});
	const FTicket Ticket = AddArrival(FLightCommand{Lights.GetSlot(*Out), ToSceneLight(World, Light)});
	Lights.Find(*Out)->Ticket = Ticket;
	return FRTStatus::Success();
}

FRTStatus FSceneCalls::SetLight(ERTLightHandle Handle, const FRTModuleLight& Light)
{
	const FRTStatus Status = CheckLight(Light);
	std::lock_guard Lock(Mutex);
	FLight* const Mine = Lights.Find(Handle);
	if (Mine == nullptr) { return RefuseHandle("SetLight", "light"); }
	if (Status) { AddUpdate(FLightCommand{Lights.GetSlot(Handle), ToSceneLight(World, Light)}, 0, Mine->Ticket); }
	return Status;
}

FRTStatus FSceneCalls::RemoveLight(ERTLightHandle Handle)
{
	std::lock_guard Lock(Mutex);
	if (Lights.Find(Handle) == nullptr) { return RefuseHandle("RemoveLight", "light"); }
	Lights.Remove(Handle);
	AddArrival(FLightCommand{Lights.GetSlot(Handle), std::nullopt});
	return FRTStatus::Success();
}

FRTStatus FSceneCalls::SetSun(const FRTModuleSun& Sun)
{
	if (const FRTStatus Status = CheckSun(Sun); !Status) { return Status; }
	FSunLight Light;
	Light.Direction = World.ToDirection(Sun.Direction);
	Light.Color = {Sun.Color[0], Sun.Color[1], Sun.Color[2]};
	Light.Irradiance = Sun.Irradiance;
	Light.AngularDiameter = Sun.AngularDiameter;
	std::lock_guard Lock(Mutex);
	Updates.emplace_back(Light);
	return FRTStatus::Success();
}

FRTStatus FSceneCalls::SetSky(const float Radiance[3])
{
	if (const FRTStatus Status = CheckSky(Radiance); !Status) { return Status; }
	std::lock_guard Lock(Mutex);
	Updates.emplace_back(FSkyCommand{{Radiance[0], Radiance[1], Radiance[2]}});
	return FRTStatus::Success();
}

} // namespace Lantern
