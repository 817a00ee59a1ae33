#include <algorithm>

#include "GBufferTypes.h"
#include "PassTools.h"
#include "Skinning/RefitQuality.h"

namespace Lantern
{

namespace
{
constexpr uint32_t MaxGroups = 65535; // in one dimension, on any device

void Dispatch(IRTCommandList& List, uint32_t Groups) { List.Dispatch(std::min(Groups, MaxGroups), DivideUp(Groups, MaxGroups), 1); }

void RecordRefitQuality(IRTCommandList& List, IRTPipeline* Pipeline, const FRefitQuality::FWork& Work)
{
	List.SetPipeline(Pipeline);
	for (const FRefitQualityConstants& C : Work.Dispatches)
	{
		List.PushConstants(&C, sizeof(C));
		Dispatch(List, FRefitQuality::CountGroups(C.TriangleCount));
	}
	const FRTBarrier Back{Work.Results.Get(), nullptr, ERTAccess::StorageWrite, ERTAccess::HostRead};
	List.Barriers(&Back, 1);
}
} // namespace

FRTStatus AddSkinningPass(FFrameContext& Context, FFrameUploads& Uploads, const std::vector<FSkinningInputs>& Items)
{
	if (Items.empty()) { return FRTStatus::Success(); }
	IRTPipeline* const Pipeline = RequireCompute(Context, "Skinning/Skin.comp");
	if (!Pipeline) { return *Context.Status; }
	FRefitQuality::FWork Quality = Context.Owner->GetRefitQuality().Prepare(Context.Scene.GetGeometries(), Items);
	IRTPipeline* const Measure = Quality.Dispatches.empty() ? nullptr : RequireCompute(Context, "Skinning/RefitQuality.comp");
	if (!Quality.Dispatches.empty() && !Measure) { return *Context.Status; }
	std::vector<FSkinConstants> Dispatches;
	// The buffers are the objects' own, unknown to the graph: last frame's readers, then this frame's. Named one by one,
	// since a barrier of memory as such would move what others hold in the same state.
	std::vector<FRTBarrier> Before, After;
	for (const FSkinningInputs& Item : Items)
	{
		const FRTGeometryInfo& Info = Item.Geometry->GetInfo();
		FUploadSlice Joints;
		if (FRTStatus S = Uploads.Push(Item.Joints.data(), Item.Joints.size() * sizeof(glm::mat4), Joints); !S) { return S; }
		FSkinConstants C{};
		C.SourcePositions = Item.SourcePositions;
		C.SourceAttributes = Item.SourceAttributes;
		C.Weights = Item.Weights;
		C.Joints = Joints.Address;
		C.Positions = Info.Positions->GetDeviceAddress() + Info.PositionsOffset;
		C.Attributes = Info.Attributes->GetDeviceAddress() + Info.AttributesOffset;
		C.VertexCount = Info.VertexCount;
		Dispatches.push_back(C);
		for (IRTBuffer* const Buffer : {Info.Positions.Get(), Info.Attributes.Get()})
		{
			Before.push_back({Buffer, nullptr, UploadedAccess, ERTAccess::StorageWrite});
			After.push_back({Buffer, nullptr, ERTAccess::StorageWrite, UploadedAccess});
		}
	}
	Context.Graph.AddPass("Skinning", [&](FPassBuilder& Builder) -> FPassExecute {
		Builder.NeverCull();
		return [=, Dispatches = std::move(Dispatches), Before = std::move(Before), After = std::move(After)](FPassContext& Pass) {
			Pass.Commands().Barriers(Before.data(), static_cast<uint32_t>(Before.size()));
			Pass.Commands().SetPipeline(Pipeline);
			for (const FSkinConstants& C : Dispatches)
			{
				Pass.Commands().PushConstants(&C, sizeof(C));
				Dispatch(Pass.Commands(), DivideUp(C.VertexCount, SKIN_GROUP_SIZE));
			}
			Pass.Commands().Barriers(After.data(), static_cast<uint32_t>(After.size()));
			if (Measure) { RecordRefitQuality(Pass.Commands(), Measure, Quality); }
		};
	});
	return FRTStatus::Success();
}

} // namespace Lantern
