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
// Threads: IRTModule may be called from any thread, and so may the calls of a renderer that change its scene (Add…, Set…,
// Remove…, Update…). RenderFrame, EndFrame and Recreate belong to one thread at a time; InvalidArgument
// refuses a second one. Nothing throws. A handle is valid for its renderer
// only.
// Errors: every build checks what an engine passes, handles that are stale or of another renderer included. InvalidArgument says
// what is wrong; nothing has changed then. Arrays must be as long as their counts say, which nobody can check.
#pragma once

#include "LanternModule/ModuleFrame.h"
#include "LanternModule/ModuleMesh.h"
#include "LanternRHI/RTInterfaces.h"
#include "LanternSignals/Signals.h"

namespace Lantern
{

/// Incremented when anything changes that an engine was compiled with: in this folder, LanternSignals/Signals.h or
/// the RHI. The library refuses other versions. A new signal is no change: the arrays have room for MaxSignals.
inline constexpr uint32_t ModuleVersion = 12;

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
enum class ERTObjectHandle : uint64_t
{
	None = 0
};
enum class ERTLightHandle : uint64_t
{
	None = 0
};
/// Returns the number of a light in FRTModuleLightMask::Lights. Its lower 24 bits are small and no two living lights share them, so that
/// they serve as an index; 0 is none. The upper 8 tell a light from those that had the index before.
inline constexpr uint32_t GetLightNumber(ERTLightHandle Handle)
{
	const uint64_t Bits = static_cast<uint64_t>(Handle);
	return static_cast<uint32_t>((Bits & 0xffffff) | ((Bits >> 32 & 0xff) << 24));
}
enum class ERTIesHandle : uint64_t
{
	None = 0
};

/// A map of a material: a texture, how it is sampled, and where its texels lie on the surface.
struct FRTModuleMap
{
	/// Null: no map. It must be created on or imported into the renderer's device with ERTTextureUsage::Sampled, and be in
	/// ShaderRead whenever a frame runs. The renderer holds a reference. The engine must keep the image of an imported texture
	/// alive while frames may read it. After SetMaterial with another texture or RemoveMaterial, that is until the fence of the first
	/// frame with FRTModuleOutputs::bCallsTaken has passed. Calls may wait in line for some frames. After the renderer's last
	/// frame, it is until the renderer is released.
	IRTTexture* Texture = nullptr;
	IRTSampler* Sampler = nullptr; ///< required with a texture; one of the first 1,024 of the device
	uint32_t UVSet = 0;            ///< 0: FRTModuleMesh::UVs, 1: FRTModuleMesh::UVs1
	/// KHR_texture_transform as a matrix: (u, v) becomes (M0 u + M1 v + Offset0, M2 u + M3 v + Offset1).
	float UVMatrix[4] = {1, 0, 0, 1};
	float UVOffset[2] = {0, 0};
};

/// A material of glTF 2.0 metallic-roughness, with its maps and the extensions ior, specular, transmission, volume and
/// diffuse_transmission. All values
/// must be finite, and colours not negative. Maps multiply the values beside them.
struct FRTModuleMaterial
{
	float BaseColor[4] = {1, 1, 1, 1}; ///< linear; a: opacity
	float Emissive[3] = {0, 0, 0};     ///< nits
	float Metallic = 0.0f;             ///< 0–1
	float Roughness = 1.0f;            ///< perceptual, 0–1
	float NormalScale = 1.0f;          ///< of the normal map's x and y
	float OcclusionStrength = 1.0f;    ///< of the occlusion map, 0–1
	float Ior = 1.5f;                  ///< of a dielectric, ≥ 1
	float Specular = 1.0f;             ///< KHR_materials_specular: specularFactor, 0–1
	/// Share of light that is not reflected by the dielectric layer and shines through, 0–1. Rays to lights pass where a section of a
	/// mesh may be masked (FRTModuleSection::bMayBeMasked); others cast shadows.
	float Transmission = 0.0f;
	FRTModuleMap BaseColorMap;         ///< sRGB format; the alpha test reads its alpha
	FRTModuleMap MetallicRoughnessMap; ///< g: roughness, b: metalness
	FRTModuleMap NormalMap;            ///< tangent space, from 0–1 to −1–1; only on meshes with tangents
	FRTModuleMap OcclusionMap;         ///< r
	FRTModuleMap EmissiveMap;          ///< sRGB format
	/// Mean of EmissiveMap, linear. Light sampling chooses triangles by it; a wrong one costs noise alone.
	float EmissiveMapMean[3] = {1, 1, 1};
	bool bMasked = false; ///< alpha-tested: texels below AlphaCutoff let rays pass
	float AlphaCutoff = 0.5f;
	bool bDoubleSided = false;
	/// Emission where the surface lights something, nits, in place of Emissive: lamps that look dim may shine. Cameras and mirrors see
	/// Emissive. EmissiveMap multiplies both. Only with bLightEmissive.
	float LightEmissive[3] = {0, 0, 0};
	bool bLightEmissive = false;
	FRTModuleMap TransmissionMap; ///< r
	bool bSolid = false;          ///< with Transmission: the surface of a volume, which bends light. Else a thin sheet
	/// The colour that white light has after AttenuationDistance in what is solid, 0–1 and > 0 (KHR_materials_volume).
	float AttenuationColor[3] = {1, 1, 1};
	float AttenuationDistance = 1.0f; ///< metres, > 0
	/// The opacity is the share of its place that the surface covers. The rest shows what lies behind, layer by layer. As with bMasked,
	/// the section of a mesh must say that it may be masked. With Transmission > 0, that counts alone. Light sampling finds no emission of
	/// such surfaces, but paths of indirect light do. If r.RT.Transmission is off, they are cut at AlphaCutoff.
	bool bBlended = false;
	/// Share of the diffuse layer's light that leaves the surface on its other side, 0–1: leaves, paper, cloth
	/// (KHR_materials_diffuse_transmission). Pixels show it if FRTModuleFrame::BackAlbedo says so.
	float DiffuseTransmission = 0.0f;
	float DiffuseTransmissionColor[3] = {1, 1, 1}; ///< factor of what leaves there, linear, 0–1
	FRTModuleMap DiffuseTransmissionMap;           ///< a
	FRTModuleMap DiffuseTransmissionColorMap;      ///< sRGB format
	/// With bSolid: the share of what AttenuationColor takes from light that is scattered and not absorbed, 0–1: water, milk, wax
	/// (KHR_materials_volume_scatter). It counts light that is scattered once. That extension's multiscatterColor counts all of it.
	float ScatterAlbedo[3] = {0, 0, 0};
	/// Mean cosine of the angle by which scattering turns light, greater than -1 and less than 1. 0: evenly to all sides.
	float ScatterAnisotropy = 0.0f;
};

/// What an engine knows of an object's future.
enum class ERTModuleMobility : uint8_t
{
	Static,     ///< never moves: SetObjectTransform refuses it
	Stationary, ///< does not move, but its light may change. No pass makes a difference yet between this and Static
	Movable,    ///< moves or deforms; a host's shadow map may leave it to rays
};

/// How diffuse indirect light falls on an object of a stylised look. ESignal::RoughSpecular has its normals as well. Other light, and what
/// the object sends to others, stay as they are.
/// The light of a pixel is taken in these steps: its normal turns to that of a sphere, and then to the camera. Light is gathered about it.
/// Saturation and value of the light are limited, its hue is kept. The tint colours it, without a change of its luminance.
struct FRTModuleToon
{
	/// Centre of the sphere, in the mesh's space. A mesh that deforms may move it in each frame, with the head's bone.
	float Center[3] = {0, 0, 0};
	/// 0: the object's own normals, to 1: those of the sphere. Above 0, objects with a sphere, such as faces and hair, hide no light from it.
	float SphereWeight = 0.0f;
	float Bend = 0.35f;         ///< to the camera: 0 to 1, where all faces the camera
	float MaxSaturation = 0.5f; ///< of the light: 1 - least / greatest component. 0 to 1, which is no limit
	/// Greatest component that a white surface shows, in units of the picture's white; ≥ 0. 0: no limit. Needs FRTModuleFrame::Exposure.
	float MaxValue = 0.8f;
	/// By how much the sample engine's lighting darkens the light by ambient occlusion, 0 to 1. An engine does so by itself, with
	/// ESignal::AmbientOcclusion.
	float Occlusion = 0.0f;
	float Tint[3] = {1, 1, 1}; ///< such as (1, 0.93, 0.88) for skin; ≥ 0, not black
	/// 1 to 255: FRTModuleFrame::ToonNumbers names the object by it, as a custom stencil does. 0: nothing names it, and it has no effect.
	/// Objects may share a number. The style that was set last then counts for all.
	uint8_t Number = 0;
};

struct FRTModuleObject
{
	ERTMeshHandle Mesh = ERTMeshHandle::None;
	const ERTMaterialHandle* Materials = nullptr; ///< one for each of the mesh's sections
	uint32_t MaterialCount = 0;
	/// Object to world: 3 rows of 4, the last column being the translation.
	double Transform[12] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0};
	bool bCastsShadow = true;
	/// False: only from the sun and the sky, as of trees that lamps should shine through. A character casts from all lights.
	bool bCastsLocalShadow = true;
	/// A character casts no shadow on characters or on itself, so that faces have no self-shadow. FRTModuleFrame::Classes says which
	/// pixels show one.
	bool bCharacter = false;
	/// Lights light it that share a bit with it (FRTModuleLight::Channels). Bit 0 is channel 0. Channels do not change who casts.
	uint8_t Channels = 1;
	bool bVisible = true; ///< seen by all rays but those of shadows: reflections and diffuse light
	ERTModuleMobility Mobility = ERTModuleMobility::Movable;
	const FRTModuleToon* Toon = nullptr; ///< read during the call; null: light falls on it as it is
};

