// Interfaces of the RHI. Three peers implement them: LanternRHIVulkan, LanternRHIMock, and LanternRHIValidation, which
// wraps any device and turns wrong use into messages. LanternRHICommon has what an implementation need not write again.
//
// Binding model, common to all shaders: one bindless descriptor set (set 0), and at most
// FRTCapabilities::MaxPushConstantBytes of push constants. Shaders reach buffers by device address.
//   Binding 0 is texture2D[], indexed by IRTTexture::GetSampledIndex; and textureCube[] if FRTTextureDesc::bCube.
//   Binding 1 is image2D[], indexed by IRTTexture::GetStorageIndex.
//   Binding 2 is sampler[], indexed by IRTSampler::GetIndex.
//   Binding 3 is accelerationStructureEXT[], indexed by IRTScene::GetIndex.
//
// Methods are grouped by who calls them. The plugin calls the first group of each interface. Hosts, that is engines and the
// programs here, call the second. Tests alone call the third, which a port needs for Tests/Contract only.
// Unsupported: only methods whose comment says so may return it. Everything else must work on every device.
//
// Threads: IRTDevice may be called from any thread. A command list belongs to one thread at a time.
// Errors: nothing throws. Wrong use is a bug (assert); the validation wrapper explains it.
#pragma once

#include "LanternRHI/RTTypes.h"

namespace Lantern
{

/// Native objects behind the interfaces. The implementation says what each means; for Vulkan it is the Vk handle.
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
	ComputeTimeline, ///< semaphore that counts the fences of ERTQueue::AsyncCompute (Vulkan: a timeline VkSemaphore)
};

class IRTBuffer : public IRTRefCounted
{
public:
	// Called by the plugin.
	virtual const FRTBufferDesc& GetDesc() const = 0;
	virtual uint64_t GetDeviceAddress() const = 0;
	/// The memory of an Upload or Readback buffer, mapped for the buffer's life. Null for a Device buffer.
	virtual void* GetMapped() = 0;

	// Called by hosts.
	virtual uint64_t GetNative(ERTNative Kind) const = 0; ///< 0 if the buffer has none of this kind
};

class IRTTexture : public IRTRefCounted
{
public:
	// Called by the plugin.
	virtual const FRTTextureDesc& GetDesc() const = 0;
	virtual uint32_t GetSampledIndex() const = 0; ///< ~0u without ERTTextureUsage::Sampled
	virtual uint32_t GetStorageIndex() const = 0; ///< of mip 0; ~0u without ERTTextureUsage::Storage

	// Called by hosts.
	virtual uint64_t GetNative(ERTNative Kind) const = 0; ///< 0 if the texture has none of this kind
	/// Says what ERTAccess::External is, in barriers recorded from now on: From before them, To after them. Only for textures of
	/// IRTDevice::ImportTexture. InvalidArgument for other textures, and for layouts that no image can be left in.
	virtual FRTStatus SetExternalState(const FRTExternalState& From, const FRTExternalState& To) = 0;
};

class IRTSampler : public IRTRefCounted
{
public:
	// Called by the plugin.
	virtual uint32_t GetIndex() const = 0; ///< in the bindless set
};

/// A pipeline for compute, raster or ray tracing (the RTPSO).
class IRTPipeline : public IRTRefCounted
{
public:
	// Called by tests.
	virtual uint32_t GetGroupCount() const = 0;           ///< shader groups; 0 unless for ray tracing
	virtual uint64_t GetNative(ERTNative Kind) const = 0; ///< 0 if the pipeline has none of this kind
};

/// A bottom-level acceleration structure (BLAS): triangles or AABBs in sections.
class IRTGeometry : public IRTRefCounted
{
public:
	// Called by the plugin.
	virtual uint64_t GetDeviceAddress() const = 0; ///< for FRTInstance::GeometryAddress
	virtual FRTBuildSizes GetBuildSizes() const = 0;

	// Called by tests.
	virtual uint32_t GetSectionCount() const = 0;
	virtual uint64_t GetNative(ERTNative Kind) const = 0; ///< 0 if the geometry has none of this kind
};

