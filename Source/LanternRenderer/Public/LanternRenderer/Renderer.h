// The renderer owns what frames are made with: shader compiler, pipelines, the RTPSO and its shader table, upload memory. A frame
// is built between BeginFrame and EndFrame; two may be in flight. Render thread only.
#pragma once

#include <array>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "LanternCore/Tasks/Tasks.h"
#include "LanternRenderer/FrameContext.h"
#include "LanternRenderer/FrameCounts.h"
#include "LanternRenderer/RadianceAudit.h"

namespace Lantern
{

struct FRendererDesc
{
	std::vector<std::string> ShaderFolders; ///< searched in order; the plugin's Shaders first
	std::string CacheFolder;                ///< keeps compiled shaders between runs; empty: they are not kept
	/// Replace files of the plugin that are made to be replaced, as Tiles/HostShadow.glsl.
	std::vector<FShaderHeader> ShaderHeaders = {};
};

/// One geometry to be deformed by linear blend skinning, from source vertices into the geometry's own buffers.
struct FSkinningInputs
{
	FRTGeometryRef Geometry; ///< dynamic; its Positions and Attributes are written
	FAddress SourcePositions = 0, SourceAttributes = 0;
	FAddress Weights = 0; ///< FSkinVertex[]
	std::vector<glm::mat4> Joints;
};

/// Whether the host's G-buffer has FGBuffer::BackAlbedo.
enum class EBackAlbedo : uint8_t
{
	None,
	OfScene, ///< if some material of the scene scatters light through
	Always
};

/// What a frame is to do beside its cameras and console variables.
struct FFrameFeatures
{
	bool bReference = false;                  ///< traces the reference instead of real-time passes
	ESignal ReferenceSignal = ESignal::Frame; ///< the whole frame, or one signal as LanternSignals/Signals.h defines it
	/// The reference starts at the surfaces of FReferencePassInputs::GBuffer.
	bool bReferenceFromGBuffer = false;
	/// The host traces rays in passes of its own. Acceleration structures are then kept even if no pass of the plugin needs
	/// them. They are recorded at the start of the frame.
	bool bRays = false;
	/// The host has a shadow map of the sun (FFrameContext::HostShadow).
	bool bHostShadow = false;
	EBackAlbedo BackAlbedo = EBackAlbedo::OfScene;
	/// Records acceleration structures where the host calls FFrameContext::RequireRays instead.
	bool bLateRays = false;
	/// The frame waits until all of its shaders are compiled, so that each picture is complete. If false, it uses what is
	/// ready (FRTPSOCompiler, FPlainPipelines) and leaves out passes whose shaders are missing. The reference always waits.
	bool bWaitForPipelines = true;
	/// Ray generation shaders of the host's own passes. They trace all ray types through the frame's RTPSO
	/// (FFrameContext::RayPipeline, FRTPSO::FindRayGen). Their push constants begin with FPassConstants.
	std::vector<FShaderSource> RayGens;
	std::vector<FShaderSource> Callables; ///< callable shaders of RayGens, by index
	/// Builds all acceleration structures that wait, so that each picture is complete. If false, r.RT.Build.TrianglesPerFrame
	/// limits a frame's builds, and rays do not see objects whose geometry waits. The reference builds all.
	bool bBuildAll = true;
	/// Left out as a whole while its shader is compiled (FRenderer::WasSkinningLeftOut). Geometries then stay as they are.
	std::vector<FSkinningInputs> Skinning;
	/// The host has no motion vectors, so that filters follow the camera alone. Decides only what is compiled ahead.
	bool bCameraMotion = false;
	/// The host's G-buffer goes through AddHostSurfacePass, which has something to convert (NeedsHostSurfacePass).
	bool bHostSurface = false;
	/// The host makes its motion vectors from FSceneConstants::ObjectMotions. These are recorded if a filter follows motion, or if
	/// FSignalRequests::bMotion asks. What rays meet is followed all the same. An engine with motion vectors of its own saves 72 bytes a frame for each moving object.
	bool bMotion = true;
	FSignalRequests Signals;
	/// The view of the frame before as this frame's world has it. Empty: as it was given then.
	std::optional<FView> PreviousView;
	/// Which of several views over the scene this is: each has histories of its own, and the frame before is its own.
	uint32_t ViewIndex = 0;
};

class FAnyHitCounter;
class FHistoryResources;
class FLightCells;
class FMovedCasters;
class FPixelExplainer;
class FRadianceAuditor;
class FRadianceCellCounter;
class FRadianceEvents;
class FRayQueueCounter;
class FPathRayCounter;
class FReflectionCounter;
class FRayQueueDemand;
class FRefitQuality;
class FSkyBake;
class FRenderer;
class FStandInFeedback;
struct FPixelExplanation;
struct FRayPrograms;

/// What an engine's frame submits ahead of the engine's list.
struct FAheadWork
{
	ERTQueue Queue = ERTQueue::Graphics; ///< from FindAheadQueue, asked once in the frame
	IRTCommandList* First = nullptr;     ///< an ended list of Queue that runs before the scene's own; may be null
	FRTFence WaitFor = 0;                ///< waited for if it is of another queue; 0: none
};

class FRenderer
{
public:
	FRenderer(IRTDevice& Device, FRendererDesc Desc);
	~FRenderer();

