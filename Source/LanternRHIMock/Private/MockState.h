// What device and objects of the mock share. Objects hold it by shared_ptr, so that an object released after its device (a leak,
// which a test reports) does no harm.
#pragma once

#include "LanternRHICommon/Arithmetic.h"
#include "LanternRHICommon/FenceQueue.h"
#include "LanternRHICommon/IndexAllocator.h"
#include "LanternRHIMock/MockDevice.h"

#include <atomic>
#include <condition_variable>
#include <deque>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <set>
#include <unordered_map>

namespace Lantern
{

class FMockBuffer;
class FMockGeometry;
class FMockCommandList;

enum class EMockMemory : uint8_t
{
	None,
	Geometry,
	Scene,
	ShaderTable,
	Texture,
	Buffer,
	Scratch
};

/// The part of an object that does not depend on its interface; TMockObject has the rest.
class FMockObject
{
public:
	FMockObject(std::shared_ptr<FMockState> InState, const char* InType, const char* InName)
	    : State(std::move(InState)),
	      Type(InType),
	      Name(InName ? InName : "")
	{}
	virtual ~FMockObject() = default;
	FMockObject(const FMockObject&) = delete;
	FMockObject& operator=(const FMockObject&) = delete;

	std::shared_ptr<FMockState> State;
	const char* Type;
	std::string Name;
	EMockMemory Memory = EMockMemory::None;
	uint64_t MemoryBytes = 0;
};

struct FMockSubmission
{
	FRTFence Fence = 0;
	std::vector<TRTRef<FMockCommandList>> Lists;
};

struct FMockState
{
	mutable std::mutex Mutex; ///< of everything below, except where noted
	std::mutex ExecuteMutex;  ///< submissions execute one at a time, in order
	FRTMockDesc Desc;
	FRTCapabilities Capabilities;

	std::vector<FRTMockCall> Calls;
	std::atomic<bool> bRecordCalls = true;
	std::atomic<uint64_t> LastRecording = 0;
	std::vector<std::string> Errors;
	std::set<FMockObject*> Live;
	std::map<uint64_t, FMockBuffer*> Buffers;                ///< by device address
	std::unordered_map<uint64_t, FMockGeometry*> Geometries; ///< by device address
	/// Addresses are never used twice. The oldest are forgotten, so that streaming for hours stays bounded.
	std::unordered_map<uint64_t, std::string> DeadGeometries;
	std::deque<uint64_t> DeadOrder;
	std::map<uint64_t, std::string> Pipelines; ///< live, by the id in their handles
	FIndexAllocator Sampled, Storage, Samplers, Scenes;
	uint64_t NextAddress = 0x100000;
	uint64_t NextPipeline = 1;
	FRTMemoryStats Memory;

	TFenceQueue<FMockSubmission> Pending;
	TFenceQueue<FMockObject*> Retired;
	FRTFence LastSubmitted = 0, Completed = 0;
	uint64_t ClockNs = 1000;          ///< guarded by ExecuteMutex
	uint64_t FirstUseNs = 0;          ///< guarded by ExecuteMutex
	std::set<uint64_t> UsedPipelines; ///< by id; guarded by ExecuteMutex
	uint32_t BlockingWaits = 0;
	FRTMockTraffic Traffic;
	bool bManual = false;

	uint32_t FailIn = 0, FailEvery = 0, SinceFail = 0;
	std::vector<std::pair<std::string, uint32_t>> Slow;
	std::vector<std::string> Held, Failing, Starved;
	std::condition_variable HoldEnded;
	uint32_t CompilesInDriver = 0; ///< slow and held ones
	std::optional<ERTMockCall> LoseAt;
	bool bLost = false;

	/// What stands for ERTNative::Device.
	uint64_t GetNativeDevice() const { return reinterpret_cast<uintptr_t>(this); }
	/// Records the call, then returns DeviceLost if the device is lost by now.
	FRTStatus Log(FRTMockCall Call);
	FRTStatus Log(ERTMockCall Kind, const std::string& Name, const FRTMockNumbers& Numbers = {});
	/// Puts the calls of these recordings behind all others, in this order.
	void OrderCalls(const std::vector<uint64_t>& Recordings);
	void AddError(std::string Message);
	void AddErrorLocked(std::string Message);
	void AddDeadGeometry(uint64_t Address, const std::string& Name);
	/// Returns "unbuilt Name", "destroyed Name" or "no geometry". Mutex must be held.
	std::string DescribeGeometry(uint64_t Address) const;
	/// Checks injected failures, then the budget. bCount is false for a part of an allocation that has been counted.
	FRTStatus Allocate(EMockMemory Kind, uint64_t Bytes, const char* Name, bool bCount = true);
	uint64_t TakeAddress(uint64_t Bytes);
	void Add(FMockObject* Object);
	/// Takes an object without references. Destroys it once all that was submitted so far has finished.
	void Retire(FMockObject* Object);
	void Collect();
	void Complete(FRTFence UpTo);
	/// Gives back the memory of an object that was destroyed or never finished.
	void FreeMemory(EMockMemory Kind, uint64_t Bytes);

private:
	uint64_t& Count(EMockMemory Kind);
};

} // namespace Lantern