/// A top-level acceleration structure (TLAS): instances of geometries, as the last BuildScene left them. It knows nothing of
/// materials, lights or objects.
class IRTScene : public IRTRefCounted
{
public:
	// Called by the plugin.
	virtual uint32_t GetIndex() const = 0; ///< in the bindless set
	virtual uint32_t GetMaxInstances() const = 0;
	virtual FRTBuildSizes GetBuildSizes() const = 0;

	// Called by hosts.
	virtual uint64_t GetNative(ERTNative Kind) const = 0; ///< 0 if the scene has none of this kind
};

/// The shader binding table: memory of the device, and host copies of what is new. The Set… calls write records on the CPU.
/// Stage gathers what changed into a free host copy, and IRTCommandList::UpdateShaderTable copies it to the device.
/// A ray reaches the hit record instance.TableOffset + geometryIndex · rayMultiplier + rayType (Vulkan specification, "Shader
/// Binding Table"). Records never written are null: a ray that reaches one runs no shader.
/// Threads: the Set… calls for records may run at once if they name different records. Everything else excludes them.
class IRTShaderTable : public IRTRefCounted
{
public:
	// Called by the plugin.
	/// Has the numbers of records as Reserve left them, and the pipeline as SetPipeline left it.
	virtual const FRTShaderTableDesc& GetDesc() const = 0;
	/// Points record Index at Group of the pipeline. Data is for hit records only and may be null for zeros.
	virtual void SetRecord(ERTRecordKind Kind, uint32_t Index, uint32_t Group, const void* Data, uint32_t DataBytes) = 0;
	/// Sets hit records First … First + Count − 1. Groups: one for each. Data: RecordDataBytes for each, tightly packed, or null
	/// for zeros.
	virtual void SetHitRecords(uint32_t First, uint32_t Count, const uint32_t* Groups, const void* Data) = 0;
	/// Sets the handles of records alone; their data stays. Groups: one for each record.
	virtual void SetGroups(ERTRecordKind Kind, uint32_t First, uint32_t Count, const uint32_t* Groups) = 0;
	/// Makes Pipeline the one whose groups the Set… calls name from now on. Records keep their handles until they are set again.
	/// Set all that rays can reach before the next trace with Pipeline. What was recorded before traces with the old pipeline and
	/// the old records.
	virtual void SetPipeline(IRTPipeline* Pipeline) = 0;
	/// Grows to at least these numbers of records, in the order of ERTRecordKind; never shrinks. Contents stay. Nothing waits: the
	/// next update moves the device's copy on the GPU. On error nothing has changed.
	virtual FRTStatus Reserve(const uint32_t Counts[4]) = 0;
	/// Copies what changed into a free host copy, so that UpdateShaderTable need only record. The call is optional:
	/// UpdateShaderTable stages the rest. From any thread.
	virtual FRTStatus Stage() = 0;
	/// Marks all records as changed. Call it if the list that was recorded last was never submitted.
	virtual void Invalidate() = 0;
	virtual uint64_t GetUpdatedBytes() const = 0; ///< copied to the device by the last UpdateShaderTable

	// Called by tests.
	virtual uint64_t GetRecordStride(ERTRecordKind Kind) const = 0; ///< bytes, a multiple of the handle alignment
	virtual uint64_t GetSizeBytes() const = 0;                      ///< of the device's copy
};

class IRTQueryPool : public IRTRefCounted
{
public:
	// Called by the plugin.
	virtual uint32_t GetCount() const = 0;
	/// Writes nanoseconds for each timestamp, bytes for each compacted size. Returns false if one of them was not written, or if
	/// the GPU has not finished it.
	virtual bool GetResults(uint32_t First, uint32_t Count, uint64_t* OutValues) = 0;

	// Called by tests.
	virtual ERTQuery GetKind() const = 0;
};