enum class ERTModuleLight : uint8_t
{
	Point,
	Spot,
	Directional,
	Rectangle,
	Disk,
	Sphere,
	Tube, ///< a cylinder with rounded ends
};

/// A light other than the sun. Point, spot and directional lights are those of KHR_lights_punctual. The others have an area, soft
/// shadows and nits. All numbers must be finite. A point light of I candela with a source radius r (metres) is a sphere of I / (π r²)
/// nits. A spot is such a sphere with bCone.
/// Rays that meet a light do not see it: give it a mesh where it should be seen. Shadow rays stop short of a mesh at its surface. A
/// mesh around it must not cast shadows. A mesh that emits adds its own light.
struct FRTModuleLight
{
	ERTModuleLight Type = ERTModuleLight::Point;
	/// The centre; not of a directional light. Up to 1e12. A light farther than 262 km from the camera may shine from elsewhere.
	double Position[3] = {0, 0, 0};
	/// In which the light travels, any length > 0: of spots, directional, rectangles, disks, cones and profiles.
	float Direction[3] = {0, -1, 0};
	/// Direction of a rectangle's width, of a tube's axis, or of a profile's horizontal angle 0. Any length > 0. Not along Direction;
	/// a profile begins anywhere then.
	float Tangent[3] = {1, 0, 0};
	/// With intensity: candela of points and spots, lux of directional lights, nits of the others. 0 to 1e20. With a profile it is that
	/// of the profile's brightest direction: Color times FRTModuleIesInfo::Peak has the intensities of the file.
	float Color[3] = {0, 0, 0};
	float Range = 0.0f;           ///< at which it has faded out, in the unit of the engine's world; 0: unlimited
	float InnerCone = 0.0f;       ///< of a spot: angle from its axis at which it begins to fade, radians
	float OuterCone = 0.7853982f; ///< and ends, radians, > InnerCone, at most π/2
	float Width = 0.0f;           ///< of a rectangle, in the unit of the engine's world, > 0, at most 1e9
	float Height = 0.0f;          ///< of a rectangle, as Width
	float Radius = 0.0f;          ///< of a disk, sphere or tube, as Width
	float Length = 0.0f;          ///< of a tube's straight part, 0 to 1e9
	float AngularDiameter = 0.0f; ///< of a directional light, radians, 0 to π
	bool bCone = false;           ///< a rectangle, disk, sphere or tube has the cones of a spot as well
	bool bTwoSided = false;       ///< a rectangle or disk shines to its back, too
	bool bCastsShadow = true;     ///< false: it shines through everything (fill light)
	bool bLightsFog = true;       ///< fog scatters it (FRTModuleFog::Light)
	/// Objects that share a bit with it are lit by it (FRTModuleObject::Channels). Bit 0 is channel 0. Fog has no channels.
	uint8_t Channels = 1;
	ERTIesHandle Ies = ERTIesHandle::None; ///< of points and spots: intensity by direction. A spot has its cones as well
};

