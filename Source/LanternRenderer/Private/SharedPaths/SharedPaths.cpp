// The pass of shared paths behind the rays.
#include "SharedPaths/SharedPaths.h"

#include "LobePixels.h"
#include "RadianceCells/RadianceCells.h"
#include "SharedPathTypes.h"
#include "TileTypes.h"

namespace Lantern
{

namespace
{
TRTConsoleVariable<float> CVarNear("r.RT.GI.Reuse.Near", 16.0f,
    "With r.RT.GI.Reuse, paths that meet something within so many pixels' widths light no pixels but the nearest. Others may not see it.",
    {0, 1024});

TRTConsoleVariable<bool> CVarReuseCosine("r.RT.Debug.GI.ReuseCosine", true,
    "Planted fault. If off, paths light each pixel around as they light the one that has drawn them, whatever its normal.");

FShaderSource MakeResolveSource(EPixelRate Rate, bool bSecondLobe, bool bBothSides)
{
	FShaderDefines Defines;
	AddBackPixelsDefine(bBothSides, Defines);
	AddRateDefine(Rate, Defines);
	if (bSecondLobe) { Defines.emplace_back("SECOND_LOBE", "1"); }
	if (AreReservoirsWanted()) { Defines.emplace_back(PathReservoirsDefine, "1"); }
	if (!CVarReuseCosine.GetOnRenderThread()) { Defines.emplace_back("NO_REUSE_COSINE", "1"); }
	return MakeComputeSource("SharedPaths/Resolve.comp", std::move(Defines));
}
} // namespace

void AddSharedPathShaders(
    const FSceneFacts& Facts, EPixelRate Rate, bool bSecondLobe, FShaderDefines& InOutDefines, std::vector<FShaderSource>& OutCompute)
{
	InOutDefines.emplace_back(SharedPathsDefine, "1");
	if (AreReservoirsWanted()) { AddPathReservoirDefines(InOutDefines); }
	OutCompute.push_back(MakeResolveSource(Rate, bSecondLobe, Facts.bBackPixels));
}

FSharedPaths MakeSharedPaths(FFrameContext& Context, EPixelRate Rate, bool bSecondLobe, bool bBothSides, uint32_t Width, uint32_t Height)
{
	FSharedPaths Shared;
	Shared.Resolve = RequireCompute(Context, MakeResolveSource(Rate, bSecondLobe, bBothSides));
	if (AreReservoirsWanted())
	{
		Shared.Reservoirs = MakePathReservoirs(Context, Width, Height);
		if (!Shared.Reservoirs.IsValid()) { return {}; }
	}
	if (Shared.Resolve) { Shared.Fresh = Context.Graph.CreateBuffer({uint64_t(Width) * Height * sizeof(FSharedPath)}, "SharedPaths"); }
	return Shared;
}

float GetNearPixels(const FFrameContext& Context)
{
	const float Near = CVarNear.GetOnRenderThread();
	return Context.bHalf ? 0.5f * Near : Near;
}

FGraphBuffer AddPathResolve(
    FFrameContext& Context, const FGBuffer& GBuffer, const FSharedPaths& Shared, FGraphTexture Output, FGraphTexture Second)
{
	const FFrameContext* const Frame = &Context;
	const FGraphTexture Toon = Context.Toon.Pixels;
	const FRadianceCells* const Cells = Context.World->RadianceCells.get();
	FGraphBuffer Changes;
	if (Cells && Cells->Grid.Moment > 0.0f)
	{
		const uint64_t Tiles = uint64_t(DivideUp(Context.Width, TILE_SIZE)) * DivideUp(Context.Height, TILE_SIZE);
		Changes = Context.Graph.CreateBuffer({Tiles * sizeof(FPathChange)}, "PathChanges");
	}
	Context.Graph.AddPass("PathResolve", [&](FPassBuilder& Builder) -> FPassExecute {
		DeclareLobePixels(Builder, GBuffer, {Output, Second});
		Builder.Read(Shared.Fresh, ERTAccess::ShaderRead);
		if (Changes.IsValid()) { Builder.Write(Changes, ERTAccess::StorageWrite); }
		if (Toon.IsValid()) { Builder.Read(Toon, ERTAccess::ShaderRead); }
		Context.Tokens.LeaveAlone(Builder);
		Builder.AllowAsync();
		return [=](FPassContext& Pass) {
			FSharedPathConstants C{};
			C.Pass = Frame->Pass;
			C.Shared = GetAddress(Pass, Shared.Fresh);
			C.Changes = Changes.IsValid() ? GetAddress(Pass, Changes) : 0;
			C.ToonPixels = GetSampledIndex(Pass, Toon);
			C.BackAlbedo = GetSampledIndex(Pass, GBuffer.BackAlbedo);
			SetLobePixels(Pass, GBuffer, {Output, Second}, C);
			Dispatch2D(Pass, Shared.Resolve, C, Frame->Width, Frame->Height, TILE_SIZE);
		};
	});
	return Changes;
}

} // namespace Lantern
