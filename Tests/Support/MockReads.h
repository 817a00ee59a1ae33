// What tests read from the mock device's memory.
#pragma once

#include <cstdint>
#include <cstring>

#include <gtest/gtest.h>

#include "LanternRHIMock/MockDevice.h"

namespace Lantern
{

/// Reads entry Index of an array of T at Address.
template <class T>
T ReadMockEntry(FRTMock& Mock, uint64_t Address, uint32_t Index)
{
	T Out{};
	uint64_t Offset = 0;
	IRTBuffer* const Buffer = Mock.FindBuffer(Address + Index * sizeof(T), &Offset);
	EXPECT_NE(Buffer, nullptr);
	if (Buffer != nullptr) { std::memcpy(&Out, Mock.GetBytes(Buffer) + Offset, sizeof(T)); }
	return Out;
}

} // namespace Lantern
