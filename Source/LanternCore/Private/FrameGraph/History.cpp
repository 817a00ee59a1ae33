// Histories: textures and buffers that outlive the frame graph, created, kept and freed by use.
#include "LanternCore/FrameGraph/History.h"

#include <algorithm>
#include <cassert>
#include <map>

namespace Lantern
{

namespace
{
constexpr ERTAccess RestingAccess = ERTAccess::ShaderRead; // of every history between frames

struct FKept
{
	bool bValid = false;   ///< holds what a submitted frame wrote
	bool bUsed = false;    ///< in this frame
	bool bWritten = false; ///< by this frame; the graph sets it
	uint32_t UnusedFrames = 0;

	void CountFrame()
	{
		UnusedFrames = bUsed ? 0 : UnusedFrames + 1;
		bUsed = bWritten = false;
	}
};

struct FTexturePair : FKept
{
	FGraphTextureDesc Desc; ///< of what is written next
	TRTRef<IRTTexture> Textures[2];
	bool bRests[2] = {}; ///< was in a submitted frame, which left it in RestingAccess
	int Newest = 0;      ///< where bValid: what the frame before wrote
};

struct FKeptBuffer : FKept
{
	FGraphBufferDesc Desc;
	TRTRef<IRTBuffer> Buffer;
	EHistoryScope Scope = EHistoryScope::View;
	bool bRests = false;
	bool bOfLastFrame = false; ///< the last submitted frame wrote it
};

/// Whether content of one texture can be that of the other, if at another resolution.
bool IsSameKind(const FGraphTextureDesc& A, const FGraphTextureDesc& B)
{
	return A.Format == B.Format && A.ExtraUsage == B.ExtraUsage && A.MipCount == B.MipCount;
}

bool IsSame(const FGraphTextureDesc& A, const FGraphTextureDesc& B)
{
	return A.Width == B.Width && A.Height == B.Height && IsSameKind(A, B);
}

bool HasSize(const IRTTexture* Texture, const FGraphTextureDesc& Desc)
{
	return Texture != nullptr && Texture->GetDesc().Width == Desc.Width && Texture->GetDesc().Height == Desc.Height;
}

bool IsSame(const FGraphBufferDesc& A, const FGraphBufferDesc& B) { return A.Size == B.Size && A.ExtraUsage == B.ExtraUsage; }

uint64_t GetTexelBytes(const FGraphTextureDesc& Desc)
{
	uint64_t Texels = 0;
	for (uint32_t Mip = 0; Mip < Desc.MipCount; ++Mip)
	{
		Texels += uint64_t(std::max(Desc.Width >> Mip, 1u)) * std::max(Desc.Height >> Mip, 1u);
	}
	return Texels * BytesPerTexel(Desc.Format);
}
} // namespace

struct FHistoryResources::FImpl
{
	explicit FImpl(IRTDevice& InDevice) : Device(InDevice) {}
	FRTStatus Create(const char* Name, FTexturePair& Pair) const;
	FRTStatus Create(const char* Name, FKeptBuffer& Kept) const;
	/// Released resources, perhaps of another size, may occupy the memory that is missing.
	template <class TMake>
	FRTStatus CreateOrCollect(const TMake& Make) const
	{
		FRTStatus Status = Make();
		if (Status.Code == ERTResult::OutOfDeviceMemory || Status.Code == ERTResult::OutOfDescriptors)
		{
			Device.CollectGarbage();
			Status = Make();
		}
		return Status;
	}

