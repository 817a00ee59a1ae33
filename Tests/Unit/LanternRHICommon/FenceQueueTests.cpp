// TFenceQueue: what waits for which fence, and in which order it goes.
#include "LanternRHICommon/FenceQueue.h"

#include <memory>

#include <gtest/gtest.h>

namespace Lantern
{
namespace
{

TEST(FenceQueue, NothingGoesBeforeItsFence)
{
	TFenceQueue<int> Queue;
	EXPECT_TRUE(Queue.IsEmpty());
	EXPECT_FALSE(Queue.Pop(~0ull));
	Queue.Push(2, 20);
	Queue.Push(2, 21);
	Queue.Push(5, 50);
	EXPECT_FALSE(Queue.Pop(1));
	EXPECT_EQ(Queue.Pop(2), 20);
	EXPECT_EQ(Queue.Pop(4), 21);
	EXPECT_FALSE(Queue.Pop(4));
	EXPECT_FALSE(Queue.IsEmpty());
	EXPECT_EQ(Queue.Pop(5), 50);
	EXPECT_TRUE(Queue.IsEmpty());
}

TEST(FenceQueue, ALowerFenceWaitsForTheOneBefore)
{
	TFenceQueue<int> Queue;
	Queue.Push(3, 30);
	Queue.Push(1, 10);
	EXPECT_FALSE(Queue.Pop(1));
	EXPECT_EQ(Queue.Pop(3), 30);
	EXPECT_EQ(Queue.Pop(3), 10);
}

TEST(FenceQueue, MovesItsItems)
{
	TFenceQueue<std::unique_ptr<int>> Queue;
	Queue.Push(0, std::make_unique<int>(7));
	const std::optional<std::unique_ptr<int>> Item = Queue.Pop(0);
	ASSERT_TRUE(Item && *Item) << "fence 0 is always complete";
	EXPECT_EQ(**Item, 7);
}

} // namespace
} // namespace Lantern
