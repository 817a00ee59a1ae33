// Scenes that are built by code: the courtyard, which the program shows by default, and small scenes whose light is known in
// closed form. The camera of each small scene stands where the known value can be read.
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
	const char* Parameters;  ///< parameters after a colon, with their defaults: "ALBEDO=0.5"; or ""
	const char* Description; ///< one line
};

std::span<const FBuiltinSceneInfo> GetBuiltinScenes();
/// Returns "courtyard, furnace, … and those of lantern render --list", for messages.
std::string GetBuiltinSceneNames();

/// Whether the text before the first colon is the name of a built-in scene.
bool IsBuiltinScene(std::string_view NameWithParameters);

/// Builds "name" or "name:p1:p2". Parameters are numbers, or words that the scene's info lists. The error of a wrong parameter
/// says what is expected.
FLoadResult BuildBuiltinScene(const std::string& NameWithParameters);

} // namespace Lantern
