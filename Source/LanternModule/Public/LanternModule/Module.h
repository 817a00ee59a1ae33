// The plugin as an engine sees it: one C entry point, then interfaces. An engine reads Plugin.json, loads the
// library that it names, looks LanternCreateModule up, and needs nothing else of Lantern's at link time.
//
//   load library → LanternCreateModule → Initialize → a device (its own: CreateDevice; the engine's: ModuleVulkan.h)
//   → CreateRenderer → AddMaterial, AddMesh, AddObject, SetSun, SetSky
//   → each frame: RenderFrame into the engine's command buffer, submit it, EndFrame
//   → Release everything, the device and the module last → unload the library
//
// Units: metres, radians, nits and lux; linear Rec.709; right-handed, y up. World positions are double precision.
// Threads: IRTModule from any thread; a renderer from one at a time. Nothing throws. Handles of one renderer mean
// nothing to another.
// Errors: what an engine hands over is checked in every build. InvalidArgument says what is wrong with it, a stale
// handle included, and that nothing has changed.
#pragma once

#include "LanternRHI/RTInterfaces.h"
#include "LanternSignals/Signals.h"

namespace Lantern
{

/// Bumped when anything in this header changes. The library refuses another version. A new signal is no change: the arrays have
/// room for MaxSignals.
inline constexpr uint32_t ModuleVersion = 5;

class IRTModuleVulkan;

enum class ERTModuleLog : uint8_t
{
	Debug,
	Info,
	Warning,
	Error,
};

/// Called from any thread, must not call the module. Text: one line, no newline, valid during the call.
using FRTModuleLogCallback = void (*)(void* User, ERTModuleLog Level, const char* Text);

/// Folders: absolute, or relative to the process's working directory.
struct FRTModuleDesc
{
	const char* ConfigFolder = nullptr;         ///< Plugin.json's configFolder; null: console variables keep their defaults
	const char* ShaderFolder = nullptr;         ///< Plugin.json's shaderFolder; needed
	const char* CacheFolder = nullptr;          ///< compiled shaders are kept here, and created if missing; null: not kept
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

/// glTF 2.0 metallic-roughness, as far as a module without the host's texture loader needs it. All finite, no colour negative.
struct FRTModuleMaterial
{
	float BaseColor[4] = {1, 1, 1, 1}; ///< linear; a: opacity
	float Emissive[3] = {0, 0, 0};     ///< nits
	float Metallic = 0.0f;             ///< 0–1
	float Roughness = 1.0f;            ///< perceptual, 0–1
	/// Times BaseColor; its alpha is what an alpha test reads. Created on or imported into the renderer's device with
	/// ERTTextureUsage::Sampled, and in ShaderRead whenever a frame runs. The renderer holds a reference. An image
	/// behind an imported one must outlive what reads it: after SetMaterial to another texture or RemoveMaterial, until the fence of the
	/// next EndFrame has passed; after the renderer's last frame, until the renderer is released. Null: none.
	IRTTexture* BaseColorTexture = nullptr;
	IRTSampler* BaseColorSampler = nullptr; ///< needed with a texture
	bool bMasked = false;                   ///< alpha-tested: texels below AlphaCutoff let rays pass
	float AlphaCutoff = 0.5f;
	bool bDoubleSided = false;
};

struct FRTModuleSection
{
	uint32_t FirstIndex = 0;
	uint32_t IndexCount = 0; ///< > 0, a multiple of 3
	/// Some object may give this section a masked material; where it is false, that is InvalidArgument. True costs
	/// nothing until an object has a masked material; then alpha tests are set up for all such sections of it.
	bool bMayBeMasked = false;
};

/// Read during AddMesh and copied to the GPU. Skinned meshes: bDeformable, with vertices skinned by the engine's CPU;
/// vertices that the GPU has skinned cannot be handed over yet.
struct FRTModuleMesh
{
	const char* Name = "";
	const float* Positions = nullptr; ///< x, y, z of each vertex; finite
	const float* Normals = nullptr;   ///< x, y, z, unit length; null: of the triangles
	const float* UVs = nullptr;       ///< u, v; null: zeros
	uint32_t VertexCount = 0;
	const uint32_t* Indices = nullptr; ///< counter-clockwise is front; < VertexCount
	uint32_t IndexCount = 0;
	const FRTModuleSection* Sections = nullptr; ///< null: one section of all indices, with bMayBeMasked
	uint32_t SectionCount = 0;
	/// UpdateMeshVertices may be called. Traced a little more slowly, and a copy stays on the CPU.
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
	double Direction[3] = {0, -1, 0}; ///< in which its light travels; any length but 0
	float Color[3] = {1, 1, 1};
	float Irradiance = 0.0f;      ///< on a plane that faces it, lux; 0: no sun, and no shadow pass
	float AngularDiameter = 0.0f; ///< radians, 0 to π; 0: hard shadows
};

struct FRTModuleView
{
	double Position[3] = {0, 0, 0};
	float Forward[3] = {0, 0, -1}; ///< unit length
	float Up[3] = {0, 1, 0};       ///< need not be perpendicular to Forward, must not be parallel to it
	float FovY = 1.0f;             ///< vertical, radians, between 0 and π
	float Near = 0.1f;             ///< > 0
};

/// The engine's G-buffer of one frame, all of one size, imported with IRTDevice::ImportTexture. All textures Sampled. The
/// access of each: how the engine used it last, not None; it is left in ShaderRead.
struct FRTModuleFrame
{
	/// From IRTDevice::ImportCommandList, recording, outside a render pass.
	IRTCommandList* Commands = nullptr;
	FRTModuleView View;
	/// D32_FLOAT or R32_FLOAT. Reversed without a far plane: near / distance along Forward; 0 is sky.
	IRTTexture* Depth = nullptr;
	/// RGBA16_SNORM: shading normal (xy) and geometric normal (zw), both octahedral (Cigolle et al. 2014) and turned
	/// towards the camera.
	IRTTexture* Normals = nullptr;
	/// RGBA32_FLOAT. xy: from the pixel's centre to where its surface was in the frame before, in pixels, y down; z: how far
	/// it was along Forward then, metres; w: a number > 0 of its object that stays the same over frames, 0: unknown. Not read
	/// where depth is 0. Null: what moves is taken for still, and shadows drag behind it where they are accumulated.
	IRTTexture* Motion = nullptr;
	IRTTexture* BaseColor = nullptr; ///< RGBA8_SRGB: base colour, a: metalness. May be null
	IRTTexture* Material = nullptr;  ///< RGBA8_UNORM: roughness, occlusion, sqrt(F0) of the dielectric, specular weight. May be null
	ERTAccess DepthAccess = ERTAccess::ShaderRead;
	ERTAccess NormalsAccess = ERTAccess::ShaderRead;
	ERTAccess MotionAccess = ERTAccess::ShaderRead;
	ERTAccess BaseColorAccess = ERTAccess::ShaderRead;
	ERTAccess MaterialAccess = ERTAccess::ShaderRead;
	/// Signals that the engine reads; ESignal::Frame is none. What is not wanted is not traced, allocates nothing and compiles
	/// nothing. What is wanted still needs its console variable on (r.RT.Shadow, r.RT.AO, …). A signal with
	/// FSignalInfo::bNeedsSurface needs BaseColor and Material.
	FSignalSet Wanted = {ESignal::SunShadow};
	/// Since the frame before, finite, > 0. What is accumulated is kept for seconds, whatever the frame rate.
	float DeltaSeconds = 1.0f / 60.0f;
	/// Nothing is carried over from the frame before: another place, another world. A change of size is seen without it.
	bool bCut = false;
	uint32_t Seed = 0; ///< same seed, frame number and scene: same image
};

/// Owned by the renderer, valid until its next RenderFrame. In ShaderRead; may be copied from, if the engine puts them
/// back in ShaderRead. Null: not asked for, off, the scene has nothing for it (no sun, …), the device cannot, an input is
/// missing, or shaders are not there yet.
struct FRTModuleOutputs
{
	/// By ESignal, which says what each holds; formats are in SignalInfos.
	IRTTexture* Signals[MaxSignals] = {};
	IRTTexture* Get(ESignal Signal) const { return Signals[ToIndex(Signal)]; }
	/// Ray-tracing shaders are compiled in the background; RenderFrame never waits for them. False: some that the scene
	/// wants are not there yet. An output is null until its first are; from then on objects whose own are missing have the
	/// shadow of a stand-in, or none (r.RT.Pipeline.Fallback, by which an engine may also have frames that wait). What does
	/// not compile is logged, keeps its stand-in and counts as there. Where shadows are traced by ray queries, the first frame
	/// still compiles their one compute shader itself.
	bool bShadersReady = false;
	/// All that the frame shows is there. False: shaders are missing, or some acceleration structures still wait for their
	/// turn (r.RT.Build.TrianglesPerFrame, r.RT.Build.MemoryMB), and rays do not see their objects yet.
	bool bComplete = false;
};

/// A scene and the passes over it.
class IRTModuleRenderer : public IRTRefCounted
{
public:
	virtual FRTStatus AddMaterial(const FRTModuleMaterial& Material, ERTMaterialHandle* Out) = 0;
	/// InvalidArgument, naming mesh and section, if Material is masked and an object uses it on a section that may not
	/// be (FRTModuleSection::bMayBeMasked).
	virtual FRTStatus SetMaterial(ERTMaterialHandle Handle, const FRTModuleMaterial& Material) = 0;
	/// InvalidArgument while objects use it. At any time, also while frames that see it are in flight; what it referred to
	/// goes as FRTModuleMaterial::BaseColorTexture says of a replaced one. The handle is void.
	virtual FRTStatus RemoveMaterial(ERTMaterialHandle Handle) = 0;
	/// Copies the data and waits for the copy. The acceleration structure is built by one of the next calls of RenderFrame,
	/// within r.RT.Build.TrianglesPerFrame, near and large meshes first; until then its objects are not seen by rays.
	virtual FRTStatus AddMesh(const FRTModuleMesh& Mesh, ERTMeshHandle* Out) = 0;
	/// New vertices for a mesh added with bDeformable, for all its objects, from the next RenderFrame on. Arrays as in
	/// FRTModuleMesh and as long as they were in AddMesh; read during the call. Costs a copy and a refit (a rebuild
	/// every r.RT.Skinning.RebuildInterval such frames); calls before the same RenderFrame cost one.
	virtual FRTStatus UpdateMeshVertices(ERTMeshHandle Handle, const float* Positions, const float* Normals) = 0;
	/// InvalidArgument, with its name, while objects use it. The handle is void: whoever uses it later is told the name of
	/// the mesh that it was.
	virtual FRTStatus RemoveMesh(ERTMeshHandle Handle) = 0;
	/// InvalidArgument, naming mesh and section, for a masked material on a section that may not be. Unsupported: an
	/// instance cannot name more objects than there are (2^24).
	virtual FRTStatus AddObject(const FRTModuleObject& Object, ERTObjectHandle* Out) = 0;
	virtual FRTStatus SetObjectTransform(ERTObjectHandle Handle, const double Transform[12]) = 0;
	/// As in AddObject.
	virtual FRTStatus SetObjectMaterials(ERTObjectHandle Handle, const ERTMaterialHandle* Materials, uint32_t Count) = 0;
	virtual FRTStatus SetObjectCastsShadow(ERTObjectHandle Handle, bool bCastsShadow) = 0;
	/// At any time, also while frames that see it are in flight.
	virtual FRTStatus RemoveObject(ERTObjectHandle Handle) = 0;
	virtual FRTStatus SetSun(const FRTModuleSun& Sun) = 0;
	/// Radiance of the sky, the same in all directions; nits, linear Rec.709, finite, ≥ 0. 0 (default): no sky.
	virtual FRTStatus SetSky(const float Radiance[3]) = 0;

