// The wrappers around single objects. Most only forward; shader tables check their records.
#pragma once

#include "LanternRHICommon/RefCounted.h"
#include "ValidationState.h"

#include <atomic>

namespace Lantern
{

class FValidated
{
public:
	FValidated(std::shared_ptr<FValidationState> InState, std::string InLabel) : State(std::move(InState)), Label(std::move(InLabel)) {}
	virtual ~FValidated() = default;
	FValidated(const FValidated&) = delete;
	FValidated& operator=(const FValidated&) = delete;
	virtual IRTRefCounted* GetInner() const = 0;

	std::shared_ptr<FValidationState> State;
	const std::string Label; ///< "buffer 'Name'"
};

template <class I>
class TValidated : public TRefCounted<I>, public FValidated
{
public:
	TValidated(std::shared_ptr<FValidationState> InState, std::string InLabel, TRTRef<I> InInner)
	    : FValidated(std::move(InState), std::move(InLabel)),
	      Inner(std::move(InInner))
	{
		State->Add(this, this);
	}
	IRTRefCounted* GetInner() const override { return Inner.Get(); }

	TRTRef<I> Inner;

private:
	void OnFinalRelease() final
	{
		State->Remove(this);
		delete this;
	}
};

class FValidatedBuffer final : public TValidated<IRTBuffer>
{
public:
	FValidatedBuffer(std::shared_ptr<FValidationState> InState, TRTRef<IRTBuffer> InInner);
	const FRTBufferDesc& GetDesc() const override { return Inner->GetDesc(); }
	uint64_t GetDeviceAddress() const override { return Inner->GetDeviceAddress(); }
	void* GetMapped() override { return Inner->GetMapped(); }
	uint64_t GetNative(ERTNative Kind) const override { return Inner->GetNative(Kind); }
	bool Has(ERTBufferUsage Usage) const { return HasAny(GetDesc().Usage, Usage); }

	std::shared_ptr<FResourceTrack> Track;
};

class FValidatedTexture final : public TValidated<IRTTexture>
{
public:
	FValidatedTexture(std::shared_ptr<FValidationState> InState, TRTRef<IRTTexture> InInner, bool bImported);
	const FRTTextureDesc& GetDesc() const override { return Inner->GetDesc(); }
	uint32_t GetSampledIndex() const override { return Inner->GetSampledIndex(); }
	uint32_t GetStorageIndex() const override { return Inner->GetStorageIndex(); }
	uint64_t GetNative(ERTNative Kind) const override { return Inner->GetNative(Kind); }
	FRTStatus SetExternalState(const FRTExternalState& From, const FRTExternalState& To) override
	{
		return Inner->SetExternalState(From, To);
	}
	bool Has(ERTTextureUsage Usage) const { return HasAny(GetDesc().Usage, Usage); }

	std::shared_ptr<FResourceTrack> Track;
};

class FValidatedSampler final : public TValidated<IRTSampler>
{
public:
	using TValidated::TValidated;
	uint32_t GetIndex() const override { return Inner->GetIndex(); }
};

enum class EPipelineKind : uint8_t
{
	Compute,
	Raster,
	RayTracing
};

struct FValidatedGroup
{
	ERTGroupKind Kind = ERTGroupKind::General;
	ERTShaderStage GeneralStage = ERTShaderStage::RayGen;
	friend bool operator==(const FValidatedGroup&, const FValidatedGroup&) = default;
};

class FValidatedPipeline final : public TValidated<IRTPipeline>
{
public:
	using TValidated::TValidated;
	uint32_t GetGroupCount() const override { return Inner->GetGroupCount(); }
	uint64_t GetNative(ERTNative Kind) const override { return Inner->GetNative(Kind); }

	EPipelineKind PipelineKind = EPipelineKind::Compute;
	bool bLibrary = false;
	uint32_t MaxRecursion = 0, MaxPayloadBytes = 0, MaxAttributeBytes = 0;
	std::vector<FValidatedGroup> Groups;
	std::vector<ERTFormat> ColorFormats;
	ERTFormat DepthFormat = ERTFormat::Unknown;
};

class FValidatedGeometry final : public TValidated<IRTGeometry>
{
public:
	FValidatedGeometry(std::shared_ptr<FValidationState> InState, TRTRef<IRTGeometry> InInner, const FRTGeometryDesc& Desc);
	~FValidatedGeometry() override;
	uint64_t GetDeviceAddress() const override { return Inner->GetDeviceAddress(); }
	FRTBuildSizes GetBuildSizes() const override { return Inner->GetBuildSizes(); }
	uint32_t GetSectionCount() const override { return Inner->GetSectionCount(); }
	uint64_t GetNative(ERTNative Kind) const override { return Inner->GetNative(Kind); }