/// Luminous intensity of a luminaire by direction, photometry of type C: a file of IES LM-63, or a table. Arrays are read during the
/// call.
struct FRTModuleIesProfile
{
	const char* Name = nullptr; ///< of the file, for messages; may be null
	const char* Text = nullptr; ///< the file; null: the table below
	uint64_t TextBytes = 0;     ///< without a zero byte
	/// Degrees from FRTModuleLight::Direction, rising from 0 or 90 to 90 or 180. It is dark outside of them.
	const float* VerticalAngles = nullptr;
	uint32_t VerticalCount = 0; ///< 2 to 4096
	/// Degrees from FRTModuleLight::Tangent, counterclockwise as seen along Direction: from above a lamp that shines down. They rise from
	/// 0 to 0, 90, 180 or 360, or from 90 to 270. The rest mirrors them.
	const float* HorizontalAngles = nullptr;
	uint32_t HorizontalCount = 0;   ///< 1 to 4096
	const float* Candela = nullptr; ///< [HorizontalCount][VerticalCount], ≥ 0, not all 0
};

struct FRTModuleIesInfo
{
	float Peak = 0.0f; ///< candela of the brightest direction
};

struct FRTModuleSun
{
	double Direction[3] = {0, -1, 0}; ///< direction in which the light travels; any length > 0
	float Color[3] = {1, 1, 1};
	float Irradiance = 0.0f;      ///< of a plane that faces the sun, lux; 0: no sun and no shadow pass
	float AngularDiameter = 0.0f; ///< radians, 0 to π; 0: hard shadows
	uint8_t Channels = 1;         ///< as FRTModuleLight::Channels. The sun's shadow is of all pixels, whatever their objects' channels are
};

