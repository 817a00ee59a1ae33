// Resources that outlive a frame: the pool of transient resources and the ring of timestamp queries.
#include <algorithm>
#include <utility>

#include "FrameGraph/FrameGraphImpl.h"
#include "LanternCore/Config/ConsoleVariables.h"
#include "LanternCore/Tasks/TaskTrace.h"
#include "LanternCore/Text/Log.h"

namespace Lantern
{

namespace
{
// As many as histories live without use (FHistoryResources::KeepFrames): resolutions that alternate find their memory again.
TRTConsoleVariable<int32_t> CVarKeepFrames("r.RT.FrameGraph.KeepFrames", 8,
    "Memory of transient resources is freed after this many frames without use. 1: a frame keeps only what it used itself.", {1, 1000});
} // namespace

uint64_t FPoolKey::GetBytes() const
{
	uint64_t Bytes = Size;
	for (uint32_t Mip = 0; bTexture && Mip < MipCount; ++Mip)
	{
		Bytes += uint64_t(std::max(Width >> Mip, 1u)) * std::max(Height >> Mip, 1u) * BytesPerTexel(Format);
	}
	return Bytes;
}

FRTStatus FFrameGraphResources::FImpl::Create(const FPoolKey& Key, const std::string& Name, std::shared_ptr<FPooledResource>& Out)
{
	auto Made = std::make_shared<FPooledResource>();
	Made->Name = Name;
	Made->Key = Key;
	FRTStatus Status;
	if (Key.bTexture)
	{
		FRTTextureDesc Desc;
		Desc.Width = Key.Width;
		Desc.Height = Key.Height;
		Desc.MipCount = Key.MipCount;
		Desc.Format = Key.Format;
		Desc.Usage = static_cast<ERTTextureUsage>(Key.Usage);
		Desc.Name = Name.c_str();
		Status = Device.CreateTexture(Desc, Made->Texture.ReleaseAndGetAddress());
	}
	else
	{
		FRTBufferDesc Desc;
		Desc.Size = Key.Size;
		Desc.Usage = static_cast<ERTBufferUsage>(Key.Usage);
		Desc.Name = Name.c_str();
		Status = Device.CreateBuffer(Desc, Made->Buffer.ReleaseAndGetAddress());
	}
	if (Status)
	{
		Out = std::move(Made);
		Pool[Key].push_back(Out);
	}
	return Status;
}

FRTStatus FFrameGraphResources::FImpl::Acquire(
    const FPoolKey& Key, const std::string& Name, const void* Owner, std::shared_ptr<FPooledResource>& Out)
{
	Out.reset();
	for (const std::shared_ptr<FPooledResource>& Item : Pool[Key])
	{
		const bool bFree = !Item->bBusy && (!Item->Owner || Item->Owner == Owner);
		if (bFree && (!Out || Item->Name == Name)) { Out = Item; }
	}
	FRTStatus Status;
	if (!Out)
	{
		Status = Create(Key, Name, Out);
		const bool bMemory = Status.Code == ERTResult::OutOfDeviceMemory || Status.Code == ERTResult::OutOfDescriptors;
		// Idle resources of other sizes and settings may occupy the memory that is missing.
		if (bMemory && Trim(0) > 0)
		{
			Device.CollectGarbage();
			Status = Create(Key, Name, Out);
		}
	}
	if (Out)
	{
		Out->Owner = Owner;
		Out->bBusy = true;
	}
	return Status;
}

uint64_t FFrameGraphResources::FImpl::Trim(uint32_t FrameCount)
{
	uint64_t Freed = 0;
	const auto IsOld = [&](const std::shared_ptr<FPooledResource>& Item) {
		const bool bOld = !Item->Owner && (FrameCount == 0 || Item->LastFrame + FrameCount <= FrameCounter);
		Freed += bOld ? Item->Key.GetBytes() : 0;
		return bOld;
	};
	for (auto& [Key, Items] : Pool) { std::erase_if(Items, IsOld); }
	std::erase_if(Pool, [](const auto& Entry) { return Entry.second.empty(); });
	return Freed;
}

void FFrameGraphResources::FImpl::TrimByAge() { Trim(static_cast<uint32_t>(CVarKeepFrames.GetOnRenderThread())); }

FTimedFrame& FFrameGraphResources::FImpl::BeginTiming(const uint32_t (&PassCounts)[PassQueueCount])
{
	constexpr size_t MaxFrames = 8; // more than any engine keeps in flight
	PollTimings();
	auto It = std::find_if(Frames.begin(), Frames.end(), [](const auto& Frame) { return !Frame->bPending; });
	if (It == Frames.end() && Frames.size() < MaxFrames) { It = Frames.insert(It, std::make_unique<FTimedFrame>()); }
	if (It == Frames.end())
	{
		// Command lists that were recorded but never submitted would otherwise occupy the ring for ever.
		It = std::min_element(Frames.begin(), Frames.end(), [](const auto& A, const auto& B) { return A->Serial < B->Serial; });
	}
	FTimedFrame& Frame = **It;
	Frame.Serial = FrameCounter;
	Frame.RecordedNs = FTaskTrace::IsOn() ? FTaskTrace::GetNow() : 0;
	Frame.TraceFrame = FTaskTrace::GetFrame();
	Frame.Passes.clear();
	for (uint32_t Queue = 0; Queue < PassQueueCount; ++Queue)
	{
		FQueueQueries& Queries = Frame.Queues[Queue];
		Queries.PassCount = PassCounts[Queue];
		const uint32_t Needed = 2 * PassCounts[Queue];
		const bool bTooSmall = !Queries.Pool || Queries.Pool->GetCount() < Needed;
		if (!Device.GetCapabilities().bTimestamps || Needed == 0 || !bTooSmall) { continue; }
		uint32_t Count = 64;
		while (Count < Needed) { Count *= 2; }
		Queries.LastFirstNs = 0;
		const FRTStatus Status = Device.CreateQueryPool(ERTQuery::Timestamp, Count, Queries.Pool.ReleaseAndGetAddress());
		if (!Status)
		{
			Queries.Pool.Reset();
			LogOnce(ERTLogLevel::Warning, fmt::format("No GPU times of passes: {}", Status.Message));
		}
	}
	return Frame;
}

bool FFrameGraphResources::FImpl::ReadTimes(FTimedFrame& Frame, uint32_t Queue, uint64_t& OutFirst, uint64_t& OutLast)
{
	FQueueQueries& Queries = Frame.Queues[Queue];
	if (!Queries.Pool || Queries.PassCount == 0) { return true; }
	std::vector<uint64_t> Times(size_t(2) * Queries.PassCount);
	// The pool still holds its earlier times until the GPU reaches the reset.
	const bool bThere = Queries.Pool->GetResults(0, 2 * Queries.PassCount, Times.data()) && Times[0] != Queries.LastFirstNs;
	if (!bThere) { return false; }
	for (size_t I = 0; I < Frame.Passes.size(); ++I)
	{
		FPassTiming& Pass = Frame.Passes[I];
		if (static_cast<uint32_t>(Pass.Queue) != Queue) { continue; }
		if (Frame.Places[I] == NoPass)
		{
			Pass.GpuMs = 0.0;
			continue;
		}
		const uint64_t Begin = Times[2 * Frame.Places[I]], End = Times[2 * Frame.Places[I] + 1];
		Pass.GpuMs = End > Begin ? static_cast<double>(End - Begin) * 1e-6 : 0.0;
		Pass.BeginMs = Begin > Times[0] ? static_cast<double>(Begin - Times[0]) * 1e-6 : 0.0;
	}
	OutFirst = Times.front();
	OutLast = Times.back();
	return true;
}

/// Adds a frame's passes to the trace, each on the lane of its queue. FirstNs: by queue, 0 where nothing ran.
static void TraceFrame(const FTimedFrame& Frame, const uint64_t (&FirstNs)[PassQueueCount])
{
	if (Frame.RecordedNs == 0 || !FTaskTrace::IsOn()) { return; }
	constexpr const char* Lanes[PassQueueCount] = {"GPU, graphics queue", "GPU, compute queue"};
	for (const uint64_t First : FirstNs)
	{
		if (First != 0) { FTaskTrace::AlignDevice(First, Frame.RecordedNs); }
	}
	for (const FPassTiming& Pass : Frame.Passes)
	{
		const auto Queue = static_cast<uint32_t>(Pass.Queue);
		if (FirstNs[Queue] == 0 || Pass.BeginMs < 0.0) { continue; } // what ran in a group has no time of its own
		const uint64_t Begin = FirstNs[Queue] + static_cast<uint64_t>(Pass.BeginMs * 1e6);
		FTaskTrace::RecordOnDevice(Lanes[Queue], Pass.Name, Begin, Begin + static_cast<uint64_t>(Pass.GpuMs * 1e6), Frame.TraceFrame);
	}
}

void FFrameGraphResources::FImpl::PollTimings()
{
	std::vector<FTimedFrame*> Pending;
	for (const auto& Frame : Frames)
	{
		if (Frame->bPending) { Pending.push_back(Frame.get()); }
	}
	std::sort(Pending.begin(), Pending.end(), [](auto* A, auto* B) { return A->Serial < B->Serial; });
	for (FTimedFrame* Frame : Pending)
	{
		uint64_t First[PassQueueCount] = {}, Last[PassQueueCount] = {};
		bool bThere = true;
		for (uint32_t Queue = 0; Queue < PassQueueCount; ++Queue) { bThere &= ReadTimes(*Frame, Queue, First[Queue], Last[Queue]); }
		if (!bThere) { continue; }
		for (uint32_t Queue = 0; Queue < PassQueueCount; ++Queue)
		{
			if (First[Queue] != 0) { Frame->Queues[Queue].LastFirstNs = First[Queue]; }
		}
		constexpr size_t MostDone = 64; // where nobody takes them
		if (Done.size() < MostDone && Last[0] > First[0])
		{
			Done.push_back({Frame->Serial, static_cast<double>(Last[0] - First[0]) * 1e-6});
		}
		TraceFrame(*Frame, First);
		Newest = Frame->Passes;
		Frame->bPending = false;
	}
}

FFrameGraphResources::FFrameGraphResources(IRTDevice& Device) : Impl(std::make_unique<FImpl>(Device)) {}
FFrameGraphResources::~FFrameGraphResources() = default;

const std::vector<FPassTiming>& FFrameGraphResources::GetTimings()
{
	Impl->PollTimings();
	return Impl->Newest;
}

uint64_t FFrameGraphResources::GetFrame() const { return Impl->FrameCounter; }

std::vector<FFrameTiming> FFrameGraphResources::TakeFrameTimings() { return std::exchange(Impl->Done, {}); }

void FFrameGraphResources::Trim(uint32_t Frames) { Impl->Trim(Frames); }

uint64_t FFrameGraphResources::GetPooledBytes() const
{
	uint64_t Bytes = 0;
	for (const auto& [Key, Items] : Impl->Pool) { Bytes += Key.GetBytes() * Items.size(); }
	return Bytes;
}

void FFrameGraphResources::PoisonHistory(std::string NamePart) { Impl->Poison.push_back(std::move(NamePart)); }

} // namespace Lantern
