// What an engine hands to IRTModuleRenderer::RenderFrame, and what it gets back. Module.h has the units and the rules.
#pragma once

#include <cmath>

#include "LanternRHI/RTInterfaces.h"
#include "LanternSignals/Signals.h"

namespace Lantern
{

/// A projection as the engine has it: any that is reversed or not, with or without a far plane, off-centre, orthographic or
/// mirrored. MakeProjection makes a simple one. Refused are: what mixes x with y, oblique near planes, and shifts of the eye.
struct FRTModuleProjection
{
	/// View space to clip space, without jitter: clip = ViewToClip · view, four rows of four. Depth is z / w, from 0 to 1. Engines
	/// with row vectors hand over the transposed matrix. View space has x to the right, and the engine's unit.
	/// Precision: the very numbers that the raster used.
	float ViewToClip[16] = {};
	bool bViewYDown = false;    ///< view space has y downwards; else upwards
	bool bViewZForward = false; ///< view space has z forwards; else backwards. A perspective says so itself, by its w
	/// y of clip space points upwards on the picture, as in Direct3D, or with a Vulkan viewport of negative height. If false, it
	/// points downwards, as Vulkan has it.
	bool bClipYUp = false;
};

/// Returns the perspective of Vulkan with reversed depth: y down, near plane at 1, no far plane. FovY: vertical, radians, between 0
/// and π. Aspect: width / height. Near: > 0.
inline FRTModuleProjection MakeProjection(float FovY, float Aspect, float Near)
{
	const float Scale = 1.0f / std::tan(0.5f * FovY);
	return {{Scale / Aspect, 0, 0, 0, 0, -Scale, 0, 0, 0, 0, 0, Near, 0, 0, -1, 0}};
}

/// All in the engine's own world (FRTModuleRendererDesc).
struct FRTModuleView
{
	double Position[3] = {0, 0, 0};
	float Forward[3] = {0, 0, -1}; ///< unit length
	float Up[3] = {0, 1, 0};       ///< need not be perpendicular to Forward, must not be parallel to it; towards the picture's top
	FRTModuleProjection Projection;
	/// Offset of the picture that temporal antialiasing has added to the projection, pixels, right and down, at most 64. Surfaces are then found
	/// where they are, and accumulation does not take the jitter for motion.
	float Jitter[2] = {0, 0};
};

enum class ERTModuleDepth : uint8_t
{
	Projected, ///< as View.Projection made it: z / w
	Linear,    ///< distance along the view in the engine's unit; sky: 0 or less, and from the far plane of View.Projection on
};

enum class ERTModuleNormals : uint8_t
{
	Octahedral, ///< two channels (Cigolle et al. 2014)
	Xyz,        ///< three channels; of any length
};

enum class ERTModuleRange : uint8_t
{
	ByFormat, ///< UNORM formats from 0 to 1, all others from −1 to 1
	Signed,   ///< from −1 to 1
	Unsigned, ///< from 0 to 1, which stand for −1 to 1
};

enum class ERTModuleMotion : uint8_t
{
	/// RGBA32_FLOAT, see FRTModuleFrame::Motion.
	Native,
	/// xy · MotionScale + MotionOffset is the offset from the pixel's centre to where its surface was in the previous frame. Neither
	/// frame's jitter is in it. Pixels: in pixels, y down. UV: in parts of the picture, y down.
	Pixels,
	UV,
};

enum class ERTModuleMaterialLayout : uint8_t
{
	Native, ///< see FRTModuleFrame::BaseColor and Material
	/// Unreal Engine 4.26. Material: metallic, specular, roughness (GBufferB). BaseColor: base colour, occlusion (GBufferC).
	Unreal,
};

/// How the textures of a G-buffer are to be read. Defaults: as the members of FRTModuleFrame say, at no cost. Anything else costs a
/// pass over the pixels.
struct FRTModuleGBufferLayout
{
	ERTModuleDepth Depth = ERTModuleDepth::Projected;
	ERTModuleNormals Normals = ERTModuleNormals::Octahedral;
	ERTModuleRange NormalRange = ERTModuleRange::ByFormat;
	/// Normals are in view space: x right, y and z as FRTModuleProjection says of the view. Else in the engine's world.
	bool bViewSpaceNormals = false;
	/// Channels z and w of octahedral normals hold the geometric normal. If not, it comes from FRTModuleFrame::GeometricNormals, or,
	/// if that is null, from depth.
	bool bGeometricInZw = true;
	ERTModuleMotion Motion = ERTModuleMotion::Native;
	/// z and w of a Motion that is not native are as in a native one. If not, surfaces count as standing still along the view.
	bool bMotionDistance = false;
	/// Texels of Motion whose x and y are 0 were not written: their surface moves with the camera alone.
	bool bMotionPartial = false;
	float MotionScale[2] = {1, 1}, MotionOffset[2] = {0, 0};
	ERTModuleMaterialLayout Material = ERTModuleMaterialLayout::Native;
};

/// Returns the layout of Unreal Engine 4.26. Normals is GBufferA of any r.GBufferFormat, Material GBufferB, BaseColor GBufferC,
/// Depth the scene depth, and Motion the velocity texture.
inline FRTModuleGBufferLayout MakeUnrealGBuffer()
{
	FRTModuleGBufferLayout Layout;
	Layout.Normals = ERTModuleNormals::Xyz;
	Layout.NormalRange = ERTModuleRange::Unsigned;
	Layout.bGeometricInZw = false;
	// Velocity is a difference of clip-space positions, y up, this frame's minus the previous one's, times 0.499 · 0.5, plus
	// 32767 / 65535. 0 was not written.
	Layout.Motion = ERTModuleMotion::UV;
	Layout.bMotionPartial = true;
	constexpr float Scale = 1.0f / (0.499f * 0.5f), Middle = 32767.0f / 65535.0f;
	Layout.MotionScale[0] = -0.5f * Scale;
	Layout.MotionScale[1] = 0.5f * Scale;
	for (int Axis = 0; Axis < 2; ++Axis) { Layout.MotionOffset[Axis] = -Layout.MotionScale[Axis] * Middle; }
	Layout.Material = ERTModuleMaterialLayout::Unreal;
	return Layout;
}

/// Casters on an engine's shadow map (flags).
enum class ERTModuleCasters : uint32_t
{
	None = 0,
	Still = 1,      ///< objects with ERTModuleMobility::Static or Stationary
	Moving = 2,     ///< objects with ERTModuleMobility::Movable
	Characters = 4, ///< objects with FRTModuleObject::bCharacter. Such a map shadows characters, too; rays do not
	/// What rays cannot meet: billboards, translucent things, anything that the renderer was not given.
	Others = 8,
};
LANTERN_RT_FLAGS(ERTModuleCasters)

/// What the sun sees of a part of the world, by an orthographic projection.
struct FRTModuleShadowCascade
{
	/// D32_FLOAT, D32_FLOAT_S8_UINT, D24_UNORM_S8_UINT, D16_UNORM or R32_FLOAT, with Sampled usage. Cascades may share a texture.
	IRTTexture* Texture = nullptr;
	ERTAccess Access = ERTAccess::ShaderRead; ///< how the engine used it last, not None; of cascades with one texture that of the first
	/// The cascade's part of the texture, texels. Width and Height 0: to the texture's end.
	uint32_t OffsetX = 0, OffsetY = 0, Width = 0, Height = 0;
	/// Three rows of four, which take a position in the engine's world. The first two give x and y from 0 to 1 over that part, y
	/// downwards. The third gives depth as texels have it, reversed or not. Casters beyond the near plane are clamped to it.
	double WorldToMap[12] = {};
	/// Edge of a texel in the engine's unit, finite, > 0. Rays are traced where it is larger than a pixel.
	float TexelSize = 0.0f;
	/// Distance by which a texel may be nearer to the sun than the surface that it shows: the engine's unit, finite, ≥ 0. The surface's
	/// slope is no part of it.
	float DepthBias = 0.0f;
};

inline constexpr uint32_t MaxShadowCascades = 4;

/// The engine's shadow map of the sun. Rays trace the casters that are not Held. Held ones come from the map where it is surely lit
/// or surely dark. Rays trace them, too, where it is neither. A map with ERTModuleCasters::Others multiplies the shadows of rays instead,
/// because rays cannot meet all that it holds. Nothing Held: all is traced.
struct FRTModuleHostShadow
{
	/// Ordered from the finest to the coarsest. All hold the same casters, each in its own part of the world.
	FRTModuleShadowCascade Cascades[MaxShadowCascades];
	uint32_t CascadeCount = 0; ///< 1 to 4; with ShaderData, 0 is fine
	ERTModuleCasters Held = ERTModuleCasters::None;
	/// Address of a buffer for FRTModuleRendererDesc::HostShadowShader, and 0 without that. Its owner orders writes before the frame.
	uint64_t ShaderData = 0;
};

/// A frame with the engine's G-buffer. All textures have one size and Sampled usage, and are imported with
/// IRTDevice::ImportTexture. The access of each is how the engine used it last, not None. All are left in ShaderRead, except those
/// whose access is External: they are left as IRTTexture::SetExternalState says.
struct FRTModuleFrame
{
	/// From IRTDevice::ImportCommandList; it must be recording, outside of a render pass.
	IRTCommandList* Commands = nullptr;
	FRTModuleView View;
	/// D32_FLOAT, D32_FLOAT_S8_UINT, D24_UNORM_S8_UINT, D16_UNORM or R32_FLOAT, as Layout.Depth says. The sky has the depth of the
	/// far plane. Native is reversed depth without a far plane in D32_FLOAT or R32_FLOAT: near / distance along Forward.
	IRTTexture* Depth = nullptr;
	/// Normals as Layout.Normals says, in any UNORM, SNORM or float format. Shading normals face whichever side the material has.
	/// Native is RGBA16_SNORM: shading normal (xy) and geometric normal (zw), both octahedral, in world space, the geometric one
	/// turned towards the camera.
	IRTTexture* Normals = nullptr;
	/// Motion vectors as Layout.Motion says. Native is RGBA32_FLOAT:
	/// - xy: offset from the pixel's centre to the position of its surface in the previous frame, in pixels, y down. Jitter is no
	///   motion.
	/// - z: distance of that position along Forward then, in metres.
	/// - w: a number > 0 for its object that stays equal over frames; 0: unknown.
	///
	/// Not read where depth is the sky's. Null: everything counts as static, and accumulated shadows lag behind
	/// moving objects.
	IRTTexture* Motion = nullptr;
	IRTTexture* BaseColor = nullptr; ///< RGBA8_SRGB: rgb base colour, a metalness; or as Layout.Material says. May be null
	/// RGBA8_UNORM: roughness, occlusion, sqrt(F0) of the dielectric, specular weight; or as Layout.Material says. May be null
	IRTTexture* Material = nullptr;
	/// R8_UNORM: what each pixel shows, as bits over 255. Bit 0: a character (FRTModuleObject::bCharacter), on which characters cast no
	/// shadow. Other bits must be 0. May be null: characters then cast on all that the picture shows.
	IRTTexture* Classes = nullptr;
	/// R8_UNORM: channels of each pixel's object (FRTModuleObject::Channels) over 255. May be null: local lights then light what the
	/// picture shows as if all of it were of channel 0.
	IRTTexture* Channels = nullptr;
	/// R8_UNORM: FRTModuleToon::Number of each pixel's object over 255; 0: none. May be null: no toon style has an effect.
	IRTTexture* ToonNumbers = nullptr;
	/// What shines diffusely through each pixel's surface, as leaves and paper do. RGBA8_SRGB or BGRA8_SRGB, or linear values from 0 to 1 in
	/// RGBA8_UNORM, BGRA8_UNORM or RGBA16_FLOAT. May be null.
	/// - rgb: albedo for light that arrives on the side away from the camera; 0: none shines through.
	/// - a, linear: share that the diffuse albedo of BaseColor has lost to it. 0 keeps that whole, as for subsurface colours that artists add.
	///
	/// Needs BaseColor and Material. The visibility of the sun is then that of the side that it shines on. Diffuse signals hold the light of
	/// both sides. The engine multiplies them by the sum of both albedos: rgb + BaseColor (1 - metalness)(1 - a). Whether the texture is
	/// there decides about shaders: passes are left out until these are compiled (IRTModuleRenderer::Precache).
	IRTTexture* BackAlbedo = nullptr;
	ERTAccess DepthAccess = ERTAccess::ShaderRead;
	ERTAccess NormalsAccess = ERTAccess::ShaderRead;
	ERTAccess MotionAccess = ERTAccess::ShaderRead;
	ERTAccess BaseColorAccess = ERTAccess::ShaderRead;
	ERTAccess MaterialAccess = ERTAccess::ShaderRead;
	ERTAccess ClassesAccess = ERTAccess::ShaderRead;
	ERTAccess ChannelsAccess = ERTAccess::ShaderRead;
	ERTAccess ToonNumbersAccess = ERTAccess::ShaderRead;
	ERTAccess BackAlbedoAccess = ERTAccess::ShaderRead;
	/// Geometric normals, coded as Normals are. May be null, see Layout.bGeometricInZw.
	IRTTexture* GeometricNormals = nullptr;
	ERTAccess GeometricNormalsAccess = ERTAccess::ShaderRead;
	FRTModuleGBufferLayout Layout;
	/// The engine's shadow map of the sun, which saves rays. May be null. Whether there is one decides about shaders: a first frame with it
	/// traces none of the sun's shadows until these are compiled (IRTModuleRenderer::Precache).
	const FRTModuleHostShadow* HostShadow = nullptr;
	/// The view's part of all textures, pixels: dynamic resolution, split screen. Width and Height 0: to the textures' end.
	/// Outputs have the size of this part, and start at 0.
	uint32_t OffsetX = 0, OffsetY = 0, Width = 0, Height = 0;
	/// Which of several views over the scene this is, any number: split screen, eyes, a mirror's picture. Each accumulates by itself.
	/// Views of one engine frame are frames of their own, with command lists, submissions and EndFrame of their own. A view that 64
	/// frames of others have passed by starts anew.
	uint32_t ViewIndex = 0;
	/// Signals that the engine reads; ESignal::Frame is none. Others are not traced, allocate nothing and compile nothing. A wanted
	/// signal also needs its console variable to be on (r.RT.Shadow, r.RT.AO, …). If FSignalInfo::bNeedsSurface says so, it
	/// needs BaseColor and Material.
	FSignalSet Wanted = {ESignal::SunShadow};
	/// The engine reads FRTModuleOutputs::Fog. It needs no input but the view. A first frame with it has none until shaders are compiled.
	bool bFog = false;
	/// How forward the engine's fog scatters: g of Henyey and Greenstein (1941), -1 < g < 1. 0: alike in all directions.
	float FogPhase = 0.0f;
	/// The engine reads FRTModuleOutputs::IndirectVolume. It needs no input but Depth and Normals, and has a use if Wanted has DiffuseGI. A
	/// first frame with it has none until shaders are compiled.
	bool bIndirectVolume = false;
	/// The engine lights by itself and reads FRTModuleOutputs::LightMask. ESignal::LocalDiffuse and LocalSpecular then hold only what is not
	/// in the mask. It needs no input but Depth and Normals. A first frame with it has none of the three until shaders are compiled.
	bool bLightMask = false;
	/// The engine reads FRTModuleOutputs::Transmission, and leaves sections with FRTModuleMaterial::Transmission out of its G-buffer. It
	/// draws those with bBlended where their opacity is at least 0.998. It needs no input but Depth and Normals. A first frame with it
	/// has none until shaders are compiled, and r.RT.Transmission may be off. The engine then draws these sections as it does without
	/// Lantern.
	bool bTransmission = false;
	/// RenderFrame submits the scene's own work (copies, skinning, acceleration structures, records) by itself before it returns.
	/// Tasks record it. Commands gets the passes over pixels alone, and is submitted later than that. The work runs on the device's
	/// compute queue, beside the engine's G-buffer, if there is one and r.RT.Async names passes of it. The engine's submission then
	/// waits for FRTModuleOutputs::Wait. Else the work runs on the device's queue, through LockQueue.
	/// What writes vertices on the engine's GPU (IRTModuleRenderer::GetMeshBuffer, FRTModuleStreams) must be submitted before
	/// RenderFrame.
	/// If false, all goes into Commands, recorded by one thread.
	bool bSubmitAhead = false;
	/// Time since the previous frame, seconds, finite, > 0. Accumulation lasts for a time in seconds, at any frame rate.
	float DeltaSeconds = 1.0f / 60.0f;
	/// Factor from radiance in nits to the picture, in which 1 is white before tone mapping; finite, ≥ 0. Emissive surfaces then get few
	/// rays where they bring less than 1/256. 0: unknown, and all get theirs.
	float Exposure = 0.0f;
	/// The previous frame's view as this frame's world has it, for an engine whose world got another origin. Null: as RenderFrame was
	/// given it then.
	const FRTModuleView* PreviousView = nullptr;
	/// Discards the view's history (a camera cut, another world). A change of size does not.
	bool bCut = false;
	uint32_t Seed = 0; ///< equal seed, frame number and scene give equal images
};

/// What the engine's submission of FRTModuleFrame::Commands waits for, before all of its commands.
struct FRTModuleWait
{
	uint64_t Semaphore = 0; ///< ERTNative::ComputeTimeline; 0: there is nothing to wait for
	uint64_t Value = 0;     ///< of that semaphore
};

/// Light in fog, by froxels: parts of the view that are PixelSize pixels wide and high, and lie in one slice of distances. All slices of
/// the view lie side by side in one texture, SlicesPerRow in each row. Take the pixel P of the view, and the distance Z along the
/// view's forward axis, in metres:
///
///   Slice  = SliceCount * log2(1 + 64 * Z / Distance) / log2(65)
///   Column = P / PixelSize
///   Texel  = Column + vec2(ColumnCount, RowCount) * vec2(floor(Slice) mod SlicesPerRow, floor(Slice) / SlicesPerRow)
///
/// P counts from the view's corner, less FRTModuleView::Jitter; a first pixel's centre is at 0.5. Froxels have their centres at n + 0.5 in
/// Slice and Column. To interpolate, fetch the four texels around Column in the two slices around Slice - 0.5. Keep indices within
/// ColumnCount, RowCount and SliceCount, and slices in front of what the pixel shows. Nothing is known beyond Distance. Froxels are not lit
/// behind what the last frame has shown there, but for one more slice.
struct FRTModuleFog
{
	/// R8_UNORM: fraction of the sun's disk that is seen. Null: no sun, or as in FRTModuleOutputs.
	IRTTexture* Visibility = nullptr;
	/// RGBA16_FLOAT: radiance that fog scatters towards the camera of local lights, shadows included, over its scattering coefficient.
	/// Times that coefficient (1 / m) and a length in metres it is in nits. Null: no light has FRTModuleLight::bLightsFog.
	IRTTexture* Light = nullptr;
	uint32_t PixelSize = 0, ColumnCount = 0, RowCount = 0, SliceCount = 0, SlicesPerRow = 0;
	float Distance = 0.0f; ///< metres
};

/// Indirect light in the air, for fog, particles and translucent surfaces: that of the sky, of what shines, and all that surfaces reflect. The
/// sun's disk and local lights are not in it. Froxels lie as those of FRTModuleFog do, in a grid of their own. The radiance from a direction D
/// is about Light * (1 + 3 * dot(Moment, D) / luminance(Light)). D is in a right-handed world with y up, in which FRTModuleWorld says how the
/// engine's axes lie. Shaders/IndirectVolume/ReadVolume.glsl has the irradiance of a surface, and what fog scatters. Nothing is known behind
/// what the picture shows, but for one more slice.
struct FRTModuleIndirectVolume
{
	/// RGBA16_FLOAT: mean radiance over all directions, in nits. Null: there are no radiance cells (r.RT.GI 2 or 3, and DiffuseGI in
	/// FRTModuleFrame::Wanted), r.RT.GI.Volume is off, or as in FRTModuleOutputs.
	IRTTexture* Light = nullptr;
	/// RGBA16_FLOAT, xyz: mean over directions of luminance times direction, as D.
	IRTTexture* Moment = nullptr;
	uint32_t PixelSize = 0, ColumnCount = 0, RowCount = 0, SliceCount = 0, SlicesPerRow = 0;
	float Distance = 0.0f; ///< metres
};

/// How much each pixel sees of the lights around it, for an engine's own lighting. The picture is divided into tiles of 8 x 8 pixels, from
/// the view's corner on. A tile has 8 slots. All lights that reach it are in slots if they are no more. Else those are that bring most to
/// some of its pixels, shadows aside. The engine multiplies its own light of a lamp by what the lamp's slot says, and by 0 where the
/// lamp has none. With LocalDiffuse and LocalSpecular, which hold the other lamps and emissive triangles, the sum is all light of lamps.
/// A lamp keeps its slot in a tile while it is listed there, also as the camera moves. Shaders/LocalLights/LightMask.glsl reads all this.
struct FRTModuleLightMask
{
	/// R32_UINT, as large as the view: slot I has the bits 4 I to 4 I + 3. 0: its light is hidden, or no light is there; 15: it is seen.
	/// Lights with an extent have values between, which r.RT.Lights.HistorySeconds smooths, rounded up or down by chance. Lights without
	/// shadow are seen. The sky has 0. Null: as in FRTModuleOutputs, and LocalDiffuse and LocalSpecular then hold no light of lamps.
	IRTTexture* Visibility = nullptr;
	/// R32_UINT, 8 texels wide and one high for each tile. The light in slot I at pixel P is that of texel (P.x / 8 * 8 + I, P.y / 8), as
	/// GetLightNumber of its handle. 0: the slot is free. Lights are named so from the frame on that has taken over AddLight.
	IRTTexture* Lights = nullptr;
};

/// Glass and water in front of the G-buffer's surfaces, for an engine that draws neither. Picture = Light + Transmittance · picture + looks:
/// once it is lit, and before its fog. Rays find these surfaces; smooth sheets leave what is behind them as the engine has drawn it. Looks
/// are other places of the engine's picture, that are seen by reflection or bent. Shaders/Transmission/Looks.glsl reads them.
struct FRTModuleTransmission
{
	IRTTexture* Light = nullptr;         ///< RGBA16_FLOAT: radiance in nits that they send to the camera. Null: as in FRTModuleOutputs
	IRTTexture* Transmittance = nullptr; ///< RGBA8_UNORM: share of what lies behind that they leave; 1 where there is none
	IRTTexture* Looks = nullptr;         ///< RGBA32_UINT: two looks of two words each
};

/// Outputs of a frame. The renderer owns the textures; they are valid until its next RenderFrame. They are in ShaderRead. The
/// engine may copy from them if it puts them back in ShaderRead.
/// To read them, fetch the texel of the view's own pixel: the engine's pixel minus FRTModuleFrame::OffsetX and OffsetY. Or sample
/// with UVs of the view's part. A null texture means that the engine lights as if there were no such pass: with visibility 1, and
/// with its own ambient light.
/// A texture is null if it was not wanted, is off, or if the scene has nothing for it (no sun, …). It is also null if the
/// device cannot make it, an input is missing, or shaders are not ready.
struct FRTModuleOutputs
{
	/// Textures by ESignal, which says what each holds. SignalInfos has their formats.
	IRTTexture* Signals[MaxSignals] = {};
	IRTTexture* Get(ESignal Signal) const { return Signals[ToIndex(Signal)]; }
	FRTModuleFog Fog;                       ///< with FRTModuleFrame::bFog
	FRTModuleIndirectVolume IndirectVolume; ///< with FRTModuleFrame::bIndirectVolume
	FRTModuleLightMask LightMask;           ///< with FRTModuleFrame::bLightMask
	FRTModuleTransmission Transmission;     ///< with FRTModuleFrame::bTransmission
	FRTModuleWait Wait;                     ///< see FRTModuleFrame::bSubmitAhead
	/// Whether all shaders of the frame are compiled. They compile in the background; RenderFrame never waits for them
	/// (IRTModuleRenderer::Precache does, at load). An output is null until its first shaders are ready, and is not filtered
	/// until those of its filter are. Objects whose own shaders are missing then have the shadow of a stand-in, or none
	/// (r.RT.Pipeline.Fallback, which can also make frames wait). A shader that does not compile is logged, keeps its stand-in
	/// and counts as ready.
	bool bShadersReady = false;
	/// Whether the frame is complete. False: shaders are missing, or some acceleration structures are not built yet
	/// (r.RT.Build.TrianglesPerFrame, r.RT.Build.MemoryMB), so that rays do not see their objects.
	bool bComplete = false;
	/// Whether this frame and those before it have taken over all calls that were made before it. False: some wait for later frames
	/// (r.RT.Scene.ArrivalsPerFrame).
	bool bCallsTaken = false;
};

} // namespace Lantern