enum class ERTModuleSkyMap : uint8_t
{
	Cube,       ///< a texture with FRTTextureDesc::bCube; faces as Vulkan and Direct3D order and orient them
	Octahedral, ///< a square 2D texture (Cigolle et al. 2014): the upper half z ≥ 0 inside, the lower half folded out to the corners
};

/// Radiance of the sky by direction, without the sun's disk: that is FRTModuleSun's. Light sampling does not know bright spots in
/// it, so these cost noise.
struct FRTModuleSkyMap
{
	IRTTexture* Texture = nullptr; ///< not null; its rules are those of FRTModuleMap::Texture, with SetSkyMap for SetMaterial
	IRTSampler* Sampler = nullptr; ///< not null; linear and clamped is right. Octahedral maps have a seam of half a texel
	ERTModuleSkyMap Kind = ERTModuleSkyMap::Cube;
	float Intensity = 1.0f; ///< nits of a texel of 1; finite, ≥ 0
	/// Three rows: from directions in the engine's world to those in the map. A rotation, mirrored or not.
	float WorldToMap[9] = {1, 0, 0, 0, 1, 0, 0, 0, 1};
};

/// Sky of a shader, FRTModuleRendererDesc::SkyShader. It also gets the sun of SetSun and, as a measure of its brightness, the radiance of
/// SetSky. The plugin bakes it into a map (r.RT.Sky.Bake), which rays read.
struct FRTModuleSkyProgram
{
	/// What moves clouds, in seconds, from -1e7 to 1e7. Shaders get a float, so wrap it every few hours. What rays see is one to two
	/// r.RT.Sky.RefreshSeconds old.
	double Seconds = 0.0;
	/// Any numbers of the engine's, finite: FSkyData::Values. A change by more than 2 % shows at once. The plugin's own sky reads four: the
	/// cover of its low and of its high clouds, 0 to 1, and the wind. The wind is along x and z of a world with y up, in metres a second.
	float Values[64] = {};
};

