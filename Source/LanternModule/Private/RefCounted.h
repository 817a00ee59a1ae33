// Reference counting for the module's own objects.
#pragma once

#include <atomic>
#include <cstdint>

namespace Lantern
{

template <class T>
class TRefCounted : public T
{
public:
	uint32_t AddRef() final { return ++Count; }
	uint32_t Release() final
	{
		const uint32_t Left = --Count;
		if (Left == 0) { delete this; }
		return Left;
	}

protected:
	~TRefCounted() override = default;

private:
	std::atomic<uint32_t> Count{1};
};

} // namespace Lantern
