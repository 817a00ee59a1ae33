// The pass of surfaces that light shines through, and the sample engine's use of it.
#include "Transmission/Transmission.h"

#include "Lights/LightCells.h"
#include "RadianceCells/RadianceCells.h"
#include "SignalPasses.h"
#include "TileTypes.h"
#include "TransmissionTypes.h"

namespace Lantern
{

namespace
{
TRTConsoleVariable<int32_t> CVarLayers("r.RT.Transmission.Layers", 4,
    "Most sheets of glass that a pixel shows one behind the other. Those behind are left out. What bends light ends the count: all behind "
    "it "
    "is traced.",
    {1, 16});
TRTConsoleVariable<int32_t> CVarPath("r.RT.Transmission.Path", 0,
    "How surfaces that light shines through are traced. 0: by the pipeline where there is one. 1: ray-tracing pipeline. 2: ray queries, "
    "which see all materials as the standard program shows them, and no own shapes.",
    {0, 2});
constexpr uint32_t BouncesWithoutCell = 2; // of a path that would end in a cell and meets none, or where there are no cells

FShaderSource MakeCompositeSource() { return MakeComputeSource("Transmission/Composite.comp"); }

std::optional<FRayDispatch> FindDispatch(const FFrameContext& Context)
{
	const FPassRays Rays = ChooseTransmissionRays({Context.Device.GetCapabilities(), Context.Facts, Context.Signals});
	return RequireRayDispatch(
	    Context, Rays, Context.GetRayGen(EPassRayGen::Transmission), MakeQuerySource(Context.Facts, TransmissionShaders, Rays));
}

FTransmission AddTracePass(FFrameContext& Context, const FGBuffer& GBuffer, const FRayDispatch& Dispatch)
{
	const FPassQuery Query{Context.Device.GetCapabilities(), Context.Facts, Context.Signals};
	const ERayPath Cached = ChooseRadianceCellPath(Query);
	const bool bCells = Cached != ERayPath::None && Dispatch.Has("RADIANCE_CELLS");
	const FRadianceCells* const Cells = bCells ? RequireRadianceCells(Context, Cached) : nullptr;
	const FLightCellsOfFrame& LightCells = RequireLightCells(Context, GBuffer);
	FTransmission Out;
	Out.Light = Context.Graph.CreateTexture({Context.Width, Context.Height, ERTFormat::RGBA16_FLOAT}, "TransmissionLight");
	Out.Transmittance = Context.Graph.CreateTexture({Context.Width, Context.Height, ERTFormat::RGBA8_UNORM}, "TransmissionTransmittance");
	Out.Looks = Context.Graph.CreateTexture({Context.Width, Context.Height, ERTFormat::RGBA32_UINT}, "TransmissionLooks");
	const FFrameContext* const Frame = &Context;
	Context.Graph.AddPass("Transmission", [&](FPassBuilder& Builder) -> FPassExecute {
		for (const FGraphTexture Texture : {GBuffer.Depth, GBuffer.Normals}) { Builder.Read(Texture, ERTAccess::ShaderRead); }
		ReadRadianceCells(Builder, Cells);
		ReadLightCells(Builder, LightCells, true);
		for (const FGraphTexture Texture : {Out.Light, Out.Transmittance, Out.Looks}) { Builder.Write(Texture, ERTAccess::StorageWrite); }
		Builder.AllowAsync();
		Builder.RunBeside(PathsGroup);
		return [=](FPassContext& Pass) {
			FTransmissionConstants C{};
			C.Pass = Frame->Pass;
			C.Depth = GetSampledIndex(Pass, GBuffer.Depth);
			C.Normals = GetSampledIndex(Pass, GBuffer.Normals);
			C.Light = GetStorageIndex(Pass, Out.Light);
			C.Transmittance = GetStorageIndex(Pass, Out.Transmittance);
			C.Looks = GetStorageIndex(Pass, Out.Looks);
			C.MostLayers = static_cast<uint32_t>(CVarLayers.GetOnRenderThread());
			C.MaxBounces = BouncesWithoutCell;
			C.FirstVoter = Cells ? Cells->TransmissionVoters : 0;
			C.RadianceCells = WriteRadianceGrid(Pass, Cells);
			Pass.CountRays(uint64_t(Frame->Width) * Frame->Height); // those that look for surfaces; few find one
			if (Dispatch.Compute) { Dispatch2D(Pass, Dispatch.Compute, C, Frame->Width, Frame->Height, RAY_QUERY_GROUP_SIZE); }
			else { TraceFrameRays(Pass, *Frame, Dispatch.RayGen, C, Frame->Width, Frame->Height); }
		};
	});
	return Out;
}
} // namespace

FPassRays ChooseTransmissionRays(const FPassQuery& Query)
{
	FPassRays Rays;
	const bool bAny = Query.Requests.bTransmission && Query.Facts.bTransmissive && IsRayTracingEnabled() && HasAnyLight(Query.Facts);
	if (bAny) { Rays.Path = ChooseShadingRayPath(Query, CVarPath, "surfaces that light shines through are"); }
	if (Rays.Path == ERayPath::None) { return Rays; }
	Rays.Defines = MakePathDefines(Query.Facts);
	if (Query.Facts.Lights > 0) { Rays.Defines.emplace_back("LIGHT_CELLS_OF_VIEW", "1"); }
	if (ChooseRadianceCellPath(Query) != ERayPath::None) { AddRadianceCellDefines(Rays.Defines); }
	AddRayConeDefine(Rays.Defines);
	if (Rays.Path == ERayPath::Pipeline) { AddReorderDefine(Query.Capabilities, Rays.Defines); }
	SetHitPrograms(EHitPrograms::OwnWhereSeen, Rays);
	Rays.bShadesHits = true;
	Rays.Shaders = TransmissionShaders;
	ListLightCellShaders(Query.Facts, Rays.Compute);
	return Rays;
}

bool IsTransmissionShown(const FFrameContext& Context)
{
	if (!Context.Facts.bTransmissive) { return false; }
	if (Context.GetRayGen(ESignal::Frame) != NoRayGen) { return true; }
	const bool bComposed = Context.Signals.bNothingElse || RequireCompute(Context, MakeCompositeSource()) != nullptr;
	return FindDispatch(Context).has_value() && bComposed;
}

FTransmission AddTransmissionPass(FFrameContext& Context, const FGBuffer& GBuffer)
{
	if (Context.Transmission) { return *Context.Transmission; }
	const std::optional<FRayDispatch> Dispatch = FindDispatch(Context);
	Context.Transmission = Dispatch ? AddTracePass(Context, GBuffer, *Dispatch) : FTransmission();
	return *Context.Transmission;
}

void ListTransmissionComposite(const FSceneFacts& Facts, std::vector<FShaderSource>& Out)
{
	if (Facts.bTransmissive) { Out.push_back(MakeCompositeSource()); }
}

FGraphTexture AddTransmissionComposite(FFrameContext& Context, FGraphTexture Lighting, const FTransmission& Transmission)
{
	IRTPipeline* const Pipeline = Transmission.IsValid() ? RequireCompute(Context, MakeCompositeSource()) : nullptr;
	if (!Pipeline || !Lighting.IsValid()) { return Lighting; }
	const FGraphTexture Output = Context.Graph.CreateTexture({Context.Width, Context.Height, ERTFormat::RGBA32_FLOAT}, "BehindGlass");
	const FFrameContext* const Frame = &Context;
	Context.Graph.AddPass("TransmissionComposite", [&](FPassBuilder& Builder) -> FPassExecute {
		for (const FGraphTexture Texture : {Lighting, Transmission.Light, Transmission.Transmittance, Transmission.Looks})
		{
			Builder.Read(Texture, ERTAccess::ShaderRead);
		}
		Builder.Write(Output, ERTAccess::StorageWrite);
		return [=](FPassContext& Pass) {
			FTransmissionCompositeConstants C{};
			C.Pass = Frame->Pass;
			C.Lighting = GetSampledIndex(Pass, Lighting);
			C.Light = GetSampledIndex(Pass, Transmission.Light);
			C.Transmittance = GetSampledIndex(Pass, Transmission.Transmittance);
			C.Looks = GetSampledIndex(Pass, Transmission.Looks);
			C.Output = GetStorageIndex(Pass, Output);
			Dispatch2D(Pass, Pipeline, C, Frame->Width, Frame->Height, TILE_SIZE);
		};
	});
	return Output;
}

} // namespace Lantern
