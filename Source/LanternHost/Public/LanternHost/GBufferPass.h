// Raster of the scene into the G-buffer that Frame.h describes.
#pragma once

#include <functional>
#include <map>
#include <optional>
#include <vector>

#include "LanternHost/DrawList.h"

namespace Lantern
{

/// Its pipelines are the renderer's (FPlainPipelines), compiled beside the frames. Frames that do not wait for pipelines draw what is
/// there. r.RT.Pipeline.Fallback says what a material program that is not ready shows; an edited one shows as it was before.
/// Draws without any pipeline are left out. Pipelines of other targets serve while a toggle's own are compiled.
/// A program that does not compile is drawn as before its edit, or as the standard program.
class FGBufferPass
{
public:
	explicit FGBufferPass(FRenderer& InRenderer) : Renderer(InRenderer) {}
	/// Starts the compiles that Precache waits for. Never waits. Between frames.
	void Want(FHostScene& Scene, const FFrameFeatures& Features) { Want(ListKeys(Scene, Features)); }
	/// Compiles what frames with these features will draw the scene with, and waits for it. For load time, between frames.
	/// Progress gets 0 to 1 and may be empty. The result is an error only if a picture would not be complete.
	FRTStatus Precache(FHostScene& Scene, const FFrameFeatures& Features, const std::function<void(float)>& Progress);
	/// Adds the raster pass. Context and Scene must live until the frame's EndFrame. One call a frame.
	FGBuffer Add(FFrameContext& Context, FHostScene& Scene);
	/// Culls objects smaller than so many pixels across on the screen. 0, the default, draws all.
	void SetMinPixels(float Pixels) { MinPixels = Pixels; }
	/// Enables FGBuffer::Motion for frames that follow motion; on by default. It costs 16 bytes a pixel, one more transform a vertex
	/// and two a pixel.
	void SetMotion(bool bEnabled) { bMotion = bEnabled; }

private:
	/// What is written beside what always is.
	struct FTargets
	{
		bool bMotion = false, bBack = false;
		friend auto operator<=>(const FTargets&, const FTargets&) = default;
	};
	struct FPipelineKey
	{
		uint32_t Program = StandardProgram;
		bool bMasked = false;
		ERTCull Cull = ERTCull::Back;
		FTargets Targets;
		friend auto operator<=>(const FPipelineKey&, const FPipelineKey&) = default;
	};
	bool MayMove(bool bFollowed) const;
	static std::vector<FPipelineKey> ListKeys(const FHostScene& Scene, const FSceneFacts& Facts, FTargets Targets);
	std::vector<FPipelineKey> ListKeys(FHostScene& Scene, const FFrameFeatures& Features) const;
	FRasterSource MakeSource(const FPipelineKey& Key) const;
	const FRasterSource& GetSource(const FPipelineKey& Key);
	void Want(const std::vector<FPipelineKey>& Keys);
	IRTPipeline* Ask(const FFrameContext& Context, const FPipelineKey& Key);
	bool FindPipelines(const FFrameContext& Context, const FHostScene& Scene, FTargets Targets);
	FTargets ChooseTargets(const FFrameContext& Context, const FHostScene& Scene);
	void RecordDraws(FFrameContext& Frame, IRTCommandList& List, FHostScene& Scene, FTargets Targets, bool bLayers);

	FRenderer& Renderer;
	std::map<FPipelineKey, FRasterSource> Sources;  // of the newest revisions
	std::map<FPipelineKey, IRTPipeline*> Pipelines; // of the frame that is being made; null: to be left out
	std::optional<FTargets> Complete;               // what last had all pipelines
	float MinPixels = 0.0f;
	bool bMotion = true;
	FDrawList Draws;
};

} // namespace Lantern