	/// Compiles what frames of the scene with these features will run, ray tracing and compute, and waits for it. For load time,
	/// between frames. Progress gets 0 to 1 and may be empty. Hit shaders that do not compile are logged. The result is an error
	/// only if a picture would not be complete without the shader.
	FRTStatus Precache(FRTScene& Scene, const FFrameFeatures& Features, const std::function<void(float)>& Progress);
	/// Returns FFrameContext::bMotion of such frames. Between frames.
	bool FollowsMotion(FRTScene& Scene, const FFrameFeatures& Features);
	/// Returns whether such frames read FGBuffer::BackAlbedo. Between frames.
	bool HasBackPixels(FRTScene& Scene, const FFrameFeatures& Features);
	/// Returns what such frames trace with; without ray generation shaders if they need no pipeline. Between frames.
	FRTPSODesc GetRayPrograms(FRTScene& Scene, const FFrameFeatures& Features);
	/// Returns a name for the texts of all shaders that such frames trace with, their includes and the compiler. Another text has
	/// another name.
	std::string GetRayShaderKey(FRTScene& Scene, const FFrameFeatures& Features);
	/// Starts a frame. It waits until at most one earlier frame is in flight. Tasks begin to gather instances and to write shader
	/// records; the scene's tables are the first pass. The scene must live, and must not change, until EndFrame. Console variables
	/// are as the caller last published them, which it does once, before it changes the scene. Several views and renderers may share
	/// one publication. A view's next frame without another one asserts if values were set since.
	FRTStatus BeginFrame(FRTScene& Scene, const FView& View, const FFrameFeatures& Features);
	FFrameContext& GetContext(); ///< between BeginFrame and EndFrame
	/// Executes the graph and submits. OutFence may be null.
	FRTStatus EndFrame(FRTFence* OutFence);
	/// Records the frame into the engine's command list. The engine submits it and then calls FrameSubmitted with its fence.
	/// Objects that move in between count as moved before the frame: their motion vectors do not say so.
	FRTStatus EndFrame(IRTCommandList& List);
	/// Records the scene's own work into lists of its own and submits them at once, ahead of the engine's list, which gets the rest.
	/// OutAhead: their fence; 0: nothing was submitted.
	FRTStatus EndFrame(IRTCommandList& List, const FAheadWork& Ahead, FRTFence& OutAhead);
	/// Ends a frame that an engine submits. Fence 0: it never will be submitted, because EndFrame failed, or because the engine
	/// drops its list or gives the frame up before EndFrame.
	void FrameSubmitted(FRTFence Fence);

