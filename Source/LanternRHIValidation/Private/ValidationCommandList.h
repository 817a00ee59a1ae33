// The wrapper around a command list. It checks each call against what the list knows, and keeps the steps that only the
// submission can judge.
#pragma once

#include "ValidationObjects.h"
#include "ValidationTracker.h"

namespace Lantern
{

class FValidatedCommandList final : public TValidated<IRTCommandList>
{
public:
	FValidatedCommandList(std::shared_ptr<FValidationState> InState, TRTRef<IRTCommandList> InInner, const char* Name, bool bInImported,
	    ERTQueue InQueue = ERTQueue::Graphics);

	FRTStatus Begin() override;
	FRTStatus End() override;
	FRTStatus GetStatus() const override { return Inner->GetStatus(); }
	void Barriers(const FRTBarrier* Items, uint32_t Count) override;
	void CopyBuffer(IRTBuffer* Dest, uint64_t DestOffset, IRTBuffer* Source, uint64_t SourceOffset, uint64_t Size) override;
	void CopyBufferRegions(IRTBuffer* Dest, IRTBuffer* Source, const FRTBufferRegion* Regions, uint32_t Count) override;
	void CopyBufferToTexture(IRTTexture* Dest, uint32_t Mip, uint32_t Layer, IRTBuffer* Source, uint64_t SourceOffset) override;
	void CopyTextureToBuffer(IRTBuffer* Dest, uint64_t DestOffset, IRTTexture* Source, uint32_t Mip, uint32_t Layer) override;
	void FillBuffer(IRTBuffer* Dest, uint64_t Offset, uint64_t Size, uint32_t Value) override;
	void ClearTexture(IRTTexture* Dest, const float Value[4]) override;
	void GenerateMips(IRTTexture* Texture) override;
	void SetPipeline(IRTPipeline* Pipeline) override;
	void PushConstants(const void* Data, uint32_t Size) override;
	void Dispatch(uint32_t GroupsX, uint32_t GroupsY, uint32_t GroupsZ) override;
	void DispatchIndirect(IRTBuffer* Arguments, uint64_t Offset) override;
	void TraceRaysIndirect(IRTShaderTable* Table, uint32_t RayGen, IRTBuffer* Arguments, uint64_t Offset) override;
	void TraceRays(IRTShaderTable* Table, uint32_t RayGen, uint32_t Width, uint32_t Height, uint32_t Depth) override;
	void UpdateShaderTable(IRTShaderTable* Table) override;
	void BeginRasterPass(const FRTRasterPassDesc& Desc) override;
	void EndRasterPass() override;
	void SetIndexBuffer(IRTBuffer* Buffer, uint64_t Offset, ERTIndexType Type) override;
	void Draw(uint32_t VertexCount, uint32_t InstanceCount) override;
	void DrawIndexed(uint32_t IndexCount, uint32_t InstanceCount, uint32_t FirstIndex, int32_t VertexOffset) override;
	void BuildGeometries(const FRTGeometryBuild* Builds, uint32_t Count) override;
	void WriteCompactedSize(IRTQueryPool* Queries, uint32_t Index, IRTGeometry* Geometry) override;
	void CompactGeometry(IRTGeometry* Dest, IRTGeometry* Source) override;
	void BuildScene(IRTScene* Scene, IRTBuffer* Instances, uint64_t InstanceOffset, uint32_t Count, IRTBuffer* Scratch,
	    uint64_t ScratchOffset) override;
	void KeepAlive(IRTRefCounted* Object) override;
	void WriteTimestamp(IRTQueryPool* Pool, uint32_t Index) override;
	void ResetQueries(IRTQueryPool* Pool, uint32_t First, uint32_t Count) override;
	void BeginMarker(const char* Name) override;
	void EndMarker() override;
	uint64_t GetNative(ERTNative Kind) const override { return Inner->GetNative(Kind); }

	// For the device:
	bool IsImported() const { return bImported; }
	ERTQueue GetQueue() const { return Queue; }
	bool IsEnded() const { return Stage == EStage::Ended; }
	bool IsSubmitted() const { return Stage == EStage::Submitted; }
	void Judge(FValidationTracker& Tracker) const;
	void MarkSubmitted(FRTFence InFence);

private:
	enum class EStage : uint8_t
	{
		Idle,
		Recording,
		Ended,
		Submitted
	};
	using EKind = FValidationStep::EKind;

