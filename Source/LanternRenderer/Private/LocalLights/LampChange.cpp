// Passes that compare the lights of two frames, and follow those that have changed.
#include "LocalLights/LampChange.h"

#include <utility>

#include "LampChangeTypes.h"
#include "LanternCore/Config/ConsoleVariables.h"
#include "LanternCore/FrameGraph/History.h"
#include "Lights/PixelChannels.h"
#include "PassTools.h"
#include "Tiles/MovedCasters.h"

namespace Lantern
{

namespace
{
static_assert(sizeof(FLightData) == LAMP_WORDS * sizeof(uint32_t));

TRTConsoleVariable<bool> CVarRescale("r.RT.Debug.Lights.Rescale", true,
    "Planted fault. If off, the filter is not told by how much lamps have changed, and finds it in the picture or not at all.");

FShaderSource MakeListSource() { return MakeComputeSource("LocalLights/ListLamps.comp"); }
FShaderSource MakeFollowSource(const FShaderDefines& Defines) { return MakeComputeSource("LocalLights/FollowLamps.comp", Defines); }

void AddListPass(FFrameContext& Context, const FHistoryBuffer& Kept, uint32_t Slots, FGraphBuffer List, IRTPipeline* Pipeline)
{
	const FFrameContext* const Frame = &Context;
	Context.Graph.AddPass("ChangedLamps", [&](FPassBuilder& Builder) -> FPassExecute {
		if (!Kept.bFresh) { Builder.Read(Kept.Buffer, ERTAccess::StorageRead); }
		Builder.Write(Kept.Buffer, ERTAccess::StorageWrite);
		Builder.Write(List, ERTAccess::StorageWrite);
		Builder.NeverCull(); // the next frame compares
		Builder.AllowAsync();
		return [=](FPassContext& Pass) {
			IRTBuffer* const Counter = Pass.GetBuffer(List);
			// Others reach the list as the pass has declared it, behind this.
			const FRTBarrier Before{Counter, nullptr, ERTAccess::StorageWrite, ERTAccess::CopyWrite},
			    After{Counter, nullptr, ERTAccess::CopyWrite, ERTAccess::StorageWrite};
			Pass.Commands().Barriers(&Before, 1);
			Pass.Commands().FillBuffer(Counter, 0, sizeof(uint32_t), Kept.bFresh ? LAMP_CHANGES + 1 : 0);
			Pass.Commands().Barriers(&After, 1);
			FListLampsConstants C{};
			C.Pass = Frame->Pass;
			C.Kept = GetAddress(Pass, Kept.Buffer);
			C.List = GetAddress(Pass, List);
			C.Slots = Slots;
			C.bFresh = Kept.bFresh ? 1u : 0u;
			DispatchMany(Pass, Pipeline, C, DivideUp(Slots, TILE_PIXELS));
		};
	});
}

/// Lists the lights that have changed, once for either lobe.
FGraphBuffer RequireList(FFrameContext& Context, IRTPipeline* Pipeline)
{
	FLampChangesOfFrame& Changes = Context.LampChanges;
	if (std::exchange(Changes.bAsked, true)) { return Changes.List; }
	const uint32_t Slots = Context.MovedCasters->GetLampRoom(Context.Scene.GetLights().GetSlotCount());
	// Asked for in each frame, or else it would be freed.
	FHistoryBuffer Kept;
	if (FRTStatus S = Context.History->GetBuffer("Lamps", {uint64_t(Slots) * sizeof(FLightData)}, Kept); !S)
	{
		Context.Fail(S);
		return {};
	}
	const bool bChanged = Context.MovedCasters->HaveLampsChanged(Context.Scene, Context.View.DeltaSeconds);
	if (!bChanged && !Kept.bFresh) { return {}; }
	const FGraphBuffer List = Context.Graph.CreateBuffer({sizeof(FLampChanges), ERTBufferUsage::CopyDest}, "LampChanges");
	AddListPass(Context, Kept, Slots, List, Pipeline);
	// A fresh list says that too many have changed: nobody knows what they were.
	if (bChanged && Context.PreviousView) { Changes.List = List; }
	return Changes.List;
}

FGraphTexture AddFollowPass(
    FFrameContext& Context, const FGBuffer& GBuffer, const FQueuedRays& Rays, FGraphBuffer List, ESignal Lobe, IRTPipeline* Pipeline)
{
	const FFrameContext* const Frame = &Context;
	const std::string Name = std::string(GetSignalInfo(Lobe).Pass) + "Change";
	const FGraphTexture Channels = RequirePixelChannels(Context, GBuffer);
	const FGraphTexture Change = Context.Graph.CreateTexture({Context.Width, Context.Height, ERTFormat::RGBA16_FLOAT}, Name.c_str());
	Context.Graph.AddPass(Name.c_str(), [&](FPassBuilder& Builder) -> FPassExecute {
		for (const FGraphTexture Texture : {GBuffer.Depth, GBuffer.Normals, GBuffer.BaseColor, GBuffer.Material})
		{
			Builder.Read(Texture, ERTAccess::ShaderRead);
		}
		if (Channels.IsValid()) { Builder.Read(Channels, ERTAccess::ShaderRead); }
		for (const FGraphBuffer Buffer : {List, Rays.Guide}) { Builder.Read(Buffer, ERTAccess::ShaderRead); }
		Builder.Write(Change, ERTAccess::StorageWrite);
		Builder.AllowAsync();
		return [=](FPassContext& Pass) {
			FFollowLampsConstants C{};
			C.Pass = Frame->Pass;
			C.List = GetAddress(Pass, List);
			C.Guide = GetAddress(Pass, Rays.Guide) + Rays.GuideOffset;
			C.Depth = GetSampledIndex(Pass, GBuffer.Depth);
			C.Normals = GetSampledIndex(Pass, GBuffer.Normals);
			C.BaseColor = GetSampledIndex(Pass, GBuffer.BaseColor);
			C.Material = GetSampledIndex(Pass, GBuffer.Material);
			C.Channels = GetSampledIndex(Pass, Channels);
			C.Output = GetStorageIndex(Pass, Change);
			C.bSpecular = Lobe == ESignal::LocalSpecular ? 1u : 0u;
			Dispatch2D(Pass, Pipeline, C, Frame->Width, Frame->Height, TILE_SIZE);
		};
	});
	return Change;
}
} // namespace

void ListLampChangeShaders(const FShaderDefines& Defines, std::vector<FShaderSource>& Out)
{
	if (!CVarRescale.GetOnRenderThread()) { return; }
	Out.push_back(MakeListSource());
	Out.push_back(MakeFollowSource(Defines));
}

FGraphTexture AddLampChange(
    FFrameContext& Context, const FGBuffer& GBuffer, const FQueuedRays& Rays, const FShaderDefines& Defines, ESignal Lobe)
{
	if (!Rays.Guide.IsValid() || !CVarRescale.GetOnRenderThread()) { return {}; }
	IRTPipeline* const List = RequireCompute(Context, MakeListSource());
	IRTPipeline* const Follow = RequireCompute(Context, MakeFollowSource(Defines));
	if (!List || !Follow) { return {}; }
	const FGraphBuffer Changes = RequireList(Context, List);
	return Changes.IsValid() ? AddFollowPass(Context, GBuffer, Rays, Changes, Lobe, Follow) : FGraphTexture{};
}

} // namespace Lantern
