// Checks the promises of SceneDescription.h.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "LanternCore/Text/Quote.h"
#include "LanternHost/SceneLoader.h"

namespace Lantern
{

namespace
{

// Beyond this, squares of distances overflow a float on the GPU.
constexpr double MaxCoordinate = 1e15;

bool IsIndex(int32_t Index, size_t Size) { return Index >= 0 && size_t(Index) < Size; }

bool IsIndexOrNone(int32_t Index, size_t Size) { return Index == -1 || IsIndex(Index, Size); }

bool IsFinite(const glm::vec3& V) { return std::isfinite(V.x) && std::isfinite(V.y) && std::isfinite(V.z); }

std::string ValidateMaterials(const FSceneDescription& Scene)
{
	for (size_t I = 0; I < Scene.Images.size(); ++I)
	{
		const FHostImage& Image = Scene.Images[I];
		if (Image.Width == 0 || Image.Height == 0 || Image.Rgba.size() != size_t(Image.Width) * Image.Height * 4)
		{
			return fmt::format("image {} {}: size and pixels disagree", I, Quote(Image.Name));
		}
	}
	for (size_t I = 0; I < Scene.Textures.size(); ++I)
	{
		if (!IsIndex(Scene.Textures[I].Image, Scene.Images.size()))
		{
			return fmt::format("texture {}: there is no image {}", I, Scene.Textures[I].Image);
		}
	}
	for (size_t I = 0; I < Scene.Materials.size(); ++I)
	{
		for (const FHostTextureSlot& Slot : Scene.Materials[I].Slots)
		{
			if (!IsIndexOrNone(Slot.Texture, Scene.Textures.size()) || Slot.UVSet > 1)
			{
				return fmt::format("material {} {}: texture slot out of range", I, Quote(Scene.Materials[I].Name));
			}
		}
	}
	return Scene.Materials.empty() ? "there are no materials" : std::string();
}

std::string ValidateMesh(const FSceneDescription& Scene, const FHostMesh& Mesh)
{
	if (Mesh.Attributes.size() != Mesh.Positions.size() || (!Mesh.Skin.empty() && Mesh.Skin.size() != Mesh.Positions.size()))
	{
		return "positions and attributes differ in number";
	}
	for (size_t I = 0; I < Mesh.Positions.size(); ++I)
	{
		if (!IsFinite(Mesh.Positions[I])) { return fmt::format("the position of vertex {} is not finite", I); }
	}
	for (size_t I = 0; I < Mesh.Indices.size(); ++I)
	{
		if (Mesh.Indices[I] >= Mesh.Positions.size())
		{
			return fmt::format("index {} is {}, but there are {} vertices", I, Mesh.Indices[I], Mesh.Positions.size());
		}
	}
	for (size_t I = 0; I < Mesh.Sections.size(); ++I)
	{
		const FHostSection& Section = Mesh.Sections[I];
		if (Section.IndexCount == 0 || Section.IndexCount % 3 != 0 ||
		    uint64_t(Section.FirstIndex) + Section.IndexCount > Mesh.Indices.size() || !IsIndex(Section.Material, Scene.Materials.size()))
		{
			return fmt::format("section {} is out of range", I);
		}
	}
	return Mesh.Sections.empty() ? "there are no sections" : std::string();
}

/// Returns the highest joint index that each mesh uses.
std::vector<uint16_t> FindMaxJoints(const FSceneDescription& Scene)
{
	std::vector<uint16_t> Result(Scene.Meshes.size(), 0);
	for (size_t I = 0; I < Scene.Meshes.size(); ++I)
	{
		for (const FSkinWeights& Weights : Scene.Meshes[I].Skin)
		{
			Result[I] = std::max(Result[I], *std::max_element(Weights.Joints.begin(), Weights.Joints.end()));
		}
	}
	return Result;
}

std::string ValidateNode(const FSceneDescription& Scene, const std::vector<uint16_t>& MaxJoints, const FHostNode& Node, size_t Index)
{
	if (Node.Parent < -1 || Node.Parent >= int64_t(Index))
	{
		return fmt::format("its parent is {}, which does not come before it", Node.Parent);
	}
	if (!IsIndexOrNone(Node.Mesh, Scene.Meshes.size()) || !IsIndexOrNone(Node.Light, Scene.Lights.size()) ||
	    !IsIndexOrNone(Node.Camera, Scene.Cameras.size()) || !IsIndexOrNone(Node.Skin, Scene.Skins.size()))
	{
		return "mesh, light, camera or skin out of range";
	}
	if (Node.Skin >= 0 && (Node.Mesh < 0 || Scene.Meshes[size_t(Node.Mesh)].Skin.empty())) { return "has a skin but no skinned mesh"; }
	if (Node.Skin >= 0 && size_t(MaxJoints[size_t(Node.Mesh)]) >= Scene.Skins[size_t(Node.Skin)].Joints.size())
	{
		return fmt::format("its mesh refers to joint {}, which its skin does not have", MaxJoints[size_t(Node.Mesh)]);
	}
	return {};
}

std::string ValidateSkins(const FSceneDescription& Scene)
{
	for (size_t I = 0; I < Scene.Skins.size(); ++I)
	{
		const FHostSkin& Skin = Scene.Skins[I];
		bool bValid = Skin.Joints.size() == Skin.InverseBind.size();
		for (const int32_t Joint : Skin.Joints) { bValid = bValid && IsIndex(Joint, Scene.Nodes.size()); }
		if (!bValid) { return fmt::format("skin {}: joints out of range", I); }
	}
	for (size_t I = 0; I < Scene.Animations.size(); ++I)
	{
		for (const FHostChannel& Channel : Scene.Animations[I].Channels)
		{
			const size_t PerKey = Channel.Interpolation == EInterpolation::CubicSpline ? 3 : 1;
			if (!IsIndex(Channel.Node, Scene.Nodes.size()) || Channel.Times.empty() ||
			    Channel.Values.size() != Channel.Times.size() * PerKey)
			{
				return fmt::format("animation {}: a channel is out of range", I);
			}
		}
	}
	return {};
}

std::string ValidateLights(const FSceneDescription& Scene)
{
	for (size_t I = 0; I < Scene.Lights.size(); ++I)
	{
		const FHostLight& Light = Scene.Lights[I];
		const bool bWave = Light.FlickerHz >= 0.0f && std::isfinite(Light.FlickerHz) && std::isfinite(Light.FlickerPhase) &&
		                   Light.FlickerDuty >= 0.0f && Light.FlickerDuty <= 1.0f;
		if (!bWave || (Light.FlickerHz > 0.0f && Light.Type == LIGHT_DIRECTIONAL))
		{
			return fmt::format("light {} {}: flickers as no light can", I, Quote(Light.Name));
		}
		if (Light.Profile > Scene.Profiles.size() || (Light.Profile != 0 && Light.Type != LIGHT_POINT))
		{
			return fmt::format("light {} {}: its profile is out of range, or it is no point light", I, Quote(Light.Name));
		}
	}
	return {};
}

/// Checks world transforms at the start, since products of finite transforms need not be finite.
std::string ValidatePlaces(const FSceneDescription& Scene)
{
	const FScenePose Pose = EvaluatePose(Scene, 0.0);
	for (size_t I = 0; I < Scene.Nodes.size(); ++I)
	{
		for (int C = 0; C < 16; ++C)
		{
			if (!(std::abs(Pose.World[I][C / 4][C % 4]) < MaxCoordinate))
			{
				return fmt::format(
				    "node {} {}: its place or size in the world is beyond {:g} m", I, Quote(Scene.Nodes[I].Name), MaxCoordinate);
			}
		}
	}
	glm::dvec3 Min, Max;
	if (GetSceneBounds(Scene, Pose, Min, Max))
	{
		for (int C = 0; C < 3; ++C)
		{
			if (!(std::abs(Min[C]) < MaxCoordinate && std::abs(Max[C]) < MaxCoordinate))
			{
				return fmt::format("the scene reaches beyond {:g} m", MaxCoordinate);
			}
		}
	}
	return {};
}

} // namespace

std::string ValidateScene(const FSceneDescription& Scene)
{
	if (const std::string Error = ValidateMaterials(Scene); !Error.empty()) { return Error; }
	for (size_t I = 0; I < Scene.Meshes.size(); ++I)
	{
		if (const std::string Error = ValidateMesh(Scene, Scene.Meshes[I]); !Error.empty())
		{
			return fmt::format("mesh {} {}: {}", I, Quote(Scene.Meshes[I].Name), Error);
		}
	}
	const std::vector<uint16_t> MaxJoints = FindMaxJoints(Scene);
	for (size_t I = 0; I < Scene.Nodes.size(); ++I)
	{
		if (const std::string Error = ValidateNode(Scene, MaxJoints, Scene.Nodes[I], I); !Error.empty())
		{
			return fmt::format("node {} {}: {}", I, Quote(Scene.Nodes[I].Name), Error);
		}
	}
	if (const std::string Error = ValidateSkins(Scene); !Error.empty()) { return Error; }
	if (const std::string Error = ValidateLights(Scene); !Error.empty()) { return Error; }
	return ValidatePlaces(Scene);
}

} // namespace Lantern
