// Pictures of tiles.
#include "Tiles/TileView.h"

#include "DebugView/DebugView.h"
#include "SettledTypes.h"

namespace Lantern
{

namespace
{
bool IsWanted() { return IsDebugPicture(TilePictures[0]) || IsDebugPicture(TilePictures[1]); }

FShaderSource MakeTileViewSource() { return MakeComputeSource("Tiles/TileView.comp"); }
} // namespace

void ListTileViewShaders(std::vector<FShaderSource>& Out)
{
	if (IsWanted()) { Out.push_back(MakeTileViewSource()); }
}

void AddTileView(FFrameContext& Context, FGraphBuffer Tiles)
{
	if (!IsWanted()) { return; }
	IRTPipeline* const Pipeline = RequireCompute(Context, MakeTileViewSource());
	if (!Pipeline) { return; }
	const FGraphTexture Output = Context.Graph.CreateTexture({Context.Width, Context.Height, ERTFormat::RGBA8_UNORM}, "TileView");
	const FFrameContext* const Frame = &Context;
	Context.Graph.AddPass("TileView", [&](FPassBuilder& Builder) -> FPassExecute {
		Builder.Read(Tiles, ERTAccess::ShaderRead);
		Builder.Write(Output, ERTAccess::StorageWrite);
		return [=](FPassContext& Pass) {
			FTileViewConstants C{};
			C.Pass = Frame->Pass;
			C.Tiles = Pass.GetBuffer(Tiles)->GetDeviceAddress();
			C.Output = GetStorageIndex(Pass, Output);
			C.bRays = IsDebugPicture(TilePictures[1]) ? 1u : 0u;
			Dispatch2D(Pass, Pipeline, C, Frame->Width, Frame->Height, TILE_SIZE);
		};
	});
	Context.DebugPicture = Output;
}

} // namespace Lantern
