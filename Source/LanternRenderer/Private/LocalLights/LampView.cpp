// Pictures of what tiles and pixels asked of local lights.
#include "LocalLights/LampView.h"

#include "DebugView/DebugView.h"
#include "LocalLightTypes.h"

namespace Lantern
{

namespace
{
bool IsWanted() { return IsDebugPicture(LampPictures[0]) || IsDebugPicture(LampPictures[1]); }

FShaderSource MakeLampViewSource() { return MakeComputeSource("LocalLights/LampView.comp"); }
} // namespace

void ListLampViewShaders(std::vector<FShaderSource>& Out)
{
	if (IsWanted()) { Out.push_back(MakeLampViewSource()); }
}

void AddLampView(FFrameContext& Context, const FShadowRays& Rays)
{
	if (!IsWanted() || Context.DebugPicture.IsValid()) { return; }
	IRTPipeline* const Pipeline = RequireCompute(Context, MakeLampViewSource());
	if (!Pipeline) { return; }
	const FGraphTexture Output = Context.Graph.CreateTexture({Context.Width, Context.Height, ERTFormat::RGBA8_UNORM}, "LampView");
	const FFrameContext* const Frame = &Context;
	const FGraphBuffer Tiles = Rays.Traced.TileLights, Answers = Rays.Queue.Answers;
	Context.Graph.AddPass("LampView", [&](FPassBuilder& Builder) -> FPassExecute {
		for (const FGraphBuffer Buffer : {Tiles, Answers})
		{
			if (Buffer.IsValid()) { Builder.Read(Buffer, ERTAccess::ShaderRead); }
		}
		Builder.Write(Output, ERTAccess::StorageWrite);
		return [=](FPassContext& Pass) {
			FLampViewConstants C{};
			C.Pass = Frame->Pass;
			C.TileLights = GetAddress(Pass, Tiles);
			C.Answers = GetAddress(Pass, Answers);
			C.Output = GetStorageIndex(Pass, Output);
			C.bRays = IsDebugPicture(LampPictures[1]) ? 1u : 0u;
			Dispatch2D(Pass, Pipeline, C, Frame->Width, Frame->Height, TILE_SIZE);
		};
	});
	Context.DebugPicture = Output;
}

} // namespace Lantern
