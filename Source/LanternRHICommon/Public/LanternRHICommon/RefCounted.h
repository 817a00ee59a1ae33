// Reference counting of objects behind the RHI's interfaces.
#pragma once

#include "LanternRHI/RTStatus.h"

#include <atomic>

namespace Lantern
{

/// Implements the counting half of TInterface, which derives from IRTRefCounted. A new object has one reference, owned by
/// whoever created it. Thread-safe.
template <class TInterface>
class TRefCounted : public TInterface
{
public:
	TRefCounted() = default;
	TRefCounted(const TRefCounted&) = delete;
	TRefCounted& operator=(const TRefCounted&) = delete;

	uint32_t AddRef() final { return References.fetch_add(1, std::memory_order_relaxed) + 1; }
	uint32_t Release() final
	{
		const uint32_t Left = References.fetch_sub(1, std::memory_order_acq_rel) - 1;
		if (Left == 0) { OnFinalRelease(); }
		return Left;
	}
	/// 1 means that only the caller has the object: no one else can take another reference.
	uint32_t GetReferences() const { return References.load(std::memory_order_acquire); }

protected:
	~TRefCounted() override = default;
	/// Runs when the last reference goes. An override may delete later, for example once the GPU has finished.
	virtual void OnFinalRelease() { delete this; }

private:
	std::atomic<uint32_t> References{1};
};

} // namespace Lantern