	/// Records all of the frame into Frame.Commands. On an error the list must not be submitted.
	virtual FRTStatus RenderFrame(const FRTModuleFrame& Frame, FRTModuleOutputs* Out) = 0;
	/// After the engine submitted what RenderFrame recorded, before the next RenderFrame. OutFence may be null.
	virtual FRTStatus EndFrame(FRTFence* OutFence) = 0;
};

class IRTModule : public IRTRefCounted
{
public:
	virtual uint32_t GetVersion() const = 0;          ///< ModuleVersion of the library
	virtual const char* GetVersionString() const = 0; ///< as in Plugin.json
	/// Once, before anything below. IoError names the folder that is not there.
	virtual FRTStatus Initialize(const FRTModuleDesc& Desc) = 0;
	/// A device of Lantern's own, on the best Vulkan device there is (tools; an engine hands over its own).
	virtual FRTStatus CreateDevice(bool bValidation, IRTDevice** Out) = 0;
	/// To hand over an engine's VkDevice; see ModuleVulkan.h. Lives as long as the module; not to be released.
	virtual IRTModuleVulkan* GetVulkan() = 0;
	/// Device: from CreateDevice, IRTModuleVulkan::AdoptDevice, or the engine's own implementation of IRTDevice.
	virtual FRTStatus CreateRenderer(IRTDevice* Device, IRTModuleRenderer** Out) = 0;
	/// Name or alias, value as text. InvalidArgument names the nearest known name. Takes effect with the next frame.
	virtual FRTStatus SetConsoleVariable(const char* Name, const char* Value) = 0;
	/// The newest value as text, cut to Capacity; InvalidArgument if there is no such variable.
	virtual FRTStatus GetConsoleVariable(const char* Name, char* Out, size_t Capacity) = 0;
};

} // namespace Lantern

/// The library's only exported function. RequestedVersion: ModuleVersion as the engine was compiled with. Ok, or
/// Unsupported (as a number) and *Out null when the library has another version. One module at a time.
extern "C" int32_t LanternCreateModule(uint32_t RequestedVersion, Lantern::IRTModule** Out);

namespace Lantern
{

/// What a dlsym of Plugin.json's entryPoint gives.
using FRTCreateModule = int32_t (*)(uint32_t RequestedVersion, IRTModule** Out);

} // namespace Lantern
