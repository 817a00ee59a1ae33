// Resources, pipelines, geometries, scenes and tables of the mock.
#pragma once

#include "LanternRHICommon/RefCounted.h"
#include "MockState.h"

#include <cstdlib>

namespace Lantern
{

/// Reference counting and the common part for interface I.
template <class I>
class TMockObject : public TRefCounted<I>, public FMockObject
{
public:
	using FMockObject::FMockObject;

private:
	void OnFinalRelease() final
	{
		const std::shared_ptr<FMockState> Keep = State;
		Keep->Retire(this);
	}
};

class FMockBuffer final : public TMockObject<IRTBuffer>
{
public:
	FMockBuffer(std::shared_ptr<FMockState> InState, const FRTBufferDesc& InDesc);
	~FMockBuffer() override;
	/// False if the host has no memory for it.
	bool HasBytes() const { return Bytes != nullptr; }

	const FRTBufferDesc& GetDesc() const override { return Desc; }
	uint64_t GetDeviceAddress() const override { return Address; }
	void* GetMapped() override { return Desc.Memory == ERTMemory::Device ? nullptr : Bytes; }
	uint64_t GetNative(ERTNative Kind) const override { return Kind == ERTNative::Buffer ? Native.Handle : 0; }

	FRTBufferDesc Desc;
	FRTNativeBuffer Native; ///< of an imported one; its bytes are the mock's own all the same
	uint64_t Address = 0;
	uint8_t* Bytes = nullptr;
};

class FMockTexture final : public TMockObject<IRTTexture>
{
public:
	FMockTexture(std::shared_ptr<FMockState> InState, const FRTTextureDesc& InDesc);
	~FMockTexture() override;

	const FRTTextureDesc& GetDesc() const override { return Desc; }
	uint32_t GetSampledIndex() const override { return Sampled; }
	uint32_t GetStorageIndex() const override { return Storage; }
	uint64_t GetNative(ERTNative Kind) const override
	{
		return Kind == ERTNative::Image ? NativeImage : Kind == ERTNative::Device ? State->GetNativeDevice() : 0;
	}
	FRTStatus SetExternalState(const FRTExternalState& From, const FRTExternalState& To) override;

	uint32_t GetWidth(uint32_t Mip) const { return Desc.Width >> Mip ? Desc.Width >> Mip : 1; }
	uint32_t GetHeight(uint32_t Mip) const { return Desc.Height >> Mip ? Desc.Height >> Mip : 1; }
	/// Allocates at first use, since most textures of a test are never touched. Call it only while executing.
	std::vector<uint8_t>& GetTexels(uint32_t Mip, uint32_t Layer);
	void Clear(const float Value[4]);
	void GenerateMips();

	static uint64_t GetSizeBytes(const FRTTextureDesc& Desc);

	FRTTextureDesc Desc;
	uint32_t Sampled = ~0u, Storage = ~0u;
	uint64_t NativeImage = 0;

private:
	std::vector<std::vector<uint8_t>> Texels;
};

class FMockSampler final : public TMockObject<IRTSampler>
{
public:
	using TMockObject::TMockObject;
	~FMockSampler() override;
	uint32_t GetIndex() const override { return Index; }

	uint32_t Index = 0;
};

/// Shader names of a group, for ResolveHit.
struct FMockGroup
{
	ERTGroupKind Kind = ERTGroupKind::General;
	std::string General, ClosestHit, AnyHit, Intersection;
	ERTShaderStage GeneralStage = ERTShaderStage::RayGen;
};
/// Groups of a pipeline. They outlive it if records on the device still point at them.
using FMockGroups = std::shared_ptr<const std::vector<FMockGroup>>;

enum class EMockPipeline : uint8_t
{
	Compute,
	Raster,
	RayTracing
};

class FMockPipeline final : public TMockObject<IRTPipeline>
{
public:
	using TMockObject::TMockObject;
	~FMockPipeline() override;
	uint32_t GetGroupCount() const override { return Groups ? static_cast<uint32_t>(Groups->size()) : 0; }
	uint64_t GetNative(ERTNative) const override { return 0; }

	EMockPipeline Kind = EMockPipeline::Compute;
	uint64_t Id = 0;    ///< in the handles of its groups
	FMockGroups Groups; ///< its own first, then those of each library
	/// Handles of its groups as a device gives them out, ShaderGroupHandleSize bytes each.
	std::vector<uint8_t> Handles;
	bool bLibrary = false;
	std::array<uint32_t, 3> Interface = {}; ///< recursion, payload and attribute bytes: a link's must be its libraries'
};

class FMockGeometry final : public TMockObject<IRTGeometry>
{
public:
	FMockGeometry(std::shared_ptr<FMockState> InState, const FRTGeometryDesc& Desc);
	~FMockGeometry() override;
	uint64_t GetDeviceAddress() const override { return Address; }
	FRTBuildSizes GetBuildSizes() const override { return Sizes; }
	uint32_t GetSectionCount() const override { return SectionCount; }
	uint64_t GetNative(ERTNative) const override { return 0; }

	static uint64_t CountPrimitives(const FRTGeometrySection* Sections, uint32_t Count);
	static FRTBuildSizes ComputeSizes(const FRTGeometryDesc& Desc);
	/// Returns what a query says: 60 % of the whole, about what drivers reach.
	uint64_t GetCompactedSize() const { return CompactedBytes ? CompactedBytes : AlignUp(Sizes.StructureBytes * 6 / 10, 128); }

	uint64_t Address = 0;
	uint32_t SectionCount = 0;
	bool bAllowUpdate = false, bAllowCompaction = false;
	uint64_t CompactedBytes = 0; ///< if > 0, made for a compacted copy
	FRTBuildSizes Sizes;
	FRTMockGeometry Built; ///< guarded by FMockState::Mutex
};

class FMockScene final : public TMockObject<IRTScene>
{
public:
	using TMockObject::TMockObject;
	~FMockScene() override;
	uint32_t GetIndex() const override { return Index; }
	uint32_t GetMaxInstances() const override { return MaxInstances; }
	FRTBuildSizes GetBuildSizes() const override { return Sizes; }
	uint64_t GetNative(ERTNative) const override { return 0; }

	uint32_t Index = 0;
	uint32_t MaxInstances = 0;
	FRTBuildSizes Sizes;
	void Build(const uint8_t* Source, uint32_t Count);

	// State of the last executed build; guarded by FMockState::Mutex.
	std::vector<FRTInstance> Instances;
	std::vector<uint8_t> bBuilt; ///< for each instance, whether its geometry had been built by then
};

class FMockQueryPool final : public TMockObject<IRTQueryPool>
{
public:
	using TMockObject::TMockObject;
	uint32_t GetCount() const override { return static_cast<uint32_t>(Values.size()); }
	ERTQuery GetKind() const override { return Kind; }
	bool GetResults(uint32_t First, uint32_t Count, uint64_t* OutValues) override;

	ERTQuery Kind = ERTQuery::Timestamp;
	std::vector<uint64_t> Values; ///< 0 if not written; guarded by FMockState::Mutex
};

} // namespace Lantern
