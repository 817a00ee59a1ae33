// FSceneMaterials: a change of a material goes on to its sections only where they depend on it.
#include "LanternScene/Scene/SceneMaterials.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

#include "LanternScene/Scene/EmissiveTriangles.h"
#include "Scene/EmissiveNits.h"

namespace Lantern
{

namespace
{
/// Tells whether chances of light sampling differ: they follow the emissive texture, what is cut away of it, and which sides shine.
bool EmitsOtherwise(const FMaterialData& Old, const FMaterialData& New)
{
	bool bOther = Old.EmissiveWeight != New.EmissiveWeight || Old.LightEmissive != New.LightEmissive || Old.UVSets != New.UVSets ||
	              ((Old.Flags ^ New.Flags) & (MATERIAL_MASKED | MATERIAL_DOUBLE_SIDED)) != 0 || Old.AlphaCutoff != New.AlphaCutoff;
	for (const uint32_t Slot : {TEXTURE_EMISSIVE, TEXTURE_BASE_COLOR})
	{
		bOther |= Old.Textures[Slot] != New.Textures[Slot] || Old.UVTransform[Slot] != New.UVTransform[Slot] ||
		          Old.UVOffset[Slot] != New.UVOffset[Slot];
	}
	return bOther;
}

double GetChange(const glm::vec3& Old, const glm::vec3& New)
{
	const double Greater = std::max(glm::length(Old), glm::length(New));
	return Greater > 0.0 ? std::min(glm::length(New - Old) / Greater, 1.0) : 0.0;
}

/// A map that scrolls reflects about as much as before.
double GetMapChange(const FMaterialData& Old, const FMaterialData& New, uint32_t Slot)
{
	constexpr double Scrolled = 1.0 / 64.0;
	if (Old.Textures[Slot] != New.Textures[Slot]) { return 1.0; }
	const bool bSame = Old.UVTransform[Slot] == New.UVTransform[Slot] && Old.UVOffset[Slot] == New.UVOffset[Slot] &&
	                   ((Old.UVSets ^ New.UVSets) >> Slot & 1u) == 0;
	return bSame ? 0.0 : Scrolled;
}
} // namespace

FAppearanceChange CompareAppearance(const FMaterialData& Old, const FMaterialData& New)
{
	const bool bShines = Old.EmissiveWeight > 0.0f || New.EmissiveWeight > 0.0f;
	const double Emitted = GetChange(Old.LightEmissive, New.LightEmissive) + (bShines ? GetMapChange(Old, New, TEXTURE_EMISSIVE) : 0.0);
	if (Emitted > 0.0)
	{
		return {std::min(Emitted, 1.0), NitsPerEmissiveWeight * double(std::max(Old.EmissiveWeight, New.EmissiveWeight))};
	}
	double Reflected = GetChange(glm::vec3(Old.BaseColor), glm::vec3(New.BaseColor)) + GetMapChange(Old, New, TEXTURE_BASE_COLOR);
	if (Old.DiffuseTransmission > 0.0f || New.DiffuseTransmission > 0.0f)
	{
		Reflected +=
		    GetChange(Old.DiffuseTransmissionColor * Old.DiffuseTransmission, New.DiffuseTransmissionColor * New.DiffuseTransmission) +
		    GetMapChange(Old, New, TEXTURE_DIFFUSE_TRANSMISSION) + GetMapChange(Old, New, TEXTURE_DIFFUSE_TRANSMISSION_COLOR);
	}
	const glm::vec3 OldScattering = Old.Extinction * Old.ScatterAlbedo, NewScattering = New.Extinction * New.ScatterAlbedo;
	if (OldScattering != glm::vec3(0) || NewScattering != glm::vec3(0))
	{
		Reflected += GetChange(OldScattering, NewScattering) + GetChange(Old.Extinction, New.Extinction) +
		             std::abs(double(New.ScatterAnisotropy) - double(Old.ScatterAnisotropy));
	}
	return {std::min(Reflected + std::abs(double(New.Metallic) - double(Old.Metallic)), 1.0), 0.0};
}

uint32_t FSceneMaterials::Add(const FMaterialData& Material, uint32_t Program)
{
	if (!Free.empty())
	{
		const uint32_t Index = Free.back();
		Free.pop_back();
		Table.Set(Index, Material);
		Programs[Index] = Program;
		Emissive.AddMaterial(Index, Material.EmissiveWeight > 0.0f);
		return Index;
	}
	Programs.push_back(Program);
	const uint32_t Index = Table.Add(Material);
	Emissive.AddMaterial(Index, Material.EmissiveWeight > 0.0f);
	return Index;
}

void FSceneMaterials::Remove(uint32_t Index)
{
	assert(Index < Table.Num() && !Sections.IsMaterialUsed(Index));
	Free.push_back(Index);
}

void FSceneMaterials::Set(uint32_t Index, const FMaterialData& Material)
{
	assert(Index < Table.Num());
	const FMaterialData Old = Table[Index];
	const bool bEmits = Material.EmissiveWeight > 0.0f;
	if ((bEmits || Old.EmissiveWeight > 0.0f) && EmitsOtherwise(Old, Material))
	{
		Emissive.ChangeMaterial(Index, bEmits, Sections.IsMaterialUsed(Index));
	}
	Table.Set(Index, Material);
	// An animated colour or roughness goes no further.
	if (FSectionTable::AffectsSections(Old, Material)) { Sections.MaterialChanged(Index); }
}

void FSceneMaterials::SetProgram(uint32_t Index, uint32_t Program)
{
	assert(Index < Table.Num());
	if (std::exchange(Programs[Index], Program) == Program) { return; }
	Sections.MaterialChanged(Index);
}

void FSceneMaterials::SetOverride(uint32_t Override)
{
	if (std::exchange(Context.Override, Override) != Override) { Sections.RefillAll(); }
}

void FSceneMaterials::SetAlphaTest(bool bEnabled)
{
	if (std::exchange(Context.bAlphaTest, bEnabled) != bEnabled) { Sections.RefillAll(); }
}

void FSceneMaterials::SetTransmission(bool bEnabled)
{
	if (std::exchange(Context.bTransmission, bEnabled) != bEnabled) { Sections.RefillAll(); }
}

} // namespace Lantern
