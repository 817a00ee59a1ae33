// What a frame is made with: shader compiler, pipelines, the RTPSO and its table, memory for constants. A frame
// is built between BeginFrame and EndFrame; two may be in flight. Render thread only.
#pragma once

#include <array>
#include <memory>
#include <string>
#include <vector>

#include "LanternCore/FrameGraph/FrameGraph.h"
#include "LanternCore/Tasks/Tasks.h"
#include "LanternRenderer/View.h"
#include "LanternScene/Pipelines/ComputePipelines.h"
#include "LanternScene/Pipelines/RTPSOCompiler.h"
#include "LanternScene/Scene/Scene.h"
#include "LanternScene/ShaderTable/ShaderBindings.h"
#include "LanternSignals/Signals.h"

namespace Lantern
{

struct FRendererDesc
{
	std::vector<std::string> ShaderFolders; ///< the plugin's Shaders first
	std::string CacheFolder;                ///< compiled shaders; empty: none
};

/// One deformed geometry: linear blend skinning from its source into the buffers of the geometry.
struct FSkinningInputs
{
	FRTGeometryRef Geometry; ///< dynamic; its Positions and Attributes are written
	FAddress SourcePositions = 0, SourceAttributes = 0;
	FAddress Weights = 0; ///< FSkinVertex[]
	std::vector<glm::mat4> Joints;
};

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
};

/// What a frame is to do beside its cameras and console variables.
struct FFrameFeatures
{
	bool bReference = false;                  ///< the path tracer instead of real-time passes
	ESignal ReferenceSignal = ESignal::Frame; ///< the whole frame, or one signal as LanternSignals/Signals.h defines it
	/// The reference takes the surfaces of FReferencePassInputs::GBuffer. Not for ESignal::Frame.
	bool bReferenceFromGBuffer = false;
	/// Passes of the host's own trace rays: acceleration structures are kept whatever else does, and are recorded at the
	/// start of the frame …
	bool bRays = false;
	bool bLateRays = false; ///< … or, with this, where the host calls FFrameContext::RequireRays
	/// The frame waits for what it needs compiled, so that each picture is complete. Else it uses what is ready, see
	/// FRTPSOCompiler. The reference always waits.
	bool bWaitForPipelines = true;
	/// Ray generation shaders of the host's own passes, which then trace all ray types through the frame's RTPSO
	/// (FFrameContext::RayPipeline, FRTPSO::FindRayGen). Their push constants begin with FPassConstants.
	std::vector<FShaderSource> RayGens;
	std::vector<FShaderSource> Callables; ///< that these call, by index
	/// All acceleration structures that wait are built now, so that each picture is complete. Else within
	/// r.RT.Build.TrianglesPerFrame, and objects whose geometry waits are not seen by rays. The reference builds all.
	bool bBuildAll = true;
	std::vector<FSkinningInputs> Skinning;
	/// The host makes its motion vectors of FSceneConstants::ObjectMotions, which then say how objects moved since the frame
	/// before, wherever a filter follows it or FSignalRequests::bMotion asks. An engine that has motion vectors of its own
	/// saves 72 bytes a frame for each object that moves.
	bool bMotion = true;
	FSignalRequests Signals;
};

/// Counts of alpha tests under rays, with r.RT.Opacity.Count. A frame's count arrives two frames later, or with WaitForAll.
struct FAnyHitCounts
{
	uint64_t LastFrame = 0; ///< count of the newest frame that has arrived; modulo 2³²
	uint64_t Total = 0;     ///< sum over all frames that have arrived
	uint32_t Frames = 0;    ///< number of frames that have arrived
};

class FAnyHitCounter;
class FHistoryResources;
class FRefitQuality;
class FRenderer;
class FStandInFeedback;
struct FRayPrograms;

