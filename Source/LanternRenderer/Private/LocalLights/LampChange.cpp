// Passes that compare the lights and emissive triangles of two frames, and follow those that have changed.
#include "LocalLights/LampChange.h"

#include <cstddef>
#include <utility>

#include "LampChangeTypes.h"
#include "LanternCore/Config/ConsoleVariables.h"
#include "LanternCore/FrameGraph/History.h"
#include "Lights/PixelChannels.h"
#include "LocalLights/Emitters.h"
#include "PassTools.h"
#include "Tiles/MovedCasters.h"

namespace Lantern
{

namespace
{
static_assert(sizeof(FLightData) == LAMP_WORDS * sizeof(uint32_t));

TRTConsoleVariable<bool> CVarRescale("r.RT.Debug.Lights.Rescale", true,
    "Planted fault. If off, the filter is not told by how much lamps have changed, and finds it in the picture or not at all.");

FShaderSource MakeLampListSource() { return MakeComputeSource("LocalLights/ListLamps.comp"); }
FShaderSource MakeEmitterListSource() { return MakeComputeSource("LocalLights/ListEmitters.comp"); }
FShaderSource MakeFollowSource(const FShaderDefines& Defines) { return MakeComputeSource("LocalLights/FollowLamps.comp", Defines); }

/// A table that is compared with that of the last frame.
struct FComparedTable
{
	const char* Pass = nullptr;
	IRTPipeline* Pipeline = nullptr;
	uint64_t Counter = 0;   ///< offset in FLampChanges
	uint32_t WhenFresh = 0; ///< what the counter says where nobody has noted the last frame
	uint32_t Count = 0;     ///< of the table; 0: nothing is compared
	FHistoryBuffer Kept;
};

/// bFirst: nothing was written to the list before.
void AddListPass(FFrameContext& Context, const FComparedTable& Table, FGraphBuffer List, bool bFirst)
{
	const FFrameContext* const Frame = &Context;
	Context.Graph.AddPass(Table.Pass, [&](FPassBuilder& Builder) -> FPassExecute {
		if (Table.Count > 0)
		{
			if (!Table.Kept.bFresh) { Builder.Read(Table.Kept.Buffer, ERTAccess::StorageRead); }
			Builder.Write(Table.Kept.Buffer, ERTAccess::StorageWrite);
			Builder.NeverCull(); // the next frame compares
		}
		if (!bFirst) { Builder.Read(List, ERTAccess::StorageRead); } // the other table keeps its part
		Builder.Write(List, ERTAccess::StorageWrite);
		Builder.AllowAsync();
		return [=](FPassContext& Pass) {
			IRTBuffer* const Counters = Pass.GetBuffer(List);
			// Others reach the list as the pass has declared it, behind this.
			const ERTAccess Declared = bFirst ? ERTAccess::StorageWrite : ERTAccess::StorageRead | ERTAccess::StorageWrite;
			const FRTBarrier Before{Counters, nullptr, Declared, ERTAccess::CopyWrite},
			    After{Counters, nullptr, ERTAccess::CopyWrite, Declared};
			Pass.Commands().Barriers(&Before, 1);
			const bool bFresh = Table.Count > 0 && Table.Kept.bFresh;
			Pass.Commands().FillBuffer(Counters, Table.Counter, sizeof(uint32_t), bFresh ? Table.WhenFresh : 0);
			Pass.Commands().Barriers(&After, 1);
			if (Table.Count == 0) { return; }
			FListChangesConstants C{};
			C.Pass = Frame->Pass;
			C.Kept = GetAddress(Pass, Table.Kept.Buffer);
			C.List = GetAddress(Pass, List);
			C.Count = Table.Count;
			C.bFresh = bFresh ? 1u : 0u;
			DispatchMany(Pass, Table.Pipeline, C, DivideUp(Table.Count, TILE_PIXELS));
		};
	});
}

/// Asks for what the table was in the last frame. It must be asked for in each frame, or else it would be freed. Returns whether the
/// table has to be compared. False as well: an error, which the context has.
bool FindKept(FFrameContext& Context, const char* Name, uint64_t Bytes, bool bChanged, FComparedTable& InOut)
{
	if (Bytes == 0) { return false; }
	if (FRTStatus S = Context.World->History->GetBuffer(Name, {Bytes}, InOut.Kept); !S)
	{
		Context.Fail(S);
		return false;
	}
	return bChanged || InOut.Kept.bFresh;
}

/// Lists what has changed, once for either lobe. Null pipelines: nobody follows those.
FGraphBuffer RequireList(FFrameContext& Context, IRTPipeline* LampList, IRTPipeline* EmitterList)
{
	FLampChangesOfFrame& Changes = Context.World->LampChanges;
	if (std::exchange(Changes.bAsked, true)) { return Changes.List; }
	FMovedCasters& Noted = *Context.MovedCasters;
	const uint32_t Slots = LampList ? Noted.GetLampRoom(Context.Scene.GetLights().GetSlotCount()) : 0;
	const uint32_t Clusters = EmitterList ? Context.Scene.GetFacts().EmissiveClusters : 0;
	const bool bLamps = Slots > 0 && Noted.HaveLampsChanged(Context.Scene, Context.View);
	const bool bEmitters = Clusters > 0 && Noted.HaveEmittersChanged(Context.Scene, Context.View);
	FComparedTable Lamps{"ChangedLamps", LampList, offsetof(FLampChanges, Count), LAMP_CHANGES + 1, 0, {}};
	FComparedTable Emitters{"ChangedEmitters", EmitterList, offsetof(FLampChanges, EmitterCount), 0, 0, {}};
	if (FindKept(Context, "Lamps", Slots * sizeof(FLightData), bLamps, Lamps)) { Lamps.Count = Slots; }
	if (FindKept(Context, "Emitters", Clusters * sizeof(FEmitterCluster), bEmitters, Emitters)) { Emitters.Count = Clusters; }
	if (Lamps.Count == 0 && Emitters.Count == 0) { return {}; }
	const FGraphBuffer List = Context.Graph.CreateBuffer({sizeof(FLampChanges), ERTBufferUsage::CopyDest}, "LampChanges");
	AddListPass(Context, Lamps, List, true);
	AddListPass(Context, Emitters, List, false);
	// A fresh list says that too many lamps have changed: nobody knows what they were.
	if ((bLamps || bEmitters) && Context.PreviousView) { Changes.List = List; }
	return Changes.List;
}

FLobes AddFollowPass(FFrameContext& Context, const FGBuffer& GBuffer, const FQueuedRays& Rays, FGraphBuffer List, IRTPipeline* Pipeline)
{
	const FFrameContext* const Frame = &Context;
	const FGraphTexture Channels = RequirePixelChannels(Context, GBuffer);
	const auto Create = [&](const char* Name) {
		return Context.Graph.CreateTexture({Context.Width, Context.Height, ERTFormat::RGBA16_FLOAT}, Name);
	};
	const FLobes Change{Create("LocalDiffuseChange"), Create("LocalSpecularChange")};
	Context.Graph.AddPass("LocalLightsChange", [&](FPassBuilder& Builder) -> FPassExecute {
		for (const FGraphTexture Texture : {GBuffer.Depth, GBuffer.Normals, GBuffer.BaseColor, GBuffer.Material})
		{
			Builder.Read(Texture, ERTAccess::ShaderRead);
		}
		for (const FGraphTexture Texture : {Channels, GBuffer.BackAlbedo})
		{
			if (Texture.IsValid()) { Builder.Read(Texture, ERTAccess::ShaderRead); }
		}
		for (const FGraphBuffer Buffer : {List, Rays.Guide}) { Builder.Read(Buffer, ERTAccess::ShaderRead); }
		for (const FGraphTexture Texture : {Change.Diffuse, Change.Specular}) { Builder.WriteIfRead(Texture, ERTAccess::StorageWrite); }
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
			C.BackAlbedo = GetSampledIndex(Pass, GBuffer.BackAlbedo);
			C.OutDiffuse = GetStorageIndex(Pass, Change.Diffuse);
			C.OutSpecular = GetStorageIndex(Pass, Change.Specular);
			Dispatch2D(Pass, Pipeline, C, Frame->Width, Frame->Height, TILE_SIZE);
		};
	});
	return Change;
}
} // namespace

