// Loads scenes: glTF 2.0 files and built-in scenes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>

#include "LanternHost/SceneDescription.h"

namespace Lantern
{

struct FLoadOptions
{
	/// Gets the current stage and how much of it is done, 0 … 1. Called from any thread, one call at a time.
	std::function<void(std::string_view Stage, float Fraction)> Progress;
	/// Limits on the size of the loaded data. Exceeding one is an error, not a truncation.
	uint64_t MaxImageBytes = uint64_t(4) << 30;    ///< decoded, all images
	uint64_t MaxGeometryBytes = uint64_t(4) << 30; ///< vertices, indices and animation keys, unpacked
	uint32_t MaxImageSize = 16384;                 ///< texels along an edge
	uint32_t MaxNodes = 16u << 20;                 ///< after expansion of instances
};

/// Either a scene or an error. An error is one line that names the file and the place in it. Example:
///   a.gltf: meshes[2].primitives[0]: index 7 of 9 is 12, but there are 4 vertices
struct FLoadResult
{
	std::optional<FSceneDescription> Scene;
	std::string Error;
};

/// Loads a `.gltf` or `.glb`, or builds a built-in scene ("courtyard", "furnace:0.7"). The error of any other name lists the
/// built-in names. The result keeps every promise of SceneDescription.h, whatever the file holds. Warnings about what was
/// ignored or approximated are in FSceneDescription::Warnings.
///
/// glTF 2.0 with KHR_lights_punctual, KHR_materials_{diffuse_transmission, emissive_strength, ior, specular, transmission, unlit},
/// KHR_texture_transform, KHR_mesh_quantization and EXT_mesh_gpu_instancing. Not read: morph targets, sparse or
/// compressed (Draco, meshopt, Basis) extensions, points and lines, orthographic cameras.
///
/// Missing tangents are generated per vertex (Lengyel, "Computing Tangent Space Basis Vectors", 2001). MikkTSpace would split
/// vertices and is not used; normal maps baked for it may show faint differences at seams.
FLoadResult LoadScene(const std::string& PathOrBuiltinName, const FLoadOptions& Options = {});

/// Loads a `.gltf` or `.glb` from memory; the magic number tells which. External files are refused.
FLoadResult LoadSceneFromMemory(const void* Data, size_t Size, const std::string& Name, const FLoadOptions& Options = {});

/// Checks every promise of SceneDescription.h: indices in range, finite values, parents first, and so on. Returns an empty string,
/// or what is wrong and where.
std::string ValidateScene(const FSceneDescription& Scene);

} // namespace Lantern
