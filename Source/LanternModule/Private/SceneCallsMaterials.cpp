// FSceneCalls' materials, and which objects use them.
#include <algorithm>
#include <utility>

#include "ArgumentChecks.h"
#include "LanternRHI/RTText.h"
#include "MeshData.h"
#include "SceneCalls.h"

namespace Lantern
{

namespace
{

FRTStatus RefuseMasked(const std::string& Mesh, size_t Section)
{
	return FRTStatus::Error(ERTResult::InvalidArgument,
	    "mesh \"%s\": section %zu cannot have a masked material: it was added without bMayBeMasked", FRTShown(Mesh.c_str()).Text, Section);
}

FMaterialTextures HoldTextures(const FRTModuleMaterial& Material)
{
	FMaterialTextures Out;
	for (const FRTModuleMap* const Map : GetMaps(Material))
	{
		if (Map->Texture == nullptr) { continue; }
		Out.Textures.emplace_back(Map->Texture);
		Out.Samplers.emplace_back(Map->Sampler);
	}
	return Out;
}

} // namespace

namespace
{
/// Whether rays may pass parts of it, which a section must allow.
bool IsCut(const FRTModuleMaterial& Material) { return Material.bMasked || (Material.bBlended && Material.Transmission <= 0.0f); }
} // namespace

FRTStatus FSceneCalls::AddMaterial(const FRTModuleMaterial& Material, ERTMaterialHandle* Out)
{
	if (Out == nullptr) { return RefuseNull("AddMaterial", "Out"); }
	*Out = ERTMaterialHandle::None;
	if (const FRTStatus Status = CheckMaterial(Material); !Status) { return Status; }
	FMaterial Added;
	Added.Textures = HoldTextures(Material);
	Added.bMasked = IsCut(Material);
	auto Data = std::make_unique<FMaterialData>(PackMaterial(Material));
	std::lock_guard Lock(Mutex);
	*Out = Materials.Add(std::move(Added));
	const FTicket Ticket = AddArrival(FMaterialCommand{Materials.GetSlot(*Out), std::move(Data), {}});
	Materials.Find(*Out)->Ticket = Ticket;
	return FRTStatus::Success();
}

FRTStatus FSceneCalls::CheckUsers(const FMaterial& Material)
{
	if (Material.OpaqueUsers.empty()) { return FRTStatus::Success(); }
	const auto& [Mesh, Section] = Material.OpaqueUsers.begin()->first;
	return RefuseMasked(Meshes.Find(Mesh)->Name, Section); // a mesh that is used is there
}

FRTStatus FSceneCalls::SetMaterial(ERTMaterialHandle Handle, const FRTModuleMaterial& Material)
{
	std::lock_guard Lock(Mutex);
	FMaterial* const Mine = Materials.Find(Handle);
	if (Mine == nullptr) { return RefuseHandle("SetMaterial", "material"); }
	FRTStatus Status = CheckMaterial(Material);
	if (Status && IsCut(Material)) { Status = CheckUsers(*Mine); }
	if (!Status) { return Status; }
	FMaterialCommand Command{Materials.GetSlot(Handle), std::make_unique<FMaterialData>(PackMaterial(Material)), {}};
	Command.Old = std::exchange(Mine->Textures, HoldTextures(Material));
	Mine->bMasked = IsCut(Material);
	AddUpdate(std::move(Command), 0, Mine->Ticket);
	return Status;
}

FRTStatus FSceneCalls::RemoveMaterial(ERTMaterialHandle Handle)
{
	std::lock_guard Lock(Mutex);
	FMaterial* const Material = Materials.Find(Handle);
	if (Material == nullptr) { return RefuseHandle("RemoveMaterial", "material"); }
	if (Material->Users > 0)
	{
		return FRTStatus::Error(ERTResult::InvalidArgument, "RemoveMaterial: %u sections of objects still use it", Material->Users);
	}
	AddArrival(FMaterialCommand{Materials.GetSlot(Handle), nullptr, std::move(Material->Textures)});
	Materials.Remove(Handle);
	return FRTStatus::Success();
}

void FSceneCalls::AddUsers(const FObject& Object)
{
	const FMesh& Mesh = *Meshes.Find(Object.Mesh);
	for (uint32_t Section = 0; Section < Object.Materials.size(); ++Section)
	{
		FMaterial& Material = *Materials.Find(Object.Materials[Section]);
		++Material.Users;
		if (Mesh.IsOpaque[Section]) { ++Material.OpaqueUsers[{Object.Mesh, Section}]; }
	}
}

void FSceneCalls::RemoveUsers(const FObject& Object)
{
	const FMesh& Mesh = *Meshes.Find(Object.Mesh);
	for (uint32_t Section = 0; Section < Object.Materials.size(); ++Section)
	{
		FMaterial& Material = *Materials.Find(Object.Materials[Section]);
		--Material.Users;
		if (!Mesh.IsOpaque[Section]) { continue; }
		const auto Found = Material.OpaqueUsers.find({Object.Mesh, Section});
		if (--Found->second == 0) { Material.OpaqueUsers.erase(Found); }
	}
}

FRTStatus FSceneCalls::CheckMaterials(const FMesh& Mesh, const ERTMaterialHandle* Handles, uint32_t Count)
{
	if (Count != Mesh.IsOpaque.size() || Handles == nullptr)
	{
		return FRTStatus::Error(ERTResult::InvalidArgument, "an object of \"%s\" needs %zu materials, not %u",
		    FRTShown(Mesh.Name.c_str()).Text, Mesh.IsOpaque.size(), Handles != nullptr ? Count : 0);
	}
	for (uint32_t Section = 0; Section < Count; ++Section)
	{
		const FMaterial* const Material = Materials.Find(Handles[Section]);
		if (Material == nullptr)
		{
			return FRTStatus::Error(
			    ERTResult::InvalidArgument, "mesh \"%s\": section %u: no such material", FRTShown(Mesh.Name.c_str()).Text, Section);
		}
		if (Mesh.IsOpaque[Section] && Material->bMasked) { return RefuseMasked(Mesh.Name, Section); }
	}
	return FRTStatus::Success();
}

std::vector<uint32_t> FSceneCalls::GetSlots(const std::vector<ERTMaterialHandle>& Handles) const
{
	std::vector<uint32_t> Slots;
	Slots.reserve(Handles.size());
	for (const ERTMaterialHandle Handle : Handles) { Slots.push_back(Materials.GetSlot(Handle)); }
	return Slots;
}

FRTStatus FSceneCalls::SetObjectMaterials(ERTObjectHandle Handle, const ERTMaterialHandle* Handles, uint32_t Count)
{
	std::lock_guard Lock(Mutex);
	FObject* const Object = Objects.Find(Handle);
	if (Object == nullptr) { return RefuseHandle("SetObjectMaterials", "object"); }
	const FRTStatus Status = CheckMaterials(*Meshes.Find(Object->Mesh), Handles, Count);
	if (!Status) { return Status; }
	RemoveUsers(*Object);
	Object->Materials.assign(Handles, Handles + Count);
	AddUsers(*Object);
	FTicket Needs = 0;
	for (uint32_t Section = 0; Section < Count; ++Section) { Needs = std::max(Needs, Materials.Find(Handles[Section])->Ticket); }
	AddUpdate(FObjectMaterialsCommand{Objects.GetSlot(Handle), GetSlots(Object->Materials)}, Needs, Object->Ticket);
	return Status;
}

} // namespace Lantern
