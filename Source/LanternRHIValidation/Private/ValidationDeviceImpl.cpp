// FValidatedDevice: submission, fences and the end of the device.
#include "ValidationDeviceImpl.h"

#include <algorithm>

namespace Lantern
{

void FValidatedDevice::OnFinalRelease()
{
	std::vector<std::string> Leaked;
	{
		std::lock_guard Lock(State->Mutex);
		for (const auto& [Key, Object] : State->Live) { Leaked.push_back(Object->Label); }
	}
	std::sort(Leaked.begin(), Leaked.end());
	for (const std::string& Item : Leaked) { State->Report("device: " + Item + " is leaked, it was never released"); }
	delete this;
}

FRTStatus FValidatedDevice::Collect(
    IRTCommandList* const* Lists, uint32_t Count, bool bImported, std::vector<FValidatedCommandList*>& OutLists)
{
	const std::string Call = bImported ? "NotifyExternalSubmit" : "Submit";
	if (Count && !Lists) { return State->Fail(Call + ": Lists is null"); }
	for (uint32_t i = 0; i < Count; ++i)
	{
		const std::string What = Call + Print(": list %u", i);
		auto* List = State->Require<FValidatedCommandList>(Lists[i], What);
		if (!List) { return FRTStatus::Error(ERTResult::InvalidArgument, "%s is none", What.c_str()); }
		if (List->IsImported() != bImported)
		{
			return State->Fail(Call + ": " + List->Label + (bImported ? " is not imported" : " is imported"));
		}
		if (std::find(OutLists.begin(), OutLists.end(), List) != OutLists.end())
		{
			return State->Fail(Call + ": " + List->Label + " is there twice");
		}
		if (!OutLists.empty() && List->GetQueue() != OutLists.front()->GetQueue())
		{
			return State->Fail(Call + ": " + List->Label + " is for another queue than the lists before it");
		}
		if (List->IsSubmitted()) { return State->Fail(Call + ": " + List->Label + " has been submitted already"); }
		if (!bImported && !List->IsEnded()) { return State->Fail(Call + ": " + List->Label + " has not been ended"); }
		OutLists.push_back(List);
	}
	return FRTStatus::Success();
}

FRTStatus FValidatedDevice::CheckWaits(const char* Call, ERTQueue Queue, const FRTFence* Waits, uint32_t WaitCount)
{
	if (WaitCount && !Waits) { return State->Fail(Print("%s: Waits is null", Call)); }
	for (uint32_t i = 0; i < WaitCount; ++i)
	{
		const auto Other = static_cast<size_t>(GetFenceQueue(Waits[i]));
		if (Waits[i] != 0 && Other == static_cast<size_t>(Queue))
		{
			return State->Fail(Print("%s: wait %u is for its own queue", Call, i));
		}
		std::lock_guard Lock(State->Mutex);
		if (Other >= QueueCount || Waits[i] > State->LastFences[Other])
		{
			return State->Fail(Print("%s: wait %u is for a fence that no submission has returned", Call, i));
		}
	}
	return FRTStatus::Success();
}

FRTStatus FValidatedDevice::Submit(
    IRTCommandList* const* Lists, uint32_t Count, FRTFence* OutFence, const FRTFence* Waits, uint32_t WaitCount)
{
	std::lock_guard Order(State->SubmitMutex);
	std::vector<FValidatedCommandList*> Mine;
	FRTStatus Status = Collect(Lists, Count, false, Mine);
	const ERTQueue Queue = Mine.empty() ? ERTQueue::Graphics : Mine.front()->GetQueue();
	if (Status) { Status = CheckWaits("Submit", Queue, Waits, WaitCount); }
	if (!Status) { return Status; }
	FValidationTracker Tracker(*State, Queue, Waits, WaitCount);
	{
		std::lock_guard Lock(State->Mutex);
		for (const FValidatedCommandList* List : Mine) { List->Judge(Tracker); }
	}
	for (const std::string& Message : Tracker.GetMessages()) { State->Report(Message); }
	if (!Tracker.GetMessages().empty())
	{
		return FRTStatus::Error(ERTResult::InvalidArgument, "Submit refused: %s", Tracker.GetMessages().front().c_str());
	}
	std::vector<IRTCommandList*> Inners;
	Inners.reserve(Mine.size());
	for (const FValidatedCommandList* List : Mine) { Inners.push_back(List->Inner.Get()); }
	FRTFence Fence = 0;
	Status = State->Inner->Submit(Inners.data(), Count, &Fence, Waits, WaitCount);
	if (!Status) { return Status; }
	{
		std::lock_guard Lock(State->Mutex);
		Tracker.Commit(Fence);
		State->NoteFence(Fence);
	}
	for (FValidatedCommandList* List : Mine) { List->MarkSubmitted(Fence); }
	if (OutFence) { *OutFence = Fence; }
	return Status;
}

FRTStatus FValidatedDevice::NotifyExternalSubmit(
    IRTCommandList* const* Lists, uint32_t Count, FRTFence* OutFence, const FRTFence* Waits, uint32_t WaitCount)
{
	std::lock_guard Order(State->SubmitMutex);
	std::vector<FValidatedCommandList*> Mine;
	FRTStatus Status = Collect(Lists, Count, true, Mine);
	if (Status) { Status = CheckWaits("NotifyExternalSubmit", ERTQueue::Graphics, Waits, WaitCount); }
	if (!Status) { return Status; }
	// The engine has submitted already: faults can be reported, but nothing can be refused.
	FValidationTracker Tracker(*State, ERTQueue::Graphics, Waits, WaitCount);
	std::vector<IRTCommandList*> Inners;
	Inners.reserve(Mine.size());
	{
		std::lock_guard Lock(State->Mutex);
		for (const FValidatedCommandList* List : Mine)
		{
			List->Judge(Tracker);
			Inners.push_back(List->Inner.Get());
		}
	}
	for (const std::string& Message : Tracker.GetMessages()) { State->Report(Message); }
	FRTFence Fence = 0;
	Status = State->Inner->NotifyExternalSubmit(Inners.data(), Count, &Fence, Waits, WaitCount);
	{
		std::lock_guard Lock(State->Mutex);
		Tracker.Commit(Fence);
	}
	if (!Status && Fence == 0) { return Status; }
	// With a fence, the error is one of recording: the lists run all the same.
	{
		std::lock_guard Lock(State->Mutex);
		State->NoteFence(Fence);
	}
	for (FValidatedCommandList* List : Mine) { List->MarkSubmitted(Fence); }
	if (OutFence) { *OutFence = Fence; }
	return Status;
}

FRTStatus FValidatedDevice::WaitFor(FRTFence Fence, uint64_t TimeoutNs)
{
	FRTFence Last = 0;
	{
		std::lock_guard Lock(State->Mutex);
		const auto Queue = static_cast<size_t>(GetFenceQueue(Fence));
		Last = Queue < QueueCount ? State->LastFences[Queue] : 0;
	}
	if (Fence > Last)
	{
		return State->Fail(Print("WaitFor: no submission has returned fence %llu, the last one is %llu",
		    static_cast<unsigned long long>(Fence), static_cast<unsigned long long>(Last)));
	}
	return State->Inner->WaitFor(Fence, TimeoutNs);
}

FRTStatus WrapWithValidation(IRTDevice* Inner, FRTValidationCallback Callback, void* User, IRTDevice** Out)
{
	if (!Inner || !Out) { return FRTStatus::Error(ERTResult::InvalidArgument, "WrapWithValidation: a null argument"); }
	*Out = new FValidatedDevice(std::make_shared<FValidationState>(Inner, Callback, User));
	return FRTStatus::Success();
}

} // namespace Lantern
