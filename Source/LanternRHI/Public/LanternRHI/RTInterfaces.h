// Interfaces of the RHI. Three peers implement them: LanternRHIVulkan, LanternRHIMock, and
// LanternRHIValidation, which wraps any device and turns wrong use into messages.
//
// Binding model, the same for every shader: one bindless descriptor set (set 0) and up to
// FRTCapabilities::MaxPushConstantBytes of push constants. Buffers are reached by device address.
//   set 0, binding 0: texture2D[]  (index: IRTTexture::GetSampledIndex)
//   set 0, binding 1: image2D[]    (index: IRTTexture::GetStorageIndex)
//   set 0, binding 2: sampler[]    (index: IRTSampler::GetIndex)
//   set 0, binding 3: accelerationStructureEXT[] (index: IRTScene::GetIndex)
//
// Threads: IRTDevice may be called from any thread. A command list belongs to one thread at a time.
// Nothing throws. Wrong use is a bug (assert); use the validation wrapper to have it explained.
#pragma once

#include "LanternRHI/RTTypes.h"

namespace Lantern
{

/// Native objects behind the interfaces; what each means is the backend's (Vulkan: the Vk handle).
enum class ERTNative : uint8_t
{
	Instance,
	PhysicalDevice,
	Device,
	Queue,
	QueueFamily,
	CommandBuffer,
	Buffer,
	Image,
	ImageView,
	Pipeline,
	AccelerationStructure,
	DescriptorSet,
	PipelineLayout,
};

class IRTBuffer : public IRTRefCounted
{
public:
	virtual const FRTBufferDesc& GetDesc() const = 0;
	virtual uint64_t GetDeviceAddress() const = 0;
	/// Upload and Readback: the memory, mapped for the buffer's life. Device: null.
	virtual void* GetMapped() = 0;
	virtual uint64_t GetNative(ERTNative Kind) const = 0; ///< 0 where it has none of this kind
};

class IRTTexture : public IRTRefCounted
{
public:
	virtual const FRTTextureDesc& GetDesc() const = 0;
	virtual uint32_t GetSampledIndex() const = 0; ///< ~0u without ERTTextureUsage::Sampled
	virtual uint32_t GetStorageIndex() const = 0; ///< ~0u without ERTTextureUsage::Storage; mip 0
	virtual uint64_t GetNative(ERTNative Kind) const = 0;
};

class IRTSampler : public IRTRefCounted
{
public:
	virtual uint32_t GetIndex() const = 0;
};

/// Compute, raster or ray-tracing pipeline (the RTPSO).
class IRTPipeline : public IRTRefCounted
{
public:
	virtual uint32_t GetGroupCount() const = 0; ///< 0 unless for ray tracing
	virtual uint64_t GetNative(ERTNative Kind) const = 0;
};

/// A bottom-level acceleration structure.
class IRTGeometry : public IRTRefCounted
{
public:
	virtual uint64_t GetDeviceAddress() const = 0;
	virtual FRTBuildSizes GetBuildSizes() const = 0;
	virtual uint32_t GetSectionCount() const = 0;
	virtual uint64_t GetNative(ERTNative Kind) const = 0;
};

/// A top-level acceleration structure.
class IRTScene : public IRTRefCounted
{
public:
	virtual uint32_t GetIndex() const = 0; ///< in the bindless heap
	virtual uint32_t GetMaxInstances() const = 0;
	virtual FRTBuildSizes GetBuildSizes() const = 0;
	virtual uint64_t GetNative(ERTNative Kind) const = 0;
};

/// The shader binding table: device-local, with host copies that hold what is new. Records are written on the CPU,
/// gathered into the next free host copy by Stage, and reach the GPU with IRTCommandList::UpdateShaderTable; only what
/// changed is copied. Hit record reached by a ray:
///   instance.TableOffset + geometryIndex · rayMultiplier + rayType   (Vulkan specification, "Shader Binding Table")
/// Records never written are null: a ray that reaches one runs no shader.
/// Threads: the Set… calls may run at once where they name different records; everything else excludes them.
class IRTShaderTable : public IRTRefCounted
{
public:
	/// Counts as they are now (see Reserve), and the pipeline as SetPipeline left it.
	virtual const FRTShaderTableDesc& GetDesc() const = 0;
	/// Points record Index at Group of the pipeline; Data (hit records only) may be null for zeros.
	virtual void SetRecord(ERTRecordKind Kind, uint32_t Index, uint32_t Group, const void* Data, uint32_t DataBytes) = 0;
	/// Hit records First … First + Count − 1: Groups[Count], and Data of RecordDataBytes each, tightly packed.
	virtual void SetHitRecords(uint32_t First, uint32_t Count, const uint32_t* Groups, const void* Data) = 0;
	/// The handles of records alone; their data stays.
	virtual void SetGroups(ERTRecordKind Kind, uint32_t First, uint32_t Count, const uint32_t* Groups) = 0;
	/// Groups that are set from now on are Pipeline's. Records keep the handles of the one before until they are set
	/// again; that must have happened to all that rays can reach before the next trace with Pipeline. What was recorded
	/// before keeps tracing with the old pipeline and the old records.
	virtual void SetPipeline(IRTPipeline* Pipeline) = 0;
	/// Grows to at least these numbers of records, in the order of ERTRecordKind; contents stay, nothing waits: the
	/// device's copy moves on the GPU in the next update. Never shrinks. On error nothing has changed.
	virtual FRTStatus Reserve(const uint32_t Counts[4]) = 0;
	/// Copies what changed into a free host copy, so that UpdateShaderTable has nothing left to do but record. Optional:
	/// UpdateShaderTable stages what is not. From any thread.
	virtual FRTStatus Stage() = 0;
	/// Everything travels again with the next update: what was recorded last was never submitted.
	virtual void Invalidate() = 0;
	virtual uint64_t GetRecordStride(ERTRecordKind Kind) const = 0; ///< bytes, a multiple of the handle alignment
	virtual uint64_t GetSizeBytes() const = 0;
	virtual uint64_t GetUpdatedBytes() const = 0; ///< copied to the device by the last UpdateShaderTable
};

class IRTQueryPool : public IRTRefCounted
{
public:
	virtual uint32_t GetCount() const = 0;
	virtual ERTQuery GetKind() const = 0;
	/// Nanoseconds of each timestamp, bytes of each compacted size; false where one has not been written and finished.
	virtual bool GetResults(uint32_t First, uint32_t Count, uint64_t* OutValues) = 0;
};

class IRTCommandList : public IRTRefCounted
{
public:
	/// Begin may be called again once the submission has finished (or none was made).
	virtual FRTStatus Begin() = 0;
	virtual FRTStatus End() = 0;

