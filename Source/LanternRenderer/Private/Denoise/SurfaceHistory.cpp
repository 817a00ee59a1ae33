// Packs what pixels show, and keeps it for the next frame.
#include "Denoise/SurfaceHistory.h"

#include "Denoise/Denoise.h"
#include "DenoiseTypes.h"
#include "LanternCore/FrameGraph/History.h"
#include "Motion/CameraMotion.h"
#include "PassTools.h"

namespace Lantern
{

namespace
{
FShaderSource MakeSurfaceSource() { return MakeComputeSource("Denoise/Surface.comp", MakeValidationDefines()); }

/// Surface: all that the pass reads and writes.
void AddSurfacePass(FFrameContext& Context, const FSurfaceInputs& Inputs, IRTPipeline* Pipeline, const FSurfaceTextures& Surface,
    FGraphTexture PreviousAnchors)
{
	const FPassConstants PassConstants = Context.Pass;
	const uint32_t Width = Context.Width, Height = Context.Height;
	const FGraphTexture Motion = Surface.Motion.IsValid() ? Surface.Motion : Inputs.Motion;
	Context.Graph.AddPass("Surface", [&](FPassBuilder& Builder) -> FPassExecute {
		for (const FGraphTexture Texture : {Inputs.Depth, Inputs.Normals, Motion, Surface.Previous, PreviousAnchors})
		{
			if (Texture.IsValid()) { Builder.Read(Texture, ERTAccess::ShaderRead); }
		}
		Builder.Write(Surface.Current, ERTAccess::StorageWrite);
		Builder.Write(Surface.Anchors, ERTAccess::StorageWrite);
		if (Surface.Reprojection.IsValid()) { Builder.Write(Surface.Reprojection, ERTAccess::StorageWrite); }
		return [=](FPassContext& Pass) {
			FSurfaceConstants C{};
			C.Pass = PassConstants;
			C.Depth = GetSampledIndex(Pass, Inputs.Depth);
			C.Normals = GetSampledIndex(Pass, Inputs.Normals);
			C.Motion = GetSampledIndex(Pass, Motion);
			C.PreviousSurface = GetSampledIndex(Pass, Surface.Previous);
			C.Output = GetStorageIndex(Pass, Surface.Current);
			C.OutReprojection = GetStorageIndex(Pass, Surface.Reprojection);
			C.PreviousAnchors = GetSampledIndex(Pass, PreviousAnchors);
			C.OutAnchors = GetStorageIndex(Pass, Surface.Anchors);
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
	FHistoryTexture Surface, Anchors;
	FRTStatus Status = Context.History->GetTexture("Surface", {Context.Width, Context.Height, ERTFormat::RG32_FLOAT}, Surface);
	if (Status) { Status = Context.History->GetTexture("Anchors", {Context.Width, Context.Height, ERTFormat::RG32_UINT}, Anchors); }
	if (!Status)
	{
		Context.Fail(Status);
		return false;
	}
	FSurfaceTextures Made;
	Made.Current = Surface.Current;
	Made.Anchors = Anchors.Current;
	if (Surface.Previous.IsValid())
	{
		Made.Motion = Inputs.Motion.IsValid() ? Inputs.Motion : AddCameraMotionPass(Context, Inputs.Depth);
		if (!Made.Motion.IsValid()) { return false; }
		Made.Previous = Surface.Previous;
		Made.Reprojection = Context.Graph.CreateTexture({Context.Width, Context.Height, ERTFormat::RG32_UINT}, "Reprojection");
	}
	AddSurfacePass(Context, Inputs, Pipeline, Made, Anchors.Previous);
	Context.Surface = Made;
	return true;
}

} // namespace Lantern
