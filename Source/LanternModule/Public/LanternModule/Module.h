// The plugin as an engine sees it: one C entry point and interfaces. An engine reads Plugin.json, loads the library that it
// names, and looks up LanternCreateModule. It links nothing of Lantern. The order of calls:
//
//   load library → LanternCreateModule → Initialize → a device (its own: CreateDevice; the engine's: ModuleVulkan.h)
//   → CreateRenderer → AddMaterial, AddMesh, AddObject, SetSun, SetSky
//   → each frame: RenderFrame into the engine's command buffer, submit it, EndFrame
//   → Release everything, the device and the module last → unload the library
//
// Units: metres, radians, nits and lux; linear Rec.709; right-handed, y up. World positions are double precision. An engine with
// other axes or another unit says so once, in FRTModuleRendererDesc, and hands over everything in its own world.
// Threads: IRTModule may be called from any thread, a renderer from one thread at a time. Nothing throws. A handle is valid for
// its renderer only.
// Errors: every build checks what an engine passes, handles that are stale or of another renderer included. InvalidArgument says
// what is wrong; nothing has changed then. Arrays must be as long as their counts say, which nobody can check.
#pragma once

#include "LanternModule/ModuleFrame.h"
#include "LanternRHI/RTInterfaces.h"
#include "LanternSignals/Signals.h"

namespace Lantern
{

/// Incremented when anything changes that an engine was compiled with: in this folder, LanternSignals/Signals.h or
/// the RHI. The library refuses other versions. A new signal is no change: the arrays have room for MaxSignals.
inline constexpr uint32_t ModuleVersion = 6;

class IRTModuleVulkan;

enum class ERTModuleLog : uint8_t
{
	Debug,
	Info,
	Warning,
	Error,
};

/// Called from any thread. Must not call the module. Text is one line without newline, valid during the call.
using FRTModuleLogCallback = void (*)(void* User, ERTModuleLog Level, const char* Text);

/// Folders are absolute, or relative to the process's working directory.
struct FRTModuleDesc
{
	const char* ConfigFolder = nullptr;         ///< configFolder of Plugin.json; null: console variables keep their defaults
	const char* ShaderFolder = nullptr;         ///< shaderFolder of Plugin.json; required
	const char* CacheFolder = nullptr;          ///< for compiled shaders, created if missing; null: they are not kept
	FRTModuleLogCallback LogCallback = nullptr; ///< null: standard error
	void* LogUser = nullptr;
};

enum class ERTMaterialHandle : uint64_t
{
	None = 0
};
enum class ERTMeshHandle : uint64_t
{
	None = 0
};
enum class ERTObjectHandle : uint64_t
{
	None = 0
};

/// A material of glTF 2.0 metallic-roughness, with one texture. All values must be finite, and colours not negative.
struct FRTModuleMaterial
{
	float BaseColor[4] = {1, 1, 1, 1}; ///< linear; a: opacity
	float Emissive[3] = {0, 0, 0};     ///< nits
	float Metallic = 0.0f;             ///< 0–1
	float Roughness = 1.0f;            ///< perceptual, 0–1
	/// Multiplies BaseColor; the alpha test reads its alpha. Null: none. It must be created on or imported into the renderer's
	/// device with ERTTextureUsage::Sampled, and be in ShaderRead whenever a frame runs. The renderer holds a reference.
	/// The engine must keep the image of an imported texture alive while frames may read it. After SetMaterial with another
	/// texture or RemoveMaterial, that is until the fence of the next EndFrame has passed. After the renderer's last frame, it
	/// is until the renderer is released.
	IRTTexture* BaseColorTexture = nullptr;
	IRTSampler* BaseColorSampler = nullptr; ///< required with a texture
	bool bMasked = false;                   ///< alpha-tested: texels below AlphaCutoff let rays pass
	float AlphaCutoff = 0.5f;
	bool bDoubleSided = false;
};

struct FRTModuleSection
{
	uint32_t FirstIndex = 0;
	uint32_t IndexCount = 0; ///< > 0, a multiple of 3
	/// Allows objects to give this section a masked material; otherwise that is InvalidArgument. True costs nothing until an
	/// object has a masked material. Alpha tests are then set up for all such sections of that object.
	bool bMayBeMasked = false;
};

inline constexpr uint32_t MaxMeshVertices = 1u << 28;             ///< their buffer has 4 GiB
inline constexpr uint32_t MaxMeshIndices = ((1u << 29) - 1u) * 3; ///< as many triangles as every device can build

/// A mesh. AddMesh reads the arrays and copies them to the GPU. Skinned meshes set bDeformable, and the engine skins their
/// vertices on the CPU. Vertices that the GPU has skinned are not supported yet.
struct FRTModuleMesh
{
	const char* Name = "";
	const float* Positions = nullptr;           ///< x, y, z of each vertex; finite
	const float* Normals = nullptr;             ///< x, y, z, unit length; null: computed from the triangles
	const float* UVs = nullptr;                 ///< u, v; finite; null: zeros
	uint32_t VertexCount = 0;                   ///< 1 … MaxMeshVertices
	const uint32_t* Indices = nullptr;          ///< counter-clockwise is front; < VertexCount
	uint32_t IndexCount = 0;                    ///< a multiple of 3, 3 … MaxMeshIndices
	const FRTModuleSection* Sections = nullptr; ///< null: one section of all indices, with bMayBeMasked
	uint32_t SectionCount = 0;
	/// Allows UpdateMeshVertices. Rays trace the mesh slightly more slowly, and a copy stays on the CPU.
	bool bDeformable = false;
};

struct FRTModuleObject
{
	ERTMeshHandle Mesh = ERTMeshHandle::None;
	const ERTMaterialHandle* Materials = nullptr; ///< one for each of the mesh's sections
	uint32_t MaterialCount = 0;
	/// Object to world: 3 rows of 4, the last column being the translation.
	double Transform[12] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0};
	bool bCastsShadow = true;
};