	virtual void Barriers(const FRTBarrier* Items, uint32_t Count) = 0;
	virtual void CopyBuffer(IRTBuffer* Dest, uint64_t DestOffset, IRTBuffer* Source, uint64_t SourceOffset, uint64_t Size) = 0;
	/// The same for many regions, none of which overlaps another in Dest: one command for a driver.
	virtual void CopyBufferRegions(IRTBuffer* Dest, IRTBuffer* Source, const FRTBufferRegion* Regions, uint32_t Count) = 0;
	/// Rows tightly packed.
	virtual void CopyBufferToTexture(IRTTexture* Dest, uint32_t Mip, uint32_t Layer, IRTBuffer* Source, uint64_t SourceOffset) = 0;
	virtual void CopyTextureToBuffer(IRTBuffer* Dest, uint64_t DestOffset, IRTTexture* Source, uint32_t Mip, uint32_t Layer) = 0;
	virtual void FillBuffer(IRTBuffer* Dest, uint64_t Offset, uint64_t Size, uint32_t Value) = 0; ///< multiples of 4
	virtual void ClearTexture(IRTTexture* Dest, const float Value[4]) = 0;                        ///< colour; access CopyWrite
	/// Mips 1… from mip 0 by a box filter, linear in the format's decoded space. All in access CopyWrite,
	/// left in ShaderRead. Width and height need not be powers of two.
	virtual void GenerateMips(IRTTexture* Texture) = 0;

	virtual void SetPipeline(IRTPipeline* Pipeline) = 0;
	virtual void PushConstants(const void* Data, uint32_t Size) = 0; ///< after SetPipeline; a multiple of 4

	virtual void Dispatch(uint32_t GroupsX, uint32_t GroupsY, uint32_t GroupsZ) = 0;
	/// Needs the pipeline of Table, or one with the same groups. RayGen: record index.
	virtual void TraceRays(IRTShaderTable* Table, uint32_t RayGen, uint32_t Width, uint32_t Height, uint32_t Depth) = 0;
	virtual void UpdateShaderTable(IRTShaderTable* Table) = 0; ///< leaves it in TraceRead

	virtual void BeginRasterPass(const FRTRasterPassDesc& Desc) = 0; ///< viewport and scissor: the whole target
	virtual void EndRasterPass() = 0;
	virtual void SetIndexBuffer(IRTBuffer* Buffer, uint64_t Offset, ERTIndexType Type) = 0;
	virtual void Draw(uint32_t VertexCount, uint32_t InstanceCount) = 0;
	virtual void DrawIndexed(uint32_t IndexCount, uint32_t InstanceCount, uint32_t FirstIndex, int32_t VertexOffset) = 0;

