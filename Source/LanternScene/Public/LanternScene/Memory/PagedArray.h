// TPagedArray grows without moving what is there: a frame that adds one more entry never pays for all those before it.
#pragma once

#include <algorithm>
#include <cassert>
#include <cstddef>
#include <memory>
#include <span>
#include <vector>

namespace Lantern
{

/// An array in pages of PageEntries. Loops over all entries go page by page, and are then as fast as over a flat array.
template <class T>
class TPagedArray
{
public:
	static constexpr size_t PageEntries = 1024;

	size_t Num() const { return Count; }
	bool IsEmpty() const { return Count == 0; }
	T& operator[](size_t Index)
	{
		assert(Index < Count);
		return Pages[Index / PageEntries][Index % PageEntries];
	}
	const T& operator[](size_t Index) const
	{
		assert(Index < Count);
		return Pages[Index / PageEntries][Index % PageEntries];
	}
	const T& Last() const { return (*this)[Count - 1]; }
	void Add(const T& Value)
	{
		Resize(Count + 1);
		(*this)[Count - 1] = Value;
	}
	/// New entries are T{}. Pages behind the end are freed.
	void Resize(size_t NewCount)
	{
		const size_t PageCount = (NewCount + PageEntries - 1) / PageEntries;
		for (size_t Index = NewCount; Index < std::min(Count, PageCount * PageEntries); ++Index) { (*this)[Index] = T{}; }
		Pages.resize(std::min(Pages.size(), PageCount));
		while (Pages.size() < PageCount) { Pages.push_back(std::make_unique<T[]>(PageEntries)); }
		Count = NewCount;
	}
	/// Writes NumEntries entries, from First on, to Out.
	void CopyTo(T* Out, size_t First, size_t NumEntries) const
	{
		for (size_t Left = NumEntries; Left > 0;)
		{
			const std::span<const T> Page = GetPage(First / PageEntries).subspan(First % PageEntries);
			const size_t Run = std::min(Left, Page.size());
			Out = std::copy_n(Page.begin(), Run, Out);
			First += Run;
			Left -= Run;
		}
	}
	size_t GetPageCount() const { return Pages.size(); }
	std::span<const T> GetPage(size_t Page) const { return {Pages[Page].get(), std::min(PageEntries, Count - Page * PageEntries)}; }

private:
	std::vector<std::unique_ptr<T[]>> Pages;
	size_t Count = 0;
};

} // namespace Lantern
