// The passes of reflections: the list of pixels, their paths, what these show, the filter, and the signal.
#include "Reflections/ReflectionPaths.h"

#include <algorithm>

#include "DebugView/DebugView.h"
#include "Denoise/Denoise.h"
#include "Feedback/ReflectionCounter.h"
#include "LanternCore/FrameGraph/History.h"
#include "Lights/LightCells.h"
#include "LocalLights/Emitters.h"
#include "MovedShare/MovedShare.h"
#include "RadianceCells/RadianceCells.h"
#include "Rays/ThreadList.h"
#include "ReflectionTypes.h"
#include "Reflections/Reflections.h"
#include "SignalPasses.h"
#include "TileTypes.h"

namespace Lantern
{

namespace
{
TRTConsoleVariable<float> CVarLitRoughness("r.RT.Reflections.LitRoughness", 0.25f,
    "Smoother surfaces show what they mirror lit by the sun and lamps, and further surfaces by radiance cells. Rougher ones show radiance "
    "cells, which are cheaper and blurred.",
    {0.0, 1.0});
TRTConsoleVariable<int32_t> CVarChangedSamples("r.RT.Reflections.ChangedSamples", 4,
    "Number of paths of a mirror's pixel that shows something new while objects move, or whose light they have changed. Others have "
    "r.RT.Reflections.Samples. No more than these: all pixels are alike.",
    {1, 64});
TRTConsoleVariable<float> CVarChangedFrames("r.RT.Reflections.ChangedFrames", 4.0f,
    "Number of frames that the history of such a pixel must still be worth, or it has r.RT.Reflections.ChangedSamples paths.", {1.0, 64.0});
TRTConsoleVariable<float> CVarChangedPaths("r.RT.Reflections.ChangedPaths", 1.0f,
    "Further paths of a frame for such pixels, at most, over the number of pixels that have a path. If more ask, each gets fewer.",
    {0.0, 64.0});
TRTConsoleVariable<bool> CVarMotion(
    "r.RT.Debug.Reflections.Motion", true, "Planted fault. If off, what a mirror shows counts as standing still, however it moves.");
TRTConsoleVariable<bool> CVarCurvature("r.RT.Debug.Reflections.Curvature", true,
    "Planted fault. If off, what a curved mirror showed is looked for where a flat one would have shown it.");
// A wider edge stop spreads the edges of what is shown wherever histories are short (Docs/Performance.md, "Movers in rough reflections").
const FDenoiseVariables Denoise("r.RT.Reflections", FDenoiseDefaults{.SigmaValue = 1.5f, .bColor = true, .HistorySeconds = 0.25f});
constexpr float Fade = 0.1f;               // roughness over which reflections fade out
constexpr float MirrorRoughness = 0.032f;  // IsMirror in Brdf.glsl
constexpr uint32_t BouncesWithoutCell = 3; // of a path that would end in a cell and meets none

constexpr FDenoiseForm FilterForm{.bColor = true, .bSparse = true, .bReach = true};

FShaderSource MakeSource(const char* Name) { return MakeComputeSource(std::string("Reflections/") + Name + ".comp"); }

FShaderSource MakeSurfaceSource()
{
	FShaderDefines Defines = MakeValidationDefines();
	if (!CVarMotion.GetOnRenderThread()) { Defines.emplace_back("NO_REFLECTED_MOTION", "1"); }
	if (!CVarCurvature.GetOnRenderThread()) { Defines.emplace_back("NO_MIRROR_CURVATURE", "1"); }
	return MakeComputeSource("Reflections/Surface.comp", std::move(Defines));
}

FShaderSource MakeCombineSource(const FSceneFacts& Facts)
{
	FShaderDefines Defines;
	AddSkyDefines(Facts, Defines);
	return MakeComputeSource("Reflections/Combine.comp", std::move(Defines));
}

/// The paths of one frame.
struct FPaths
{
	FReflectionPathSettings Settings;
	FRayDispatch Dispatch;
	IRTPipeline *List = nullptr, *Surface = nullptr, *Changed = nullptr, *Combine = nullptr;
	const FRadianceCells* Cells = nullptr; ///< null: there are none
	uint32_t FirstVoter = 0;
	FGraphTexture Radiance;      ///< over the directional albedo of lobes, and of what mirrors show
	FGraphTexture Mirrored;      ///< albedo and emission of what mirrors show
	FThreadMarks Threads;        ///< pixels that are traced
	FThreadMarks ChangedThreads; ///< those that are traced further; invalid: none are
	FGraphBuffer Hits;           ///< FReflectionHit
	FSurfaceTextures Shown;      ///< what reflections show; Current is invalid: nobody asks
	FGraphTexture LastAnchors;   ///< of the frame before; invalid: there are none
	FGraphTexture Reach;         ///< FDenoiseInputs::Reach; invalid: nobody asks
	FGraphTexture Picture;       ///< one of ReflectionPictures; invalid: nobody asks
};

FReflectionFade GetFade(float MaxRoughness)
{
	if (MaxRoughness >= 1.0f) { return {1.0f, 0.0f}; }
	const float Start = GetFullRoughness(MaxRoughness), End = std::max(MaxRoughness, Start + 1.0e-3f);
	return {End, 1.0f / (End - Start)};
}

/// Number of paths that pixels whose light has changed have beside those of others.
uint32_t GetFurtherSamples(uint32_t Samples)
{
	const uint32_t Changed = static_cast<uint32_t>(CVarChangedSamples.GetOnRenderThread());
	return Changed > Samples && CVarChangedPaths.GetOnRenderThread() > 0.0f ? Changed - Samples : 0;
}

void DeclarePixels(FPassBuilder& Builder, const FGBuffer& GBuffer)
{
	for (const FGraphTexture Texture : {GBuffer.Depth, GBuffer.Normals, GBuffer.BaseColor, GBuffer.Material})
	{
		if (Texture.IsValid()) { Builder.Read(Texture, ERTAccess::ShaderRead); }
	}
}

/// False: an error, which the context has.
bool RequireShown(FFrameContext& Context, FPaths& Paths)
{
	FHistoryTexture Surface, Anchors;
	FRTStatus Status = Context.History->GetTexture("ReflectionSurface", {Context.Width, Context.Height, ERTFormat::RG32_FLOAT}, Surface);
	if (Status)
	{
		Status = Context.History->GetTexture("ReflectionAnchors", {Context.Width, Context.Height, ERTFormat::RG32_UINT}, Anchors);
	}
	if (!Status)
	{
		Context.Fail(Status);
		return false;
	}
	Paths.Shown.Current = Surface.Current;
	Paths.Shown.Previous = Surface.Previous;
	Paths.Shown.Anchors = Anchors.Current;
	Paths.LastAnchors = Anchors.Previous;
	return true;
}

void AddListPass(FFrameContext& Context, const FGBuffer& GBuffer, const FPaths& Paths)
{
	const FFrameContext* const Frame = &Context;
	Context.Graph.AddPass("ReflectionsList", [&](FPassBuilder& Builder) -> FPassExecute {
		DeclarePixels(Builder, GBuffer);
		MarkThreads(Builder, Paths.Threads.List);
		ReadRadianceCells(Builder, Paths.Cells);
		for (const FGraphTexture Texture :
		    {Paths.Radiance, Paths.Mirrored, Paths.Shown.Current, Paths.Shown.Anchors, Paths.Reach, Paths.Picture})
		{
			if (Texture.IsValid()) { Builder.Write(Texture, ERTAccess::StorageWrite); }
		}
		Context.Tokens.LeaveAlone(Builder);
		Builder.AllowAsync();
		return [=, MaxRoughness = Paths.Settings.MaxRoughness](FPassContext& Pass) {
			FReflectionListConstants C{};
			C.Pass = Frame->Pass;
			C.Pixels = GetReflectionPixels(Pass, GBuffer);
			C.Radiance = GetStorageIndex(Pass, Paths.Radiance);
			C.Mirrored = GetStorageIndex(Pass, Paths.Mirrored);
			C.Surface = GetStorageIndex(Pass, Paths.Shown.Current);
			C.Anchors = GetStorageIndex(Pass, Paths.Shown.Anchors);
			C.Picture = GetStorageIndex(Pass, Paths.Picture);
			C.Reach = GetStorageIndex(Pass, Paths.Reach);
			C.Fade = GetFade(MaxRoughness);
			C.List = GetAddress(Pass, Paths.Threads.List);
			C.RadianceCells = WriteRadianceGrid(Pass, Paths.Cells);
			C.FirstVoter = Paths.FirstVoter;
			Dispatch2D(Pass, Paths.List, C, Frame->Width, Frame->Height, TILE_SIZE);
		};
	});
}

/// bFurther: of ChangedThreads, for pixels that have their first paths.
void AddTracePass(FFrameContext& Context, const FGBuffer& GBuffer, const FPaths& Paths, bool bFurther)
{
	const FFrameContext* const Frame = &Context;
	const FGraphBuffer Threads = (bFurther ? Paths.ChangedThreads : Paths.Threads).List;
	const FLightCellsOfFrame& LightCells = RequireLightCells(Context, GBuffer);
	const uint32_t Bounces = Paths.Cells ? std::max(Paths.Settings.Bounces, BouncesWithoutCell) : Paths.Settings.Bounces;
	Context.Graph.AddPass(bFurther ? "ReflectionsFurther" : "Reflections", [&](FPassBuilder& Builder) -> FPassExecute {
		DeclarePixels(Builder, GBuffer);
		LaunchFromThreadList(Builder, Threads);
		ReadRadianceCells(Builder, Paths.Cells);
		ReadLightCells(Builder, LightCells, true);
		if (bFurther)
		{
			Builder.Read(Paths.Threads.List, ERTAccess::ShaderRead);
			Builder.Read(Paths.Radiance, ERTAccess::StorageRead);
		}
		Builder.Write(Paths.Radiance, ERTAccess::StorageWrite);
		if (!bFurther)
		{
			Builder.Write(Paths.Mirrored, ERTAccess::StorageWrite);
			Builder.Write(Paths.Hits, ERTAccess::StorageWrite);
		}
		Builder.AllowAsync();
		if (!bFurther) { Builder.RunBeside(PathsGroup); }
		const uint32_t Samples = bFurther ? GetFurtherSamples(Paths.Settings.Samples) : Paths.Settings.Samples;
		const float FurtherPaths = CVarChangedPaths.GetOnRenderThread();
		return [=, FullRoughness = GetFullRoughness(Paths.Settings.MaxRoughness)](FPassContext& Pass) {
			FReflectionPathConstants C{};
			C.Pass = Frame->Pass;
			C.Pixels = GetReflectionPixels(Pass, GBuffer);
			C.Radiance = GetStorageIndex(Pass, Paths.Radiance);
			C.Mirrored = bFurther ? NO_TEXTURE : GetStorageIndex(Pass, Paths.Mirrored);
			C.SamplesPerPixel = Samples;
			C.FirstSamples = bFurther ? Paths.Settings.Samples : 0;
			C.FurtherPaths = FurtherPaths;
			C.MaxBounces = Bounces + 1;
			C.LitRoughness = CVarLitRoughness.GetOnRenderThread();
			C.EmissionRoughness = FullRoughness;
			C.List = GetAddress(Pass, Threads);
			C.FirstList = GetAddress(Pass, Paths.Threads.List);
			C.Hits = bFurther ? 0 : GetAddress(Pass, Paths.Hits);
			C.RadianceCells = WriteRadianceGrid(Pass, Paths.Cells);
			C.FirstVoter = Paths.FirstVoter;
			C.Statistics = Frame->ReflectionStatistics;
			const double PathsOfPixel = bFurther ? std::min<double>(Samples, FurtherPaths) : Samples;
			Pass.CountRays(static_cast<uint64_t>(PathsOfPixel * Frame->Width * Frame->Height) * GetMaxPathRays(Frame->Facts, Bounces));
			TraceThreadList(Pass, *Frame, Paths.Dispatch, Threads, C, Frame->Width, Frame->Height);
		};
	});
}

void AddSurfacePass(FFrameContext& Context, const FGBuffer& GBuffer, const FPaths& Paths)
{
	const FFrameContext* const Frame = &Context;
	Context.Graph.AddPass("ReflectionsSurface", [&](FPassBuilder& Builder) -> FPassExecute {
		DeclarePixels(Builder, GBuffer);
		LaunchFromThreadList(Builder, Paths.Threads.List);
		Builder.Read(Paths.Hits, ERTAccess::ShaderRead);
		for (const FGraphTexture Texture : {GBuffer.Motion, Paths.Shown.Previous, Paths.LastAnchors})
		{
			if (Texture.IsValid()) { Builder.Read(Texture, ERTAccess::ShaderRead); }
		}
		for (const FGraphTexture Texture : {Paths.Shown.Current, Paths.Shown.Anchors, Paths.Reach, Paths.Picture})
		{
			if (Texture.IsValid()) { Builder.Write(Texture, ERTAccess::StorageWrite); }
		}
		Builder.AllowAsync();
		return [=](FPassContext& Pass) {
			FReflectionSurfaceConstants C{};
			C.Pass = Frame->Pass;
			C.Pixels = GetReflectionPixels(Pass, GBuffer);
			C.Motion = GetSampledIndex(Pass, GBuffer.Motion);
			C.bNamesObjects = GBuffer.bNamesObjects ? 1 : 0;
			C.PreviousSurface = GetSampledIndex(Pass, Paths.Shown.Previous);
			C.PreviousAnchors = GetSampledIndex(Pass, Paths.LastAnchors);
			C.List = GetAddress(Pass, Paths.Threads.List);
			C.Hits = GetAddress(Pass, Paths.Hits);
			C.OutSurface = GetStorageIndex(Pass, Paths.Shown.Current);
			C.OutAnchors = GetStorageIndex(Pass, Paths.Shown.Anchors);
			C.Picture = GetStorageIndex(Pass, Paths.Picture);
			C.OutReach = GetStorageIndex(Pass, Paths.Reach);
			DispatchThreadList(Pass, Paths.Surface, Paths.Threads.List, C);
		};
	});
}

/// Lists the pixels that are traced further. Changed: FDenoiseInputs::ChangedShare.
void AddChangedPass(FFrameContext& Context, const FGBuffer& GBuffer, const FPaths& Paths, FGraphTexture History, FGraphTexture Changed)
{
	const FFrameContext* const Frame = &Context;
	Context.Graph.AddPass("ReflectionsChanged", [&](FPassBuilder& Builder) -> FPassExecute {
		DeclarePixels(Builder, GBuffer);
		LaunchFromThreadList(Builder, Paths.Threads.List);
		MarkThreads(Builder, Paths.ChangedThreads.List);
		for (const FGraphTexture Texture : {Paths.Radiance, Paths.Shown.Anchors, History, Changed})
		{
			if (Texture.IsValid()) { Builder.Read(Texture, ERTAccess::ShaderRead); }
		}
		Builder.AllowAsync();
		return [=](FPassContext& Pass) {
			FReflectionChangedConstants C{};
			C.Pass = Frame->Pass;
			C.Pixels = GetReflectionPixels(Pass, GBuffer);
			C.Radiance = GetSampledIndex(Pass, Paths.Radiance);
			C.Anchors = GetSampledIndex(Pass, Paths.Shown.Anchors);
			C.History = GetSampledIndex(Pass, History);
			C.ChangedShare = GetSampledIndex(Pass, Changed);
			C.List = GetAddress(Pass, Paths.Threads.List);
			C.OutList = GetAddress(Pass, Paths.ChangedThreads.List);
			C.LeastFrames = CVarChangedFrames.GetOnRenderThread();
			DispatchThreadList(Pass, Paths.Changed, Paths.Threads.List, C);
		};
	});
}

FGraphTexture AddCombinePass(FFrameContext& Context, const FGBuffer& GBuffer, const FPaths& Paths, FGraphTexture Radiance)
{
	const FFrameContext* const Frame = &Context;
	const FSignalInfo& Info = GetSignalInfo(ESignal::Reflections);
	const FGraphTexture Output =
	    Context.Graph.CreateTexture({Context.Width, Context.Height, Info.Format, ERTTextureUsage::CopySource}, Info.Pass);
	Context.Graph.AddPass("ReflectionsCombine", [&](FPassBuilder& Builder) -> FPassExecute {
		DeclarePixels(Builder, GBuffer);
		for (const FGraphTexture Texture : {Radiance, Paths.Mirrored}) { Builder.Read(Texture, ERTAccess::ShaderRead); }
		Builder.Write(Output, ERTAccess::StorageWrite);
		Builder.AllowAsync();
		return [=, MaxRoughness = Paths.Settings.MaxRoughness](FPassContext& Pass) {
			FReflectionCombineConstants C{};
			C.Pass = Frame->Pass;
			C.Pixels = GetReflectionPixels(Pass, GBuffer);
			C.Radiance = GetSampledIndex(Pass, Radiance);
			C.Mirrored = GetSampledIndex(Pass, Paths.Mirrored);
			C.Output = GetStorageIndex(Pass, Output);
			C.Fade = GetFade(MaxRoughness);
			Dispatch2D(Pass, Paths.Combine, C, Frame->Width, Frame->Height, TILE_SIZE);
		};
	});
	return Output;
}

/// Adds what the filter asks for, and the filter. Returns the filtered radiance.
FGraphTexture AddFilter(FFrameContext& Context, const FGBuffer& GBuffer, FPaths& Paths)
{
	AddSurfacePass(Context, GBuffer, Paths);
	FDenoiseInputs Inputs;
	Inputs.Name = GetSignalInfo(ESignal::Reflections).Pass;
	Inputs.Signal = Paths.Radiance;
	Inputs.Surface = Paths.Shown;
	Inputs.Reach = Paths.Reach;
	Inputs.ChangedShare = AddMovedShare(Context, GBuffer, ELightFrom::SpecularLobe, Paths.Shown.Current);
	if (Inputs.ChangedShare.IsValid() && Paths.Changed)
	{
		if (!RequireDenoiseHistory(Context, Inputs.Name, Inputs.History)) { return Paths.Radiance; }
		Paths.ChangedThreads = AddThreadMarks(Context, Context.Width, Context.Height, "ReflectionsChangedThreads");
		AddChangedPass(Context, GBuffer, Paths, Inputs.History.Previous, Inputs.ChangedShare);
		AddThreadOrder(Context, Paths.ChangedThreads, Paths.Threads.List);
		AddTracePass(Context, GBuffer, Paths, true);
	}
	return AddDenoise(Context, GBuffer, Inputs, Denoise);
}
} // namespace

FReflectionPixels GetReflectionPixels(FPassContext& Pass, const FGBuffer& GBuffer)
{
	return {GetSampledIndex(Pass, GBuffer.Depth), GetSampledIndex(Pass, GBuffer.Normals), GetSampledIndex(Pass, GBuffer.BaseColor),
	    GetSampledIndex(Pass, GBuffer.Material)};
}

float GetFullRoughness(float MaxRoughness) { return MaxRoughness < 1.0f ? std::max(MaxRoughness - Fade, MirrorRoughness) : 1.0f; }

FPassRays ChooseReflectionPaths(const FReflectionPathSettings& Settings, const FPassQuery& Query)
{
	FPassRays Rays;
	Rays.Path = Settings.Path;
	if (Rays.Path == ERayPath::None) { return Rays; }
	Rays.Defines = MakePathDefines(Query.Facts);
	if (IsEmissionDirect(Query, GetSignalPass(ESignal::Reflections).EmissionIn)) { Rays.Defines.emplace_back("EMISSIVE_IS_DIRECT", "1"); }
	if (Query.Facts.Lights > 0) { Rays.Defines.emplace_back("LIGHT_CELLS_OF_VIEW", "1"); }
	if (ChooseRadianceCellPath(Query) != ERayPath::None) { AddRadianceCellDefines(Rays.Defines); }
	if (Rays.Path == ERayPath::Pipeline) { AddReorderDefine(Query.Capabilities, Rays.Defines); }
	AddRayConeDefine(Rays.Defines);
	if (ArePathEndsCounted()) { Rays.Defines.emplace_back("COUNTS_ENDS", "1"); }
	SetHitPrograms(EHitPrograms::OwnWhereSeen, Rays);
	Rays.bShadesHits = true;
	Rays.Shaders = "Reflections/Paths";
	ListLightCellShaders(Query.Facts, Rays.Compute);
	Rays.Compute.push_back(MakeSource("List"));
	Rays.Compute.push_back(MakeThreadOrderSource());
	Rays.Compute.push_back(MakeCombineSource(Query.Facts));
	return Rays;
}

bool AreReflectionPathsFiltered() { return Denoise.IsEnabled(); }

void ListReflectionPathFilters(const FReflectionPathSettings& Settings, std::vector<FShaderSource>& Out)
{
	if (!Denoise.IsEnabled()) { return; }
	Out.push_back(MakeSurfaceSource());
	if (GetFurtherSamples(Settings.Samples) > 0) { Out.push_back(MakeSource("Changed")); }
	ListMovedShareShaders(Out);
	ListDenoiseShaders(FilterForm, Denoise.Get(), Out);
}

FGraphTexture AddReflectionPaths(const FReflectionPathSettings& Settings, FFrameContext& Context, const FGBuffer& GBuffer)
{
	const FPassQuery Query{Context.Device.GetCapabilities(), Context.Facts, Context.Signals};
	const std::optional<FRayDispatch> Dispatch =
	    RequireRayDispatch(Context, ESignal::Reflections, ChooseSignalRays(Context, ESignal::Reflections));
	const bool bFiltered = Denoise.IsEnabled();
	FPaths Paths{Settings};
	Paths.List = RequireCompute(Context, MakeSource("List")); // all are asked for at once
	Paths.Combine = RequireCompute(Context, MakeCombineSource(Context.Facts));
	const bool bOrders = RequireCompute(Context, MakeThreadOrderSource()) != nullptr;
	Paths.Surface = bFiltered ? RequireCompute(Context, MakeSurfaceSource()) : nullptr;
	const bool bFurther = bFiltered && GetFurtherSamples(Settings.Samples) > 0;
	Paths.Changed = bFurther ? RequireCompute(Context, MakeSource("Changed")) : nullptr;
	if (bFiltered && !AreDenoiseShadersReady(Context, FilterForm, Denoise.Get())) { return {}; }
	if (!Dispatch || !Paths.List || !bOrders || !Paths.Combine || (bFiltered && !Paths.Surface) || (bFurther && !Paths.Changed))
	{
		return {};
	}
	Paths.Dispatch = *Dispatch;
	if (bFiltered && !RequireShown(Context, Paths)) { return {}; }
	const ERayPath Cached = ChooseRadianceCellPath(Query);
	if (Cached != ERayPath::None && Dispatch->Has("RADIANCE_CELLS"))
	{
		Paths.Cells = RequireRadianceCells(Context, Cached);
		Paths.FirstVoter = Paths.Cells ? Paths.Cells->ReflectionVoters : 0;
	}
	const uint64_t Pixels = uint64_t(Context.Width) * Context.Height;
	Paths.Radiance = Context.Graph.CreateTexture({Context.Width, Context.Height, ERTFormat::RGBA16_FLOAT}, "ReflectedRadiance");
	Paths.Mirrored = Context.Graph.CreateTexture({Context.Width, Context.Height, ERTFormat::RG32_UINT}, "ReflectedSurfaces");
	Paths.Threads = AddThreadMarks(Context, Context.Width, Context.Height, "ReflectionsThreads");
	Paths.Hits = Context.Graph.CreateBuffer({Pixels * sizeof(FReflectionHit)}, "ReflectionHits");
	if (bFiltered) { Paths.Reach = Context.Graph.CreateTexture({Context.Width, Context.Height, ERTFormat::R16_FLOAT}, "ReflectionReach"); }
	if (bFiltered && IsDebugPicture(ReflectionPictures[0]) && !Context.DebugPicture.IsValid())
	{
		Paths.Picture = Context.Graph.CreateTexture({Context.Width, Context.Height, ERTFormat::RGBA8_UNORM}, "ReflectionMotion");
		Context.DebugPicture = Paths.Picture;
	}
	AddListPass(Context, GBuffer, Paths);
	AddThreadOrder(Context, Paths.Threads);
	AddTracePass(Context, GBuffer, Paths, false);
	return AddCombinePass(Context, GBuffer, Paths, bFiltered ? AddFilter(Context, GBuffer, Paths) : Paths.Radiance);
}

} // namespace Lantern