/// What pixels show and showed, for passes that reproject; made by the first that asks (Denoise/SurfaceHistory.h).
struct FSurfaceTextures
{
	FGraphTexture Current;  ///< RG32_FLOAT, see Shaders/Library/History.glsl
	FGraphTexture Previous; ///< of the frame before; invalid: there is none
	FGraphTexture Motion;   ///< as in FGBuffer; invalid where Previous is
};

/// Given to every pass.
struct FFrameContext
{
	IRTDevice& Device;
	FFrameGraph& Graph;
	FRTScene& Scene;
	FComputePipelines& Pipelines;
	FSceneFacts Facts;
	FPassConstants Pass; ///< addresses of this frame's constants
	FView View{};
	uint32_t Width = 0, Height = 0;
	/// Null where no pass of this frame traces through a pipeline.
	const FRTPSO* RayPipeline = nullptr;
	FShaderBindings* RayBindings = nullptr;
	/// Ray generation shaders of RayPipeline by signal; that of ESignal::Frame is the reference path tracer. NoRayGen: the frame
	/// does not have it, or it is still being compiled.
	std::array<uint32_t, SignalCount> RayGens = [] {
		std::array<uint32_t, SignalCount> None;
		None.fill(NoRayGen);
		return None;
	}();
	uint32_t GetRayGen(ESignal Signal) const { return RayGens[ToIndex(Signal)]; }
	/// The frame before this one; null where nothing may be carried over from it: the first, a cut, another size, a lost one,
	/// one that another renderer's frame of the scene has followed.
	const FView* PreviousView = nullptr;
	/// What passes keep from frame to frame.
	FHistoryResources* History = nullptr;
	FSurfaceTextures Surface;
	FSignalRequests Signals;
	/// First error that a pass met; the frame is then not submitted.
	FRTStatus* Status = nullptr;
	void Fail(const FRTStatus& Error) const
	{
		if (Status->IsOk()) { *Status = Error; }
	}
	FRenderer* Owner = nullptr;
	/// Whoever traces rays calls this before adding its pass. The first call adds what rays need of the frame:
	/// acceleration structures and shader records. They are gathered and written by tasks meanwhile, so the later it comes,
	/// and the more the host adds before (its G-buffer), the less there is to wait for.
	void RequireRays() const;
};

class FRenderer
{
public:
	FRenderer(IRTDevice& Device, FRendererDesc Desc);
	~FRenderer();

	/// At load, between frames: compiles what frames of the scene with these features will trace with, and waits for it.
	/// Progress (0 … 1) may be empty. What does not compile is said, and is an error only where frames cannot do without.
	FRTStatus Precache(FRTScene& Scene, const FFrameFeatures& Features, const std::function<void(float)>& Progress);
	/// What such frames trace with; without ray generation shaders where they need no pipeline. Between frames.
	FRTPSODesc GetRayPrograms(FRTScene& Scene, const FFrameFeatures& Features);
	/// Names the texts of all shaders that such frames trace with, their includes and the compiler: another text, another name.
	std::string GetRayShaderKey(FRTScene& Scene, const FFrameFeatures& Features);
	/// Waits until at most one earlier frame is in flight, publishes console variables, and starts a frame: gathering
	/// instances and writing shader records begin as tasks, the scene's tables are the first pass. The scene must not change
	/// until EndFrame, and must live until then.
	FRTStatus BeginFrame(FRTScene& Scene, const FView& View, const FFrameFeatures& Features);
	FFrameContext& GetContext(); ///< between BeginFrame and EndFrame
	/// Executes the graph and submits. OutFence may be null.
	FRTStatus EndFrame(FRTFence* OutFence);
	/// The same, recorded into the engine's command list, which the engine submits and then reports by
	/// FrameSubmitted with its fence. Objects that move in between count as moved before the frame: no motion vectors say so.
	FRTStatus EndFrame(IRTCommandList& List);
	/// 0: it never will be (EndFrame failed, the engine dropped its list, or gives the frame up before EndFrame).
	void FrameSubmitted(FRTFence Fence);

