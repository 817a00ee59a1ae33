// From changes of the scene to what radiance cells and filters forget.
#include "RadianceCells/RadianceEvents.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include <glm/gtc/constants.hpp>

#include "LanternCore/Config/ConsoleVariables.h"

namespace Lantern
{

namespace
{
TRTConsoleVariable<bool> CVarEvents("r.RT.Debug.GI.Events", true,
    "Planted fault. Off: radiance cells and the filter of global illumination are not told what has changed, and average over it.");

constexpr double DegreesInWindow = 1.0; // that the sun may move while a cell averages
constexpr double HurriedPart = 0.5;     // of a lamp's light that comes or goes; what flickers by less is usual
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

/// What a lamp brings to a place at about this distance.
double GetBrought(const FLightChange& Change, const glm::dvec3& Place)
{
	constexpr double Nearest = 0.5; // metres
	if (Change.bDirectional) { return Change.Strength; }
	const double Distance = std::max(glm::length(Change.Position - Place), Nearest);
	return (Change.Strength + 2.0 * Change.Moved / Distance) / (Distance * Distance);
}

constexpr double AtOnePlace = 1.0; // metres

/// Joins changes of one lamp at about one place. What it is in a frame holds for some more, so the greatest counts and not the sum.
template <typename TEvent>
void JoinLamp(std::vector<TEvent>& Events, const TEvent& Event)
{
	for (TEvent& Other : Events)
	{
		if (Other.Change.Slot != Event.Change.Slot || glm::length(Other.Change.Position - Event.Change.Position) > AtOnePlace) { continue; }
		const FLightChange Before = Other.Change;
		Other = Event;
		Other.Change.Strength = std::max(Before.Strength, Event.Change.Strength);
		Other.Change.Moved = std::max(Before.Moved, Event.Change.Moved);
		Other.Change.Part = std::max(Before.Part, Event.Change.Part);
		return;
	}
	Events.push_back(Event);
}
} // namespace

void FRadianceEvents::FindLampEvents(const FRTScene& Scene)
{
	std::vector<FLightChange> Changes;
	if (!Scene.GetLights().GetStrengthChanges().GetSince(Last.Lamps, Changes)) { Fresh.push_back({}); }
	for (const FLightChange& Change : Changes) { JoinLamp(FreshLamps, FLampEvent{Change}); }
}

std::vector<FRadianceEvent> FRadianceEvents::MakeLampEvents(const FRTScene& Scene, const glm::dvec3& Camera) const
{
	std::vector<FLampEvent> All = KeptLamps;
	for (const FLampEvent& Event : FreshLamps) { JoinLamp(All, Event); }
	if (All.size() > RADIANCE_CELL_MOST_EVENTS)
	{
		const auto Brings = [&](const FLampEvent& Event) { return GetBrought(Event.Change, Camera); };
		std::ranges::stable_sort(All, std::greater{}, Brings);
		All.resize(RADIANCE_CELL_MOST_EVENTS);
	}
	std::vector<FRadianceEvent> Out;
	for (const FLampEvent& Event : All)
	{
		const FLightChange& Change = Event.Change;
		const double Radius = Change.bDirectional ? -1.0 : Change.Range > 0.0 ? Change.Range : 1.0e9;
		Out.push_back({Scene.ToRelative(Change.Position), static_cast<float>(Radius), static_cast<float>(std::min(Change.Strength, 1.0e30)),
		    static_cast<float>(std::min(Change.Moved, 1.0e30))});
	}
	return Out;
}

bool AreIndirectChangesTold() { return CVarEvents.GetOnRenderThread(); }

FRadianceEvents::FFound FRadianceEvents::Find(FRTScene& Scene, const glm::dvec3& Camera, float DeltaSeconds)
{
	const FSunLight& Sun = Scene.GetSun();
	Next = {Scene.GetSections().GetIdentity(), glm::normalize(Sun.Direction), Sun.Color * Sun.Irradiance, Scene.GetSky(),
	    Scene.GetLights().GetStrengthChanges().GetCount(), Scene.GetAppearanceChanges().GetEverywhere(), true};
	Delta = double(DeltaSeconds);
	Fresh.clear();
	FreshLamps.clear();
	FFound Found;
	if (!Last.bValid || Last.Scene != Next.Scene || !CVarEvents.GetOnRenderThread()) { return Found; }
	const bool bSun = glm::length(Next.Sun) > 0.0f || glm::length(Last.Sun) > 0.0f;
	const double Window = GetWindow(bSun ? Last.SunDirection : Next.SunDirection, Next.SunDirection,
	    std::max({GetChange(Last.Sun, Next.Sun), GetChange(Last.Sky, Next.Sky), Next.Surfaces - Last.Surfaces}));
	if (Window < 1.0e9) { Fresh.push_back({.Window = static_cast<float>(std::max(Window, double(LeastWindow)))}); }
	FindLampEvents(Scene);
	for (const std::vector<FEvent>* Events : {&Fresh, &Kept})
	{
		for (const FEvent& Event : *Events) { Found.Window = std::min(Found.Window, Event.Window); }
	}
	Found.Lamps = MakeLampEvents(Scene, Camera);
	Found.bHurry = Found.Window <= float(LeastWindow);
	for (const std::vector<FLampEvent>* Lamps : {&FreshLamps, &KeptLamps})
	{
		for (const FLampEvent& Lamp : *Lamps) { Found.bHurry |= Lamp.Change.Part >= HurriedPart; }
	}
	return Found;
}

void FRadianceEvents::EndFrame(bool bSubmitted)
{
	if (!bSubmitted) { return; }
	Time += Delta;
	Delta = 0.0;
	const auto Keep = [Until = Time + HoldSeconds](auto Event) {
		Event.Until = Until;
		return Event;
	};
	for (const FEvent& Event : Fresh) { Kept.push_back(Keep(Event)); }
	for (const FLampEvent& Lamp : FreshLamps) { JoinLamp(KeptLamps, Keep(Lamp)); }
	Fresh.clear();
	FreshLamps.clear();
	const auto IsOver = [this](const auto& Event) { return Event.Until < Time; };
	std::erase_if(Kept, IsOver);
	std::erase_if(KeptLamps, IsOver);
	Last = Next;
	Next = {};
}

} // namespace Lantern
