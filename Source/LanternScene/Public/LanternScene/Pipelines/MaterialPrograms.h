// Material programs: the surface of a material as GLSL. The RTPSO compiler (RTPSOCompiler.h) makes the hit groups of each
// program. The host's raster may use the same text.
//
// A program defines this function:
//   FMaterialSurface EvaluateMaterial(FMaterialData M, FMaterialInputs I, uint Override)
// It may include "Materials/Standard.glsl" and build on EvaluateStandard. It may also define one of two macros.
//   MATERIAL_STANDARD_OPACITY says that the opacity is that of the standard program. The alpha test then reads only what that
//   needs.
//   MATERIAL_HAS_ALPHA_TEST says that the program has an alpha test. The signature of the test is
//   bool IsHitCutAway(FMaterialRef, FSectionData, uint Primitive, vec2 Barycentrics)
// Blended materials (MATERIAL_BLENDED) have no alpha test: what they cover is the opacity of EvaluateMaterial, or the standard one.
// If neither is defined, the alpha test evaluates the whole program. Inline ray queries use the standard program for all materials,
// and so do r.RT.GI 2 and 3 (r.RT.GI.Materials). Their standard parameters should say about what the program shows.
// Lights are sampled by the emission of the standard program. A program must leave the emission of materials that emit as it is.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "LanternCore/Shaders/ShaderCompiler.h"

namespace Lantern
{

/// The glTF metallic-roughness material, Materials/Standard.glsl. Every FMaterialPrograms begins with it.
inline constexpr uint32_t StandardProgram = 0;
inline constexpr const char* StandardProgramName = "Standard";

struct FMaterialProgramDesc
{
	std::string Name;             ///< for messages; escaped by EscapeText, at most MaxQuotedBytes
	std::string Path;             ///< GLSL, relative to the shader folders
	std::string Text;             ///< GLSL that replaces the file, if not empty; Path then only names it in messages
	std::string IntersectionPath; ///< intersection shader, for procedural geometry; may be empty
	friend bool operator==(const FMaterialProgramDesc&, const FMaterialProgramDesc&) = default;
};

/// The kind of hit group that a section needs. A stand-in is of the same class as what it stands in for.
enum class ERTHitClass : uint8_t
{
	Opaque,
	Masked,     ///< with an any-hit shader for the alpha test
	Procedural, ///< AABBs with the program's intersection shader
	/// Masked, by the alpha of the base colour's texture and of the material alone: the standard program, no pieces, vertices of
	/// ours, and SECTION_PLAIN_OPACITY. Its any-hit shader is shorter, and alpha tests are most of what shadow rays of foliage cost.
	MaskedPlain,
};
inline constexpr uint32_t HitClassCount = 4;

/// Returns whether hit groups of the class have an any-hit shader.
constexpr bool IsMasked(ERTHitClass Class) { return Class == ERTHitClass::Masked || Class == ERTHitClass::MaskedPlain; }

/// What the hit groups of a section are made from. There is one group for each ray type.
struct FHitProgram
{
	uint32_t Program = StandardProgram;
	ERTHitClass Class = ERTHitClass::Opaque;
	friend bool operator==(const FHitProgram&, const FHitProgram&) = default;
	friend auto operator<=>(const FHitProgram&, const FHitProgram&) = default;
};

/// The programs of a renderer, by index. None is ever removed.
/// Threads: the render thread. Descriptions that Share returns are for any thread.
class FMaterialPrograms
{
public:
	FMaterialPrograms();
	uint32_t Add(FMaterialProgramDesc Desc);
	/// Returns the program with an equal description, or adds one.
	uint32_t FindOrAdd(FMaterialProgramDesc Desc);
	/// Replaces the description. The old shaders stay in use until the new ones are compiled, or for good if those do not compile.
	void Edit(uint32_t Program, FMaterialProgramDesc Desc);
	uint32_t GetCount() const { return static_cast<uint32_t>(Entries.size()); }
	const FMaterialProgramDesc& Get(uint32_t Program) const { return *Entries[Program].Desc; }
	/// Returns a description that later edits do not change, for other threads.
	const std::shared_ptr<const FMaterialProgramDesc>& Share(uint32_t Program) const { return Entries[Program].Desc; }
	uint32_t GetRevision(uint32_t Program) const { return Entries[Program].Revision; } ///< rises with each Edit that changes something
	uint64_t GetEdits() const { return Edits; }                                        ///< sum of all revisions

	/// Returns Shader with Program as its material: the include "Materials/Material.glsl" is the text of the program.
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
