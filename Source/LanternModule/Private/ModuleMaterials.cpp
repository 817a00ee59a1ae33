// FModuleRenderer's materials, and which objects use them.
#include <algorithm>
#include <cassert>

#include "ArgumentChecks.h"
#include "LanternRHI/RTText.h"
#include "LanternScene/Scene/TextureSlot.h"
#include "MeshData.h"
#include "ModuleRenderer.h"

namespace Lantern
{

namespace
{

FRTStatus RefuseMasked(const FRTGeometryInfo& Geometry, size_t Section)
{
	return FRTStatus::Error(ERTResult::InvalidArgument,
	    "mesh \"%s\": section %zu cannot have a masked material: it was added without bMayBeMasked", FRTShown(Geometry.Name.c_str()).Text,
	    Section);
}

} // namespace

void FModuleRenderer::StoreMaterial(FMaterial& Material, const FRTModuleMaterial& From)
{
	FMaterialData Data = PackMaterial(From);
	if (From.BaseColorTexture != nullptr)
	{
		[[maybe_unused]] const bool bFits =
		    MakeTextureSlot(From.BaseColorTexture->GetSampledIndex(), From.BaseColorSampler->GetIndex(), Data.Textures[TEXTURE_BASE_COLOR]);
		assert(bFits && "CheckMaterial has seen to it");
	}
	ReplacedTextures.push_back(std::move(Material.Textures));
	Material.Textures = {TRTRef(From.BaseColorTexture), TRTRef(From.BaseColorSampler)};
	Scene.SetMaterial(Material.Index, Data);
}

FRTStatus FModuleRenderer::AddMaterial(const FRTModuleMaterial& Material, ERTMaterialHandle* Out)
{
	if (Out == nullptr) { return RefuseNull("AddMaterial", "Out"); }
	*Out = ERTMaterialHandle::None;
	if (const FRTStatus Status = CheckMaterial(Material); !Status) { return Status; }
	FMaterial Added;
	Added.Index = Scene.AddMaterial(PackMaterial(Material));
	MaterialUsers.resize(std::max<size_t>(MaterialUsers.size(), Added.Index + 1));
	StoreMaterial(Added, Material);
	*Out = Materials.Add(std::move(Added));
	return FRTStatus::Success();
}

FRTStatus FModuleRenderer::CheckUsers(uint32_t Material)
{
	FRTStatus Status = FRTStatus::Success();
	Objects.ForEach([&](const FObject& User) {
		const FRTObjectInfo& Object = Scene.GetObject(User.Id);
		const FRTGeometryInfo& Geometry = Object.Geometry->GetInfo();
		for (size_t Section = 0; Section < Object.Materials.size(); ++Section)
		{
			if (Object.Materials[Section] == Material && Geometry.Sections[Section].bOpaque) { Status = RefuseMasked(Geometry, Section); }
		}
	});
	return Status;
}

FRTStatus FModuleRenderer::SetMaterial(ERTMaterialHandle Handle, const FRTModuleMaterial& Material)
{
	FMaterial* const Mine = Materials.Find(Handle);
	if (Mine == nullptr) { return RefuseHandle("SetMaterial", "material"); }
	FRTStatus Status = CheckMaterial(Material);
	const bool bWasMasked = (Scene.GetMaterials()[Mine->Index].Flags & MATERIAL_MASKED) != 0;
	if (Status && Material.bMasked && !bWasMasked) { Status = CheckUsers(Mine->Index); }
	if (Status) { StoreMaterial(*Mine, Material); }
	return Status;
}

FRTStatus FModuleRenderer::RemoveMaterial(ERTMaterialHandle Handle)
{
	FMaterial* const Material = Materials.Find(Handle);
	if (Material == nullptr) { return RefuseHandle("RemoveMaterial", "material"); }
	if (const uint32_t Users = MaterialUsers[Material->Index]; Users > 0)
	{
		return FRTStatus::Error(ERTResult::InvalidArgument, "RemoveMaterial: %u sections of objects still use it", Users);
	}
	Scene.RemoveMaterial(Material->Index);
	ReplacedTextures.push_back(std::move(Material->Textures));
	Materials.Remove(Handle);
	return FRTStatus::Success();
}

void FModuleRenderer::AddUsers(const std::vector<uint32_t>& Used)
{
	for (const uint32_t Material : Used) { ++MaterialUsers[Material]; }
}

void FModuleRenderer::RemoveUsers(const std::vector<uint32_t>& Used)
{
	for (const uint32_t Material : Used) { --MaterialUsers[Material]; }
}

FRTStatus FModuleRenderer::ResolveMaterials(
    const FRTGeometryInfo& Geometry, const ERTMaterialHandle* Handles, uint32_t MaterialCount, std::vector<uint32_t>& Out)
{
	if (MaterialCount != Geometry.Sections.size() || Handles == nullptr)
	{
		return FRTStatus::Error(ERTResult::InvalidArgument, "an object of \"%s\" needs %zu materials, not %u",
		    FRTShown(Geometry.Name.c_str()).Text, Geometry.Sections.size(), Handles != nullptr ? MaterialCount : 0);
	}
	for (uint32_t Section = 0; Section < MaterialCount; ++Section)
	{
		const FMaterial* const Material = Materials.Find(Handles[Section]);
		if (Material == nullptr)
		{
			return FRTStatus::Error(
			    ERTResult::InvalidArgument, "mesh \"%s\": section %u: no such material", FRTShown(Geometry.Name.c_str()).Text, Section);
		}
		Out.push_back(Material->Index);
		if (Geometry.Sections[Section].bOpaque && (Scene.GetMaterials()[Out.back()].Flags & MATERIAL_MASKED) != 0)
		{
			return RefuseMasked(Geometry, Section);
		}
	}
	return FRTStatus::Success();
}

FRTStatus FModuleRenderer::SetObjectMaterials(ERTObjectHandle Handle, const ERTMaterialHandle* Handles, uint32_t MaterialCount)
{
	const FObject* const Object = Objects.Find(Handle);
	if (Object == nullptr) { return RefuseHandle("SetObjectMaterials", "object"); }
	std::vector<uint32_t> Indices;
	const FRTStatus Status = ResolveMaterials(Scene.GetObject(Object->Id).Geometry->GetInfo(), Handles, MaterialCount, Indices);
	if (Status)
	{
		AddUsers(Indices);
		RemoveUsers(Scene.GetObject(Object->Id).Materials);
		Scene.SetMaterials(Object->Id, std::move(Indices));
	}
	return Status;
}

} // namespace Lantern
