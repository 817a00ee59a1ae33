// FSceneCalls' meshes: from arrays, in the engine's own buffers, and of heights.
#include <algorithm>
#include <cstring>
#include <utility>

#include "ArgumentChecks.h"
#include "LandscapePatch.h"
#include "LanternRHI/RTText.h"
#include "LanternScene/Geometry/GeometryStore.h"
#include "MeshData.h"
#include "SceneCalls.h"
#include "StreamedMesh.h"

namespace Lantern
{

namespace
{

constexpr ERTBufferUsage StreamsUsage = ERTBufferUsage::GeometryInput | ERTBufferUsage::Storage | ERTBufferUsage::CopyDest;

/// Buffer: its name is the mesh's.
FRTStatus CreateMeshBuffer(IRTDevice& Device, const FRTModuleMesh& Mesh, const FMeshData& Data, FRTGeometryInfo& Out)
{
	constexpr ERTBufferUsage Usage = StreamsUsage | ERTBufferUsage::Index;
	const FRTBufferDesc Desc{Data.GetBytes(), Usage, ERTMemory::Device, Mesh.Name};
	const FRTStatus Status = Device.CreateBuffer(Desc, Out.Positions.ReleaseAndGetAddress());
	Out.Attributes = Out.Indices = Out.Positions;
	Out.AttributesOffset = Data.GetAttributesOffset();
	Out.IndicesOffset = Data.GetIndicesOffset();
	return Status;
}

/// An upload that fills Buffer from Data, which has Copy and GetBytes.
template <class TData>
FBufferUploadRef MakeUpload(const TRTRef<IRTBuffer>& Buffer, std::shared_ptr<TData> Data)
{
	auto Upload = std::make_shared<FBufferUpload>();
	Upload->Bytes = Data->GetBytes();
	Upload->Buffer = Buffer;
	Upload->Copy = [Data = std::move(Data)](uint64_t Offset, uint64_t Size, uint8_t* To) { Data->Copy(Offset, Size, To); };
	return Upload;
}

/// What shaders read of a mesh in the engine's buffers.
struct FStreamsData
{
	std::vector<FVertexStreams> Streams;
	uint64_t GetBytes() const { return Streams.size() * sizeof(FVertexStreams); }
	void Copy(uint64_t Offset, uint64_t Size, uint8_t* Out) const
	{
		std::memcpy(Out, reinterpret_cast<const uint8_t*>(Streams.data()) + Offset, Size);
	}
};

} // namespace

FRTStatus FSceneCalls::MakeStreamedMesh(IRTDevice& On, const FRTModuleMesh& Mesh, FAddMeshCommand& OutCommand)
{
	if (const FRTStatus Status = CheckStreamedMesh(Mesh); !Status) { return Status; }
	OutCommand.Info = std::make_unique<FRTGeometryInfo>(DescribeStreamedMesh(Mesh));
	const auto Data = std::make_shared<FStreamsData>(FStreamsData{PackStreams(Mesh)});
	const FRTBufferDesc Desc{Data->GetBytes(), StreamsUsage, ERTMemory::Device, Mesh.Name};
	const FRTStatus Status = On.CreateBuffer(Desc, OutCommand.Info->Attributes.ReleaseAndGetAddress());
	if (Status) { OutCommand.Upload = MakeUpload(OutCommand.Info->Attributes, Data); }
	return Status;
}

FRTStatus FSceneCalls::MakeCopiedMesh(IRTDevice& On, const FRTModuleMesh& Mesh, FMesh& Out, FAddMeshCommand& OutCommand)
{
	if (const FRTStatus Status = CheckMesh(Mesh); !Status) { return Status; }
	const std::shared_ptr<FMeshData> Data = PackMesh(Mesh);
	OutCommand.Info = std::make_unique<FRTGeometryInfo>(DescribeGeometry(Mesh, *Data));
	if (const FRTStatus Status = CreateMeshBuffer(On, Mesh, *Data, *OutCommand.Info); !Status) { return Status; }
	if (Mesh.bDeformable) { Out.Deformable = std::make_shared<FDeformableMesh>(Mesh, *Data); }
	OutCommand.Deformable = Out.Deformable;
	OutCommand.Upload = MakeUpload(OutCommand.Info->Positions, Data);
	return FRTStatus::Success();
}

FRTStatus FSceneCalls::MakeMesh(IRTDevice& On, FBufferUploads& By, const FRTModuleMesh& Mesh, FMesh& Out, FAddMeshCommand& OutCommand)
{
	FRTStatus Status = Mesh.Streams != nullptr ? MakeStreamedMesh(On, Mesh, OutCommand) : MakeCopiedMesh(On, Mesh, Out, OutCommand);
	if (Status) { Status = FGeometryStore::Check(*OutCommand.Info, On.GetCapabilities()); }
	if (!Status) { return Status; }
	Out.Name = Mesh.Name;
	for (const FRTSectionInfo& Section : OutCommand.Info->Sections) { Out.IsOpaque.push_back(Section.bOpaque); }
	Out.bDeformable = Mesh.bDeformable;
	Out.bStreamed = Mesh.Streams != nullptr;
	Out.bHasBounds = Mesh.BoundsRadius >= 0.0f;
	Out.Upload = OutCommand.Upload;
	return By.Add(OutCommand.Upload);
}

/// Mesh: made of Added.
ERTMeshHandle FSceneCalls::AddOne(FMesh Added, FAddMeshCommand Command)
{
	std::lock_guard Lock(Mutex);
	const ERTMeshHandle Handle = Meshes.Add(std::move(Added));
	Command.Slot = Meshes.GetSlot(Handle);
	const FTicket Ticket = AddArrival(std::move(Command));
	Meshes.Find(Handle)->Ticket = Ticket;
	return Handle;
}

FRTStatus FSceneCalls::AddMesh(const FRTModuleMesh& Mesh, ERTMeshHandle* Out)
{
	if (Out == nullptr) { return RefuseNull("AddMesh", "Out"); }
	*Out = ERTMeshHandle::None;
	FMesh Added;
	FAddMeshCommand Command;
	std::shared_lock DeviceLock(DeviceMutex);
	const FRTStatus Status = MakeMesh(*Device, *Uploads, Mesh, Added, Command);
	if (Status) { *Out = AddOne(std::move(Added), std::move(Command)); }
	return Status;
}

FRTStatus FSceneCalls::AddLandscape(const FRTModuleLandscape& Patch, ERTMeshHandle* Out)
{
	if (Out == nullptr) { return RefuseNull("AddLandscape", "Out"); }
	*Out = ERTMeshHandle::None;
	if (const FRTStatus Status = CheckLandscape(Patch); !Status) { return Status; }
	FMesh Added;
	Added.Landscape = std::make_shared<FLandscapePatch>(Patch);
	FAddMeshCommand Command;
	std::shared_lock DeviceLock(DeviceMutex);
	const FRTStatus Status = MakeMesh(*Device, *Uploads, Added.Landscape->MakeMesh(), Added, Command);
	if (Status) { *Out = AddOne(std::move(Added), std::move(Command)); }
	return Status;
}

FRTStatus FSceneCalls::CheckDeformable(const char* Function, ERTMeshHandle Handle)
{
	const FMesh* const Mesh = Meshes.Find(Handle);
	if (Mesh == nullptr) { return RefuseMesh(Function, Handle); }
	if (Mesh->bDeformable) { return FRTStatus::Success(); }
	return FRTStatus::Error(
	    ERTResult::InvalidArgument, "%s: mesh \"%s\" was added without bDeformable", Function, FRTShown(Mesh->Name.c_str()).Text);
}

/// The renderer's own buffer has the vertices, and the engine may write them.
FRTStatus FSceneCalls::CheckOwnVertices(const char* Function, ERTMeshHandle Handle)
{
	if (const FRTStatus Status = CheckDeformable(Function, Handle); !Status) { return Status; }
	const FMesh& Mesh = *Meshes.Find(Handle);
	if (!Mesh.bStreamed && !Mesh.Landscape) { return FRTStatus::Success(); }
	return FRTStatus::Error(ERTResult::InvalidArgument, "%s: mesh \"%s\" %s", Function, FRTShown(Mesh.Name.c_str()).Text,
	    Mesh.bStreamed ? "has its vertices in the engine's own buffers" : "is a landscape");
}

FRTStatus FSceneCalls::SetVertices(ERTMeshHandle Handle, FDeformableMesh& Deformable, const float* Positions, const float* Normals)
{
	bool bNew = false;
	const FRTStatus Status = Deformable.SetVertices(Positions, Normals, bNew);
	if (!Status || !bNew) { return Status; }
	std::lock_guard Lock(Mutex);
	FMesh* const Mesh = Meshes.Find(Handle);
	if (Mesh != nullptr) { AddUpdate(FVerticesCommand{Meshes.GetSlot(Handle)}, 0, Mesh->Ticket); }
	return Status; // without an effect if another thread has removed the mesh meanwhile
}

FRTStatus FSceneCalls::SetLandscapeHeights(ERTMeshHandle Handle, const FRTModuleHeights& Heights)
{
	std::shared_lock DeviceLock(DeviceMutex); // TakeOver reads the patch's arrays, and replaces Deformable
	std::shared_ptr<FLandscapePatch> Landscape;
	FDeformableMeshRef Deformable;
	{
		std::lock_guard Lock(Mutex);
		const FMesh* const Mesh = Meshes.Find(Handle);
		if (Mesh == nullptr) { return RefuseMesh("SetLandscapeHeights", Handle); }
		if (!Mesh->Landscape)
		{
			return FRTStatus::Error(
			    ERTResult::InvalidArgument, "SetLandscapeHeights: mesh \"%s\" is no landscape", FRTShown(Mesh->Name.c_str()).Text);
		}
		Landscape = Mesh->Landscape;
		Deformable = Mesh->Deformable;
	}
	return Landscape->SetHeights(
	    Heights, [&](const float* Positions, const float* Normals) { return SetVertices(Handle, *Deformable, Positions, Normals); });
}

FRTStatus FSceneCalls::UpdateMeshVertices(ERTMeshHandle Handle, const float* Positions, const float* Normals)
{
	std::shared_lock DeviceLock(DeviceMutex); // what TakeOver replaces would get vertices that nobody sees
	FDeformableMeshRef Deformable;
	{
		std::lock_guard Lock(Mutex);
		if (const FRTStatus Status = CheckOwnVertices("UpdateMeshVertices", Handle); !Status) { return Status; }
		Deformable = Meshes.Find(Handle)->Deformable;
	}
	return SetVertices(Handle, *Deformable, Positions, Normals);
}

FRTStatus FSceneCalls::GetMeshBuffer(ERTMeshHandle Handle, FRTModuleMeshBuffer* Out)
{
	if (Out == nullptr) { return RefuseNull("GetMeshBuffer", "Out"); }
	*Out = {};
	std::lock_guard Lock(Mutex);
	if (const FRTStatus Status = CheckOwnVertices("GetMeshBuffer", Handle); !Status) { return Status; }
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

} // namespace Lantern
