// Looks up what is known of the light of one pixel.
#include "RadianceCells/Explain.h"

#include "Feedback/PixelExplainer.h"
#include "Lights/LightCells.h"

namespace Lantern
{

namespace
{
FShaderSource MakeSource() { return MakeComputeSource("RadianceCells/Explain.comp"); }
} // namespace

void ListExplainShaders(std::vector<FShaderSource>& Out)
{
	if (GetExplainedPixel()) { Out.push_back(MakeSource()); }
}

void AddExplainPass(FFrameContext& Context, const FGBuffer& GBuffer)
{
	const std::shared_ptr<const FRadianceCells> Cells = Context.World->RadianceCells;
	if (Context.ExplainedPixel == 0 || !Cells) { return; }
	IRTPipeline* const Pipeline = RequireCompute(Context, MakeSource());
	if (!Pipeline) { return; }
	const FFrameContext* const Frame = &Context;
	const FLightCellsOfFrame& Lights = Context.World->LightCells;
	const bool bLights = Lights.Buffer.IsValid();
	Context.Graph.AddPass("Explain", [&](FPassBuilder& Builder) -> FPassExecute {
		for (const FGraphTexture Texture : {GBuffer.Depth, GBuffer.Normals}) { Builder.Read(Texture, ERTAccess::ShaderRead); }
		ReadRadianceCells(Builder, Cells.get());
		if (bLights) { ReadLightCells(Builder, Lights, false); }
		Builder.NeverCull(); // the graph does not see what it writes
		Context.Tokens.LeaveAlone(Builder);
		return [=, Pixel = GetExplainedPixel().value_or(glm::uvec2(0))](FPassContext& Pass) {
			FExplainConstants C{};
			C.Pass = Frame->Pass;
			C.Grid = WriteRadianceGrid(Pass, Cells.get());
			C.Lights = bLights ? Frame->World->LightCells.Address : 0;
			C.Out = Frame->ExplainedPixel;
			C.Depth = GetSampledIndex(Pass, GBuffer.Depth);
			C.Normals = GetSampledIndex(Pass, GBuffer.Normals);
			C.X = Pixel.x;
			C.Y = Pixel.y;
			DispatchMany(Pass, Pipeline, C, 1);
		};
	});
}

} // namespace Lantern
