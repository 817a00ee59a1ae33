// The scratch buffer of builds: it grows at once, shrinks after a while, and has a reserve for what must be built.
#pragma once

#include <cstdint>

#include "Geometry/GeometryMemoryBudget.h"
#include "Geometry/GeometrySlots.h"

namespace Lantern
{

/// Threads: render thread.
class FBuildScratch
{
public:
	/// The size is a multiple of this, in bytes.
	static constexpr uint64_t Step = 64 << 10;
	/// Frames in a row for which the buffer must be more than twice too large before it goes.
	static constexpr uint32_t ShrinkAfterFrames = 64;

	/// All must outlive this. The reserve for refits counts while Slots has dynamic geometries.
	FBuildScratch(IRTDevice& Device, const FGeometrySlots& Slots, FGeometryMemoryBudget& Memory);

	/// Bytes to allocate so that Bytes and the reserve fit; 0: the buffer is large enough. Otherwise this is the whole new
	/// size, since the GPU may still use the smaller buffer.
	uint64_t GetGrowth(uint64_t Bytes) const;
	/// Bytes that a build would take in addition: its structure and the growth of the buffer.
	uint64_t GetBuildBytes(const FRTBuildSizes& Sizes) const { return Sizes.StructureBytes + GetGrowth(Sizes.BuildScratchBytes); }
	/// Makes the buffer hold Bytes and the reserve. On error the buffer stays as it was.
	FRTStatus Grow(uint64_t Bytes);
	/// See FGeometryStore::ReserveScratch.
	FRTStatus Reserve(uint64_t Bytes, IRTBuffer*& Out);
	/// Sets what refits of a frame need at least, in bytes: later frames reserve as much.
	void SetRefitReserve(uint64_t Bytes) { RefitReserve = Bytes; }
	/// Null before the first Grow, and after the buffer went.
	IRTBuffer* Get() const { return Buffer.Get(); }

	/// The buffer goes soon if no frame needs more of it: frames must be submitted until then.
	bool IsTooLarge() const;
	/// Must follow each submitted frame.
	void EndFrame();

private:
	IRTDevice& Device;
	const FGeometrySlots& Slots;
	FGeometryMemoryBudget& Memory;
	TRTRef<IRTBuffer> Buffer;
	uint64_t FrameNeed = 0;  ///< this frame, bytes
	uint64_t RecentNeed = 0; ///< most of the frames in a row that found the buffer too large, bytes
	uint64_t SceneReserve = 0, RefitReserve = 0;
	uint32_t FramesTooLarge = 0;
};

} // namespace Lantern
