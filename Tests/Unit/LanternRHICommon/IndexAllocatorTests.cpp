// FIndexAllocator: indices of a bindless array.
#include "LanternRHICommon/IndexAllocator.h"

#include <gtest/gtest.h>

namespace Lantern
{
namespace
{

TEST(IndexAllocator, GivesEveryIndexOnce)
{
	FIndexAllocator Indices;
	EXPECT_EQ(Indices.Allocate(), FIndexAllocator::None) << "no capacity yet";
	Indices.SetCapacity(3);
	EXPECT_EQ(Indices.Allocate(), 0u);
	EXPECT_EQ(Indices.Allocate(), 1u);
	EXPECT_EQ(Indices.Allocate(), 2u);
	EXPECT_EQ(Indices.Allocate(), FIndexAllocator::None);
}

TEST(IndexAllocator, UsesFreedIndicesAgainTheLatestFirst)
{
	FIndexAllocator Indices;
	Indices.SetCapacity(4);
	for (uint32_t i = 0; i < 3; ++i) { ASSERT_EQ(Indices.Allocate(), i); }
	Indices.Free(0);
	Indices.Free(2);
	EXPECT_EQ(Indices.Allocate(), 2u);
	EXPECT_EQ(Indices.Allocate(), 0u);
	EXPECT_EQ(Indices.Allocate(), 3u) << "a new one only if none is free";
	EXPECT_EQ(Indices.Allocate(), FIndexAllocator::None);
}

} // namespace
} // namespace Lantern