	/// Scratch must be in BuildWrite; results are in BuildWrite afterwards: put a memory barrier behind it.
	virtual void BuildGeometries(const FRTGeometryBuild* Builds, uint32_t Count) = 0;
	/// Queries (of CompactedSize) [Index]: bytes that Geometry, built by an earlier command and with a barrier between,
	/// would need. It was created with bAllowCompaction. Reset the query before.
	virtual void WriteCompactedSize(IRTQueryPool* Queries, uint32_t Index, IRTGeometry* Geometry) = 0;
	/// Dest was created with CompactedBytes of what WriteCompactedSize said of Source. Dest is in BuildWrite afterwards.
	virtual void CompactGeometry(IRTGeometry* Dest, IRTGeometry* Source) = 0;
	/// Instances: FRTInstance[Count] at InstanceOffset (a multiple of 16). Count may be 0.
	virtual void BuildScene(
	    IRTScene* Scene, IRTBuffer* Instances, uint64_t InstanceOffset, uint32_t Count, IRTBuffer* Scratch, uint64_t ScratchOffset) = 0;
	/// Keeps what the list uses without naming it (through an address, an index, or a scene's instances) until the GPU is
	/// done. FRTScene holds its geometries itself.
	virtual void KeepAlive(IRTRefCounted* Object) = 0;

	virtual void WriteTimestamp(IRTQueryPool* Pool, uint32_t Index) = 0;
	virtual void ResetQueries(IRTQueryPool* Pool, uint32_t First, uint32_t Count) = 0;
	virtual void BeginMarker(const char* Name) = 0;
	virtual void EndMarker() = 0;

	virtual uint64_t GetNative(ERTNative Kind) const = 0;
};

/// Value on the device's timeline; 0 is always complete.
using FRTFence = uint64_t;

class IRTDevice : public IRTRefCounted
{
public:
	virtual uint32_t GetVersion() const = 0; ///< RHIVersion of the implementation
	virtual const FRTCapabilities& GetCapabilities() const = 0;

	virtual FRTStatus CreateBuffer(const FRTBufferDesc& Desc, IRTBuffer** Out) = 0;
	virtual FRTStatus CreateTexture(const FRTTextureDesc& Desc, IRTTexture** Out) = 0;
	/// Wraps the engine's texture (Vulkan: a VkImage); it must outlive the wrapper. Access: as it is now.
	virtual FRTStatus ImportTexture(const FRTTextureDesc& Desc, uint64_t NativeImage, IRTTexture** Out) = 0;
	virtual FRTStatus CreateSampler(const FRTSamplerDesc& Desc, IRTSampler** Out) = 0;
	virtual FRTStatus CreateComputePipeline(const FRTComputePipelineDesc& Desc, IRTPipeline** Out) = 0;
	virtual FRTStatus CreateRasterPipeline(const FRTRasterPipelineDesc& Desc, IRTPipeline** Out) = 0;
	virtual FRTStatus CreateRayTracingPipeline(const FRTRayTracingPipelineDesc& Desc, IRTPipeline** Out) = 0;
	virtual FRTStatus CreateGeometry(const FRTGeometryDesc& Desc, IRTGeometry** Out) = 0;
	/// What CreateGeometry would make, without making it; Desc.CompactedBytes is ignored. All 0 where the device has no
	/// acceleration structures.
	virtual FRTBuildSizes GetGeometrySizes(const FRTGeometryDesc& Desc) = 0;
	virtual FRTStatus CreateScene(const FRTSceneDesc& Desc, IRTScene** Out) = 0;
	virtual FRTStatus CreateShaderTable(const FRTShaderTableDesc& Desc, IRTShaderTable** Out) = 0;
	virtual FRTStatus CreateQueryPool(ERTQuery Kind, uint32_t Count, IRTQueryPool** Out) = 0;
	virtual FRTStatus CreateCommandList(const char* Name, IRTCommandList** Out) = 0;
	/// Records into the engine's command buffer (Vulkan: a VkCommandBuffer in the recording state). Begin and
	/// End must not be called; the engine submits it and calls NotifyExternalSubmit.
	virtual FRTStatus ImportCommandList(uint64_t NativeCommandBuffer, IRTCommandList** Out) = 0;

	/// Runs the lists in order. OutFence: complete when they are.
	virtual FRTStatus Submit(IRTCommandList* const* Lists, uint32_t Count, FRTFence* OutFence) = 0;
	/// After the engine submitted imported lists on the device's queue: returns the fence of that work.
	virtual FRTStatus NotifyExternalSubmit(IRTCommandList* const* Lists, uint32_t Count, FRTFence* OutFence) = 0;
	virtual FRTFence GetCompletedFence() = 0;
	virtual FRTStatus WaitFor(FRTFence Fence, uint64_t TimeoutNs) = 0;
	virtual FRTStatus WaitIdle() = 0;
	/// Destroys what was released and is no longer used. Called by Submit and WaitFor; harmless to call more.
	virtual void CollectGarbage() = 0;

	virtual FRTMemoryStats GetMemoryStats() const = 0;
	/// Messages of the backend's validation since creation (Vulkan validation layers, when on).
	virtual uint32_t GetValidationMessageCount() const = 0;
	virtual uint64_t GetNative(ERTNative Kind) const = 0;
};

} // namespace Lantern
