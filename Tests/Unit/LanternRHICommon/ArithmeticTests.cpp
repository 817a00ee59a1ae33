// AlignUp and IsInside.
#include "LanternRHICommon/Arithmetic.h"

#include <gtest/gtest.h>

namespace Lantern
{
namespace
{

TEST(Arithmetic, AlignUpIsTheSmallestMultiple)
{
	EXPECT_EQ(AlignUp(0, 64), 0u);
	EXPECT_EQ(AlignUp(1, 64), 64u);
	EXPECT_EQ(AlignUp(64, 64), 64u);
	EXPECT_EQ(AlignUp(65, 64), 128u);
	EXPECT_EQ(AlignUp(10, 12), 12u) << "not a power of two";
	EXPECT_EQ(AlignUp((1ull << 40) + 1, 256), (1ull << 40) + 256);
}

TEST(Arithmetic, IsInsideAtItsEdges)
{
	EXPECT_TRUE(IsInside(0, 16, 16));
	EXPECT_TRUE(IsInside(16, 0, 16));
	EXPECT_FALSE(IsInside(1, 16, 16));
	EXPECT_FALSE(IsInside(17, 0, 16));
	EXPECT_FALSE(IsInside(8, ~0ull, 16)) << "offset and size together overflow";
}

} // namespace
} // namespace Lantern
