// What Shaders/Sky/SkyProgram.glsl gets.
#include "LanternHost/SampleSky.h"

#include "LanternCore/Config/ConsoleVariables.h"

namespace Lantern
{

namespace
{
TRTConsoleVariable<bool> CVarProgram("r.Sky.Program", false,
    "Sky of the sample engine. On: a gradient that follows the sun, with two layers of clouds; the view's sky says how bright it is. Off: "
    "uniform.");
TRTConsoleVariable<float> CVarClouds("r.Sky.Clouds", 0.5f, "Share of the sample engine's sky that low clouds cover.", {0, 1});
TRTConsoleVariable<float> CVarHighClouds("r.Sky.HighClouds", 0.4f, "Share of the sample engine's sky that high clouds cover.", {0, 1});
TRTConsoleVariable<float> CVarWind(
    "r.Sky.Wind", 10.0f, "Speed of the low clouds of the sample engine's sky along x, in metres a second.", {-1000, 1000});
} // namespace

void ApplySampleSky(FRTScene& Scene, double Time)
{
	if (!CVarProgram.GetOnRenderThread())
	{
		if (Scene.GetSkyProgram()) { Scene.SetSkyProgram(std::nullopt); }
		return;
	}
	const float Wind = CVarWind.GetOnRenderThread();
	FSkyProgram Program;
	Program.Seconds = Time;
	Program.Values[0] = {CVarClouds.GetOnRenderThread(), CVarHighClouds.GetOnRenderThread(), Wind, 0.2f * Wind};
	if (Scene.GetSkyProgram() != Program) { Scene.SetSkyProgram(Program); }
}

} // namespace Lantern
