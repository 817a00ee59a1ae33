// What engines ask of a scene, on its way from the calling thread to the frame that takes it over.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <variant>
#include <vector>

#include "DeformableMesh.h"
#include "LanternScene/Memory/BufferUploads.h"
#include "LanternScene/Scene/Object.h"
#include "LanternScene/Scene/SceneLights.h"
#include "SceneTypes.h"

namespace Lantern
{

/// What a material refers to, kept while it does.
struct FMaterialTextures
{
	std::vector<TRTRef<IRTTexture>> Textures;
	std::vector<TRTRef<IRTSampler>> Samplers;
};

// Materials, meshes and objects are named by their slots (TSlotTable).

/// Adds the material, or changes it. Old: what it no longer refers to.
struct FMaterialCommand
{
	uint32_t Slot = 0;
	std::unique_ptr<FMaterialData> Data; ///< null: removes the material
	FMaterialTextures Old;
};
struct FAddMeshCommand
{
	uint32_t Slot = 0;
	std::unique_ptr<FRTGeometryInfo> Info; ///< null: there is nothing of it on this device
	FBufferUploadRef Upload;
	FDeformableMeshRef Deformable; ///< null: the mesh is rigid
};
struct FRemoveMeshCommand
{
	uint32_t Slot = 0;
};
struct FAddObjectCommand
{
	uint32_t Slot = 0, Mesh = 0;
	uint8_t Mask = MaskDefault;
	bool bCharacter = false;
	uint8_t Channels = CHANNELS_DEFAULT;
	std::shared_ptr<const FToonStyle> Toon;
	std::vector<uint32_t> Materials;
	glm::dmat4 Transform{1.0};
};
struct FRemoveObjectCommand
{
	uint32_t Slot = 0;
};
struct FTransformCommand
{
	uint32_t Slot = 0;
	glm::dmat4 Transform{1.0};
};
struct FMaskCommand
{
	uint32_t Slot = 0;
	uint8_t Mask = MaskDefault;
};
struct FChannelsCommand
{
	uint32_t Slot = 0;
	uint8_t Channels = CHANNELS_DEFAULT;
};
struct FToonCommand
{
	uint32_t Slot = 0;
	std::shared_ptr<const FToonStyle> Style; ///< null: none
};
struct FObjectMaterialsCommand
{
	uint32_t Slot = 0;
	std::vector<uint32_t> Materials;
};
/// The object has another mesh, once that can be seen.
struct FObjectMeshCommand
{
	uint32_t Slot = 0, Mesh = 0;
	std::vector<uint32_t> Materials;
};
/// The mesh has new vertices.
struct FVerticesCommand
{
	uint32_t Slot = 0;
};
struct FSkyCommand
{
	glm::vec3 Radiance{0};
};

struct FSkyMapCommand
{
	FSkyMap Map;
	FMaterialTextures Old; ///< what the sky no longer refers to
};

struct FSkyProgramCommand
{
	std::optional<FSkyProgram> Program;
};

/// The engine's GPU has written new positions.
struct FDeformedCommand
{
	uint32_t Slot = 0;
};
/// Adds a profile of lights.
struct FProfileCommand
{
	uint32_t Slot = 0;
	std::shared_ptr<const FProfileGrid> Grid; ///< null: removes the profile
};
/// Adds the light, or changes it. FSceneLight::Profile is the slot of its profile, from 1.
struct FLightCommand
{
	uint32_t Slot = 0;
	std::optional<FSceneLight> Light; ///< none: removes the light
};

using FSceneCommand = std::variant<FMaterialCommand, FAddMeshCommand, FRemoveMeshCommand, FAddObjectCommand, FRemoveObjectCommand,
    FTransformCommand, FMaskCommand, FChannelsCommand, FToonCommand, FObjectMaterialsCommand, FObjectMeshCommand, FVerticesCommand,
    FDeformedCommand, FProfileCommand, FLightCommand, FSunLight, FSkyCommand, FSkyMapCommand, FSkyProgramCommand>;

} // namespace Lantern
