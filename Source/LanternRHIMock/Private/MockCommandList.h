// Command lists of the mock: calls for inspection, and closures that run when the submission does.
#pragma once

#include "MockObjects.h"

#include <functional>

namespace Lantern
{

class FMockCommandList final : public TMockObject<IRTCommandList>
{
public:
	FMockCommandList(std::shared_ptr<FMockState> InState, const char* InName, uint64_t InNative, ERTQueue InQueue = ERTQueue::Graphics);

	FRTStatus Begin() override;
	FRTStatus End() override;
	FRTStatus GetStatus() const override { return Failed; }
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
	void SetIndexBuffer(IRTBuffer* Buffer, uint64_t Offset, ERTIndexType IndexType) override;
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
	uint64_t GetNative(ERTNative Kind) const override
	{
		return Kind == ERTNative::CommandBuffer ? Native : Kind == ERTNative::Device ? State->GetNativeDevice() : 0;
	}

	/// Runs what was recorded and lets go of it. Under FMockState::ExecuteMutex.
	void Execute();
	bool IsEnded() const { return Stage == EStage::Ended; }
	bool IsImported() const { return Native != 0; }
	ERTQueue GetQueue() const { return Queue; }
	void MarkSubmitted() { Stage = EStage::Submitted; }
	uint64_t GetRecording() const { return Recording; }

private:
	enum class EStage : uint8_t
	{
		Idle,
		Recording,
		Ended,
		Submitted
	};

	void Log(ERTMockCall Kind, const std::string& Object, const FRTMockNumbers& Numbers = {}, bool bWithPush = false);
	void CountBytes(uint64_t FRTMockTraffic::*Of, uint64_t Bytes);
	void Keep(IRTRefCounted* Object);
	void Then(std::function<void()> Work) { Commands.push_back(std::move(Work)); }
	const std::string& GetPipelineName() const;
	void BuildGeometry(const FRTGeometryBuild& Build);
	void CheckTrace(IRTShaderTable* Table, uint32_t RayGen);

	std::vector<std::function<void()>> Commands;
	std::vector<TRTRef<IRTRefCounted>> Kept;
	std::vector<uint8_t> Push;
	FMockPipeline* Pipeline = nullptr;
	uint64_t Native = 0;
	ERTQueue Queue = ERTQueue::Graphics;
	uint64_t Recording = 0; ///< see FRTMockCall::Recording
	FRTStatus Failed;       ///< what End returns
	EStage Stage = EStage::Idle;
	bool bInPass = false;
};

} // namespace Lantern
