// The pass that finds where objects that move and lamps that change have changed the light.
#include "MovedShare/MovedShare.h"

#include "MovedShareTypes.h"
#include "RadianceCells/RadianceCells.h"
#include "RadianceCells/RadianceEvents.h"
#include "TileTypes.h"
#include "Tiles/MovedCasters.h"

namespace Lantern
{

namespace
{
TRTConsoleVariable<bool> CVarShown("r.RT.Debug.MovedShare.Shown", true,
    "Planted fault. If off, mirrors keep the light of what they show when objects move there, until the filter's clamp finds it.");

FShaderSource MakeSource()
{
	FShaderDefines Defines;
	if (!CVarShown.GetOnRenderThread()) { Defines.emplace_back("NO_SHOWN", "1"); }
	return MakeComputeSource("MovedShare/MovedShare.comp", std::move(Defines));
}
} // namespace

void ListMovedShareShaders(std::vector<FShaderSource>& Out)
{
	if (AreIndirectChangesTold()) { Out.push_back(MakeSource()); }
}

FGraphTexture AddMovedShare(FFrameContext& Context, const FGBuffer& GBuffer, ELightFrom From, FGraphTexture Shown, FGraphBuffer Changes)
{
	if (!AreIndirectChangesTold()) { return {}; }
	IRTPipeline* const Pipeline = RequireCompute(Context, MakeSource()); // before it is needed: then it would be too late
	const FMoversOfFrame& Movers = RequireMovers(Context);
	const FRadianceCells* const Cells = Context.World->RadianceCells.get();
	const uint32_t LampCount = Cells ? Cells->Grid.EventCount : 0;
	if (!Pipeline || (Movers.Count == 0 && LampCount == 0 && !Changes.IsValid())) { return {}; }
	FMovedShareConstants C{};
	C.Pass = Context.Pass;
	C.Casters = Movers.Casters;
	C.CasterCount = Movers.Count;
	C.LampCount = LampCount;
	C.Lamps = LampCount > 0 ? Cells->Grid.Events : 0;
	C.Moment = Cells ? Cells->Grid.Moment : 0.0f;
	const char* const Name = From == ELightFrom::Around ? "MovedShare" : "MovedShareOfLobes";
	const FGraphTexture Material = From == ELightFrom::SpecularLobe ? GBuffer.Material : FGraphTexture{};
	const FGraphTexture Share = Context.Graph.CreateTexture({Context.Width, Context.Height, ERTFormat::RG16_FLOAT}, Name);
	Context.Graph.AddPass(Name, [&](FPassBuilder& Builder) -> FPassExecute {
		for (const FGraphTexture Texture : {GBuffer.Depth, GBuffer.Normals, Material, Shown})
		{
			if (Texture.IsValid()) { Builder.Read(Texture, ERTAccess::ShaderRead); }
		}
		if (Changes.IsValid()) { Builder.Read(Changes, ERTAccess::ShaderRead); }
		Builder.Write(Share, ERTAccess::StorageWrite);
		Builder.AllowAsync();
		return [=, Width = Context.Width, Height = Context.Height](FPassContext& Pass) mutable {
			C.Depth = GetSampledIndex(Pass, GBuffer.Depth);
			C.Normals = GetSampledIndex(Pass, GBuffer.Normals);
			C.Material = GetSampledIndex(Pass, Material);
			C.Shown = GetSampledIndex(Pass, Shown);
			C.Changes = Changes.IsValid() ? GetAddress(Pass, Changes) : 0;
			C.Output = GetStorageIndex(Pass, Share);
			Dispatch2D(Pass, Pipeline, C, Width, Height, TILE_SIZE);
		};
	});
	return Share;
}

} // namespace Lantern
