// What the engine's lamp must bring: by indirect light, by the plugin's own direct light, and by the engine's with the light mask.
#include <cmath>
#include <cstdio>
#include <optional>
#include <vector>

#include <glm/gtc/packing.hpp>

#include "Judge/Judge.h"
#include "Judge/Verdict.h"

namespace Fork
{

using namespace Lantern;

namespace
{

/// Ends the lamp, whatever a check has found.
FError RemoveLamp(FJudge& Judge, const FError& Found)
{
	Judge.Scene.LampIntensity = Judge.Scene.LampWidth = 0.0;
	const FError Error = Judge.Engine.GetPlugin().SetLamp(Judge.Scene);
	return Found.empty() ? Error : Found;
}

/// Mean light with the lamp at an intensity.
FError MeasureLamp(FJudge& Judge, double Intensity, double& Out)
{
	Judge.Scene.LampIntensity = Intensity;
	FMasks Masks;
	FError Error = Judge.Engine.GetPlugin().SetLamp(Judge.Scene);
	if (Error.empty()) { Error = RunUntilComplete(Judge, Masks); }
	// With 8 frames the ratio of two lamps came out as 1.97 and 1.88 in two rounds: noise alone could fail it. With 32 its standard deviation
	// was 0.025, a quarter of what CheckLamp allows; with 48 it is a fifth.
	constexpr int Frames = 48;
	Out = 0.0;
	for (int Frame = 0; Error.empty() && Frame < Frames; ++Frame)
	{
		Error = Judge.Engine.RunFrame(Judge.Scene, false, Masks);
		Out += GetMeanLight(Masks[0]) / Frames;
	}
	return Error;
}

} // namespace

FError CheckLamp(FJudge& Judge)
{
	FSignalSet& Wanted = Judge.Engine.GetPlugin().Wanted;
	Wanted.Add(ESignal::DiffuseGI);
	constexpr double Intensities[] = {200.0, 400.0, 0.0}; // candela
	double Light[3] = {};
	FError Error;
	for (int Index = 0; Error.empty() && Index < 3; ++Index) { Error = MeasureLamp(Judge, Intensities[Index], Light[Index]); }
	double Halved = 0.0, OffChannel = 0.0;
	Judge.Scene.bLampProfile = true;
	if (Error.empty()) { Error = MeasureLamp(Judge, 2.0 * Intensities[0], Halved); }
	Judge.Scene.bLampProfile = false;
	Judge.Scene.LampChannels = 2;
	if (Error.empty()) { Error = MeasureLamp(Judge, Intensities[0], OffChannel); }
	Judge.Scene.LampChannels = 1;
	Error = RemoveLamp(Judge, Error);
	Wanted.Remove(ESignal::DiffuseGI);
	if (!Error.empty()) { return Error; }
	const double Once = Light[0] - Light[2], Twice = Light[1] - Light[2];
	std::printf("lamp: mean light %.4f without, %.4f and %.4f with it\n", Light[2], Light[0], Light[1]);
	std::printf("lamp: mean light %.4f with a profile, %.4f of another channel\n", Halved, OffChannel);
	if (std::abs((Halved - Light[2]) / Once - 1.0) > 0.1) { return "diffuse light does not follow the lamp's profile"; }
	if (std::abs(OffChannel - Light[2]) > 0.1 * Once) { return "a lamp of another channel lights the boxes"; }
	const bool bProportional = Once > 0.05 * Light[2] && std::abs(Twice / Once - 2.0) < 0.1;
	return bProportional ? FError() : "diffuse light does not follow the lamp";
}

namespace
{

constexpr uint32_t Stride = 16; // pixels between those that CheckSquareLamp asks

/// Adds the light of some pixels of a view up, over frames without jitter and over the grey of surfaces.
FError AddSomeLight(FJudge& Judge, const std::vector<uint32_t>& Pixels, double& Out)
{
	constexpr int Frames = 24;
	FMasks Masks;
	FError Error = RunUntilComplete(Judge, Masks);
	for (FCamera& Camera : Judge.Scene.Cameras) { Camera.Jitter = glm::dvec2(0); }
	for (int Frame = 0; Error.empty() && Frame < Frames; ++Frame)
	{
		Error = Judge.Engine.RunFrame(Judge.Scene, false, Masks);
		for (const uint32_t Pixel : Pixels) { Out += glm::unpackHalf1x16(Masks[0].Lit[Pixel * 4]) / (FForkRaster::Grey * Frames); }
	}
	return Error;
}

} // namespace

FError CheckSquareLamp(FJudge& Judge)
{
	constexpr double Intensity = 30.0, Limit = 0.03; // candela; 8 x 8 points for the lamp, and some frames of noise
	FSignalSet& Wanted = Judge.Engine.GetPlugin().Wanted;
	Judge.Scene.LampIntensity = Intensity;
	Judge.Scene.LampWidth = 1.0 * Metre;
	Judge.Scene.Cameras[0].Jitter = glm::dvec2(0);
	const FShadowTruth Truth(Judge.Scene, Judge.Scene.Cameras[0]);
	std::vector<uint32_t> Pixels;
	double Right = 0.0, Found = 0.0, Without = 0.0;
	for (uint32_t Pixel = 0; Pixel < PixelCount; Pixel += Stride)
	{
		const uint32_t X = Pixel % ViewSize.width, Y = Pixel / ViewSize.width;
		const std::optional<double> Light = Y % Stride == 0 ? Truth.ExpectSquareLamp(X, Y, ViewSize.width, ViewSize.height) : std::nullopt;
		if (!Light) { continue; }
		Pixels.push_back(Pixel);
		Right += *Light;
	}
	Wanted.Add(ESignal::LocalDiffuse);
	FError Error = Judge.Engine.GetPlugin().SetLamp(Judge.Scene);
	if (Error.empty()) { Error = AddSomeLight(Judge, Pixels, Found); }
	Error = RemoveLamp(Judge, Error);
	if (Error.empty()) { Error = AddSomeLight(Judge, Pixels, Without); }
	Wanted.Remove(ESignal::LocalDiffuse);
	if (!Error.empty()) { return Error; }
	const double Ratio = (Found - Without) / Right;
	std::printf("square lamp: light of %zu pixels is %.4f of what its points bring\n", Pixels.size(), Ratio);
	return Pixels.size() > 50 && std::abs(Ratio - 1.0) < Limit ? FError() : "the light of a square lamp is not as bright as it must be";
}

FError CheckLightMask(FJudge& Judge)
{
	constexpr double Intensity = 3.0; // candela: surfaces near the lamp are as bright as in the sun
	FPluginScene& Plugin = Judge.Engine.GetPlugin();
	Judge.Scene.LampIntensity = Intensity;
	Plugin.bLightMask = true;
	FMasks Masks;
	FError Error = Plugin.SetLamp(Judge.Scene);
	if (Error.empty()) { Error = RunUntilComplete(Judge, Masks); }
	for (uint32_t View = 0; Error.empty() && View < ViewCount; ++View)
	{
		const FCamera& Camera = Judge.Scene.Cameras[View];
		const FShadowPicture Lamp = ExpectShadow(Judge.Scene, Camera, ELightSource::Lamp);
		Error = JudgeLight(ExpectShadow(Judge.Scene, Camera), Masks[View], &Lamp);
		uint32_t Lit = 0, Shadowed = 0;
		for (const FExpectedPixel& Pixel : Lamp)
		{
			Lit += Pixel.Shadow == EExpectation::Lit;
			Shadowed += Pixel.Shadow == EExpectation::Shadowed && Pixel.Light > 0.0;
		}
		std::printf("light mask, view %u: the lamp lights %u pixels, and is hidden from %u\n", View, Lit, Shadowed);
		if (Error.empty() && (Lit < PixelCount / 12 || Shadowed < PixelCount / 120)) { Error = "too little of the lamp to judge it"; }
	}
	Plugin.bLightMask = false;
	Error = RemoveLamp(Judge, Error);
	return Error.empty() ? Error : "light mask: " + Error;
}

} // namespace Fork