	/// The newest frame failed, and nothing of it reached the GPU.
	bool IsFrameLost() const { return bFrameLost; }

	FRTStatus WaitForAll();
	IRTDevice& GetDevice() { return Device; }
	FShaderCompiler& GetCompiler() { return Compiler; }
	FMaterialPrograms& GetPrograms() { return Programs; }
	FComputePipelines& GetPipelines() { return Pipelines; }
	FRefitQuality& GetRefitQuality() { return *RefitQuality; }
	FFrameUploads& GetUploads() { return Uploads; }
	FHistoryResources& GetHistory() { return *History; }
	FFrameGraphResources& GetGraphResources() { return GraphResources; }
	/// RTPSO of the last frame; null if it had none.
	const FRTPSO* GetRayPipeline() const { return RayPipeline.get(); }
	FRTPSOCompiler& GetRayCompiler() { return RayCompiler; }
	/// All that the last frame wanted to trace with was compiled, or cannot be.
	bool AreRayProgramsReady() { return bRaysReady || (RayPipeline && !RayCompiler.GetStats().bBusy); }
	/// What the compiler was told last of each program that is not ready.
	const std::vector<FProgramPriority>& GetProgramPriorities() const;
	const FShaderBindings& GetBindings() const { return Bindings; }
	const FAnyHitCounts& GetAnyHits() const;
	/// Whether executed frames leave DumpGraph a text; off by default, for it takes longer than the graph.
	void SetGraphDump(bool bEnabled) { bDumpGraph = bEnabled; }
	const std::string& DumpGraph() const { return LastDump; } ///< of the last executed frame

private:
	friend struct FFrameContext;
	FRTStatus PrepareRayPipeline(const FRayPrograms& Wanted, const FFrameFeatures& Features);
	FRTStatus StartUpdate(const FView& View, const FRayPrograms& Wanted, const FFrameFeatures& Features);
	void StartPrebind();
	FRTStatus FinishPrebind();
	void AddTables();
	void AddRayPasses();
	FRTStatus AllocateConstants();
	void WriteConstants();
	void DropFrame();
	void KeepHistory(bool bSubmitted);
	void EndFeedback(bool bSubmitted);
	FRTStatus WaitForSlot();
	FRTStatus Execute(IRTCommandList& List);

	IRTDevice& Device;
	FShaderCompiler Compiler;
	FComputePipelines Pipelines;
	FFrameUploads Uploads;
	FFrameGraphResources GraphResources;
	std::unique_ptr<FRefitQuality> RefitQuality;
	FShaderBindings Bindings;
	std::unique_ptr<FAnyHitCounter> AnyHits;
	FMaterialPrograms Programs;
	FRTPSOCompiler RayCompiler;
	std::unique_ptr<FStandInFeedback> StandIns;
	bool bStandIns = false; // some hit program of the frame is not ready
	bool bRaysReady = true;
	FSignalSet Ready; // signals whose ray generation shaders the last frame had
	std::shared_ptr<const FRTPSO> RayPipeline;
	std::unique_ptr<FFrameGraph> Graph;
	std::unique_ptr<FFrameContext> Context;
	FRTStatus FrameStatus;
	FSceneUse FrameUse;
	FUploadSlice SceneConstants, ViewConstants;
	bool bUpdating = false; // the scene has something to record in this frame
	bool bRayPassesAdded = false;
	bool bFrameLost = false;
	static constexpr uint32_t MaxInFlight = 2;
	TRTRef<IRTCommandList> Lists[MaxInFlight];
	FRTFence Fences[MaxInFlight] = {};
	uint32_t Slot = 0; // of this frame, in Lists and Fences
	std::unique_ptr<FHistoryResources> History;
	FView LastView;              // of the newest frame that reached the GPU
	uint64_t LastScene = 0;      // identity of its scene's sections, which outlives an address; 0: none
	uint32_t LastSceneFrame = 0; // what the scene counted it as: another renderer's frame may have followed
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
