// The draw calls by which a raster shows a scene to one view.
#pragma once

#include <functional>
#include <vector>

#include "LanternHost/HostScene.h"

namespace Lantern
{

class FDrawList
{
public:
	/// Objects of one batch, for one draw call.
	struct FRun
	{
		uint32_t Batch = 0; ///< index into FHostScene::GetBatches
		bool bMirrored = false;
		uint32_t Count = 0;
		FAddress Objects = 0; ///< uint32_t[Count], indices into FObjectData[]
	};

	/// Lists what View sees, solid batches before masked ones, and near ones before far ones. Objects smaller than MinPixels across on
	/// the screen are left out, and those for whose index Keep returns false. Keep may be empty. The list is good for this frame.
	FRTStatus Make(
	    FHostScene& Scene, FFrameUploads& Uploads, const FView& View, float MinPixels, const std::function<bool(uint32_t)>& Keep = {});
	const std::vector<FRun>& GetRuns() const { return Runs; }

private:
	struct FBatchUse
	{
		uint32_t Plain = 0;    ///< objects at the front of the batch's places
		uint32_t Mirrored = 0; ///< and at their back
	};
	void ListObjects(FHostScene& Scene, const std::function<bool(uint32_t)>& Keep, uint32_t* Objects);

	std::vector<FRun> Runs;
	// Kept for their memory.
	std::vector<FDrawBlocks::FSeen> Seen;
	std::vector<FBatchUse> Uses;
	std::vector<uint32_t> Order; // batches in use
};

} // namespace Lantern
