// The console variables of culling, and the rule that is made of them for a frame.
#include "LanternScene/Instances/Culling.h"

#include <algorithm>
#include <cmath>

#include "LanternCore/Config/ConsoleVariables.h"

namespace Lantern
{

namespace
{
TRTConsoleVariable<bool> CVarCulling(
    "r.RT.Culling", true, "Hides objects from rays that are far away and small. Off: rays see all objects.");
TRTConsoleVariable<float> CVarRadius(
    "r.RT.Culling.Radius", 1000.0f, "Distance before the camera up to which every object is kept, metres.", {0, 1e9});
TRTConsoleVariable<float> CVarRadiusBehind(
    "r.RT.Culling.RadiusBehind", 500.0f, "Distance behind the camera up to which every object is kept, metres.", {0, 1e9});
TRTConsoleVariable<float> CVarAngle("r.RT.Culling.Angle", 0.25f,
    "Least angle, from centre to rim in degrees, under which objects beyond r.RT.Culling.Radius are kept. 0: all are kept.", {0, 90});
TRTConsoleVariable<float> CVarAngleBehind("r.RT.Culling.AngleBehind", 1.0f,
    "Least angle, from centre to rim in degrees, under which objects behind the camera and beyond r.RT.Culling.RadiusBehind are kept. 0: "
    "all are kept.",
    {0, 90});
TRTConsoleVariable<float> CVarShadowPixels("r.RT.Culling.Shadow.MinPixels", 0.0f,
    "Objects that are fewer pixels across than this cast no ray-traced shadows. 0: all do.", {0, 16384});
TRTConsoleVariable<float> CVarVisiblePixels("r.RT.Culling.Visible.MinPixels", 0.0f,
    "Objects that are fewer pixels across than this are seen by shadow rays alone. 0: all rays see all objects.", {0, 16384});

double InvertSine(float Degrees)
{
	// The result is finite, so that a radius of 0 times it is not a NaN.
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

FGatherView::FGatherView(const glm::dvec3& InPosition, const glm::vec3& InForward, float FovY, uint32_t InHeight)
    : Position(InPosition),
      Forward(InForward),
      PixelSize(InHeight > 0 ? static_cast<float>(2.0 * std::tan(0.5 * double(FovY)) / InHeight) : 0.0f),
      Height(InHeight)
{}

FCullingRule::FCullingRule(const FGatherView& View, const FCullingSettings& Settings)
    : bCull(Settings.bEnabled),
      Eye(View.Position),
      Forward(View.bOrthographic ? glm::dvec3(0) : glm::normalize(glm::dvec3(View.Forward))),
      Radius{Settings.Radius + View.Reach, Settings.RadiusBehind + View.Reach},
      InverseSine{InvertSine(Settings.Angle), InvertSine(Settings.AngleBehind)},
      bOrthographic(View.bOrthographic)
{
	PixelsPerSlope = View.PixelSize > 0.0f ? 2.0 / double(View.PixelSize) : 0.0;
	const bool bLimits = View.PixelSize > 0.0f && !View.bOrthographic;
	bVisibleLimit = Settings.VisibleMinPixels > 0.0f && bLimits;
	bShadowLimit = Settings.ShadowMinPixels > 0.0f && bLimits;
	if (bVisibleLimit) { VisibleScale = PixelsPerSlope / Settings.VisibleMinPixels; }
	if (bShadowLimit) { ShadowScale = PixelsPerSlope / Settings.ShadowMinPixels; }
}

float FCullingRule::ScreenSize(const glm::dvec3& Center, double SphereRadius) const
{
	if (bOrthographic) { return static_cast<float>(SphereRadius * PixelsPerSlope); }
	// The distance is at least the radius: a sphere around the camera fills the screen.
	const double Distance = std::max(glm::distance(Center, Eye), std::max(SphereRadius, 1e-6));
	return static_cast<float>(SphereRadius / Distance * PixelsPerSlope);
}

} // namespace Lantern
