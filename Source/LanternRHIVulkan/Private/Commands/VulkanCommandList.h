// Command lists: a VkCommandBuffer of our own or of the engine, and the objects that it keeps.
#pragma once

#include "Commands/VulkanListMemory.h"
#include "Commands/VulkanQueryPool.h"
#include "Commands/VulkanRegions.h"
#include "Pipelines/VulkanPipeline.h"
#include "Resources/VulkanAccel.h"
#include "Resources/VulkanBuffer.h"
#include "Resources/VulkanTexture.h"
#include "ShaderTable/VulkanShaderTable.h"

namespace Lantern
{

/// What a scatter does, whatever it copies.
inline constexpr FVulkanAccess ScatterAccess{
    VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT, VK_ACCESS_2_SHADER_STORAGE_READ_BIT | VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT};

class FVulkanCommandList final : public TVulkanObject<IRTCommandList>
{
public:
	using TVulkanObject::TVulkanObject;
	FRTStatus Initialise(const char* InName, ERTQueue InQueue);
	/// Takes the engine's command buffer, which is in the recording state.
	void InitialiseImported(VkCommandBuffer Buffer);

	FRTStatus Begin() override;
	FRTStatus End() override;
	FRTStatus GetStatus() const override { return Error; }
	void Barriers(const FRTBarrier* Items, uint32_t Count) override;
	void SetPipeline(IRTPipeline* Pipeline) override;
	void PushConstants(const void* Data, uint32_t Size) override;
	void Dispatch(uint32_t GroupsX, uint32_t GroupsY, uint32_t GroupsZ) override;
	void DispatchIndirect(IRTBuffer* Arguments, uint64_t Offset) override;
	void BeginRasterPass(const FRTRasterPassDesc& Desc) override;
	void EndRasterPass() override;
	void SetIndexBuffer(IRTBuffer* Buffer, uint64_t Offset, ERTIndexType Type) override;
	void Draw(uint32_t VertexCount, uint32_t InstanceCount) override;
	void DrawIndexed(uint32_t IndexCount, uint32_t InstanceCount, uint32_t FirstIndex, int32_t VertexOffset) override;
	void KeepAlive(IRTRefCounted* Object) override;
	void WriteTimestamp(IRTQueryPool* Pool, uint32_t Index) override;
	void ResetQueries(IRTQueryPool* Pool, uint32_t First, uint32_t Count) override;
	void BeginMarker(const char* Name) override;
	void EndMarker() override;
	uint64_t GetNative(ERTNative Kind) const override;

	void CopyBuffer(IRTBuffer* Dest, uint64_t DestOffset, IRTBuffer* Source, uint64_t SourceOffset, uint64_t Size) override;
	void CopyBufferRegions(IRTBuffer* Dest, IRTBuffer* Source, const FRTBufferRegion* Regions, uint32_t Count) override;
	void CopyBufferToTexture(IRTTexture* Dest, uint32_t Mip, uint32_t Layer, IRTBuffer* Source, uint64_t SourceOffset) override;
	void CopyTextureToBuffer(IRTBuffer* Dest, uint64_t DestOffset, IRTTexture* Source, uint32_t Mip, uint32_t Layer) override;
	void FillBuffer(IRTBuffer* Dest, uint64_t Offset, uint64_t Size, uint32_t Value) override;
	void ClearTexture(IRTTexture* Dest, const float Value[4]) override;
	/// Uses linear blits, a box filter for even sizes. For odd sizes, each texel takes two of the three that it covers.
	void GenerateMips(IRTTexture* Texture) override;

	// Rays and builds: VulkanCommandListTrace.cpp.
	void TraceRays(IRTShaderTable* Table, uint32_t RayGen, uint32_t Width, uint32_t Height, uint32_t Depth) override;
	void TraceRaysIndirect(IRTShaderTable* Table, uint32_t RayGen, IRTBuffer* Arguments, uint64_t Offset) override;
	/// Takes the table's changes at once: submit lists that update one table in the order of these calls.
	void UpdateShaderTable(IRTShaderTable* Table) override;
	void BuildGeometries(const FRTGeometryBuild* Builds, uint32_t Count) override;
	void WriteCompactedSize(IRTQueryPool* Queries, uint32_t Index, IRTGeometry* Geometry) override;
	void CompactGeometry(IRTGeometry* Dest, IRTGeometry* Source) override;
	void BuildScene(IRTScene* Scene, IRTBuffer* Instances, uint64_t InstanceOffset, uint32_t Count, IRTBuffer* Scratch,
	    uint64_t ScratchOffset) override;

	// For the device.
	VkCommandBuffer GetHandle() const { return Handle; }
	bool IsImported() const { return bImported; }
	ERTQueue GetQueue() const { return Queue; }
	/// Gives the list's references to the submission with this fence.
	FVulkanKept TakeKept(FRTFence InFence);

private:
	~FVulkanCommandList() override;
	void Keep(IRTRefCounted* Object);
	void ReleaseKept();
	/// Returns stages and accesses as this list's queue has them.
	FVulkanAccess GetAccess(ERTAccess Access) const;
	void Barrier(const FVulkanAccess& Before, const FVulkanAccess& After);
	/// Regions of a shader table, as a trace names them.
	struct FTraceRegions
	{
		VkStridedDeviceAddressRegionKHR Generate, Miss, Hit, Callable;
	};
	FTraceRegions UseTable(IRTShaderTable* Table, uint32_t RayGen);
	void CopyRecords(const FVulkanShaderTable::FCopies& Item, VkBuffer Dest);
	/// Copies the items of Regions, which lie in Items.
	void ScatterItems(IRTBuffer* Dest, IRTBuffer* Source, const FVulkanRegions& Regions, const FVulkanListMemory::FSlice& Items);
	/// What the caller has set stays set.
	void RestoreAfterScatter();
	void MipBarrier(const FVulkanTexture& Texture, uint32_t First, uint32_t Count, VkImageLayout Before, VkImageLayout After);

	std::string Name;
	bool bImported = false;
	ERTQueue Queue = ERTQueue::Graphics;
	VkCommandPool Pool = VK_NULL_HANDLE;
	VkCommandBuffer Handle = VK_NULL_HANDLE;
	FRTFence Fence = 0;
	FRTStatus Error; ///< the first of recording; calls that return nothing leave it here
	FVulkanKept Kept;
	FVulkanListMemory ListMemory;
	FVulkanPipeline* Bound = nullptr;
	uint8_t Pushed[sizeof(FVulkanScatter::FPush)] = {}; ///< what a scatter writes over
	uint32_t PushedBytes = 0;
	std::vector<std::pair<FVulkanQueryPool*, uint32_t>> QueriesWritten;
	uint32_t SetBoundPoints = 0; ///< a bit for each bind point that has the descriptor set
};

} // namespace Lantern
