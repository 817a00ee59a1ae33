// One dispatch of the reference path tracer: adds samples to a band of rows.
#include "Reference/Reference.h"

#include "Lights/PixelChannels.h"
#include "LocalLights/Emitters.h"
#include "ReferenceTypes.h"
#include "SignalPasses.h"
#include "Toon/Toon.h"

namespace Lantern
{

namespace
{
bool IsStyled(ESignal Signal) { return Signal != ESignal::Frame && GetSignalPass(Signal).bStyled; }
} // namespace

FPassRays ChooseReferenceRays(const FRTCapabilities& Capabilities, const FSceneFacts& Facts, ESignal Signal, bool bFromGBuffer)
{
	FPassRays Rays;
	Rays.Path = ERayPath::Pipeline;
	Rays.Defines = MakePathDefines(Facts);
	if (Signal != ESignal::Frame) { Rays.Defines.emplace_back("SIGNAL", "1"); }
	if (Signal != ESignal::Frame && IsEmissionDirectInReference(Facts)) { Rays.Defines.emplace_back(EmissiveDirectDefine, "1"); }
	if (bFromGBuffer) { Rays.Defines.emplace_back("FROM_GBUFFER", "1"); }
	AddReorderDefine(Capabilities, Rays.Defines);
	Rays.bShadesHits = true;
	return Rays;
}

std::string GetReferencePath(ESignal Signal)
{
	return Signal == ESignal::Frame ? "Reference/PathTrace.rgen" : MakeShaderPath(Signal, "Reference.rgen");
}

std::vector<FShaderSource> ListReferenceComputeShaders(const FSceneFacts& Facts, ESignal Signal)
{
	std::vector<FShaderSource> Out;
	if (Facts.bLightChannels) { Out.push_back(MakePixelChannelsSource()); }
	if (IsStyled(Signal)) { ListToonShaders(Facts, true, Out); }
	if (Signal != ESignal::Frame && GetSignalPass(Signal).ListSurfaceShaders) { GetSignalPass(Signal).ListSurfaceShaders(Facts, Out); }
	return Out;
}

bool IsReferenceGraded(const FSceneFacts& Facts, ESignal Signal)
{
	return Signal != ESignal::Frame && GetSignalPass(Signal).bToonGraded && Facts.bToon && AreToonStylesOn();
}

void AddReferenceGrade(FFrameContext& Context, const FReferencePassInputs& Inputs)
{
	if (IsReferenceGraded(Context.Facts, Inputs.Signal)) { AddToonReferenceGrade(Context, Inputs.GBuffer, Inputs.Sum); }
}

void AddReferencePass(FFrameContext& Context, const FReferencePassInputs& Inputs)
{
	if (Context.GetRayGen(ESignal::Frame) == NoRayGen)
	{
		Context.Fail(FRTStatus::Error(ERTResult::Unsupported,
		    "the reference path tracer needs ray-tracing pipelines, which %s does not have", Context.Device.GetCapabilities().DeviceName));
		return;
	}
	Context.RequireRays();
	const FGraphTexture Channels = RequirePixelChannels(Context, Inputs.GBuffer);
	const bool bStyled = Inputs.GBuffer.Depth.IsValid() && IsStyled(Inputs.Signal);
	const auto AddSurface =
	    Inputs.GBuffer.Depth.IsValid() && Inputs.Signal != ESignal::Frame ? GetSignalPass(Inputs.Signal).AddSurface : nullptr;
	const FGBuffer G = bStyled      ? RequireToonSurface(Context, Inputs.GBuffer)
	                   : AddSurface ? AddSurface(Context, Inputs.GBuffer)
	                                : Inputs.GBuffer;
	const FGraphTexture Toon = bStyled ? Context.Toon.Pixels : FGraphTexture();
	const FFrameContext* const Frame = &Context;
	Context.Graph.AddPass("PathTrace", [&](FPassBuilder& Builder) -> FPassExecute {
		Builder.Write(Inputs.Sum, ERTAccess::StorageWrite | ERTAccess::ShaderRead);
		for (const FGraphTexture Texture : {G.Depth, G.Normals, G.BaseColor, G.Material, G.Emissive, G.BackAlbedo, Channels, Toon})
		{
			if (Texture.IsValid()) { Builder.Read(Texture, ERTAccess::ShaderRead); }
		}
		return [=](FPassContext& Pass) {
			FReferenceConstants C{};
			C.Pass = Frame->Pass;
			C.Sum = Pass.GetBuffer(Inputs.Sum)->GetDeviceAddress();
			C.FirstSample = Inputs.FirstSample;
			C.SampleCount = Inputs.SampleCount;
			C.MaxBounces = Inputs.MaxBounces;
			C.FirstRow = Inputs.FirstRow;
			C.bPixelCenters = Inputs.bPixelCenters ? 1u : 0u;
			ForEachSignalPass([&](const FSignalPass& Signal) {
				if (Signal.SetReferenceConstants) { Signal.SetReferenceConstants(C); }
			});
			C.Depth = GetSampledIndex(Pass, G.Depth);
			C.Normals = GetSampledIndex(Pass, G.Normals);
			C.BaseColor = GetSampledIndex(Pass, G.BaseColor);
			C.Material = GetSampledIndex(Pass, G.Material);
			C.Emissive = GetSampledIndex(Pass, G.Emissive);
			C.BackAlbedo = GetSampledIndex(Pass, G.BackAlbedo);
			C.Channels = GetSampledIndex(Pass, Channels);
			C.ToonPixels = GetSampledIndex(Pass, Toon);
			Pass.CountRays(uint64_t(Frame->Width) * Inputs.RowCount * Inputs.SampleCount);
			TraceFrameRays(Pass, *Frame, Frame->GetRayGen(ESignal::Frame), C, Frame->Width, Inputs.RowCount);
		};
	});
}

} // namespace Lantern
