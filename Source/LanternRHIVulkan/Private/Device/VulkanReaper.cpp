// FVulkanReaper: the thread, and who waits for it.
#include "Device/VulkanReaper.h"

#include <utility>

namespace Lantern
{

FVulkanReaper::~FVulkanReaper()
{
	{
		const std::scoped_lock Lock(Mutex);
		bStop = true;
	}
	Added.notify_all();
	if (Thread.joinable()) { Thread.join(); }
}

void FVulkanReaper::Add(const FVulkanGarbage& Item)
{
	{
		const std::scoped_lock Lock(Mutex);
		Items.push_back(Item);
		if (!Thread.joinable())
		{
			Thread = std::thread([this] { Run(); });
		}
	}
	Added.notify_one();
}

void FVulkanReaper::Drain()
{
	std::unique_lock Lock(Mutex);
	Idle.wait(Lock, [this] { return Items.empty() && !bBusy; });
}

void FVulkanReaper::Run()
{
	std::unique_lock Lock(Mutex);
	for (;;)
	{
		Added.wait(Lock, [this] { return bStop || !Items.empty(); });
		if (Items.empty()) { return; }
		const std::vector<FVulkanGarbage> Dead = std::exchange(Items, {});
		bBusy = true;
		Lock.unlock();
		for (const FVulkanGarbage& Item : Dead) { Item.Delete(Item.Object); }
		Lock.lock();
		bBusy = false;
		Idle.notify_all();
	}
}

} // namespace Lantern
