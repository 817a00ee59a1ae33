// Histories: named textures and buffers that one frame leaves for the next and that outlive the frame graph. A history texture
// is double-buffered: each frame reads the previous one and writes the current one. A cache buffer is changed in place. The
// graph marks all of them, so that tests can poison them (FFrameGraphResources::PoisonHistory).
//
//   FHistoryTexture Mean = History.GetTexture("SunShadow.Mean", {W, H, ERTFormat::RG16_FLOAT});
//   if (Mean.Previous.IsValid()) { … reproject … }   // else: start anew
//   … write Mean.Current, wholly …
//
// Writing a history does not keep a pass from being culled; if it is culled, the history ends. Some passes have no other
// output, such as one that copies the G-buffer for the next frame. Such a pass runs if another pass that runs reads Current in
// this frame, or declares by FPassBuilder::Keep(Current) that it will in the next. Declare it from the first frame on.
//
// The calls of a frame are BeginFrame → Get… → (graph executed and submitted) → EndFrame. One object serves one view. Render
// thread only.
#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "LanternCore/FrameGraph/FrameGraph.h"

namespace Lantern
{

struct FHistoryTexture
{
	/// The previous frame's texture, in ShaderRead, at the resolution that frame had. Invalid on first use, after a cut, and with
	/// another format. Also
	/// invalid after a frame that was lost or did not write Current.
	FGraphTexture Previous;
	FGraphTexture Current; ///< one of the frame's passes must write all of it; later passes may read it
};

struct FHistoryBuffer
{
	FGraphBuffer Buffer;
	/// True if nothing was written since its creation or, of a view's, a cut: the content is undefined and must be written wholly.
	bool bFresh = false;
	/// Whether the last submitted frame wrote it. Else what it holds is older, or part of it was never written.
	bool bOfLastFrame = false;
};

enum class EHistoryScope : uint8_t
{
	View,  ///< a cut ends it
	World, ///< a cache of what the scene holds, wherever the camera is
};

class FHistoryResources
{
public:
	explicit FHistoryResources(IRTDevice& Device);
	~FHistoryResources();
	FHistoryResources(const FHistoryResources&) = delete;
	FHistoryResources& operator=(const FHistoryResources&) = delete;

	/// bKeep: false invalidates the content of all histories but keeps their memory (a cut). bKeepWorld: those of the world keep it.
	void BeginFrame(FFrameGraph& Graph, bool bKeep, bool bKeepWorld = false);
	/// Returns the history of this name, once a frame. Another format starts anew. Fails if there is no memory; the
	/// pass must then be left out. The textures may be sampled, stored to and copied to; ExtraUsage adds to that. Takes the
	/// memory of two textures.
	FRTStatus GetTexture(const char* Name, const FGraphTextureDesc& Desc, FHistoryTexture& Out);
	/// Returns the cache of this name. It keeps its content in frames that do not write it or do not ask for it.
	FRTStatus GetBuffer(const char* Name, const FGraphBufferDesc& Desc, FHistoryBuffer& Out, EHistoryScope Scope = EHistoryScope::View);
	/// Call after the graph was executed. bSubmitted false: the frame never runs, so that its writes do not count. Frees what
	/// no frame asked for in the last KeepFrames frames, once the GPU is done with it.
	void EndFrame(bool bSubmitted);
	/// Frees everything. Only between frames.
	void Clear();
	uint64_t GetBytes() const; ///< memory held, without the driver's padding
	/// Returns the parts of it by name, in no order.
	std::vector<std::pair<std::string, uint64_t>> GetParts() const;

	static constexpr uint32_t KeepFrames = 8;

private:
	struct FImpl;
	std::unique_ptr<FImpl> Impl;
};

} // namespace Lantern
