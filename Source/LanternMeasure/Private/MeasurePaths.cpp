// Camera paths for any scene, and their scripts.
#include "LanternMeasure/MeasurePaths.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>

#include <glm/gtc/matrix_transform.hpp>

namespace Lantern
{

namespace
{
constexpr std::array<const char*, static_cast<size_t>(EMeasurePath::Count)> PathNames = {"still", "slow", "fast", "cut"};
constexpr double SlowPart = 0.1;
constexpr double FastSeconds = 0.6; // for all of the way

FScriptFrame MakeFrame(FView View, double Time, const FPathSettings& Settings)
{
	View.DeltaSeconds = Settings.DeltaSeconds;
	View.bCut = false;
	FScriptFrame Frame;
	Frame.View = View;
	Frame.Time = Time;
	Frame.bCapture = false;
	return Frame;
}

void AddStill(FPathScript& Out, const FMeasureViews& Views, const FPathSettings& Settings, const FLightSwitch* Switch)
{
	const uint32_t Count = Settings.WarmUp + Settings.Frames;
	Out.Script.assign(Count, MakeFrame(Views.Home, Settings.Time, Settings));
	for (uint32_t I = Settings.WarmUp; I < Count; ++I) { Out.ErrorFrames.push_back(I); }
	Out.bStill = true;
	if (!Switch || !Switch->CanSwitch() || Settings.SwitchFrames == 0) { return; }
	for (uint32_t I = 0; I < Count; ++I)
	{
		Out.Script[I].Change = [Switch](FSampleEngine& Engine) { Switch->Set(Engine.GetScene(), false); };
	}
	FScriptFrame Frame = MakeFrame(Views.Home, Settings.Time, Settings);
	Frame.bCapture = true;
	Frame.Change = [Switch](FSampleEngine& Engine) { Switch->Set(Engine.GetScene(), true); };
	Out.FirstSwitched = Count;
	Out.Script.insert(Out.Script.end(), Settings.SwitchFrames, Frame);
}

void AddMoving(FPathScript& Out, const FMeasureViews& Views, const FPathSettings& Settings, double Part, bool bGhost)
{
	const uint32_t Last = Settings.WarmUp + Settings.Frames - 1; // the first at home
	for (uint32_t I = 0; I <= Last; ++I)
	{
		const double Left = double(Last - I);
		const double Seconds = Left * double(Settings.DeltaSeconds);
		Out.Script.push_back(MakeFrame(Views.GetView(std::min(1.0, Part * Seconds / FastSeconds)), Settings.Time - Seconds, Settings));
	}
	Out.Script.insert(Out.Script.end(), FPathScript::SettleFrames, MakeFrame(Views.Home, Settings.Time, Settings));
	Out.ErrorFrames = {Last};
	if (!bGhost) { return; }
	Out.BeforeFrame = Last - FPathScript::SettleFrames;
	Out.GhostFrame = Last + FPathScript::SettleFrames;
}

void AddCut(FPathScript& Out, const FMeasureViews& Views, const FPathSettings& Settings)
{
	const uint32_t Count = Settings.WarmUp + Settings.Frames, Cut = Count - FPathScript::SettleFrames;
	Out.Script.assign(Cut, MakeFrame(Views.Cut, Settings.Time, Settings));
	Out.Script.insert(Out.Script.end(), FPathScript::SettleFrames, MakeFrame(Views.Home, Settings.Time, Settings));
	Out.Script[Cut].View.bCut = true;
	for (uint32_t I = Cut; I < Count; ++I) { Out.ErrorFrames.push_back(I); }
	Out.BeforeFrame = Cut - 1;
	Out.GhostFrame = Count - 1;
}
} // namespace

const char* GetPathName(EMeasurePath Path)
{
	assert(Path < EMeasurePath::Count);
	return PathNames[static_cast<size_t>(Path)];
}

std::optional<EMeasurePath> FindPath(std::string_view Name)
{
	for (size_t I = 0; I < PathNames.size(); ++I)
	{
		if (Name == PathNames[I]) { return static_cast<EMeasurePath>(I); }
	}
	return std::nullopt;
}

FLightSwitch::FLightSwitch(FHostScene& Scene)
{
	Before = After = Scene.GetScene().GetSun();
	bSun = Before.Irradiance > 0.0f;
	bLights = !bSun && Scene.HasSceneLights() && Scene.GetScene().GetLights().GetCount() > 0;
	if (!bSun) { return; }
	const glm::dvec3 Direction = glm::normalize(Before.Direction);
	const glm::dvec3 Level(Direction.x, 0.0, Direction.z);
	const glm::dvec3 Heading = glm::length(Level) > 1e-6 ? glm::normalize(Level) : glm::dvec3(1, 0, 0);
	// About this axis a light that travels along Heading turns downwards: the sun rises, and comes down behind the zenith.
	const glm::dvec3 Axis = glm::cross(Heading, glm::dvec3(0, -1, 0));
	After.Direction = glm::dvec3(glm::rotate(glm::dmat4(1), glm::radians(60.0), Axis) * glm::dvec4(Direction, 0.0));
}

void FLightSwitch::Set(FHostScene& Scene, bool bSwitched) const
{
	if (bSun) { Scene.SetSun(bSwitched ? After : Before); }
	// Setting them starts an update of the scene: only where it changes something.
	if (bLights && Scene.HasSceneLights() == bSwitched) { Scene.SetSceneLights(!bSwitched); }
}

FPathScript MakePathScript(EMeasurePath Path, const FMeasureViews& Views, const FPathSettings& Settings, const FLightSwitch* Switch)
{
	assert(Settings.Frames > FPathScript::SettleFrames);
	FPathScript Out;
	Out.FirstTimed = Settings.WarmUp;
	Out.TimedCount = Settings.Frames;
	switch (Path)
	{
	case EMeasurePath::Still: AddStill(Out, Views, Settings, Switch); break;
	case EMeasurePath::Slow: AddMoving(Out, Views, Settings, SlowPart, false); break;
	case EMeasurePath::Fast: AddMoving(Out, Views, Settings, 1.0, true); break;
	case EMeasurePath::Cut: AddCut(Out, Views, Settings); break;
	case EMeasurePath::Count: assert(false); break;
	}
	Out.PictureFrame = Out.ErrorFrames.back();
	for (const uint32_t Frame : Out.ErrorFrames) { Out.Script[Frame].bCapture = true; }
	if (Out.GhostFrame) { Out.Script[*Out.GhostFrame].bCapture = true; }
	// Tells whether the scene has the signal at all.
	Out.Script.front().bCapture = true;
	return Out;
}

} // namespace Lantern
