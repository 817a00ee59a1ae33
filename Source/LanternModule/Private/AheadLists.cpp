// FAheadLists: lists are used again once the GPU has finished with them.
#include "AheadLists.h"

#include <algorithm>
#include <utility>

namespace Lantern
{

FRTStatus FAheadLists::Begin(ERTQueue Queue, IRTCommandList*& Out)
{
	const FRTFence Done = Device.GetCompletedFence(Queue);
	const auto Idle = std::find_if(Items.begin(), Items.end(),
	    [=](const FItem& Item) { return Item.Queue == Queue && GetFenceValue(Item.Fence) <= GetFenceValue(Done); });
	Last = static_cast<size_t>(Idle - Items.begin());
	if (Idle == Items.end())
	{
		FItem New{Queue, nullptr};
		if (FRTStatus S = Device.CreateCommandList("Ahead", New.List.ReleaseAndGetAddress(), Queue); !S) { return S; }
		Items.push_back(std::move(New));
	}
	Out = Items[Last].List.Get();
	return Out->Begin();
}

} // namespace Lantern
