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
	static constexpr uint32_t FramesInFlight = 2; ///< as FRenderer has them

	struct FSlot
	{
		TRTRef<IRTBuffer> Buffer;
		T Notes{};
		bool bWritten = false; ///< the GPU has written Buffer, or will have when its frame is done
	};

	explicit TReadbackRing(IRTDevice& InDevice, const char* InName, ERTBufferUsage InUsage) : Device(InDevice), Name(InName), Usage(InUsage)
	{}

	/// Starts the frame of one of the renderer's FramesInFlight slots, after the frame that had the slot before has ended on the
	/// GPU. Calls Take(const FSlot&) if that one left values.
	template <class TTake>
	void BeginFrame(uint32_t Slot, TTake&& Take)
	{
		Current = Slot % FramesInFlight;
		TakeSlot(Slots[Current], Take);
	}

	/// Takes what is left, oldest first, after all frames have ended on the GPU.
	template <class TTake>
	void TakeAll(TTake&& Take)
	{
		for (uint32_t Step = 1; Step <= FramesInFlight; ++Step) { TakeSlot(Slots[(Current + Step) % FramesInFlight], Take); }
	}

	/// Returns this frame's slot with a buffer of at least Bytes. Null, and an error in Status: no memory. The slot counts as
	/// written unless EndFrame says otherwise.
	FSlot* Write(uint64_t Bytes, FRTStatus& Status)
	{
		FSlot& Slot = Slots[Current];
		if (!Slot.Buffer || Slot.Buffer->GetDesc().Size < Bytes)
		{
			Status = Device.CreateBuffer({Bytes, Usage, ERTMemory::Readback, Name}, Slot.Buffer.ReleaseAndGetAddress());
			if (!Status) { return nullptr; }
		}
		Slot.bWritten = true;
		return &Slot;
	}

	/// Returns this frame's slot; null: nothing was written.
	FSlot* GetCurrent() { return Slots[Current].bWritten ? &Slots[Current] : nullptr; }

	/// bSubmitted: false if the frame never runs.
	void EndFrame(bool bSubmitted) { Slots[Current].bWritten &= bSubmitted; }

private:
	template <class TTake>
	static void TakeSlot(FSlot& Slot, TTake&& Take)
	{
		if (!Slot.bWritten) { return; }
		Slot.bWritten = false;
		Take(static_cast<const FSlot&>(Slot));
	}

	IRTDevice& Device;
	const char* Name;
	ERTBufferUsage Usage;
	FSlot Slots[FramesInFlight];
	uint32_t Current = 0;
};

} // namespace Lantern
