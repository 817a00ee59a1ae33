// The pass that keeps the guide of paths, and what launches need of it.
#include "BruteForce/PathGuide.h"

#include "PassTools.h"
#include "PathGuideTypes.h"
#include "TwoFrames.h"

namespace Lantern
{

namespace
{
FShaderSource MakeUpdateSource(EPixelRate Rate)
{
	FShaderDefines Defines;
	AddRateDefine(Rate, Defines);
	return MakeComputeSource("BruteForce/GuideUpdate.comp", std::move(Defines));
}

uint32_t CountTiles(uint32_t Pixels) { return DivideUp(Pixels, PATH_GUIDE_TILE); }
} // namespace

void AddPathGuideDefines(EPixelRate Rate, FPassRays& InOut)
{
	InOut.Defines.emplace_back(GuidedPathsDefine, "1");
	InOut.Compute.push_back(MakeUpdateSource(Rate));
}

FPathGuide MakePathGuide(FFrameContext& Context, EPixelRate Rate, uint64_t Threads)
{
	FPathGuide Guide;
	Guide.Update = RequireCompute(Context, MakeUpdateSource(Rate));
	if (!Guide.Update) { return {}; }
	const uint64_t Bytes = uint64_t(CountTiles(Context.Width)) * CountTiles(Context.Height) * sizeof(FPathGuideTile);
	FTwoFrames Tiles;
	if (!RequireTwoFrames(Context, "PathGuide", Bytes, Tiles)) { return {}; }
	Guide.Tiles = Tiles.Buffer;
	Guide.Offset = Tiles.Offset;
	Guide.PreviousOffset = Tiles.PreviousOffset;
	Guide.bPrevious = Tiles.bPrevious;
	Guide.Records = Context.Graph.CreateBuffer({Threads * sizeof(uint32_t)}, "PathRecords");
	return Guide;
}

void DeclareGuidedPaths(FPassBuilder& Builder, const FPathGuide& Guide)
{
	if (Guide.bPrevious) { Builder.Read(Guide.Tiles, ERTAccess::ShaderRead); }
	Builder.Write(Guide.Records, ERTAccess::StorageWrite);
	Builder.Keep(Guide.Tiles);
}

FAddress GetGuideTiles(FPassContext& Pass, const FPathGuide& Guide)
{
	return Guide.bPrevious ? GetAddress(Pass, Guide.Tiles) + Guide.PreviousOffset : 0;
}

void AddPathGuideUpdate(FFrameContext& Context, const FGBuffer& GBuffer, const FPathGuide& Guide)
{
	const FFrameContext* const Frame = &Context;
	Context.Graph.AddPass("PathGuide", [&](FPassBuilder& Builder) -> FPassExecute {
		for (const FGraphTexture Texture : {GBuffer.Depth, GBuffer.Normals}) { Builder.Read(Texture, ERTAccess::ShaderRead); }
		Builder.Read(Guide.Records, ERTAccess::ShaderRead);
		if (Guide.bPrevious) { Builder.Read(Guide.Tiles, ERTAccess::StorageRead); }
		Builder.Write(Guide.Tiles, ERTAccess::StorageWrite);
		Context.Tokens.LeaveAlone(Builder);
		Builder.AllowAsync();
		return [=](FPassContext& Pass) {
			const FAddress Tiles = GetAddress(Pass, Guide.Tiles);
			FPathGuideConstants C{};
			C.Pass = Frame->Pass;
			C.Previous = Guide.bPrevious ? Tiles + Guide.PreviousOffset : 0;
			C.Current = Tiles + Guide.Offset;
			C.Records = GetAddress(Pass, Guide.Records);
			C.Depth = GetSampledIndex(Pass, GBuffer.Depth);
			C.Normals = GetSampledIndex(Pass, GBuffer.Normals);
			Dispatch2D(Pass, Guide.Update, C, Frame->Width, Frame->Height, PATH_GUIDE_TILE);
		};
	});
}

} // namespace Lantern
