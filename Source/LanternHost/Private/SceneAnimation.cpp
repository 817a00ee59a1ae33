// Poses: sampling of animation channels (glTF 2.0, appendix C), and joint matrices.
#include <algorithm>
#include <cmath>

#include <glm/gtc/quaternion.hpp>

#include "LanternHost/SceneDescription.h"

namespace Lantern
{

namespace
{

struct FLocalTransform
{
	glm::dvec3 Translation;
	glm::dquat Rotation;
	glm::dvec3 Scale;
};

glm::dquat ToQuat(const glm::vec4& V) { return glm::dquat(V.w, V.x, V.y, V.z); }

glm::dvec4 NormalizeQuat(const glm::dvec4& V)
{
	const double Length = glm::length(V);
	return Length > 1e-12 ? V / Length : glm::dvec4(0, 0, 0, 1);
}

/// Interpolates between keys Key and Key + 1, at Fraction of their distance Span (seconds).
glm::dvec4 Interpolate(const FHostChannel& Channel, size_t Key, double Fraction, double Span)
{
	if (Channel.Interpolation == EInterpolation::Step) { return Channel.Values[Key]; }
	if (Channel.Interpolation == EInterpolation::Linear)
	{
		const glm::dvec4 A(Channel.Values[Key]), B(Channel.Values[Key + 1]);
		if (Channel.Path != EAnimationPath::Rotation) { return glm::mix(A, B, Fraction); }
		const glm::dquat Q = glm::slerp(glm::normalize(ToQuat(A)), glm::normalize(ToQuat(B)), Fraction);
		return {Q.x, Q.y, Q.z, Q.w};
	}
	// Hermite: values are (in-tangent, value, out-tangent), tangents per second.
	const double T = Fraction, T2 = T * T, T3 = T2 * T;
	const glm::dvec4 P0(Channel.Values[Key * 3 + 1]), M0(Channel.Values[Key * 3 + 2]);
	const glm::dvec4 M1(Channel.Values[Key * 3 + 3]), P1(Channel.Values[Key * 3 + 4]);
	return (2 * T3 - 3 * T2 + 1) * P0 + (T3 - 2 * T2 + T) * Span * M0 + (-2 * T3 + 3 * T2) * P1 + (T3 - T2) * Span * M1;
}

glm::dvec4 Sample(const FHostChannel& Channel, double Time)
{
	const std::vector<float>& Times = Channel.Times;
	const size_t ValueOffset = Channel.Interpolation == EInterpolation::CubicSpline ? 1 : 0;
	const size_t Stride = Channel.Interpolation == EInterpolation::CubicSpline ? 3 : 1;
	const auto After = std::upper_bound(Times.begin(), Times.end(), Time);
	if (After == Times.begin()) { return Channel.Values[ValueOffset]; }
	if (After == Times.end()) { return Channel.Values[(Times.size() - 1) * Stride + ValueOffset]; }
	const size_t Key = size_t(After - Times.begin()) - 1;
	const double Span = double(Times[Key + 1]) - double(Times[Key]);
	return Interpolate(Channel, Key, (Time - double(Times[Key])) / Span, Span);
}

void ApplyAnimation(const FHostAnimation& Animation, double Time, std::vector<FLocalTransform>& Locals)
{
	double Looped = Animation.Duration > 0 ? std::fmod(Time, double(Animation.Duration)) : 0.0;
	Looped = Looped < 0 ? Looped + double(Animation.Duration) : Looped;
	for (const FHostChannel& Channel : Animation.Channels)
	{
		const glm::dvec4 Value = Sample(Channel, Looped);
		FLocalTransform& Local = Locals[size_t(Channel.Node)];
		switch (Channel.Path)
		{
		case EAnimationPath::Translation: Local.Translation = glm::dvec3(Value); break;
		case EAnimationPath::Rotation:
		{
			const glm::dvec4 Unit = NormalizeQuat(Value);
			Local.Rotation = glm::dquat(Unit.w, Unit.x, Unit.y, Unit.z);
			break;
		}
		case EAnimationPath::Scale: Local.Scale = glm::dvec3(Value); break;
		}
	}
}

glm::dmat4 Compose(const FLocalTransform& Local)
{
	const glm::dmat3 Rotation = glm::mat3_cast(Local.Rotation);
	return {glm::dvec4(Rotation[0] * Local.Scale.x, 0), glm::dvec4(Rotation[1] * Local.Scale.y, 0),
	    glm::dvec4(Rotation[2] * Local.Scale.z, 0), glm::dvec4(Local.Translation, 1)};
}

void GrowBounds(const glm::dvec3& Point, bool& bAny, glm::dvec3& Min, glm::dvec3& Max)
{
	Min = bAny ? glm::min(Min, Point) : Point;
	Max = bAny ? glm::max(Max, Point) : Point;
	bAny = true;
}

/// Computes the exact bounds of a skinned mesh in the pose.
void GrowSkinnedBounds(
    const FSceneDescription& Scene, const FScenePose& Pose, int32_t NodeIndex, bool& bAny, glm::dvec3& Min, glm::dvec3& Max)
{
	const FHostMesh& Mesh = Scene.Meshes[size_t(Scene.Nodes[size_t(NodeIndex)].Mesh)];
	const std::vector<glm::mat4> Joints = EvaluateJoints(Scene, Pose, NodeIndex);
	const glm::dmat4& World = Pose.World[size_t(NodeIndex)];
	for (size_t V = 0; V < Mesh.Positions.size(); ++V)
	{
		glm::vec4 Bent(0);
		for (size_t I = 0; I < 4; ++I)
		{
			Bent += Mesh.Skin[V].Weights[I] * (Joints[Mesh.Skin[V].Joints[I]] * glm::vec4(Mesh.Positions[V], 1));
		}
		GrowBounds(glm::dvec3(World * glm::dvec4(glm::dvec3(Bent), 1)), bAny, Min, Max);
	}
}

} // namespace

FScenePose EvaluatePose(const FSceneDescription& Scene, double Time)
{
	FScenePose Pose;
	Pose.World.resize(Scene.Nodes.size());
	std::vector<FLocalTransform> Locals(Scene.Nodes.size());
	for (size_t I = 0; I < Scene.Nodes.size(); ++I)
	{
		const FHostNode& Node = Scene.Nodes[I];
		Locals[I] = {Node.Translation, glm::dquat(Node.Rotation), glm::dvec3(Node.Scale)};
	}
	for (const FHostAnimation& Animation : Scene.Animations) { ApplyAnimation(Animation, Time, Locals); }
	for (size_t I = 0; I < Scene.Nodes.size(); ++I)
	{
		const FHostNode& Node = Scene.Nodes[I];
		const glm::dmat4 Local = Node.Matrix ? *Node.Matrix : Compose(Locals[I]);
		Pose.World[I] = Node.Parent >= 0 ? Pose.World[size_t(Node.Parent)] * Local : Local;
	}
	return Pose;
}

bool IsLightOn(const FHostLight& Light, double Time)
{
	// Tolerates a millionth of a period, since times of frames are sums of rounded numbers.
	const double Periods = Time * double(Light.FlickerHz) + double(Light.FlickerPhase) + 1e-6;
	return Light.FlickerHz <= 0.0f || Periods - std::floor(Periods) < double(Light.FlickerDuty);
}

std::vector<glm::mat4> EvaluateJoints(const FSceneDescription& Scene, const FScenePose& Pose, int32_t Node)
{
	std::vector<glm::mat4> Joints;
	const int32_t SkinIndex = Scene.Nodes[size_t(Node)].Skin;
	if (SkinIndex < 0) { return Joints; }
	const FHostSkin& Skin = Scene.Skins[size_t(SkinIndex)];
	const glm::dmat4& World = Pose.World[size_t(Node)];
	// A node scaled to zero along an axis has no inverse; it shows nothing anyway.
	const double Determinant = glm::determinant(World);
	const glm::dmat4 ToModel = Determinant != 0 && std::isfinite(1.0 / Determinant) ? glm::inverse(World) : glm::dmat4(1);
	Joints.reserve(Skin.Joints.size());
	for (size_t I = 0; I < Skin.Joints.size(); ++I)
	{
		Joints.push_back(glm::mat4(ToModel * Pose.World[size_t(Skin.Joints[I])] * glm::dmat4(Skin.InverseBind[I])));
	}
	return Joints;
}

bool GetSceneBounds(const FSceneDescription& Scene, const FScenePose& Pose, glm::dvec3& OutMin, glm::dvec3& OutMax)
{
	bool bAny = false;
	for (size_t I = 0; I < Scene.Nodes.size(); ++I)
	{
		const FHostNode& Node = Scene.Nodes[I];
		if (Node.Mesh < 0) { continue; }
		if (Node.Skin >= 0)
		{
			GrowSkinnedBounds(Scene, Pose, int32_t(I), bAny, OutMin, OutMax);
			continue;
		}
		const FHostMesh& Mesh = Scene.Meshes[size_t(Node.Mesh)];
		for (int Corner = 0; Corner < 8; ++Corner)
		{
			const glm::dvec3 Point((Corner & 1) != 0 ? Mesh.BoundsMax.x : Mesh.BoundsMin.x,
			    (Corner & 2) != 0 ? Mesh.BoundsMax.y : Mesh.BoundsMin.y, (Corner & 4) != 0 ? Mesh.BoundsMax.z : Mesh.BoundsMin.z);
			GrowBounds(glm::dvec3(Pose.World[I] * glm::dvec4(Point, 1)), bAny, OutMin, OutMax);
		}
	}
	return bAny;
}

} // namespace Lantern
