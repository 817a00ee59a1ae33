// Linear blend skinning into the geometries' own buffers, and the measure of refit quality behind it.
#include <algorithm>
#include <cassert>

#include "PassTools.h"
#include "Skinning/RefitQuality.h"
#include "SkinningTypes.h"

namespace Lantern
{

namespace
{
constexpr uint32_t MaxGroups = 65535; // in one dimension, on any device

FShaderSource MakeSkinSource() { return MakeComputeSource("Skinning/Skin.comp"); }
FShaderSource MakeRefitQualitySource() { return MakeComputeSource("Skinning/RefitQuality.comp"); }

void Dispatch(IRTCommandList& List, uint32_t Groups, uint32_t Layers = 1)
{
	List.Dispatch(std::min(Groups, MaxGroups), DivideUp(Groups, MaxGroups), Layers);
}

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

/// Items of similar size, for one dispatch.
struct FSkinDispatch
{
	uint32_t First = 0, Count = 0, Groups = 0;
};

bool KeepsPrevious(const FRTGeometryInfo& Info, bool bMotion) { return bMotion && Info.PreviousPositions; }

/// Joints of all items, and the items themselves in the order of their sizes, in memory of the frame.
FRTStatus UploadItems(
    FFrameUploads& Uploads, const std::vector<FSkinningInputs>& Inputs, bool bMotion, std::vector<FSkinItem>& Items, FAddress& OutItems)
{
	uint64_t JointCount = 0;
	for (const FSkinningInputs& Input : Inputs) { JointCount += Input.Joints.size(); }
	FUploadSlice Joints, Slice;
	if (FRTStatus S = Uploads.Allocate(std::max<uint64_t>(1, JointCount) * sizeof(glm::mat4), Joints); !S) { return S; }
	auto* Next = static_cast<glm::mat4*>(Joints.Data);
	for (const FSkinningInputs& Input : Inputs)
	{
		const FRTGeometryInfo& Info = Input.Geometry->GetInfo();
		FSkinItem& Item = Items.emplace_back();
		Item.SourcePositions = Input.SourcePositions;
		Item.SourceAttributes = Input.SourceAttributes;
		Item.Weights = Input.Weights;
		Item.Joints = Joints.Address + static_cast<uint64_t>(Next - static_cast<glm::mat4*>(Joints.Data)) * sizeof(glm::mat4);
		Item.Positions = Info.Positions->GetDeviceAddress() + Info.PositionsOffset;
		Item.Attributes = Info.Attributes->GetDeviceAddress() + Info.AttributesOffset;
		Item.PreviousPositions =
		    KeepsPrevious(Info, bMotion) && Input.Geometry->WasDeformed() ? Info.PreviousPositions->GetDeviceAddress() : 0;
		Item.VertexCount = Info.VertexCount;
		Next = std::copy(Input.Joints.begin(), Input.Joints.end(), Next);
	}
	std::stable_sort(Items.begin(), Items.end(), [](const FSkinItem& A, const FSkinItem& B) { return A.VertexCount < B.VertexCount; });
	const FRTStatus Status = Uploads.Push(Items.data(), Items.size() * sizeof(FSkinItem), Slice);
	OutItems = Slice.Address;
	return Status;
}

/// Items: by size. Within a dispatch none has twice the groups that it needs.
std::vector<FSkinDispatch> MakeDispatches(const std::vector<FSkinItem>& Items)
{
	std::vector<FSkinDispatch> Dispatches;
	uint32_t Least = 0;
	for (uint32_t I = 0; I < Items.size(); ++I)
	{
		const uint32_t Groups = DivideUp(Items[I].VertexCount, SKIN_GROUP_SIZE);
		if (Dispatches.empty() || Groups > 2 * Least || Dispatches.back().Count == MaxGroups)
		{
			Dispatches.push_back({I, 0, 0});
			Least = Groups;
		}
		++Dispatches.back().Count;
		Dispatches.back().Groups = Groups;
	}
	return Dispatches;
}
} // namespace

void ListSkinningShaders(FRTScene& Scene, std::vector<FShaderSource>& Out)
{
	Out.push_back(MakeSkinSource());
	if (Scene.GetGeometries().WantsRefitQuality()) { Out.push_back(MakeRefitQualitySource()); }
}

bool IsSkinningReady(const FFrameContext& Context) { return RequireCompute(Context, MakeSkinSource()) != nullptr; }

FRTStatus AddSkinningPass(FFrameContext& Context, FFrameUploads& Uploads, const std::vector<FSkinningInputs>& Inputs, bool bMotion)
{
	if (Inputs.empty()) { return FRTStatus::Success(); }
	IRTPipeline* const Pipeline = RequireCompute(Context, MakeSkinSource());
	FGeometryStore& Store = Context.Scene.GetGeometries();
	IRTPipeline* const Measure = Store.WantsRefitQuality() ? RequireCompute(Context, MakeRefitQualitySource()) : nullptr;
	if (!*Context.Status) { return *Context.Status; }
	assert(Pipeline && "IsSkinningReady was false");
	FRefitQuality::FWork Quality = Measure ? Context.Owner->GetRefitQuality().Prepare(Store, Inputs) : FRefitQuality::FWork{};
	std::vector<FSkinItem> Items;
	FAddress ItemsAddress = 0;
	if (FRTStatus S = UploadItems(Uploads, Inputs, bMotion, Items, ItemsAddress); !S) { return S; }
	// The buffers are the objects' own, unknown to the graph: last frame's readers, then this frame's. Named one by one,
	// since a barrier of memory as such would move what others hold in the same state.
	std::vector<FRTBarrier> Before, After;
	for (const FSkinningInputs& Input : Inputs)
	{
		const FRTGeometryInfo& Info = Input.Geometry->GetInfo();
		for (IRTBuffer* const Buffer : {Info.Positions.Get(), Info.Attributes.Get()})
		{
			Before.push_back({Buffer, nullptr, UploadedAccess, ERTAccess::StorageWrite});
			After.push_back({Buffer, nullptr, ERTAccess::StorageWrite, UploadedAccess});
		}
		if (!KeepsPrevious(Info, bMotion)) { continue; }
		Before.push_back({Info.PreviousPositions.Get(), nullptr, ERTAccess::ShaderRead, ERTAccess::StorageWrite});
		After.push_back({Info.PreviousPositions.Get(), nullptr, ERTAccess::StorageWrite, ERTAccess::ShaderRead});
	}
	Context.Graph.AddPass("Skinning", [&](FPassBuilder& Builder) -> FPassExecute {
		Builder.NeverCull();
		Builder.RecordOnTask();
		Builder.AllowAsync();
		Context.Tokens.WriteAlone(Builder, Context.Tokens.Vertices);
		return [=, Dispatches = MakeDispatches(Items), Before = std::move(Before), After = std::move(After)](FPassContext& Pass) {
			Pass.Commands().Barriers(Before.data(), static_cast<uint32_t>(Before.size()));
			Pass.Commands().SetPipeline(Pipeline);
			for (const FSkinDispatch& D : Dispatches)
			{
				const FSkinConstants Constants{ItemsAddress + uint64_t(D.First) * sizeof(FSkinItem)};
				Pass.Commands().PushConstants(&Constants, sizeof(Constants));
				Dispatch(Pass.Commands(), D.Groups, D.Count);
			}
			Pass.Commands().Barriers(After.data(), static_cast<uint32_t>(After.size()));
			if (!Quality.Dispatches.empty()) { RecordRefitQuality(Pass.Commands(), Measure, Quality); }
		};
	});
	return FRTStatus::Success();
}

} // namespace Lantern
