// Plain types of the RHI: enums, capabilities, descriptions. C++17, no Vulkan, no standard containers, so that an engine with
// its own allocator and ABI can include it. A call reads the description that it takes and keeps none of its pointers: what
// they point at need not outlive the call.
#pragma once

#include "LanternRHI/RTFormat.h"
#include "LanternRHI/RTStatus.h"

namespace Lantern
{

// ---------------------------------------------------------------------------------------------------- enums

enum class ERTMemory : uint8_t
{
	Device,   ///< not mappable
	Upload,   ///< mapped, written by the CPU, coherent
	Readback, ///< mapped, read by the CPU, coherent, cached
};

/// Uses of a buffer (flags). Every buffer has a device address.
enum class ERTBufferUsage : uint32_t
{
	None = 0,
	Storage = 1 << 0,
	Index = 1 << 1,
	Indirect = 1 << 2,
	CopySource = 1 << 3,
	CopyDest = 1 << 4,
	GeometryInput = 1 << 5, ///< vertices, indices, AABBs or instances of an acceleration structure build
	Scratch = 1 << 6,       ///< scratch of builds; aligned to FRTCapabilities::ScratchAlignment
	ShaderTable = 1 << 7,
};

/// Uses of a texture (flags).
enum class ERTTextureUsage : uint32_t
{
	None = 0,
	Sampled = 1 << 0, ///< gets a sampled index in the bindless heap
	Storage = 1 << 1, ///< gets a storage index in the bindless heap
	RenderTarget = 1 << 2,
	Depth = 1 << 3,
	CopySource = 1 << 4,
	CopyDest = 1 << 5,
};

/// Use of a resource between two barriers. A texture's layout follows from it. Reads may be combined with |. A write stands
/// alone, but StorageWrite may be combined with ShaderRead on a storage texture or buffer (read-modify-write).
enum class ERTAccess : uint32_t
{
	None = 0,              ///< contents are undefined (textures: the layout too)
	ShaderRead = 1 << 0,   ///< sampled texture, or buffer read by any shader stage
	StorageRead = 1 << 1,  ///< imageLoad
	StorageWrite = 1 << 2, ///< imageStore, buffer writes, atomics
	RenderTarget = 1 << 3, ///< colour attachment, read and write
	DepthWrite = 1 << 4,   ///< depth attachment, read and write
	IndexRead = 1 << 5,
	IndirectRead = 1 << 6,
	CopyRead = 1 << 7,
	CopyWrite = 1 << 8,
	GeometryInput = 1 << 9, ///< read by an acceleration structure build
	BuildRead = 1 << 10,    ///< a BLAS read by a TLAS build, or the source of an update
	BuildWrite = 1 << 11,   ///< an acceleration structure or scratch written by a build
	TraceRead = 1 << 12,    ///< an acceleration structure or shader table read by rays
	HostRead = 1 << 13,
	/// An imported texture as its engine has it: IRTTexture::SetExternalState says how. Before or After of a barrier, alone.
	External = 1 << 14,
};

enum class ERTIndexType : uint8_t
{
	None, ///< vertices in order
	UInt16,
	UInt32,
};

/// How an engine leaves an imported texture, or wants it back, in terms of the peer's API. Vulkan: VkImageLayout,
/// VkPipelineStageFlags2, VkAccessFlags2.
struct FRTExternalState
{
	uint32_t Layout = 0;
	/// Before Lantern: stages and accesses since the last write, that write included, and what the engine's own barriers after it
	/// lead to. After Lantern: those of the engine's next use.
	uint64_t Stages = 0;
	uint64_t Accesses = 0;
};

enum class ERTShaderStage : uint8_t
{
	Vertex,
	Fragment,
	Compute,
	RayGen,
	Miss,
	ClosestHit,
	AnyHit,
	Intersection,
	Callable,
};

/// Queues of a device. Work on one queue runs in the order of its submission, work on two queues side by side.
enum class ERTQueue : uint8_t
{
	Graphics,     ///< takes every command; each device has it
	AsyncCompute, ///< takes all but raster; see FRTCapabilities::bAsyncComputeQueue
	Transfer,     ///< copies between buffers; see FRTCapabilities::bTransferQueue
};
inline constexpr uint32_t QueueCount = 3;

#define LANTERN_RT_FLAGS(E)                                                                                                                \
	constexpr E operator|(E A, E B) { return static_cast<E>(static_cast<uint32_t>(A) | static_cast<uint32_t>(B)); }                        \
	constexpr E operator&(E A, E B) { return static_cast<E>(static_cast<uint32_t>(A) & static_cast<uint32_t>(B)); }                        \
	constexpr E& operator|=(E& A, E B) { return A = A | B; }                                                                               \
	constexpr bool HasAny(E A, E B) { return (static_cast<uint32_t>(A) & static_cast<uint32_t>(B)) != 0; }

LANTERN_RT_FLAGS(ERTBufferUsage)
LANTERN_RT_FLAGS(ERTTextureUsage)
LANTERN_RT_FLAGS(ERTAccess)

// ---------------------------------------------------------------------------------------------------- capabilities

/// What a device can do, as rungs of a ladder: each includes those before it. Chosen once, when the device is created.
enum class ERTRung : uint8_t
{
	None,     ///< raster and compute only: no ray-traced feature runs
	RayQuery, ///< inline rays in compute; no hit groups, so no reference path tracer and no RTPSO
	Pipeline, ///< ray-tracing pipelines; a device may have these without ray query (see bRayQuery)
	Reorder,  ///< shader execution reordering; below it, divergent hit shading is slower
	Micromap, ///< opacity micromaps; below it, alpha tests run in any-hit shaders
};

struct FRTCapabilities
{
	char DeviceName[256] = {};
	char DriverName[256] = {}; ///< name and version as the driver gives them, in characters that may be shown
	bool bIsCpu = false;       ///< renders on the processor: report no absolute times
	ERTRung Rung = ERTRung::None;
	bool bRayQuery = false;
	bool bRayTracingPipeline = false;
	bool bPipelineLibraries = false;
	/// A linked pipeline may take all of its groups from libraries. If false, the driver needs ray generation and miss groups
	/// among the link's own (FRTRayTracingPipelineDesc::Groups). Hit groups may always come from libraries.
	bool bLibraryOnlyPipelines = false;
	bool bDeferredOperations = false; ///< the extension is there; it may still never defer
	bool bIndirectTrace = false;
	bool bPositionFetch = false;
	bool bReorder = false;
	bool bMicromap = false;
	bool bTimestamps = false;
	bool bTransferQueue = false;     ///< has ERTQueue::Transfer
	bool bAsyncComputeQueue = false; ///< has ERTQueue::AsyncCompute
	uint32_t ShaderGroupHandleSize = 0;
	uint32_t ShaderGroupHandleAlignment = 0;
	uint32_t ShaderGroupBaseAlignment = 0;
	uint32_t MaxShaderGroupStride = 0;
	uint32_t MaxRayRecursionDepth = 0;
	uint32_t ScratchAlignment = 0;
	uint64_t MaxInstanceCount = 0;
	uint64_t MaxPrimitiveCount = 0;
	uint32_t MaxTextureDimension = 0;
	uint32_t MaxPushConstantBytes = 128;
	uint32_t MaxBindlessTextures = 0; ///< of sampled and of storage textures each
	uint64_t DeviceMemoryBytes = 0;
	double TimestampPeriodNs = 0.0;
};

// ---------------------------------------------------------------------------------------------------- descriptions

class IRTBuffer;
class IRTTexture;
class IRTPipeline;
class IRTGeometry;
class IRTScene;

struct FRTBufferDesc
{
	uint64_t Size = 0; ///< bytes, > 0
	ERTBufferUsage Usage = ERTBufferUsage::None;
	ERTMemory Memory = ERTMemory::Device;
	const char* Name = ""; ///< reaches debugger and profiler
};

/// Memory that the engine owns, for IRTDevice::ImportBuffer.
struct FRTNativeBuffer
{
	uint64_t Handle = 0; ///< Vulkan: a VkBuffer with SHADER_DEVICE_ADDRESS usage; 0: only Address is known
	/// Device address of the first byte, a multiple of 16. 0: asked of Handle.
	uint64_t Address = 0;
	/// Called once, from any thread, when neither Lantern nor work that the GPU still has can reach the memory. It must not call
	/// the device. May be null.
	void (*Released)(void* User) = nullptr;
	void* User = nullptr;
};

struct FRTTextureDesc
{
	uint32_t Width = 0, Height = 0;
	uint32_t MipCount = 1;
	uint32_t ArraySize = 1; ///< if > 1, the sampled view is a 2D array
	ERTFormat Format = ERTFormat::Unknown;
	ERTTextureUsage Usage = ERTTextureUsage::None;
	const char* Name = "";
	/// IRTDevice::ImportTexture only. The engine's view of the image, which shaders then sample (Vulkan: a 2D VkImageView of one
	/// aspect). It must outlive the texture. 0: a view of the whole image in Format is made.
	uint64_t NativeView = 0;
	/// The sampled view is a cube of the layers +x, −x, +y, −y, +z, −z. ArraySize is 6, and width equals height.
	bool bCube = false;
};

enum class ERTFilter : uint8_t
{
	Nearest,
	Linear
};
enum class ERTAddress : uint8_t
{
	Repeat,
	Clamp,
	Mirror
};

struct FRTSamplerDesc
{
	ERTFilter Min = ERTFilter::Linear, Mag = ERTFilter::Linear, Mip = ERTFilter::Linear;
	ERTAddress U = ERTAddress::Repeat, V = ERTAddress::Repeat;
	float MaxAnisotropy = 1.0f;
	const char* Name = "";
	/// An engine's own sampler (Vulkan: VkSampler), which must outlive this one. All other members but Name are then ignored.
	/// 0: one is made. Implementations that import nothing return Unsupported.
	uint64_t NativeSampler = 0;
};

/// SPIR-V of one stage. Its entry point is "main".
struct FRTShaderCode
{
	const uint32_t* Words = nullptr;
	size_t WordCount = 0;
	ERTShaderStage Stage = ERTShaderStage::Compute;
	const char* Name = "";
};

struct FRTComputePipelineDesc
{
	FRTShaderCode Shader;
	const char* Name = "";
};

enum class ERTCull : uint8_t
{
	None,
	Back,
	Front
};

/// Raster pipelines pull their vertices from buffer addresses: there is no vertex input. Clip space is Vulkan's: y down, z from
/// 0 to 1. Counter-clockwise is front, as seen on the target. Depth is reversed (1 near, 0 far); the test is
/// greater-or-equal, unless bReversedDepth says otherwise.
struct FRTRasterPipelineDesc
{
	FRTShaderCode Vertex;
	FRTShaderCode Fragment; ///< Words may be null for depth only
	const ERTFormat* ColorFormats = nullptr;
	uint32_t ColorCount = 0;
	ERTFormat DepthFormat = ERTFormat::Unknown; ///< Unknown for no depth test
	ERTCull Cull = ERTCull::Back;
	bool bDepthWrite = true;
	bool bReversedDepth = true; ///< if false, 0 is near and the test is less-or-equal
	const char* Name = "";
};

inline constexpr uint32_t NoShader = ~0u;

enum class ERTGroupKind : uint8_t
{
	General, ///< ray generation, miss or callable
	Triangles,
	Procedural, ///< AABBs with an intersection shader
};

/// A group of shaders. Members are indices into FRTRayTracingPipelineDesc::Shaders, or NoShader.
struct FRTShaderGroup
{
	ERTGroupKind Kind = ERTGroupKind::General;
	uint32_t General = NoShader;
	uint32_t ClosestHit = NoShader;
	uint32_t AnyHit = NoShader;
	uint32_t Intersection = NoShader;
};

/// A monolithic pipeline (no libraries), a library, or a pipeline linked from libraries. Its own groups are numbered first, then
/// those of each library in order. bLibrary and Libraries need FRTCapabilities::bPipelineLibraries.
struct FRTRayTracingPipelineDesc
{
	const FRTShaderCode* Shaders = nullptr; ///< may be null if there are libraries
	uint32_t ShaderCount = 0;
	const FRTShaderGroup* Groups = nullptr;
	uint32_t GroupCount = 0;
	/// Libraries to link, made with bLibrary and with the recursion, payload and attribute sizes of this description. They may be
	/// released afterwards: the linked pipeline keeps what it needs.
	IRTPipeline* const* Libraries = nullptr;
	uint32_t LibraryCount = 0;
	/// Makes a library, which has at least one shader. It is good for linking only, never for SetPipeline or a shader table.
	bool bLibrary = false;
	uint32_t MaxRecursion = 1;
	uint32_t MaxPayloadBytes = 32;
	uint32_t MaxAttributeBytes = 8;
	const char* Name = "";
};

/// What every device can build from. Normalised numbers are from −1 to 1.
enum class ERTVertexFormat : uint8_t
{
	Float3,
	Half4,    ///< the fourth is not read
	Snorm16x4 ///< the fourth is not read
};
constexpr uint32_t GetPositionBytes(ERTVertexFormat Format) { return Format == ERTVertexFormat::Float3 ? 12 : 8; }

/// One section of a geometry: triangles, or, if bProcedural, AABBs of six floats (min, max). Sizes depend on counts, strides,
/// formats and flags alone; addresses are read when the geometry is built.
struct FRTGeometrySection
{
	IRTBuffer* Vertices = nullptr; ///< or the AABBs
	uint64_t VertexOffset = 0;     ///< bytes
	uint32_t VertexStride = 12;    ///< bytes, a multiple of 4; 24 for AABBs
	uint32_t VertexCount = 0;      ///< or the number of AABBs
	IRTBuffer* Indices = nullptr;
	uint64_t IndexOffset = 0; ///< bytes
	uint32_t TriangleCount = 0;
	ERTIndexType IndexType = ERTIndexType::UInt32;
	bool bOpaque = true; ///< if false, any-hit shaders run
	bool bProcedural = false;
	ERTVertexFormat VertexFormat = ERTVertexFormat::Float3; ///< of triangles
};

struct FRTGeometryDesc
{
	const FRTGeometrySection* Sections = nullptr;
	uint32_t SectionCount = 0; ///< > 0, each with at least one primitive
	bool bAllowUpdate = false; ///< may be refitted
	bool bFastBuild = false;   ///< prefers build speed to trace speed
	bool bAllowCompaction = false;
	/// If > 0, makes storage of this many bytes for a compacted copy (IRTCommandList::CompactGeometry). All other members are
	/// those of the geometry to be copied.
	uint64_t CompactedBytes = 0;
	const char* Name = "";
};

struct FRTSceneDesc
{
	uint32_t MaxInstances = 0;
	bool bFastBuild = false;
	const char* Name = "";
};

/// Bits of FRTInstance::Flags.
inline constexpr uint8_t InstanceCullDisable = 1;
/// Turns the front of triangles around. A triangle's front is the side from which its vertices run counter-clockwise in object
/// space (right-handed, as in glTF).
inline constexpr uint8_t InstanceFlipFacing = 2;
inline constexpr uint8_t InstanceForceOpaque = 4;
inline constexpr uint8_t InstanceForceNoOpaque = 8;

/// One instance as the GPU reads it. The CPU or a shader writes it to a GeometryInput buffer.
struct FRTInstance
{
	float Transform[12];          ///< object to world, 3 rows of 4
	uint32_t CustomIndexAndMask;  ///< index in the low 24 bits, mask in the high 8
	uint32_t TableOffsetAndFlags; ///< first hit record in the low 24 bits, Instance… flags in the high 8
	uint64_t GeometryAddress;     ///< IRTGeometry::GetDeviceAddress()
};
static_assert(sizeof(FRTInstance) == 64, "layout of VkAccelerationStructureInstanceKHR");

inline constexpr uint32_t MaxInstanceIndex = (1u << 24) - 1;

struct FRTBuildSizes
{
	uint64_t StructureBytes = 0;
	uint64_t BuildScratchBytes = 0;
	uint64_t UpdateScratchBytes = 0;
};

struct FRTGeometryBuild
{
	IRTGeometry* Geometry = nullptr;
	/// Counts, strides and flags are those given at creation.
	const FRTGeometrySection* Sections = nullptr;
	uint32_t SectionCount = 0;
	bool bUpdate = false; ///< refits in place; needs bAllowUpdate and an earlier build
	IRTBuffer* Scratch = nullptr;
	uint64_t ScratchOffset = 0; ///< bytes, a multiple of ScratchAlignment; builds of one call must not overlap
};

enum class ERTQuery : uint8_t
{
	Timestamp,
	CompactedSize, ///< bytes that a built geometry needs once compacted
};

/// The most bytes of data that a record has beside its handle.
inline constexpr uint32_t MaxRecordDataBytes = 32;

struct FRTShaderTableDesc
{
	IRTPipeline* Pipeline = nullptr; ///< must have been created for ray tracing
	uint32_t RayGenCount = 1;
	uint32_t MissCount = 0;
	uint32_t HitCount = 0;
	uint32_t CallableCount = 0;
	uint32_t RecordDataBytes = 0; ///< of hit records, ≤ MaxRecordDataBytes; the others carry none
	/// Host copies made at creation (≥ 1): one for each frame in flight, and one to fill. If all are in use, another is made;
	/// nothing waits.
	uint32_t Copies = 3;
	const char* Name = "";
};

enum class ERTRecordKind : uint8_t
{
	RayGen,
	Miss,
	Hit,
	Callable
};

struct FRTBarrier
{
	IRTBuffer* Buffer = nullptr;   ///< at most one of Buffer and Texture; without one, a memory barrier
	IRTTexture* Texture = nullptr; ///< all mips and layers
	ERTAccess Before = ERTAccess::None;
	ERTAccess After = ERTAccess::None;
	/// Before was on another queue, whose fence is among the waits of the submission. The waits order the two, and the barrier
	/// changes a texture's layout.
	bool bOtherQueue = false;
};

struct FRTColorTarget
{
	IRTTexture* Texture = nullptr;
	bool bClear = true;
	float Clear[4] = {0, 0, 0, 0};
};

struct FRTRasterPassDesc
{
	const FRTColorTarget* Colors = nullptr;
	uint32_t ColorCount = 0;
	IRTTexture* Depth = nullptr;
	bool bClearDepth = true;
	float ClearDepth = 0.0f; ///< 0 is the far plane of reversed depth
	uint32_t Width = 0, Height = 0;
};

/// One of several copies between two buffers. All members are in bytes.
struct FRTBufferRegion
{
	uint64_t DestOffset = 0, SourceOffset = 0, Size = 0;
};

struct FRTMemoryStats
{
	uint64_t Geometry = 0, Scene = 0, ShaderTable = 0, Texture = 0, Buffer = 0, Scratch = 0; ///< live bytes
	uint64_t Total = 0, Peak = 0;
};

} // namespace Lantern
