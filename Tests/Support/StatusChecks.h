// Checks of a status in tests: its message is shown.
#pragma once

#include <gtest/gtest.h>

#include "LanternRHI/RTStatus.h"

#define LANTERN_CHECK_STATUS(Check, Expression)                                                                                            \
	do {                                                                                                                                   \
		const ::Lantern::FRTStatus Status_ = (Expression);                                                                                 \
		Check(Status_.IsOk()) << Status_.Message;                                                                                          \
	}                                                                                                                                      \
	while (false)

/// Ends the function where the status is an error.
#define ASSERT_OK(Expression) LANTERN_CHECK_STATUS(ASSERT_TRUE, Expression)
#define EXPECT_OK(Expression) LANTERN_CHECK_STATUS(EXPECT_TRUE, Expression)
