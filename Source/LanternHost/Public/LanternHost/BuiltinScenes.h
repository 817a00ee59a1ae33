// Scenes that are built by code: the courtyard that the program shows when it is given nothing, and the small scenes
// whose light is known in closed form. Each has a camera placed where the known value can be read.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "LanternHost/SceneLoader.h"

namespace Lantern
{

struct FBuiltinSceneInfo
{
	const char* Name;        ///< "furnace"
	const char* Parameters;  ///< how they are written after a colon, with their defaults: "ALBEDO=0.5"; or ""
	const char* Description; ///< one line
};

std::span<const FBuiltinSceneInfo> GetBuiltinScenes();
/// "courtyard, furnace, … and those of lantern render --list", for messages.
std::string GetBuiltinSceneNames();

/// Whether the text before the first colon is the name of a built-in scene.
bool IsBuiltinScene(std::string_view NameWithParameters);

/// Builds "name" or "name:p1:p2"; parameters are numbers or the words that the scene's info gives. A wrong one is an
/// error that says what is expected.
FLoadResult BuildBuiltinScene(const std::string& NameWithParameters);

} // namespace Lantern
