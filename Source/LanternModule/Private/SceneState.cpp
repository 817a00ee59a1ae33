// FSceneState: commands are carried out one by one, in order.
#include "SceneState.h"

#include <algorithm>
#include <utility>

#include "LanternCore/Tasks/TaskTrace.h"
#include "LanternCore/Text/Log.h"
#include "LanternCore/Text/Quote.h"

namespace Lantern
{

namespace
{
/// Slots come in order, and each is used again when it is free.
auto& GetSlot(auto& Values, uint32_t Slot)
{
	if (Slot >= Values.size()) { Values.resize(Slot + 1); }
	return Values[Slot];
}
} // namespace

void FSceneState::Apply(std::vector<FSceneCommand>& Commands)
{
	for (FSceneCommand& Command : Commands)
	{
		std::visit([this](auto& Each) { Do(Each); }, Command);
	}
	Commands.clear();
	ChangeMeshes(~0u);
}

FSceneValues FSceneState::Describe() const
{
	FSceneValues Out;
	Out.Materials.resize(Materials.size());
	for (size_t Slot = 0; Slot < Materials.size(); ++Slot)
	{
		if (Materials[Slot] != ~0u) { Out.Materials[Slot] = Scene.GetMaterials()[Materials[Slot]]; }
	}
	Out.Transforms.resize(Objects.size());
	for (size_t Slot = 0; Slot < Objects.size(); ++Slot)
	{
		if (Objects[Slot].IsValid()) { Out.Transforms[Slot] = Scene.GetObject(Objects[Slot]).Transform; }
	}
	Out.Lights.resize(Lights.size());
	for (size_t Slot = 0; Slot < Lights.size(); ++Slot)
	{
		if (Lights[Slot].IsValid()) { Out.Lights[Slot] = Scene.GetLights().Get(Lights[Slot]); }
	}
	Out.Sun = Scene.GetSun();
	Out.Sky = Scene.GetSky();
	Out.SkyProgram = Scene.GetSkyProgram();
	return Out;
}

// ---------------------------------------------------------------------------------------------------- commands

void FSceneState::Do(FMaterialCommand& Command)
{
	constexpr uint32_t None = ~0u;
	const bool bKnown = Command.Slot < Materials.size() && Materials[Command.Slot] != None;
	if (!Command.Data)
	{
		const uint32_t Material = std::exchange(Materials[Command.Slot], None);
		ChangeMeshes(Material);
		Scene.RemoveMaterial(Material);
	}
	else if (bKnown) { Scene.SetMaterial(Materials[Command.Slot], *Command.Data); }
	else
	{
		if (Command.Slot >= Materials.size()) { Materials.resize(Command.Slot + 1, None); }
		Materials[Command.Slot] = Scene.AddMaterial(*Command.Data);
	}
	if (!Command.Old.Textures.empty()) { ReplacedTextures.push_back(std::move(Command.Old)); }
}

void FSceneState::Do(FAddMeshCommand& Command)
{
	FMesh& Mesh = GetSlot(Meshes, Command.Slot);
	Mesh = {};
	if (!Command.Info) { return; }
	Command.Info->bWaitsForData = !Command.Upload->bFilled;
	bEngineVertices |= Command.Info->bStreams;
	const std::string Name = Command.Info->Name;
	if (const FRTStatus Status = Scene.CreateGeometry(std::move(*Command.Info), Mesh.Geometry); !Status)
	{
		LogError("Module: mesh \"{}\" is left out: {}", EscapeText(Name, MaxQuotedBytes), Status.Message);
		return;
	}
	Mesh.Upload = std::move(Command.Upload);
	Mesh.Upload->Geometry = Mesh.Geometry;
	Mesh.Deformable = std::move(Command.Deformable);
}

void FSceneState::Do(FRemoveMeshCommand& Command)
{
	FMesh& Mesh = Meshes[Command.Slot];
	if (Mesh.bDeformed) { std::erase(Deformed, Command.Slot); }
	if (Mesh.Upload) { Mesh.Upload->Geometry = nullptr; } // it may still be on its way
	Mesh = {};
}

void FSceneState::Do(FAddObjectCommand& Command)
{
	FRTObjectId& Id = GetSlot(Objects, Command.Slot);
	Id = {};
	FRTObjectInfo Info;
	Info.Geometry = Command.Mesh < Meshes.size() ? Meshes[Command.Mesh].Geometry : FRTGeometryRef();
	if (!Info.Geometry) { return; }
	Info.Materials = GetMaterials(Command.Materials);
	Info.Transform = Command.Transform;
	Info.Mask = Command.Mask;
	Info.bCharacter = Command.bCharacter;
	Info.Channels = Command.Channels;
	Info.Toon = Command.Toon;
	Id = Scene.AddObject(std::move(Info));
}

void FSceneState::Do(FRemoveObjectCommand& Command)
{
	MeshChanges.erase(Command.Slot);
	const FRTObjectId Id = std::exchange(Objects[Command.Slot], {});
	if (Id.IsValid()) { Scene.RemoveObject(Id); }
}

void FSceneState::Do(FTransformCommand& Command)
{
	const FRTObjectId Id = Objects[Command.Slot];
	if (Id.IsValid()) { Scene.SetTransform(Id, Command.Transform); }
}

void FSceneState::Do(FMaskCommand& Command)
{
	const FRTObjectId Id = Objects[Command.Slot];
	if (Id.IsValid()) { Scene.SetMask(Id, Command.Mask); }
}

void FSceneState::Do(FChannelsCommand& Command)
{
	const FRTObjectId Id = Objects[Command.Slot];
	if (Id.IsValid()) { Scene.SetChannels(Id, Command.Channels); }
}

void FSceneState::Do(FToonCommand& Command)
{
	const FRTObjectId Id = Objects[Command.Slot];
	if (Id.IsValid()) { Scene.SetToon(Id, std::move(Command.Style)); }
}

void FSceneState::Do(FObjectMaterialsCommand& Command)
{
	const auto Waiting = MeshChanges.find(Command.Slot);
	const FRTObjectId Id = Objects[Command.Slot];
	if (Waiting != MeshChanges.end()) { Waiting->second.Materials = GetMaterials(Command.Materials); }
	else if (Id.IsValid()) { Scene.SetMaterials(Id, GetMaterials(Command.Materials)); }
}

void FSceneState::Do(FObjectMeshCommand& Command)
{
	MeshChanges.erase(Command.Slot);
	const FRTGeometryRef Geometry = Meshes[Command.Mesh].Geometry;
	if (Geometry && Objects[Command.Slot].IsValid()) { MeshChanges[Command.Slot] = {Geometry, GetMaterials(Command.Materials)}; }
}

void FSceneState::Do(FSkyMapCommand& Command)
{
	Scene.SetSkyMap(Command.Map);
	if (!Command.Old.Textures.empty()) { ReplacedTextures.push_back(std::move(Command.Old)); }
}

void FSceneState::ChangeMeshes(uint32_t Material)
{
	std::erase_if(MeshChanges, [&](auto& Item) {
		auto& [Slot, Change] = Item;
		const std::vector<uint32_t>& Shown = Scene.GetObject(Objects[Slot]).Materials;
		const bool bGoes = std::find(Shown.begin(), Shown.end(), Material) != Shown.end();
		if (!Change.Geometry->IsBuilt() && !bGoes) { return false; }
		Scene.SetGeometry(Objects[Slot], std::move(Change.Geometry), std::move(Change.Materials));
		return true;
	});
}

void FSceneState::Do(FVerticesCommand& Command)
{
	if (Meshes[Command.Slot].Geometry) { MarkDeformed(Command.Slot); }
}

void FSceneState::Do(FDeformedCommand& Command)
{
	if (!Meshes[Command.Slot].Geometry) { return; }
	Scene.MarkDeformed(Meshes[Command.Slot].Geometry);
	bEngineVertices = true;
}

void FSceneState::Do(FProfileCommand& Command)
{
	uint32_t& Number = GetSlot(Profiles, Command.Slot);
	if (Command.Grid) { Number = Scene.AddLightProfile(*Command.Grid); }
	else if (Number != 0) { Scene.RemoveLightProfile(std::exchange(Number, 0)); }
}

void FSceneState::Do(FLightCommand& Command)
{
	FLightId& Id = GetSlot(Lights, Command.Slot);
	if (Command.Light && Command.Light->Profile != 0) { Command.Light->Profile = Profiles[Command.Light->Profile - 1]; }
	if (!Command.Light) { Scene.RemoveLight(std::exchange(Id, {})); }
	else if (Id.IsValid()) { Scene.SetLight(Id, *Command.Light); }
	else { Id = Scene.AddLight(*Command.Light); }
}

std::vector<uint32_t> FSceneState::GetMaterials(const std::vector<uint32_t>& Slots) const
{
	std::vector<uint32_t> Out;
	Out.reserve(Slots.size());
	for (const uint32_t Slot : Slots) { Out.push_back(Materials[Slot]); }
	return Out;
}

// ---------------------------------------------------------------------------------------------------- a frame

void FSceneState::MarkDeformed(uint32_t Slot)
{
	if (!std::exchange(Meshes[Slot].bDeformed, true)) { Deformed.push_back(Slot); }
}

FRTStatus FSceneState::RecordVertices(IRTCommandList& List)
{
	const std::vector<uint32_t> Slots = std::exchange(Deformed, {});
	FRTStatus Status;
	for (const uint32_t Slot : Slots)
	{
		++VisitedMeshes;
		FMesh& Mesh = Meshes[Slot];
		Mesh.bDeformed = false;
		// What is not filled yet would be written over.
		if (!Status || (Mesh.Upload && !Mesh.Upload->bFilled))
		{
			MarkDeformed(Slot);
			continue;
		}
		RecordedVertices.push_back(Slot);
		Status = Mesh.Deformable->Record(List, VertexUploads, Mesh.Geometry->GetInfo());
		Scene.MarkDeformed(Mesh.Geometry);
		if (const auto Bounds = Mesh.Deformable->FindNewBounds(*Mesh.Geometry)) { Scene.SetBounds(Mesh.Geometry, *Bounds); }
	}
	return Status;
}

FRTStatus FSceneState::Record(IRTCommandList& List)
{
	FTraceScope Trace("Record arrivals");
	VisitedMeshes = 0;
	Filled.clear();
	if (FRTStatus Status = Uploads.Record(List, Filled); !Status) { return Status; }
	for (const FBufferUploadRef& Upload : Filled)
	{
		if (Upload->bFilled.exchange(true) || !Upload->Geometry) { continue; }
		Scene.MarkFilled(Upload->Geometry);
	}
	return RecordVertices(List);
}

void FSceneState::EndFrame(FRTFence Fence)
{
	Uploads.EndFrame(Fence);
	VertexUploads.EndFrame(Fence);
	for (const uint32_t Slot : std::exchange(RecordedVertices, {}))
	{
		if (Meshes[Slot].Deformable && Meshes[Slot].Deformable->EndFrame(Fence != 0)) { MarkDeformed(Slot); }
	}
	ReplacedTextures.clear();
	bEngineVertices &= Fence == 0;
}

} // namespace Lantern
