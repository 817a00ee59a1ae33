// The frame as passes see it: what its pixels and its world have in common, and what is asked of it. Render thread only.
#pragma once

#include <array>
#include <memory>
#include <optional>

#include "FogTypes.h"
#include "LanternCore/FrameGraph/FrameGraph.h"
#include "LanternRenderer/HostShadow.h"
#include "LanternRenderer/View.h"
#include "LanternScene/Pipelines/PlainPipelines.h"
#include "LanternScene/Pipelines/RTPSOCompiler.h"
#include "LanternScene/Scene/Scene.h"
#include "LanternScene/ShaderTable/ShaderTable.h"
#include "LanternSignals/Signals.h"

namespace Lantern
{

/// What is asked of a frame beside the composite.
struct FSignalRequests
{
	/// Signals that somebody reads. They are made even if the composite has no use for them, such as ambient occlusion without
	/// a sky. Their own console variables still rule.
	FSignalSet Wanted;
	/// The host lights by itself: there is no composite, and only wanted signals are made.
	bool bNothingElse = false;
	/// Records how objects moved (FSceneConstants::ObjectMotions), even if no filter follows it.
	bool bMotion = false;
	/// Somebody reads the light in fog (FFogAtlas).
	bool bFog = false;
	/// How forward fog scatters: g of Henyey and Greenstein (1941), −1 < g < 1. 0: alike in all directions.
	float FogPhase = 0.0f;
	/// Somebody reads indirect light in the air (FIndirectVolume).
	bool bIndirectVolume = false;
	/// Somebody reads the light mask (FLightMask), and lights by itself with it. The signals of local lights, and with them the composite,
	/// then lack the lights of the mask.
	bool bLightMask = false;
	/// Somebody reads what surfaces that light shines through show (FTransmission).
	bool bTransmission = false;
};

class FHistoryResources;
class FLightCells;
class FMovedCasters;
class FRadianceEvents;
class FRayQueueCounter;
class FRayQueueDemand;
class FRenderer;

/// Surfaces that pixels show and showed, for passes that reproject. The first pass that asks makes them
/// (Denoise/SurfaceHistory.h).
struct FSurfaceTextures
{
	FGraphTexture Current;  ///< RG32_FLOAT, see Shaders/Library/History.glsl
	FGraphTexture Previous; ///< Current of the frame before; invalid: there is none
	FGraphTexture Motion;   ///< as in FGBuffer; invalid where Previous is
	/// RG32_UINT: where each surface was in the frame before, see Shaders/Library/History.glsl. Invalid where Previous is.
	FGraphTexture Reprojection;
	FGraphTexture Anchors; ///< RG32_UINT: where the histories of pixels lie, see Shaders/Library/History.glsl
};

/// Lights by place in the world, for passes that walk them (Lights/LightCells.h). The first pass that asks makes them.
struct FLightCellsOfFrame
{
	FLightCells* OfView = nullptr; ///< what the view keeps
	bool bGridAsked = false, bAsked = false;
	FGraphBuffer Buffer;  ///< invalid: there are none
	FGraphBuffer Counts;  ///< see FPassBuilder::Keep
	FAddress Address = 0; ///< FSceneConstants::LightCells, once they are recorded
};

/// The scene's data, which passes reach without the graph. Passes count as readers of all; those that are not say so
/// (FPassBuilder::Without), and may then run beside what writes it.
struct FSceneTokens
{
	FGraphToken Tables;     ///< objects, materials, sections, lights
	FGraphToken Vertices;   ///< of deformed geometry
	FGraphToken Structures; ///< acceleration structures
	FGraphToken Records;    ///< of the shader table
	FGraphToken Sky;        ///< the map that its program is baked into
	/// Says that the pass reads nothing of the scene.
	void LeaveAlone(FPassBuilder& Builder) const
	{
		for (const FGraphToken Token : {Tables, Vertices, Structures, Records, Sky}) { Builder.Without(Token); }
	}
	/// Says that the pass changes one, and touches nothing else of the scene.
	void WriteAlone(FPassBuilder& Builder, FGraphToken Written) const;
};

/// Light in fog by froxels, in atlases of slices: FogTypes.h says where a froxel lies. A texture is invalid if the scene has nothing
/// for it.
struct FFogAtlas
{
	FGraphTexture Visibility; ///< R8_UNORM: fraction of the sun's disk that is seen
	FGraphTexture Light;      ///< RGBA16_FLOAT: radiance that fog scatters of local lights, over its scattering coefficient
	FFogGrid Grid{};
	bool IsValid() const { return Visibility.IsValid() || Light.IsValid(); }
};

/// The fog of a frame (Fog/FogShadow.h).
struct FFogOfFrame
{
	FFogAtlas Atlas;
	FGraphTexture Depth; ///< how far its next frame may be seen; invalid: there is none
	bool bAsked = false, bDepthAsked = false;
};

/// Indirect light in the air by froxels, in atlases of slices: FogTypes.h says where a froxel lies, ReadVolume.glsl how they are read. It has
/// the sky's light, all that shines, and all that surfaces reflect; the sun's disk and local lights are FFogAtlas's.
struct FIndirectVolume
{
	FGraphTexture Light;  ///< RGBA16_FLOAT: mean radiance over all directions, nits
	FGraphTexture Moment; ///< RGBA16_FLOAT: mean of luminance times direction, in the axes of the world
	FFogGrid Grid{};
	bool IsValid() const { return Light.IsValid(); }
};

/// Surfaces in front of the G-buffer's that light shines through: Light + Transmittance · what the G-buffer's surface sends, and what Looks
/// names of other pixels' surfaces.
struct FTransmission
{
	FGraphTexture Light;         ///< RGBA16_FLOAT: radiance that they send to the camera
	FGraphTexture Transmittance; ///< RGBA8_UNORM: share of what lies behind that they leave
	FGraphTexture Looks;         ///< RGBA32_UINT: what they show of other pixels (Shaders/Transmission/Looks.glsl)
	bool IsValid() const { return Light.IsValid(); }
};

/// What pixels see of lights, for a host that lights by itself: FRTModuleLightMask says how it is read.
struct FLightMask
{
	FGraphTexture Visibility; ///< R32_UINT; invalid: nobody asks, or as in FFrameOutputs
	FGraphTexture Lights;     ///< R32_UINT: which light a slot is, by MakeLightNumber or FSceneLight::Number; 0: none
	bool IsValid() const { return Visibility.IsValid(); }
};

/// Lamps and emissive triangles that have changed since the view's last frame, for what follows them (LocalLights/LampChange.h). The
/// first pass that asks lists them.
struct FLampChangesOfFrame
{
	FGraphBuffer List; ///< invalid: none has, or there is no last frame
	bool bAsked = false;
};

/// Objects that moved, came, went or were deformed lately (Tiles/MovedCasters.h). The first pass that asks writes them.
struct FMoversOfFrame
{
	uint64_t Casters = 0; ///< FMovedCaster[Count], one for each object; 0: none
	uint32_t Count = 0;   ///< at most SETTLED_MOST_CASTERS
	bool bAsked = false;
};

struct FShadowRays;    // Private/Rays/ShadowRays.h
struct FRadianceCells; // Private/RadianceCells/RadianceCells.h
/// Ray generation shaders of passes that make no signal.
enum class EPassRayGen : uint8_t
{
	Fog,
	RadianceCells,
	Transmission,
	IndirectVolume,
	DeferredPaths, ///< of a signal whose paths end in radiance cells: the second launch
	Count
};
constexpr size_t PassRayGenCount = static_cast<size_t>(EPassRayGen::Count);
/// Light by the lobe that reflects it.
struct FLobes
{
	FGraphTexture Diffuse, Specular; ///< RGBA16_FLOAT
};

/// Surfaces of objects with a style: see ToonSurface.comp.
struct FToonOfFrame
{
	FGraphTexture Normals; ///< as FGBuffer::Normals, about which pixels gather light
	FGraphTexture Pixels;  ///< RG32_FLOAT, see FToonSurfaceConstants
	bool IsValid() const { return Pixels.IsValid(); }
};

/// What a frame asks of the world, whatever its pixels. The first pass that asks makes it.
struct FWorldOfFrame
{
	FHistoryResources* History = nullptr; ///< where caches of the world are kept
	FLightCellsOfFrame LightCells;
	FMoversOfFrame Movers;
	FLampChangesOfFrame LampChanges;
	std::optional<bool> bLampsHalf; ///< AreLocalLightsHalf, for the whole frame: shaders may become ready in the middle of it
	std::shared_ptr<const FRadianceCells> RadianceCells; ///< null: none, or nobody has asked so far
	bool bRadianceCellsAsked = false;
	double SkyChange = 0.0; ///< share of the sky's light that a program's leap changes in this frame, beside the scene's own values
};

struct FHalfFrame; // Private/HalfFrame/HalfFrame.h

/// What passes of a frame share of its pixels.
struct FPixelsOfFrame
{
	FSurfaceTextures Surface;
	FGraphTexture PixelChannels; ///< invalid: nobody has asked so far, or there is none
	FToonOfFrame Toon;           ///< invalid: nobody has asked so far, or there is none
	/// What r.RT.Debug.View shows instead of a signal, RGBA8_UNORM; invalid: nothing drew it.
	FGraphTexture DebugPicture;
	std::shared_ptr<const FShadowRays> ShadowRays; ///< null: none, or nobody has asked so far
	bool bShadowRaysAsked = false;
	std::optional<FLobes> LocalLobes;              ///< of local lights: as traced, or the half frame's, filtered; nullopt: not made so far
	std::optional<FLobes> LocalChange;             ///< by how much they have changed as lights have; nullopt: not found so far
	std::optional<FLobes> IndirectLobes;           ///< of diffuse GI's paths, filtered; nullopt: nobody has asked so far
	std::optional<FGraphTexture> ReflectedLight;   ///< the signal; nullopt: nobody has asked so far
	std::optional<FTransmission> Transmission;     ///< nullopt: nobody has asked so far
	std::optional<FLightMask> LightMask;           ///< nullopt: nobody has asked so far
	std::optional<FIndirectVolume> IndirectVolume; ///< nullopt: nobody has asked so far
	/// The frame with a quarter of these pixels, for signals that do without the others. Null: nobody has asked so far.
	std::shared_ptr<FHalfFrame> Half;
};

/// The frame as passes see it.
struct FFrameContext : FPixelsOfFrame
{
	IRTDevice& Device;
	FFrameGraph& Graph;
	FRTScene& Scene;
	FPlainPipelines& Pipelines;
	FSceneFacts Facts;
	FPassConstants Pass; ///< addresses of this frame's constants
	FView View{};
	uint32_t Width = 0, Height = 0;
	/// Null where no pass of this frame traces through a pipeline.
	const FRTPSO* RayPipeline = nullptr;
	FShaderTable* RayTable = nullptr;
	/// Ray generation shaders of RayPipeline by signal; that of ESignal::Frame is the reference path tracer. NoRayGen: the frame
	/// does not have it, or it is still being compiled.
	std::array<uint32_t, SignalCount> RayGens = [] {
		std::array<uint32_t, SignalCount> None;
		None.fill(NoRayGen);
		return None;
	}();
	uint32_t GetRayGen(ESignal Signal) const { return RayGens[ToIndex(Signal)]; }
	std::array<uint32_t, PassRayGenCount> PassRayGens = [] { ///< as RayGens
		std::array<uint32_t, PassRayGenCount> None;
		None.fill(NoRayGen);
		return None;
	}();
	uint32_t GetRayGen(EPassRayGen Which) const { return PassRayGens[static_cast<size_t>(Which)]; }
	/// The view of the frame before. Null if nothing may be carried over from it: there was none, a cut, another size, or a lost
	/// frame. Null as well if a geometry was deformed in another renderer's or view's frame of the scene since.
	const FView* PreviousView = nullptr;
	/// Textures that passes keep from frame to frame.
	FHistoryResources* History = nullptr;
	FMovedCasters* MovedCasters = nullptr;     ///< what may have changed the sun's shadows since the view's last frame
	FRadianceEvents* RadianceEvents = nullptr; ///< what has changed indirect light
	uint64_t RadianceCellStatistics = 0;       ///< address of FRadianceCellStatistics; 0: nothing is counted
	uint64_t RadianceAudit = 0;                ///< address of FRadianceAuditPath[RADIANCE_AUDIT_PATHS]; 0: no path is audited
	uint64_t ReflectionStatistics = 0;         ///< address of FReflectionStatistics; 0: nothing is counted
	uint64_t ExplainedPixel = 0;               ///< address of FExplainedPixel; 0: none is explained
	FRayQueueCounter* RayCounter = nullptr;
	/// What the host hands over beside its G-buffer, before it adds passes. Frames without FFrameFeatures::bHostShadow do not read it.
	FHostShadow HostShadow;
	FRayQueueDemand* QueueDemand = nullptr; ///< what earlier frames asked of the queue of shadow rays
	std::shared_ptr<FWorldOfFrame> World;
	FHistoryResources* HalfHistory = nullptr; ///< of FPixelsOfFrame::Half
	bool bHalf = false;                       ///< this is such a frame
	FFogOfFrame Fog;
	FSceneTokens Tokens;
	FSignalRequests Signals;
	/// First error that a pass met; the frame is then not submitted. Not while passes are recorded.
	FRTStatus* Status = nullptr;
	bool bWaitForPipelines = true; ///< FFrameFeatures::bWaitForPipelines, or a reason to wait all the same
	bool bMotion = false;          ///< FSceneConstants::ObjectMotions are recorded, because some pass follows them
	/// Sets Status, unless it has an error already. From any thread.
	void Fail(const FRTStatus& Error) const;
	FRenderer* Owner = nullptr;
	/// Passes that trace rays call this before they add themselves. The first call adds the passes that record acceleration
	/// structures and shader records. Tasks prepare these meanwhile, so a late first call waits less.
	void RequireRays() const;
};

} // namespace Lantern
