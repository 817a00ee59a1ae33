// WaitAwake: asks until it is done, or until the time is over.
#include <gtest/gtest.h>

#include "LanternCore/Tasks/WaitAwake.h"

namespace Lantern
{
namespace
{

constexpr double Hour = 3.6e6;

TEST(WaitAwake, AsksUntilItIsDone)
{
	int Asked = 0;
	EXPECT_TRUE(WaitAwake([&] { return ++Asked == 5; }, Hour));
	EXPECT_EQ(Asked, 5);
}

TEST(WaitAwake, WhatIsDoneNeedsNoTime)
{
	EXPECT_TRUE(WaitAwake([] { return true; }, 0.0));
}

TEST(WaitAwake, GivesUpWhenTheTimeIsOver)
{
	int Asked = 0;
	EXPECT_FALSE(WaitAwake([&] { return ++Asked == 2; }, 0.0));
	EXPECT_EQ(Asked, 1);
	EXPECT_FALSE(WaitAwake([] { return false; }, 1e-3));
}

} // namespace
} // namespace Lantern