/// Gets User and the share that is done, 0 to 1.
using FRTModuleProgress = void (*)(void* User, float Done);
/// The engine's world: directions of its axes in a right-handed world with y up, and its unit. All that crosses the interface is
/// in it: transforms, positions, directions, views and motion. Object space is the engine's, too. The default is Lantern's.
struct FRTModuleRendererDesc
{
	/// Unit length, perpendicular to each other. A left-handed engine's are mirrored, which is fine.
	float AxisX[3] = {1, 0, 0}, AxisY[3] = {0, 1, 0}, AxisZ[3] = {0, 0, 1};
	float MetersPerUnit = 1.0f; ///< 0.01 for centimetres; > 0. It holds for the world; radiometric units are as above
	/// Shader of an engine whose shadow map is none of cascades, as a virtual one. An absolute path of a GLSL file that defines what
	/// Tiles/HostShadow.glsl of the shader folder does, and takes its place. Read during CreateRenderer. Null: cascades.
	const char* HostShadowShader = nullptr;
	/// Shader of the engine's sky. An absolute path of a GLSL file that defines what Sky/SkyProgram.glsl of the shader folder does, and takes
	/// its place. Directions that it gets are in the engine's world. It is compiled together with the plugin's libraries, so a prefix keeps its
	/// names apart. Read during CreateRenderer. Null: the plugin's own sky.
	const char* SkyShader = nullptr;
};

/// Returns the world of Unreal Engine: centimetres, left-handed, x forward, y right, z up.
inline FRTModuleRendererDesc MakeUnrealWorld() { return {{0, 0, -1}, {1, 0, 0}, {0, 1, 0}, 0.01f, nullptr, nullptr}; }

/// Gives meshes again to IRTModuleRenderer::Recreate. Get returns whether the engine still has the mesh. Out must be what AddMesh
/// had: as many sections, each with its bMayBeMasked, and bDeformable; vertices may be newer. Its arrays are read before the next
/// call of Get. Get runs on the thread that called Recreate and must not call the renderer.
struct FRTModuleMeshSource
{
	bool (*Get)(void* User, ERTMeshHandle Mesh, FRTModuleMesh* Out) = nullptr;
	void* User = nullptr;
};