	IRTDevice& Device;
	FFrameGraph* Graph = nullptr; // between BeginFrame and EndFrame; dead already in EndFrame
	// Graphs write into the values; a map does not move them.
	std::map<std::string, FTexturePair, std::less<>> Textures;
	std::map<std::string, FKeptBuffer, std::less<>> Buffers;
};

FRTStatus FHistoryResources::FImpl::Create(const char* Name, FTexturePair& Pair) const
{
	FRTTextureDesc Desc;
	Desc.Width = Pair.Desc.Width;
	Desc.Height = Pair.Desc.Height;
	Desc.MipCount = Pair.Desc.MipCount;
	Desc.Format = Pair.Desc.Format;
	Desc.Usage = ERTTextureUsage::Sampled | ERTTextureUsage::Storage | ERTTextureUsage::CopyDest | Pair.Desc.ExtraUsage;
	Desc.Name = Name;
	for (int I = 0; I < 2; ++I)
	{
		TRTRef<IRTTexture>& Texture = Pair.Textures[I];
		// The newest content stays at its own resolution until it has been read.
		if (HasSize(Texture.Get(), Pair.Desc) || (Pair.bValid && I == Pair.Newest)) { continue; }
		Pair.bRests[I] = false;
		const auto Make = [&] { return Device.CreateTexture(Desc, Texture.ReleaseAndGetAddress()); };
		if (FRTStatus S = CreateOrCollect(Make); !S) { return S; }
	}
	return FRTStatus::Success();
}

FRTStatus FHistoryResources::FImpl::Create(const char* Name, FKeptBuffer& Kept) const
{
	const ERTBufferUsage Usage = ERTBufferUsage::Storage | ERTBufferUsage::CopyDest | Kept.Desc.ExtraUsage;
	const FRTBufferDesc Desc{Kept.Desc.Size, Usage, ERTMemory::Device, Name};
	return CreateOrCollect([&] { return Device.CreateBuffer(Desc, Kept.Buffer.ReleaseAndGetAddress()); });
}

namespace
{
/// Returns the item of this name, marked as used. Creates it if it is new or has another description.
template <class TMap, class TDesc, class TCreate>
FRTStatus Use(TMap& Items, const char* Name, const TDesc& Desc, const TCreate& Create, typename TMap::mapped_type*& Out)
{
	const auto [It, bNew] = Items.try_emplace(Name);
	Out = &It->second;
	assert(!Out->bUsed && "asked for twice in one frame");
	if (bNew || !IsSame(Out->Desc, Desc))
	{
		*Out = {};
		Out->Desc = Desc;
		if (FRTStatus S = Create(*Out); !S)
		{
			Items.erase(It);
			return S;
		}
	}
	Out->bUsed = true;
	return FRTStatus::Success();
}
} // namespace

FHistoryResources::FHistoryResources(IRTDevice& Device) : Impl(std::make_unique<FImpl>(Device)) {}
FHistoryResources::~FHistoryResources() = default;

void FHistoryResources::BeginFrame(FFrameGraph& Graph, bool bKeep, bool bKeepWorld)
{
	assert(!Impl->Graph && "EndFrame was not called");
	Impl->Graph = &Graph;
	for (auto& [Name, Pair] : Impl->Textures) { Pair.bValid &= bKeep; }
	for (auto& [Name, Kept] : Impl->Buffers) { Kept.bValid &= bKeep || (bKeepWorld && Kept.Scope == EHistoryScope::World); }
}

FRTStatus FHistoryResources::GetTexture(const char* Name, const FGraphTextureDesc& Desc, FHistoryTexture& Out)
{
	assert(Impl->Graph && "between BeginFrame and EndFrame");
	Out = {};
	const auto Old = Impl->Textures.find(Name);
	if (Old != Impl->Textures.end() && IsSameKind(Old->second.Desc, Desc))
	{
		FTexturePair& Kept = Old->second;
		Kept.Desc = Desc;
		if (const FRTStatus Status = Impl->Create(Name, Kept); !Status)
		{
			Impl->Textures.erase(Old);
			return Status;
		}
	}
	FTexturePair* Pair = nullptr;
	const auto Create = [&](FTexturePair& Made) { return Impl->Create(Name, Made); };
	if (FRTStatus S = Use(Impl->Textures, Name, Desc, Create, Pair); !S) { return S; }
	FFrameGraph& Graph = *Impl->Graph;
	if (Pair->bValid)
	{
		const std::string Label = std::string(Name) + " before";
		Out.Previous = Graph.ImportTexture(Pair->Textures[Pair->Newest].Get(), RestingAccess, RestingAccess, Label.c_str());
		Graph.MarkHistory(Out.Previous);
	}
	const int Next = 1 - Pair->Newest;
	const ERTAccess State = Pair->bRests[Next] ? RestingAccess : ERTAccess::None;
	Out.Current = Graph.ImportTexture(Pair->Textures[Next].Get(), State, RestingAccess, Name);
	Graph.MarkForLater(Out.Current, &Pair->bWritten);
	return FRTStatus::Success();
}

FRTStatus FHistoryResources::GetBuffer(const char* Name, const FGraphBufferDesc& Desc, FHistoryBuffer& Out, EHistoryScope Scope)
{
	assert(Impl->Graph && "between BeginFrame and EndFrame");
	Out = {};
	FKeptBuffer* Kept = nullptr;
	const auto Create = [&](FKeptBuffer& Made) { return Impl->Create(Name, Made); };
	if (FRTStatus S = Use(Impl->Buffers, Name, Desc, Create, Kept); !S) { return S; }
	Kept->Scope = Scope;
	FFrameGraph& Graph = *Impl->Graph;
	Out.bFresh = !Kept->bValid;
	Out.bOfLastFrame = Kept->bValid && Kept->bOfLastFrame;
	Out.Buffer = Graph.ImportBuffer(Kept->Buffer.Get(), Kept->bRests ? RestingAccess : ERTAccess::None, RestingAccess, Name);
	Graph.MarkForLater(Out.Buffer, &Kept->bWritten);
	if (Kept->bValid) { Graph.MarkHistory(Out.Buffer); }
	return FRTStatus::Success();
}

void FHistoryResources::EndFrame(bool bSubmitted)
{
	Impl->Graph = nullptr;
	for (auto& [Name, Pair] : Impl->Textures)
	{
		if (Pair.bUsed && bSubmitted) { Pair.bRests[1 - Pair.Newest] = true; } // the graph moves it there, used or not
		// Content written two frames ago is not a history of the previous frame.
		Pair.bValid = Pair.bUsed && bSubmitted && Pair.bWritten;
		Pair.Newest = Pair.bValid ? 1 - Pair.Newest : Pair.Newest;
		Pair.CountFrame();
	}
	for (auto& [Name, Kept] : Impl->Buffers)
	{
		Kept.bValid |= bSubmitted && Kept.bWritten; // a frame that never ran has changed nothing
		Kept.bRests |= Kept.bUsed && bSubmitted;
		if (bSubmitted) { Kept.bOfLastFrame = Kept.bWritten; }
		Kept.CountFrame();
	}
	const auto IsUnused = [](const auto& Entry) { return Entry.second.UnusedFrames >= KeepFrames; };
	std::erase_if(Impl->Textures, IsUnused);
	std::erase_if(Impl->Buffers, IsUnused);
}

void FHistoryResources::Clear()
{
	assert(!Impl->Graph && "between frames");
	Impl->Textures.clear();
	Impl->Buffers.clear();
}

uint64_t FHistoryResources::GetBytes() const
{
	uint64_t Bytes = 0;
	for (const auto& [Name, Size] : GetParts()) { Bytes += Size; }
	return Bytes;
}

std::vector<std::pair<std::string, uint64_t>> FHistoryResources::GetParts() const
{
	std::vector<std::pair<std::string, uint64_t>> Parts;
	for (const auto& [Name, Pair] : Impl->Textures) { Parts.emplace_back(Name, 2 * GetTexelBytes(Pair.Desc)); }
	for (const auto& [Name, Kept] : Impl->Buffers) { Parts.emplace_back(Name, Kept.Desc.Size); }
	return Parts;
}

} // namespace Lantern
