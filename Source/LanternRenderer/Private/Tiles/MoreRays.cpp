// Passes that ask for more sun rays and trace them.
#include "Tiles/MoreRays.h"

#include "Denoise/Denoise.h"
#include "Denoise/SurfaceHistory.h"
#include "LanternCore/Config/ConsoleVariables.h"
#include "MoreRaysTypes.h"
#include "Tiles/Tiles.h"

namespace Lantern
{

namespace
{
TRTConsoleVariable<int32_t> CVarMoreRays("r.RT.Shadow.MoreRays", 8,
    "Further sun rays of a pixel in a penumbra, where the filter has no history to rely on. This is what has just come into view, all but "
    "wide penumbrae while the picture moves, and shadows of what moves. Powers of two spread best. Needs r.RT.Shadow.Denoise and soft "
    "shadows. 0: none.",
    {0, 32});

FShaderSource MakeSource() { return MakeComputeSource("Tiles/MoreRays.comp"); }

bool IsSameView(const FView& A, const FView& B)
{
	const FViewWindow WindowA = A.GetWindow(), WindowB = B.GetWindow();
	return A.Position == B.Position && A.Forward == B.Forward && A.Up == B.Up && A.Width == B.Width && A.Height == B.Height &&
	       A.Near == B.Near && WindowA == WindowB;
}

void AddAskPass(FFrameContext& Context, IRTPipeline* Pipeline, const FRayQueue& More, FGraphBuffer Tiles, FGraphBuffer Marks,
    const FShadowChanges& Changes, FGraphTexture History)
{
	const FFrameContext* const Frame = &Context;
	const FSurfaceTextures Surface = Context.Surface;
	const bool bPrevious = Surface.Previous.IsValid();
	Context.Graph.AddPass((More.Name + "Ask").c_str(), [&](FPassBuilder& Builder) -> FPassExecute {
		for (const FGraphBuffer Buffer : {Tiles, More.Answers, More.SunWidths}) { Builder.Read(Buffer, ERTAccess::ShaderRead); }
		Builder.Write(Marks, ERTAccess::StorageWrite);
		Builder.Read(Surface.Current, ERTAccess::ShaderRead);
		for (const FGraphTexture Texture : {Surface.Reprojection, Surface.Motion})
		{
			if (bPrevious) { Builder.Read(Texture, ERTAccess::ShaderRead); }
		}
		if (History.IsValid()) { Builder.Read(History, ERTAccess::ShaderRead); }
		Builder.AllowAsync();
		return [=](FPassContext& Pass) {
			FMoreRaysConstants C{};
			C.Pass = Frame->Pass;
			C.Tiles = GetAddress(Pass, Tiles);
			C.Marks = GetAddress(Pass, Marks);
			C.Answers = GetAddress(Pass, More.Answers);
			C.Widths = GetAddress(Pass, More.SunWidths);
			C.Casters = Changes.Casters;
			C.CasterCount = Changes.CasterCount;
			C.CasterSpread = Changes.Spread;
			C.Surface = GetSampledIndex(Pass, Surface.Current);
			C.Reprojection = GetSampledIndex(Pass, bPrevious ? Surface.Reprojection : FGraphTexture{});
			C.Motion = GetSampledIndex(Pass, bPrevious ? Surface.Motion : FGraphTexture{});
			C.History = GetSampledIndex(Pass, History);
			Dispatch2D(Pass, Pipeline, C, Frame->Width, Frame->Height, TILE_SIZE);
		};
	});
}
} // namespace

uint32_t GetMoreRays() { return static_cast<uint32_t>(CVarMoreRays.GetOnRenderThread()); }

void ListMoreRaysShaders(std::vector<FShaderSource>& Out)
{
	Out.push_back(MakeSource());
	ListSurfaceShaders(Out);
}

void AddMoreRays(FFrameContext& Context, const FGBuffer& GBuffer, const FRayDispatch& Dispatch, const FRayQueue& Queue,
    const FQueuedRays& Rays, FGraphBuffer Tiles, FGraphBuffer Lit, const FShadowChanges& Changes, const char* FilterName,
    FHistoryTexture& OutHistory)
{
	IRTPipeline* const Pipeline = RequireCompute(Context, MakeSource());
	if (!Pipeline || !RequireSurface(Context, {GBuffer.Depth, GBuffer.Normals, GBuffer.Motion})) { return; }
	const bool bHistory = Context.PreviousView && Context.Surface.Previous.IsValid();
	if (bHistory && Changes.CasterCount == 0 && IsSameView(Context.View, *Context.PreviousView)) { return; }
	if (!RequireDenoiseHistory(Context, FilterName, OutHistory)) { return; }
	const FRayQueue More = CreateFurtherQueue(Context, Queue, "More");
	FQueuedRays Traced = Rays;
	Traced.MoreSamples = GetMoreRays();
	Traced.MoreAnswers = {}; // of lamps
	const FGraphBuffer Marks = CreateSunMarks(Context, More);
	AddAskPass(Context, Pipeline, More, Tiles, Marks, Changes, OutHistory.Previous);
	AddSunQueuePass(Context, {More, Marks, Lit, Traced.MoreSamples});
	AddShadowRaysPass(Context, GBuffer, Dispatch, More, Traced);
}

} // namespace Lantern
