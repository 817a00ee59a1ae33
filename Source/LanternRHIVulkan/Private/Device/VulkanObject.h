// Reference counting of everything that a device creates. The last Release hands the object to the device. The device
// deletes it, and with it the native object, once the GPU has finished all work submitted by then.
#pragma once

#include "LanternRHI/RTInterfaces.h"
#include "LanternRHICommon/RefCounted.h"

#include <type_traits>
#include <utility>

namespace Lantern
{

class FVulkanDevice;

/// The device implements these two (VulkanDevice.cpp), so that objects need not see its class.
void AddChild(FVulkanDevice& Device);
/// Object must not be touched afterwards. bSlow: see FVulkanGarbage.
void RetireChild(FVulkanDevice& Device, void* Object, void (*Delete)(void*), bool bSlow);

template <class TInterface>
class TVulkanObject : public TRefCounted<TInterface>
{
public:
	explicit TVulkanObject(FVulkanDevice& InDevice) : Device(InDevice) { AddChild(Device); }

	FVulkanDevice& Device;

protected:
	~TVulkanObject() override = default;

private:
	void OnFinalRelease() final
	{
		constexpr bool bSlow = std::is_same_v<TInterface, IRTPipeline>;
		RetireChild(
		    Device, this, [](void* Object) { delete static_cast<TVulkanObject*>(Object); }, bSlow);
	}
};

/// Makes an object. The result holds its only reference.
template <class T, class... TArgs>
TRTRef<T> MakeVulkanObject(TArgs&&... Args)
{
	T* Object = new T(std::forward<TArgs>(Args)...);
	TRTRef<T> Result(Object);
	Object->Release();
	return Result;
}

/// Gives a reference to the caller of a creation function.
template <class TInterface, class T>
void HandOut(TRTRef<T>& Object, TInterface** Out)
{
	Object->AddRef();
	*Out = Object.Get();
}

} // namespace Lantern
