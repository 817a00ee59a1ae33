// Pipelines without real shaders, for tests on the mock. The device may be wrapped.
#pragma once

#include "LanternRHIMock/MockDevice.h"
#include "RHIMaker.h"

#include <utility>

namespace Lantern
{

inline constexpr uint32_t DummyWords[] = {0x07230203, 0x00010500, 0, 1, 0};

struct FMockMaker : FRHIMaker
{
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
		    {ERTShaderStage::RayGen, "RayGen"},
		    {ERTShaderStage::Miss, "Miss"},
		    {ERTShaderStage::ClosestHit, "Stone"},
		    {ERTShaderStage::ClosestHit, "Leaf"},
		    {ERTShaderStage::AnyHit, "LeafMask"},
		    {ERTShaderStage::Callable, "Light"},
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
	/// Creates a library with one group, whose one shader has the library's name.
	FRTStatus CreateLibrary(const char* Name, ERTShaderStage Stage, uint32_t PayloadBytes, TRTRef<IRTPipeline>& Out) const
	{
		const bool bHit = Stage == ERTShaderStage::ClosestHit;
		const FRTShaderCode Shader = {DummyWords, std::size(DummyWords), Stage, Name};
		FRTShaderGroup Group;
		Group.Kind = bHit ? ERTGroupKind::Triangles : ERTGroupKind::General;
		(bHit ? Group.ClosestHit : Group.General) = 0;
		FRTRayTracingPipelineDesc Desc;
		Desc.Shaders = &Shader;
		Desc.ShaderCount = 1;
		Desc.Groups = &Group;
		Desc.GroupCount = 1;
		Desc.bLibrary = true;
		Desc.MaxPayloadBytes = PayloadBytes;
		Desc.Name = Name;
		return Device->CreateRayTracingPipeline(Desc, Out.ReleaseAndGetAddress());
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
};

} // namespace Lantern
