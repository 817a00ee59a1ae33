// FMockDevice: creation of objects.
#include "LanternRHI/RTText.h"

#include "MockCommandList.h"
#include "MockDeviceImpl.h"
#include "MockShaderTable.h"
#include "MockTableHandle.h"

#include <algorithm>
#include <cassert>
#include <chrono>
#include <cstring>
#include <thread>

namespace Lantern
{
namespace
{

std::string GetShaderName(const FRTRayTracingPipelineDesc& Desc, uint32_t Index)
{
	if (Index == NoShader) { return {}; }
	assert(Index < Desc.ShaderCount);
	return Desc.Shaders[Index].Name ? Desc.Shaders[Index].Name : "";
}

std::vector<FMockGroup> MakeOwnGroups(const FRTRayTracingPipelineDesc& Desc)
{
	std::vector<FMockGroup> Groups;
	for (uint32_t i = 0; i < Desc.GroupCount; ++i)
	{
		const FRTShaderGroup& Group = Desc.Groups[i];
		FMockGroup& Mine = Groups.emplace_back();
		Mine.Kind = Group.Kind;
		Mine.General = GetShaderName(Desc, Group.General);
		Mine.ClosestHit = GetShaderName(Desc, Group.ClosestHit);
		Mine.AnyHit = GetShaderName(Desc, Group.AnyHit);
		Mine.Intersection = GetShaderName(Desc, Group.Intersection);
		if (Group.General != NoShader) { Mine.GeneralStage = Desc.Shaders[Group.General].Stage; }
	}
	return Groups;
}

/// Says whether drivers without bLibraryOnlyPipelines need the group in the link: from a library, it would see no push constants.
bool IsBoundToLink(const FMockGroup& Group)
{
	return Group.Kind == ERTGroupKind::General && Group.GeneralStage != ERTShaderStage::Callable;
}

std::vector<uint8_t> MakeHandles(const FMockPipeline& Pipeline, uint32_t HandleSize)
{
	std::vector<uint8_t> Handles(static_cast<size_t>(Pipeline.GetGroupCount()) * HandleSize);
	for (uint32_t Group = 0; Group < Pipeline.GetGroupCount(); ++Group)
	{
		const FMockHandle Handle(Pipeline.Id, Group);
		std::memcpy(Handles.data() + static_cast<size_t>(Group) * HandleSize, &Handle, sizeof(Handle));
	}
	return Handles;
}

} // namespace

FRTStatus FMockDevice::CreateBuffer(const FRTBufferDesc& Desc, IRTBuffer** Out)
{
	assert(Desc.Size > 0);
	FRTStatus Status =
	    Start(ERTMockCall::CreateBuffer, Desc.Name, {Desc.Size, static_cast<uint64_t>(Desc.Usage), static_cast<uint64_t>(Desc.Memory)});
	if (!Status) { return Status; }
	const EMockMemory Memory = HasAny(Desc.Usage, ERTBufferUsage::Scratch) ? EMockMemory::Scratch : EMockMemory::Buffer;
	Status = State->Allocate(Memory, Desc.Size, Desc.Name);
	if (!Status) { return Status; }
	auto Buffer = std::make_unique<FMockBuffer>(State, Desc);
	if (!Buffer->HasBytes())
	{
		State->FreeMemory(Memory, Desc.Size);
		return FRTStatus::Error(ERTResult::OutOfHostMemory, "%s: no host memory for %llu bytes", FRTShown(Desc.Name).Text,
		    static_cast<unsigned long long>(Desc.Size));
	}
	return Finish(*State, std::move(Buffer), Memory, Desc.Size, Out);
}

FRTStatus FMockDevice::ImportBuffer(const FRTBufferDesc& Desc, const FRTNativeBuffer& Native, IRTBuffer** Out)
{
	const FRTStatus Status = Start(ERTMockCall::ImportBuffer, Desc.Name, {Desc.Size, Native.Handle, Native.Address});
	if (!Status) { return Status; }
	auto Buffer = std::make_unique<FMockBuffer>(State, Desc);
	Buffer->Desc.Memory = ERTMemory::Device;
	Buffer->Native = Native;
	return Finish(*State, std::move(Buffer), EMockMemory::None, 0, Out);
}

FRTStatus FMockDevice::TakeIndices(const FRTTextureDesc& Desc, FMockTexture& Texture)
{
	std::lock_guard Lock(State->Mutex);
	const bool bSampled = HasAny(Desc.Usage, ERTTextureUsage::Sampled);
	const bool bStorage = HasAny(Desc.Usage, ERTTextureUsage::Storage);
	if (bSampled) { Texture.Sampled = State->Sampled.Allocate(); }
	if (bStorage) { Texture.Storage = State->Storage.Allocate(); }
	if ((bSampled && Texture.Sampled == FIndexAllocator::None) || (bStorage && Texture.Storage == FIndexAllocator::None))
	{
		return FRTStatus::Error(ERTResult::OutOfDescriptors, "%s: the bindless heap of %u textures is full", FRTShown(Desc.Name).Text,
		    State->Desc.MaxBindlessTextures);
	}
	return FRTStatus::Success();
}

FRTStatus FMockDevice::CreateTexture(const FRTTextureDesc& Desc, IRTTexture** Out)
{
	assert(Desc.Width && Desc.Height && Desc.MipCount && Desc.ArraySize && Desc.Format != ERTFormat::Unknown);
	FRTStatus Status =
	    Start(ERTMockCall::CreateTexture, Desc.Name, {Desc.Width, Desc.Height, Desc.MipCount, static_cast<uint64_t>(Desc.Format)});
	if (!Status) { return Status; }
	if (std::max(Desc.Width, Desc.Height) > State->Desc.MaxTextureDimension)
	{
		return FRTStatus::Error(ERTResult::Unsupported, "%s: %u x %u texels, the device allows %u", FRTShown(Desc.Name).Text, Desc.Width,
		    Desc.Height, State->Desc.MaxTextureDimension);
	}
	const uint64_t Bytes = FMockTexture::GetSizeBytes(Desc);
	Status = State->Allocate(EMockMemory::Texture, Bytes, Desc.Name);
	if (!Status) { return Status; }
	auto Texture = std::make_unique<FMockTexture>(State, Desc);
	Status = TakeIndices(Desc, *Texture);
	if (!Status)
	{
		State->FreeMemory(EMockMemory::Texture, Bytes);
		return Status;
	}
	return Finish(*State, std::move(Texture), EMockMemory::Texture, Bytes, Out);
}

FRTStatus FMockDevice::ImportTexture(const FRTTextureDesc& Desc, uint64_t NativeImage, IRTTexture** Out)
{
	FRTStatus Status = Start(ERTMockCall::ImportTexture, Desc.Name, {Desc.Width, Desc.Height, Desc.MipCount, NativeImage});
	if (!Status) { return Status; }
	auto Texture = std::make_unique<FMockTexture>(State, Desc);
	Texture->NativeImage = NativeImage;
	Status = TakeIndices(Desc, *Texture);
	return Status ? Finish(*State, std::move(Texture), EMockMemory::None, 0, Out) : Status;
}

FRTStatus FMockDevice::CreateSampler(const FRTSamplerDesc& Desc, IRTSampler** Out)
{
	FRTStatus Status = Start(ERTMockCall::CreateSampler, Desc.Name);
	if (!Status) { return Status; }
	uint32_t Index = 0;
	{
		std::lock_guard Lock(State->Mutex);
		Index = State->Samplers.Allocate();
		if (Index == FIndexAllocator::None)
		{
			return FRTStatus::Error(
			    ERTResult::OutOfDescriptors, "%s: the heap of %u samplers is full", FRTShown(Desc.Name).Text, State->Desc.MaxSamplers);
		}
	}
	auto Sampler = std::make_unique<FMockSampler>(State, "Sampler", Desc.Name);
	Sampler->Index = Index;
	return Finish(*State, std::move(Sampler), EMockMemory::None, 0, Out);
}

FRTStatus FMockDevice::CreateGeometry(const FRTGeometryDesc& Desc, IRTGeometry** Out)
{
	const uint64_t Primitives = FMockGeometry::CountPrimitives(Desc.Sections, Desc.SectionCount);
	FRTStatus Status =
	    Start(ERTMockCall::CreateGeometry, Desc.Name, {Desc.SectionCount, Primitives, Desc.bAllowUpdate ? 1u : 0u, Desc.CompactedBytes});
	if (!Status) { return Status; }
	if (State->Desc.Rung == ERTRung::None)
	{
		return FRTStatus::Error(ERTResult::Unsupported, "%s: the device has no acceleration structures", FRTShown(Desc.Name).Text);
	}
	const uint64_t Bytes = FMockGeometry::ComputeSizes(Desc).StructureBytes;
	Status = State->Allocate(EMockMemory::Geometry, Bytes, Desc.Name);
	if (!Status) { return Status; }
	return Finish(*State, std::make_unique<FMockGeometry>(State, Desc), EMockMemory::Geometry, Bytes, Out);
}

FRTStatus FMockDevice::CreateScene(const FRTSceneDesc& Desc, IRTScene** Out)
{
	FRTStatus Status = Start(ERTMockCall::CreateScene, Desc.Name, {Desc.MaxInstances});
	if (!Status) { return Status; }
	if (State->Desc.Rung == ERTRung::None)
	{
		return FRTStatus::Error(ERTResult::Unsupported, "%s: the device has no acceleration structures", FRTShown(Desc.Name).Text);
	}
	const uint64_t Bytes = AlignUp(256 + Desc.MaxInstances * 128ull, 256);
	Status = State->Allocate(EMockMemory::Scene, Bytes, Desc.Name);
	if (!Status) { return Status; }
	uint32_t Index = FIndexAllocator::None;
	{
		std::lock_guard Lock(State->Mutex);
		Index = State->Scenes.Allocate();
	}
	if (Index == FIndexAllocator::None)
	{
		State->FreeMemory(EMockMemory::Scene, Bytes);
		return FRTStatus::Error(
		    ERTResult::OutOfDescriptors, "%s: the heap of %u scenes is full", FRTShown(Desc.Name).Text, State->Desc.MaxScenes);
	}
	auto Scene = std::make_unique<FMockScene>(State, "Scene", Desc.Name);
	Scene->Index = Index;
	Scene->MaxInstances = Desc.MaxInstances;
	Scene->Sizes = {Bytes, AlignUp(256 + Desc.MaxInstances * 64ull, 256), 0};
	return Finish(*State, std::move(Scene), EMockMemory::Scene, Bytes, Out);
}

FRTStatus FMockDevice::CreateShaderTable(const FRTShaderTableDesc& Desc, IRTShaderTable** Out)
{
	assert(Desc.Pipeline && Desc.RecordDataBytes <= MaxRecordDataBytes);
	FRTStatus Status =
	    Start(ERTMockCall::CreateShaderTable, Desc.Name, {Desc.RayGenCount, Desc.MissCount, Desc.HitCount, Desc.CallableCount});
	if (!Status) { return Status; }
	auto Table = std::make_unique<FMockShaderTable>(State, Desc);
	if (Table->Pipeline->bLibrary) { State->AddError(Table->Name + ": made for the library " + Table->Pipeline->Name); }
	Status = Table->Allocate();
	return Status ? Finish(*State, std::move(Table), EMockMemory::None, 0, Out) : Status;
}

FRTStatus FMockDevice::CreateQueryPool(ERTQuery Kind, uint32_t Count, IRTQueryPool** Out)
{
	FRTStatus Status = Start(ERTMockCall::CreateQueryPool, "", {Count, static_cast<uint64_t>(Kind)});
	if (!Status) { return Status; }
	auto Pool = std::make_unique<FMockQueryPool>(State, "QueryPool", "");
	Pool->Kind = Kind;
	Pool->Values.resize(Count);
	return Finish(*State, std::move(Pool), EMockMemory::None, 0, Out);
}

FRTStatus FMockDevice::CreateCommandList(const char* Name, IRTCommandList** Out, ERTQueue Queue)
{
	FRTStatus Status = Start(ERTMockCall::CreateCommandList, Name, {uint64_t(Queue)});
	if (!Status) { return Status; }
	const bool bThere = Queue == ERTQueue::Graphics || (Queue == ERTQueue::Transfer && State->Desc.bTransferQueue) ||
	                    (Queue == ERTQueue::AsyncCompute && State->Desc.bAsyncComputeQueue);
	if (!bThere) { return FRTStatus::Error(ERTResult::Unsupported, "the device has no such queue (mock)"); }
	return Finish(*State, std::make_unique<FMockCommandList>(State, Name, 0, Queue), EMockMemory::None, 0, Out);
}

FRTStatus FMockDevice::ImportCommandList(uint64_t NativeCommandBuffer, IRTCommandList** Out)
{
	assert(NativeCommandBuffer);
	FRTStatus Status = Start(ERTMockCall::ImportCommandList, "", {NativeCommandBuffer});
	if (!Status) { return Status; }
	auto List = std::make_unique<FMockCommandList>(State, "imported", NativeCommandBuffer);
	return Finish(*State, std::move(List), EMockMemory::None, 0, Out);
}

// ------------------------------------------------------------------------------------------------ pipelines

FRTStatus FMockDevice::Compile(const char* Name)
{
	const std::string Whole = Name ? Name : "";
	const auto IsPart = [&](const std::string& Part) { return Whole.find(Part) != std::string::npos; };
	uint32_t Milliseconds = 0;
	std::unique_lock Lock(State->Mutex);
	for (const auto& [Part, Delay] : State->Slow) { Milliseconds += IsPart(Part) ? Delay : 0; }
	const bool bFail = std::any_of(State->Failing.begin(), State->Failing.end(), IsPart);
	const bool bStarved = std::any_of(State->Starved.begin(), State->Starved.end(), IsPart);
	const auto IsHeld = [&] { return std::any_of(State->Held.begin(), State->Held.end(), IsPart); };
	if (Milliseconds || IsHeld())
	{
		++State->CompilesInDriver;
		State->HoldEnded.wait(Lock, [&] { return !IsHeld(); });
		Lock.unlock();
		std::this_thread::sleep_for(std::chrono::milliseconds(Milliseconds));
		Lock.lock();
		--State->CompilesInDriver;
	}
	Lock.unlock();
	if (bFail) { return FRTStatus::Error(ERTResult::CompileFailed, "%s: compile failed (mock, injected)", Whole.c_str()); }
	if (bStarved) { return FRTStatus::Error(ERTResult::OutOfDeviceMemory, "%s: no device memory (mock, injected)", Whole.c_str()); }
	return FRTStatus::Success();
}

FRTStatus FMockDevice::CreateComputePipeline(const FRTComputePipelineDesc& Desc, IRTPipeline** Out)
{
	FRTStatus Status = Start(ERTMockCall::CreateComputePipeline, Desc.Name, {Desc.Shader.WordCount});
	if (Status) { Status = Compile(Desc.Name); }
	if (!Status) { return Status; }
	auto Pipeline = std::make_unique<FMockPipeline>(State, "Pipeline", Desc.Name);
	return Finish(*State, std::move(Pipeline), EMockMemory::None, 0, Out);
}

FRTStatus FMockDevice::CreateRasterPipeline(const FRTRasterPipelineDesc& Desc, IRTPipeline** Out)
{
	FRTStatus Status = Start(ERTMockCall::CreateRasterPipeline, Desc.Name, {Desc.ColorCount});
	if (Status) { Status = Compile(Desc.Name); }
	if (!Status) { return Status; }
	auto Pipeline = std::make_unique<FMockPipeline>(State, "Pipeline", Desc.Name);
	Pipeline->Kind = EMockPipeline::Raster;
	return Finish(*State, std::move(Pipeline), EMockMemory::None, 0, Out);
}

void FMockDevice::CheckLibrary(const FMockPipeline& Link, const FMockPipeline& Library)
{
	const std::string What = Link.Name + ": linked from " + Library.Name;
	if (!Library.bLibrary) { State->AddError(What + ", which is no library"); }
	if (Library.Interface != Link.Interface) { State->AddError(What + " of other recursion, payload or attribute sizes"); }
	const std::vector<FMockGroup>& Groups = *Library.Groups;
	if (!State->Capabilities.bLibraryOnlyPipelines && std::any_of(Groups.begin(), Groups.end(), IsBoundToLink))
	{
		State->AddError(What + " with ray generation or miss groups, which the device needs among the link's own");
	}
}

FRTStatus FMockDevice::CreateRayTracingPipeline(const FRTRayTracingPipelineDesc& Desc, IRTPipeline** Out)
{
	FRTStatus Status = Start(ERTMockCall::CreateRayTracingPipeline, Desc.Name,
	    {Desc.ShaderCount, Desc.GroupCount, Desc.MaxRecursion, Desc.MaxPayloadBytes, Desc.LibraryCount, Desc.bLibrary ? 1u : 0u});
	if (!Status) { return Status; }
	if (!State->Capabilities.bRayTracingPipeline)
	{
		return FRTStatus::Error(ERTResult::Unsupported, "%s: the device has no ray-tracing pipelines", FRTShown(Desc.Name).Text);
	}
	if ((Desc.bLibrary || Desc.LibraryCount) && !State->Capabilities.bPipelineLibraries)
	{
		return FRTStatus::Error(ERTResult::Unsupported, "%s: the device has no pipeline libraries", FRTShown(Desc.Name).Text);
	}
	assert(!Desc.bLibrary || (Desc.ShaderCount && !Desc.LibraryCount));
	Status = Compile(Desc.Name);
	if (!Status) { return Status; }
	auto Pipeline = std::make_unique<FMockPipeline>(State, Desc.bLibrary ? "Library" : "Pipeline", Desc.Name);
	Pipeline->Kind = EMockPipeline::RayTracing;
	Pipeline->bLibrary = Desc.bLibrary;
	Pipeline->Interface = {Desc.MaxRecursion, Desc.MaxPayloadBytes, Desc.MaxAttributeBytes};
	std::vector<FMockGroup> Groups = MakeOwnGroups(Desc);
	for (uint32_t i = 0; i < Desc.LibraryCount; ++i)
	{
		const auto* Library = static_cast<const FMockPipeline*>(Desc.Libraries[i]);
		assert(Library && Library->Kind == EMockPipeline::RayTracing);
		CheckLibrary(*Pipeline, *Library);
		Groups.insert(Groups.end(), Library->Groups->begin(), Library->Groups->end());
	}
	Pipeline->Groups = std::make_shared<const std::vector<FMockGroup>>(std::move(Groups));
	{
		std::lock_guard Lock(State->Mutex);
		Pipeline->Id = State->NextPipeline++;
		State->Pipelines[Pipeline->Id] = Pipeline->Name;
	}
	Pipeline->Handles = MakeHandles(*Pipeline, State->Desc.HandleSize);
	return Finish(*State, std::move(Pipeline), EMockMemory::None, 0, Out);
}

} // namespace Lantern
