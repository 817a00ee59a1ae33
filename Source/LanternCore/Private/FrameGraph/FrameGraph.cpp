// The interface of the frame graph: declaring resources and passes.
#include "LanternCore/FrameGraph/FrameGraph.h"

#include <algorithm>
#include <cassert>

#include <fmt/format.h>

#include "FrameGraph/FrameGraphImpl.h"

namespace Lantern
{

namespace
{

class FBuilder final : public FPassBuilder
{
public:
	FBuilder(FGraphPass& InPass, const std::vector<FGraphResource>& InResources) : Pass(InPass), Resources(InResources) {}
	void Read(FGraphTexture Texture, ERTAccess Access) override { Add(Texture.Index, true).Read |= Access; }
	void Read(FGraphBuffer Buffer, ERTAccess Access) override { Add(Buffer.Index, false).Read |= Access; }
	void Write(FGraphTexture Texture, ERTAccess Access) override { Add(Texture.Index, true).Write |= Access; }
	void Write(FGraphBuffer Buffer, ERTAccess Access) override { Add(Buffer.Index, false).Write |= Access; }
	void WriteIfRead(FGraphTexture Texture, ERTAccess Access) override
	{
		FPassUse& Use = Add(Texture.Index, true);
		Use.Write |= Access;
		Use.bIfRead = true;
	}
	void RecordOnTask() override { Pass.bOnTask = true; }
	void AllowAsync() override { Pass.bAllowAsync = true; }
	void Write(FGraphToken Token) override { Pass.TokenWrites.push_back(Token.Index); }
	void Without(FGraphToken Token) override { Pass.TokensUnused.push_back(Token.Index); }
	void RunBeside(const char* Group) override { Pass.Group = Group; }
	void ShareApart(FGraphBuffer Buffer) override { Add(Buffer.Index, false).bApart = true; }
	void NeverCull() override { Pass.bNeverCull = true; }
	void Keep(FGraphTexture Texture) override { AddKeep(Texture.Index, true); }
	void Keep(FGraphBuffer Buffer) override { AddKeep(Buffer.Index, false); }

private:
	bool IsOfGraph(uint32_t Index, bool bTexture)
	{
		const bool bIs = Index < Resources.size() && Resources[Index].bTexture == bTexture;
		if (!bIs)
		{
			Pass.BadUse = bTexture ? "declares a texture that is not of this graph" : "declares a buffer that is not of this graph";
		}
		return bIs;
	}
	void AddKeep(uint32_t Index, bool bTexture)
	{
		if (IsOfGraph(Index, bTexture)) { Pass.Keeps.push_back(Index); }
	}
	FPassUse& Add(uint32_t Index, bool bTexture)
	{
		if (!IsOfGraph(Index, bTexture)) { return Ignored; }
		const auto Is = [&](const FPassUse& Use) { return Use.Resource == Index; };
		const auto It = std::find_if(Pass.Uses.begin(), Pass.Uses.end(), Is);
		return It != Pass.Uses.end() ? *It : Pass.Uses.emplace_back(FPassUse{Index});
	}

