// An RHI without a GPU, for unit tests. It records every call, and really executes copies, fills, clears and shader-table
// updates, in submission order. Dispatches, draws and rays are recorded only. Handles of shader groups, compacted sizes and
// addresses are made up, but behave as those of a device. Tests can make allocations, compiles and the device itself fail.
#pragma once

#include "LanternRHI/RTInterfaces.h"

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace Lantern
{

struct FMockState;

/// What the pretended device can do. Real devices have handle size, handle alignment and base alignment 32/32/64 (NVIDIA) or
/// 32/16/32 (lavapipe). The specification allows 32/64/64 and 64/64/256 too, which no device has yet.
struct FRTMockDesc
{
	ERTRung Rung = ERTRung::Pipeline;
	bool bRayQuery = true; ///< a device may have pipelines without ray query; ignored below the RayQuery rung
	bool bPipelineLibraries = true;
	bool bIndirectTrace = true;  ///< ignored below the Pipeline rung
	bool bTransferQueue = false; ///< all queues share one timeline: what is submitted completes in that order
	bool bAsyncComputeQueue = true;
	bool bLibraryOnlyPipelines = true; ///< if false, ray generation and miss groups must be the link's own
	uint32_t HandleSize = 32;
	uint32_t HandleAlignment = 32;
	uint32_t BaseAlignment = 64;
	uint32_t ScratchAlignment = 128;
	uint32_t MaxTextureDimension = 16384;
	uint32_t MaxPushConstantBytes = 128;
	uint32_t MaxBindlessTextures = 4096; ///< of sampled and of storage textures each
	uint32_t MaxSamplers = 64;
	uint32_t MaxScenes = 16;
	uint64_t DeviceMemoryBytes = 8ull << 30; ///< allocations beyond it return OutOfDeviceMemory
};

enum class ERTMockCall : uint8_t
{
	CreateBuffer,  ///< Numbers: size, usage, memory
	CreateTexture, ///< Numbers: width, height, mips, format
	ImportBuffer,  ///< Numbers: size, native handle, native address
	ImportTexture, ///< Numbers: width, height, mips, native image
	CreateSampler,
	CreateComputePipeline,    ///< Numbers: shader words
	CreateRasterPipeline,     ///< Numbers: colour targets
	CreateRayTracingPipeline, ///< Numbers: shaders, own groups, recursion, payload bytes, libraries, is a library
	CreateGeometry,           ///< Numbers: sections, primitives, may update, compacted bytes
	CreateScene,              ///< Numbers: most instances
	CreateShaderTable,        ///< Numbers: ray generation, miss, hit, callable records
	CreateQueryPool,          ///< Numbers: queries, kind
	CreateCommandList,        ///< Numbers: queue
	ImportCommandList,        ///< Numbers: native command buffer
	Submit,                   ///< Numbers: lists, fence, queue; Bytes: FRTFence[], those that it waits for
	NotifyExternalSubmit,     ///< Numbers: lists, fence
	WaitFor,                  ///< Numbers: fence, timeout
	WaitIdle,
	ReserveShaderTable, ///< only if the table grows; Numbers: ray generation, miss, hit, callable records
	MakeHostCopy,       ///< for a shader table, beyond those of its creation; Numbers: bytes
	StageShaderTable,   ///< only if there was anything new; Numbers: bytes
	SetTablePipeline,   ///< name: table
	Destroy,            ///< of the native object, after the last Release() and never while in flight
	Begin,
	End,
	Barrier,             ///< one per item; name of the resource or empty; Numbers: before, after
	CopyBuffer,          ///< name: destination; Numbers: destination offset, source offset, size
	CopyBufferToTexture, ///< Numbers: mip, layer, source offset
	CopyTextureToBuffer, ///< name: source; Numbers: mip, layer, destination offset
	FillBuffer,          ///< Numbers: offset, size, value
	ClearTexture,
	GenerateMips,
	SetPipeline,
	PushConstants,     ///< Bytes
	Dispatch,          ///< name: pipeline; Numbers: groups; Bytes: push constants
	DispatchIndirect,  ///< name: pipeline; Numbers: offset; Bytes: push constants
	TraceRays,         ///< name: pipeline; Numbers: ray generation, width, height, depth; Bytes: push constants
	TraceRaysIndirect, ///< name: pipeline; Numbers: ray generation, offset; Bytes: push constants
	UpdateShaderTable, ///< Numbers: bytes copied, ranges, bytes moved within the device
	BeginRasterPass,   ///< name: first target; Numbers: width, height, colours, has depth
	EndRasterPass,
	SetIndexBuffer,     ///< Numbers: offset, type
	Draw,               ///< name: pipeline; Numbers: vertices, instances; Bytes: push constants
	DrawIndexed,        ///< name: pipeline; Numbers: indices, instances, first, offset; Bytes: push constants
	BuildGeometry,      ///< one per geometry; Numbers: sections, is update, scratch offset
	BuildScene,         ///< Numbers: instances, instance offset, scratch offset
	WriteCompactedSize, ///< name: geometry; Numbers: query
	CompactGeometry,    ///< name: destination
	KeepAlive,
	WriteTimestamp, ///< Numbers: index
	ResetQueries,   ///< Numbers: first, count
	BeginMarker,
	EndMarker,
};

using FRTMockNumbers = std::array<uint64_t, 6>;

struct FRTMockCall
{
	ERTMockCall Kind = ERTMockCall::CreateBuffer;
	std::string Name; ///< the object acted on; for draws, dispatches and rays their pipeline
	std::string List; ///< the list that recorded it; empty for calls of the device
	/// A number of its own for each recording of a list; 0 for calls of the device. Calls of lists that are submitted together
	/// come behind each other, in the order of the lists, whichever thread recorded first.
	uint64_t Recording = 0;
	FRTMockNumbers Numbers = {};
	std::vector<uint8_t> Bytes;
};

/// A shader record as the device sees it.
struct FRTMockRecord
{
	bool bInRange = false; ///< the record lies inside its region of the table
	bool bNull = false;    ///< has no handle: never set, or set but not yet updated on the device
	/// The handle's pipeline is not the one for which the device's copy was last updated, or it was destroyed.
	bool bStale = false;
	uint32_t Index = 0;
	uint32_t Group = 0;
	std::string Pipeline;
	std::string General, ClosestHit, AnyHit, Intersection; ///< names of the group's shaders
	std::vector<uint8_t> Data;                             ///< record data beside the handle
	std::string Error;                                     ///< why IsGood() is false; empty otherwise
	bool IsGood() const { return Error.empty(); }
};

struct FRTMockInstance
{
	FRTInstance Instance = {};
	IRTGeometry* Geometry = nullptr; ///< null if none lives at the address now
	std::string GeometryName;        ///< stays after destruction; "?" if no geometry ever had the address
	bool bDangling = false;
	bool bBuilt = false; ///< the geometry had been built when the scene was
};

struct FRTMockGeometry
{
	uint32_t BuildCount = 0;                  ///< executed full builds
	uint32_t UpdateCount = 0;                 ///< executed refits
	std::vector<FRTGeometrySection> Sections; ///< of the last build; its buffers may have been destroyed since
	std::string CompactedFrom;                ///< what CompactGeometry copied into it
	uint64_t CompactedSize = 0;               ///< bytes that it would need compacted, or needs

	bool IsUsable() const { return BuildCount > 0; } ///< built, or compacted from one that was
};

/// A shader table's host copies and its moves.
struct FRTMockTable
{
	uint32_t HostCopies = 0;      ///< that exist now
	uint32_t HostCopiesInUse = 0; ///< staged, recorded, or read by what the device has not finished
	uint32_t HostCopiesMade = 0;  ///< ever; more than FRTShaderTableDesc::Copies if all were in use or the table grew
	uint64_t HostBytes = 0;       ///< of all host copies
	uint32_t Moves = 0;           ///< executed moves into larger device memory
};

/// Bytes that executed commands copied since the last ClearTraffic().
struct FRTMockTraffic
{
	uint64_t Buffer = 0;     ///< CopyBuffer, and between buffers and textures
	uint64_t Table = 0;      ///< shader records, from host to device
	uint64_t TableMoved = 0; ///< shader records, from device to device
	uint64_t Instances = 0;  ///< read by BuildScene
};

/// Inspection and fault injection. Thread-safe; lives as long as its device.
class FRTMock
{
public:
	explicit FRTMock(FMockState& InState) : State(InState) {}
	FRTMock(const FRTMock&) = delete;
	FRTMock& operator=(const FRTMock&) = delete;

	// ------------------------------------------------------------------------------------------ what was called
	std::vector<FRTMockCall> GetCalls() const;
	std::vector<FRTMockCall> FindCalls(ERTMockCall Kind) const;
	/// Name: exact.
	std::vector<FRTMockCall> FindCalls(ERTMockCall Kind, const std::string& Name) const;
	std::vector<FRTMockCall> FindDispatches(const std::string& Pipeline) const;
	uint32_t CountCalls(ERTMockCall Kind) const;
	uint32_t CountCalls(ERTMockCall Kind, const std::string& Name) const;
	void ClearCalls();
	/// If false, calls are not recorded from now on, so that memory stays bounded and calls are quick. Those recorded stay.
	/// Faults, errors and counts of waits work all the same. Default: true.
	void SetCallRecording(bool bRecord);
	// Names of what was created since the last ClearCalls(), in order.
	std::vector<std::string> GetCreatedBuffers() const;
	std::vector<std::string> GetCreatedTextures() const;
	std::vector<std::string> GetCreatedPipelines() const;
	/// Counts the native objects that are not destroyed yet, including released ones still in flight.
	uint32_t GetLiveObjectCount() const;
	std::vector<std::string> GetLiveObjects() const; ///< "Buffer Name", sorted
	/// Returns the first 1000 faults on which a GPU might have crashed; empty is right. Examples are scenes built from dangling or
	/// never built geometries, rays into a table that was never updated, and libraries used as pipelines.
	std::vector<std::string> GetErrors() const;

	// ------------------------------------------------------------------------------------------ what is in memory
	/// Returns the memory of any buffer, Device buffers included. Null if it is not a buffer of a mock.
	uint8_t* GetBytes(IRTBuffer* Buffer) const;
	/// Returns tightly packed texels. Empty if it is not a texture of a mock.
	std::vector<uint8_t> GetTexels(IRTTexture* Texture, uint32_t Mip = 0, uint32_t Layer = 0) const;
	/// Returns the live buffers of this name, by address.
	std::vector<IRTBuffer*> FindLiveBuffers(const std::string& Name) const;
	std::vector<IRTScene*> FindLiveScenes() const;
	std::vector<IRTShaderTable*> FindLiveTables() const;
	/// Returns the live buffer that holds the device address, or null.
	IRTBuffer* FindBuffer(uint64_t DeviceAddress, uint64_t* OutOffset = nullptr) const;
	/// Returns a record of the device's copy of the table, as executed submissions left it. What is in flight is not in it yet.
	FRTMockRecord ResolveRecord(IRTShaderTable* Table, ERTRecordKind Kind, uint32_t Index) const;
	/// Returns the hit record that a ray reaches: TableOffset + GeometryIndex · RayMultiplier + RayType.
	FRTMockRecord ResolveHit(
	    IRTShaderTable* Table, const FRTInstance& Instance, uint32_t GeometryIndex, uint32_t RayType, uint32_t RayMultiplier) const;
	/// Returns the instances of the last executed BuildScene.
	std::vector<FRTMockInstance> GetSceneInstances(IRTScene* Scene) const;
	FRTMockGeometry GetGeometry(IRTGeometry* Geometry) const;
	FRTMockTable GetTable(IRTShaderTable* Table) const;
	FRTMockTraffic GetTraffic() const;
	void ClearTraffic();

	// ------------------------------------------------------------------------------------------ time
	/// If true, a submission executes and completes only by CompleteUpTo(), WaitIdle(), or WaitFor() without a time limit. WaitFor()
	/// with one returns Timeout. So a buffer that the CPU overwrites too early is seen overwritten.
	/// If false (default), submissions execute within Submit(). Turning it off completes all.
	void SetManualFences(bool bManual);
	void CompleteUpTo(FRTFence Fence);
	FRTFence GetLastFence() const;     ///< of the last submission
	uint32_t GetBlockingWaits() const; ///< WaitFor/WaitIdle calls that found work unfinished

	// ------------------------------------------------------------------------------------------ faults
	/// Makes the N-th allocation from now return OutOfDeviceMemory; 1 is the next, 0 is none. Allocations are buffers, textures,
	/// geometries, scenes, shader tables (one, with its copies), their growth (ReserveShaderTable) and host copies made later
	/// (MakeHostCopy).
	void FailAllocation(uint32_t N);
	void FailEveryAllocation(uint32_t N); ///< every N-th from now; 0 is none
	/// Makes pipelines and libraries whose name contains Part take Milliseconds longer to create. Creating threads sleep side by
	/// side, and the device goes on meanwhile.
	void SlowCompile(const std::string& Part, uint32_t Milliseconds);
	/// Makes the first rays of each pipeline take Milliseconds longer, by the device's timestamps. Nothing sleeps.
	void SlowFirstUse(uint32_t Milliseconds);
	/// Keeps pipelines and libraries whose name contains Part in the driver until ClearCompileFaults(). Call that before anything
	/// waits for the creating threads. The device goes on meanwhile.
	void HoldCompiles(const std::string& Part);
	/// Returns the number of threads that are in a slow or held compile now.
	uint32_t GetCompilesInDriver() const;
	/// Makes pipelines and libraries whose name contains Part fail with CompileFailed. A link has a name of its own.
	void FailCompile(const std::string& Part);
	/// Makes pipelines and libraries whose name contains Part fail with OutOfDeviceMemory.
	void StarveCompiles(const std::string& Part);
	void ClearCompileFaults(); ///< ends SlowCompile, HoldCompiles, FailCompile and StarveCompiles
	/// Loses the device at the next call of this kind.
	void LoseDeviceAt(ERTMockCall Kind);
	void LoseDevice();

private:
	FMockState& State;
};

/// Out receives one reference. Fails only if Desc cannot be a device: an alignment is no power of two, or handles are too small.
FRTStatus CreateMockDevice(const FRTMockDesc& Desc, IRTDevice** Out);

/// Device must come from CreateMockDevice, unwrapped; anything else is a bug (assert).
FRTMock& GetMock(IRTDevice* Device);

} // namespace Lantern
