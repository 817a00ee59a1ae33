// What one frame leaves for the next: named textures and buffers that outlive the frame graph. Histories are written
// anew each frame from what the frame before left (two of each, in turn); caches are changed in place. Both are marked
// in the graph, so that tests can poison them (FFrameGraphResources::PoisonHistory).
//
//   FHistoryTexture Mean = History.GetTexture("SunShadow.Mean", {W, H, ERTFormat::RG16_FLOAT});
//   if (Mean.Previous.IsValid()) { … reproject … }   // else: start anew
//   … write Mean.Current, wholly …
//
// Writing a history keeps no pass alive by itself: what nobody reads is culled, and the history then ends. A pass that has
// no other output, such as one that copies the G-buffer for the next frame, runs if a pass that runs reads Current in this
// frame, or says FPassBuilder::Keep(Current): "I shall read it in the next". Say it from the first frame on.
//
// A frame: BeginFrame → Get… → (graph executed and submitted) → EndFrame. Of one view. Render thread.
#pragma once

#include <memory>
#include <string>

#include "LanternCore/FrameGraph/FrameGraph.h"

namespace Lantern
{

struct FHistoryTexture
{
	/// In ShaderRead; invalid: there is none (first use, a cut, another size or format, a lost frame, or one that did not
	/// write Current).
	FGraphTexture Previous;
	FGraphTexture Current; ///< to be written wholly by one of the frame's passes; may be read by those behind it
};

struct FHistoryBuffer
{
	FGraphBuffer Buffer;
	/// Nothing has been written to it since it was made or since a cut: its content is undefined, and must be written wholly.
	bool bFresh = false;
};

class FHistoryResources
{
public:
	explicit FHistoryResources(IRTDevice& Device);
	~FHistoryResources();
	FHistoryResources(const FHistoryResources&) = delete;
	FHistoryResources& operator=(const FHistoryResources&) = delete;

	/// bKeep: false forgets the content of all (not their memory): a cut.
	void BeginFrame(FFrameGraph& Graph, bool bKeep);
	/// The same name once a frame; another size or format starts anew. Error: no memory; the frame cannot go on with this
	/// pass. May be sampled, stored to and copied to; ExtraUsage: what else. Memory: two textures of the description.
	FRTStatus GetTexture(const char* Name, const FGraphTextureDesc& Desc, FHistoryTexture& Out);
	/// A cache, changed in place: it keeps its content in frames that do not write it, or do not ask for it.
	FRTStatus GetBuffer(const char* Name, const FGraphBufferDesc& Desc, FHistoryBuffer& Out);
	/// After the graph was executed. bSubmitted: false: the frame never runs, and what it would have written is not there.
	/// What no frame asked for in the last KeepFrames frames is freed, when the GPU is done with it.
	void EndFrame(bool bSubmitted);
	/// Frees all of it. Between frames.
	void Clear();
	uint64_t GetBytes() const; ///< without the driver's padding

	static constexpr uint32_t KeepFrames = 8;

private:
	struct FImpl;
	std::unique_ptr<FImpl> Impl;
};

} // namespace Lantern
