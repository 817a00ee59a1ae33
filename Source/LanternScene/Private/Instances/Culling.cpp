#include "LanternScene/Instances/Culling.h"

#include <algorithm>
#include <cmath>

#include "LanternCore/Config/ConsoleVariables.h"

namespace Lantern
{

namespace
{
TRTConsoleVariable<bool> CVarCulling(
    "r.RT.Culling", true, "Leaves out of the rays' scene what is far away and small. Off: all objects are in it.");
TRTConsoleVariable<float> CVarRadius(
    "r.RT.Culling.Radius", 1000.0f, "Metres before the camera up to which every object is kept.", {0, 1e9});
TRTConsoleVariable<float> CVarRadiusBehind(
    "r.RT.Culling.RadiusBehind", 500.0f, "Metres behind the camera up to which every object is kept.", {0, 1e9});
TRTConsoleVariable<float> CVarAngle("r.RT.Culling.Angle", 0.25f,
    "Beyond r.RT.Culling.Radius, objects seen under at least this angle (centre to rim, degrees) are kept. 0: all.", {0, 90});
TRTConsoleVariable<float> CVarAngleBehind("r.RT.Culling.AngleBehind", 1.0f,
    "Behind the camera and beyond r.RT.Culling.RadiusBehind: the angle from which objects are kept. 0: all.", {0, 90});
TRTConsoleVariable<float> CVarShadowPixels(
    "r.RT.Culling.Shadow.MinPixels", 0.0f, "Objects that are fewer pixels across cast no ray-traced shadow.", {0, 16384});
TRTConsoleVariable<float> CVarVisiblePixels(
    "r.RT.Culling.Visible.MinPixels", 0.0f, "Objects that are fewer pixels across are seen by no rays but those of shadows.", {0, 16384});

double InvertSine(float Degrees)
{
	// A finite bound keeps radius 0 from making a NaN.
	return 1.0 / std::max(1e-15, std::sin(glm::radians(double(std::clamp(Degrees, 0.0f, 90.0f)))));
}
} // namespace

FCullingSettings FCullingSettings::FromConsole()
{
	FCullingSettings Settings;
	Settings.bEnabled = CVarCulling.GetOnRenderThread();
	Settings.Radius = CVarRadius.GetOnRenderThread();
	Settings.RadiusBehind = CVarRadiusBehind.GetOnRenderThread();
	Settings.Angle = CVarAngle.GetOnRenderThread();
	Settings.AngleBehind = CVarAngleBehind.GetOnRenderThread();
	Settings.ShadowMinPixels = CVarShadowPixels.GetOnRenderThread();
	Settings.VisibleMinPixels = CVarVisiblePixels.GetOnRenderThread();
	return Settings;
}

FCullingRule::FCullingRule(const FGatherView& View, const FCullingSettings& Settings)
    : bCull(Settings.bEnabled),
      Eye(View.Position),
      Forward(glm::normalize(glm::dvec3(View.Forward))),
      Radius{Settings.Radius, Settings.RadiusBehind},
      InverseSine{InvertSine(Settings.Angle), InvertSine(Settings.AngleBehind)}
{
	PixelsPerSlope = View.Height / std::tan(0.5 * double(View.FovY));
	bVisibleLimit = Settings.VisibleMinPixels > 0.0f && View.Height > 0;
	bShadowLimit = Settings.ShadowMinPixels > 0.0f && View.Height > 0;
	if (bVisibleLimit) { VisibleScale = PixelsPerSlope / Settings.VisibleMinPixels; }
	if (bShadowLimit) { ShadowScale = PixelsPerSlope / Settings.ShadowMinPixels; }
}

float FCullingRule::ScreenSize(const glm::dvec3& Center, double SphereRadius) const
{
	// Not rays alone decide: what surrounds the camera fills the screen.
	const double Distance = std::max(glm::distance(Center, Eye), std::max(SphereRadius, 1e-6));
	return static_cast<float>(SphereRadius / Distance * PixelsPerSlope);
}

} // namespace Lantern
