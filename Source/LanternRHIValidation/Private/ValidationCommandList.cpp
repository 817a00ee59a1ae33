// FValidatedCommandList: recording state, barriers, queries, copies and compaction.
#include "ValidationCommandList.h"

#include <algorithm>
#include <string_view>
#include <utility>

namespace Lantern
{
namespace
{

bool IsForTransfer(std::string_view Call) { return Call == "CopyBuffer" || Call == "CopyBufferRegions" || Call == "KeepAlive"; }

bool IsForGraphics(std::string_view Call) { return Call == "BeginRasterPass" || Call == "GenerateMips"; }

bool HasSameShape(const FRTGeometrySection& A, const FRTGeometrySection& B)
{
	return A.VertexCount == B.VertexCount && A.TriangleCount == B.TriangleCount && A.bProcedural == B.bProcedural &&
	       A.bOpaque == B.bOpaque && A.IndexType == B.IndexType && A.VertexFormat == B.VertexFormat;
}

} // namespace

FValidatedCommandList::FValidatedCommandList(
    std::shared_ptr<FValidationState> InState, TRTRef<IRTCommandList> InInner, const char* Name, bool bInImported, ERTQueue InQueue)
    : TValidated(std::move(InState), MakeLabel("list", Name), std::move(InInner)),
      bImported(bInImported),
      Queue(InQueue)
{
	if (bImported) { Stage = EStage::Recording; }
}

FRTStatus FValidatedCommandList::Begin()
{
	if (bImported) { return State->Fail(Where("Begin") + ": an imported list is begun by the engine"); }
	if (Stage == EStage::Recording) { return State->Fail(Where("Begin") + ": it is recording already"); }
	if (Stage == EStage::Submitted && State->Inner->GetCompletedFence(Queue) < Fence)
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
	if (Stage != EStage::Recording)
	{
		Report(Call, "the list is not recording");
		return false;
	}
	if (Queue == ERTQueue::Transfer && !IsForTransfer(Call))
	{
		Report(Call, "a list of the transfer queue takes copies between buffers alone");
		return false;
	}
	if (Queue == ERTQueue::AsyncCompute && IsForGraphics(Call))
	{
		Report(Call, "a list of the compute queue takes no raster");
		return false;
	}
	return true;
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

// ------------------------------------------------------------------------------------------------ copies

void FValidatedCommandList::CopyBuffer(IRTBuffer* Dest, uint64_t DestOffset, IRTBuffer* Source, uint64_t SourceOffset, uint64_t Size)
{
	const FRTBufferRegion Region{DestOffset, SourceOffset, Size};
	CopyRegions("CopyBuffer", Dest, Source, &Region, 1);
}

void FValidatedCommandList::CopyBufferRegions(IRTBuffer* Dest, IRTBuffer* Source, const FRTBufferRegion* Regions, uint32_t Count)
{
	if (!Regions || Count == 0) { return Report("CopyBufferRegions", "no regions"); }
	CopyRegions("CopyBufferRegions", Dest, Source, Regions, Count);
}

void FValidatedCommandList::CopyRegions(
    const char* Call, IRTBuffer* Dest, IRTBuffer* Source, const FRTBufferRegion* Regions, uint32_t Count)
{
	if (!CanRecordOutside(Call)) { return; }
	FValidatedBuffer* To = RequireBuffer(Call, "Dest", Dest, ERTBufferUsage::CopyDest);
	FValidatedBuffer* From = RequireBuffer(Call, "Source", Source, ERTBufferUsage::CopySource);
	if (!To || !From) { return; }
	for (uint32_t Index = 0; Index < Count; ++Index)
	{
		const FRTBufferRegion& Region = Regions[Index];
		if (!CheckRange(Call, *To, Region.DestOffset, Region.Size) || !CheckRange(Call, *From, Region.SourceOffset, Region.Size))
		{
			return;
		}
	}
	if (To == From)
	{
		// One buffer has one state; it cannot be read and written at once.
		return Report(Call, To->Label + " is both source and destination");
	}
	AddUse(Call, From->Track, ERTAccess::CopyRead);
	AddUse(Call, To->Track, ERTAccess::CopyWrite);
	Inner->CopyBufferRegions(To->Inner.Get(), From->Inner.Get(), Regions, Count);
}

bool FValidatedCommandList::CheckTextureCopy(
    const char* Call, const FValidatedTexture& Texture, uint32_t Mip, uint32_t Layer, const FValidatedBuffer& Buffer, uint64_t Offset)
{
	const FRTTextureDesc& Desc = Texture.GetDesc();
	if (Mip >= Desc.MipCount || Layer >= Desc.ArraySize)
	{
		Report(Call, Texture.Label + Print(": mip %u of %u, layer %u of %u", Mip, Desc.MipCount, Layer, Desc.ArraySize));
		return false;
	}
	const uint64_t Texel = BytesPerTexel(Desc.Format);
	if (Offset % std::max<uint64_t>(Texel, 4) != 0)
	{
		Report(Call, Buffer.Label + Print(": offset %llu is not a multiple of %llu", static_cast<unsigned long long>(Offset),
		                                static_cast<unsigned long long>(std::max<uint64_t>(Texel, 4))));
		return false;
	}
	const uint64_t Width = std::max(1u, Desc.Width >> Mip), Height = std::max(1u, Desc.Height >> Mip);
	return CheckRange(Call, Buffer, Offset, Width * Height * Texel);
}

void FValidatedCommandList::CopyBufferToTexture(IRTTexture* Dest, uint32_t Mip, uint32_t Layer, IRTBuffer* Source, uint64_t SourceOffset)
{
	const char* Call = "CopyBufferToTexture";
	if (!CanRecordOutside(Call)) { return; }
	FValidatedTexture* To = RequireTexture(Call, "Dest", Dest, ERTTextureUsage::CopyDest);
	FValidatedBuffer* From = RequireBuffer(Call, "Source", Source, ERTBufferUsage::CopySource);
	if (!To || !From || !CheckTextureCopy(Call, *To, Mip, Layer, *From, SourceOffset)) { return; }
	AddUse(Call, From->Track, ERTAccess::CopyRead);
	AddUse(Call, To->Track, ERTAccess::CopyWrite);
	Inner->CopyBufferToTexture(To->Inner.Get(), Mip, Layer, From->Inner.Get(), SourceOffset);
}

void FValidatedCommandList::CopyTextureToBuffer(IRTBuffer* Dest, uint64_t DestOffset, IRTTexture* Source, uint32_t Mip, uint32_t Layer)
{
	const char* Call = "CopyTextureToBuffer";
	if (!CanRecordOutside(Call)) { return; }
	FValidatedBuffer* To = RequireBuffer(Call, "Dest", Dest, ERTBufferUsage::CopyDest);
	FValidatedTexture* From = RequireTexture(Call, "Source", Source, ERTTextureUsage::CopySource);
	if (!To || !From || !CheckTextureCopy(Call, *From, Mip, Layer, *To, DestOffset)) { return; }
	AddUse(Call, From->Track, ERTAccess::CopyRead);
	AddUse(Call, To->Track, ERTAccess::CopyWrite);
	Inner->CopyTextureToBuffer(To->Inner.Get(), DestOffset, From->Inner.Get(), Mip, Layer);
}

void FValidatedCommandList::FillBuffer(IRTBuffer* Dest, uint64_t Offset, uint64_t Size, uint32_t Value)
{
	const char* Call = "FillBuffer";
	if (!CanRecordOutside(Call)) { return; }
	FValidatedBuffer* To = RequireBuffer(Call, "Dest", Dest, ERTBufferUsage::CopyDest);
	if (!To || !CheckRange(Call, *To, Offset, Size)) { return; }
	if (Offset % 4 || Size % 4) { return Report(Call, To->Label + ": offset and size must be multiples of 4"); }
	AddUse(Call, To->Track, ERTAccess::CopyWrite);
	Inner->FillBuffer(To->Inner.Get(), Offset, Size, Value);
}

void FValidatedCommandList::ClearTexture(IRTTexture* Dest, const float Value[4])
{
	const char* Call = "ClearTexture";
	if (!CanRecordOutside(Call)) { return; }
	FValidatedTexture* To = RequireTexture(Call, "Dest", Dest, ERTTextureUsage::CopyDest);
	if (!To) { return; }
	if (!Value) { return Report(Call, "Value is null"); }
	if (IsDepth(To->GetDesc().Format)) { return Report(Call, To->Label + " is a depth texture"); }
	AddUse(Call, To->Track, ERTAccess::CopyWrite);
	Inner->ClearTexture(To->Inner.Get(), Value);
}

void FValidatedCommandList::GenerateMips(IRTTexture* Texture)
{
	const char* Call = "GenerateMips";
	if (!CanRecordOutside(Call)) { return; }
	FValidatedTexture* To = RequireTexture(Call, "Texture", Texture, ERTTextureUsage::CopyDest);
	if (!To) { return; }
	if (IsDepth(To->GetDesc().Format)) { return Report(Call, To->Label + ": its format cannot be filtered"); }
	switch (To->GetDesc().Format)
	{
	case ERTFormat::R16_UINT:
	case ERTFormat::R32_UINT:
	case ERTFormat::RG32_UINT:
	case ERTFormat::RGBA32_UINT: return Report(Call, To->Label + ": its format cannot be filtered");
	default: break;
	}
	AddUse(Call, To->Track, ERTAccess::CopyWrite);
	FValidationStep& Left = AddStep(EKind::SetState, Call);
	Left.Resource = To->Track;
	Left.After = ERTAccess::ShaderRead;
	Inner->GenerateMips(To->Inner.Get());
}

// ------------------------------------------------------------------------------------------------ compaction

void FValidatedCommandList::WriteCompactedSize(IRTQueryPool* Queries, uint32_t Index, IRTGeometry* Geometry)
{
	const char* Call = "WriteCompactedSize";
	if (!CanRecordOutside(Call)) { return; }
	auto* Pool = State->Require<FValidatedQueryPool>(Queries, Where(Call) + ": Queries");
	auto* Mine = State->Require<FValidatedGeometry>(Geometry, Where(Call) + ": Geometry");
	if (!Pool || !Mine) { return; }
	if (Pool->GetKind() != ERTQuery::CompactedSize)
	{
		return Report(Call, Mine->Label + ": " + Pool->Label + " is not for compacted sizes");
	}
	if (Index >= Pool->GetCount()) { return Report(Call, Mine->Label + Print(": query %u of %u", Index, Pool->GetCount())); }
	if (!Mine->Track->bAllowCompaction) { return Report(Call, Mine->Label + " was created without bAllowCompaction"); }
	if (bUnflushedBuild) { return Report(Call, Mine->Label + ": geometries were built, with no memory barrier from BuildWrite since"); }
	{
		std::lock_guard Lock(State->Mutex);
		if (!std::exchange(Pool->Track->Queries[Index].bReset, false))
		{
			return Report(Call, Mine->Label + Print(": query %u was not reset since it was written", Index));
		}
	}
	AddStep(EKind::RequireBuilt, Call).Geometry = Mine->Track;
	FValidationStep& Step = AddStep(EKind::WriteSize, Call);
	Step.Geometry = Mine->Track;
	Step.Queries = Pool->Track;
	Step.Count = Index;
	KeptGeometries.emplace_back(Mine->Track);
	Inner->WriteCompactedSize(Pool->Inner.Get(), Index, Mine->Inner.Get());
}

bool FValidatedCommandList::CheckCompaction(const FValidatedGeometry& Dest, const FValidatedGeometry& Source)
{
	const FGeometryTrack &To = *Dest.Track, &From = *Source.Track;
	std::string Wrong;
	uint64_t Size = 0;
	{
		std::lock_guard Lock(State->Mutex);
		Size = From.CompactedSize;
	}
	if (!From.bAllowCompaction) { Wrong = Source.Label + " was created without bAllowCompaction"; }
	else if (From.CompactedBytes) { Wrong = Source.Label + " is a compacted copy itself"; }
	else if (!To.CompactedBytes) { Wrong = Dest.Label + " was created without CompactedBytes"; }
	else if (Size == 0) { Wrong = "no compacted size of " + Source.Label + " has been read (WriteCompactedSize, then GetResults)"; }
	else if (To.CompactedBytes != Size)
	{
		Wrong = Dest.Label + Print(" was created for %llu bytes, but ", Wide(To.CompactedBytes)) + Source.Label +
		        Print(" needs %llu", Wide(Size));
	}
	else if (To.bAllowUpdate != From.bAllowUpdate || To.bFastBuild != From.bFastBuild ||
	         !std::equal(To.Sections.begin(), To.Sections.end(), From.Sections.begin(), From.Sections.end(), HasSameShape))
	{
		Wrong = Dest.Label + " was created with other sections or flags than " + Source.Label;
	}
	if (!Wrong.empty()) { Report("CompactGeometry", Wrong); }
	return Wrong.empty();
}

void FValidatedCommandList::CompactGeometry(IRTGeometry* Dest, IRTGeometry* Source)
{
	const char* Call = "CompactGeometry";
	if (!CanRecordOutside(Call)) { return; }
	auto* To = State->Require<FValidatedGeometry>(Dest, Where(Call) + ": Dest");
	auto* From = State->Require<FValidatedGeometry>(Source, Where(Call) + ": Source");
	if (!To || !From || !CheckCompaction(*To, *From)) { return; }
	if (bUnflushedBuild) { return Report(Call, From->Label + ": geometries were built, with no memory barrier from BuildWrite since"); }
	AddStep(EKind::RequireBuilt, Call).Geometry = From->Track;
	AddStep(EKind::BuildGeometry, Call).Geometry = To->Track;
	KeptGeometries.emplace_back(From->Track);
	KeptGeometries.emplace_back(To->Track);
	bUnflushedGeometry = true;
	Inner->CompactGeometry(To->Inner.Get(), From->Inner.Get());
}

} // namespace Lantern
