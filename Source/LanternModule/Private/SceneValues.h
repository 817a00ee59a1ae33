// What the scene alone knows of an engine's things, by their slots: taken along when the scene moves to another device.
#pragma once

#include <optional>
#include <vector>

#include <glm/glm.hpp>

#include "SceneCommands.h"

namespace Lantern
{

struct FSceneValues
{
	std::vector<std::optional<FMaterialData>> Materials;
	std::vector<std::optional<glm::dmat4>> Transforms; ///< of objects
	std::vector<std::optional<FSceneLight>> Lights;
	FSunLight Sun;
	glm::vec3 Sky{0};
	std::optional<FSkyProgram> SkyProgram;

	/// Follows a command that no frame has taken.
	void Follow(const FSceneCommand& Command);
};

} // namespace Lantern
