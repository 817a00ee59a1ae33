// Command lists that the module submits itself, ahead of an engine's.
#pragma once

#include <vector>

#include "LanternRHI/RTInterfaces.h"

namespace Lantern
{

/// Threads: render thread.
class FAheadLists
{
public:
	explicit FAheadLists(IRTDevice& InDevice) : Device(InDevice) {}
	/// Returns a list of the queue, begun: one that the GPU has finished with, or a new one.
	FRTStatus Begin(ERTQueue Queue, IRTCommandList*& Out);
	/// The list of the last Begin runs, and is done with the fence. One that is not submitted may be begun again at once.
	void Submitted(FRTFence Fence) { Items[Last].Fence = Fence; }

private:
	struct FItem
	{
		ERTQueue Queue;
		TRTRef<IRTCommandList> List;
		FRTFence Fence = 0;
	};
	IRTDevice& Device;
	std::vector<FItem> Items;
	size_t Last = 0;
};

} // namespace Lantern
