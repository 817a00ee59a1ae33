// FVulkanCommandList: recording, barriers, pipelines, raster passes, queries and copies.
#include "Commands/VulkanCommandList.h"

#include <algorithm>
#include <cassert>
#include <cstring>

namespace Lantern
{
namespace
{

VkBuffer NativeOf(IRTBuffer* Buffer) { return static_cast<FVulkanBuffer*>(Buffer)->GetHandle(); }

/// One mip of one layer, rows tightly packed.
VkBufferImageCopy RegionOf(const FRTTextureDesc& Desc, uint32_t Mip, uint32_t Layer, uint64_t Offset)
{
	assert(Mip < Desc.MipCount && Layer < Desc.ArraySize);
	VkBufferImageCopy Region{};
	Region.bufferOffset = Offset;
	Region.imageSubresource = {AspectOf(Desc.Format), Mip, Layer, 1};
	Region.imageExtent = {std::max(Desc.Width >> Mip, 1u), std::max(Desc.Height >> Mip, 1u), 1};
	return Region;
}

} // namespace

// ------------------------------------------------------------------------------------------------ recording

FRTStatus FVulkanCommandList::Initialise(const char* InName, ERTQueue InQueue)
{
	Queue = InQueue;
	Name = InName ? InName : "";
	VkCommandPoolCreateInfo PoolInfo{VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO};
	PoolInfo.flags = VK_COMMAND_POOL_CREATE_TRANSIENT_BIT;
	PoolInfo.queueFamilyIndex = Device.Queues[static_cast<size_t>(Queue)].Family;
	VkResult Result = Device.Check(Device.Api.CreateCommandPool(Device.Handle, &PoolInfo, nullptr, &Pool));
	if (Result != VK_SUCCESS)
	{
		Pool = VK_NULL_HANDLE;
		return MakeStatus(Result, "Creating the command pool of", Name.c_str());
	}
	VkCommandBufferAllocateInfo Info{VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO};
	Info.commandPool = Pool;
	Info.level = VK_COMMAND_BUFFER_LEVEL_PRIMARY;
	Info.commandBufferCount = 1;
	Result = Device.Check(Device.Api.AllocateCommandBuffers(Device.Handle, &Info, &Handle));
	if (Result == VK_SUCCESS) { Device.SetName(VK_OBJECT_TYPE_COMMAND_BUFFER, ToNative(Handle), Name.c_str()); }
	return MakeStatus(Result, "Allocating the command buffer of", Name.c_str());
}

void FVulkanCommandList::InitialiseImported(VkCommandBuffer Buffer)
{
	bImported = true;
	Handle = Buffer;
}

FVulkanCommandList::~FVulkanCommandList()
{
	ReleaseKept();
	if (Pool) { Device.Api.DestroyCommandPool(Device.Handle, Pool, nullptr); }
}

void FVulkanCommandList::Keep(IRTRefCounted* Object)
{
	if (Object && Kept.insert(Object).second) { Object->AddRef(); }
}

void FVulkanCommandList::KeepAlive(IRTRefCounted* Object) { Keep(Object); }

void FVulkanCommandList::ReleaseKept()
{
	for (IRTRefCounted* Object : Kept) { Object->Release(); }
	Kept.clear();
}

FVulkanKept FVulkanCommandList::TakeKept(FRTFence InFence)
{
	Fence = InFence;
	for (const auto& [Queries, Index] : QueriesWritten) { Queries->NoteWrite(Index, InFence); }
	QueriesWritten.clear();
	if (bImported) { ListMemory.Release(); } // nothing says when it begins again
	FVulkanKept Result;
	Result.swap(Kept);
	return Result;
}

FRTStatus FVulkanCommandList::Begin()
{
	assert(!bImported);
	if (Device.IsLost()) { return Device.LostStatus(); }
	assert(Fence <= Device.GetCompletedFence(Queue) && "Begin before the last submission has finished");
	ReleaseKept();
	Error = {};
	Bound = nullptr;
	SetBoundPoints = 0;
	PushedBytes = 0;
	QueriesWritten.clear();
	ListMemory.Begin();
	VkResult Result = Device.Check(Device.Api.ResetCommandPool(Device.Handle, Pool, 0));
	VkCommandBufferBeginInfo Info{VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO};
	Info.flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT;
	Result = Result ? Result : Device.Check(Device.Api.BeginCommandBuffer(Handle, &Info));
	return MakeStatus(Result, "Beginning command list", Name.c_str());
}

FRTStatus FVulkanCommandList::End()
{
	assert(!bImported);
	if (Device.IsLost()) { return Device.LostStatus(); }
	const VkResult Result = Device.Check(Device.Api.EndCommandBuffer(Handle));
	return Error ? MakeStatus(Result, "Ending command list", Name.c_str()) : Error;
}

FVulkanAccess FVulkanCommandList::GetAccess(ERTAccess Access) const
{
	const FVulkanAccess All = AccessOf(Access, Device.Bits);
	return Queue == ERTQueue::Graphics ? All : ForComputeQueue(All);
}

void FVulkanCommandList::Barrier(const FVulkanAccess& Before, const FVulkanAccess& After)
{
	VkMemoryBarrier2 Memory{VK_STRUCTURE_TYPE_MEMORY_BARRIER_2};
	Memory.srcStageMask = Before.Stages;
	Memory.srcAccessMask = Before.Access;
	Memory.dstStageMask = After.Stages;
	Memory.dstAccessMask = After.Access;
	VkDependencyInfo Info{VK_STRUCTURE_TYPE_DEPENDENCY_INFO};
	Info.memoryBarrierCount = 1;
	Info.pMemoryBarriers = &Memory;
	Device.Api.CmdPipelineBarrier2(Handle, &Info);
}

void FVulkanCommandList::Barriers(const FRTBarrier* Items, uint32_t Count)
{
	// Buffers get a global memory barrier: no driver makes a buffer's barrier finer than that.
	VkMemoryBarrier2 Memory{VK_STRUCTURE_TYPE_MEMORY_BARRIER_2};
	std::vector<VkImageMemoryBarrier2> Images;
	for (uint32_t Index = 0; Index < Count; ++Index)
	{
		const FRTBarrier& Item = Items[Index];
		assert(!(Item.Buffer && Item.Texture));
		// What happened on another queue is ordered and visible by the semaphore; its stages may be unknown to this queue.
		const FVulkanAccess Before = Item.bOtherQueue ? FVulkanAccess{VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT, 0} : GetAccess(Item.Before);
		const FVulkanAccess After = GetAccess(Item.After);
		if (!Item.Texture)
		{
			Keep(Item.Buffer);
			Memory.srcStageMask |= Before.Stages;
			Memory.srcAccessMask |= Before.Access;
			Memory.dstStageMask |= After.Stages;
			Memory.dstAccessMask |= After.Access;
			continue;
		}
		Keep(Item.Texture);
		const FVulkanTexture* Texture = static_cast<const FVulkanTexture*>(Item.Texture);
		VkImageMemoryBarrier2 Image{VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER_2};
		// Contents are dropped, but whoever used the memory last must be done with it.
		Image.srcStageMask = Item.Before == ERTAccess::None ? VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT : Before.Stages;
		Image.srcAccessMask = Before.Access;
		Image.dstStageMask = After.Stages;
		Image.dstAccessMask = After.Access;
		Image.oldLayout = GetVulkanLayout(Item.Before);
		Image.newLayout = GetVulkanLayout(Item.After);
		if (Item.Before == ERTAccess::External)
		{
			Texture->GetExternalState(0).ApplyTo(Image.srcStageMask, Image.srcAccessMask, Image.oldLayout);
		}
		if (Item.After == ERTAccess::External)
		{
			Texture->GetExternalState(1).ApplyTo(Image.dstStageMask, Image.dstAccessMask, Image.newLayout);
		}
		Image.srcQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
		Image.dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
		Image.image = Texture->GetImage();
		Image.subresourceRange = {AllAspectsOf(Texture->GetDesc().Format), 0, VK_REMAINING_MIP_LEVELS, 0, VK_REMAINING_ARRAY_LAYERS};
		Images.push_back(Image);
	}
	VkDependencyInfo Info{VK_STRUCTURE_TYPE_DEPENDENCY_INFO};
	Info.memoryBarrierCount = Memory.srcStageMask || Memory.dstStageMask ? 1 : 0;
	Info.pMemoryBarriers = &Memory;
	Info.imageMemoryBarrierCount = static_cast<uint32_t>(Images.size());
	Info.pImageMemoryBarriers = Images.data();
	if (Info.memoryBarrierCount || Info.imageMemoryBarrierCount) { Device.Api.CmdPipelineBarrier2(Handle, &Info); }
}

// ------------------------------------------------------------------------------------------------ pipelines

void FVulkanCommandList::SetPipeline(IRTPipeline* Pipeline)
{
	Keep(Pipeline);
	Bound = static_cast<FVulkanPipeline*>(Pipeline);
	Device.Api.CmdBindPipeline(Handle, Bound->BindPoint, Bound->Handle);
	const uint32_t Bit = Bound->BindPoint == VK_PIPELINE_BIND_POINT_RAY_TRACING_KHR ? 4u : 1u << static_cast<uint32_t>(Bound->BindPoint);
	// In an engine's command buffer other sets may have been bound since.
	if (bImported || !(SetBoundPoints & Bit))
	{
		Device.Api.CmdBindDescriptorSets(Handle, Bound->BindPoint, Device.Bindless.PipelineLayout, 0, 1, &Device.Bindless.Set, 0, nullptr);
		SetBoundPoints |= Bit;
	}
}

void FVulkanCommandList::PushConstants(const void* Data, uint32_t Size)
{
	assert(Bound && Size % 4 == 0 && Size <= Device.GetCapabilities().MaxPushConstantBytes);
	Device.Api.CmdPushConstants(Handle, Device.Bindless.PipelineLayout, AllStages(Device.Bits), 0, Size, Data);
	const uint32_t Remembered = std::min<uint32_t>(Size, sizeof(Pushed));
	memcpy(Pushed, Data, Remembered);
	PushedBytes = std::max(PushedBytes, Remembered);
}

void FVulkanCommandList::Dispatch(uint32_t GroupsX, uint32_t GroupsY, uint32_t GroupsZ)
{
	assert(Bound && Bound->BindPoint == VK_PIPELINE_BIND_POINT_COMPUTE);
	Device.Api.CmdDispatch(Handle, GroupsX, GroupsY, GroupsZ);
}

void FVulkanCommandList::DispatchIndirect(IRTBuffer* Arguments, uint64_t Offset)
{
	assert(Bound && Bound->BindPoint == VK_PIPELINE_BIND_POINT_COMPUTE && Offset % 4 == 0);
	Keep(Arguments);
	Device.Api.CmdDispatchIndirect(Handle, NativeOf(Arguments), Offset);
}

// ------------------------------------------------------------------------------------------------ raster

void FVulkanCommandList::BeginRasterPass(const FRTRasterPassDesc& Desc)
{
	std::vector<VkRenderingAttachmentInfo> Colors(Desc.ColorCount);
	for (uint32_t Index = 0; Index < Desc.ColorCount; ++Index)
	{
		const FRTColorTarget& Target = Desc.Colors[Index];
		Keep(Target.Texture);
		VkRenderingAttachmentInfo& Color = Colors[Index];
		Color = {VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO};
		Color.imageView = static_cast<FVulkanTexture*>(Target.Texture)->GetAttachmentView();
		Color.imageLayout = GetVulkanLayout(ERTAccess::RenderTarget);
		Color.loadOp = Target.bClear ? VK_ATTACHMENT_LOAD_OP_CLEAR : VK_ATTACHMENT_LOAD_OP_LOAD;
		Color.storeOp = VK_ATTACHMENT_STORE_OP_STORE;
		for (uint32_t Channel = 0; Channel < 4; ++Channel)
		{
			if (IsIntegerFormat(Target.Texture->GetDesc().Format))
			{
				Color.clearValue.color.uint32[Channel] = static_cast<uint32_t>(Target.Clear[Channel]);
			}
			else { Color.clearValue.color.float32[Channel] = Target.Clear[Channel]; }
		}
	}
	VkRenderingAttachmentInfo Depth{VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO};
	if (Desc.Depth)
	{
		Keep(Desc.Depth);
		Depth.imageView = static_cast<FVulkanTexture*>(Desc.Depth)->GetAttachmentView();
		Depth.imageLayout = GetVulkanLayout(ERTAccess::DepthWrite);
		Depth.loadOp = Desc.bClearDepth ? VK_ATTACHMENT_LOAD_OP_CLEAR : VK_ATTACHMENT_LOAD_OP_LOAD;
		Depth.storeOp = VK_ATTACHMENT_STORE_OP_STORE;
		Depth.clearValue.depthStencil = {Desc.ClearDepth, 0};
	}
	VkRenderingInfo Info{VK_STRUCTURE_TYPE_RENDERING_INFO};
	Info.renderArea.extent = {Desc.Width, Desc.Height};
	Info.layerCount = 1;
	Info.colorAttachmentCount = Desc.ColorCount;
	Info.pColorAttachments = Colors.data();
	Info.pDepthAttachment = Desc.Depth ? &Depth : nullptr;
	Device.Api.CmdBeginRendering(Handle, &Info);
	const VkViewport Viewport = {0.0f, 0.0f, static_cast<float>(Desc.Width), static_cast<float>(Desc.Height), 0.0f, 1.0f};
	Device.Api.CmdSetViewport(Handle, 0, 1, &Viewport);
	Device.Api.CmdSetScissor(Handle, 0, 1, &Info.renderArea);
}

void FVulkanCommandList::EndRasterPass() { Device.Api.CmdEndRendering(Handle); }

void FVulkanCommandList::SetIndexBuffer(IRTBuffer* Buffer, uint64_t Offset, ERTIndexType Type)
{
	assert(Type != ERTIndexType::None);
	Keep(Buffer);
	Device.Api.CmdBindIndexBuffer(
	    Handle, NativeOf(Buffer), Offset, Type == ERTIndexType::UInt16 ? VK_INDEX_TYPE_UINT16 : VK_INDEX_TYPE_UINT32);
}

void FVulkanCommandList::Draw(uint32_t VertexCount, uint32_t InstanceCount)
{
	Device.Api.CmdDraw(Handle, VertexCount, InstanceCount, 0, 0);
}

void FVulkanCommandList::DrawIndexed(uint32_t IndexCount, uint32_t InstanceCount, uint32_t FirstIndex, int32_t VertexOffset)
{
	Device.Api.CmdDrawIndexed(Handle, IndexCount, InstanceCount, FirstIndex, VertexOffset, 0);
}

// ------------------------------------------------------------------------------------------------ queries, markers

void FVulkanCommandList::WriteTimestamp(IRTQueryPool* Queries, uint32_t Index)
{
	Keep(Queries);
	if (Device.GetCapabilities().bTimestamps)
	{
		FVulkanQueryPool* Native = static_cast<FVulkanQueryPool*>(Queries);
		QueriesWritten.push_back({Native, Index});
		Device.Api.CmdWriteTimestamp2(Handle, VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT, Native->Handle, Index);
	}
}

void FVulkanCommandList::ResetQueries(IRTQueryPool* Queries, uint32_t First, uint32_t Count)
{
	Keep(Queries);
	FVulkanQueryPool* Native = static_cast<FVulkanQueryPool*>(Queries);
	Native->NoteReset(First, Count);
	Device.Api.CmdResetQueryPool(Handle, Native->Handle, First, Count);
}

void FVulkanCommandList::BeginMarker(const char* MarkerName)
{
	if (Device.Instance->bDebugUtils)
	{
		VkDebugUtilsLabelEXT Label{VK_STRUCTURE_TYPE_DEBUG_UTILS_LABEL_EXT};
		Label.pLabelName = MarkerName;
		Device.Instance->Api.CmdBeginDebugUtilsLabelEXT(Handle, &Label);
	}
}

void FVulkanCommandList::EndMarker()
{
	if (Device.Instance->bDebugUtils) { Device.Instance->Api.CmdEndDebugUtilsLabelEXT(Handle); }
}

uint64_t FVulkanCommandList::GetNative(ERTNative Kind) const
{
	switch (Kind)
	{
	case ERTNative::CommandBuffer: return ToNative(Handle);
	case ERTNative::Device: return ToNative(Device.Handle);
	default: return 0;
	}
}

// ------------------------------------------------------------------------------------------------ copies

void FVulkanCommandList::CopyBuffer(IRTBuffer* Dest, uint64_t DestOffset, IRTBuffer* Source, uint64_t SourceOffset, uint64_t Size)
{
	const FRTBufferRegion Region{DestOffset, SourceOffset, Size};
	CopyBufferRegions(Dest, Source, &Region, 1);
}

void FVulkanCommandList::CopyBufferRegions(IRTBuffer* Dest, IRTBuffer* Source, const FRTBufferRegion* Regions, uint32_t Count)
{
	Keep(Dest);
	Keep(Source);
	const uint64_t Addresses = Dest->GetDeviceAddress() | Source->GetDeviceAddress();
	const bool bHasAddresses = Dest->GetDeviceAddress() != 0 && Source->GetDeviceAddress() != 0 && Addresses % 4 == 0;
	FVulkanRegions Parts(Regions, Count, Queue != ERTQueue::Transfer && bHasAddresses);
	FVulkanListMemory::FSlice Items;
	if (Parts.GetMostItems() > 0 && !ListMemory.Allocate(Device, sizeof(FVulkanScatter::FRegion) * Parts.GetMostItems(), Items))
	{
		Parts = FVulkanRegions(Regions, Count, false); // slower, and needs no memory
	}
	// To the caller a scatter is a copy: what it waits for, and what waits for it, waits for copies.
	const bool bScatter = Parts.GetMostItems() > 0;
	const FVulkanAccess Copy = GetAccess(ERTAccess::CopyRead | ERTAccess::CopyWrite);
	if (bScatter) { Barrier(Copy, ScatterAccess); }
	const std::vector<VkBufferCopy>& Copies = Parts.GetCopies();
	if (!Copies.empty())
	{
		Device.Api.CmdCopyBuffer(Handle, NativeOf(Source), NativeOf(Dest), static_cast<uint32_t>(Copies.size()), Copies.data());
	}
	if (bScatter)
	{
		ScatterItems(Dest, Source, Parts, Items);
		Barrier(ScatterAccess, Copy);
	}
}

void FVulkanCommandList::ScatterItems(
    IRTBuffer* Dest, IRTBuffer* Source, const FVulkanRegions& Regions, const FVulkanListMemory::FSlice& Items)
{
	Keep(ListMemory.GetBlock());
	FVulkanScatter::FPush Push;
	Push.Dest = Dest->GetDeviceAddress();
	Push.Source = Source->GetDeviceAddress();
	Push.WordsPerItem = Regions.GetWordsPerItem();
	Push.Kind = FVulkanScatter::EKind::Regions;
	const uint32_t Count = Regions.WriteItems(static_cast<FVulkanScatter::FRegion*>(Items.Data));
	const uint32_t MostAtOnce = FVulkanScatter::MostThreads / Push.WordsPerItem;
	for (uint32_t First = 0; First < Count; First += Push.Count)
	{
		Push.Items = Items.Address + sizeof(FVulkanScatter::FRegion) * First;
		Push.Count = std::min(Count - First, MostAtOnce);
		Device.Scatter.Record(Device, Handle, Push);
	}
	RestoreAfterScatter();
}

void FVulkanCommandList::RestoreAfterScatter()
{
	if (Bound && Bound->BindPoint == VK_PIPELINE_BIND_POINT_COMPUTE)
	{
		Device.Api.CmdBindPipeline(Handle, Bound->BindPoint, Bound->Handle);
	}
	if (PushedBytes > 0)
	{
		Device.Api.CmdPushConstants(Handle, Device.Bindless.PipelineLayout, AllStages(Device.Bits), 0, PushedBytes, Pushed);
	}
}

void FVulkanCommandList::CopyBufferToTexture(IRTTexture* Dest, uint32_t Mip, uint32_t Layer, IRTBuffer* Source, uint64_t SourceOffset)
{
	Keep(Dest);
	Keep(Source);
	const VkBufferImageCopy Region = RegionOf(Dest->GetDesc(), Mip, Layer, SourceOffset);
	Device.Api.CmdCopyBufferToImage(
	    Handle, NativeOf(Source), static_cast<FVulkanTexture*>(Dest)->GetImage(), GetVulkanLayout(ERTAccess::CopyWrite), 1, &Region);
}

void FVulkanCommandList::CopyTextureToBuffer(IRTBuffer* Dest, uint64_t DestOffset, IRTTexture* Source, uint32_t Mip, uint32_t Layer)
{
	Keep(Dest);
	Keep(Source);
	const VkBufferImageCopy Region = RegionOf(Source->GetDesc(), Mip, Layer, DestOffset);
	Device.Api.CmdCopyImageToBuffer(
	    Handle, static_cast<FVulkanTexture*>(Source)->GetImage(), GetVulkanLayout(ERTAccess::CopyRead), NativeOf(Dest), 1, &Region);
}

void FVulkanCommandList::FillBuffer(IRTBuffer* Dest, uint64_t Offset, uint64_t Size, uint32_t Value)
{
	assert(Offset % 4 == 0 && Size % 4 == 0);
	Keep(Dest);
	if (Size > 0) { Device.Api.CmdFillBuffer(Handle, NativeOf(Dest), Offset, Size, Value); }
}

void FVulkanCommandList::ClearTexture(IRTTexture* Dest, const float Value[4])
{
	Keep(Dest);
	const FRTTextureDesc& Desc = Dest->GetDesc();
	assert(AspectOf(Desc.Format) == VK_IMAGE_ASPECT_COLOR_BIT);
	VkClearColorValue Color{};
	for (uint32_t Channel = 0; Channel < 4; ++Channel)
	{
		if (IsIntegerFormat(Desc.Format)) { Color.uint32[Channel] = static_cast<uint32_t>(Value[Channel]); }
		else { Color.float32[Channel] = Value[Channel]; }
	}
	const VkImageSubresourceRange Range = {VK_IMAGE_ASPECT_COLOR_BIT, 0, VK_REMAINING_MIP_LEVELS, 0, VK_REMAINING_ARRAY_LAYERS};
	Device.Api.CmdClearColorImage(
	    Handle, static_cast<FVulkanTexture*>(Dest)->GetImage(), GetVulkanLayout(ERTAccess::CopyWrite), &Color, 1, &Range);
}

void FVulkanCommandList::MipBarrier(
    const FVulkanTexture& Texture, uint32_t First, uint32_t Count, VkImageLayout Before, VkImageLayout After)
{
	const bool bFinal = After == VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL;
	const FVulkanAccess Next = AccessOf(bFinal ? ERTAccess::ShaderRead : ERTAccess::CopyRead, Device.Bits);
	VkImageMemoryBarrier2 Image{VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER_2};
	Image.srcStageMask = VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT;
	Image.srcAccessMask = Before == VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL ? VK_ACCESS_2_TRANSFER_WRITE_BIT : 0;
	Image.dstStageMask = Next.Stages;
	Image.dstAccessMask = Next.Access;
	Image.oldLayout = Before;
	Image.newLayout = After;
	Image.srcQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
	Image.dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
	Image.image = Texture.GetImage();
	Image.subresourceRange = {AspectOf(Texture.GetDesc().Format), First, Count, 0, VK_REMAINING_ARRAY_LAYERS};
	VkDependencyInfo Info{VK_STRUCTURE_TYPE_DEPENDENCY_INFO};
	Info.imageMemoryBarrierCount = 1;
	Info.pImageMemoryBarriers = &Image;
	Device.Api.CmdPipelineBarrier2(Handle, &Info);
}

void FVulkanCommandList::GenerateMips(IRTTexture* Texture)
{
	Keep(Texture);
	const FVulkanTexture& Image = *static_cast<FVulkanTexture*>(Texture);
	const FRTTextureDesc& Desc = Image.GetDesc();
	VkFormatProperties Properties{};
	Device.Instance->Api.GetPhysicalDeviceFormatProperties(Device.Physical, GetVulkanFormat(Desc.Format), &Properties);
	const bool bLinear = Properties.optimalTilingFeatures & VK_FORMAT_FEATURE_SAMPLED_IMAGE_FILTER_LINEAR_BIT;
	const auto Extent = [&](uint32_t Mip) {
		return VkOffset3D{static_cast<int32_t>(std::max(Desc.Width >> Mip, 1u)), static_cast<int32_t>(std::max(Desc.Height >> Mip, 1u)), 1};
	};
	for (uint32_t Mip = 1; Mip < Desc.MipCount; ++Mip)
	{
		MipBarrier(Image, Mip - 1, 1, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL);
		VkImageBlit Region{};
		Region.srcSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, Mip - 1, 0, Desc.ArraySize};
		Region.srcOffsets[1] = Extent(Mip - 1);
		Region.dstSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, Mip, 0, Desc.ArraySize};
		Region.dstOffsets[1] = Extent(Mip);
		Device.Api.CmdBlitImage(Handle, Image.GetImage(), VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, Image.GetImage(),
		    VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, 1, &Region, bLinear ? VK_FILTER_LINEAR : VK_FILTER_NEAREST);
	}
	const uint32_t Last = Desc.MipCount - 1;
	if (Last > 0) { MipBarrier(Image, 0, Last, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL); }
	MipBarrier(Image, Last, 1, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL);
}

} // namespace Lantern
