// Motion vectors of a world that stands still, from depth and two cameras.
#include "Motion/CameraMotion.h"

#include "CameraMotionTypes.h"

namespace Lantern
{

FGraphTexture AddCameraMotionPass(FFrameContext& Context, FGraphTexture Depth)
{
	IRTPipeline* const Pipeline = Depth.IsValid() ? RequireCompute(Context, MakeCameraMotionSource()) : nullptr;
	if (!Pipeline) { return {}; }
	const uint32_t Width = Context.Width, Height = Context.Height;
	const FGraphTexture Output = Context.Graph.CreateTexture({Width, Height, ERTFormat::RGBA32_FLOAT}, "CameraMotion");
	const FPassConstants PassConstants = Context.Pass;
	Context.Graph.AddPass("CameraMotion", [&](FPassBuilder& Builder) -> FPassExecute {
		Builder.Read(Depth, ERTAccess::ShaderRead);
		Builder.Write(Output, ERTAccess::StorageWrite);
		return [=](FPassContext& Pass) {
			FCameraMotionConstants C{};
			C.Pass = PassConstants;
			C.Depth = Pass.GetTexture(Depth)->GetSampledIndex();
			C.Output = Pass.GetTexture(Output)->GetStorageIndex();
			Dispatch2D(Pass, Pipeline, C, Width, Height, CAMERA_MOTION_GROUP_SIZE);
		};
	});
	return Output;
}

} // namespace Lantern
