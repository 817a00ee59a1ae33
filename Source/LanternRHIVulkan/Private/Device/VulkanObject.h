// Reference counting of everything a device creates. The last Release hands the object to the device, which
// deletes it (and with it the native object) once the GPU is past all work submitted by then.
#pragma once

#include "LanternRHI/RTInterfaces.h"

#include <atomic>
#include <utility>

namespace Lantern
{

class FVulkanDevice;

/// Implemented by the device (VulkanDevice.cpp); apart from it so that objects need not see the device's class.
void AddChild(FVulkanDevice& Device);
/// Object must not be touched afterwards.
void RetireChild(FVulkanDevice& Device, void* Object, void (*Delete)(void*));

template <class TInterface>
class TVulkanObject : public TInterface
{
public:
	explicit TVulkanObject(FVulkanDevice& InDevice) : Device(InDevice) { AddChild(Device); }
	TVulkanObject(const TVulkanObject&) = delete;
	TVulkanObject& operator=(const TVulkanObject&) = delete;

	uint32_t AddRef() override { return References.fetch_add(1, std::memory_order_relaxed) + 1; }
	uint32_t Release() override
	{
		const uint32_t Left = References.fetch_sub(1, std::memory_order_acq_rel) - 1;
		if (Left == 0)
		{
			RetireChild(Device, this, [](void* Object) { delete static_cast<TVulkanObject*>(Object); });
		}
		return Left;
	}

	/// 1 means that only the caller has it: no one else can take another.
	uint32_t GetReferences() const { return References.load(std::memory_order_acquire); }

	FVulkanDevice& Device;

protected:
	~TVulkanObject() override = default;

private:
	std::atomic<uint32_t> References{1};
};

/// Takes the one reference of a new object.
template <class T, class... TArgs>
TRTRef<T> MakeVulkanObject(TArgs&&... Args)
{
	T* Object = new T(std::forward<TArgs>(Args)...);
	TRTRef<T> Result(Object);
	Object->Release();
	return Result;
}

/// Gives the reference to the caller of a creation function.
template <class TInterface, class T>
void HandOut(TRTRef<T>& Object, TInterface** Out)
{
	Object->AddRef();
	*Out = Object.Get();
}

} // namespace Lantern
