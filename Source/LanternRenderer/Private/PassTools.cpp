// What passes share.
#include "PassTools.h"

#include "Feedback/PathRayCounter.h"
#include "LanternCore/Text/Log.h"

namespace Lantern
{

namespace
{
TRTConsoleVariable<bool> CVarEnable("r.RT.Enable", true, "All of the plugin's ray-traced features.");
TRTConsoleVariable<bool> CVarLightArea(
    "r.RT.Debug.Lights.Area", true, "Planted fault. Off: lights with an extent have half of it in their density.");
TRTConsoleVariable<bool> CVarLightProfile(
    "r.RT.Debug.Lights.Profile", true, "Planted fault. Off: lights with a profile shine alike in all directions.");
TRTConsoleVariable<bool> CVarLightChannels("r.RT.Debug.Lights.Channels", true, "Planted fault. Off: lights light objects of all channels.");
TRTConsoleVariable<bool> CVarSheet("r.RT.Debug.Transmission.Sheet", true,
    "Planted fault. Off: a thin sheet reflects as one interface, and not as two with all that goes to and fro between them.");
TRTConsoleVariable<bool> CVarLightEmission("r.RT.Debug.Lights.LightEmission", true,
    "Planted fault. Off: materials light with what cameras see of them, whatever their second emission is.");
TRTConsoleVariable<bool> CVarBackLobe(
    "r.RT.Debug.DiffuseTransmission", true, "Planted fault. Off: light that leaves surfaces on their other side is lost.");
TRTConsoleVariable<bool> CVarScatteredDepth(
    "r.RT.Debug.Transmission.Scattering", true, "Planted fault. Off: water takes nothing from light on its way to where it is scattered.");
} // namespace

namespace
{
constexpr std::pair<EPixelRate, const char*> RateDefines[] = {{EPixelRate::Checkerboard, "CHECKERBOARD"}, {EPixelRate::Quarter, "QUARTER"}};
} // namespace

uint32_t GetTurnFrames(EPixelRate Rate) { return Rate == EPixelRate::Full ? 1 : Rate == EPixelRate::Checkerboard ? 2 : 4; }

void AddRateDefine(EPixelRate Rate, FShaderDefines& InOut)
{
	for (const auto& [Of, Name] : RateDefines)
	{
		if (Of == Rate) { InOut.emplace_back(Name, "1"); }
	}
}

EPixelRate FindRate(const FShaderDefines& Defines)
{
	for (const auto& [Rate, Name] : RateDefines)
	{
		if (std::any_of(Defines.begin(), Defines.end(), [Of = Name](const auto& Define) { return Define.first == Of; })) { return Rate; }
	}
	return EPixelRate::Full;
}

bool IsRayTracingEnabled() { return CVarEnable.GetOnRenderThread(); }

FShaderSource MakeComputeSource(std::string Path, FShaderDefines Defines)
{
	FShaderSource Source;
	Source.Path = std::move(Path);
	Source.Stage = ERTShaderStage::Compute;
	Source.Defines = std::move(Defines);
	return Source;
}

IRTPipeline* RequireCompute(const FFrameContext& Context, const FShaderSource& Source)
{
	IRTPipeline* Pipeline = nullptr;
	const bool bWait = Context.bWaitForPipelines;
	const FRTStatus Status = bWait ? Context.Pipelines.Get(Source, Pipeline) : Context.Pipelines.Find(Source, Pipeline);
	if (Status) { return Pipeline; }
	if (bWait || Status.Code == ERTResult::DeviceLost) { Context.Fail(Status); }
	else
	{
		// Other passes go on, as they do without a ray-tracing shader that does not compile.
		const auto Level = Status.Code == ERTResult::CompileFailed ? ERTLogLevel::Error : ERTLogLevel::Warning;
		LogOnce(Level, Source.Path + " is left out of frames:\n" + Status.Message);
	}
	return nullptr;
}

std::string MakeShaderPath(ESignal Signal, const char* Suffix)
{
	const std::string Pass = GetSignalInfo(Signal).Pass;
	return Pass + "/" + Pass + Suffix;
}

uint32_t GetSampledIndex(FPassContext& Pass, FGraphTexture Texture)
{
	return Texture.IsValid() ? Pass.GetTexture(Texture)->GetSampledIndex() : NO_TEXTURE;
}

uint32_t GetStorageIndex(FPassContext& Pass, FGraphTexture Texture)
{
	IRTTexture* const Found = Texture.IsValid() ? Pass.GetTexture(Texture) : nullptr;
	return Found ? Found->GetStorageIndex() : NO_TEXTURE;
}

FAddress GetAddress(FPassContext& Pass, FGraphBuffer Buffer) { return Buffer.IsValid() ? Pass.GetBuffer(Buffer)->GetDeviceAddress() : 0; }

void AddLightEmissionDefine(const FSceneFacts& Facts, FShaderDefines& InOut)
{
	if (Facts.bLightEmission && CVarLightEmission.GetOnRenderThread()) { InOut.emplace_back("HAS_LIGHT_EMISSION", "1"); }
}

void AddDiffuseTransmissionDefine(const FSceneFacts& Facts, FShaderDefines& InOut)
{
	if (!Facts.bDiffuseTransmission && !Facts.bBackPixels) { return; }
	if (Facts.bDiffuseTransmission) { InOut.emplace_back("HAS_DIFFUSE_TRANSMISSION", "1"); }
	if (Facts.bBackPixels) { InOut.emplace_back(BackPixelsDefine, "1"); }
	if (!CVarBackLobe.GetOnRenderThread()) { InOut.emplace_back("NO_BACK_LOBE", "1"); }
}

void AddBackPixelsDefine(bool bBackPixels, FShaderDefines& InOut)
{
	FSceneFacts OfPixels;
	OfPixels.bBackPixels = bBackPixels;
	AddDiffuseTransmissionDefine(OfPixels, InOut);
}

void AddTransmissionDefine(const FSceneFacts& Facts, FShaderDefines& InOut)
{
	if (!Facts.bTransmissive) { return; }
	InOut.emplace_back("HAS_TRANSMISSION", "1");
	if (!CVarSheet.GetOnRenderThread()) { InOut.emplace_back("ONE_INTERFACE", "1"); }
}

void AddSkyDefines(const FSceneFacts& Facts, FShaderDefines& InOut)
{
	if (Facts.bSky) { InOut.emplace_back("HAS_SKY", "1"); }
	if (Facts.bSky && Facts.bSkyInPlace) { InOut.emplace_back("SKY_IN_PLACE", "1"); }
}

FShaderDefines MakeFactDefines(const FSceneFacts& Facts)
{
	FShaderDefines Defines;
	const auto Add = [&](bool bHas, const char* Name) {
		if (bHas) { Defines.emplace_back(Name, "1"); }
	};
	Add(Facts.bSun, "HAS_SUN");
	AddSkyDefines(Facts, Defines);
	Add(Facts.Lights > 0, "HAS_LIGHTS");
	Add(Facts.bAreaLights, "HAS_AREA_LIGHTS");
	Add((Facts.bAreaLights || Facts.bEmissive) && !CVarLightArea.GetOnRenderThread(), "HALF_LIGHT_AREA");
	Add(Facts.bLightProfiles && CVarLightProfile.GetOnRenderThread(), "HAS_LIGHT_PROFILES");
	Add(Facts.bLightChannels && CVarLightChannels.GetOnRenderThread(), "HAS_LIGHT_CHANNELS");
	Add(Facts.bMasked, "HAS_MASKED");
	AddLightEmissionDefine(Facts, Defines);
	AddDiffuseTransmissionDefine(Facts, Defines);
	return Defines;
}

FShaderDefines MakePathDefines(const FSceneFacts& Facts)
{
	FShaderDefines Defines = MakeFactDefines(Facts);
	AddTransmissionDefine(Facts, Defines);
	if (Facts.bScattering) { Defines.emplace_back("HAS_SCATTERING", "1"); }
	if (Facts.bScattering && !CVarScatteredDepth.GetOnRenderThread()) { Defines.emplace_back("NO_SCATTERED_DEPTH", "1"); }
	if (Facts.bEmissive) { Defines.emplace_back("HAS_EMISSIVE", "1"); }
	if (Facts.bCharacters) { Defines.emplace_back("HAS_CHARACTERS", "1"); }
	if (ArePathRaysCounted()) { Defines.emplace_back("COUNTS_PATH_RAYS", "1"); }
	return Defines;
}

bool HasAnyLight(const FSceneFacts& Facts) { return Facts.bSun || Facts.bSky || Facts.bEmissive || Facts.Lights > 0; }

uint64_t GetMaxPathRays(const FSceneFacts& Facts, uint32_t Bounces)
{
	const uint64_t Emissive = Facts.bEmissive ? 1 : 0;
	const uint64_t Lights = Emissive + (Facts.bSun ? 1 : 0) + (Facts.bSky ? 1 : 0) + (Facts.Lights > 0 ? 1 : 0);
	return Emissive + 1 + Bounces * (Lights + 1);
}

} // namespace Lantern