/// Offsets and sizes are in bytes.
class IRTCommandList : public IRTRefCounted
{
public:
	// Called by the plugin.
	/// May be called again once the submission has finished, or if there was none.
	virtual FRTStatus Begin() = 0;
	/// Returns what went wrong while the list was recorded.
	virtual FRTStatus End() = 0;
	/// Returns what has gone wrong so far while the list was recorded, as End will. For imported lists, which have no End.
	virtual FRTStatus GetStatus() const = 0;
	virtual void Barriers(const FRTBarrier* Items, uint32_t Count) = 0;
	virtual void CopyBuffer(IRTBuffer* Dest, uint64_t DestOffset, IRTBuffer* Source, uint64_t SourceOffset, uint64_t Size) = 0;
	/// Copies many regions at once. None may overlap another in Dest.
	virtual void CopyBufferRegions(IRTBuffer* Dest, IRTBuffer* Source, const FRTBufferRegion* Regions, uint32_t Count) = 0;
	/// Rows in Source are tightly packed.
	virtual void CopyBufferToTexture(IRTTexture* Dest, uint32_t Mip, uint32_t Layer, IRTBuffer* Source, uint64_t SourceOffset) = 0;
	virtual void FillBuffer(IRTBuffer* Dest, uint64_t Offset, uint64_t Size, uint32_t Value) = 0; ///< multiples of 4
	/// Makes mips 1… from mip 0 by a box filter, linear in the format's decoded space. All mips must be in CopyWrite and are left
	/// in ShaderRead. Width and height need not be powers of two.
	virtual void GenerateMips(IRTTexture* Texture) = 0;
	virtual void SetPipeline(IRTPipeline* Pipeline) = 0;
	virtual void PushConstants(const void* Data, uint32_t Size) = 0; ///< after SetPipeline; a multiple of 4
	virtual void Dispatch(uint32_t GroupsX, uint32_t GroupsY, uint32_t GroupsZ) = 0;
	/// Dispatches as many groups as the three uint32_t at Offset, a multiple of 4, say when the device comes to the command.
	/// Arguments needs usage Indirect, and must be in IndirectRead. Numbers may be 0.
	virtual void DispatchIndirect(IRTBuffer* Arguments, uint64_t Offset) = 0;
	/// Needs the pipeline of Table, or one with the same groups. RayGen: index of the ray generation record.
	virtual void TraceRays(IRTShaderTable* Table, uint32_t RayGen, uint32_t Width, uint32_t Height, uint32_t Depth) = 0;
	/// Traces as TraceRays, with width, height and depth as DispatchIndirect has its groups. Needs
	/// FRTCapabilities::bIndirectTrace.
	virtual void TraceRaysIndirect(IRTShaderTable* Table, uint32_t RayGen, IRTBuffer* Arguments, uint64_t Offset) = 0;
	virtual void UpdateShaderTable(IRTShaderTable* Table) = 0; ///< leaves it in TraceRead
	/// Scratch must be in BuildWrite. Geometries are in BuildWrite afterwards: put a memory barrier behind the builds.
	virtual void BuildGeometries(const FRTGeometryBuild* Builds, uint32_t Count) = 0;
	/// Writes the compacted size of Geometry, in bytes, to Queries[Index]. The pool must be of ERTQuery::CompactedSize, and the
	/// query reset before. Geometry must have bAllowCompaction; its build must come before, with a barrier between.
	virtual void WriteCompactedSize(IRTQueryPool* Queries, uint32_t Index, IRTGeometry* Geometry) = 0;
	/// Copies Source into Dest, which was created with the CompactedBytes that WriteCompactedSize wrote for Source. Dest is in
	/// BuildWrite afterwards.
	virtual void CompactGeometry(IRTGeometry* Dest, IRTGeometry* Source) = 0;
	/// Instances: FRTInstance[Count] at InstanceOffset, a multiple of 16. Count may be 0. Scene is in BuildWrite afterwards.
	virtual void BuildScene(
	    IRTScene* Scene, IRTBuffer* Instances, uint64_t InstanceOffset, uint32_t Count, IRTBuffer* Scratch, uint64_t ScratchOffset) = 0;
	virtual void WriteTimestamp(IRTQueryPool* Pool, uint32_t Index) = 0;
	virtual void ResetQueries(IRTQueryPool* Pool, uint32_t First, uint32_t Count) = 0;
	virtual void BeginMarker(const char* Name) = 0; ///< for debuggers and profilers
	virtual void EndMarker() = 0;