/// A scene and the passes that render it.
///
/// Calls that change the scene check their arguments and give handles at once, from any thread. They wait for no GPU, no
/// compiler and no frame. The next RenderFrame takes them over, in the order of each thread. Things that come or go may take some
/// frames if there are many (r.RT.Scene.ArrivalsPerFrame); what is said of them meanwhile comes with them. Arrays are read during
/// the call. Errors about handles hold at the time of the call: a thread that removes what another one uses is told.
class IRTModuleRenderer : public IRTRefCounted
{
public:
	virtual FRTStatus AddMaterial(const FRTModuleMaterial& Material, ERTMaterialHandle* Out) = 0;
	/// Replaces a material. InvalidArgument, naming mesh and section, if Material is masked and an object uses it on a section
	/// without FRTModuleSection::bMayBeMasked.
	virtual FRTStatus SetMaterial(ERTMaterialHandle Handle, const FRTModuleMaterial& Material) = 0;
	/// Removes a material; InvalidArgument while objects use it. May be called while frames that use it are in flight. Its
	/// maps are released as FRTModuleMap::Texture says of replaced ones. The handle becomes invalid.
	virtual FRTStatus RemoveMaterial(ERTMaterialHandle Handle) = 0;
	/// Adds a mesh: copies the arrays on the CPU. Frames copy them on to the GPU, within r.RT.Upload.MBPerFrame, on the device's
	/// queue for copies if it has one. A later frame builds the acceleration structure, within r.RT.Build.TrianglesPerFrame, near
	/// and large meshes first. Rays do not see its objects until then.
	virtual FRTStatus AddMesh(const FRTModuleMesh& Mesh, ERTMeshHandle* Out) = 0;
	/// Adds a patch of a landscape as a mesh, as AddMesh. The renderer keeps the heights; Recreate does not ask for them.
	virtual FRTStatus AddLandscape(const FRTModuleLandscape& Patch, ERTMeshHandle* Out) = 0;
	/// Changes heights of a patch, from the next RenderFrame on; holes stay. Costs what the patch costs, whatever the landscape's size.
	/// InvalidArgument if the mesh did not come from AddLandscape.
	virtual FRTStatus SetLandscapeHeights(ERTMeshHandle Handle, const FRTModuleHeights& Heights) = 0;
	/// Replaces the vertices of a mesh with bDeformable, for all its objects, from the next RenderFrame on. The arrays are as in
	/// FRTModuleMesh, as long as in AddMesh, and read during the call. Costs a copy and a refit, and a rebuild every
	/// r.RT.Skinning.RebuildInterval such frames. Several calls before one RenderFrame cost as much as one. InvalidArgument for
	/// meshes with Streams and for landscapes, which have calls of their own.
	virtual FRTStatus UpdateMeshVertices(ERTMeshHandle Handle, const float* Positions, const float* Normals) = 0;
	/// Returns where the vertices of a mesh with bDeformable lie, for an engine whose GPU writes them. InvalidArgument if the mesh has
	/// no bDeformable, or no BoundsRadius that holds all that the engine will write; and for meshes with Streams and landscapes.
	virtual FRTStatus GetMeshBuffer(ERTMeshHandle Handle, FRTModuleMeshBuffer* Out) = 0;
	/// Says that the engine's GPU has written new positions of the mesh. The work must come before the next RenderFrame's commands,
	/// on one queue, with a barrier to shader reads and acceleration structure builds between. Writing again needs that barrier, too.
	/// Normals stay as they were.
	virtual FRTStatus MarkMeshDeformed(ERTMeshHandle Handle) = 0;
	/// Removes a mesh; InvalidArgument, with its name, while objects use it. The handle becomes invalid. The error of a later
	/// use names the removed mesh.
	virtual FRTStatus RemoveMesh(ERTMeshHandle Handle) = 0;
	/// Adds an object. InvalidArgument, naming mesh and section, for a masked material on a section without bMayBeMasked.
	/// Unsupported if there are 2^24 objects, which is the limit of instance indices.
	virtual FRTStatus AddObject(const FRTModuleObject& Object, ERTObjectHandle* Out) = 0;
	/// Adds many objects: all of them or, on an error, which names the first wrong one, none. Out: one handle for each.
	virtual FRTStatus AddObjects(const FRTModuleObject* Objects, uint32_t Count, ERTObjectHandle* Out) = 0;
	virtual FRTStatus SetObjectTransform(ERTObjectHandle Handle, const double Transform[12]) = 0;
	/// Replaces the materials; the errors are those of AddObject.
	virtual FRTStatus SetObjectMaterials(ERTObjectHandle Handle, const ERTMaterialHandle* Materials, uint32_t Count) = 0;
	/// Shows another mesh as the object: a level of detail that the engine chose, or a change of model. The object keeps its
	/// place, its motion and what is accumulated on it. Until the new mesh has its acceleration structure, rays see the old one. The
	/// level stays until the next call, also while the engine does not draw the object. The errors are those of AddObject.
	virtual FRTStatus SetObjectMesh(ERTObjectHandle Handle, ERTMeshHandle Mesh, const ERTMaterialHandle* Materials, uint32_t Count) = 0;
	virtual FRTStatus SetObjectCastsShadow(ERTObjectHandle Handle, bool bCastsShadow) = 0;
	virtual FRTStatus SetObjectVisible(ERTObjectHandle Handle, bool bVisible) = 0;
	/// Sets FRTModuleObject::Channels. The first object or light without channel 0 needs other shaders, which compile beside the frames.
	virtual FRTStatus SetObjectChannels(ERTObjectHandle Handle, uint8_t Channels) = 0;
	/// Sets FRTModuleObject::Toon; null: none. Costs what changed, so that it may come with each frame. The first style of a scene needs
	/// other shaders, which compile beside the frames. InvalidArgument names the member that is wrong.
	virtual FRTStatus SetObjectToon(ERTObjectHandle Handle, const FRTModuleToon* Toon) = 0;
	/// Removes an object. May be called while frames that show it are in flight.
	virtual FRTStatus RemoveObject(ERTObjectHandle Handle) = 0;
	/// Adds a light. Costs what changed, whatever the number of lights; so do SetLight and RemoveLight. InvalidArgument names the
	/// member that is wrong. Unsupported if there are 2^23 lights.
	virtual FRTStatus AddLight(const FRTModuleLight& Light, ERTLightHandle* Out) = 0;
	virtual FRTStatus SetLight(ERTLightHandle Handle, const FRTModuleLight& Light) = 0;
	virtual FRTStatus RemoveLight(ERTLightHandle Handle) = 0;
	/// Adds a profile for lights. Info may be null. InvalidArgument names file, line and what is wrong there. Unsupported: photometry of
	/// types A and B, a tilt in another file, or more than 65,535 profiles. The first light with one needs other shaders.
	virtual FRTStatus AddIesProfile(const FRTModuleIesProfile& Profile, ERTIesHandle* Out, FRTModuleIesInfo* Info) = 0;
	/// Removes a profile; InvalidArgument while lights have it.
	virtual FRTStatus RemoveIesProfile(ERTIesHandle Handle) = 0;
	virtual FRTStatus SetSun(const FRTModuleSun& Sun) = 0;
	/// Sets the radiance of a uniform sky: nits, linear Rec.709, finite, ≥ 0. 0 (default): no sky.
	virtual FRTStatus SetSky(const float Radiance[3]) = 0;
	/// Makes a map the sky, from the next RenderFrame on, in place of SetSky's radiance. Null: SetSky's radiance again. A change of
	/// sky waits for nothing and compiles nothing, so that it may come with each frame. New texels of the texture may, too. A sky where
	/// there was none (radiance or Intensity 0) needs other shaders, which compile beside the frames.
	virtual FRTStatus SetSkyMap(const FRTModuleSkyMap* Map) = 0;
	/// Makes a program the sky, from the next RenderFrame on, in place of a map. Null: the map or radiance again. A change of what the program
	/// gets compiles nothing, so that it may come with each frame. A shader that does not compile is logged, and the sky is then the map or the
	/// radiance. With r.RT.Sky.Bake off, what asks for the sky is left out instead.
	virtual FRTStatus SetSkyProgram(const FRTModuleSkyProgram* Program) = 0;

