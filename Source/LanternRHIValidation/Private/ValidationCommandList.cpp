// FValidatedCommandList: recording state, barriers and queries.
#include "ValidationCommandList.h"

namespace Lantern
{

FValidatedCommandList::FValidatedCommandList(
    std::shared_ptr<FValidationState> InState, TRTRef<IRTCommandList> InInner, const char* Name, bool bInImported)
    : TValidated(std::move(InState), MakeLabel("list", Name), std::move(InInner)),
      bImported(bInImported)
{
	if (bImported) { Stage = EStage::Recording; }
}

FRTStatus FValidatedCommandList::Begin()
{
	if (bImported) { return State->Fail(Where("Begin") + ": an imported list is begun by the engine"); }
	if (Stage == EStage::Recording) { return State->Fail(Where("Begin") + ": it is recording already"); }
	if (Stage == EStage::Submitted && State->Inner->GetCompletedFence() < Fence)
	{
		return State->Fail(
		    Where("Begin") + Print(": its submission (fence %llu) has not finished", static_cast<unsigned long long>(Fence)));
	}
	Steps.clear();
	KeptGeometries.clear();
	ScratchRanges.clear();
	bUnflushedGeometry = bUnflushedBuild = bUnflushedScene = bInPass = false;
	Pipeline.Reset();
	IndexSize = Markers = 0;
	FRTStatus Status = Inner->Begin();
	Stage = Status ? EStage::Recording : EStage::Idle;
	return Status;
}

FRTStatus FValidatedCommandList::End()
{
	if (bImported) { return State->Fail(Where("End") + ": an imported list is ended by the engine"); }
	if (Stage != EStage::Recording) { return State->Fail(Where("End") + ": it is not recording"); }
	if (bInPass) { return State->Fail(Where("End") + ": within a raster pass"); }
	if (Markers) { Report("End", Print("%u markers are still open", Markers)); }
	Pipeline.Reset();
	FRTStatus Status = Inner->End();
	Stage = Status ? EStage::Ended : EStage::Idle;
	return Status;
}

void FValidatedCommandList::Judge(FValidationTracker& Tracker) const
{
	for (const FGeometryHold& Hold : KeptGeometries) { Tracker.Keep(Hold.Geometry); }
	for (const FValidationStep& Step : Steps) { Tracker.Run(Step); }
}

void FValidatedCommandList::MarkSubmitted(FRTFence InFence)
{
	Stage = EStage::Submitted;
	Fence = InFence;
	// The steps refer to buffers of the wrapped device, which must not outlive their use.
	Steps.clear();
	KeptGeometries.clear();
	Pipeline.Reset();
}

bool FValidatedCommandList::CanRecord(const char* Call)
{
	if (Stage == EStage::Recording) { return true; }
	Report(Call, "the list is not recording");
	return false;
}

bool FValidatedCommandList::CanRecordOutside(const char* Call)
{
	if (!CanRecord(Call)) { return false; }
	if (bInPass) { Report(Call, "not allowed within a raster pass"); }
	return !bInPass;
}

FValidationStep& FValidatedCommandList::AddStep(EKind Kind, const char* Call)
{
	FValidationStep& Step = Steps.emplace_back();
	Step.Kind = Kind;
	Step.What = Where(Call);
	return Step;
}

void FValidatedCommandList::AddUse(const char* Call, const std::shared_ptr<FResourceTrack>& Resource, ERTAccess Access)
{
	FValidationStep& Step = AddStep(EKind::Use, Call);
	Step.Resource = Resource;
	Step.After = Access;
}

FValidatedBuffer* FValidatedCommandList::RequireBuffer(const char* Call, const char* Argument, IRTBuffer* Buffer, ERTBufferUsage Usage)
{
	auto* Found = State->Require<FValidatedBuffer>(Buffer, Where(Call) + ": " + Argument);
	if (!Found || Found->Has(Usage)) { return Found; }
	static constexpr const char* Names[] = {
	    "Storage", "Index", "Indirect", "CopySource", "CopyDest", "GeometryInput", "Scratch", "ShaderTable"};
	uint32_t Bit = 0;
	while (!(static_cast<uint32_t>(Usage) & (1u << Bit))) { ++Bit; }
	Report(Call, Found->Label + " was created without the usage " + Names[Bit]);
	return nullptr;
}

FValidatedTexture* FValidatedCommandList::RequireTexture(const char* Call, const char* Argument, IRTTexture* Texture, ERTTextureUsage Usage)
{
	auto* Found = State->Require<FValidatedTexture>(Texture, Where(Call) + ": " + Argument);
	if (!Found || Found->Has(Usage)) { return Found; }
	static constexpr const char* Names[] = {"Sampled", "Storage", "RenderTarget", "Depth", "CopySource", "CopyDest"};
	uint32_t Bit = 0;
	while (!(static_cast<uint32_t>(Usage) & (1u << Bit))) { ++Bit; }
	Report(Call, Found->Label + " was created without the usage " + Names[Bit]);
	return nullptr;
}

bool FValidatedCommandList::CheckRange(const char* Call, const FValidatedBuffer& Buffer, uint64_t Offset, uint64_t Size)
{
	if (Size > 0 && IsInside(Offset, Size, Buffer.GetDesc().Size)) { return true; }
	Report(Call, Buffer.Label + Print(": %llu bytes at %llu of %llu", static_cast<unsigned long long>(Size),
	                                static_cast<unsigned long long>(Offset), static_cast<unsigned long long>(Buffer.GetDesc().Size)));
	return false;
}

bool FValidatedCommandList::CheckBarrier(const FRTBarrier& Item, FRTBarrier& OutInner)
{
	const char* Call = "Barriers";
	OutInner = Item;
	if (Item.Buffer && Item.Texture)
	{
		Report(Call, "an item has both a buffer and a texture");
		return false;
	}
	if (Item.After == ERTAccess::None)
	{
		Report(Call, "an item's After is None");
		return false;
	}
	FValidationStep Step;
	Step.Kind = EKind::Barrier;
	Step.What = Where(Call);
	Step.Before = Item.Before;
	Step.After = Item.After;
	if (Item.Buffer)
	{
		auto* Buffer = State->Require<FValidatedBuffer>(Item.Buffer, Where(Call) + ": Buffer");
		if (!Buffer) { return false; }
		OutInner.Buffer = Buffer->Inner.Get();
		Step.Resource = Buffer->Track;
	}
	else if (Item.Texture)
	{
		auto* Texture = State->Require<FValidatedTexture>(Item.Texture, Where(Call) + ": Texture");
		if (!Texture) { return false; }
		OutInner.Texture = Texture->Inner.Get();
		Step.Resource = Texture->Track;
	}
	Steps.push_back(std::move(Step));
	return true;
}

void FValidatedCommandList::Barriers(const FRTBarrier* Items, uint32_t Count)
{
	if (!CanRecordOutside("Barriers") || Count == 0) { return; }
	if (!Items) { return Report("Barriers", "Items is null"); }
	std::vector<FRTBarrier> Inners;
	for (uint32_t i = 0; i < Count; ++i)
	{
		FRTBarrier Mine;
		if (!CheckBarrier(Items[i], Mine)) { continue; }
		Inners.push_back(Mine);
		if (!HasAny(Mine.Before, ERTAccess::BuildWrite)) { continue; }
		if (!Mine.Buffer && !Mine.Texture)
		{
			bUnflushedGeometry = bUnflushedBuild = bUnflushedScene = false;
			ScratchRanges.clear();
		}
		else
		{
			const FResourceTrack* Track = Steps.back().Resource.get();
			std::erase_if(ScratchRanges, [=](const FScratchRange& Range) { return Range.Buffer == Track; });
		}
	}
	if (!Inners.empty()) { Inner->Barriers(Inners.data(), static_cast<uint32_t>(Inners.size())); }
}

void FValidatedCommandList::KeepAlive(IRTRefCounted* Object)
{
	if (!CanRecord("KeepAlive")) { return; }
	if (!Object || State->IsDead(Object))
	{
		State->Require<FValidated>(Object, Where("KeepAlive") + ": Object");
		return;
	}
	// An object that is no wrapper is the caller's own, and kept as it is.
	FValidated* Known = State->FindAny(Object);
	if (auto* Geometry = dynamic_cast<FValidatedGeometry*>(Known)) { KeptGeometries.emplace_back(Geometry->Track); }
	Inner->KeepAlive(Known ? Known->GetInner() : Object);
}

void FValidatedCommandList::WriteTimestamp(IRTQueryPool* Pool, uint32_t Index)
{
	if (!CanRecord("WriteTimestamp")) { return; }
	auto* Mine = State->Require<FValidatedQueryPool>(Pool, Where("WriteTimestamp") + ": Pool");
	if (!Mine) { return; }
	if (Index >= Mine->GetCount()) { return Report("WriteTimestamp", Print("query %u of %u", Index, Mine->GetCount())); }
	if (Mine->GetKind() != ERTQuery::Timestamp) { return Report("WriteTimestamp", Mine->Label + " is not for timestamps"); }
	Inner->WriteTimestamp(Mine->Inner.Get(), Index);
}

void FValidatedCommandList::ResetQueries(IRTQueryPool* Pool, uint32_t First, uint32_t Count)
{
	if (!CanRecordOutside("ResetQueries")) { return; }
	auto* Mine = State->Require<FValidatedQueryPool>(Pool, Where("ResetQueries") + ": Pool");
	if (!Mine) { return; }
	if (Count == 0 || !IsInside(First, Count, Mine->GetCount()))
	{
		return Report("ResetQueries", Print("queries %u + %u of %u", First, Count, Mine->GetCount()));
	}
	Mine->MarkReset(First, Count);
	Inner->ResetQueries(Mine->Inner.Get(), First, Count);
}

void FValidatedCommandList::BeginMarker(const char* Name)
{
	if (!CanRecord("BeginMarker")) { return; }
	if (!Name) { return Report("BeginMarker", "Name is null"); }
	++Markers;
	Inner->BeginMarker(Name);
}

void FValidatedCommandList::EndMarker()
{
	if (!CanRecord("EndMarker")) { return; }
	if (Markers == 0) { return Report("EndMarker", "no marker is open"); }
	--Markers;
	Inner->EndMarker();
}

} // namespace Lantern
