// FSceneMaterials: a change of a material goes on to its sections only where they depend on it.
#include "LanternScene/Scene/SceneMaterials.h"

#include <cassert>
#include <utility>

#include "LanternScene/Scene/EmissiveTriangles.h"

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
} // namespace

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

} // namespace Lantern
