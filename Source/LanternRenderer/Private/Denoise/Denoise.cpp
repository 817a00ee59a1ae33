// Passes of the filter: temporal accumulation, then the wavelet.
#include "Denoise/Denoise.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <initializer_list>
#include <string>

#include "DebugView/DebugView.h"
#include "Denoise/SurfaceHistory.h"
#include "DenoiseTypes.h"
#include "LanternCore/Config/ConsoleVariables.h"
#include "PassTools.h"

namespace Lantern
{

namespace
{
// What `lantern stability` switches off to see that its cases notice.
TRTConsoleVariable<bool> CVarValidate("r.RT.Debug.Denoise.Validate", true,
    "Planted fault. Off: the filter takes what was in a pixel's place before for its surface, whatever it was.");
TRTConsoleVariable<bool> CVarAdapt("r.RT.Debug.Denoise.Adapt", true,
    "Planted fault. If off, the filter looks neither for changes nor for noise, and clamps nothing, whatever its client asks for.");
TRTConsoleVariable<bool> CVarGuard("r.RT.Debug.Denoise.Guard", true, "Planted fault. Off: the filter takes what is not a number for one.");
constexpr uint32_t MaxPasses = 5;

/// The signals that passes of the wavelet filter at once: one or two.
using FSignals = std::array<FGraphTexture, 2>; // the second may be invalid

/// One signal in one frame.
struct FDenoiser
{
	FFrameContext& Context;
	const FDenoiseInputs& Inputs;
	const FDenoiseSettings& Settings;
	std::string Name;
	bool bColor;           ///< three channels
	ERTFormat ImageFormat; ///< of a mean beside its variance
	IRTPipeline* Temporal = nullptr;
	FHistoryTexture History, Moments; ///< Moments: of colours only
	FGraphTexture Picture;            ///< of the history, for r.RT.Debug.View; else invalid

