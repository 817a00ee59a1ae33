// FValidatedCommandList: copies, fills, clears and mips.
#include "ValidationCommandList.h"

#include <algorithm>

namespace Lantern
{

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
	if (To->GetDesc().Format == ERTFormat::D32_FLOAT) { return Report(Call, To->Label + " is a depth texture"); }
	AddUse(Call, To->Track, ERTAccess::CopyWrite);
	Inner->ClearTexture(To->Inner.Get(), Value);
}

void FValidatedCommandList::GenerateMips(IRTTexture* Texture)
{
	const char* Call = "GenerateMips";
	if (!CanRecordOutside(Call)) { return; }
	FValidatedTexture* To = RequireTexture(Call, "Texture", Texture, ERTTextureUsage::CopyDest);
	if (!To) { return; }
	switch (To->GetDesc().Format)
	{
	case ERTFormat::R16_UINT:
	case ERTFormat::R32_UINT:
	case ERTFormat::RG32_UINT:
	case ERTFormat::RGBA32_UINT:
	case ERTFormat::D32_FLOAT: return Report(Call, To->Label + ": its format cannot be filtered");
	default: break;
	}
	AddUse(Call, To->Track, ERTAccess::CopyWrite);
	FValidationStep& Left = AddStep(EKind::SetState, Call);
	Left.Resource = To->Track;
	Left.After = ERTAccess::ShaderRead;
	Inner->GenerateMips(To->Inner.Get());
}

} // namespace Lantern
