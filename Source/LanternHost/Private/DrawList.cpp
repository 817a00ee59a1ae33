// Sorts what a view sees by batch.
#include "LanternHost/DrawList.h"

#include <algorithm>
#include <bit>

namespace Lantern
{

/// Lists the objects of each batch in its places, near before far, and orders the batches by their nearest objects.
void FDrawList::ListObjects(FHostScene& Scene, const std::function<bool(uint32_t)>& Keep, uint32_t* Objects)
{
	const uint32_t* const Indices = Scene.GetBatchIndices().data();
	const FHostScene::FDrawBatch* const Batches = Scene.GetBatches().data();
	Uses.assign(Scene.GetBatches().size(), {});
	Order.clear();
	for (const FDrawBlocks::FSeen& InBlock : Seen)
	{
		const FDrawBlocks::FBlock& Block = Scene.GetDrawBlocks().GetBlock(InBlock.Block);
		for (uint64_t Left = InBlock.Items; Left != 0; Left &= Left - 1)
		{
			const int Index = std::countr_zero(Left);
			const FDrawBlocks::FItem& Item = Block.Items[Index];
			if (Keep && !Keep(Item.Object)) { continue; }
			const bool bMirrored = ((Block.Mirrored >> Index) & 1u) != 0;
			for (uint32_t I = 0; I < Item.BatchCount; ++I)
			{
				const uint32_t Batch = Indices[Item.FirstBatch + I];
				FBatchUse& Use = Uses[Batch];
				if (Use.Plain + Use.Mirrored == 0) { Order.push_back(Batch); }
				const uint32_t Place = bMirrored ? Batches[Batch].Places - ++Use.Mirrored : Use.Plain++;
				Objects[Batches[Batch].FirstPlace + Place] = Item.Object;
			}
		}
	}
	std::stable_partition(Order.begin(), Order.end(), [&](uint32_t Batch) { return !Batches[Batch].bMasked; });
}

FRTStatus FDrawList::Make(
    FHostScene& Scene, FFrameUploads& Uploads, const FView& View, float MinPixels, const std::function<bool(uint32_t)>& Keep)
{
	Runs.clear();
	Scene.GetDrawBlocks().Collect(View, MinPixels, Seen);
	if (Seen.empty()) { return FRTStatus::Success(); }
	FUploadSlice Objects;
	if (FRTStatus S = Uploads.Allocate(uint64_t(Scene.GetPlaceCount()) * sizeof(uint32_t), Objects); !S) { return S; }
	ListObjects(Scene, Keep, static_cast<uint32_t*>(Objects.Data));
	for (const uint32_t Index : Order)
	{
		const FHostScene::FDrawBatch& Batch = Scene.GetBatches()[Index];
		for (const bool bMirrored : {false, true})
		{
			const uint32_t Count = bMirrored ? Uses[Index].Mirrored : Uses[Index].Plain;
			const uint32_t First = Batch.FirstPlace + (bMirrored ? Batch.Places - Count : 0);
			if (Count > 0) { Runs.push_back({Index, bMirrored, Count, Objects.Address + uint64_t(First) * sizeof(uint32_t)}); }
		}
	}
	return FRTStatus::Success();
}

} // namespace Lantern
