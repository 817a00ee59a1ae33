// Objects that tests of the RHI need again and again, on any device.
#pragma once

#include "LanternRHI/RTInterfaces.h"
#include "Support/StatusChecks.h"

#include <cstring>
#include <gtest/gtest.h>

namespace Lantern
{

inline constexpr ERTBufferUsage AnyUsage =
    ERTBufferUsage::Storage | ERTBufferUsage::Index | ERTBufferUsage::CopySource | ERTBufferUsage::CopyDest | ERTBufferUsage::GeometryInput;

/// Makes objects of one device; failures are test failures and null.
struct FRHIMaker
{
	TRTRef<IRTDevice> Device;

	TRTRef<IRTBuffer> Buffer(
	    uint64_t Size, ERTMemory Memory = ERTMemory::Device, const char* Name = "Buffer", ERTBufferUsage Usage = AnyUsage) const
	{
		TRTRef<IRTBuffer> Out;
		EXPECT_OK(Device->CreateBuffer({Size, Usage, Memory, Name}, Out.ReleaseAndGetAddress()));
		return Out;
	}
	TRTRef<IRTBuffer> Scratch(uint64_t Size = 1 << 20) const { return Buffer(Size, ERTMemory::Device, "Scratch", ERTBufferUsage::Scratch); }
	TRTRef<IRTTexture> Texture(uint32_t Width, uint32_t Height, ERTFormat Format, uint32_t Mips = 1,
	    ERTTextureUsage Usage = ERTTextureUsage::Sampled | ERTTextureUsage::CopySource | ERTTextureUsage::CopyDest,
	    const char* Name = "Texture") const
	{
		FRTTextureDesc Desc;
		Desc.Width = Width;
		Desc.Height = Height;
		Desc.MipCount = Mips;
		Desc.Format = Format;
		Desc.Usage = Usage;
		Desc.Name = Name;
		TRTRef<IRTTexture> Out;
		EXPECT_OK(Device->CreateTexture(Desc, Out.ReleaseAndGetAddress()));
		return Out;
	}
	TRTRef<IRTCommandList> List(const char* Name = "List") const
	{
		TRTRef<IRTCommandList> Out;
		EXPECT_OK(Device->CreateCommandList(Name, Out.ReleaseAndGetAddress()));
		EXPECT_OK(Out->Begin());
		return Out;
	}
	FRTFence Submit(IRTCommandList* List) const
	{
		FRTFence Fence = 0;
		EXPECT_OK(List->End());
		EXPECT_OK(Device->Submit(&List, 1, &Fence));
		return Fence;
	}
	/// One triangle in each section.
	FRTGeometrySection Section(IRTBuffer* Vertices, IRTBuffer* Indices = nullptr) const
	{
		FRTGeometrySection Item;
		Item.Vertices = Vertices;
		Item.VertexCount = 3;
		Item.Indices = Indices;
		Item.TriangleCount = 1;
		Item.IndexType = Indices ? ERTIndexType::UInt32 : ERTIndexType::None;
		return Item;
	}
	TRTRef<IRTGeometry> Geometry(const FRTGeometrySection& Item, const char* Name = "Geometry", bool bUpdate = false) const
	{
		return CompactableGeometry(Item, Name, 0, false, bUpdate);
	}
	/// Bytes: size of a compacted copy; 0: not for one.
	TRTRef<IRTGeometry> CompactableGeometry(
	    const FRTGeometrySection& Item, const char* Name, uint64_t Bytes = 0, bool bCompaction = true, bool bUpdate = false) const
	{
		FRTGeometryDesc Desc;
		Desc.Sections = &Item;
		Desc.SectionCount = 1;
		Desc.bAllowUpdate = bUpdate;
		Desc.bAllowCompaction = bCompaction;
		Desc.CompactedBytes = Bytes;
		Desc.Name = Name;
		TRTRef<IRTGeometry> Out;
		EXPECT_OK(Device->CreateGeometry(Desc, Out.ReleaseAndGetAddress()));
		return Out;
	}
	TRTRef<IRTScene> Scene(uint32_t MaxInstances = 8) const
	{
		TRTRef<IRTScene> Out;
		EXPECT_OK(Device->CreateScene({MaxInstances, false, "Scene"}, Out.ReleaseAndGetAddress()));
		return Out;
	}
	static FRTInstance Instance(uint64_t Address, uint32_t TableOffset = 0)
	{
		FRTInstance Item = {};
		Item.Transform[0] = Item.Transform[5] = Item.Transform[10] = 1.0f;
		Item.CustomIndexAndMask = 0xff000000u;
		Item.TableOffsetAndFlags = TableOffset;
		Item.GeometryAddress = Address;
		return Item;
	}
	static void Build(IRTCommandList* List, IRTGeometry* Geometry, const FRTGeometrySection& Section, IRTBuffer* Scratch,
	    bool bUpdate = false, uint64_t Offset = 0)
	{
		FRTGeometryBuild Item;
		Item.Geometry = Geometry;
		Item.Sections = &Section;
		Item.SectionCount = 1;
		Item.bUpdate = bUpdate;
		Item.Scratch = Scratch;
		Item.ScratchOffset = Offset;
		List->BuildGeometries(&Item, 1);
	}
	static void BuildBarrier(IRTCommandList* List)
	{
		FRTBarrier Item;
		Item.Before = ERTAccess::BuildWrite;
		Item.After = ERTAccess::BuildRead | ERTAccess::BuildWrite | ERTAccess::TraceRead;
		List->Barriers(&Item, 1);
	}
};

} // namespace Lantern
