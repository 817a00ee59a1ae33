// FMockState: call log, memory budget, submissions and released objects.
#include "MockState.h"

#include "MockCommandList.h"

#include <algorithm>

namespace Lantern
{

FRTStatus FMockState::Log(FRTMockCall Call)
{
	std::lock_guard Lock(Mutex);
	if (LoseAt == Call.Kind)
	{
		bLost = true;
		LoseAt.reset();
	}
	if (bRecordCalls) { Calls.push_back(std::move(Call)); }
	return bLost ? FRTStatus::Error(ERTResult::DeviceLost, "the device was lost (mock)") : FRTStatus::Success();
}

FRTStatus FMockState::Log(ERTMockCall Kind, const std::string& Name, const FRTMockNumbers& Numbers)
{
	FRTMockCall Call;
	Call.Kind = Kind;
	if (bRecordCalls)
	{
		Call.Name = Name;
		Call.Numbers = Numbers;
	}
	return Log(std::move(Call));
}

void FMockState::OrderCalls(const std::vector<uint64_t>& Recordings)
{
	std::lock_guard Lock(Mutex);
	const auto GetPlace = [&](const FRTMockCall& Call) { return std::find(Recordings.begin(), Recordings.end(), Call.Recording); };
	const auto IsOther = [&](const FRTMockCall& Call) { return GetPlace(Call) == Recordings.end(); };
	const auto First = std::stable_partition(Calls.begin(), Calls.end(), IsOther);
	std::stable_sort(First, Calls.end(), [&](const FRTMockCall& A, const FRTMockCall& B) { return GetPlace(A) < GetPlace(B); });
}

void FMockState::AddError(std::string Message)
{
	std::lock_guard Lock(Mutex);
	AddErrorLocked(std::move(Message));
}

void FMockState::AddErrorLocked(std::string Message)
{
	constexpr size_t MaxErrors = 1000;
	if (Errors.size() < MaxErrors) { Errors.push_back(std::move(Message)); }
}

void FMockState::AddDeadGeometry(uint64_t Address, const std::string& Name)
{
	constexpr size_t MaxDead = 1 << 17;
	std::lock_guard Lock(Mutex);
	Geometries.erase(Address);
	DeadGeometries[Address] = Name;
	DeadOrder.push_back(Address);
	if (DeadOrder.size() > MaxDead)
	{
		DeadGeometries.erase(DeadOrder.front());
		DeadOrder.pop_front();
	}
}

uint64_t& FMockState::Count(EMockMemory Kind)
{
	switch (Kind)
	{
	case EMockMemory::Geometry: return Memory.Geometry;
	case EMockMemory::Scene: return Memory.Scene;
	case EMockMemory::ShaderTable: return Memory.ShaderTable;
	case EMockMemory::Texture: return Memory.Texture;
	case EMockMemory::Scratch: return Memory.Scratch;
	case EMockMemory::None:
	case EMockMemory::Buffer: break;
	}
	return Memory.Buffer;
}

FRTStatus FMockState::Allocate(EMockMemory Kind, uint64_t Bytes, const char* Name, bool bCount)
{
	std::lock_guard Lock(Mutex);
	bool bFail = bCount && FailIn > 0 && --FailIn == 0;
	if (bCount && FailEvery > 0 && ++SinceFail == FailEvery)
	{
		SinceFail = 0;
		bFail = true;
	}
	if (bFail || Bytes > Desc.DeviceMemoryBytes - Memory.Total)
	{
		return FRTStatus::Error(ERTResult::OutOfDeviceMemory, "%s: no device memory for %llu bytes (mock%s)", Name,
		    static_cast<unsigned long long>(Bytes), bFail ? ", injected" : "");
	}
	Count(Kind) += Bytes;
	Memory.Total += Bytes;
	Memory.Peak = std::max(Memory.Peak, Memory.Total);
	return FRTStatus::Success();
}

void FMockState::FreeMemory(EMockMemory Kind, uint64_t Bytes)
{
	std::lock_guard Lock(Mutex);
	Count(Kind) -= Bytes;
	Memory.Total -= Bytes;
}

uint64_t FMockState::TakeAddress(uint64_t Bytes)
{
	std::lock_guard Lock(Mutex);
	const uint64_t Address = NextAddress;
	// The gap makes one past the end of a buffer belong to nobody.
	NextAddress += AlignUp(Bytes, 256) + 256;
	return Address;
}

void FMockState::Add(FMockObject* Object)
{
	std::lock_guard Lock(Mutex);
	Live.insert(Object);
}

void FMockState::Retire(FMockObject* Object)
{
	{
		std::lock_guard Lock(Mutex);
		Retired.Push(LastSubmitted, Object);
	}
	Collect();
}

void FMockState::Collect()
{
	// Destroying one object may release others, which land in Retired: repeat until nothing is ready.
	for (;;)
	{
		FMockObject* Object = nullptr;
		{
			std::lock_guard Lock(Mutex);
			const std::optional<FMockObject*> Oldest = Retired.Pop(Completed);
			if (!Oldest) { return; }
			Object = *Oldest;
			Live.erase(Object);
			if (bRecordCalls)
			{
				FRTMockCall& Call = Calls.emplace_back();
				Call.Kind = ERTMockCall::Destroy;
				Call.Name = Object->Name;
			}
		}
		// The destructor may drop the last owner of this state.
		const std::shared_ptr<FMockState> Keep = Object->State;
		if (Object->Memory != EMockMemory::None) { FreeMemory(Object->Memory, Object->MemoryBytes); }
		delete Object;
	}
}

void FMockState::Complete(FRTFence UpTo)
{
	std::vector<FMockSubmission> Done;
	{
		std::lock_guard Execute(ExecuteMutex);
		{
			std::lock_guard Lock(Mutex);
			while (std::optional<FMockSubmission> Oldest = Pending.Pop(UpTo)) { Done.push_back(std::move(*Oldest)); }
		}
		for (FMockSubmission& Submission : Done)
		{
			for (TRTRef<FMockCommandList>& List : Submission.Lists) { List->Execute(); }
			std::lock_guard Lock(Mutex);
			Completed = std::max(Completed, Submission.Fence);
		}
	}
	Done.clear();
	Collect();
}

std::string FMockState::DescribeGeometry(uint64_t Address) const
{
	const auto Found = Geometries.find(Address);
	if (Found != Geometries.end()) { return "unbuilt " + Found->second->Name; }
	const auto Dead = DeadGeometries.find(Address);
	return Dead == DeadGeometries.end() ? "no geometry" : "destroyed " + Dead->second;
}

} // namespace Lantern
