// The passes of screen probes before and behind their rays.
#include "ScreenProbes/ScreenProbes.h"

#include <cstring>
#include <string>

#include "LobePixels.h"
#include "TileTypes.h"

namespace Lantern
{

namespace
{
TRTConsoleVariable<int32_t> CVarSpacing("r.RT.GI.Probes.Spacing", 16,
    "Pixels from one screen probe of r.RT.GI 2 to the next, 8 to 32. Each traces 64 rays. Rounded to a multiple of 8.", {8, 32});
TRTConsoleVariable<float> CVarNear("r.RT.GI.Probes.Near", 2.0f,
    "Length of short rays of pixels, over the spacing of screen probes. They see what lies between a pixel and the probes around it: "
    "contact "
    "shadows, and colour from what is near. One pixel of four traces one in a frame. 0: none does.",
    {0, 64});
TRTConsoleVariable<bool> CVarSolidAngle(
    "r.RT.Debug.GI.SolidAngle", true, "Planted fault. If off, all texels of a screen probe's map count as if they had one solid angle.");
TRTConsoleVariable<bool> CVarUnseen(
    "r.RT.Debug.GI.Unseen", true, "Planted fault. If off, what a screen probe cannot see below its own surface counts as dark.");

constexpr uint32_t RaysPerPixelToVote = 4; // as many rays vote as where one pixel of four traces

FShaderSource MakeSource(const char* Name, bool bSecondLobe = false)
{
	FShaderDefines Defines;
	if (bSecondLobe) { Defines.emplace_back("SECOND_LOBE", "1"); }
	if (!CVarSolidAngle.GetOnRenderThread()) { Defines.emplace_back("NO_SOLID_ANGLE", "1"); }
	if (!CVarUnseen.GetOnRenderThread()) { Defines.emplace_back("NO_UNSEEN", "1"); }
	return MakeComputeSource(std::string("ScreenProbes/") + Name + ".comp", std::move(Defines));
}

FScreenProbeGrid MakeGrid(const FFrameContext& Context)
{
	FScreenProbeGrid Grid{};
	Grid.Spacing = static_cast<uint32_t>(CVarSpacing.GetOnRenderThread()) / 8 * 8;
	Grid.Columns = DivideUp(Context.Width, Grid.Spacing);
	Grid.Rows = DivideUp(Context.Height, Grid.Spacing);
	const uint32_t PixelsOfProbe = Grid.Spacing * Grid.Spacing;
	Grid.NearReach = CVarNear.GetOnRenderThread();
	Grid.RaysPerVote = std::max(RaysPerPixelToVote * uint32_t(SCREEN_PROBE_TEXELS) / PixelsOfProbe, 1u);
	return Grid;
}

uint64_t GetPlanBytes(const FScreenProbeGrid& Grid) { return uint64_t(Grid.Columns) * Grid.Rows * sizeof(FScreenProbePlan); }

uint64_t GetRayBytes(const FScreenProbeGrid& Grid)
{
	return uint64_t(Grid.Columns) * Grid.Rows * uint64_t(SCREEN_PROBE_TEXELS) * sizeof(FScreenProbeRay);
}

FScreenProbeConstants MakeConstants(FPassContext& Pass, const FFrameContext& Frame, const FGBuffer& GBuffer, const FScreenProbes& Probes)
{
	FScreenProbeConstants C{};
	C.Pass = Frame.Pass;
	C.Grid = WriteScreenProbeGrid(Pass, Probes);
	C.Depth = GetSampledIndex(Pass, GBuffer.Depth);
	C.Normals = GetSampledIndex(Pass, GBuffer.Normals);
	C.BaseColor = C.Material = C.Output = C.SecondOutput = NO_TEXTURE;
	return C;
}

/// Adds a pass with a work group for each probe. bFirst: of the frame's.
void AddProbePass(
    FFrameContext& Context, const FGBuffer& GBuffer, const FScreenProbes& Probes, const char* Name, IRTPipeline* Pipeline, bool bFirst)
{
	const FFrameContext* const Frame = &Context;
	Context.Graph.AddPass((std::string("ScreenProbes") + Name).c_str(), [&](FPassBuilder& Builder) -> FPassExecute {
		for (const FGraphTexture Texture : {GBuffer.Depth, GBuffer.Normals}) { Builder.Read(Texture, ERTAccess::ShaderRead); }
		if (!bFirst || Probes.Kept.bPrevious) { Builder.Read(Probes.Kept.Buffer, ERTAccess::StorageRead); }
		if (!bFirst) { Builder.Read(Probes.Work, ERTAccess::StorageRead); }
		Builder.Write(Probes.Work, ERTAccess::StorageWrite);
		Builder.Write(Probes.Kept.Buffer, ERTAccess::StorageWrite);
		Builder.Keep(Probes.Kept.Buffer);
		Context.Tokens.LeaveAlone(Builder);
		Builder.AllowAsync();
		return [=](FPassContext& Pass) {
			const FScreenProbeConstants C = MakeConstants(Pass, *Frame, GBuffer, Probes);
			Dispatch2D(Pass, Pipeline, C, Probes.Grid.Columns, Probes.Grid.Rows, 1);
		};
	});
}
} // namespace

void AddScreenProbeShaders(bool bSecondLobe, FShaderDefines& InOutDefines, std::vector<FShaderSource>& OutCompute)
{
	InOutDefines.emplace_back(ScreenProbesDefine, "1");
	for (const char* Name : {"Plan", "Resolve", "Project"}) { OutCompute.push_back(MakeSource(Name)); }
	OutCompute.push_back(MakeSource("Gather", bSecondLobe));
}

uint32_t CountScreenProbeVoters(const FFrameContext& Context)
{
	const FScreenProbeGrid Grid = MakeGrid(Context);
	return DivideUp(Grid.Columns * Grid.Rows * uint32_t(SCREEN_PROBE_TEXELS), Grid.RaysPerVote);
}

FScreenProbes MakeScreenProbes(FFrameContext& Context, bool bSecondLobe)
{
	FScreenProbes Probes;
	Probes.Plan = RequireCompute(Context, MakeSource("Plan")); // all are asked for at once
	Probes.Resolve = RequireCompute(Context, MakeSource("Resolve"));
	Probes.Project = RequireCompute(Context, MakeSource("Project"));
	IRTPipeline* const Gather = RequireCompute(Context, MakeSource("Gather", bSecondLobe));
	if (!Probes.Plan || !Probes.Resolve || !Probes.Project || !Gather) { return {}; }
	Probes.Grid = MakeGrid(Context);
	const uint64_t Bytes = uint64_t(Probes.Grid.Columns) * Probes.Grid.Rows * sizeof(FScreenProbe);
	if (!RequireTwoFrames(Context, "ScreenProbes", Bytes, Probes.Kept)) { return {}; }
	if (FRTStatus S = Context.Owner->GetUploads().Allocate(sizeof(FScreenProbeGrid), Probes.GridData); !S)
	{
		Context.Fail(S);
		return {};
	}
	Probes.NearRays = Probes.Grid.NearReach > 0.0f ? DivideUp(Context.Width, 2) * DivideUp(Context.Height, 2) : 0;
	const uint64_t NearBytes = uint64_t(Probes.NearRays) * sizeof(FScreenProbeRay);
	Probes.Work = Context.Graph.CreateBuffer({GetPlanBytes(Probes.Grid) + GetRayBytes(Probes.Grid) + NearBytes}, "ScreenProbeWork");
	Probes.Gather = Gather;
	return Probes;
}

void AddScreenProbePlan(FFrameContext& Context, const FGBuffer& GBuffer, const FScreenProbes& Probes)
{
	AddProbePass(Context, GBuffer, Probes, "Plan", Probes.Plan, true);
}

void DeclareScreenProbeRays(FPassBuilder& Builder, const FScreenProbes& Probes)
{
	Builder.Read(Probes.Kept.Buffer, ERTAccess::StorageRead);
	Builder.Read(Probes.Work, ERTAccess::StorageRead);
	Builder.Write(Probes.Work, ERTAccess::StorageWrite);
}

FAddress WriteScreenProbeGrid(FPassContext& Pass, const FScreenProbes& Probes)
{
	if (!Probes.IsValid()) { return 0; }
	const FAddress Kept = GetAddress(Pass, Probes.Kept.Buffer), Work = GetAddress(Pass, Probes.Work);
	FScreenProbeGrid Grid = Probes.Grid;
	Grid.Probes = Kept + Probes.Kept.Offset;
	Grid.Previous = Probes.Kept.bPrevious ? Kept + Probes.Kept.PreviousOffset : 0;
	Grid.Plans = Work;
	Grid.Rays = Work + GetPlanBytes(Grid);
	Grid.NearRays = Grid.Rays + GetRayBytes(Grid);
	std::memcpy(Probes.GridData.Data, &Grid, sizeof(Grid));
	return Probes.GridData.Address;
}

void AddScreenProbeGather(
    FFrameContext& Context, const FGBuffer& GBuffer, const FScreenProbes& Probes, FGraphTexture Output, FGraphTexture Second)
{
	AddProbePass(Context, GBuffer, Probes, "Resolve", Probes.Resolve, false);
	AddProbePass(Context, GBuffer, Probes, "Project", Probes.Project, false);
	const FFrameContext* const Frame = &Context;
	Context.Graph.AddPass("ScreenProbesGather", [&](FPassBuilder& Builder) -> FPassExecute {
		DeclareLobePixels(Builder, GBuffer, {Output, Second});
		Builder.Read(Probes.Kept.Buffer, ERTAccess::StorageRead);
		Builder.Read(Probes.Work, ERTAccess::StorageRead);
		Context.Tokens.LeaveAlone(Builder);
		Builder.AllowAsync();
		return [=](FPassContext& Pass) {
			FScreenProbeConstants C = MakeConstants(Pass, *Frame, GBuffer, Probes);
			SetLobePixels(Pass, GBuffer, {Output, Second}, C);
			Dispatch2D(Pass, Probes.Gather, C, Frame->Width, Frame->Height, TILE_SIZE);
		};
	});
}

} // namespace Lantern