	/// Returns whether the newest frame failed, so that nothing of it reached the GPU.
	bool IsFrameLost() const { return bFrameLost; }

	FRTStatus WaitForAll();
	IRTDevice& GetDevice() { return Device; }
	FShaderCompiler& GetCompiler() { return Compiler; }
	FMaterialPrograms& GetPrograms() { return Programs; }
	FPlainPipelines& GetPipelines() { return Pipelines; }
	FRefitQuality& GetRefitQuality() { return *RefitQuality; }
	FFrameUploads& GetUploads() { return Uploads; }
	/// Frees what a view keeps from frame to frame. Only between frames, after WaitForAll.
	void ClearHistories(uint32_t ViewIndex = 0);
	/// Returns the memory of it, in bytes.
	uint64_t GetHistoryBytes(uint32_t ViewIndex = 0);
	/// Returns the parts of it by name, in bytes.
	std::vector<std::pair<std::string, uint64_t>> GetHistoryParts(uint32_t ViewIndex = 0);
	FLightCells& GetLightCells(uint32_t ViewIndex = 0) { return *GetView(ViewIndex).LightCells; }
	FFrameGraphResources& GetGraphResources() { return GraphResources; }
	/// Returns the RTPSO of the last frame; null if it had none.
	const FRTPSO* GetRayPipeline() const { return RayPipeline.get(); }
	FRTPSOCompiler& GetRayCompiler() { return RayCompiler; }
	/// Returns whether all shaders that the last frame wanted are compiled, or cannot be.
	bool AreShadersReady() { return (bRaysReady || (RayPipeline && !RayCompiler.GetStats().bBusy)) && !Pipelines.IsAnyToCome(); }
	/// Returns whether the last frame left out FFrameFeatures::Skinning. The host then asks for it again.
	bool WasSkinningLeftOut() const { return bSkinningLeftOut; }
	/// Returns what the compiler was last told of each program that is not ready, by program.
	const std::vector<FProgramPriority>& GetProgramPriorities() const;
	const FShaderTable& GetShaderTable() const { return ShaderTable; }
	const FAnyHitCounts& GetAnyHits() const;
	const FRayCounts& GetRayCounts() const;
	const FRadianceCellCounts& GetRadianceCells() const;
	const FRadianceAudit& GetRadianceAudit() const;
	const FReflectionCounts& GetReflectionCounts() const;
	const FPathRayCounts& GetPathRayCounts() const;
	const FPixelExplanation& GetPixelExplanation() const;
	/// Makes executed frames leave a text for DumpGraph. Off by default, because it takes longer than the graph itself.
	void SetGraphDump(bool bEnabled) { bDumpGraph = bEnabled; }
	const std::string& DumpGraph() const { return LastDump; } ///< the last executed frame, as text

private:
	friend struct FFrameContext;
	FRayPrograms ChoosePrograms(FRTScene& Scene, const FFrameFeatures& Features);
	FRTStatus PrepareRayPipeline(const FRayPrograms& Wanted);
	FRTStatus StartUpdate(const FView& View, const FRayPrograms& Wanted, const FFrameFeatures& Features);
	void StartPrebind();
	FRTStatus FinishPrebind();
	void AddTables();
	void AddRayPasses();
	void AddBuildPasses();
	FRTStatus AllocateConstants();
	void WriteConstants();
	void DropFrame();
	void KeepHistory(bool bSubmitted);
	void FindPreviousView(FRTScene& Scene, const FFrameFeatures& Features);
	void BeginFeedback();
	void StartCounting();
	void EndFeedback(bool bSubmitted);
	FRTStatus WaitForFlight();
	FRTStatus BeginList(ERTQueue Queue, IRTCommandList*& Out);
	FRTStatus SubmitGraph(FRTFence& OutFence);
	void StartRecording();
	FRTStatus EndLists(FRTStatus Status);
	void Fail(const FRTStatus& Error);
	FRTStatus GetFailure();
	/// Run: executes the graph.
	FRTStatus Execute(const std::function<FRTStatus()>& Run);

