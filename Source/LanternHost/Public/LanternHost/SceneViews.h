// Named views of a scene: the file views.json beside it.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <glm/glm.hpp>

namespace Lantern
{

struct FViewCamera
{
	glm::dvec3 Position, Target; ///< metres
	double FovY;                 ///< vertical, degrees
};

struct FViewSun
{
	double Irradiance;    ///< on a plane that faces the sun
	glm::dvec3 Direction; ///< in which the light travels
	double Diameter;      ///< degrees
};

/// Each check returns an empty string, or says what no picture can be made of. Numbers must be finite.
std::string CheckViewCamera(const FViewCamera& Camera);
std::string CheckViewSun(const FViewSun& Sun);
std::string CheckViewSky(const glm::dvec3& Sky);

/// A view of a scene. What is absent stays as the scene has it.
struct FSceneView
{
	std::string Name;
	std::optional<FViewCamera> Camera;
	std::optional<FViewSun> Sun;
	std::optional<glm::dvec3> Sky; ///< constant radiance
	bool bSceneLights = true;      ///< false: the file's own lights are off
};

struct FSceneViews
{
	std::string File; ///< the views.json that lists the scene; empty if none does
	std::vector<FSceneView> Views;
	std::vector<std::string> Warnings; ///< one line each, with file and place
	std::string Error;                 ///< one line with file and place; empty if all is well

	const FSceneView* Find(std::string_view Name) const; ///< null if no view has the name
	std::string ListNames() const;                       ///< "main, night"
};

/// Reads the views of a scene file from views.json in its folder, or else in the folder above. The file is an object. It has a list of
/// views for each scene, by the scene's path relative to the file:
///   {"forest/forest.gltf": [{"name": "main", "camera": [px, py, pz, tx, ty, tz, fovY], "sun": [irradiance, dx, dy, dz, diameter],
///     "sky": [r, g, b], "sceneLights": false}]}
/// Everything but the name may be absent. Members that begin with "_" are comments. It is no error if no file lists the scene.
FSceneViews LoadSceneViews(const std::string& SceneFile);

} // namespace Lantern
