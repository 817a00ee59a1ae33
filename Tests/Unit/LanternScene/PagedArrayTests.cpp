// TPagedArray against std::vector, and that growth moves nothing.
#include "LanternScene/Memory/PagedArray.h"

#include <random>

#include <gtest/gtest.h>

namespace Lantern
{
namespace
{

using FArray = TPagedArray<uint32_t>;

void ExpectEqual(const FArray& Array, const std::vector<uint32_t>& Model)
{
	ASSERT_EQ(Array.Num(), Model.size());
	ASSERT_EQ(Array.IsEmpty(), Model.empty());
	std::vector<uint32_t> Copy(Model.size());
	Array.CopyTo(Copy.data(), 0, Copy.size());
	ASSERT_EQ(Copy, Model);
	size_t Seen = 0;
	for (size_t Page = 0; Page < Array.GetPageCount(); ++Page) { Seen += Array.GetPage(Page).size(); }
	ASSERT_EQ(Seen, Model.size());
}

TEST(FPagedArrayTest, EqualsAVectorOverRandomSteps)
{
	FArray Array;
	std::vector<uint32_t> Model;
	std::mt19937 Random(4);
	for (int Step = 0; Step < 2000; ++Step)
	{
		const uint32_t Choice = Random() % 10;
		if (Choice < 6)
		{
			Array.Add(Step);
			Model.push_back(Step);
		}
		else if (Choice < 8)
		{
			const size_t Count = Random() % (4 * FArray::PageEntries);
			Array.Resize(Count);
			Model.resize(Count);
		}
		else if (!Model.empty())
		{
			const size_t Index = Random() % Model.size(), Length = Random() % (Model.size() - Index);
			Array[Index] = Model[Index] = ~uint32_t(Step);
			std::vector<uint32_t> Part(Length);
			Array.CopyTo(Part.data(), Index, Length);
			ASSERT_TRUE(std::equal(Part.begin(), Part.end(), Model.begin() + static_cast<ptrdiff_t>(Index)));
		}
		ASSERT_NO_FATAL_FAILURE(ExpectEqual(Array, Model)) << Step;
	}
}

TEST(FPagedArrayTest, GrowthMovesNothingAndShrinkingFreesPages)
{
	FArray Array;
	Array.Add(1);
	const uint32_t* const First = &Array[0];
	Array.Resize(100 * FArray::PageEntries);
	EXPECT_EQ(&Array[0], First);
	EXPECT_EQ(Array.GetPageCount(), 100u);
	Array.Resize(FArray::PageEntries + 1);
	EXPECT_EQ(Array.GetPageCount(), 2u);
	EXPECT_EQ(&Array[0], First);
	Array.Resize(0);
	EXPECT_EQ(Array.GetPageCount(), 0u);
}

} // namespace
} // namespace Lantern
