// Distinct group handles by number. Records hold the number, four bytes instead of 32: when a pipeline replaces another,
// far less has to be written, and the records' data are not touched.
#pragma once

#include <cstdint>
#include <string>
#include <unordered_map>
#include <vector>

namespace Lantern
{

class FVulkanHandleStore
{
public:
	static constexpr uint32_t Null = 0; ///< zeros: a record without shaders

	void Initialise(uint32_t InHandleSize);
	/// From now on SlotsOfGroups is of these handles. Numbers given before stay.
	void SetPipeline(const uint8_t* Handles, uint32_t GroupCount);
	const uint32_t* GetSlotsOfGroups() const { return SlotsOfGroups.data(); }
	const uint8_t* GetHandles() const { return Bytes.data(); } ///< of HandleSize bytes each, by number
	uint32_t GetCount() const { return static_cast<uint32_t>(Bytes.size() / HandleSize); }
	/// Many are of pipelines long gone: find out which are used, and call Prune.
	bool IsCrowded() const { return GetCount() > MostBeforePruning; }
	/// Drops all but the Used ones (by number) and those of the pipeline. Returns the new number of each old one.
	std::vector<uint32_t> Prune(const std::vector<bool>& Used);

private:
	uint32_t FindOrAdd(const uint8_t* Handle);

	uint32_t HandleSize = 1;
	uint32_t MostBeforePruning = 4096;
	std::vector<uint8_t> Bytes;
	std::unordered_map<std::string, uint32_t> Slots; // by bytes
	std::vector<uint32_t> SlotsOfGroups;
};

} // namespace Lantern