struct FRTModuleSun
{
	double Direction[3] = {0, -1, 0}; ///< direction in which the light travels; any length > 0
	float Color[3] = {1, 1, 1};
	float Irradiance = 0.0f;      ///< of a plane that faces the sun, lux; 0: no sun and no shadow pass
	float AngularDiameter = 0.0f; ///< radians, 0 to π; 0: hard shadows
};

/// The engine's world: directions of its axes in a right-handed world with y up, and its unit. All that crosses the interface is
/// in it: transforms, positions, directions, views and motion. Object space is the engine's, too. The default is Lantern's.
struct FRTModuleRendererDesc
{
	/// Unit length, perpendicular to each other. A left-handed engine's are mirrored, which is fine.
	float AxisX[3] = {1, 0, 0}, AxisY[3] = {0, 1, 0}, AxisZ[3] = {0, 0, 1};
	float MetersPerUnit = 1.0f; ///< 0.01 for centimetres; > 0. It holds for the world; radiometric units are as above
};

/// Returns the world of Unreal Engine: centimetres, left-handed, x forward, y right, z up.
inline FRTModuleRendererDesc MakeUnrealWorld() { return {{0, 0, -1}, {1, 0, 0}, {0, 1, 0}, 0.01f}; }

/// A scene and the passes that render it.
class IRTModuleRenderer : public IRTRefCounted
{
public:
	virtual FRTStatus AddMaterial(const FRTModuleMaterial& Material, ERTMaterialHandle* Out) = 0;
	/// Replaces a material. InvalidArgument, naming mesh and section, if Material is masked and an object uses it on a section
	/// without FRTModuleSection::bMayBeMasked.
	virtual FRTStatus SetMaterial(ERTMaterialHandle Handle, const FRTModuleMaterial& Material) = 0;
	/// Removes a material; InvalidArgument while objects use it. May be called while frames that use it are in flight. Its
	/// texture is released as FRTModuleMaterial::BaseColorTexture says of a replaced one. The handle becomes invalid.
	virtual FRTStatus RemoveMaterial(ERTMaterialHandle Handle) = 0;
	/// Adds a mesh: copies the data and waits for the copy. One of the next calls of RenderFrame builds the acceleration
	/// structure, within r.RT.Build.TrianglesPerFrame, near and large meshes first. Rays do not see its objects until then.
	virtual FRTStatus AddMesh(const FRTModuleMesh& Mesh, ERTMeshHandle* Out) = 0;
	/// Replaces the vertices of a mesh with bDeformable, for all its objects, from the next RenderFrame on. The arrays are as in
	/// FRTModuleMesh, as long as in AddMesh, and read during the call. Costs a copy and a refit, and a rebuild every
	/// r.RT.Skinning.RebuildInterval such frames. Several calls before one RenderFrame cost as much as one.
	virtual FRTStatus UpdateMeshVertices(ERTMeshHandle Handle, const float* Positions, const float* Normals) = 0;
	/// Removes a mesh; InvalidArgument, with its name, while objects use it. The handle becomes invalid. The error of a later
	/// use names the removed mesh.
	virtual FRTStatus RemoveMesh(ERTMeshHandle Handle) = 0;
	/// Adds an object. InvalidArgument, naming mesh and section, for a masked material on a section without bMayBeMasked.
	/// Unsupported if there are 2^24 objects, which is the limit of instance indices.
	virtual FRTStatus AddObject(const FRTModuleObject& Object, ERTObjectHandle* Out) = 0;
	virtual FRTStatus SetObjectTransform(ERTObjectHandle Handle, const double Transform[12]) = 0;
	/// Replaces the materials; the errors are those of AddObject.
	virtual FRTStatus SetObjectMaterials(ERTObjectHandle Handle, const ERTMaterialHandle* Materials, uint32_t Count) = 0;
	virtual FRTStatus SetObjectCastsShadow(ERTObjectHandle Handle, bool bCastsShadow) = 0;
	/// Removes an object. May be called while frames that show it are in flight.
	virtual FRTStatus RemoveObject(ERTObjectHandle Handle) = 0;
	virtual FRTStatus SetSun(const FRTModuleSun& Sun) = 0;
	/// Sets the radiance of a uniform sky: nits, linear Rec.709, finite, ≥ 0. 0 (default): no sky.
	virtual FRTStatus SetSky(const float Radiance[3]) = 0;

