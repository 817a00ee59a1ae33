// Material programs: what a material's surface is, as GLSL. The hit groups of each program are made by the RTPSO's
// compiler (PipelineCompiler.h); the host's raster may use the same text.
//
// A program defines
//   FMaterialSurface EvaluateMaterial(FMaterialData M, FMaterialInputs I, uint Override)
// and may include "Materials/Standard.glsl" and build on its EvaluateStandard. Further, with these macros defined:
//   MATERIAL_STANDARD_OPACITY  Opacity is the standard's: the alpha test under rays reads no more than that needs
//   MATERIAL_HAS_ALPHA_TEST    its own test: bool IsHitCutAway(FMaterialRef, FSectionData, uint Primitive, vec2 Barycentrics)
// Without either, the alpha test evaluates the whole program. Inline ray queries know the standard program alone. Lights are sampled by the standard's emission: a program
// leaves it as it is on materials that emit.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "LanternCore/Shaders/ShaderCompiler.h"

namespace Lantern
{

/// glTF metallic-roughness, Materials/Standard.glsl. Always there.
inline constexpr uint32_t StandardProgram = 0;
inline constexpr const char* StandardProgramName = "Standard";

struct FMaterialProgramDesc
{
	std::string Name;             ///< for messages; kept as EscapeText shows it, at most MaxQuotedBytes
	std::string Path;             ///< GLSL, relative to the shader folders
	std::string Text;             ///< if not empty: instead of the file; Path then only names it in messages
	std::string IntersectionPath; ///< intersection shader, for procedural geometry; may be empty
	friend bool operator==(const FMaterialProgramDesc&, const FMaterialProgramDesc&) = default;
};

/// What a stand-in has to be like.
enum class ERTHitClass : uint8_t
{
	Opaque,
	Masked,     ///< with an any-hit shader for the alpha test
	Procedural, ///< AABBs with the program's intersection shader
};
inline constexpr uint32_t HitClassCount = 3;

/// What a section's hit groups are made from: one for each ray type.
struct FHitProgram
{
	uint32_t Program = StandardProgram;
	ERTHitClass Class = ERTHitClass::Opaque;
	friend bool operator==(const FHitProgram&, const FHitProgram&) = default;
	friend auto operator<=>(const FHitProgram&, const FHitProgram&) = default;
};

/// The programs of a renderer, by index; never removed. Render thread.
class FMaterialPrograms
{
public:
	FMaterialPrograms();
	uint32_t Add(FMaterialProgramDesc Desc);
	/// The program that is like this, if there is one.
	uint32_t FindOrAdd(FMaterialProgramDesc Desc);
	/// The new text is compiled and takes the old one's place when it is ready; if it does not compile, the old one stays.
	void Edit(uint32_t Program, FMaterialProgramDesc Desc);
	uint32_t GetCount() const { return static_cast<uint32_t>(Entries.size()); }
	const FMaterialProgramDesc& Get(uint32_t Program) const { return *Entries[Program].Desc; }
	/// Stays as it is when the program is edited. For other threads.
	const std::shared_ptr<const FMaterialProgramDesc>& Share(uint32_t Program) const { return Entries[Program].Desc; }
	uint32_t GetRevision(uint32_t Program) const { return Entries[Program].Revision; } ///< changes with each Edit
	uint64_t GetEdits() const { return Edits; }                                        ///< of all programs so far

	/// Shader with Program for its material: "Materials/Material.glsl" is the program's text.
	FShaderSource MakeSource(FShaderSource Shader, uint32_t Program) const { return MakeSource(std::move(Shader), Get(Program)); }
	static FShaderSource MakeSource(FShaderSource Shader, const FMaterialProgramDesc& Program);

private:
	struct FEntry
	{
		std::shared_ptr<const FMaterialProgramDesc> Desc;
		uint32_t Revision = 0;
	};
	std::vector<FEntry> Entries;
	uint64_t Edits = 0;
};

} // namespace Lantern

template <>
struct std::hash<Lantern::FHitProgram>
{
	size_t operator()(const Lantern::FHitProgram& Value) const noexcept
	{
		return std::hash<uint64_t>()(uint64_t(Value.Program) * Lantern::HitClassCount + uint64_t(Value.Class));
	}
};
