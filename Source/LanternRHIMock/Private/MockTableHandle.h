// The handle of a shader group as the mock gives it out.
#pragma once

#include <cstdint>

namespace Lantern
{

struct FMockHandle
{
	static constexpr uint64_t TheMagic = 0x454c444e41485452ull;

	FMockHandle() = default;
	FMockHandle(uint64_t InPipeline, uint32_t InGroup) : Magic(TheMagic), Pipeline(InPipeline), Group(InGroup), Check(ComputeCheck()) {}
	bool IsGood() const { return Magic == TheMagic && Check == ComputeCheck(); }

	uint64_t Magic = 0;
	uint64_t Pipeline = 0;
	uint32_t Group = 0;
	uint32_t Check = 0; ///< tells a handle from record data

private:
	uint32_t ComputeCheck() const { return static_cast<uint32_t>(Pipeline * 2654435761u) ^ (Group * 40503u + 17u); }
};
static_assert(sizeof(FMockHandle) == 24, "must fit into the smallest handle, 32 bytes");

} // namespace Lantern
