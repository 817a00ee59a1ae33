// The pass that packs the light mask, and what it keeps from frame to frame.
#include "LocalLights/LightMask.h"

#include "Denoise/Denoise.h"
#include "Denoise/SurfaceHistory.h"
#include "LightMaskTypes.h"
#include "LocalLights/LocalLights.h"
#include "LocalLights/SecondRays.h"
#include "SignalPasses.h"

namespace Lantern
{

namespace
{
TRTConsoleVariable<bool> CVarMaskOrder("r.RT.Debug.Lights.MaskOrder", true,
    "Planted fault. If off, lights of the light mask have slots by their order and not by their numbers, and take over histories of "
    "others.");

FShaderSource MakeMaskSource(const FSceneFacts& Facts)
{
	FShaderDefines Defines;
	AddRateDefine(GetLightRate(), Defines);
	if (IsLightMaskAccumulated(Facts))
	{
		Defines.emplace_back("MASK_HISTORY", "1");
		AddMaskOrderDefine(Defines);
	}
	return MakeComputeSource("LocalLights/Mask.comp", std::move(Defines));
}

struct FMaskPass
{
	FGraphTexture Mask;
	FHistoryTexture Lights, Means, Counts;
	FShadowChanges Changes;
	bool bAccumulated = false, bSurface = false, bReproject = false;
};

/// Finds what accumulation needs. False: an error, which the context has. Without surfaces the frame stands alone.
bool FindHistory(FFrameContext& Context, const FGBuffer& GBuffer, FMaskPass& InOut)
{
	InOut.bAccumulated = IsLightMaskAccumulated(Context.Facts);
	if (!InOut.bAccumulated) { return true; }
	const auto Find = [&](const char* Name, ERTFormat Format, FHistoryTexture& Out) {
		const FRTStatus Status = Context.History->GetTexture(Name, {Context.Width, Context.Height, Format}, Out);
		if (!Status) { Context.Fail(Status); }
		return static_cast<bool>(Status);
	};
	if (!Find("LightMaskMeans", ERTFormat::RG32_UINT, InOut.Means)) { return false; }
	if (!Find("LightMaskCounts", ERTFormat::R32_UINT, InOut.Counts)) { return false; }
	if (!FindLampChanges(Context, false, InOut.Changes)) { return false; }
	if (!RequireSurface(Context, {GBuffer.Depth, GBuffer.Normals, GBuffer.Motion})) { return true; }
	InOut.bSurface = true;
	InOut.bReproject = Context.Surface.Previous.IsValid() && InOut.Means.Previous.IsValid() && InOut.Counts.Previous.IsValid() &&
	                   InOut.Lights.Previous.IsValid();
	return true;
}

void Declare(
    FPassBuilder& Builder, const FGBuffer& GBuffer, const FShadowRays& Rays, const FSurfaceTextures& Surface, const FMaskPass& Mask)
{
	for (const FGraphTexture Texture : {GBuffer.Depth, GBuffer.Normals}) { Builder.Read(Texture, ERTAccess::ShaderRead); }
	for (const FGraphBuffer Buffer : {Rays.Queue.Answers, Rays.Traced.TileLights}) { Builder.Read(Buffer, ERTAccess::ShaderRead); }
	for (const FGraphTexture Texture : {Mask.Mask, Mask.Lights.Current}) { Builder.Write(Texture, ERTAccess::StorageWrite); }
	Builder.Keep(Mask.Lights.Current);
	Builder.AllowAsync();
	if (!Mask.bAccumulated) { return; }
	if (Mask.bSurface) { Builder.Read(Surface.Current, ERTAccess::ShaderRead); }
	for (const FGraphTexture Texture : {Mask.Means.Current, Mask.Counts.Current})
	{
		Builder.Write(Texture, ERTAccess::StorageWrite);
		Builder.Keep(Texture);
	}
	if (!Mask.bReproject) { return; }
	for (const FGraphTexture Texture :
	    {Surface.Reprojection, Surface.Motion, Mask.Lights.Previous, Mask.Means.Previous, Mask.Counts.Previous})
	{
		Builder.Read(Texture, ERTAccess::ShaderRead);
	}
}

void SetHistory(FPassContext& Pass, const FFrameContext& Frame, const FMaskPass& Mask, FLightMaskConstants& C)
{
	const auto Previous = [&](FGraphTexture Texture) { return Mask.bReproject ? GetSampledIndex(Pass, Texture) : NO_TEXTURE; };
	C.Casters = Mask.Changes.Casters;
	C.CasterCount = Mask.Changes.CasterCount;
	C.bChangesKnown = Mask.Changes.bKnown ? 1u : 0u;
	C.Surface = Mask.bSurface ? GetSampledIndex(Pass, Frame.Surface.Current) : NO_TEXTURE;
	C.Motion = Previous(Frame.Surface.Motion);
	C.Reprojection = Previous(Frame.Surface.Reprojection);
	C.PreviousLights = Previous(Mask.Lights.Previous);
	C.PreviousMeans = Previous(Mask.Means.Previous);
	C.PreviousCounts = Previous(Mask.Counts.Previous);
	C.OutMeans = GetStorageIndex(Pass, Mask.Means.Current);
	C.OutCounts = GetStorageIndex(Pass, Mask.Counts.Current);
	C.MinAlpha = GetMinAlpha(GetLocalHistorySeconds(), Frame.View.DeltaSeconds);
}

FLightMask AddMask(FFrameContext& Context, const FGBuffer& GBuffer)
{
	if (!Context.Facts.bLightMask || ChooseSignalRays(Context, GetLightMaskRow()).Path == ERayPath::None) { return {}; }
	const FShadowRays* const Rays = RequireShadowRays(Context, GBuffer);
	if (!Rays || !Rays->Traced.TileLights.IsValid()) { return {}; }
	IRTPipeline* const Pipeline = RequireCompute(Context, MakeMaskSource(Context.Facts));
	FMaskPass Mask;
	Mask.Lights = Rays->Traced.MaskLights;
	if (!Pipeline || !FindHistory(Context, GBuffer, Mask)) { return {}; }
	Mask.Mask = Context.Graph.CreateTexture({Context.Width, Context.Height, ERTFormat::R32_UINT, ERTTextureUsage::CopySource}, "LightMask");
	const FFrameContext* const Frame = &Context;
	const FGraphBuffer Answers = Rays->Queue.Answers, TileLights = Rays->Traced.TileLights;
	Context.Graph.AddPass("ShadowLightsMask", [&](FPassBuilder& Builder) -> FPassExecute {
		Declare(Builder, GBuffer, *Rays, Context.Surface, Mask);
		return [=](FPassContext& Pass) {
			FLightMaskConstants C{};
			C.Pass = Frame->Pass;
			C.TileLights = GetAddress(Pass, TileLights);
			C.Answers = GetAddress(Pass, Answers);
			C.Depth = GetSampledIndex(Pass, GBuffer.Depth);
			C.Normals = GetSampledIndex(Pass, GBuffer.Normals);
			C.OutMask = GetStorageIndex(Pass, Mask.Mask);
			C.OutLights = GetStorageIndex(Pass, Mask.Lights.Current);
			if (Mask.bAccumulated) { SetHistory(Pass, *Frame, Mask, C); }
			Dispatch2D(Pass, Pipeline, C, Frame->Width, Frame->Height, TILE_SIZE);
		};
	});
	return {Mask.Mask, Mask.Lights.Current};
}
} // namespace

bool IsLightMaskAccumulated(const FSceneFacts& Facts) { return Facts.bLightMask && Facts.bAreaLights && GetLocalHistorySeconds() > 0.0f; }

void ListLightMaskShaders(const FSceneFacts& Facts, std::vector<FShaderSource>& Out)
{
	if (!Facts.bLightMask) { return; }
	Out.push_back(MakeMaskSource(Facts));
	if (IsLightMaskAccumulated(Facts)) { ListSurfaceShaders(Out); }
}

bool IsLightMaskReady(FFrameContext& Context)
{
	return !Context.Facts.bLightMask || RequireCompute(Context, MakeMaskSource(Context.Facts)) != nullptr;
}

void AddMaskOrderDefine(FShaderDefines& InOut)
{
	if (!CVarMaskOrder.GetOnRenderThread()) { InOut.emplace_back("MASK_ORDER", "1"); }
}

bool FindMaskLights(FFrameContext& Context, FHistoryTexture& Out)
{
	// A tile has its lights side by side, as many as it has columns.
	static_assert(TILE_LIGHTS == TILE_SIZE);
	const uint32_t Columns = DivideUp(Context.Width, TILE_SIZE), Rows = DivideUp(Context.Height, TILE_SIZE);
	const FGraphTextureDesc Desc{Columns * TILE_LIGHTS, Rows, ERTFormat::R32_UINT, ERTTextureUsage::CopySource}; // engines copy it
	const FRTStatus Status = Context.History->GetTexture("LightMaskLights", Desc, Out);
	if (!Status) { Context.Fail(Status); }
	return static_cast<bool>(Status);
}

FLightMask AddLightMaskPass(FFrameContext& Context, const FGBuffer& GBuffer)
{
	if (!Context.LightMask) { Context.LightMask = AddMask(Context, GBuffer); }
	return *Context.LightMask;
}

} // namespace Lantern
