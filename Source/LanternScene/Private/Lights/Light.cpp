// Lights as shaders see them.
#include "LanternScene/Lights/Light.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "LanternScene/Geometry/Octahedral.h"

namespace Lantern
{

namespace
{
uint32_t PackDirection(const glm::dvec3& V) { return PackOctahedral(glm::vec3(glm::normalize(V))); }

/// Steps of a coordinate, modulo 2³²: differences of lights and origin are right wherever both are.
int32_t PackCoordinate(double Metres)
{
	double Steps = std::round(Metres * double(LIGHT_POSITION_STEPS));
	// The remainder takes tens of nanoseconds, and a conversion drops the higher bits as well.
	if (!(std::abs(Steps) < 0x1p62)) { Steps = std::remainder(Steps, 0x1p32); }
	return static_cast<int32_t>(static_cast<uint32_t>(static_cast<int64_t>(Steps)));
}

/// KHR_lights_punctual, "Inner and Outer Cone Angles".
void PackCone(const FSceneLight& Light, FLightData& Out)
{
	const float CosOuter = std::cos(Light.OuterCone);
	Out.SpotScale = 1.0f / std::max(0.001f, std::cos(Light.InnerCone) - CosOuter);
	Out.SpotOffset = -CosOuter * Out.SpotScale;
	Out.Flags |= LIGHT_HAS_CONE;
}

glm::vec2 PackSize(const FSceneLight& Light)
{
	switch (Light.Type)
	{
	case LIGHT_RECTANGLE: return 0.5f * Light.Size;
	case LIGHT_TUBE: return {Light.Size.x, 0.5f * Light.Size.y};
	case LIGHT_DIRECTIONAL:
	{
		// 1 − cos r = 2 sin²(r/2): the difference itself would lose all digits for a small disk.
		const double HalfSin = std::sin(0.25 * double(Light.Size.x));
		return {static_cast<float>(2.0 * HalfSin * HalfSin), 0.0f};
	}
	default: return {Light.Size.x, 0.0f};
	}
}

/// The tangent at a right angle to the direction, where that counts.
glm::dvec3 MakeTangent(const FSceneLight& Light)
{
	const glm::dvec3 Tangent(Light.Tangent);
	if (Light.Type != LIGHT_RECTANGLE && Light.Profile == 0) { return Tangent; }
	const glm::dvec3 Normal = glm::normalize(glm::dvec3(Light.Direction));
	const glm::dvec3 Across = glm::normalize(Tangent) - glm::dot(glm::normalize(Tangent), Normal) * Normal;
	if (Light.Profile == 0 || glm::length(Across) > 1e-3) { return Across; }
	return glm::cross(Normal, std::abs(Normal.x) < 0.5 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0));
}
} // namespace

ELightKind GetLightKind(const FSceneLight& Light)
{
	switch (Light.Type)
	{
	case LIGHT_DIRECTIONAL: return ELightKind::Directional;
	case LIGHT_RECTANGLE:
	case LIGHT_DISK: return ELightKind::Rect;
	default: return Light.OuterCone > 0.0f ? ELightKind::Spot : ELightKind::Point;
	}
}

bool HasExtent(const FSceneLight& Light) { return Light.Type != LIGHT_POINT && (Light.Type != LIGHT_DIRECTIONAL || Light.Size.x > 0.0f); }

bool ReachesEverywhere(const FSceneLight& Light) { return Light.Type == LIGHT_DIRECTIONAL || Light.Range <= 0.0f; }

FLightReach GetReach(const FSceneLight& Light)
{
	FLightReach Out{glm::ivec3(0), 0.0f};
	if (ReachesEverywhere(Light)) { return Out; }
	for (int Axis = 0; Axis < 3; ++Axis) { Out.Position[Axis] = PackCoordinate(Light.Position[Axis]); }
	Out.Radius = Light.Range;
	return Out;
}

bool ReachAlike(const FSceneLight& A, const FSceneLight& B)
{
	if (ReachesEverywhere(A) || ReachesEverywhere(B)) { return ReachesEverywhere(A) && ReachesEverywhere(B); }
	return A.Type == B.Type && A.Position == B.Position && A.Range == B.Range && A.Direction == B.Direction && A.InnerCone == B.InnerCone &&
	       A.OuterCone == B.OuterCone && A.bTwoSided == B.bTwoSided;
}

