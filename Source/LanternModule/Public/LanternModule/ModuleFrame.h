// What an engine hands to IRTModuleRenderer::RenderFrame, and what it gets back. Module.h has the units and the rules.
#pragma once

#include "LanternRHI/RTInterfaces.h"
#include "LanternSignals/Signals.h"

namespace Lantern
{

struct FRTModuleView
{
	double Position[3] = {0, 0, 0};
	float Forward[3] = {0, 0, -1}; ///< unit length
	float Up[3] = {0, 1, 0};       ///< need not be perpendicular to Forward, must not be parallel to it
	float FovY = 1.0f;             ///< vertical, radians, between 0 and π
	float Near = 0.1f;             ///< > 0
};

/// A frame with the engine's G-buffer. All textures have one size and Sampled usage, and are imported with
/// IRTDevice::ImportTexture. The access of each is how the engine used it last, not None. All are left in ShaderRead.
struct FRTModuleFrame
{
	/// From IRTDevice::ImportCommandList; it must be recording, outside of a render pass.
	IRTCommandList* Commands = nullptr;
	FRTModuleView View;
	/// D32_FLOAT or R32_FLOAT. Reversed depth without a far plane: near / distance along Forward; 0 is the sky.
	IRTTexture* Depth = nullptr;
	/// RGBA16_SNORM: shading normal (xy) and geometric normal (zw), both octahedral (Cigolle et al. 2014) and turned
	/// towards the camera.
	IRTTexture* Normals = nullptr;
	/// RGBA32_FLOAT motion vectors.
	/// - xy: offset from the pixel's centre to the position of its surface in the previous frame, in pixels, y down.
	/// - z: distance of that position along Forward then, in metres.
	/// - w: a number > 0 for its object that stays equal over frames; 0: unknown.
	///
	/// Not read where depth is 0. Null: everything counts as static, and accumulated shadows lag behind
	/// moving objects.
	IRTTexture* Motion = nullptr;
	IRTTexture* BaseColor = nullptr; ///< RGBA8_SRGB: rgb base colour, a metalness. May be null
	IRTTexture* Material = nullptr;  ///< RGBA8_UNORM: roughness, occlusion, sqrt(F0) of the dielectric, specular weight. May be null
	ERTAccess DepthAccess = ERTAccess::ShaderRead;
	ERTAccess NormalsAccess = ERTAccess::ShaderRead;
	ERTAccess MotionAccess = ERTAccess::ShaderRead;
	ERTAccess BaseColorAccess = ERTAccess::ShaderRead;
	ERTAccess MaterialAccess = ERTAccess::ShaderRead;
	/// Signals that the engine reads; ESignal::Frame is none. Others are not traced, allocate nothing and compile nothing. A wanted
	/// signal also needs its console variable to be on (r.RT.Shadow, r.RT.AO, …). If FSignalInfo::bNeedsSurface says so, it
	/// needs BaseColor and Material.
	FSignalSet Wanted = {ESignal::SunShadow};
	/// Time since the previous frame, seconds, finite, > 0. Accumulation lasts for a time in seconds, at any frame rate.
	float DeltaSeconds = 1.0f / 60.0f;
	/// Discards all history (a camera cut, another world). A change of size does so without it.
	bool bCut = false;
	uint32_t Seed = 0; ///< equal seed, frame number and scene give equal images
};

/// Outputs of a frame. The renderer owns the textures; they are valid until its next RenderFrame. They are in ShaderRead. The
/// engine may copy from them if it puts them back in ShaderRead.
/// A texture is null if it was not wanted, is off, or if the scene has nothing for it (no sun, …). It is also null if the
/// device cannot make it, an input is missing, or shaders are not ready.
struct FRTModuleOutputs
{
	/// Textures by ESignal, which says what each holds. SignalInfos has their formats.
	IRTTexture* Signals[MaxSignals] = {};
	IRTTexture* Get(ESignal Signal) const { return Signals[ToIndex(Signal)]; }
	/// Whether all shaders of the frame are compiled. They compile in the background; RenderFrame never waits for them
	/// (IRTModuleRenderer::Precache does, at load). An output is null until its first shaders are ready, and is not filtered
	/// until those of its filter are. Objects whose own shaders are missing then have the shadow of a stand-in, or none
	/// (r.RT.Pipeline.Fallback, which can also make frames wait). A shader that does not compile is logged, keeps its stand-in
	/// and counts as ready.
	bool bShadersReady = false;
	/// Whether the frame is complete. False: shaders are missing, or some acceleration structures are not built yet
	/// (r.RT.Build.TrianglesPerFrame, r.RT.Build.MemoryMB), so that rays do not see their objects.
	bool bComplete = false;
};

} // namespace Lantern
