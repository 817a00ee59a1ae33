// Resources of the mock: buffers, textures, samplers, geometries and query pools.
#include "MockObjects.h"

#include "MockTexels.h"

#include <algorithm>
#include <cassert>
#include <cstring>

namespace Lantern
{

FMockBuffer::FMockBuffer(std::shared_ptr<FMockState> InState, const FRTBufferDesc& InDesc)
    : TMockObject(std::move(InState), "Buffer", InDesc.Name),
      Desc(InDesc)
{
	Desc.Name = Name.c_str();
	// calloc: the pages of large buffers that no test touches cost nothing.
	Bytes = static_cast<uint8_t*>(std::calloc(1, Desc.Size));
	Address = State->TakeAddress(Desc.Size);
	std::lock_guard Lock(State->Mutex);
	State->Buffers[Address] = this;
}

FMockBuffer::~FMockBuffer()
{
	std::free(Bytes);
	{
		std::lock_guard Lock(State->Mutex);
		State->Buffers.erase(Address);
	}
	if (Native.Released != nullptr) { Native.Released(Native.User); }
}

FMockTexture::FMockTexture(std::shared_ptr<FMockState> InState, const FRTTextureDesc& InDesc)
    : TMockObject(std::move(InState), "Texture", InDesc.Name),
      Desc(InDesc),
      Texels(static_cast<size_t>(InDesc.MipCount) * InDesc.ArraySize)
{
	Desc.Name = Name.c_str();
}

FMockTexture::~FMockTexture()
{
	std::lock_guard Lock(State->Mutex);
	if (Sampled != ~0u) { State->Sampled.Free(Sampled); }
	if (Storage != ~0u) { State->Storage.Free(Storage); }
}

uint64_t FMockTexture::GetSizeBytes(const FRTTextureDesc& Desc)
{
	uint64_t Sum = 0;
	for (uint32_t Mip = 0; Mip < Desc.MipCount; ++Mip)
	{
		Sum += std::max<uint64_t>(1, Desc.Width >> Mip) * std::max<uint64_t>(1, Desc.Height >> Mip);
	}
	const uint64_t Block = BytesPerBlock(Desc.Format);
	return Block != 0 ? (Sum * Desc.ArraySize * Block + 15) / 16 : Sum * Desc.ArraySize * BytesPerTexel(Desc.Format);
}

FRTStatus FMockTexture::SetExternalState(const FRTExternalState& From, const FRTExternalState& To)
{
	if (NativeImage == 0) { return FRTStatus::Error(ERTResult::InvalidArgument, "SetExternalState: it was not imported"); }
	// Without an API of its own, the mock knows of layouts that 0 is none.
	if (From.Layout == 0 || To.Layout == 0) { return FRTStatus::Error(ERTResult::InvalidArgument, "SetExternalState: Layout is 0"); }
	return FRTStatus::Success();
}

std::vector<uint8_t>& FMockTexture::GetTexels(uint32_t Mip, uint32_t Layer)
{
	assert(Mip < Desc.MipCount && Layer < Desc.ArraySize);
	std::vector<uint8_t>& Plane = Texels[static_cast<size_t>(Layer) * Desc.MipCount + Mip];
	if (Plane.empty()) { Plane.resize(static_cast<size_t>(GetWidth(Mip)) * GetHeight(Mip) * BytesPerTexel(Desc.Format)); }
	return Plane;
}

void FMockTexture::Clear(const float Value[4])
{
	const uint32_t Step = BytesPerTexel(Desc.Format);
	uint8_t Texel[16] = {};
	EncodeTexel(Desc.Format, Value, Texel);
	for (uint32_t Layer = 0; Layer < Desc.ArraySize; ++Layer)
	{
		for (uint32_t Mip = 0; Mip < Desc.MipCount; ++Mip)
		{
			std::vector<uint8_t>& Plane = GetTexels(Mip, Layer);
			for (size_t At = 0; At < Plane.size(); At += Step) { std::memcpy(Plane.data() + At, Texel, Step); }
		}
	}
}

void FMockTexture::GenerateMips()
{
	for (uint32_t Layer = 0; Layer < Desc.ArraySize; ++Layer)
	{
		for (uint32_t Mip = 1; Mip < Desc.MipCount; ++Mip)
		{
			const FTexelPlane Source{GetTexels(Mip - 1, Layer).data(), GetWidth(Mip - 1), GetHeight(Mip - 1)};
			const FTexelPlane Dest{GetTexels(Mip, Layer).data(), GetWidth(Mip), GetHeight(Mip)};
			FilterBox(Desc.Format, Source, Dest);
		}
	}
}

FMockSampler::~FMockSampler()
{
	std::lock_guard Lock(State->Mutex);
	State->Samplers.Free(Index);
}

FMockPipeline::~FMockPipeline()
{
	std::lock_guard Lock(State->Mutex);
	State->Pipelines.erase(Id);
}

uint64_t FMockGeometry::CountPrimitives(const FRTGeometrySection* Sections, uint32_t Count)
{
	uint64_t Sum = 0;
	for (uint32_t i = 0; i < Count; ++i) { Sum += Sections[i].bProcedural ? Sections[i].VertexCount : Sections[i].TriangleCount; }
	return Sum;
}

FRTBuildSizes FMockGeometry::ComputeSizes(const FRTGeometryDesc& Desc)
{
	const uint64_t Primitives = CountPrimitives(Desc.Sections, Desc.SectionCount);
	// About what drivers report (100 bytes per triangle); only the proportions matter.
	return {Desc.CompactedBytes ? Desc.CompactedBytes : AlignUp(256 + Primitives * 100, 256), AlignUp(256 + Primitives * 64, 256),
	    Desc.bAllowUpdate ? AlignUp(256 + Primitives * 16, 256) : 0};
}

FMockGeometry::FMockGeometry(std::shared_ptr<FMockState> InState, const FRTGeometryDesc& Desc)
    : TMockObject(std::move(InState), "Geometry", Desc.Name),
      SectionCount(Desc.SectionCount),
      bAllowUpdate(Desc.bAllowUpdate),
      bAllowCompaction(Desc.bAllowCompaction),
      CompactedBytes(Desc.CompactedBytes),
      Sizes(ComputeSizes(Desc))
{
	Address = State->TakeAddress(Sizes.StructureBytes);
	std::lock_guard Lock(State->Mutex);
	State->Geometries[Address] = this;
}

FMockGeometry::~FMockGeometry() { State->AddDeadGeometry(Address, Name); }

FMockScene::~FMockScene()
{
	std::lock_guard Lock(State->Mutex);
	State->Scenes.Free(Index);
}

bool FMockQueryPool::GetResults(uint32_t First, uint32_t Count, uint64_t* OutValues)
{
	assert(IsInside(First, Count, Values.size()));
	std::lock_guard Lock(State->Mutex);
	for (uint32_t i = 0; i < Count; ++i)
	{
		if (Values[First + i] == 0) { return false; }
		OutValues[i] = Values[First + i];
	}
	return true;
}

} // namespace Lantern
