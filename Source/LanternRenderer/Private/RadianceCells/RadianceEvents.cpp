// From changes of the scene to spheres in which radiance cells forget.
#include "RadianceCells/RadianceEvents.h"

#include <algorithm>
#include <cmath>

#include <glm/gtc/constants.hpp>

#include "LanternCore/Config/ConsoleVariables.h"

namespace Lantern
{

namespace
{
TRTConsoleVariable<bool> CVarEvents("r.RT.Debug.GI.Events", true,
    "Planted fault. Off: radiance cells and the filter of global illumination are not told what has changed, and average over it.");

constexpr double DegreesInWindow = 1.0; // that the sun may move while a cell averages
constexpr double ChangeInWindow = 0.1;  // by which a strength may change meanwhile, of the greater one

double GetChange(const glm::vec3& A, const glm::vec3& B)
{
	const double Greater = std::max(glm::length(A), glm::length(B));
	return Greater > 0.0 ? glm::length(A - B) / Greater : 0.0;
}

/// Returns the frames after which light that changes so much in each is too old.
double GetWindow(const glm::dvec3& SunBefore, const glm::dvec3& SunNow, double Strengths)
{
	const double Degrees = glm::degrees(std::acos(std::clamp(glm::dot(SunBefore, SunNow), -1.0, 1.0)));
	const double Rate = std::max(Degrees / DegreesInWindow, Strengths / ChangeInWindow);
	return Rate > 0.0 ? 1.0 / Rate : 1.0e9;
}

/// Position: as FLightReach has it.
glm::dvec3 ToWorld(const FRTScene& Scene, const glm::ivec3& Position)
{
	const glm::dvec3 Origin = Scene.GetOrigin();
	glm::dvec3 World = Origin;
	for (int Axis = 0; Axis < 3; ++Axis)
	{
		const auto Start = static_cast<uint32_t>(std::llround(Origin[Axis] * double(LIGHT_POSITION_STEPS)));
		World[Axis] += double(static_cast<int32_t>(static_cast<uint32_t>(Position[Axis]) - Start)) / double(LIGHT_POSITION_STEPS);
	}
	return World;
}
} // namespace

void FRadianceEvents::FindLampEvents(const FRTScene& Scene)
{
	std::vector<FLightReach> Reaches;
	const bool bKnown = Scene.GetLights().GetJournal().GetSince(Last.Lamps, Reaches);
	if (!bKnown) { Fresh.push_back({}); }
	for (const FLightReach& Reach : Reaches)
	{
		if (Reach.Radius <= 0.0f) { Fresh.push_back({}); }
		else { Fresh.push_back({ToWorld(Scene, Reach.Position), double(Reach.Radius)}); }
	}
}

bool AreIndirectChangesTold() { return CVarEvents.GetOnRenderThread(); }

FRadianceEvents::FFound FRadianceEvents::Find(FRTScene& Scene, float DeltaSeconds)
{
	const FSunLight& Sun = Scene.GetSun();
	Next = {Scene.GetSections().GetIdentity(), glm::normalize(Sun.Direction), Sun.Color * Sun.Irradiance, Scene.GetSky(),
	    Scene.GetLights().GetJournal().GetCount(), Scene.GetAppearanceChanges().GetEverywhere(), true};
	Delta = double(DeltaSeconds);
	Fresh.clear();
	FFound Found;
	if (!Last.bValid || Last.Scene != Next.Scene || !CVarEvents.GetOnRenderThread()) { return Found; }
	const bool bSun = glm::length(Next.Sun) > 0.0f || glm::length(Last.Sun) > 0.0f;
	const double Window = GetWindow(bSun ? Last.SunDirection : Next.SunDirection, Next.SunDirection,
	    std::max({GetChange(Last.Sun, Next.Sun), GetChange(Last.Sky, Next.Sky), Next.Surfaces - Last.Surfaces}));
	if (Window < 1.0e9) { Fresh.push_back({.Window = static_cast<float>(std::max(Window, double(LeastWindow)))}); }
	FindLampEvents(Scene);
	for (const std::vector<FEvent>* Events : {&Fresh, &Kept})
	{
		for (const FEvent& Event : *Events)
		{
			if (Event.Radius < 0.0) { Found.Window = std::min(Found.Window, Event.Window); }
			else { Found.Spheres.push_back({Scene.ToRelative(Event.Center), static_cast<float>(Event.Radius), Event.Window, 0.0f}); }
		}
	}
	if (Found.Spheres.size() > RADIANCE_CELL_MOST_EVENTS)
	{
		Found.Window = std::min(Found.Window, float(LeastWindow));
		Found.Spheres.clear();
	}
	Found.bHurry = Found.Window <= float(LeastWindow) || !Found.Spheres.empty();
	return Found;
}

void FRadianceEvents::EndFrame(bool bSubmitted)
{
	if (!bSubmitted) { return; }
	Time += Delta;
	Delta = 0.0;
	for (FEvent& Event : Fresh)
	{
		Event.Until = Time + HoldSeconds;
		Kept.push_back(Event);
	}
	Fresh.clear();
	std::erase_if(Kept, [this](const FEvent& Event) { return Event.Until < Time; });
	Last = Next;
	Next = {};
}

} // namespace Lantern
