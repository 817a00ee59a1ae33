// Handles of shader groups by number. A record holds the number, four bytes instead of a handle's 32 or more. When one
// pipeline replaces another, far less has to be written, and the data of the records stays untouched.
#pragma once

#include <cstdint>
#include <string>
#include <unordered_map>
#include <vector>

namespace Lantern
{

/// Each distinct handle once. Not thread-safe, but for the const calls.
class FHandleStore
{
public:
	static constexpr uint32_t Null = 0; ///< a handle of zeros: a record without shaders

	/// HandleSize: bytes.
	void Initialise(uint32_t InHandleSize);
	/// Handles: GroupCount of them, HandleSize bytes each, in the order of the pipeline's groups. From now on
	/// GetSlotsOfGroups() is of these. Numbers given before stay.
	void SetPipeline(const uint8_t* Handles, uint32_t GroupCount);
	/// The number of each group's handle.
	const uint32_t* GetSlotsOfGroups() const { return SlotsOfGroups.data(); }
	uint32_t GetGroupCount() const { return static_cast<uint32_t>(SlotsOfGroups.size()); }
	/// All handles, HandleSize bytes each, by number.
	const uint8_t* GetHandles() const { return Bytes.data(); }
	uint32_t GetHandleSize() const { return HandleSize; }
	uint32_t GetCount() const { return static_cast<uint32_t>(Bytes.size() / HandleSize); }
	uint64_t GetSizeBytes() const { return Bytes.size(); }
	/// Says that most handles may be of pipelines long gone: find out which are used, and call Prune.
	bool IsCrowded() const { return GetCount() > MostBeforePruning; }
	/// Drops all but the Used handles (by number) and those of the pipeline. Returns the new number of each old one.
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
