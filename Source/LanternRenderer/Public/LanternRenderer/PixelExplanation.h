// What a frame knew of the light of one pixel, for whoever looks for the reason of a picture.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace Lantern
{

/// A radiance cell that the end of a path would try at the pixel's place.
struct FExplainedRadianceCell
{
	uint32_t Slot = 0;        ///< of the table
	uint32_t Key = 0;         ///< names the cell as long as it lives
	float Size = 0.0f;        ///< edge, metres
	uint32_t Updates = 0;     ///< that its light is the mean of; 127 stands for as many or more
	uint32_t SinceUpdate = 0; ///< frames, modulo 4,096
	uint32_t SinceLookUp = 0; ///< frames, modulo 4,096
	glm::vec3 Light{0};       ///< mean of irradiance / π, in units of radiance
	glm::vec3 Place{0};       ///< where rays of its updates start, relative to the camera, metres
};

/// What the newest frame that has arrived knew of a pixel, with r.RT.Debug.Explain. A frame's arrives two frames later, or with WaitForAll.
/// Only frames whose indirect light ends in radiance cells are explained.
struct FPixelExplanation
{
	/// In the order in which the end of a path tries them.
	static constexpr const char* CellNames[] = {"fine, thin", "fine, thick", "coarse, thin", "coarse, thick"};

	bool bSurface = false;                                      ///< false: the sky, or outside of the picture
	glm::vec3 Position{0};                                      ///< relative to the camera, metres
	glm::vec3 Normal{0};                                        ///< geometric
	std::optional<uint32_t> Used;                               ///< into Cells: the one that a path's end would take; else it would go on
	std::optional<uint32_t> LightCell;                          ///< absent: there are no light cells, or the place lies outside of them
	std::optional<uint32_t> ListedLights;                       ///< of the light cell; absent: it has no list, and all lights are visited
	std::array<std::optional<FExplainedRadianceCell>, 4> Cells; ///< absent: there is no such cell
	uint32_t Frames = 0;                                        ///< number of frames that have arrived
};

/// Returns a pixel from a text of the form X,Y, as r.RT.Debug.Explain has it; nothing from any other text. Any thread.
std::optional<glm::uvec2> ParsePixel(std::string_view Text);

} // namespace Lantern