	// Called by hosts.
	/// Rows in Dest are tightly packed.
	virtual void CopyTextureToBuffer(IRTBuffer* Dest, uint64_t DestOffset, IRTTexture* Source, uint32_t Mip, uint32_t Layer) = 0;
	virtual void BeginRasterPass(const FRTRasterPassDesc& Desc) = 0; ///< viewport and scissor are the whole target
	virtual void EndRasterPass() = 0;
	virtual void SetIndexBuffer(IRTBuffer* Buffer, uint64_t Offset, ERTIndexType Type) = 0;
	virtual void Draw(uint32_t VertexCount, uint32_t InstanceCount) = 0;
	virtual void DrawIndexed(uint32_t IndexCount, uint32_t InstanceCount, uint32_t FirstIndex, int32_t VertexOffset) = 0;

	// Called by tests.
	virtual void ClearTexture(IRTTexture* Dest, const float Value[4]) = 0; ///< a colour texture in CopyWrite
	/// Keeps Object until the GPU has finished with the list. For what the list reaches without naming it: through an address, an
	/// index, or a scene's instances. FRTScene holds its geometries itself.
	virtual void KeepAlive(IRTRefCounted* Object) = 0;
	virtual uint64_t GetNative(ERTNative Kind) const = 0; ///< 0 if the list has none of this kind
};

/// Value on the timeline of one queue, which its two highest bits name; 0 is always complete. Fences of one queue are ordered
/// by time. Those of two queues must not be compared.
using FRTFence = uint64_t;
inline constexpr uint32_t FenceQueueShift = 62;
constexpr ERTQueue GetFenceQueue(FRTFence Fence) { return static_cast<ERTQueue>(Fence >> FenceQueueShift); }
constexpr uint64_t GetFenceValue(FRTFence Fence) { return Fence & ((1ull << FenceQueueShift) - 1); }
constexpr FRTFence MakeFence(ERTQueue Queue, uint64_t Value) { return uint64_t(Queue) << FenceQueueShift | Value; }