	bool Prepare(const FGBuffer& GBuffer);
	FGraphTexture CreateImage(bool bLast, uint32_t Index) const;
	FGraphTexture AddTemporalPass(FGraphTexture Output);
	const FSurfaceTextures& GetSurface() const { return Inputs.Surface.Current.IsValid() ? Inputs.Surface : Context.Surface; }
};

FShaderDefines MakeDefines(const FDenoiseForm& Form)
{
	FShaderDefines Defines = {{"CHANNELS", Form.bColor ? "3" : "1"}};
	if (Form.bExtent) { Defines.emplace_back("WITH_EXTENT", "1"); }
	return Defines;
}

FShaderSource MakeTemporalSource(const FDenoiseForm& Form)
{
	FShaderDefines Defines = MakeDefines(Form);
	if (Form.bColor && !Form.bKnownNoise && Form.Rate == EPixelRate::Quarter) { AddRateDefine(Form.Rate, Defines); }
	for (const auto& Define : MakeValidationDefines()) { Defines.push_back(Define); }
	if (Form.bSparse) { Defines.emplace_back("SPARSE", "1"); }
	if (!CVarAdapt.GetOnRenderThread()) { Defines.emplace_back("NO_ADAPTION", "1"); }
	if (!CVarGuard.GetOnRenderThread()) { Defines.emplace_back("NO_GUARD", "1"); }
	return MakeComputeSource(Form.bKnownNoise ? "Denoise/TemporalKnown.comp" : "Denoise/Temporal.comp", std::move(Defines));
}

FShaderSource MakeFilterSource(const FDenoiseForm& Form)
{
	FShaderDefines Defines = MakeDefines(Form);
	if (Form.bPair) { Defines.emplace_back("PAIR", "1"); }
	if (Form.bReach) { Defines.emplace_back("WITH_REACH", "1"); }
	return MakeComputeSource("Denoise/Filter.comp", std::move(Defines));
}

bool Require(FFrameContext& Context, const std::string& Name, ERTFormat Format, FHistoryTexture& Out)
{
	const FRTStatus Status = Context.History->GetTexture(Name.c_str(), {Context.Width, Context.Height, Format}, Out);
	if (!Status) { Context.Fail(Status); }
	return bool(Status);
}

FGraphTexture FDenoiser::CreateImage(bool bLast, uint32_t Index) const
{
	if (bLast) { return Context.Graph.CreateTexture(Context.Graph.GetDesc(Inputs.Signal), (Name + " denoised").c_str()); }
	return Context.Graph.CreateTexture({Context.Width, Context.Height, ImageFormat}, (Name + " " + std::to_string(Index)).c_str());
}

bool HasOtherSize(const FFrameContext& Context, FGraphTexture Texture)
{
	const FGraphTextureDesc& Desc = Context.Graph.GetDesc(Texture);
	return Desc.Width != Context.Width || Desc.Height != Context.Height;
}

FGraphTexture FDenoiser::AddTemporalPass(FGraphTexture Output)
{
	const FSurfaceTextures Surface = GetSurface();
	const bool bReproject = History.Previous.IsValid() && Surface.Previous.IsValid() && (!bColor || Moments.Previous.IsValid());
	const bool bReadsSurface = bReproject && (!bColor || HasOtherSize(Context, History.Previous));
	Context.Graph.AddPass((Name + "Temporal").c_str(), [&](FPassBuilder& Builder) -> FPassExecute {
		for (const FGraphTexture Texture : {Inputs.Signal, Surface.Current}) { Builder.Read(Texture, ERTAccess::ShaderRead); }
		for (const FGraphTexture Texture : {Inputs.Extent, Inputs.Change, Inputs.ChangedShare})
		{
			if (Texture.IsValid()) { Builder.Read(Texture, ERTAccess::ShaderRead); }
		}
		if (bReproject)
		{
			if (Surface.Motion.IsValid()) { Builder.Read(Surface.Motion, ERTAccess::ShaderRead); }
			Builder.Read(History.Previous, ERTAccess::ShaderRead);
			if (bReadsSurface) { Builder.Read(Surface.Previous, ERTAccess::ShaderRead); }
			if (bColor) { Builder.Read(Moments.Previous, ERTAccess::ShaderRead); }
			Builder.Read(bColor ? Surface.Anchors : Surface.Reprojection, ERTAccess::ShaderRead);
		}
		Builder.Write(History.Current, ERTAccess::StorageWrite);
		if (bColor) { Builder.Write(Moments.Current, ERTAccess::StorageWrite); }
		Builder.Write(Output, ERTAccess::StorageWrite);
		if (Picture.IsValid()) { Builder.Write(Picture, ERTAccess::StorageWrite); }
		Builder.AllowAsync();
		FTemporalConstants C{};
		C.Pass = Context.Pass;
		C.MinAlpha = GetMinAlpha(Settings.HistorySeconds, Context.View.DeltaSeconds);
		C.ClampSigma = CVarAdapt.GetOnRenderThread() ? Settings.ClampSigma : 0.0f;
		C.ChangeSigma = CVarAdapt.GetOnRenderThread() ? Settings.ChangeSigma : 0.0f;
		C.Resampling = Settings.Resampling;
		C.RaysPerPixel = static_cast<float>(std::max(Inputs.RaysPerPixel, 1u));
		C.bChangesKnown = Inputs.Changes.bKnown ? 1u : 0u;
		C.Casters = Inputs.Changes.Casters;
		C.CasterCount = Inputs.Changes.CasterCount;
		C.CasterSpread = Inputs.Changes.Spread;
		C.bViewChange = IsDebugPicture(Name + ChangePicture) ? 1u : 0u;
		const uint32_t GroupSize = bColor ? DENOISE_GROUP_SIZE : DENOISE_VISIBILITY_GROUP_SIZE;
		return [=, Signal = Inputs.Signal, Extent = Inputs.Extent, Change = Inputs.Change, Share = Inputs.ChangedShare, Pipeline = Temporal,
		           Kept = History, KeptMoments = Moments, bColor = bColor, Picture = Picture, Width = Context.Width,
		           Height = Context.Height](FPassContext& Pass) mutable {
			C.Signal = GetSampledIndex(Pass, Signal);
			C.Extent = GetSampledIndex(Pass, Extent);
			C.Change = GetSampledIndex(Pass, Change);
			C.ChangedShare = GetSampledIndex(Pass, Share);
			C.Surface = GetSampledIndex(Pass, Surface.Current);
			C.Motion = GetSampledIndex(Pass, bReproject ? Surface.Motion : FGraphTexture{});
			C.PreviousSurface = GetSampledIndex(Pass, bReadsSurface ? Surface.Previous : FGraphTexture{});
			C.Reprojection = GetSampledIndex(Pass, bReproject && !bColor ? Surface.Reprojection : FGraphTexture{});
			C.Anchors = GetSampledIndex(Pass, bReproject && bColor ? Surface.Anchors : FGraphTexture{});
			C.History = GetSampledIndex(Pass, bReproject ? Kept.Previous : FGraphTexture{});
			C.Moments = GetSampledIndex(Pass, bReproject ? KeptMoments.Previous : FGraphTexture{});
			C.OutHistory = GetStorageIndex(Pass, Kept.Current);
			C.OutMoments = GetStorageIndex(Pass, KeptMoments.Current);
			C.Output = GetStorageIndex(Pass, Output);
			C.OutView = GetStorageIndex(Pass, Picture);
			Dispatch2D(Pass, Pipeline, C, Width, Height, GroupSize);
		};
	});
	return Output;
}

bool FDenoiser::Prepare(const FGBuffer& GBuffer)
{
	assert(!Inputs.Surface.Current.IsValid() || bColor);
	if (!Inputs.Surface.Current.IsValid() && !RequireSurface(Context, {GBuffer.Depth, GBuffer.Normals, GBuffer.Motion})) { return false; }
	History = Inputs.History;
	if (!History.Current.IsValid() && !RequireDenoiseHistory(Context, Inputs.Name, History)) { return false; }
	if (bColor && !Require(Context, Name + "Moments", ERTFormat::RG16_FLOAT, Moments)) { return false; }
	if (IsDebugPicture(Name + ConfidencePicture) || IsDebugPicture(Name + ChangePicture))
	{
		Picture = Context.Graph.CreateTexture({Context.Width, Context.Height, ERTFormat::RGBA8_UNORM}, "HistoryView");
		Context.DebugPicture = Picture;
	}
	return true;
}

/// Name: of the pass. Surface: what pixels show. Reach: FDenoiseInputs::Reach.
void AddFilterPass(FFrameContext& Context, const std::string& Name, FGraphTexture Surface, FGraphTexture Reach, const FSignals& Inputs,
    const FSignals& Outputs, const FDenoiseSettings& Settings, IRTPipeline* Pipeline, uint32_t Index)
{
	Context.Graph.AddPass(Name.c_str(), [&](FPassBuilder& Builder) -> FPassExecute {
		Builder.Read(Surface, ERTAccess::ShaderRead);
		for (const FGraphTexture Input : {Inputs[0], Inputs[1], Reach})
		{
			if (Input.IsValid()) { Builder.Read(Input, ERTAccess::ShaderRead); }
		}
		for (const FGraphTexture Output : Outputs)
		{
			if (Output.IsValid()) { Builder.Write(Output, ERTAccess::StorageWrite); }
		}
		Builder.AllowAsync();
		FFilterConstants C{};
		C.Pass = Context.Pass;
		C.Step = Settings.FirstStep << Index;
		C.SigmaValue = Settings.SigmaValue;
		C.SigmaNormal = Settings.SigmaNormal;
		C.SigmaDepth = Settings.SigmaDepth;
		C.ReachExtent = Settings.ReachExtent;
		return [=, Width = Context.Width, Height = Context.Height](FPassContext& Pass) mutable {
			C.Input = GetSampledIndex(Pass, Inputs[0]);
			C.SecondInput = GetSampledIndex(Pass, Inputs[1]);
			C.Surface = GetSampledIndex(Pass, Surface);
			C.Reach = GetSampledIndex(Pass, Reach);
			C.Output = GetStorageIndex(Pass, Outputs[0]);
			C.SecondOutput = GetStorageIndex(Pass, Outputs[1]);
			Dispatch2D(Pass, Pipeline, C, Width, Height, DENOISE_GROUP_SIZE);
		};
	});
}

/// Filters one signal, or two colours.
FSignals AddDenoise(
    FFrameContext& Context, const FGBuffer& GBuffer, std::initializer_list<const FDenoiseInputs*> All, const FDenoiseSettings& Settings)
{
	FSignals Signals, Results;
	std::vector<FDenoiser> Denoisers;
	const uint32_t Passes = std::min(Settings.Passes, MaxPasses);
	IRTPipeline* Filter = nullptr;
	bool bReady = true; // all are asked for at once
	for (const FDenoiseInputs* const Inputs : All)
	{
		const ERTFormat Format = Context.Graph.GetDesc(Inputs->Signal).Format;
		assert(Format == ERTFormat::R16_FLOAT || Format == ERTFormat::RGBA16_FLOAT);
		const FDenoiseForm Form{Format == ERTFormat::RGBA16_FLOAT, Inputs->Extent.IsValid(), All.size() > 1, Inputs->Rate,
		    Inputs->bKnownNoise, Inputs->Surface.Current.IsValid(), Inputs->Reach.IsValid()};
		assert(!Form.bExtent || !Form.bColor);
		assert(!Form.bKnownNoise || Form.bColor);
		assert(!Form.bPair || Form.bColor);
		Signals[Denoisers.size()] = Inputs->Signal;
		FDenoiser& Denoiser = Denoisers.emplace_back(FDenoiser{Context, *Inputs, Settings, Inputs->Name, Form.bColor,
		    Form.bColor || Form.bExtent ? ERTFormat::RGBA16_FLOAT : ERTFormat::RG16_FLOAT});
		Denoiser.Temporal = RequireCompute(Context, MakeTemporalSource(Form));
		bReady &= Denoiser.Temporal != nullptr;
		if (Passes == 0) { continue; }
		Filter = RequireCompute(Context, MakeFilterSource(Form));
		bReady &= Filter != nullptr;
	}
	if (!bReady) { return Signals; }
	for (FDenoiser& Denoiser : Denoisers) { bReady = bReady && Denoiser.Prepare(GBuffer); }
	if (!bReady) { return Signals; }
	for (size_t I = 0; I < Denoisers.size(); ++I) { Results[I] = Denoisers[I].AddTemporalPass(Denoisers[I].CreateImage(Passes == 0, 0)); }
	for (uint32_t Pass = 0; Pass < Passes; ++Pass)
	{
		const FSignals Inputs = Results;
		for (size_t I = 0; I < Denoisers.size(); ++I) { Results[I] = Denoisers[I].CreateImage(Pass + 1 == Passes, Pass + 1); }
		AddFilterPass(Context, Denoisers[0].Name + "Filter" + std::to_string(Pass), Denoisers[0].GetSurface().Current,
		    Denoisers[0].Inputs.Reach, Inputs, Results, Settings, Filter, Pass);
	}
	return Results;
}
} // namespace

float GetMinAlpha(float HistorySeconds, float DeltaSeconds)
{
	// 1 − e^−x of frames so short that their share would be lost in half precision.
	return HistorySeconds > 0.0f ? std::max(-std::expm1(-DeltaSeconds / HistorySeconds), 1.0f / 1024.0f) : 1.0f;
}

FShaderDefines MakeValidationDefines()
{
	return CVarValidate.GetOnRenderThread() ? FShaderDefines{} : FShaderDefines{{"NO_VALIDATION", "1"}};
}

bool RequireDenoiseHistory(FFrameContext& Context, const char* Name, FHistoryTexture& Out)
{
	return Require(Context, std::string(Name) + "History", ERTFormat::RGBA16_FLOAT, Out);
}

void ListDenoiseShaders(const FDenoiseForm& Form, const FDenoiseSettings& Settings, std::vector<FShaderSource>& Out)
{
	Out.push_back(MakeTemporalSource(Form));
	if (Settings.Passes > 0) { Out.push_back(MakeFilterSource(Form)); }
	ListSurfaceShaders(Out);
}

bool AreDenoiseShadersReady(const FFrameContext& Context, const FDenoiseForm& Form, const FDenoiseSettings& Settings)
{
	const bool bTemporal = RequireCompute(Context, MakeTemporalSource(Form)) != nullptr; // both are asked for at once
	return (Settings.Passes == 0 || RequireCompute(Context, MakeFilterSource(Form))) && bTemporal;
}

FGraphTexture AddDenoise(FFrameContext& Context, const FGBuffer& GBuffer, const FDenoiseInputs& Inputs, const FDenoiseSettings& Settings)
{
	return AddDenoise(Context, GBuffer, {&Inputs}, Settings)[0];
}

FLobes AddDenoisePair(FFrameContext& Context, const FGBuffer& GBuffer, const FDenoiseInputs& Diffuse, const FDenoiseInputs& Specular,
    const FDenoiseSettings& Settings)
{
	const FSignals Results = AddDenoise(Context, GBuffer, {&Diffuse, &Specular}, Settings);
	return {Results[0], Results[1]};
}

} // namespace Lantern
