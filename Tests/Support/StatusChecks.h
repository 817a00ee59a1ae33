// Checks of a status in tests: its message is shown.
#pragma once

#include <gtest/gtest.h>

#include "LanternRHI/RTInterfaces.h"

#define ASSERT_FINE(Expression)                                                                                                            \
	do {                                                                                                                                   \
		const ::Lantern::FRTStatus Fine = (Expression);                                                                                    \
		ASSERT_TRUE(Fine.IsOk()) << Fine.Message;                                                                                          \
	}                                                                                                                                      \
	while (false)
