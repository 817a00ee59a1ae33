// Pictures of radiance cells.
#include "RadianceCells/RadianceCellsView.h"

#include "DebugView/DebugView.h"

namespace Lantern
{

namespace
{
bool IsWanted() { return IsDebugPicture(RadianceCellPictures[0]) || IsDebugPicture(RadianceCellPictures[1]); }

FShaderSource MakeSource() { return MakeComputeSource("RadianceCells/View.comp"); }
} // namespace

void ListRadianceCellsViewShaders(std::vector<FShaderSource>& Out)
{
	if (IsWanted()) { Out.push_back(MakeSource()); }
}

void AddRadianceCellsView(FFrameContext& Context, const FGBuffer& GBuffer)
{
	const std::shared_ptr<const FRadianceCells> Cells = Context.World->RadianceCells;
	if (!IsWanted() || !Cells) { return; }
	IRTPipeline* const Pipeline = RequireCompute(Context, MakeSource());
	if (!Pipeline) { return; }
	const FGraphTexture Output = Context.Graph.CreateTexture({Context.Width, Context.Height, ERTFormat::RGBA8_UNORM}, "RadianceCellsView");
	const FFrameContext* const Frame = &Context;
	Context.Graph.AddPass("RadianceCellsView", [&](FPassBuilder& Builder) -> FPassExecute {
		for (const FGraphTexture Texture : {GBuffer.Depth, GBuffer.Normals}) { Builder.Read(Texture, ERTAccess::ShaderRead); }
		ReadRadianceCells(Builder, Cells.get());
		Builder.Write(Output, ERTAccess::StorageWrite);
		Context.Tokens.LeaveAlone(Builder);
		return [=](FPassContext& Pass) {
			FRadianceCellViewConstants C{};
			C.Pass = Frame->Pass;
			C.Grid = WriteRadianceGrid(Pass, Cells.get());
			C.Depth = GetSampledIndex(Pass, GBuffer.Depth);
			C.Normals = GetSampledIndex(Pass, GBuffer.Normals);
			C.Output = GetStorageIndex(Pass, Output);
			C.bLight = IsDebugPicture(RadianceCellPictures[1]) ? 1u : 0u;
			Dispatch2D(Pass, Pipeline, C, Frame->Width, Frame->Height, RADIANCE_CELL_VIEW_GROUP);
		};
	});
	Context.DebugPicture = Output;
}

} // namespace Lantern
