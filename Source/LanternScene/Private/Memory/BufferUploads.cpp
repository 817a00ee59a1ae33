// FBufferUploads: the ring, who fills it, and the copies out of it.
#include "LanternScene/Memory/BufferUploads.h"

#include <algorithm>
#include <cstring>
#include <iterator>
#include <utility>
#include <variant>

#include "LanternScene/Memory/Upload.h"

namespace Lantern
{

namespace
{
/// Pieces: small enough for a thread to give way, large enough for a copy to be worth a command.
constexpr uint64_t MostChunkBytes = 1 << 20;
constexpr uint64_t LeastChunkBytes = 64 << 10;
constexpr size_t MostChunksPerFrame = 512;
constexpr uint64_t RingAlignment = 16;
constexpr uint64_t FirstRingBytes = 1 << 20;
constexpr uint64_t RingGrowth = 4;

uint64_t Align(uint64_t Value) { return (Value + RingAlignment - 1) & ~(RingAlignment - 1); }
} // namespace

FBufferUploads::FBufferUploads(IRTDevice& InDevice) : Device(InDevice), LargestRing(GetMostStagingBytes()) {}

FBufferUploads::~FBufferUploads()
{
	{
		std::lock_guard Lock(Mutex);
		bStop = bWake = true;
	}
	Wake.notify_one();
	if (Stager.joinable()) { Stager.join(); }
}

// ---------------------------------------------------------------------------------------------------- any thread

FRTStatus FBufferUploads::SetRing(uint64_t Size)
{
	TRTRef<IRTBuffer> New;
	const FRTBufferDesc Desc{Size, ERTBufferUsage::CopySource, ERTMemory::Upload, "Staging"};
	if (FRTStatus Status = Device.CreateBuffer(Desc, New.ReleaseAndGetAddress()); !Status) { return Status; }
	std::lock_guard Lock(Mutex);
	Ring = std::move(New);
	RingSize = Size;
	Head = Used = 0;
	return FRTStatus::Success();
}

FRTStatus FBufferUploads::MakeRing()
{
	std::lock_guard Turn(StageMutex);
	if (bRing.load(std::memory_order_relaxed)) { return FRTStatus::Success(); }
	const FRTStatus Status = SetRing(std::min(FirstRingBytes, LargestRing));
	bRing.store(Status.IsOk(), std::memory_order_release);
	return Status;
}

bool FBufferUploads::Grow()
{
	// Chunks keep the ring that they lie in.
	return RingSize < LargestRing && SetRing(std::min(RingSize * RingGrowth, LargestRing)).IsOk();
}

FRTStatus FBufferUploads::Add(const FBufferUploadRef& Upload)
{
	if (!bRing.load(std::memory_order_acquire))
	{
		if (FRTStatus Status = MakeRing(); !Status) { return Status; }
	}
	{
		std::lock_guard Lock(Mutex);
		Waiting.push_back({Upload});
	}
	Stage();
	std::lock_guard Lock(Mutex);
	if (!Waiting.empty() && !Stager.joinable())
	{
		Stager = std::thread([this] { RunStager(); });
	}
	return FRTStatus::Success();
}

bool FBufferUploads::TakeRoom(uint64_t Wanted, FChunk& Out)
{
	const uint64_t ToEnd = RingSize - Head, Free = RingSize - Used;
	const auto Take = [&](uint64_t Offset, uint64_t Skipped, uint64_t Room) {
		Out.Size = std::min({Wanted, MostChunkBytes, Room});
		if (Out.Size < std::min(Wanted, LeastChunkBytes)) { return false; }
		Out.RingOffset = Offset;
		Out.RingBytes = Skipped + Align(Out.Size);
		Used += Out.RingBytes;
		Head = Offset + Align(Out.Size);
		return true;
	};
	// All sizes are multiples of the alignment: the last chunk may fill the ring to its end.
	if (Take(Head, 0, std::min(ToEnd, Free))) { return true; }
	return Free > ToEnd && Take(0, ToEnd, Free - ToEnd);
}

void FBufferUploads::Stage()
{
	const std::unique_lock Turn(StageMutex, std::try_to_lock);
	if (!Turn.owns_lock()) { return; }
	for (;;)
	{
		FChunk Chunk;
		if (!NextChunk(Chunk))
		{
			bool bFull = false;
			{
				std::lock_guard Lock(Mutex);
				bFull = !Waiting.empty() && !bStop;
			}
			if (!bFull || !Grow()) { return; }
			continue;
		}
		Chunk.Upload->Copy(Chunk.DestOffset, Chunk.Size, static_cast<uint8_t*>(Chunk.Ring->GetMapped()) + Chunk.RingOffset);
		if (Chunk.bLast) { Chunk.Upload->Copy = nullptr; }
		std::lock_guard Lock(Mutex);
		Staged.push_back(std::move(Chunk));
	}
}

bool FBufferUploads::NextChunk(FChunk& Out)
{
	std::lock_guard Lock(Mutex);
	if (Waiting.empty() || bStop) { return false; }
	FWaiting& First = Waiting.front();
	if (!TakeRoom(First.Upload->Bytes - First.Done, Out)) { return false; }
	Out.Ring = Ring;
	Out.Upload = First.Upload;
	Out.DestOffset = First.Done;
	First.Done += Out.Size;
	Out.bLast = First.Done == First.Upload->Bytes;
	if (Out.bLast) { Waiting.pop_front(); }
	return true;
}

void FBufferUploads::RunStager()
{
	for (;;)
	{
		{
			std::unique_lock Lock(Mutex);
			Wake.wait(Lock, [this] { return bWake; });
			bWake = false;
			if (bStop) { return; }
		}
		Stage();
	}
}

// ---------------------------------------------------------------------------------------------------- render thread

std::vector<FBufferUploads::FChunk> FBufferUploads::TakeStaged()
{
	const uint64_t Most = GetUploadBytesPerFrame();
	std::vector<FChunk> Out;
	uint64_t Bytes = 0;
	std::lock_guard Lock(Mutex);
	while (!Staged.empty() && Out.size() < MostChunksPerFrame && (Out.empty() || Bytes + Staged.front().Size <= Most))
	{
		Bytes += Staged.front().Size;
		Out.push_back(std::move(Staged.front()));
		Staged.pop_front();
	}
	return Out;
}

void FBufferUploads::PutBack(std::vector<FChunk> Chunks)
{
	std::lock_guard Lock(Mutex);
	Staged.insert(Staged.begin(), std::make_move_iterator(Chunks.begin()), std::make_move_iterator(Chunks.end()));
}

void FBufferUploads::ReleaseRoom(const std::vector<FChunk>& Chunks)
{
	bool bMore = false;
	{
		std::lock_guard Lock(Mutex);
		for (const FChunk& Chunk : Chunks) { Used -= Chunk.Ring == Ring ? Chunk.RingBytes : 0; }
		bWake |= !Waiting.empty();
		bMore = bWake;
	}
	if (bMore) { Wake.notify_one(); }
}

void FBufferUploads::CollectBatches()
{
	while (!Batches.empty())
	{
		FBatch& Oldest = Batches.front();
		if (Device.GetCompletedFence(GetFenceQueue(Oldest.Fence)) < Oldest.Fence) { return; }
		ReleaseRoom(Oldest.Chunks);
		if (Oldest.List)
		{
			for (FChunk& Chunk : Oldest.Chunks)
			{
				if (Chunk.bLast) { Copied.push_back(std::move(Chunk.Upload)); }
			}
			FreeLists.push_back(std::move(Oldest.List));
		}
		Batches.pop_front();
	}
}

void FBufferUploads::RecordCopies(IRTCommandList& List, const std::vector<FChunk>& Chunks)
{
	for (const FChunk& Chunk : Chunks)
	{
		List.CopyBuffer(Chunk.Upload->Buffer.Get(), Chunk.DestOffset, Chunk.Ring.Get(), Chunk.RingOffset, Chunk.Size);
	}
}

FRTStatus FBufferUploads::BeginTransferList(TRTRef<IRTCommandList>& Out)
{
	if (FreeLists.empty())
	{
		FRTStatus Status = Device.CreateCommandList("Uploads", Out.ReleaseAndGetAddress(), ERTQueue::Transfer);
		if (!Status) { return Status; }
	}
	else
	{
		Out = std::move(FreeLists.back());
		FreeLists.pop_back();
	}
	return Out->Begin();
}

FRTStatus FBufferUploads::Submit(std::vector<FChunk> Chunks)
{
	FBatch Batch;
	FRTStatus Status = BeginTransferList(Batch.List);
	if (Status) { RecordCopies(*Batch.List, Chunks); }
	Status = Status ? Batch.List->End() : Status;
	IRTCommandList* const Lists[] = {Batch.List.Get()};
	Status = Status ? Device.Submit(Lists, 1, &Batch.Fence) : Status;
	if (!Status)
	{
		PutBack(std::move(Chunks));
		return Status;
	}
	Batch.Chunks = std::move(Chunks);
	Batches.push_back(std::move(Batch));
	return Status;
}

FRTStatus FBufferUploads::Record(IRTCommandList& List, std::vector<FBufferUploadRef>& OutFilled)
{
	const bool bTransfer = Device.GetCapabilities().bTransferQueue && IsTransferQueueWanted();
	std::vector<FChunk> Chunks = TakeStaged();
	if (!Chunks.empty() && bTransfer)
	{
		if (FRTStatus Status = Submit(std::move(Chunks)); !Status) { return Status; }
		Chunks.clear();
	}
	CollectBatches();
	// Named one by one: a barrier of memory as such would move what others hold in the same state.
	std::vector<FRTBarrier> Before, Barriers;
	const IRTBuffer* Last = nullptr; // pieces of a buffer lie together
	for (const FChunk& Chunk : Chunks)
	{
		IRTBuffer* const Buffer = Chunk.Upload->Buffer.Get();
		if (std::exchange(Last, Buffer) == Buffer) { continue; }
		if (Chunk.DestOffset > 0) { Before.push_back({Buffer, nullptr, UploadedAccess, ERTAccess::CopyWrite}); }
		Barriers.push_back({Buffer, nullptr, ERTAccess::CopyWrite, UploadedAccess});
	}
	if (!Before.empty()) { List.Barriers(Before.data(), static_cast<uint32_t>(Before.size())); }
	RecordCopies(List, Chunks);
	for (const FBufferUploadRef& Upload : Copied)
	{
		Barriers.push_back({Upload->Buffer.Get(), nullptr, ERTAccess::CopyWrite, UploadedAccess});
		OutFilled.push_back(Upload);
	}
	for (const FChunk& Chunk : Chunks)
	{
		if (Chunk.bLast) { OutFilled.push_back(Chunk.Upload); }
	}
	if (!Barriers.empty()) { List.Barriers(Barriers.data(), static_cast<uint32_t>(Barriers.size())); }
	Acquired = std::exchange(Copied, {});
	Recorded = std::move(Chunks);
	return FRTStatus::Success();
}

void FBufferUploads::EndFrame(FRTFence Fence)
{
	std::vector<FBufferUploadRef> Lost = std::exchange(Acquired, {});
	std::vector<FChunk> Chunks = std::exchange(Recorded, {});
	if (Fence == 0)
	{
		Copied.insert(Copied.begin(), Lost.begin(), Lost.end());
		PutBack(std::move(Chunks));
	}
	else if (!Chunks.empty()) { Batches.push_back({Fence, std::move(Chunks), nullptr}); }
}

} // namespace Lantern