	std::shared_ptr<FGeometryTrack> Track;
};

class FValidatedScene final : public TValidated<IRTScene>
{
public:
	FValidatedScene(std::shared_ptr<FValidationState> InState, TRTRef<IRTScene> InInner, const char* Name);
	uint32_t GetIndex() const override { return Inner->GetIndex(); }
	uint32_t GetMaxInstances() const override { return Inner->GetMaxInstances(); }
	FRTBuildSizes GetBuildSizes() const override { return Inner->GetBuildSizes(); }
	uint64_t GetNative(ERTNative Kind) const override { return Inner->GetNative(Kind); }

	std::shared_ptr<FSceneTrack> Track;
};

class FValidatedQueryPool final : public TValidated<IRTQueryPool>
{
public:
	FValidatedQueryPool(std::shared_ptr<FValidationState> InState, TRTRef<IRTQueryPool> InInner);
	uint32_t GetCount() const override { return Inner->GetCount(); }
	ERTQuery GetKind() const override { return Inner->GetKind(); }
	bool GetResults(uint32_t First, uint32_t Count, uint64_t* OutValues) override;
	void MarkReset(uint32_t First, uint32_t Count);

	std::shared_ptr<FQueryTrack> Track;
};

class FValidatedShaderTable final : public TValidated<IRTShaderTable>
{
public:
	FValidatedShaderTable(std::shared_ptr<FValidationState> InState, TRTRef<IRTShaderTable> InInner, const FRTShaderTableDesc& InDesc,
	    FValidatedPipeline* InPipeline);
	const FRTShaderTableDesc& GetDesc() const override { return Desc; }
	void SetRecord(ERTRecordKind Kind, uint32_t Index, uint32_t Group, const void* Data, uint32_t DataBytes) override;
	void SetHitRecords(uint32_t First, uint32_t Count, const uint32_t* Groups, const void* Data) override;
	void SetGroups(ERTRecordKind Kind, uint32_t First, uint32_t Count, const uint32_t* Groups) override;
	void SetPipeline(IRTPipeline* InPipeline) override;
	FRTStatus Reserve(const uint32_t Counts[4]) override;
	FRTStatus Stage() override;
	void Invalidate() override;
	uint64_t GetUpdatedBytes() const override { return Inner->GetUpdatedBytes(); }
	uint64_t GetRecordStride(ERTRecordKind Kind) const override { return Inner->GetRecordStride(Kind); }
	uint64_t GetSizeBytes() const override { return Inner->GetSizeBytes(); }

	FRTShaderTableDesc Desc; ///< as Inner's, but with the wrapped pipeline
	TRTRef<FValidatedPipeline> Pipeline;
	std::shared_ptr<FTableTrack> Track;

	/// Reports calls that meet though they exclude each other. bSets: one of the Set… calls, which may meet each other.
	class FUse
	{
	public:
		FUse(FValidatedShaderTable& InTable, const char* Call, bool bSets);
		~FUse() { Table.Users -= Count; }
		FUse(const FUse&) = delete;
		FUse& operator=(const FUse&) = delete;

	private:
		FValidatedShaderTable& Table;
		const uint32_t Count;
	};

private:
	std::string Describe(const char* Call, ERTRecordKind Kind, uint32_t Index) const;
	/// Reports and returns false if the records do not exist, or if a group may not stand behind them.
	bool CheckRecords(const char* Call, ERTRecordKind Kind, uint32_t First, uint32_t Count, const uint32_t* Groups) const;
	void MarkSet(ERTRecordKind Kind, uint32_t First, uint32_t Count);
	void ResizeTracks();

	std::atomic<uint32_t> Users = 0; ///< Set… calls, and 65536 for each call that excludes all others
};

} // namespace Lantern
