// Shows light cells.
#include "Lights/LightCellsView.h"

#include "LanternCore/Text/Log.h"
#include "Lights/LightCells.h"

namespace Lantern
{

FGraphTexture AddLightCellsView(FFrameContext& Context, const FGBuffer& GBuffer, FGraphTexture Otherwise)
{
	const FLightCellsOfFrame& Cells = RequireLightCells(Context, GBuffer);
	if (!Cells.Buffer.IsValid())
	{
		LogOnce(ERTLogLevel::Info,
		    "r.RT.Debug.View shows the picture: there are no light cells. They are off (r.RT.Lights.Cells), the scene "
		    "has too few lights of finite range for them, or their shaders are being compiled");
		return Otherwise;
	}
	IRTPipeline* const Pipeline = RequireCompute(Context, MakeLightCellsViewSource());
	if (!Pipeline) { return Otherwise; }
	const FGraphTexture Output = Context.Graph.CreateTexture({Context.Width, Context.Height, ERTFormat::RGBA8_UNORM}, "DebugView");
	const FFrameContext* const Frame = &Context;
	Context.Graph.AddPass("DebugView", [&](FPassBuilder& Builder) -> FPassExecute {
		Builder.Read(GBuffer.Depth, ERTAccess::ShaderRead);
		ReadLightCells(Builder, Cells, false);
		Builder.Write(Output, ERTAccess::StorageWrite);
		return [=](FPassContext& Pass) {
			FLightCellConstants C{};
			C.Pass = Frame->Pass;
			C.Grid = Frame->World->LightCells.Address;
			C.Depth = GetSampledIndex(Pass, GBuffer.Depth);
			C.Output = GetStorageIndex(Pass, Output);
			Dispatch2D(Pass, Pipeline, C, Frame->Width, Frame->Height, LIGHT_CELL_MARK_SIZE);
		};
	});
	return Output;
}

} // namespace Lantern