namespace
{
double GetLuminance(const glm::vec3& Color) { return glm::dot(glm::dvec3(Color), glm::dvec3(0.2126, 0.7152, 0.0722)); }

/// By which Color makes an intensity: square metres, or 1 of what has no extent.
double GetLargestFace(const FSceneLight& Light)
{
	const double X = Light.Size.x, Y = Light.Size.y;
	switch (Light.Type)
	{
	case LIGHT_RECTANGLE: return X * Y;
	case LIGHT_DISK:
	case LIGHT_SPHERE: return glm::pi<double>() * X * X;
	case LIGHT_TUBE: return 2.0 * X * Y + glm::pi<double>() * X * X;
	default: return 1.0;
	}
}

/// Whether only colours, places, directions and ranges differ.
bool ShineAlike(const FSceneLight& A, const FSceneLight& B)
{
	return A.Type == B.Type && A.InnerCone == B.InnerCone && A.OuterCone == B.OuterCone && A.Size == B.Size &&
	       A.bCastsShadow == B.bCastsShadow && A.bTwoSided == B.bTwoSided && A.Profile == B.Profile && A.Channels == B.Channels;
}

double GetAngle(const glm::vec3& A, const glm::vec3& B)
{
	return std::acos(std::clamp(glm::dot(glm::normalize(glm::dvec3(A)), glm::normalize(glm::dvec3(B))), -1.0, 1.0));
}

/// Returns which part of a light comes from or goes to elsewhere because it has turned.
double GetTurnedPart(const FSceneLight& Before, const FSceneLight& After)
{
	const bool bFlat = After.Type == LIGHT_RECTANGLE || After.Type == LIGHT_DISK, bDirectional = After.Type == LIGHT_DIRECTIONAL;
	double Part = 0.0;
	if ((bFlat || bDirectional || After.OuterCone > 0.0f || After.Profile != 0) && Before.Direction != After.Direction)
	{
		const double Width = bDirectional ? glm::radians(1.0) : After.OuterCone > 0.0f ? double(After.OuterCone) : 1.0;
		Part = GetAngle(Before.Direction, After.Direction) / Width;
	}
	const bool bTangent = After.Type == LIGHT_RECTANGLE || After.Type == LIGHT_TUBE || After.Profile != 0;
	if (bTangent && Before.Tangent != After.Tangent) { Part += GetAngle(Before.Tangent, After.Tangent); }
	return std::min(Part, 1.0);
}
} // namespace

double GetPeakIntensity(const FSceneLight& Light) { return GetLuminance(Light.Color) * GetLargestFace(Light); }

FLightChange CompareLights(uint32_t Slot, const FSceneLight& Before, const FSceneLight& After)
{
	const double Greater = std::max(GetPeakIntensity(Before), GetPeakIntensity(After));
	FLightChange Change;
	Change.Slot = Slot;
	Change.bDirectional = After.Type == LIGHT_DIRECTIONAL;
	Change.Position = Change.bDirectional ? glm::dvec3(0) : After.Position;
	const bool bEndless = ReachesEverywhere(Before) || ReachesEverywhere(After);
	Change.Range = bEndless ? 0.0 : double(std::max(Before.Range, After.Range));
	const double Difference = GetLuminance(glm::abs(After.Color - Before.Color)) * GetLargestFace(After);
	const bool bAlike = ShineAlike(Before, After) && Before.Range == After.Range;
	Change.Strength = bAlike ? std::min(std::max(Difference, Greater * GetTurnedPart(Before, After)), Greater) : Greater;
	Change.Moved = Change.bDirectional ? 0.0 : glm::length(After.Position - Before.Position) * Greater;
	Change.Part = Greater > 0.0 ? Change.Strength / Greater : 0.0;
	return Change;
}

FLightData PackLight(const FSceneLight& Light)
{
	assert(Light.Type != LIGHT_NONE && Light.Type <= LIGHT_TUBE);
	FLightData Out{};
	Out.Flags = Light.Type;
	Out.Flags |= Light.bCastsShadow ? LIGHT_CASTS_SHADOW : 0u;
	Out.Flags |= Light.bTwoSided ? LIGHT_TWO_SIDED : 0u;
	Out.Flags |= Light.bLightsFog ? LIGHT_IN_FOG : 0u;
	assert(Light.Profile <= LIGHT_PROFILES_MOST && (Light.Profile == 0 || Light.Type == LIGHT_POINT));
	Out.Flags |= ((Light.Channels ^ CHANNELS_DEFAULT) << LIGHT_CHANNELS_SHIFT) | (Light.Profile << LIGHT_PROFILE_SHIFT);
	for (int Axis = 0; Axis < 3; ++Axis) { Out.Position[Axis] = PackCoordinate(Light.Position[Axis]); }
	Out.Color = Light.Color;
	Out.Range = Light.Range;
	assert(glm::length(Light.Direction) > 0.0f && glm::length(MakeTangent(Light)) > 0.0);
	Out.Direction = PackDirection(glm::dvec3(Light.Direction));
	Out.Tangent = PackDirection(MakeTangent(Light));
	Out.Size = PackSize(Light);
	Out.Number = Light.Number;
	if (Light.OuterCone > 0.0f && Light.Type != LIGHT_DIRECTIONAL) { PackCone(Light, Out); }
	return Out;
}

} // namespace Lantern
