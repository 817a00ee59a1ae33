// FLightProfiles keeps what lights of a scene shine by direction, for shaders.
#pragma once

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
	/// Frees the number and its texels.
	void Remove(uint32_t Number);
	uint32_t GetCount() const { return Slots.GetAliveCount(); }
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
	TSlots<FRange> Slots;
	FSectionAllocator Words;
	TGpuTable<FLightProfile> Headers{"LightProfiles"};
	TGpuTable<uint32_t> Texels{"LightProfileTexels"};
};

} // namespace Lantern
