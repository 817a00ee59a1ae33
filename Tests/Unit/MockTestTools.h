// Objects that tests on the mock need again and again. The device may be wrapped.
#pragma once

#include "LanternRHIMock/MockDevice.h"

#include <cstring>
#include <gtest/gtest.h>
#include <utility>

namespace Lantern
{

#define ASSERT_OK(Call)                                                                                                \
	do                                                                                                                 \
	{                                                                                                                  \
		const FRTStatus StatusOfCall = (Call);                                                                         \
		ASSERT_TRUE(StatusOfCall.IsOk()) << StatusOfCall.Message;                                                      \
	} while (false)
#define EXPECT_OK(Call)                                                                                                \
	do                                                                                                                 \
	{                                                                                                                  \
		const FRTStatus StatusOfCall = (Call);                                                                         \
		EXPECT_TRUE(StatusOfCall.IsOk()) << StatusOfCall.Message;                                                      \
	} while (false)

inline constexpr uint32_t DummyWords[] = {0x07230203, 0x00010500, 0, 1, 0};

inline constexpr ERTBufferUsage AnyUsage = ERTBufferUsage::Storage | ERTBufferUsage::Index |
                                           ERTBufferUsage::CopySource | ERTBufferUsage::CopyDest |
                                           ERTBufferUsage::GeometryInput;

/// Makes objects of one device; failures are test failures and null.
struct FMockMaker
{
	TRTRef<IRTDevice> Device;

	TRTRef<IRTBuffer> Buffer(uint64_t Size, ERTMemory Memory = ERTMemory::Device, const char* Name = "Buffer",
	                         ERTBufferUsage Usage = AnyUsage) const
	{
		TRTRef<IRTBuffer> Out;
		EXPECT_OK(Device->CreateBuffer({Size, Usage, Memory, Name}, Out.ReleaseAndGetAddress()));
		return Out;
	}
	TRTRef<IRTBuffer> Scratch(uint64_t Size = 1 << 20) const
	{
		return Buffer(Size, ERTMemory::Device, "Scratch", ERTBufferUsage::Scratch);
	}
	TRTRef<IRTTexture> Texture(uint32_t Width, uint32_t Height, ERTFormat Format, uint32_t Mips = 1,
	                           ERTTextureUsage Usage = ERTTextureUsage::Sampled | ERTTextureUsage::CopySource |
	                                                   ERTTextureUsage::CopyDest,
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
	TRTRef<IRTPipeline> Compute(const char* Name = "Compute") const
	{
		FRTComputePipelineDesc Desc;
		Desc.Shader = {DummyWords, std::size(DummyWords), ERTShaderStage::Compute, Name};
		Desc.Name = Name;
		TRTRef<IRTPipeline> Out;
		EXPECT_OK(Device->CreateComputePipeline(Desc, Out.ReleaseAndGetAddress()));
		return Out;
	}
	/// Groups: 0 ray generation, 1 miss, 2 hit "Stone", 3 hit "Leaf" with any-hit, 4 callable, 5 procedural.
	TRTRef<IRTPipeline> RayTracing(const char* Name = "RTPSO") const
	{
		const std::pair<ERTShaderStage, const char*> Stages[] = {
		    {ERTShaderStage::RayGen, "RayGen"},       {ERTShaderStage::Miss, "Miss"},
		    {ERTShaderStage::ClosestHit, "Stone"},    {ERTShaderStage::ClosestHit, "Leaf"},
		    {ERTShaderStage::AnyHit, "LeafMask"},     {ERTShaderStage::Callable, "Light"},
		    {ERTShaderStage::Intersection, "Sphere"},
		};
		FRTShaderCode Shaders[std::size(Stages)];
		for (size_t i = 0; i < std::size(Stages); ++i)
		{
			Shaders[i] = {DummyWords, std::size(DummyWords), Stages[i].first, Stages[i].second};
		}
		FRTShaderGroup Groups[6];
		Groups[0].General = 0;
		Groups[1].General = 1;
		Groups[2].Kind = Groups[3].Kind = ERTGroupKind::Triangles;
		Groups[2].ClosestHit = 2;
		Groups[3].ClosestHit = 3;
		Groups[3].AnyHit = 4;
		Groups[4].General = 5;
		Groups[5].Kind = ERTGroupKind::Procedural;
		Groups[5].Intersection = 6;
		FRTRayTracingPipelineDesc Desc;
		Desc.Shaders = Shaders;
		Desc.ShaderCount = static_cast<uint32_t>(std::size(Shaders));
		Desc.Groups = Groups;
		Desc.GroupCount = static_cast<uint32_t>(std::size(Groups));
		Desc.Name = Name;
		TRTRef<IRTPipeline> Out;
		EXPECT_OK(Device->CreateRayTracingPipeline(Desc, Out.ReleaseAndGetAddress()));
		return Out;
	}
	TRTRef<IRTShaderTable> Table(IRTPipeline* Pipeline, uint32_t HitCount, uint32_t DataBytes = 0) const
	{
		FRTShaderTableDesc Desc;
		Desc.Pipeline = Pipeline;
		Desc.MissCount = 1;
		Desc.HitCount = HitCount;
		Desc.CallableCount = 1;
		Desc.RecordDataBytes = DataBytes;
		Desc.Name = "Table";
		TRTRef<IRTShaderTable> Out;
		EXPECT_OK(Device->CreateShaderTable(Desc, Out.ReleaseAndGetAddress()));
		return Out;
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
	TRTRef<IRTGeometry> Geometry(const FRTGeometrySection& Item, const char* Name = "Geometry",
	                             bool bUpdate = false) const
	{
		FRTGeometryDesc Desc;
		Desc.Sections = &Item;
		Desc.SectionCount = 1;
		Desc.bAllowUpdate = bUpdate;
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
	static void Build(IRTCommandList* List, IRTGeometry* Geometry, const FRTGeometrySection& Section,
	                  IRTBuffer* Scratch, bool bUpdate = false, uint64_t Offset = 0)
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
