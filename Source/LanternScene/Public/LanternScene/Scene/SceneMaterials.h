// FSceneMaterials keeps the materials of a scene, the program of each, and the sections that objects make of them.
#pragma once

#include <cstdint>
#include <vector>

#include "LanternScene/Memory/GpuTable.h"
#include "LanternScene/Pipelines/MaterialPrograms.h"
#include "LanternScene/Scene/CasterChanges.h"
#include "LanternScene/ShaderTable/SectionTable.h"
#include "SceneTypes.h"

namespace Lantern
{

class FEmissiveTriangles;

/// Tells by how much a surface that has another material lights its surroundings otherwise.
FAppearanceChange CompareAppearance(const FMaterialData& Old, const FMaterialData& New);

/// Threads: one at a time.
class FSceneMaterials
{
public:
	/// Emissive is told when a material begins, ceases or changes to emit. It outlives this.
	explicit FSceneMaterials(FEmissiveTriangles& InEmissive) : Emissive(InEmissive) {}
	FSceneMaterials(const FSceneMaterials&) = delete;
	FSceneMaterials& operator=(const FSceneMaterials&) = delete;

	/// Returns the material's index, which may be that of a removed one. Program is an index of FMaterialPrograms.
	uint32_t Add(const FMaterialData& Material, uint32_t Program = StandardProgram);
	/// Rewrites the sections of the material only where they depend on what changed.
	void Set(uint32_t Index, const FMaterialData& Material);
	void SetProgram(uint32_t Index, uint32_t Program);
	uint32_t GetProgram(uint32_t Index) const { return Programs[Index]; }
	/// Frees the index. No object may use the material.
	void Remove(uint32_t Index);
	/// Override is as in FRTScene::SetMaterialOverride.
	void SetOverride(uint32_t Override);
	void SetAlphaTest(bool bEnabled);
	void SetTransmission(bool bEnabled);

	TGpuTable<FMaterialData>& GetTable() { return Table; }
	const TGpuTable<FMaterialData>& GetTable() const { return Table; }
	const FSectionContext& GetContext() const { return Context; }
	FSectionTable& GetSections() { return Sections; }
	const FSectionTable& GetSections() const { return Sections; }

private:
	FEmissiveTriangles& Emissive;
	TGpuTable<FMaterialData> Table{"Materials"};
	std::vector<uint32_t> Programs; // by material
	std::vector<uint32_t> Free;
	FSectionContext Context{Table, Programs};
	FSectionTable Sections{Context};
};

} // namespace Lantern
