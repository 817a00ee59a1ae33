// What the GPU counts and the CPU reads some frames later, without a wait.
#pragma once

#include "LanternRHI/RTInterfaces.h"

namespace Lantern
{

/// Readback buffers of the frames in flight. A frame's values are handed out exactly FramesInFlight frames later, when the
/// renderer has waited for that frame anyway. What arrives when does not depend on the speed of the machine, so runs repeat.
/// T: what the CPU notes beside the buffer, to know what its values mean. Render thread.
template <class T>
class TReadbackRing
{
public:
	static constexpr uint32_t FramesInFlight = 2; ///< FRenderer::MaxInFlight

	struct FEntry
	{
		TRTRef<IRTBuffer> Buffer;
		T Notes{};
		bool bWritten = false; ///< the GPU has written Buffer, or will have when its frame is done
	};

	explicit TReadbackRing(IRTDevice& InDevice, const char* InName, ERTBufferUsage InUsage) : Device(InDevice), Name(InName), Usage(InUsage)
	{}

	/// Starts a frame. FlightIndex, below FramesInFlight, is that of the frame FramesInFlight before, which has ended on the GPU.
	/// Calls Take(const FEntry&) if that frame left values.
	template <class TTake>
	void BeginFrame(uint32_t FlightIndex, TTake&& Take)
	{
		Current = FlightIndex % FramesInFlight;
		TakeEntry(Entries[Current], Take);
	}

	/// Takes what is left, oldest first, after all frames have ended on the GPU.
	template <class TTake>
	void TakeAll(TTake&& Take)
	{
		for (uint32_t Step = 1; Step <= FramesInFlight; ++Step) { TakeEntry(Entries[(Current + Step) % FramesInFlight], Take); }
	}

	/// Returns this frame's entry with a buffer of at least Bytes. Null, and an error in Status: no memory. The entry counts as
	/// written unless EndFrame says otherwise.
	FEntry* Write(uint64_t Bytes, FRTStatus& Status)
	{
		FEntry& Entry = Entries[Current];
		if (!Entry.Buffer || Entry.Buffer->GetDesc().Size < Bytes)
		{
			Status = Device.CreateBuffer({Bytes, Usage, ERTMemory::Readback, Name}, Entry.Buffer.ReleaseAndGetAddress());
			if (!Status) { return nullptr; }
		}
		Entry.bWritten = true;
		return &Entry;
	}

	/// Returns this frame's entry; null: nothing was written.
	FEntry* GetCurrent() { return Entries[Current].bWritten ? &Entries[Current] : nullptr; }

	/// bSubmitted: false if the frame never runs.
	void EndFrame(bool bSubmitted) { Entries[Current].bWritten &= bSubmitted; }

private:
	template <class TTake>
	static void TakeEntry(FEntry& Entry, TTake&& Take)
	{
		if (!Entry.bWritten) { return; }
		Entry.bWritten = false;
		Take(static_cast<const FEntry&>(Entry));
	}

	IRTDevice& Device;
	const char* Name;
	ERTBufferUsage Usage;
	FEntry Entries[FramesInFlight];
	uint32_t Current = 0;
};

} // namespace Lantern
