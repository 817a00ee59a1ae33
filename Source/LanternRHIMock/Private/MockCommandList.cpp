// FMockCommandList: recording, copies, raster and queries.
#include "MockCommandList.h"

#include <algorithm>
#include <cassert>
#include <cstring>

namespace Lantern
{
namespace
{

FMockBuffer* AsMock(IRTBuffer* Object) { return static_cast<FMockBuffer*>(Object); }
FMockTexture* AsMock(IRTTexture* Object) { return static_cast<FMockTexture*>(Object); }
FMockQueryPool* AsMock(IRTQueryPool* Object) { return static_cast<FMockQueryPool*>(Object); }

/// Simulated duration of one command.
constexpr uint64_t CommandNs = 1000;

} // namespace

FMockCommandList::FMockCommandList(std::shared_ptr<FMockState> InState, const char* InName, uint64_t InNative, ERTQueue InQueue)
    : TMockObject(std::move(InState), "CommandList", InName),
      Native(InNative),
      Queue(InQueue)
{
	// An imported command buffer is recording already.
	if (Native)
	{
		Stage = EStage::Recording;
		Recording = ++State->LastRecording;
	}
}

void FMockCommandList::Log(ERTMockCall Kind, const std::string& Object, const FRTMockNumbers& Numbers, bool bWithPush)
{
	if (!State->bRecordCalls)
	{
		(void)State->Log(Kind, Object); // the call may be the one that loses the device
		return;
	}
	FRTMockCall Call;
	Call.Kind = Kind;
	Call.Name = Object;
	Call.List = Name;
	Call.Recording = Recording;
	Call.Numbers = Numbers;
	if (bWithPush) { Call.Bytes = Push; }
	(void)State->Log(std::move(Call)); // a lost device is seen at End() or Submit()
}

void FMockCommandList::Keep(IRTRefCounted* Object) { Kept.emplace_back(Object); }

const std::string& FMockCommandList::GetPipelineName() const
{
	assert(Pipeline && "no pipeline set");
	return Pipeline->Name;
}

void FMockCommandList::CountBytes(uint64_t FRTMockTraffic::*Of, uint64_t Bytes)
{
	std::lock_guard Lock(State->Mutex);
	State->Traffic.*Of += Bytes;
}

void FMockCommandList::Execute()
{
	for (const std::function<void()>& Command : Commands)
	{
		State->ClockNs += CommandNs;
		Command();
	}
	Commands.clear();
	Kept.clear();
	Stage = EStage::Idle;
}

FRTStatus FMockCommandList::Begin()
{
	assert(!IsImported() && (Stage == EStage::Idle || Stage == EStage::Ended) && "recording, or still in flight");
	Commands.clear();
	Kept.clear();
	Push.clear();
	Pipeline = nullptr;
	Failed = {};
	Recording = ++State->LastRecording;
	FRTMockCall Call;
	Call.Kind = ERTMockCall::Begin;
	Call.Name = Call.List = Name;
	Call.Recording = Recording;
	FRTStatus Status = State->Log(std::move(Call));
	if (Status) { Stage = EStage::Recording; }
	return Status;
}

FRTStatus FMockCommandList::End()
{
	assert(!IsImported() && Stage == EStage::Recording && !bInPass);
	Stage = EStage::Ended;
	FRTMockCall Call;
	Call.Kind = ERTMockCall::End;
	Call.Name = Call.List = Name;
	Call.Recording = Recording;
	FRTStatus Status = State->Log(std::move(Call));
	return Status ? Failed : Status;
}

void FMockCommandList::Barriers(const FRTBarrier* Items, uint32_t Count)
{
	for (uint32_t i = 0; i < Count; ++i)
	{
		const FRTBarrier& Item = Items[i];
		assert(!(Item.Buffer && Item.Texture));
		std::string Object;
		if (Item.Buffer) { Object = AsMock(Item.Buffer)->Name; }
		if (Item.Texture) { Object = AsMock(Item.Texture)->Name; }
		Log(ERTMockCall::Barrier, Object, {static_cast<uint64_t>(Item.Before), static_cast<uint64_t>(Item.After)});
		if (Item.Buffer) { Keep(Item.Buffer); }
		if (Item.Texture) { Keep(Item.Texture); }
	}
}

void FMockCommandList::CopyBuffer(IRTBuffer* Dest, uint64_t DestOffset, IRTBuffer* Source, uint64_t SourceOffset, uint64_t Size)
{
	FMockBuffer* To = AsMock(Dest);
	FMockBuffer* From = AsMock(Source);
	assert(IsInside(DestOffset, Size, To->Desc.Size) && IsInside(SourceOffset, Size, From->Desc.Size));
	Log(ERTMockCall::CopyBuffer, To->Name, {DestOffset, SourceOffset, Size});
	Keep(Dest);
	Keep(Source);
	Then([=, this] {
		std::memmove(To->Bytes + DestOffset, From->Bytes + SourceOffset, Size);
		CountBytes(&FRTMockTraffic::Buffer, Size);
	});
}

void FMockCommandList::CopyBufferRegions(IRTBuffer* Dest, IRTBuffer* Source, const FRTBufferRegion* Regions, uint32_t Count)
{
	for (uint32_t Index = 0; Index < Count; ++Index)
	{
		CopyBuffer(Dest, Regions[Index].DestOffset, Source, Regions[Index].SourceOffset, Regions[Index].Size);
	}
}

void FMockCommandList::CopyBufferToTexture(IRTTexture* Dest, uint32_t Mip, uint32_t Layer, IRTBuffer* Source, uint64_t SourceOffset)
{
	FMockTexture* To = AsMock(Dest);
	FMockBuffer* From = AsMock(Source);
	Log(ERTMockCall::CopyBufferToTexture, To->Name, {Mip, Layer, SourceOffset});
	Keep(Dest);
	Keep(Source);
	Then([=, this] {
		std::vector<uint8_t>& Texels = To->GetTexels(Mip, Layer);
		assert(IsInside(SourceOffset, Texels.size(), From->Desc.Size));
		std::memcpy(Texels.data(), From->Bytes + SourceOffset, Texels.size());
		CountBytes(&FRTMockTraffic::Buffer, Texels.size());
	});
}

void FMockCommandList::CopyTextureToBuffer(IRTBuffer* Dest, uint64_t DestOffset, IRTTexture* Source, uint32_t Mip, uint32_t Layer)
{
	FMockBuffer* To = AsMock(Dest);
	FMockTexture* From = AsMock(Source);
	Log(ERTMockCall::CopyTextureToBuffer, From->Name, {Mip, Layer, DestOffset});
	Keep(Dest);
	Keep(Source);
	Then([=, this] {
		const std::vector<uint8_t>& Texels = From->GetTexels(Mip, Layer);
		assert(IsInside(DestOffset, Texels.size(), To->Desc.Size));
		std::memcpy(To->Bytes + DestOffset, Texels.data(), Texels.size());
		CountBytes(&FRTMockTraffic::Buffer, Texels.size());
	});
}

void FMockCommandList::FillBuffer(IRTBuffer* Dest, uint64_t Offset, uint64_t Size, uint32_t Value)
{
	FMockBuffer* To = AsMock(Dest);
	assert(Offset % 4 == 0 && Size % 4 == 0 && IsInside(Offset, Size, To->Desc.Size));
	Log(ERTMockCall::FillBuffer, To->Name, {Offset, Size, Value});
	Keep(Dest);
	Then([=] {
		for (uint64_t At = Offset; At < Offset + Size; At += 4) { std::memcpy(To->Bytes + At, &Value, 4); }
	});
}

void FMockCommandList::ClearTexture(IRTTexture* Dest, const float Value[4])
{
	FMockTexture* To = AsMock(Dest);
	Log(ERTMockCall::ClearTexture, To->Name);
	Keep(Dest);
	const std::array<float, 4> Colour = {Value[0], Value[1], Value[2], Value[3]};
	Then([=] { To->Clear(Colour.data()); });
}

void FMockCommandList::GenerateMips(IRTTexture* Texture)
{
	FMockTexture* To = AsMock(Texture);
	Log(ERTMockCall::GenerateMips, To->Name);
	Keep(Texture);
	Then([=] { To->GenerateMips(); });
}

void FMockCommandList::SetPipeline(IRTPipeline* InPipeline)
{
	Pipeline = static_cast<FMockPipeline*>(InPipeline);
	Push.clear();
	if (Pipeline->bLibrary) { State->AddError(Name + ": SetPipeline of the library " + Pipeline->Name); }
	Log(ERTMockCall::SetPipeline, GetPipelineName());
	Keep(InPipeline);
}

void FMockCommandList::PushConstants(const void* Data, uint32_t Size)
{
	assert(Pipeline && Size % 4 == 0 && Size <= State->Desc.MaxPushConstantBytes);
	const auto* Bytes = static_cast<const uint8_t*>(Data);
	Push.assign(Bytes, Bytes + Size);
	Log(ERTMockCall::PushConstants, GetPipelineName(), {Size}, true);
}

void FMockCommandList::Dispatch(uint32_t GroupsX, uint32_t GroupsY, uint32_t GroupsZ)
{
	assert(!bInPass && Pipeline && Pipeline->Kind == EMockPipeline::Compute);
	Log(ERTMockCall::Dispatch, GetPipelineName(), {GroupsX, GroupsY, GroupsZ}, true);
	Then([] {});
}

void FMockCommandList::DispatchIndirect(IRTBuffer* Arguments, uint64_t Offset)
{
	assert(!bInPass && Pipeline && Pipeline->Kind == EMockPipeline::Compute);
	assert(Offset % 4 == 0 && IsInside(Offset, 12, AsMock(Arguments)->Desc.Size));
	Log(ERTMockCall::DispatchIndirect, GetPipelineName(), {Offset}, true);
	Keep(Arguments);
	Then([] {});
}

void FMockCommandList::BeginRasterPass(const FRTRasterPassDesc& Desc)
{
	assert(!bInPass && Queue == ERTQueue::Graphics);
	bInPass = true;
	std::string First = Desc.Depth ? AsMock(Desc.Depth)->Name : std::string();
	if (Desc.ColorCount) { First = AsMock(Desc.Colors[0].Texture)->Name; }
	Log(ERTMockCall::BeginRasterPass, First, {Desc.Width, Desc.Height, Desc.ColorCount, Desc.Depth ? 1u : 0u});
	for (uint32_t i = 0; i < Desc.ColorCount; ++i)
	{
		const FRTColorTarget& Target = Desc.Colors[i];
		Keep(Target.Texture);
		if (!Target.bClear) { continue; }
		const std::array<float, 4> Colour = {Target.Clear[0], Target.Clear[1], Target.Clear[2], Target.Clear[3]};
		Then([To = AsMock(Target.Texture), Colour] { To->Clear(Colour.data()); });
	}
	if (!Desc.Depth) { return; }
	Keep(Desc.Depth);
	if (Desc.bClearDepth)
	{
		Then([To = AsMock(Desc.Depth)] { To->Clear(std::array<float, 4>{}.data()); });
	}
}

void FMockCommandList::EndRasterPass()
{
	assert(bInPass);
	bInPass = false;
	Log(ERTMockCall::EndRasterPass, "");
}

void FMockCommandList::SetIndexBuffer(IRTBuffer* Buffer, uint64_t Offset, ERTIndexType IndexType)
{
	Log(ERTMockCall::SetIndexBuffer, AsMock(Buffer)->Name, {Offset, static_cast<uint64_t>(IndexType)});
	Keep(Buffer);
}

void FMockCommandList::Draw(uint32_t VertexCount, uint32_t InstanceCount)
{
	assert(bInPass);
	Log(ERTMockCall::Draw, GetPipelineName(), {VertexCount, InstanceCount}, true);
	Then([] {});
}

void FMockCommandList::DrawIndexed(uint32_t IndexCount, uint32_t InstanceCount, uint32_t FirstIndex, int32_t VertexOffset)
{
	assert(bInPass);
	Log(ERTMockCall::DrawIndexed, GetPipelineName(),
	    {IndexCount, InstanceCount, FirstIndex, static_cast<uint64_t>(static_cast<int64_t>(VertexOffset))}, true);
	Then([] {});
}

void FMockCommandList::KeepAlive(IRTRefCounted* Object)
{
	const auto* Known = dynamic_cast<FMockObject*>(Object);
	Log(ERTMockCall::KeepAlive, Known ? Known->Name : std::string());
	Keep(Object);
}

void FMockCommandList::WriteTimestamp(IRTQueryPool* Pool, uint32_t Index)
{
	FMockQueryPool* Mine = AsMock(Pool);
	assert(Index < Mine->GetCount());
	Log(ERTMockCall::WriteTimestamp, Mine->Name, {Index});
	Keep(Pool);
	Then([=, this] {
		std::lock_guard Lock(State->Mutex);
		Mine->Values[Index] = State->ClockNs;
	});
}

void FMockCommandList::ResetQueries(IRTQueryPool* Pool, uint32_t First, uint32_t Count)
{
	FMockQueryPool* Mine = AsMock(Pool);
	assert(First + Count <= Mine->GetCount());
	Log(ERTMockCall::ResetQueries, Mine->Name, {First, Count});
	Keep(Pool);
	Then([=, this] {
		std::lock_guard Lock(State->Mutex);
		std::fill_n(Mine->Values.begin() + First, Count, 0);
	});
}

void FMockCommandList::BeginMarker(const char* MarkerName) { Log(ERTMockCall::BeginMarker, MarkerName); }
void FMockCommandList::EndMarker() { Log(ERTMockCall::EndMarker, ""); }

} // namespace Lantern
