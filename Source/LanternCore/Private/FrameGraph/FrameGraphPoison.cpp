// Overwrites histories with bits that are not-a-number, so that tests find the passes that let them through.
#include <algorithm>

#include "FrameGraph/FrameGraphPoison.h"

namespace Lantern
{

namespace
{

// All bits set is a NaN in every float format.
constexpr uint32_t NotANumber = ~0u;

/// Bytes of the largest mip level.
uint64_t GetBytes(const FGraphTextureDesc& Desc) { return uint64_t(Desc.Width) * Desc.Height * BytesPerTexel(Desc.Format); }

bool CanBePoisoned(const FGraphResource& Resource)
{
	return Resource.bTexture ? HasAny(Resource.TextureDesc.ExtraUsage, ERTTextureUsage::CopyDest)
	                         : HasAny(Resource.BufferDesc.ExtraUsage, ERTBufferUsage::CopyDest);
}

void SwitchBits(FPassContext& Pass, FGraphBuffer Bits, ERTAccess Before, ERTAccess After)
{
	FRTBarrier Barrier;
	Barrier.Buffer = Pass.GetBuffer(Bits);
	Barrier.Before = Before;
	Barrier.After = After;
	Pass.Commands().Barriers(&Barrier, 1);
}

/// The access in which the pass leaves buffers. It avoids CopyWrite if possible, since global memory barriers after later copies
/// (the scene's tables) would cover these buffers as well.
ERTAccess GetBufferAccess(const FGraphResource& Resource)
{
	return HasAny(Resource.BufferDesc.ExtraUsage, ERTBufferUsage::Storage) ? ERTAccess::StorageWrite : ERTAccess::CopyWrite;
}

void FillBuffer(FPassContext& Pass, FGraphBuffer Buffer, ERTAccess Access)
{
	IRTBuffer* const Dest = Pass.GetBuffer(Buffer);
	if (Access != ERTAccess::CopyWrite) { SwitchBits(Pass, Buffer, Access, ERTAccess::CopyWrite); }
	Pass.Commands().FillBuffer(Dest, 0, Dest->GetDesc().Size / 4 * 4, NotANumber);
	if (Access != ERTAccess::CopyWrite) { SwitchBits(Pass, Buffer, ERTAccess::CopyWrite, Access); }
}

/// Copies the bits to a texture from a filled buffer, which is left as it was declared.
void PoisonTextures(FPassContext& Pass, FGraphBuffer Bits, const std::vector<FGraphTexture>& Textures)
{
	IRTCommandList& Commands = Pass.Commands();
	IRTBuffer* const Source = Pass.GetBuffer(Bits);
	FillBuffer(Pass, Bits, ERTAccess::StorageWrite);
	SwitchBits(Pass, Bits, ERTAccess::StorageWrite, ERTAccess::CopyRead);
	for (const FGraphTexture Texture : Textures)
	{
		IRTTexture* const Dest = Pass.GetTexture(Texture);
		for (uint32_t Mip = 0; Mip < Dest->GetDesc().MipCount; ++Mip) { Commands.CopyBufferToTexture(Dest, Mip, 0, Source, 0); }
	}
	SwitchBits(Pass, Bits, ERTAccess::CopyRead, ERTAccess::StorageWrite);
}

} // namespace

FRTStatus FPoisonPass::Find(const std::vector<std::string>& NameParts)
{
	for (uint32_t Index = 0; Index < Resources.size(); ++Index)
	{
		const FGraphResource& Resource = Resources[Index];
		const auto IsIn = [&](const std::string& Part) { return Resource.Name.find(Part) != std::string::npos; };
		if (!Resource.bHistory || std::none_of(NameParts.begin(), NameParts.end(), IsIn)) { continue; }
		if (!CanBePoisoned(Resource))
		{
			return FRTStatus::Error(
			    ERTResult::InvalidArgument, "Frame graph: %s cannot be poisoned: it has no usage CopyDest", Resource.Describe().c_str());
		}
		if (Resource.bTexture) { Textures.push_back({Index}); }
		else { Buffers.push_back({Index}); }
	}
	return FRTStatus::Success();
}

FGraphPass FPoisonPass::Make()
{
	FGraphPass Pass;
	Pass.Name = "Poison";
	Pass.bNeverCull = true;
	const auto Write = [&](uint32_t Index, ERTAccess Access) { Pass.Uses.push_back({.Resource = Index, .Write = Access}); };
	std::vector<std::pair<FGraphBuffer, ERTAccess>> Filled;
	for (const FGraphBuffer Buffer : Buffers)
	{
		Filled.emplace_back(Buffer, GetBufferAccess(Resources[Buffer.Index]));
		Write(Buffer.Index, Filled.back().second);
	}
	uint64_t Bytes = 0;
	for (const FGraphTexture Texture : Textures)
	{
		Write(Texture.Index, ERTAccess::CopyWrite);
		Bytes = std::max(Bytes, GetBytes(Resources[Texture.Index].TextureDesc));
	}
	FGraphBuffer Bits;
	if (Bytes > 0)
	{
		Bits = {static_cast<uint32_t>(Resources.size())};
		FGraphResource& Resource = Resources.emplace_back();
		Resource.Name = "PoisonBits";
		Resource.BufferDesc = {(Bytes + 3) / 4 * 4, ERTBufferUsage::CopySource | ERTBufferUsage::CopyDest};
		Write(Bits.Index, ERTAccess::StorageWrite);
	}
	Pass.Execute = [Filled, Bits, Poisoned = Textures](FPassContext& Context) {
		for (const auto& [Buffer, Access] : Filled) { FillBuffer(Context, Buffer, Access); }
		if (Bits.IsValid()) { PoisonTextures(Context, Bits, Poisoned); }
	};
	return Pass;
}

} // namespace Lantern
