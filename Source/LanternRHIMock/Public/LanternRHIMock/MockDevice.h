// An RHI without a GPU, for unit tests. It records every call, really executes copies, fills, clears and
// shader-table updates in submission order, and can be told to fail: allocations, compiles, the device itself.
// Handles of shader groups, compacted sizes and addresses are made up, but behave as those of a device.
// Dispatches, draws and rays are recorded only.
#pragma once

#include "LanternRHI/RTInterfaces.h"

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace Lantern
{

struct FMockState;

/// What the pretended device can do. The handle alignments of real devices: 32/32/64 (NVIDIA), 32/16/32 (lavapipe),
/// 32/64/64 and 64/64/256 (nobody yet, but the specification allows them).
struct FRTMockDesc
{
	ERTRung Rung = ERTRung::Pipeline;
	bool bRayQuery = true; ///< a device may have pipelines without ray query; ignored below the RayQuery rung
	bool bPipelineLibraries = true;
	bool bLibraryOnlyPipelines = true; ///< false: ray generation and miss groups must be the link's own
	uint32_t HandleSize = 32;
	uint32_t HandleAlignment = 32;
	uint32_t BaseAlignment = 64;
	uint32_t ScratchAlignment = 128;
	uint32_t MaxTextureDimension = 16384;
	uint32_t MaxPushConstantBytes = 128;
	uint32_t MaxBindlessTextures = 4096; ///< sampled and storage each
	uint32_t MaxSamplers = 64;
	uint32_t MaxScenes = 16;
	uint64_t DeviceMemoryBytes = 8ull << 30; ///< allocations beyond it return OutOfDeviceMemory
};

enum class ERTMockCall : uint8_t
{
	CreateBuffer,  ///< Numbers: size, usage, memory
	CreateTexture, ///< Numbers: width, height, mips, format
	ImportTexture, ///< Numbers: width, height, mips, native image
	CreateSampler,
	CreateComputePipeline,    ///< Numbers: shader words
	CreateRasterPipeline,     ///< Numbers: colour targets
	CreateRayTracingPipeline, ///< Numbers: shaders, own groups, recursion, payload bytes, libraries, is a library
	CreateGeometry,           ///< Numbers: sections, primitives, may update, compacted bytes
	CreateScene,              ///< Numbers: most instances
	CreateShaderTable,        ///< Numbers: ray generation, miss, hit, callable records
	CreateQueryPool,          ///< Numbers: queries, kind
	CreateCommandList,
	ImportCommandList,    ///< Numbers: native command buffer
	Submit,               ///< Numbers: lists, fence
	NotifyExternalSubmit, ///< Numbers: lists, fence
	WaitFor,              ///< Numbers: fence, timeout
	WaitIdle,
	ReserveShaderTable, ///< one that grows; Numbers: ray generation, miss, hit, callable records
	MakeHostCopy,       ///< of a shader table, beyond those it was created with; Numbers: bytes
	StageShaderTable,   ///< one that had anything new; Numbers: bytes
	SetTablePipeline,   ///< name: table
	Destroy,            ///< the native object, not the last Release(): never while in flight
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
	TraceRays,         ///< name: pipeline; Numbers: ray generation, width, height, depth; Bytes: push constants
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
	std::string Name; ///< the object acted on; draws, dispatches and rays: their pipeline
	std::string List; ///< the list that recorded it; empty for calls of the device
	FRTMockNumbers Numbers = {};
	std::vector<uint8_t> Bytes;
};

/// A shader record as the device sees it.
struct FRTMockRecord
{
	bool bInRange = false; ///< the record lies inside its region of the table
	bool bNull = false;    ///< no handle: never set, or set but not yet updated on the device
	/// The handle is of another pipeline than the one for which the device's copy was last updated, or of a destroyed one.
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
	IRTGeometry* Geometry = nullptr; ///< null: none lives at the address (now)
	std::string GeometryName;        ///< also of a destroyed one; "?" where no geometry ever had the address
	bool bDangling = false;
	bool bBuilt = false; ///< had been built when the scene was
};

struct FRTMockGeometry
{
	uint32_t BuildCount = 0;                  ///< executed full builds
	uint32_t UpdateCount = 0;                 ///< executed refits
	std::vector<FRTGeometrySection> Sections; ///< of the last one; its buffers may have been destroyed since
	std::string CompactedFrom;                ///< what CompactGeometry copied into it
	uint64_t CompactedSize = 0;               ///< bytes that it would need compacted, or needs

	bool IsUsable() const { return BuildCount > 0; } ///< built, or compacted from one that was
};

/// A shader table's host copies and its moves.
struct FRTMockTable
{
	uint32_t HostCopies = 0;      ///< there are now
	uint32_t HostCopiesInUse = 0; ///< staged, recorded, or read by what the device has not finished
	uint32_t HostCopiesMade = 0;  ///< ever: more than FRTShaderTableDesc::Copies where all were in use, or it grew
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
	/// false: calls are not recorded from now on (those recorded stay), so that memory stays bounded and calls are quick.
	/// Faults, errors and counts of waits work all the same. Default: true.
	void SetCallRecording(bool bRecord);
	/// Names of what was created since the last ClearCalls(), in order.
	std::vector<std::string> GetCreatedBuffers() const;
	std::vector<std::string> GetCreatedTextures() const;
	std::vector<std::string> GetCreatedPipelines() const;
	/// Native objects not yet destroyed, released ones still in flight included.
	uint32_t GetLiveObjectCount() const;
	std::vector<std::string> GetLiveObjects() const; ///< "Buffer Name", sorted
	/// What a GPU would have crashed on: scenes built from dangling or never built geometries, rays into a table
	/// that was never updated, libraries used as pipelines, compaction of the wrong size. Empty is right. The first 1000.
	std::vector<std::string> GetErrors() const;

	// ------------------------------------------------------------------------------------------ what is in memory
	/// Memory of any buffer, Device ones included. Null: not a buffer of a mock.
	uint8_t* GetBytes(IRTBuffer* Buffer) const;
	/// Tightly packed texels. Empty: not a texture of a mock.
	std::vector<uint8_t> GetTexels(IRTTexture* Texture, uint32_t Mip = 0, uint32_t Layer = 0) const;
	/// The live buffer that holds the device address; null: none.
	IRTBuffer* FindBuffer(uint64_t DeviceAddress, uint64_t* OutOffset = nullptr) const;
	/// Any record of the device's copy of the table, as executed submissions left it: what is in flight is not in it yet.
	FRTMockRecord ResolveRecord(IRTShaderTable* Table, ERTRecordKind Kind, uint32_t Index) const;
	/// The hit record a ray reaches: TableOffset + GeometryIndex · RayMultiplier + RayType.
	FRTMockRecord ResolveHit(
	    IRTShaderTable* Table, const FRTInstance& Instance, uint32_t GeometryIndex, uint32_t RayType, uint32_t RayMultiplier) const;
	/// Instances of the last executed BuildScene.
	std::vector<FRTMockInstance> GetSceneInstances(IRTScene* Scene) const;
	FRTMockGeometry GetGeometry(IRTGeometry* Geometry) const;
	FRTMockTable GetTable(IRTShaderTable* Table) const;
	FRTMockTraffic GetTraffic() const;
	void ClearTraffic();

	// ------------------------------------------------------------------------------------------ time
	/// true: a submission executes and completes only by CompleteUpTo(), WaitIdle(), or WaitFor() without a time limit;
	/// WaitFor() with one returns Timeout. So a buffer that the CPU overwrites too early is seen overwritten.
	/// false (default): submissions execute within Submit(). Turning it off completes all.
	void SetManualFences(bool bManual);
	void CompleteUpTo(FRTFence Fence);
	FRTFence GetLastFence() const;     ///< of the last submission
	uint32_t GetBlockingWaits() const; ///< WaitFor/WaitIdle calls that found work unfinished

	// ------------------------------------------------------------------------------------------ faults
	/// The N-th allocation from now (1: the next) returns OutOfDeviceMemory; 0: none. Allocations are buffers, textures,
	/// geometries, scenes, shader tables (one, with its copies), their growth (ReserveShaderTable) and host copies made
	/// later (MakeHostCopy).
	void FailAllocation(uint32_t N);
	void FailEveryAllocation(uint32_t N); ///< every N-th from now; 0: none
	/// Pipelines and libraries whose name contains Part take Milliseconds longer to create. Creating threads sleep side by
	/// side, and the device goes on meanwhile.
	void SlowCompile(const std::string& Part, uint32_t Milliseconds);
	/// Rays of a pipeline that is used for the first time take Milliseconds longer, by the device's timestamps. Nothing sleeps.
	void SlowFirstUse(uint32_t Milliseconds);
	/// Pipelines and libraries whose name contains Part stay in the driver until ClearCompileFaults(), which must come before
	/// anything waits for the creating threads. The device goes on meanwhile.
	void HoldCompiles(const std::string& Part);
	/// Threads that are in a slow compile or in a held one now.
	uint32_t GetCompilesInDriver() const;
	/// Pipelines and libraries whose name contains Part fail with CompileFailed. A link has its own name.
	void FailCompile(const std::string& Part);
	void ClearCompileFaults(); ///< slow ones, held ones, failing ones
	/// The device is lost at the next call of this kind.
	void LoseDeviceAt(ERTMockCall Kind);
	void LoseDevice();

private:
	FMockState& State;
};

/// Out receives one reference. Fails only where Desc cannot be a device (an alignment that is no power of two).
FRTStatus CreateMockDevice(const FRTMockDesc& Desc, IRTDevice** Out);

/// Device must come from CreateMockDevice, unwrapped; anything else is a bug (assert).
FRTMock& GetMock(IRTDevice* Device);

} // namespace Lantern
