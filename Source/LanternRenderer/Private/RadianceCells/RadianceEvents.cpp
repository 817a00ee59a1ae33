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
constexpr double HurriedShare = 1.0e-3; // of what sun and sky bring to a place in the open
constexpr double ChangeInWindow = 0.1;  // by which a strength may change meanwhile, of the greater one

double GetLuminance(const glm::vec3& Color) { return glm::dot(glm::dvec3(Color), glm::dvec3(0.2126, 0.7152, 0.0722)); }

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

std::array<int64_t, 4> MakeKey(const FLightChange& Change)
{
	constexpr double Farthest = 1.0e15; // metres
	std::array<int64_t, 4> Key{Change.Slot, 0, 0, 0};
	for (int Axis = 0; Axis < 3; ++Axis)
	{
		Key[size_t(Axis) + 1] = static_cast<int64_t>(std::floor(std::clamp(Change.Position[Axis], -Farthest, Farthest)));
	}
	return Key;
}
} // namespace

/// What it is in a frame holds for some more, so the greatest counts and not the sum.
FRadianceEvents::FLampEvent FRadianceEvents::Join(
    const FLampEvents& Events, const FLampEvents::key_type& Key, const FLampEvent& Event, double Weight)
{
	const auto Place = Events.find(Key);
	if (Place == Events.end()) { return Event; }
	const FLightChange& Before = Place->second.Change;
	FLampEvent Joined = Event;
	Joined.Change.Strength = std::max(Weight * Before.Strength, Event.Change.Strength);
	Joined.Change.Moved = std::max(Weight * Before.Moved, Event.Change.Moved);
	Joined.Change.Part = std::max(Weight * Before.Part, Event.Change.Part);
	if (Before.Range <= 0.0 || Event.Change.Range <= 0.0) { Joined.Change.Range = 0.0; }
	else { Joined.Change.Range = std::max(Before.Range, Event.Change.Range); }
	return Joined;
}

void FRadianceEvents::FindLampEvents(const FRTScene& Scene)
{
	std::vector<FLightChange> Changes;
	if (!Scene.GetLights().GetStrengthChanges().GetSince(Last.Lamps, Changes)) { Fresh.push_back({}); }
	for (const FLightChange& Change : Changes)
	{
		const FLampEvents::key_type Key = MakeKey(Change);
		FreshLamps[Key] = Join(FreshLamps, Key, FLampEvent{Change});
	}
}

std::vector<FRadianceEvent> FRadianceEvents::MakeLampEvents(const FRTScene& Scene, const glm::dvec3& Camera) const
{
	std::vector<FLightChange> All;
	for (const auto& [Key, Event] : FreshLamps) { All.push_back(Join(KeptLamps, Key, Event).Change); }
	for (const auto& [Key, Event] : KeptLamps)
	{
		if (!FreshLamps.contains(Key)) { All.push_back(Event.Change); }
	}
	if (All.size() > RADIANCE_CELL_MOST_EVENTS)
	{
		std::ranges::stable_sort(All, std::greater{}, [&](const FLightChange& Change) { return GetBrought(Change, Camera); });
		All.resize(RADIANCE_CELL_MOST_EVENTS);
	}
	std::vector<FRadianceEvent> Out;
	for (const FLightChange& Change : All)
	{
		const double Radius = Change.bDirectional ? -1.0 : Change.Range > 0.0 ? Change.Range : 1.0e9;
		Out.push_back({Scene.ToRelative(Change.Position), static_cast<float>(Radius), static_cast<float>(std::min(Change.Strength, 1.0e30)),
		    static_cast<float>(std::min(Change.Moved, 1.0e30))});
	}
	return Out;
}

bool AreIndirectChangesTold() { return CVarEvents.GetOnRenderThread(); }

FRadianceEvents::FFound FRadianceEvents::Find(FRTScene& Scene, const glm::dvec3& Camera, float DeltaSeconds, double SkyChange)
{
	const FSunLight& Sun = Scene.GetSun();
	Next = {Scene.GetSections().GetIdentity(), glm::normalize(Sun.Direction), Sun.Color * Sun.Irradiance, Scene.GetSky(),
	    Scene.GetLights().GetStrengthChanges().GetCount(), Scene.GetAppearanceChanges().GetObjects().GetCount(),
	    Scene.GetAppearanceChanges().GetEverywhere(), true};
	Delta = double(DeltaSeconds);
	Fresh.clear();
	FreshLamps.clear();
	FFound Found;
	if (!Last.bValid || Last.Scene != Next.Scene || !CVarEvents.GetOnRenderThread()) { return Found; }
	const bool bSun = glm::length(Next.Sun) > 0.0f || glm::length(Last.Sun) > 0.0f;
	const double Window = GetWindow(bSun ? Last.SunDirection : Next.SunDirection, Next.SunDirection,
	    std::max({GetChange(Last.Sun, Next.Sun), GetChange(Last.Sky, Next.Sky), SkyChange, Next.Surfaces - Last.Surfaces}));
	if (Window < 1.0e9) { Fresh.push_back({.Window = static_cast<float>(std::max(Window, double(LeastWindow)))}); }
	FindLampEvents(Scene);
	std::vector<FCasterChange> Appearances;
	if (!Scene.GetAppearanceChanges().GetObjects().Find(Last.Appearances, Appearances)) { Fresh.push_back({}); }
	for (const std::vector<FEvent>* Events : {&Fresh, &Kept})
	{
		for (const FEvent& Event : *Events) { Found.Window = std::min(Found.Window, Event.Window); }
	}
	Found.Lamps = MakeLampEvents(Scene, Camera);
	Found.bHurry = Found.Window <= float(LeastWindow);
	// A beacon at the horizon is no reason.
	const double Daylight = GetLuminance(Next.Sun) + glm::pi<double>() * GetLuminance(Next.Sky);
	for (const FLampEvents* Lamps : {&FreshLamps, &KeptLamps})
	{
		for (const auto& [Key, Lamp] : *Lamps)
		{
			const bool bReaches = Lamp.Change.Range <= 0.0 || glm::length(Lamp.Change.Position - Camera) < 2.0 * Lamp.Change.Range;
			Found.bHurry |= Lamp.Change.Part >= HurriedPart && bReaches && GetBrought(Lamp.Change, Camera) > HurriedShare * Daylight;
		}
	}
	return Found;
}

void FRadianceEvents::EndFrame(bool bSubmitted)
{
	if (!bSubmitted) { return; }
	Time += Delta;
	// A lamp that is switched off and then flickers would else count as switched off for good.
	const double Weight = std::max(1.0 - Delta / HoldSeconds, 0.0);
	Delta = 0.0;
	const double Until = Time + HoldSeconds;
	for (FEvent& Event : Fresh)
	{
		Event.Until = Until;
		Kept.push_back(Event);
	}
	for (const auto& [Key, Lamp] : FreshLamps) { KeptLamps[Key] = Join(KeptLamps, Key, {Lamp.Change, Until}, Weight); }
	Fresh.clear();
	FreshLamps.clear();
	std::erase_if(Kept, [this](const FEvent& Event) { return Event.Until < Time; });
	std::erase_if(KeptLamps, [this](const auto& Lamp) { return Lamp.second.Until < Time; });
	Last = Next;
	Next = {};
}

} // namespace Lantern