/// Creation calls write a new object with one reference to Out.
class IRTDevice : public IRTRefCounted
{
public:
	// Called by the plugin.
	virtual uint32_t GetVersion() const = 0; ///< RHIVersion of the implementation
	virtual const FRTCapabilities& GetCapabilities() const = 0;
	virtual FRTStatus CreateBuffer(const FRTBufferDesc& Desc, IRTBuffer** Out) = 0;
	/// Unsupported: the device lacks the format, the usage or the size.
	virtual FRTStatus CreateTexture(const FRTTextureDesc& Desc, IRTTexture** Out) = 0;
	virtual FRTStatus CreateComputePipeline(const FRTComputePipelineDesc& Desc, IRTPipeline** Out) = 0;
	/// Unsupported: the device lacks ray-tracing pipelines, the recursion depth, or libraries as the description needs them.
	virtual FRTStatus CreateRayTracingPipeline(const FRTRayTracingPipelineDesc& Desc, IRTPipeline** Out) = 0;
	/// Unsupported: the device lacks acceleration structures, or has them for fewer primitives.
	virtual FRTStatus CreateGeometry(const FRTGeometryDesc& Desc, IRTGeometry** Out) = 0;
	/// Returns the sizes that CreateGeometry would need, without creating anything. Desc.CompactedBytes is ignored. All sizes are 0
	/// if the device has no acceleration structures.
	virtual FRTBuildSizes GetGeometrySizes(const FRTGeometryDesc& Desc) = 0;
	/// Unsupported: the device lacks acceleration structures, or has them for fewer instances.
	virtual FRTStatus CreateScene(const FRTSceneDesc& Desc, IRTScene** Out) = 0;
	virtual FRTStatus CreateShaderTable(const FRTShaderTableDesc& Desc, IRTShaderTable** Out) = 0;
	/// Unsupported: queries of compacted sizes, if the device lacks acceleration structures.
	virtual FRTStatus CreateQueryPool(ERTQuery Kind, uint32_t Count, IRTQueryPool** Out) = 0;
	/// A list of ERTQueue::Transfer takes CopyBuffer, CopyBufferRegions and KeepAlive alone. Unsupported: the device lacks the queue.
	virtual FRTStatus CreateCommandList(const char* Name, IRTCommandList** Out, ERTQueue Queue = ERTQueue::Graphics) = 0;
	/// Runs the lists in order, on the one queue that all of them were created for. OutFence is complete when they are; it may be
	/// null. Waits: fences of other queues that the device waits for before it begins. Nothing else orders queues: what a list
	/// needs of another queue must be among them, or be known to be complete before this call.
	virtual FRTStatus Submit(
	    IRTCommandList* const* Lists, uint32_t Count, FRTFence* OutFence, const FRTFence* Waits = nullptr, uint32_t WaitCount = 0) = 0;
	/// Call it after the engine has submitted imported lists on the device's queue. OutFence: the fence of that work. An error of
	/// a list's GetStatus is returned, too; the fence is written all the same, because the list runs.
	/// Waits: fences of other queues that the engine's submission has waited for.
	virtual FRTStatus NotifyExternalSubmit(
	    IRTCommandList* const* Lists, uint32_t Count, FRTFence* OutFence, const FRTFence* Waits = nullptr, uint32_t WaitCount = 0) = 0;
	virtual FRTFence GetCompletedFence(ERTQueue Queue = ERTQueue::Graphics) = 0;
	/// Returns Timeout if the fence is not complete after TimeoutNs.
	virtual FRTStatus WaitFor(FRTFence Fence, uint64_t TimeoutNs) = 0;
	/// Destroys what was released and is no longer used. Submit and WaitFor call it; more calls do no harm.
	virtual void CollectGarbage() = 0;
	virtual FRTMemoryStats GetMemoryStats() const = 0;

	// Called by hosts.
	/// Wraps memory of the engine's, which must stay until Native.Released. Nothing is copied. Desc.Usage is what the engine
	/// created it with; Desc.Memory is ignored. Without Native.Handle, copies and barriers that name the buffer are not possible.
	/// InvalidArgument names what of Native or Desc cannot be; Released is not called then. Unsupported: the implementation imports
	/// nothing.
	virtual FRTStatus ImportBuffer(const FRTBufferDesc& Desc, const FRTNativeBuffer& Native, IRTBuffer** Out) = 0;
	/// Wraps the engine's texture (Vulkan: a VkImage), which must outlive the wrapper. Its access stays what it is now.
	/// Unsupported: as CreateTexture, or the implementation imports nothing.
	virtual FRTStatus ImportTexture(const FRTTextureDesc& Desc, uint64_t NativeImage, IRTTexture** Out) = 0;
	virtual FRTStatus CreateSampler(const FRTSamplerDesc& Desc, IRTSampler** Out) = 0;
	/// Unsupported: a port for an engine that rasterizes by itself need not implement it, nor raster passes.
	virtual FRTStatus CreateRasterPipeline(const FRTRasterPipelineDesc& Desc, IRTPipeline** Out) = 0;
	/// Records into the engine's command buffer (Vulkan: a VkCommandBuffer in the recording state). Begin and End must not be
	/// called. The engine submits it and calls NotifyExternalSubmit. Unsupported: the implementation imports nothing.
	virtual FRTStatus ImportCommandList(uint64_t NativeCommandBuffer, IRTCommandList** Out) = 0;
	virtual FRTStatus WaitIdle() = 0;
	/// Returns the number of messages of the backend's validation since creation (Vulkan: its validation layers, if on).
	virtual uint32_t GetValidationMessageCount() const = 0;
	virtual uint64_t GetNative(ERTNative Kind) const = 0; ///< 0 if the device has none of this kind
};

} // namespace Lantern
