// What the engine shows: boxes, a reed, a sun and a lamp. The engine's world is in centimetres, left-handed: x to the right, y towards
// where the first camera stands, z up. All below is in it.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include <glm/glm.hpp>

namespace Fork
{

inline constexpr double Metre = 100.0;
/// The game advances by this with each frame, however long the frame takes: pictures do not depend on the machine.
inline constexpr float FrameSeconds = 1.0f / 60.0f;

/// From metres, given as right, up and towards the camera.
inline glm::dvec3 At(double Right, double Up, double Towards) { return glm::dvec3(Right, Towards, Up) * Metre; }

struct FBox
{
	glm::dvec3 Centre{0};
	glm::dvec3 HalfSize{1};
	bool bCastsShadow = true;
	bool bCutOut = false;     ///< its material's map lets light through where IsCutOut says so
	bool bDeformable = false; ///< has a mesh of its own, whose vertices may change
};

/// A post that bends in its middle. The engine's GPU skins it.
struct FReed
{
	glm::dvec3 Middle{0};
	double Bend = 0.0; ///< of the upper half, radians about y
};

struct FCamera
{
	glm::dvec3 Position{0};
	glm::dvec3 Forward{0, -1, 0}, Right{1, 0, 0}, Up{0, 0, 1}; ///< orthonormal
	double FovY = 1.0;                                         ///< vertical, radians
	double Near = 0.5 * Metre, Far = 1024.0 * Metre;
	glm::dvec2 Jitter{0}; ///< of the picture, pixels, right and down
};

/// A pane of clear glass that lies flat. The engine draws none: the plugin finds it by rays.
struct FPane
{
	glm::dvec3 Centre{0};
	double HalfSize = 1.0; ///< along x and y
};

struct FForkScene
{
	std::vector<FBox> Boxes;
	FReed Reed;
	glm::dvec3 SunDirection{0, 0, -1}; ///< direction in which the light travels, unit length
	glm::dvec3 Lamp{0};
	double LampIntensity = 0.0; ///< candela; 0: there is none
	double LampWidth = 0.0;     ///< of a square that shines down, LampIntensity straight below it; 0: the lamp is a point
	uint8_t LampChannels = 1;   ///< bit 0: it lights all boxes
	bool bLampProfile = false;  ///< it shines half as bright wherever it does not shine up
	std::optional<FPane> Pane;
	std::array<FCamera, 2> Cameras; ///< two views of one scene, as of two players
};

/// A floor, a floating cube, a deformable pillar, a slab that casts no shadow, a cut-out cube, and a reed. Offset moves all of them.
FForkScene MakeScene(glm::dvec3 Offset);

struct FVertex
{
	glm::vec3 Position, Normal;
	glm::vec3 Previous; ///< position in the frame before
	glm::vec2 UV;
};

/// Whether the map of the cut-out material has a hole at a UV: see MakeCutOutMap.
bool IsCutOut(glm::dvec2 UV);
inline constexpr uint32_t CutOutMapSize = 4; ///< texels, of both sides
/// RGBA8 texels for nearest-neighbour sampling: a window in the middle, with alpha 0.
std::array<uint32_t, CutOutMapSize * CutOutMapSize> MakeCutOutMap();

struct FBoxMesh
{
	std::array<FVertex, 24> Vertices;
	std::array<uint32_t, 36> Indices; ///< cross products of edges point outwards
};

/// A box from −HalfSize to HalfSize. Each face has UVs from 0 to 1.
FBoxMesh MakeBoxMesh(glm::vec3 HalfSize = glm::vec3(1));

struct FSkinVertex
{
	glm::vec3 Position; ///< relative to the reed's middle
	float Weight;       ///< of the bone that turns
};

struct FReedMesh
{
	std::vector<FSkinVertex> Vertices;
	std::vector<uint32_t> Indices; ///< cross products of edges point outwards
};

/// A post of rings without ends, from 2 m below its middle to 2 m above.
FReedMesh MakeReedMesh();
/// Linear blend of two bones, as Fork.comp does it.
glm::dvec3 SkinVertex(const FSkinVertex& Vertex, double Bend);

/// Projects view space (centimetres, x right, y up, z backwards) to Vulkan's clip space: 0 at the near plane, 1 at the far plane. No
/// jitter.
glm::mat4 GetViewToClip(const FCamera& Camera, double Aspect);
/// Rotates the world to view space.
glm::dmat3 GetWorldToView(const FCamera& Camera);

} // namespace Fork