	/// "list 'Name': Call"
	std::string Where(const char* Call) const { return Label + ": " + Call; }
	void Report(const char* Call, const std::string& Message) { State->Report(Where(Call) + ": " + Message); }
	bool CanRecord(const char* Call);
	/// Like CanRecord; reports a raster pass around the call too.
	bool CanRecordOutside(const char* Call);
	bool CanDraw(const char* Call);
	bool HasPipeline(const char* Call, EPipelineKind Kind);
	FValidationStep& AddStep(EKind Kind, const char* Call);
	void AddUse(const char* Call, const std::shared_ptr<FResourceTrack>& Resource, ERTAccess Access);
	FValidatedBuffer* RequireBuffer(const char* Call, const char* Argument, IRTBuffer* Buffer, ERTBufferUsage Usage);
	FValidatedTexture* RequireTexture(const char* Call, const char* Argument, IRTTexture* Texture, ERTTextureUsage Usage);
	bool CheckRange(const char* Call, const FValidatedBuffer& Buffer, uint64_t Offset, uint64_t Size);
	void CopyRegions(const char* Call, IRTBuffer* Dest, IRTBuffer* Source, const FRTBufferRegion* Regions, uint32_t Count);
	bool CheckTextureCopy(
	    const char* Call, const FValidatedTexture& Texture, uint32_t Mip, uint32_t Layer, const FValidatedBuffer& Buffer, uint64_t Offset);
	bool CheckBarrier(const FRTBarrier& Item, FRTBarrier& OutInner);
	FValidatedTexture* CheckTarget(IRTTexture* Texture, const FRTRasterPassDesc& Desc, bool bDepth);

	bool CheckBuild(const FRTGeometryBuild& Build, FRTGeometryBuild& OutInner, std::vector<FRTGeometrySection>& OutSections);
	bool CheckSection(const FValidatedGeometry& Geometry, uint32_t Index, const FRTGeometrySection& Section, FRTGeometrySection& OutInner);
	bool CheckTriangles(const std::string& Which, const FRTGeometrySection& Section, FRTGeometrySection& OutInner);
	bool CheckScratch(const char* Call, const std::string& Which, IRTBuffer* Scratch, uint64_t Offset, uint64_t Bytes);
	bool CheckInstances(FValidatedScene& Scene, IRTBuffer* Instances, uint64_t Offset, uint32_t Count);
	/// Refuses instances that are wrong already while the list is recorded: the driver must not see them.
	bool CheckAddresses(const FValidatedScene& Scene, FValidatedBuffer& Buffer, uint64_t Offset, uint32_t Count);
	bool CheckCompaction(const FValidatedGeometry& Dest, const FValidatedGeometry& Source);
	/// Returns the buffer of an indirect command's arguments. Null: it is wrong, and has been reported.
	FValidatedBuffer* RequireArguments(const char* Call, IRTBuffer* Arguments, uint64_t Offset);
	bool CheckTrace(FValidatedShaderTable& Table, uint32_t RayGen, uint32_t Width, uint32_t Height, uint32_t Depth);

	struct FScratchRange
	{
		const FResourceTrack* Buffer;
		uint64_t Begin, End;
	};

	EStage Stage = EStage::Idle;
	const bool bImported;
	const ERTQueue Queue;
	FRTFence Fence = 0;
	std::vector<FValidationStep> Steps;
	std::vector<FGeometryHold> KeptGeometries;
	std::vector<FScratchRange> ScratchRanges; ///< written since the last barrier on builds
	bool bUnflushedGeometry = false;          ///< a geometry was built or copied, with no barrier since
	bool bUnflushedBuild = false;             ///< a geometry was built, with no barrier since
	bool bUnflushedScene = false;
	bool bInPass = false;
	std::vector<ERTFormat> PassColors;
	ERTFormat PassDepth = ERTFormat::Unknown;
	TRTRef<FValidatedPipeline> Pipeline;
	uint64_t IndexBytes = 0; ///< behind the offset at which the index buffer was set
	uint32_t IndexSize = 0;  ///< 0 if no index buffer is set
	uint32_t Markers = 0;
};

} // namespace Lantern