void ListLampChangeShaders(bool bLamps, const FSceneFacts& Facts, const FShaderDefines& Defines, std::vector<FShaderSource>& Out)
{
	if (!CVarRescale.GetOnRenderThread()) { return; }
	if (bLamps) { Out.push_back(MakeLampListSource()); }
	if (HasEmitters(Facts)) { Out.push_back(MakeEmitterListSource()); }
	Out.push_back(MakeFollowSource(Defines));
}

FLobes AddLampChange(FFrameContext& Context, const FGBuffer& GBuffer, bool bLamps, const FQueuedRays& Rays, const FShaderDefines& Defines)
{
	if (!Rays.Guide.IsValid() || !CVarRescale.GetOnRenderThread()) { return {}; }
	const bool bEmitters = HasEmitters(Context.Facts);
	IRTPipeline* const Lamps = bLamps ? RequireCompute(Context, MakeLampListSource()) : nullptr;
	IRTPipeline* const Emitters = bEmitters ? RequireCompute(Context, MakeEmitterListSource()) : nullptr;
	IRTPipeline* const Follow = RequireCompute(Context, MakeFollowSource(Defines));
	if (!Follow || (bLamps && !Lamps) || (bEmitters && !Emitters)) { return {}; }
	const FGraphBuffer Changes = RequireList(Context, Lamps, Emitters);
	return Changes.IsValid() ? AddFollowPass(Context, GBuffer, Rays, Changes, Follow) : FLobes{};
}

} // namespace Lantern
