// What a pane of glass before the camera must leave of the picture, by the closed form of a sheet.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <vector>

#include <glm/gtc/packing.hpp>

#include "Judge/Judge.h"

namespace Fork
{

using namespace Lantern;

namespace
{

/// The first view's light without jitter, once the plugin has all that it needs.
FError RenderLit(FJudge& Judge, std::vector<double>& Out)
{
	FMasks Masks;
	FError Error = RunUntilComplete(Judge, Masks);
	for (FCamera& Camera : Judge.Scene.Cameras) { Camera.Jitter = glm::dvec2(0); }
	if (Error.empty()) { Error = Judge.Engine.RunFrame(Judge.Scene, true, Masks); }
	if (!Error.empty()) { return Error; }
	for (uint32_t Pixel = 0; Pixel < PixelCount; ++Pixel) { Out.push_back(double(glm::unpackHalf1x16(Masks[0].Lit[Pixel * 4]))); }
	return Error;
}

enum class EPanePart
{
	Inside,
	Edge,
	Outside
};

/// Which part of the pane a pixel shows. OutLeft: the share of light that a sheet leaves, (1 - R) / (1 + R) with R by Schlick (1994).
EPanePart FindPart(const FForkScene& Scene, uint32_t Pixel, double& OutLeft)
{
	constexpr double Border = 0.03 * Metre;
	const FCamera& Camera = Scene.Cameras[0];
	const double Tangent = std::tan(Camera.FovY * 0.5), Aspect = double(ViewSize.width) / ViewSize.height;
	const double X = ((Pixel % ViewSize.width + 0.5) / ViewSize.width * 2.0 - 1.0) * Tangent * Aspect;
	const double Y = (1.0 - (Pixel / ViewSize.width + 0.5) / ViewSize.height * 2.0) * Tangent;
	const glm::dvec3 Direction = normalize(Camera.Forward + X * Camera.Right + Y * Camera.Up);
	const glm::dvec3 Met = Camera.Position + Direction * ((Scene.Pane->Centre.z - Camera.Position.z) / Direction.z);
	const glm::dvec3 Off = abs(Met - Scene.Pane->Centre);
	const double Beyond = std::max(Off.x, Off.y) - Scene.Pane->HalfSize, R = 0.04 + 0.96 * std::pow(1.0 - std::abs(Direction.z), 5.0);
	OutLeft = (1.0 - R) / (1.0 + R);
	return Beyond < -Border ? EPanePart::Inside : Beyond < Border ? EPanePart::Edge : EPanePart::Outside;
}

/// The pane reflects the sky alone, which is dark.
FError Compare(const FForkScene& Scene, const std::vector<double>& Without, const std::vector<double>& With)
{
	constexpr double Step = 0.005; // of the eight bits of transmittance, and halves
	uint32_t Inside = 0, Outside = 0;
	for (uint32_t Pixel = 0; Pixel < PixelCount; ++Pixel)
	{
		double Left = 1.0;
		const EPanePart Part = FindPart(Scene, Pixel, Left);
		if (Part == EPanePart::Edge) { continue; }
		const double Right = Part == EPanePart::Inside ? Left * Without[Pixel] : Without[Pixel];
		if (!(std::abs(With[Pixel] - Right) < Step))
		{
			return "pixel " + std::to_string(Pixel % ViewSize.width) + ", " + std::to_string(Pixel / ViewSize.width) + " shows " +
			       std::to_string(With[Pixel]) + ", not " + std::to_string(Right);
		}
		Inside += Part == EPanePart::Inside && Without[Pixel] > 0.1;
		Outside += Part == EPanePart::Outside;
	}
	std::printf("glass: %u pixels behind it, %u beside it\n", Inside, Outside);
	return Inside > PixelCount / 20 && Outside > PixelCount / 6 ? FError() : "too little of the pane to judge it";
}

} // namespace

FError CheckGlass(FJudge& Judge)
{
	FPluginScene& Plugin = Judge.Engine.GetPlugin();
	const FSignalSet Wanted = Plugin.Wanted;
	Plugin.Wanted = FSignalSet{ESignal::SunShadow}; // all else has noise
	std::vector<double> Without, With;
	FError Error = RenderLit(Judge, Without);
	const FCamera& Camera = Judge.Scene.Cameras[0];
	Judge.Scene.Pane = FPane{Camera.Position + Camera.Forward * (4.0 * Metre), 1.5 * Metre};
	if (Error.empty()) { Error = Plugin.SetPane(Judge.Scene); }
	if (Error.empty()) { Error = RenderLit(Judge, With); }
	if (Error.empty()) { Error = Compare(Judge.Scene, Without, With); }
	Judge.Scene.Pane.reset();
	const FError Removed = Plugin.SetPane(Judge.Scene);
	Plugin.Wanted = Wanted;
	Error = Error.empty() ? Removed : Error;
	return Error.empty() ? Error : "glass: " + Error;
}

} // namespace Fork
