// The shader table of a scene has a hit record for each section and ray type: record = section · ray types + ray type.
//
// A hit record is its handle and the section's FSectionData, 32 bytes. The stride is the tightest that the device allows:
// 64 bytes with handles of 32. Records hold nothing that all of them would repeat: buffers and textures are bindless or
// reached by address. FSceneConstants, one block a frame, is the global root table.
//
// Costs follow what changed. A frame without changes takes constant time and copies nothing. Records of changed sections are
// written and copied. Another pipeline has all handles written, but no data. Growing never waits.
#pragma once

#include <vector>

#include "LanternRHI/RTInterfaces.h"
#include "LanternScene/ShaderTable/ChangeJournal.h"
#include "SceneTypes.h"

namespace Lantern
{

class FRTPSO;
class FSectionTable;

/// Counters of the last Prepare and Record.
struct FShaderTableStats
{
	uint32_t RecordsWritten = 0; ///< hit records, handle and data
	uint32_t HandlesWritten = 0; ///< hit records, the handle alone
	uint64_t BytesCopied = 0;    ///< to the device
};

class FShaderTable
{
public:
	explicit FShaderTable(IRTDevice& InDevice) : Device(InDevice) {}

	/// Does everything but recording (pre-binding). Reads the changes of Sections since the last call: several FShaderTables can
	/// serve one table of sections, such as those of two renderers. Any thread, also beside the recording of earlier passes.
	/// Sections must not change meanwhile. After an error the next call does what is missing.
	FRTStatus Prepare(const FRTPSO& Pipeline, const FSectionTable& Sections);
	/// Records the copy of what Prepare staged, if anything. Runs on the thread that records List.
	FRTStatus Record(IRTCommandList& List);
	/// Calls Prepare, then Record.
	FRTStatus Sync(IRTCommandList& List, const FRTPSO& Pipeline, const FSectionTable& Sections);
	/// Makes the next Record copy everything again: what was recorded last was never submitted.
	void Invalidate();
	/// Null before the first Prepare, which makes the table. Later ones may make another: do not call this while one runs.
	IRTShaderTable* GetTable() const { return Table.Get(); }
	const FShaderTableStats& GetStats() const { return Stats; }

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
	FChangeCursor Seen = 0;                     // changes of BoundSections whose records are written
	uint32_t RayTypes = 0;
	uint32_t RecordsUsed = 0;     // hit records that were ever written
	std::vector<uint32_t> Groups; // by number of the hit program (FHitProgramIndex) and ray type
	uint64_t GroupsRevision = ~0ull;
	bool bRewrite = true;  // no record can be relied on
	bool bPending = false; // something waits for Record
	FShaderTableStats Stats;
};

} // namespace Lantern