	/// Compiles what frames like Frame will run in the scene as it is, and waits for it. For load time, between frames: the first
	/// frames then have their outputs. Reads Wanted, View, Layout and the textures; Commands may be null. Without Depth or Normals it
	/// reads Wanted and Layout alone. Progress is called with 0 to 1 during the call, and may be null. CompileFailed if a shader does
	/// not compile; frames go on without it.
	virtual FRTStatus Precache(const FRTModuleFrame& Frame, FRTModuleProgress Progress, void* User) = 0;
	/// Records the frame into Frame.Commands. On an error the command list must not be submitted. DeviceLost: every frame is
	/// refused until Recreate; the log says so once.
	/// Changes what the command buffer has bound. Pipelines and descriptor sets of the compute and ray-tracing bind points are then
	/// Lantern's or none, and push constants of all stages are undefined. The pipeline and sets of the graphics bind point, vertex
	/// and index buffers and dynamic state stay. No render pass, query or label is left open.
	virtual FRTStatus RenderFrame(const FRTModuleFrame& Frame, FRTModuleOutputs* Out) = 0;
	/// Ends the frame. Call after submitting the commands of RenderFrame, before the next RenderFrame. OutFence may be null.
	virtual FRTStatus EndFrame(FRTFence* OutFence) = 0;

	/// Takes the scene over to another device after ERTResult::DeviceLost, or at will. Handles, objects, lights, sun, sky and
	/// materials stay, without their maps: the engine gives maps again by SetMaterial and SetSkyMap. Source gives the meshes, but for
	/// landscapes; objects of a mesh that it does not give are not seen. All textures, lists and buffers of the old device are void.
	/// A frame that was not ended is none. Uploads and structures follow the budgets of frames, as after AddMesh. InvalidArgument
	/// names a mesh that Source gives otherwise than it was; on an error nothing has changed, and the call may be repeated. Render
	/// thread.
	virtual FRTStatus Recreate(IRTDevice* Device, const FRTModuleMeshSource& Source) = 0;
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
