#include "MockCommandList.h"

#include <algorithm>
#include <cassert>
#include <cstring>

namespace Lantern
{
namespace
{

FMockBuffer* AsMock(IRTBuffer* Object)
{
	return static_cast<FMockBuffer*>(Object);
}
FMockTexture* AsMock(IRTTexture* Object)
{
	return static_cast<FMockTexture*>(Object);
}
FMockShaderTable* AsMock(IRTShaderTable* Object)
{
	return static_cast<FMockShaderTable*>(Object);
}
FMockQueryPool* AsMock(IRTQueryPool* Object)
{
	return static_cast<FMockQueryPool*>(Object);
}

/// Simulated duration of one command.
constexpr uint64_t CommandNs = 1000;

} // namespace

FMockCommandList::FMockCommandList(std::shared_ptr<FMockState> InState, const char* InName, uint64_t InNative)
    : TMockObject(std::move(InState), "CommandList", InName),
      Native(InNative)
{
	// An imported command buffer is recording already.
	if (Native)
	{
		Stage = EStage::Recording;
	}
}

void FMockCommandList::Log(ERTMockCall Kind, const std::string& Object, std::array<uint64_t, 4> Numbers, bool bWithPush)
{
	FRTMockCall Call;
	Call.Kind = Kind;
	Call.Name = Object;
	Call.List = Name;
	Call.Numbers = Numbers;
	if (bWithPush)
	{
		Call.Bytes = Push;
	}
	(void)State->Log(std::move(Call)); // a lost device is seen at End() or Submit()
}

void FMockCommandList::Keep(IRTRefCounted* Object)
{
	Kept.emplace_back(Object);
}

const std::string& FMockCommandList::GetPipelineName() const
{
	assert(Pipeline && "no pipeline set");
	return Pipeline->Name;
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
	FRTMockCall Call;
	Call.Kind = ERTMockCall::Begin;
	Call.Name = Call.List = Name;
	FRTStatus Status = State->Log(std::move(Call));
	if (Status)
	{
		Stage = EStage::Recording;
	}
	return Status;
}

FRTStatus FMockCommandList::End()
{
	assert(!IsImported() && Stage == EStage::Recording && !bInPass);
	Stage = EStage::Ended;
	FRTMockCall Call;
	Call.Kind = ERTMockCall::End;
	Call.Name = Call.List = Name;
	return State->Log(std::move(Call));
}

void FMockCommandList::Barriers(const FRTBarrier* Items, uint32_t Count)
{
	for (uint32_t i = 0; i < Count; ++i)
	{
		const FRTBarrier& Item = Items[i];
		assert(!(Item.Buffer && Item.Texture));
		std::string Object;
		if (Item.Buffer)
		{
			Object = AsMock(Item.Buffer)->Name;
		}
		if (Item.Texture)
		{
			Object = AsMock(Item.Texture)->Name;
		}
		Log(ERTMockCall::Barrier, Object, {static_cast<uint64_t>(Item.Before), static_cast<uint64_t>(Item.After)});
		if (Item.Buffer)
		{
			Keep(Item.Buffer);
		}
		if (Item.Texture)
		{
			Keep(Item.Texture);
		}
	}
}

void FMockCommandList::CopyBuffer(IRTBuffer* Dest, uint64_t DestOffset, IRTBuffer* Source, uint64_t SourceOffset,
                                  uint64_t Size)
{
	FMockBuffer* To = AsMock(Dest);
	FMockBuffer* From = AsMock(Source);
	assert(DestOffset + Size <= To->Desc.Size && SourceOffset + Size <= From->Desc.Size);
	Log(ERTMockCall::CopyBuffer, To->Name, {DestOffset, SourceOffset, Size});
	Keep(Dest);
	Keep(Source);
	Then([=] { std::memmove(To->Bytes + DestOffset, From->Bytes + SourceOffset, Size); });
}

void FMockCommandList::CopyBufferToTexture(IRTTexture* Dest, uint32_t Mip, uint32_t Layer, IRTBuffer* Source,
                                           uint64_t SourceOffset)
{
	FMockTexture* To = AsMock(Dest);
	FMockBuffer* From = AsMock(Source);
	Log(ERTMockCall::CopyBufferToTexture, To->Name, {Mip, Layer, SourceOffset});
	Keep(Dest);
	Keep(Source);
	Then(
	    [=]
	    {
		    std::vector<uint8_t>& Texels = To->GetTexels(Mip, Layer);
		    assert(SourceOffset + Texels.size() <= From->Desc.Size);
		    std::memcpy(Texels.data(), From->Bytes + SourceOffset, Texels.size());
	    });
}

void FMockCommandList::CopyTextureToBuffer(IRTBuffer* Dest, uint64_t DestOffset, IRTTexture* Source, uint32_t Mip,
                                           uint32_t Layer)
{
	FMockBuffer* To = AsMock(Dest);
	FMockTexture* From = AsMock(Source);
	Log(ERTMockCall::CopyTextureToBuffer, From->Name, {Mip, Layer, DestOffset});
	Keep(Dest);
	Keep(Source);
	Then(
	    [=]
	    {
		    const std::vector<uint8_t>& Texels = From->GetTexels(Mip, Layer);
		    assert(DestOffset + Texels.size() <= To->Desc.Size);
		    std::memcpy(To->Bytes + DestOffset, Texels.data(), Texels.size());
	    });
}

void FMockCommandList::FillBuffer(IRTBuffer* Dest, uint64_t Offset, uint64_t Size, uint32_t Value)
{
	FMockBuffer* To = AsMock(Dest);
	assert(Offset % 4 == 0 && Size % 4 == 0 && Offset + Size <= To->Desc.Size);
	Log(ERTMockCall::FillBuffer, To->Name, {Offset, Size, Value});
	Keep(Dest);
	Then(
	    [=]
	    {
		    for (uint64_t At = Offset; At < Offset + Size; At += 4)
		    {
			    std::memcpy(To->Bytes + At, &Value, 4);
		    }
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

void FMockCommandList::TraceRays(IRTShaderTable* Table, uint32_t RayGen, uint32_t Width, uint32_t Height,
                                 uint32_t Depth)
{
	FMockShaderTable* Mine = AsMock(Table);
	assert(!bInPass && Pipeline && Pipeline->Kind == EMockPipeline::RayTracing && RayGen < Mine->Desc.RayGenCount);
	assert(Pipeline->GetGroupCount() == Mine->Pipeline->GetGroupCount());
	Log(ERTMockCall::TraceRays, GetPipelineName(), {RayGen, Width, Height, Depth}, true);
	Keep(Table);
	Then(
	    [=, this]
	    {
		    if (!Mine->IsUpdated())
		    {
			    State->AddError(Mine->Name + ": rays traced before any UpdateShaderTable");
		    }
	    });
}

void FMockCommandList::UpdateShaderTable(IRTShaderTable* Table)
{
	FMockShaderTable* Mine = AsMock(Table);
	std::vector<FMockShaderTable::FUpdate> Updates = Mine->TakeUpdates();
	uint64_t Bytes = 0;
	for (const FMockShaderTable::FUpdate& Update : Updates)
	{
		Bytes += Update.Bytes.size();
	}
	Log(ERTMockCall::UpdateShaderTable, Mine->Name, {Bytes, Updates.size()});
	Keep(Table);
	Then([Mine, Updates = std::move(Updates)] { Mine->Apply(Updates); });
}

void FMockCommandList::BeginRasterPass(const FRTRasterPassDesc& Desc)
{
	assert(!bInPass);
	bInPass = true;
	std::string First = Desc.Depth ? AsMock(Desc.Depth)->Name : std::string();
	if (Desc.ColorCount)
	{
		First = AsMock(Desc.Colors[0].Texture)->Name;
	}
	Log(ERTMockCall::BeginRasterPass, First, {Desc.Width, Desc.Height, Desc.ColorCount, Desc.Depth ? 1u : 0u});
	for (uint32_t i = 0; i < Desc.ColorCount; ++i)
	{
		const FRTColorTarget& Target = Desc.Colors[i];
		Keep(Target.Texture);
		if (!Target.bClear)
		{
			continue;
		}
		const std::array<float, 4> Colour = {Target.Clear[0], Target.Clear[1], Target.Clear[2], Target.Clear[3]};
		Then([To = AsMock(Target.Texture), Colour] { To->Clear(Colour.data()); });
	}
	if (!Desc.Depth)
	{
		return;
	}
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

void FMockCommandList::DrawIndexed(uint32_t IndexCount, uint32_t InstanceCount, uint32_t FirstIndex,
                                   int32_t VertexOffset)
{
	assert(bInPass);
	Log(ERTMockCall::DrawIndexed, GetPipelineName(),
	    {IndexCount, InstanceCount, FirstIndex, static_cast<uint64_t>(static_cast<int64_t>(VertexOffset))}, true);
	Then([] {});
}

void FMockCommandList::BuildGeometries(const FRTGeometryBuild* Builds, uint32_t Count)
{
	for (uint32_t i = 0; i < Count; ++i)
	{
		BuildGeometry(Builds[i]);
	}
}

void FMockCommandList::BuildGeometry(const FRTGeometryBuild& Build)
{
	auto* Geometry = static_cast<FMockGeometry*>(Build.Geometry);
	assert(Build.SectionCount == Geometry->SectionCount && (!Build.bUpdate || Geometry->bAllowUpdate));
	assert(Build.ScratchOffset % State->Desc.ScratchAlignment == 0);
	Log(ERTMockCall::BuildGeometry, Geometry->Name, {Build.SectionCount, Build.bUpdate ? 1u : 0u, Build.ScratchOffset});
	Keep(Geometry);
	Keep(Build.Scratch);
	std::vector<FRTGeometrySection> Sections(Build.Sections, Build.Sections + Build.SectionCount);
	for (const FRTGeometrySection& Section : Sections)
	{
		if (Section.Vertices)
		{
			Keep(Section.Vertices);
		}
		if (Section.Indices)
		{
			Keep(Section.Indices);
		}
	}
	Then(
	    [this, Geometry, Sections = std::move(Sections), bUpdate = Build.bUpdate]
	    {
		    std::lock_guard Lock(State->Mutex);
		    if (bUpdate && Geometry->Built.BuildCount == 0)
		    {
			    State->Errors.push_back(Geometry->Name + ": updated before any build");
		    }
		    ++(bUpdate ? Geometry->Built.UpdateCount : Geometry->Built.BuildCount);
		    Geometry->Built.Sections = Sections;
	    });
}

void FMockCommandList::WriteCompactedSize(IRTQueryPool* Queries, uint32_t Index, IRTGeometry* Geometry)
{
	auto* Source = static_cast<FMockGeometry*>(Geometry);
	FMockQueryPool* Mine = AsMock(Queries);
	assert(Mine->Kind == ERTQuery::CompactedSize && Index < Mine->GetCount());
	Keep(Queries);
	Keep(Geometry);
	Then(
	    [=, this]
	    {
		    std::lock_guard Lock(State->Mutex);
		    Mine->Values[Index] = AlignUp(Source->Sizes.StructureBytes * 6 / 10, 128);
	    });
}

void FMockCommandList::CompactGeometry(IRTGeometry* Dest, IRTGeometry* Source)
{
	auto* To = static_cast<FMockGeometry*>(Dest);
	auto* From = static_cast<FMockGeometry*>(Source);
	Keep(Dest);
	Keep(Source);
	Then(
	    [=, this]
	    {
		    std::lock_guard Lock(State->Mutex);
		    To->Built = From->Built;
	    });
}

void FMockCommandList::BuildScene(IRTScene* Scene, IRTBuffer* Instances, uint64_t InstanceOffset, uint32_t Count,
                                  IRTBuffer* Scratch, uint64_t ScratchOffset)
{
	auto* Mine = static_cast<FMockScene*>(Scene);
	FMockBuffer* From = Instances ? AsMock(Instances) : nullptr;
	assert(Count <= Mine->MaxInstances && InstanceOffset % 16 == 0);
	assert(Count == 0 || (From && InstanceOffset + Count * sizeof(FRTInstance) <= From->Desc.Size));
	Log(ERTMockCall::BuildScene, Mine->Name, {Count, InstanceOffset, ScratchOffset});
	Keep(Scene);
	if (Instances)
	{
		Keep(Instances);
	}
	if (Scratch)
	{
		Keep(Scratch);
	}
	Then(
	    [=, this]
	    {
		    std::lock_guard Lock(State->Mutex);
		    Mine->Instances.resize(Count);
		    for (uint32_t i = 0; i < Count; ++i)
		    {
			    auto& [Instance, bBuilt] = Mine->Instances[i];
			    std::memcpy(&Instance, From->Bytes + InstanceOffset + i * sizeof(FRTInstance), sizeof(FRTInstance));
			    const auto Found = State->Geometries.find(Instance.GeometryAddress);
			    bBuilt = Found != State->Geometries.end() && Found->second->Built.BuildCount > 0;
			    // Address 0 is an inactive instance (Vulkan specification, "Acceleration Structure Instances").
			    if (bBuilt || Instance.GeometryAddress == 0)
			    {
				    continue;
			    }
			    const auto Dead = State->DeadGeometries.find(Instance.GeometryAddress);
			    State->Errors.push_back(Mine->Name + ": instance " + std::to_string(i) +
			                            (Found != State->Geometries.end()      ? " of unbuilt " + Found->second->Name
			                             : Dead != State->DeadGeometries.end() ? " of destroyed " + Dead->second
			                                                                   : std::string(" of no geometry")));
		    }
	    });
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
	Then(
	    [=, this]
	    {
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
	Then(
	    [=, this]
	    {
		    std::lock_guard Lock(State->Mutex);
		    std::fill_n(Mine->Values.begin() + First, Count, 0);
	    });
}

void FMockCommandList::BeginMarker(const char* MarkerName)
{
	Log(ERTMockCall::BeginMarker, MarkerName);
}
void FMockCommandList::EndMarker()
{
	Log(ERTMockCall::EndMarker, "");
}

} // namespace Lantern
