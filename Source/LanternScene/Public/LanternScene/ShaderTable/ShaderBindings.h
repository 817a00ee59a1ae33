// The shader table of a scene: a hit record for each section and ray type, record = section · ray types + ray type.
//
// A hit record is its handle and the section's FSectionData, 32 bytes, at the tightest stride that the device allows:
// 64 bytes with handles of 32. What every record would repeat is in none of them: all buffers and textures of the scene
// are bindless or reached by address, and FSceneConstants, one block a frame, is the global root table.
//
// Costs follow what changed: a frame in which nothing did takes constant time and copies nothing; changed sections have
// their records written and copied; another pipeline has all handles written, but no data. Growing never waits.
#pragma once

#include <vector>

#include "LanternRHI/RTInterfaces.h"
#include "SceneTypes.h"

namespace Lantern
{

class FRTPSO;
class FSectionTable;

/// Of the last Prepare and Record.
struct FShaderBindingStats
{
	uint32_t RecordsWritten = 0; ///< hit records, handle and data
	uint32_t HandlesWritten = 0; ///< hit records of which only the handle was written
	uint64_t BytesCopied = 0;    ///< to the device
};

class FShaderBindings
{
public:
	explicit FShaderBindings(IRTDevice& InDevice) : Device(InDevice) {}

	/// Pre-bind: everything but recording. Takes the sections' changes, so that one FShaderBindings alone serves a table of
	/// sections at a time. Any thread, also beside the recording of earlier passes; nobody may change Sections meanwhile.
	/// After an error the next call makes up for it.
	FRTStatus Prepare(const FRTPSO& Pipeline, FSectionTable& Sections);
	/// Records the copy of what Prepare staged, if anything. The thread that records List.
	FRTStatus Record(IRTCommandList& List);
	/// Both in turn.
	FRTStatus Sync(IRTCommandList& List, const FRTPSO& Pipeline, FSectionTable& Sections);
	/// What was recorded last was never submitted: the next Record copies everything again.
	void Invalidate();
	/// Null before the first Prepare, which makes it, and later ones may make another: not while one runs.
	IRTShaderTable* GetTable() const { return Table.Get(); }
	const FShaderBindingStats& GetStats() const { return Stats; }

private:
	FRTStatus Reserve(const FRTPSO& Pipeline, const FSectionTable& Sections);
	void SetGeneralRecords(const FRTPSO& Pipeline);
	void LookUpGroups(const FRTPSO& Pipeline, const FSectionTable& Sections);
	void WriteChanged(const FSectionTable& Sections, std::vector<uint32_t> Changed);
	void WriteAll(const FSectionTable& Sections);
	void WriteHandles(const FSectionTable& Sections);
	void WriteHandlesBehind(const FSectionTable& Sections);

	IRTDevice& Device;
	TRTRef<IRTShaderTable> Table;
	const IRTPipeline* BoundPipeline = nullptr; // identity only; the table keeps it
	uint64_t BoundSections = 0;                 // FSectionTable::GetIdentity
	uint32_t RayTypes = 0;
	uint32_t RecordsUsed = 0;     // hit records that ever were
	std::vector<uint32_t> Groups; // of each program slot and ray type
	uint64_t GroupsRevision = ~0ull;
	bool bRewrite = true;  // no record can be relied on
	bool bPending = false; // something waits for Record
	FShaderBindingStats Stats;
};

} // namespace Lantern
