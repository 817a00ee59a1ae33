// Resources, pipelines, geometries, scenes and tables of the mock.
#pragma once

#include "MockState.h"

#include <atomic>
#include <cstdlib>

namespace Lantern
{

/// Reference counting and the common part for interface I.
template <class I>
class TMockObject : public I, public FMockObject
{
public:
	using FMockObject::FMockObject;
	uint32_t AddRef() override { return ++References; }
	uint32_t Release() override
	{
		const uint32_t Left = --References;
		if (Left == 0)
		{
			const std::shared_ptr<FMockState> Keep = State;
			Keep->Retire(this);
		}
		return Left;
	}

private:
	std::atomic<uint32_t> References = 1;
};

class FMockBuffer final : public TMockObject<IRTBuffer>
{
public:
	FMockBuffer(std::shared_ptr<FMockState> InState, const FRTBufferDesc& InDesc);
	~FMockBuffer() override;
	/// False: the host has no memory for it.
	bool HasBytes() const { return Bytes != nullptr; }

	const FRTBufferDesc& GetDesc() const override { return Desc; }
	uint64_t GetDeviceAddress() const override { return Address; }
	void* GetMapped() override { return Desc.Memory == ERTMemory::Device ? nullptr : Bytes; }
	uint64_t GetNative(ERTNative) const override { return 0; }

	FRTBufferDesc Desc;
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
	uint64_t GetNative(ERTNative Kind) const override { return Kind == ERTNative::Image ? NativeImage : 0; }

	uint32_t GetWidth(uint32_t Mip) const { return Desc.Width >> Mip ? Desc.Width >> Mip : 1; }
	uint32_t GetHeight(uint32_t Mip) const { return Desc.Height >> Mip ? Desc.Height >> Mip : 1; }
	/// Allocated at first use: most textures of a test are never touched. Only while executing.
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
};

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
	uint32_t GetGroupCount() const override { return static_cast<uint32_t>(Groups.size()); }
	uint64_t GetNative(ERTNative) const override { return 0; }

	EMockPipeline Kind = EMockPipeline::Compute;
	uint64_t Id = 0; ///< in the handles of its groups
	std::vector<FMockGroup> Groups;
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
	static FRTBuildSizes ComputeSizes(uint64_t Primitives, bool bAllowUpdate);

	uint64_t Address = 0;
	uint32_t SectionCount = 0;
	bool bAllowUpdate = false;
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
	std::vector<std::pair<FRTInstance, bool>> Instances; ///< and whether built then; guarded by FMockState::Mutex
};

class FMockQueryPool final : public TMockObject<IRTQueryPool>
{
public:
	using TMockObject::TMockObject;
	uint32_t GetCount() const override { return static_cast<uint32_t>(Values.size()); }
	ERTQuery GetKind() const override { return Kind; }
	bool GetResults(uint32_t First, uint32_t Count, uint64_t* OutValues) override;

	ERTQuery Kind = ERTQuery::Timestamp;
	std::vector<uint64_t> Values; ///< 0: not written; guarded by FMockState::Mutex
};

inline constexpr uint32_t RecordKinds = 4;

/// Layout and contents of a shader binding table. A handle holds a magic number, its pipeline's id and the group.
class FMockShaderTable final : public TMockObject<IRTShaderTable>
{
public:
	FMockShaderTable(std::shared_ptr<FMockState> InState, const FRTShaderTableDesc& InDesc);

	const FRTShaderTableDesc& GetDesc() const override { return Desc; }
	void SetRecord(ERTRecordKind Kind, uint32_t Index, uint32_t Group, const void* Data, uint32_t DataBytes) override;
	void SetHitRecords(uint32_t First, uint32_t Count, const uint32_t* Groups, const void* Data) override;
	void SetGroups(ERTRecordKind Kind, uint32_t First, uint32_t Count, const uint32_t* Groups) override;
	void SetPipeline(IRTPipeline* InPipeline) override;
	FRTStatus Reserve(const uint32_t Counts[4]) override;
	FRTStatus Stage() override { return FRTStatus::Success(); }
	void Invalidate() override { Dirty.assign(1, {0, Size}); }
	uint64_t GetRecordStride(ERTRecordKind Kind) const override { return Strides[static_cast<uint32_t>(Kind)]; }
	uint64_t GetSizeBytes() const override { return Size; }
	uint64_t GetUpdatedBytes() const override { return UpdatedBytes; }

	struct FUpdate
	{
		uint64_t Offset = 0;
		std::vector<uint8_t> Bytes;
	};
	/// What changed since the last call, as of now: what a copy recorded now carries.
	std::vector<FUpdate> TakeUpdates();
	void Apply(const std::vector<FUpdate>& Updates);
	FRTMockRecord Resolve(ERTRecordKind Kind, uint32_t Index) const;
	uint32_t GetCount(ERTRecordKind Kind) const;
	bool IsUpdated() const;

	FRTShaderTableDesc Desc;
	TRTRef<FMockPipeline> Pipeline;

private:
	mutable std::mutex TableMutex;
	std::array<uint64_t, RecordKinds> Strides = {};
	std::array<uint64_t, RecordKinds> Starts = {};
	uint64_t Size = 0;
	std::vector<uint8_t> Host, Device;
	std::vector<std::pair<uint64_t, uint64_t>> Dirty; ///< offset, size; unsorted
	bool bUpdated = false;
	uint64_t UpdatedBytes = 0;
	void Layout();
};

} // namespace Lantern
