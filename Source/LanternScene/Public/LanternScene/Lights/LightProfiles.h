// FLightProfiles keeps what lights of a scene shine by direction, for shaders.
#pragma once

#include <deque>

#include "LanternScene/Lights/Photometry.h"
#include "LanternScene/Memory/GpuTable.h"
#include "LanternScene/Memory/Slots.h"
#include "LanternScene/ShaderTable/SectionAllocator.h"
#include "LightTypes.h"

namespace Lantern
{

/// Costs nothing while it is empty. Threads: one at a time.
class FLightProfiles
{
public:
	/// Returns the profile's number, from 1. Returns 0, and logs that once, if there are LIGHT_PROFILES_MOST.
	uint32_t Add(const FProfileGrid& Grid);
	/// Frees the number and its texels, once KeptFrames frames were submitted. Views compare lights with those of their last frame, and
	/// have to know what these shone.
	void Remove(uint32_t Number);
	static constexpr uint32_t KeptFrames = 64;
	void EndFrame(bool bSubmitted);
	/// Returns whether a removed one is still there.
	bool HasRetired() const { return !Retired.empty(); }
	TGpuTable<FLightProfile>& GetHeaders() { return Headers; }
	const TGpuTable<FLightProfile>& GetHeaders() const { return Headers; }
	/// Two texels in a word.
	TGpuTable<uint32_t>& GetTexels() { return Texels; }
	const TGpuTable<uint32_t>& GetTexels() const { return Texels; }

private:
	/// Words of Texels.
	struct FRange
	{
		uint32_t First = 0, Count = 0;
	};
	struct FRetired
	{
		uint32_t Slot = 0;
		uint64_t Frame = 0; ///< in which it was removed
	};
	void FreeBefore(uint64_t Frame);
	TSlots<FRange> Slots;
	std::deque<FRetired> Retired; // the oldest first
	uint64_t Frames = 0;          // submitted ones
	FSectionAllocator Words;
	TGpuTable<FLightProfile> Headers{"LightProfiles"};
	TGpuTable<uint32_t> Texels{"LightProfileTexels"};
};

} // namespace Lantern
