// Packs what pixels show, and keeps it for the next frame.
#include "Denoise/SurfaceHistory.h"

#include "DenoiseTypes.h"
#include "LanternCore/FrameGraph/History.h"
#include "Motion/CameraMotion.h"
#include "PassTools.h"

namespace Lantern
{

namespace
{
FShaderSource MakeSurfaceSource() { return MakeComputeSource("Denoise/Surface.comp"); }

void AddSurfacePass(FFrameContext& Context, const FSurfaceInputs& Inputs, IRTPipeline* Pipeline, FGraphTexture Output)
{
	const FPassConstants PassConstants = Context.Pass;
	const uint32_t Width = Context.Width, Height = Context.Height;
	Context.Graph.AddPass("Surface", [&](FPassBuilder& Builder) -> FPassExecute {
		Builder.Read(Inputs.Depth, ERTAccess::ShaderRead);
		Builder.Read(Inputs.Normals, ERTAccess::ShaderRead);
		if (Inputs.Motion.IsValid()) { Builder.Read(Inputs.Motion, ERTAccess::ShaderRead); }
		Builder.Write(Output, ERTAccess::StorageWrite);
		return [=](FPassContext& Pass) {
			FSurfaceConstants C{};
			C.Pass = PassConstants;
			C.Depth = Pass.GetTexture(Inputs.Depth)->GetSampledIndex();
			C.Normals = Pass.GetTexture(Inputs.Normals)->GetSampledIndex();
			C.Motion = Inputs.Motion.IsValid() ? Pass.GetTexture(Inputs.Motion)->GetSampledIndex() : NO_TEXTURE;
			C.Output = Pass.GetTexture(Output)->GetStorageIndex();
			Dispatch2D(Pass, Pipeline, C, Width, Height, DENOISE_GROUP_SIZE);
		};
	});
}
} // namespace

void ListSurfaceShaders(std::vector<FShaderSource>& Out) { Out.push_back(MakeSurfaceSource()); }

bool RequireSurface(FFrameContext& Context, const FSurfaceInputs& Inputs)
{
	if (Context.Surface.Current.IsValid()) { return true; }
	IRTPipeline* const Pipeline = RequireCompute(Context, MakeSurfaceSource());
	// Asked for in the first frame, which has nothing to reproject: the second one does.
	const bool bMotion = Inputs.Motion.IsValid() || RequireCompute(Context, MakeCameraMotionSource());
	if (!Pipeline || !bMotion) { return false; }
	FHistoryTexture Surface;
	if (FRTStatus S = Context.History->GetTexture("Surface", {Context.Width, Context.Height, ERTFormat::RG32_FLOAT}, Surface); !S)
	{
		Context.Fail(S);
		return false;
	}
	AddSurfacePass(Context, Inputs, Pipeline, Surface.Current);
	Context.Surface.Current = Surface.Current;
	if (!Surface.Previous.IsValid()) { return true; }
	Context.Surface.Motion = Inputs.Motion.IsValid() ? Inputs.Motion : AddCameraMotionPass(Context, Inputs.Depth);
	if (!Context.Surface.Motion.IsValid()) { return false; }
	Context.Surface.Previous = Surface.Previous;
	return true;
}

} // namespace Lantern