	IRTDevice& Device;
	FShaderCompiler Compiler;
	FPlainPipelines Pipelines;
	FFrameUploads Uploads;
	FFrameGraphResources GraphResources;
	std::unique_ptr<FRefitQuality> RefitQuality;
	FShaderTable ShaderTable;
	std::unique_ptr<FAnyHitCounter> AnyHits;
	std::unique_ptr<FRadianceCellCounter> CellCounter;
	std::unique_ptr<FRadianceAuditor> CellAuditor;
	std::unique_ptr<FReflectionCounter> ReflectionCounter;
	std::unique_ptr<FPathRayCounter> PathRayCounter;
	std::unique_ptr<FPixelExplainer> Explainer;
	std::unique_ptr<FSkyBake> Sky;
	FMaterialPrograms Programs;
	FRTPSOCompiler RayCompiler;
	std::unique_ptr<FStandInFeedback> StandIns;
	std::unique_ptr<FRayQueueDemand> QueueDemand;
	std::unique_ptr<FRayQueueCounter> RayCounter;
	bool bStandIns = false; // some hit program of the frame is not ready
	bool bRaysReady = true;
	bool bSkinningLeftOut = false;
	FSignalSet Ready; // signals whose ray generation shaders the last frame had
	std::shared_ptr<const FRTPSO> RayPipeline;
	std::unique_ptr<FFrameGraph> Graph;
	std::unique_ptr<FFrameContext> Context;
	FRTStatus FrameStatus;
	std::mutex FailureMutex; // of FrameStatus, while passes are recorded
	FSceneUse FrameUse;
	FUploadSlice SceneConstants, ViewConstants;
	bool bUpdating = false; // the scene has something to record in this frame
	bool bRayPassesAdded = false;
	bool bFrameLost = false;
	static constexpr uint32_t MaxInFlight = 2;
	static constexpr uint32_t KeptIdleFrames = 64; // of other views, after which a view's histories go
	std::vector<TRTRef<IRTCommandList>> Lists[MaxInFlight][QueueCount];
	uint32_t ListsUsed[QueueCount] = {};   // of Lists, in this frame
	std::vector<IRTCommandList*> Recorded; // of this frame, in order
	std::vector<FGraphSubmission> Submissions;
	FRTFence LastGraph = 0; // what the last frame of this renderer ended with
	FRTFence Fences[MaxInFlight] = {};
	uint32_t FlightIndex = 0; // of this frame, in Lists and Fences
	/// What a view keeps from frame to frame.
	struct FViewState
	{
		std::unique_ptr<FHistoryResources> History, HalfHistory; ///< HalfHistory: of FFrameContext::Half
		std::unique_ptr<FLightCells> LightCells;
		std::unique_ptr<FMovedCasters> Casters;
		std::unique_ptr<FRadianceEvents> RadianceEvents;
		FView LastView;          // of the newest frame that reached the GPU
		uint64_t LastScene = 0;  // identity of its scene's sections, which outlives an address; 0: none
		uint64_t Viewer = 0;     // who it is to scenes
		uint64_t Published = 0;  // FConsoleVariables::GetPublishCount of the newest frame that reached the GPU
		uint32_t IdleFrames = 0; // of other views since its own last one
		uint32_t Turn = 0;       // FViewConstants::FrameIndex of its newest frame
	};
	FViewState& GetView(uint32_t Index);
	std::map<uint32_t, FViewState> Views;
	FViewState* State = nullptr; // of this frame's view
	FView PreviousView;          // of this frame, see FFrameContext::PreviousView
	std::string LastDump;
	bool bDumpGraph = false;
	enum class EPrebind : uint8_t
	{
		None,
		InLine,
		Running
	};
	EPrebind Prebind = EPrebind::None;
	FRTStatus PrebindStatus;
	FTaskGroup PrebindTask; // last: it ends before what it uses
};

} // namespace Lantern
