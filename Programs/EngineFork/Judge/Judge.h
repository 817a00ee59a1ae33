// What the checks share: the engine that they judge, and its scene as of now.
#pragma once

#include <array>
#include <string>

#include "Example/ForkEngine.h"

namespace Fork
{

using FMasks = std::array<FFrameMasks, ViewCount>;

struct FJudge
{
	FForkEngine& Engine;
	FForkScene Scene;
	std::string Pictures; ///< begin of their paths; empty: none
	int Checks = 0;
};

/// Runs frames until the plugin has all that it needs, then a few more. The plugin never waits: its first frames may lack shadows.
FError RunUntilComplete(FJudge& Judge, FMasks& Out);

/// Diffuse light: what surfaces reflect of the lamp is proportional to its intensity and its profile, and ends with it and its channel.
FError CheckLamp(FJudge& Judge);
/// The plugin's own light of a lamp with an extent: as a sum over the points of the lamp has it.
FError CheckSquareLamp(FJudge& Judge);
/// The engine's own light of the lamp by the plugin's mask: each pixel of it is right.
FError CheckLightMask(FJudge& Judge);
/// A pane of glass in front of the picture leaves what a sheet must, and all else as it was.
FError CheckGlass(FJudge& Judge);

} // namespace Fork
