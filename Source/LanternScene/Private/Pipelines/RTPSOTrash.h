// Objects whose destruction would cost the render thread time.
#pragma once

#include <memory>
#include <type_traits>
#include <utility>
#include <vector>

namespace Lantern
{

/// Keeps objects until a background thread destroys them. Freeing memory that a compile thread allocated takes a lock of the
/// allocator, and such a thread may hold it while it does not run. Measured: 5 to 150 ms of a frame on two busy cores.
/// Threads: the caller holds the lock of the RTPSO compiler.
class FTrash
{
public:
	template <class T>
	void Discard(T&& Object)
	{
		static_assert(!std::is_lvalue_reference_v<T>);
		Objects.push_back(std::make_shared<T>(std::forward<T>(Object)));
	}
	bool IsEmpty() const { return Objects.empty(); }
	/// All objects so far. The caller destroys them, without the lock.
	std::vector<std::shared_ptr<void>> Take() { return std::exchange(Objects, {}); }

private:
	std::vector<std::shared_ptr<void>> Objects;
};

} // namespace Lantern
