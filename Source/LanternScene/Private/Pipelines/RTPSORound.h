// A round of compiles: the units to be compiled before the next link, and until when it waits for them.
#pragma once

#include <chrono>
#include <memory>
#include <vector>

#include "Pipelines/RTPSOUnitSet.h"

namespace Lantern
{

/// Knows no clock: the caller says what time it is.
/// Threads: the caller holds the lock of the RTPSO compiler. What GetShared returns is for any thread.
class FCompileRound
{
public:
	using FTime = std::chrono::steady_clock::time_point;

	/// Queues Units in this order. End: the deadline of the round that this begins; a round that is open keeps its own.
	void Add(const std::vector<FUnitStateRef>& Units, FTime End);
	bool IsOpen() const { return bOpen; }
	bool HasUnit() const { return Next != Queue.size(); }
	/// The next unit of the queue, which counts as running until EndUnit.
	FUnitStateRef TakeUnit();
	void EndUnit(FUnitState& Unit);
	bool IsAnyRunning() const { return Running > 0; } ///< also units that have outlived their round
	/// Everything is compiled, or the deadline has passed. A round without a deadline ignores Now.
	bool IsOver(FTime Now, bool bDeadline) const { return bOpen && ((!HasUnit() && Running == 0) || (bDeadline && Now >= End)); }
	/// Units that nobody has taken become idle and wait for another round. Shaders in common go to Trash.
	void Close(FTrash& Trash);
	/// Nothing more is taken from the queue: the device is lost.
	void Abandon() { Next = Queue.size(); }
	/// Shaders that the units of the open round have in common.
	const std::shared_ptr<FSharedShaders>& GetShared() const { return Shared; }

private:
	bool bOpen = false;
	FTime End;
	std::vector<FUnitStateRef> Queue; ///< those before Next have been taken
	size_t Next = 0;
	uint32_t Running = 0;
	std::shared_ptr<FSharedShaders> Shared;
};

} // namespace Lantern
