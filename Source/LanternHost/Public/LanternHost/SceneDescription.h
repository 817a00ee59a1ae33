// A scene on the CPU, as loaded from a file or built by code, before it reaches a GPU. Right-handed, y up, metres, radians,
// linear Rec.709. It is plain data. The loader and ValidateScene() guarantee the invariants stated here.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>

#include "LanternScene/Lights/Light.h"
#include "LanternScene/Lights/Photometry.h"
#include "LanternScene/Scene/Object.h"
#include "SceneTypes.h"

namespace Lantern
{

struct FHostImage
{
	std::string Name; ///< for messages: file or "image 3"
	uint32_t Width = 0, Height = 0;
	bool bSrgb = false;        ///< colour data, sRGB-encoded
	std::vector<uint8_t> Rgba; ///< Width × Height × 4, top row first
	bool bHasAlpha = false;    ///< some texel's alpha is below 255
};

struct FHostTexture
{
	int32_t Image = -1; ///< into Images; ≥ 0
	bool bRepeatU = true, bRepeatV = true;
	bool bMirrorU = false, bMirrorV = false;
	bool bNearest = false;
};

enum class EAlphaMode : uint8_t
{
	Opaque,
	Mask,
	Blend
};

struct FHostTextureSlot
{
	int32_t Texture = -1;            ///< into Textures; −1: none
	uint32_t UVSet = 0;              ///< 0 or 1
	glm::vec4 Transform{1, 0, 0, 1}; ///< rows of the 2×2 part of KHR_texture_transform
	glm::vec2 Offset{0};
};

struct FHostMaterial
{
	std::string Name;
	glm::vec4 BaseColor{1};
	glm::vec3 Emissive{0}; ///< nits, strength included
	/// Nits, ≥ 0: takes the place of Emissive where the surface lights something. Cameras and mirrors do not see it. The emissive
	/// texture multiplies it as well.
	std::optional<glm::vec3> LightEmissive;
	float Metallic = 1.0f, Roughness = 1.0f;
	float NormalScale = 1.0f, OcclusionStrength = 1.0f;
	float AlphaCutoff = 0.5f;
	float Ior = 1.5f, Specular = 1.0f, Transmission = 0.0f;
	/// Share of the diffuse layer's light that leaves the surface on its other side, and the factor of what leaves there.
	float DiffuseTransmission = 0.0f;
	glm::vec3 DiffuseTransmissionColor{1};
	/// With Transmission: the surface of a volume, which bends and absorbs light. Else a thin sheet.
	bool bSolid = false;
	glm::vec3 Extinction{0};        ///< of what is solid: coefficient of what is absorbed and scattered, 1/m, ≥ 0
	glm::vec3 ScatterAlbedo{0};     ///< share of it that is scattered, once, 0–1
	float ScatterAnisotropy = 0.0f; ///< mean cosine of the angle by which that turns light, −1 to 1 exclusive
	EAlphaMode AlphaMode = EAlphaMode::Opaque;
	bool bDoubleSided = false;
	std::array<FHostTextureSlot, TEXTURE_SLOTS> Slots; ///< by TEXTURE_…
	/// Material program (see LanternScene/MaterialPrograms.h): GLSL, relative to the shader folders. Empty: the standard one.
	std::string Program;
};

struct FHostSection
{
	uint32_t FirstIndex = 0, IndexCount = 0; ///< IndexCount: a multiple of 3, > 0
	int32_t Material = -1;                   ///< into Materials; ≥ 0
};

/// Up to 4 influences (the loader keeps the four strongest and renormalises).
struct FSkinWeights
{
	std::array<uint16_t, 4> Joints{};
	std::array<float, 4> Weights{};
};

struct FHostMesh
{
	std::string Name;
	std::vector<glm::vec3> Positions;          ///< finite
	std::vector<FVertexAttributes> Attributes; ///< as many as Positions; normals always there
	std::vector<FSkinWeights> Skin;            ///< empty, or as many as Positions
	std::vector<uint32_t> Indices;             ///< < Positions.size()
	std::vector<FHostSection> Sections;        ///< > 0
	bool bHasTangents = false;
	glm::vec3 BoundsMin{0}, BoundsMax{0};
};

struct FHostNode
{
	std::string Name;
	int32_t Parent = -1; ///< < its own index: parents come first
	glm::dvec3 Translation{0};
	glm::quat Rotation{1, 0, 0, 0};
	glm::vec3 Scale{1};
	std::optional<glm::dmat4> Matrix; ///< replaces the three members above
	int32_t Mesh = -1, Skin = -1, Light = -1, Camera = -1;
	std::vector<int32_t> Materials; ///< by section, replacing the mesh's; empty: the mesh's. Masked only where the mesh's material is
	FRTObjectTraits Traits;         ///< of the node's mesh; bMoves is left to FHostScene
	std::optional<FToonStyle> Toon; ///< of the node's mesh
};

struct FHostSkin
{
	std::vector<int32_t> Joints; ///< nodes
	std::vector<glm::mat4> InverseBind;
};

enum class EAnimationPath : uint8_t
{
	Translation,
	Rotation,
	Scale
};
enum class EInterpolation : uint8_t
{
	Step,
	Linear,
	CubicSpline
};

struct FHostChannel
{
	int32_t Node = -1;
	EAnimationPath Path = EAnimationPath::Translation;
	EInterpolation Interpolation = EInterpolation::Linear;
	std::vector<float> Times;      ///< ascending
	std::vector<glm::vec4> Values; ///< xyz or quaternion xyzw; three per key for cubic splines
};

struct FHostAnimation
{
	std::string Name;
	std::vector<FHostChannel> Channels;
	float Duration = 0.0f;
};

/// A light whose position, direction (−z) and tangent (x) are those of its node. Its Profile is an index of Profiles, plus 1; 0: none.
struct FHostLight : FSceneLight
{
	FHostLight() { Color = glm::vec3(1); }
	std::string Name;
	/// A square wave for lights that flicker or are switched: on for FlickerDuty of each period, off for the rest. A period
	/// begins FlickerPhase periods before time 0. Not for directional lights, which shine as the sun.
	float FlickerHz = 0.0f; ///< 0: always on
	float FlickerDuty = 0.5f, FlickerPhase = 0.0f;
};

struct FHostCamera
{
	float FovY = 1.0f; ///< radians
	float Near = 0.1f;
};

struct FSceneDescription
{
	std::string Name;
	std::vector<FHostImage> Images;
	std::vector<FHostTexture> Textures;
	std::vector<FHostMaterial> Materials; ///< > 0
	std::vector<FHostMesh> Meshes;
	std::vector<FHostNode> Nodes;
	std::vector<FHostSkin> Skins;
	std::vector<FHostAnimation> Animations;
	std::vector<FHostLight> Lights;
	std::vector<FProfileGrid> Profiles; ///< of lights
	std::vector<FHostCamera> Cameras;
	std::vector<std::string> Warnings; ///< one line each, with their place; the caller of the loader logs them
	/// Defaults that a built-in scene suggests; the command line overrides them.
	std::optional<glm::vec3> DefaultSky; ///< uniform radiance
	std::optional<glm::vec4> DefaultSun; ///< xyz: direction in which the light travels; w: irradiance
	float DefaultSunDiameter = 0.53f;    ///< degrees
	float DefaultExposure = 0.0f;        ///< EV
};

/// World transforms at one time.
struct FScenePose
{
	std::vector<glm::dmat4> World; ///< per node
};

/// Samples all animations at Time (seconds, looped) and composes world transforms.
FScenePose EvaluatePose(const FSceneDescription& Scene, double Time);

/// Whether the light is on at Time (seconds). At the moment of a switch, the new state counts.
bool IsLightOn(const FHostLight& Light, double Time);

/// Returns the joint matrices of Node's skin, in the model space of the skinned node (glTF 2.0 §3.7.3.3).
std::vector<glm::mat4> EvaluateJoints(const FSceneDescription& Scene, const FScenePose& Pose, int32_t Node);

/// Computes the world-space bounds of all meshes in the pose, skinned meshes included. Returns false if there are none.
bool GetSceneBounds(const FSceneDescription& Scene, const FScenePose& Pose, glm::dvec3& OutMin, glm::dvec3& OutMax);

} // namespace Lantern