	/// Records the frame into Frame.Commands. On an error the command list must not be submitted.
	virtual FRTStatus RenderFrame(const FRTModuleFrame& Frame, FRTModuleOutputs* Out) = 0;
	/// Ends the frame. Call after submitting the commands of RenderFrame, before the next RenderFrame. OutFence may be null.
	virtual FRTStatus EndFrame(FRTFence* OutFence) = 0;
};

class IRTModule : public IRTRefCounted
{
public:
	virtual uint32_t GetVersion() const = 0;          ///< the library's ModuleVersion
	virtual const char* GetVersionString() const = 0; ///< as in Plugin.json
	/// Initialises the module. Call once, before all functions below. IoError names a folder that is missing; after an error the
	/// call may be repeated.
	virtual FRTStatus Initialize(const FRTModuleDesc& Desc) = 0;
	/// Creates a device of Lantern's own on the best Vulkan device, for tools. An engine hands over its own device instead.
	virtual FRTStatus CreateDevice(bool bValidation, IRTDevice** Out) = 0;
	/// Returns the interface that adopts an engine's VkDevice; see ModuleVulkan.h. It lives as long as the module. Do not release.
	virtual IRTModuleVulkan* GetVulkan() = 0;
	/// Creates a renderer. Device comes from CreateDevice or IRTModuleVulkan::AdoptDevice, or is the engine's own IRTDevice.
	virtual FRTStatus CreateRenderer(IRTDevice* Device, const FRTModuleRendererDesc& Desc, IRTModuleRenderer** Out) = 0;
	/// Sets a console variable by name or alias, from text. Takes effect with the next frame. InvalidArgument names the nearest
	/// known name.
	virtual FRTStatus SetConsoleVariable(const char* Name, const char* Value) = 0;
	/// Gets the newest value as text, cut to Capacity. InvalidArgument if there is no such variable.
	virtual FRTStatus GetConsoleVariable(const char* Name, char* Out, size_t Capacity) = 0;
};

} // namespace Lantern

/// The library's only exported function. RequestedVersion is the ModuleVersion that the engine was compiled with. Returns Ok
/// (as a number), or Unsupported with *Out null if the library has another version. InvalidArgument: Out is null, or there is a
/// module already; one may exist at a time.
extern "C" int32_t LanternCreateModule(uint32_t RequestedVersion, Lantern::IRTModule** Out);

namespace Lantern
{

/// The type of the function that Plugin.json's entryPoint names, for dlsym.
using FRTCreateModule = int32_t (*)(uint32_t RequestedVersion, IRTModule** Out);

} // namespace Lantern