	FGraphPass& Pass;
	const std::vector<FGraphResource>& Resources;
	FPassUse Ignored;
};

} // namespace

const FPassUse* FGraphPass::Find(uint32_t Resource) const
{
	const auto It = std::find_if(Uses.begin(), Uses.end(), [&](const FPassUse& Use) { return Use.Resource == Resource; });
	return It != Uses.end() ? &*It : nullptr;
}

FPoolKey FGraphResource::MakeKey() const
{
	FPoolKey Key;
	Key.bTexture = bTexture;
	if (bTexture)
	{
		Key.Width = TextureDesc.Width;
		Key.Height = TextureDesc.Height;
		Key.MipCount = TextureDesc.MipCount;
		Key.Format = TextureDesc.Format;
		Key.Usage = static_cast<uint32_t>(TextureDesc.ExtraUsage | GetTextureUsage(AllAccess));
	}
	else
	{
		Key.Size = BufferDesc.Size;
		Key.Usage = static_cast<uint32_t>(BufferDesc.ExtraUsage | GetBufferUsage(AllAccess));
	}
	return Key;
}

std::string FGraphResource::Describe() const
{
	if (bTexture)
	{
		return fmt::format("texture '{}' ({}x{} {})", Name, TextureDesc.Width, TextureDesc.Height, ToString(TextureDesc.Format));
	}
	return fmt::format("buffer '{}' ({} bytes)", Name, BufferDesc.Size);
}

FFrameGraph::FImpl::~FImpl()
{
	for (const FGraphResource& Resource : Resources)
	{
		if (Resource.Pooled)
		{
			Resource.Pooled->Owner = nullptr;
			Resource.Pooled->bBusy = false;
		}
	}
}

FFrameGraph::FFrameGraph(FFrameGraphResources& Resources) : Impl(std::make_unique<FImpl>(*Resources.Impl)) {}
FFrameGraph::~FFrameGraph() = default;

FGraphTexture FFrameGraph::CreateTexture(const FGraphTextureDesc& Desc, const char* Name)
{
	assert(Desc.Width > 0 && Desc.Height > 0 && Desc.Format != ERTFormat::Unknown && Desc.MipCount > 0);
	FGraphResource Resource; // complete before the list grows: Desc may be what GetDesc returned, which lies in it
	Resource.Name = Name;
	Resource.bTexture = true;
	Resource.TextureDesc = Desc;
	Impl->Resources.push_back(std::move(Resource));
	return {static_cast<uint32_t>(Impl->Resources.size() - 1)};
}

FGraphBuffer FFrameGraph::CreateBuffer(const FGraphBufferDesc& Desc, const char* Name)
{
	assert(Desc.Size > 0);
	FGraphResource Resource;
	Resource.Name = Name;
	Resource.BufferDesc = Desc;
	Impl->Resources.push_back(std::move(Resource));
	return {static_cast<uint32_t>(Impl->Resources.size() - 1)};
}

FGraphTexture FFrameGraph::ImportTexture(IRTTexture* Texture, ERTAccess Current, ERTAccess After, const char* Name)
{
	assert(Texture);
	const auto [It, bNew] = Impl->Imported.try_emplace(Texture, static_cast<uint32_t>(Impl->Resources.size()));
	if (bNew)
	{
		FGraphResource& Resource = Impl->Resources.emplace_back();
		const FRTTextureDesc& Desc = Texture->GetDesc();
		Resource.Name = Name;
		Resource.bTexture = true;
		Resource.bImported = true;
		Resource.TextureDesc = {Desc.Width, Desc.Height, Desc.Format, Desc.Usage, Desc.MipCount};
		Resource.ImportedTexture = TRTRef<IRTTexture>(Texture);
		Resource.Current = Current;
	}
	FGraphResource& Resource = Impl->Resources[It->second];
	assert(Resource.Current == Current && "one texture imported twice, in two states");
	Resource.After = After != ERTAccess::None ? After : Resource.After;
	return {It->second};
}

FGraphBuffer FFrameGraph::ImportBuffer(IRTBuffer* Buffer, ERTAccess Current, ERTAccess After, const char* Name)
{
	assert(Buffer);
	const auto [It, bNew] = Impl->Imported.try_emplace(Buffer, static_cast<uint32_t>(Impl->Resources.size()));
	if (bNew)
	{
		FGraphResource& Resource = Impl->Resources.emplace_back();
		Resource.Name = Name;
		Resource.bImported = true;
		Resource.BufferDesc = {Buffer->GetDesc().Size, Buffer->GetDesc().Usage};
		Resource.ImportedBuffer = TRTRef<IRTBuffer>(Buffer);
		Resource.Current = Current;
	}
	FGraphResource& Resource = Impl->Resources[It->second];
	assert(Resource.Current == Current && "one buffer imported twice, in two states");
	Resource.After = After != ERTAccess::None ? After : Resource.After;
	return {It->second};
}

FGraphToken FFrameGraph::CreateToken(const char*) { return {Impl->TokenCount++}; }

const std::vector<FGraphSubmission>& FFrameGraph::GetSubmissions() const { return Impl->Submissions; }

void FFrameGraph::MarkHistory(FGraphTexture Texture)
{
	assert(Impl->Resources[Texture.Index].bImported);
	Impl->Resources[Texture.Index].bHistory = true;
}

void FFrameGraph::MarkHistory(FGraphBuffer Buffer)
{
	assert(Impl->Resources[Buffer.Index].bImported);
	Impl->Resources[Buffer.Index].bHistory = true;
}

void FFrameGraph::MarkForLater(FGraphTexture Texture, bool* OutWritten)
{
	FGraphResource& Resource = Impl->Resources[Texture.Index];
	assert(Resource.bTexture && Resource.bImported);
	Resource.bForLater = true;
	Resource.OutWritten = OutWritten;
}

void FFrameGraph::MarkForLater(FGraphBuffer Buffer, bool* OutWritten)
{
	FGraphResource& Resource = Impl->Resources[Buffer.Index];
	assert(!Resource.bTexture && Resource.bImported);
	Resource.bForLater = true;
	Resource.OutWritten = OutWritten;
}

void FFrameGraph::AddUsage(FGraphTexture Texture, ERTTextureUsage Usage)
{
	assert(!Impl->bCompiled && !Impl->Resources[Texture.Index].bImported);
	Impl->Resources[Texture.Index].TextureDesc.ExtraUsage |= Usage;
}

const FGraphTextureDesc& FFrameGraph::GetDesc(FGraphTexture Texture) const
{
	assert(Texture.Index < Impl->Resources.size() && Impl->Resources[Texture.Index].bTexture);
	return Impl->Resources[Texture.Index].TextureDesc;
}

const FGraphBufferDesc& FFrameGraph::GetDesc(FGraphBuffer Buffer) const
{
	assert(Buffer.Index < Impl->Resources.size() && !Impl->Resources[Buffer.Index].bTexture);
	return Impl->Resources[Buffer.Index].BufferDesc;
}

void FFrameGraph::AddPass(const char* Name, const std::function<FPassExecute(FPassBuilder&)>& Setup)
{
	assert(!Impl->bCompiled && "a compiled graph takes no more passes");
	FGraphPass Pass;
	Pass.Name = Name;
	FBuilder Builder(Pass, Impl->Resources);
	Pass.Execute = Setup(Builder);
	Impl->Passes.push_back(std::move(Pass));
}

FRTStatus FFrameGraph::Compile()
{
	if (Impl->bCompiled) { return Impl->CompileStatus; }
	Impl->bCompiled = true;
	Impl->CompileStatus = Impl->Validate();
	if (Impl->CompileStatus) { Impl->CompileStatus = Impl->AddPoison(); }
	if (Impl->CompileStatus)
	{
		Impl->Cull();
		Impl->AssignQueues();
		Impl->GatherGroups();
		Impl->FindLifetimes();
		Impl->CompileStatus = Impl->Allocate();
	}
	if (Impl->CompileStatus)
	{
		Impl->PlaceBarriers();
		Impl->OrderTokens();
	}
	return Impl->CompileStatus;
}

uint32_t FFrameGraph::GetPassCount() const { return static_cast<uint32_t>(Impl->Passes.size()); }

uint32_t FFrameGraph::GetCulledPassCount() const
{
	return static_cast<uint32_t>(
	    std::count_if(Impl->Passes.begin(), Impl->Passes.end(), [](const FGraphPass& Pass) { return Pass.bCulled; }));
}

} // namespace Lantern
