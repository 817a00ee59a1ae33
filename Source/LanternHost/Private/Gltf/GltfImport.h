// A glTF document in memory becomes a scene.
#pragma once

#include <filesystem>

#include "Gltf/GltfFile.h"
#include "LanternHost/SceneLoader.h"

namespace Lantern::Gltf
{

/// Imports a .gltf or .glb. External files lie in Folder; if it is empty, none are read. Throws FError and what the standard library
/// throws.
FSceneDescription ImportScene(FBytes Data, const std::filesystem::path& Folder, const FLoadOptions& Options);

} // namespace Lantern::Gltf
