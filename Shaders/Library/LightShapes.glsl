// Points on lights with an extent. Each function samples one as a surface at the coordinates' origin sees it, and returns the
// solid angle by which its radiance must be multiplied: the inverse of the pdf, or 0 if the point shines elsewhere.
// ToCenter: from the surface to the light's centre, metres. U: in [0, 1).
#ifndef LANTERN_LIGHT_SHAPES_GLSL
#define LANTERN_LIGHT_SHAPES_GLSL

#include "../Shared/SceneTypes.h"
#include "Sampling.glsl"

// Solid angles below this are sampled by area: the difference of four angles, which spherical sampling takes, has lost its digits.
const float LeastSphericalRectangle = 0.01; // sr

// Uniform in the sphere of directions.
vec3 SampleUniformSphere(vec2 U)
{
	float Z = 1.0 - 2.0 * U.x;
	float R = sqrt(max(0.0, 1.0 - Z * Z));
	return vec3(R * cos(2.0 * Pi * U.y), R * sin(2.0 * Pi * U.y), Z);
}

// Uniform in the cone that the sphere fills. Inside it, the sphere shines from all around.
float SampleSphere(vec3 ToCenter, float Radius, vec2 U, out vec3 Direction, out float Distance)
{
	float DistanceSquared = dot(ToCenter, ToCenter);
	float RadiusSquared = Radius * Radius;
	if (DistanceSquared <= RadiusSquared)
	{
		Direction = SampleUniformSphere(U);
		float Along = dot(Direction, ToCenter);
		Distance = Along + sqrt(max(Along * Along - DistanceSquared + RadiusSquared, 0.0));
		return 4.0 * Pi;
	}
	float SinSquared = RadiusSquared / DistanceSquared;
	float OneMinusCos = SinSquared / (1.0 + sqrt(1.0 - SinSquared));
	vec3 Local = SampleCone(U, OneMinusCos);
	float CenterDistance = sqrt(DistanceSquared);
	Direction = MakeBasis(ToCenter / CenterDistance) * Local;
	Distance = CenterDistance * Local.z - sqrt(max(RadiusSquared - DistanceSquared * dot(Local.xy, Local.xy), 0.0));
	return 2.0 * Pi * OneMinusCos;
}

// Returns the solid angle of a sample that was uniform over Area, at Point.
float AreaSample(vec3 Point, vec3 Normal, float Area, bool bTwoSided, out vec3 Direction, out float Distance)
{
	float DistanceSquared = max(dot(Point, Point), 1.0e-12);
	Distance = sqrt(DistanceSquared);
	Direction = Point / Distance;
	float Cosine = -dot(Normal, Direction);
	return (bTwoSided ? abs(Cosine) : max(Cosine, 0.0)) * Area / DistanceSquared;
}

float SampleDiskLight(vec3 ToCenter, vec3 Normal, float Radius, bool bTwoSided, vec2 U, out vec3 Direction, out float Distance)
{
	vec3 Point = ToCenter + MakeBasis(Normal) * vec3(Radius * SampleDisk(U), 0.0);
	return AreaSample(Point, Normal, Pi * Radius * Radius, bTwoSided, Direction, Distance);
}

// Uniform in the solid angle of the rectangle (Ureña et al. 2013, "An Area-Preserving Parametrization for Spherical Rectangles").
// Half: half its width, along Tangent, and half its height.
float SampleRectangle(vec3 ToCenter, vec3 Tangent, vec3 Normal, vec2 Half, bool bTwoSided, vec2 U, out vec3 Direction, out float Distance)
{
	vec3 Bitangent = cross(Normal, Tangent);
	float Height = dot(ToCenter, Normal);
	// Coordinates of the corners in a frame in which the rectangle lies at z < 0.
	vec2 Center = vec2(dot(ToCenter, Tangent), dot(ToCenter, Bitangent));
	vec2 Low = Center - Half, High = Center + Half;
	float Z = -max(abs(Height), 1.0e-6);
	// z of the normals of the four planes through an edge.
	vec2 LowZ = -Low * inversesqrt(Z * Z + Low * Low), HighZ = High * inversesqrt(Z * Z + High * High);
	float Angle0 = AccurateAcos(-LowZ.y * HighZ.x), Angle1 = AccurateAcos(-HighZ.x * HighZ.y);
	float Angle2 = AccurateAcos(-HighZ.y * LowZ.x), Angle3 = AccurateAcos(-LowZ.x * LowZ.y);
	float SolidAngle = Angle0 + Angle1 + Angle2 + Angle3 - 2.0 * Pi;
	if (!bTwoSided && Height >= 0.0) { SolidAngle = 0.0; } // its back
	if (SolidAngle < LeastSphericalRectangle)
	{
		vec2 At = (2.0 * U - 1.0) * Half;
		vec3 Point = ToCenter + Tangent * At.x + Bitangent * At.y;
		return AreaSample(Point, Normal, 4.0 * Half.x * Half.y, bTwoSided, Direction, Distance);
	}
	float Phi = U.x * SolidAngle + 2.0 * Pi - Angle2 - Angle3;
	float SinPhi = sin(Phi);
	float F = (cos(Phi) * LowZ.y - HighZ.y) / (abs(SinPhi) > 1.0e-7 ? SinPhi : 1.0e-7);
	float Cu = clamp((F > 0.0 ? 1.0 : -1.0) * inversesqrt(F * F + LowZ.y * LowZ.y), -0.9999999, 0.9999999);
	float X = clamp(-Cu * Z * inversesqrt(1.0 - Cu * Cu), Low.x, High.x);
	float AcrossSquared = X * X + Z * Z;
	float First = Low.y * inversesqrt(AcrossSquared + Low.y * Low.y), Last = High.y * inversesqrt(AcrossSquared + High.y * High.y);
	float Sine = First + U.y * (Last - First);
	float Y = Sine * Sine < 0.999999 ? clamp(Sine * sqrt(AcrossSquared) * inversesqrt(1.0 - Sine * Sine), Low.y, High.y) : (Sine < 0.0 ? Low.y : High.y);
	vec3 Point = Tangent * X + Bitangent * Y + Normal * (Height < 0.0 ? Z : -Z);
	Distance = length(Point);
	Direction = Point / Distance;
	return SolidAngle;
}

// A capsule: the side of a cylinder, sampled by area where it is seen, and two rounded ends.
float SampleTube(vec3 ToCenter, vec3 Axis, float Radius, float HalfLength, vec2 U, out vec3 Direction, out float Distance)
{
	float Along = dot(ToCenter, Axis);
	vec3 Across = ToCenter - Axis * Along;
	vec3 ToNearest = ToCenter - Axis * clamp(Along, -HalfLength, HalfLength);
	if (dot(ToNearest, ToNearest) <= Radius * Radius)
	{
		Direction = SampleUniformSphere(U);
		Distance = 0.0;
		return 4.0 * Pi;
	}
	float AxisDistance = length(Across);
	// Shares by the areas that are seen from afar.
	float Sine = max(AxisDistance * inversesqrt(dot(ToCenter, ToCenter)), 0.1);
	float SideArea = 4.0 * HalfLength * Sine, EndArea = Pi * Radius;
	float SideShare = AxisDistance > Radius ? SideArea / (SideArea + EndArea) : 0.0;
	if (U.x < SideShare)
	{
		vec3 Near = -Across / AxisDistance;
		float Half = AccurateAcos(Radius / AxisDistance); // of the arc that is seen
		float Phi = (2.0 * U.x / SideShare - 1.0) * Half;
		vec3 Normal = Near * cos(Phi) + cross(Axis, Near) * sin(Phi);
		vec3 Point = ToCenter + Axis * ((2.0 * U.y - 1.0) * HalfLength) + Normal * Radius;
		return AreaSample(Point, Normal, 4.0 * Half * Radius * HalfLength, false, Direction, Distance) / SideShare;
	}
	float EndShare = 0.5 * (1.0 - SideShare);
	float Choice = (U.x - SideShare) / EndShare; // 0 to 2
	float End = Choice < 1.0 ? -1.0 : 1.0;
	vec3 ToEnd = ToCenter + Axis * (End * HalfLength);
	float SolidAngle = SampleSphere(ToEnd, Radius, vec2(clamp(Choice - (End > 0.0 ? 1.0 : 0.0), 0.0, 0.99999994), U.y), Direction, Distance);
	bool bRounded = End * dot(Direction * Distance - ToEnd, Axis) > 0.0; // the other half of the sphere is within the tube
	return bRounded ? SolidAngle / EndShare : 0.0;
}

// Returns how far the light reaches from its centre, metres.
float LightReach(uint Type, vec2 Size)
{
	return Type == LIGHT_RECTANGLE ? length(Size) : Type == LIGHT_TUBE ? Size.x + Size.y : Size.x;
}

// Returns the light's area as seen from the surface, m², at least a tenth of it: not exact, and 0 only at the back of a flat light.
float LightProjectedArea(uint Type, vec2 Size, vec3 ToCenter, vec3 Normal, bool bTwoSided)
{
	if (Type == LIGHT_SPHERE) { return Pi * Size.x * Size.x; }
	if (Type == LIGHT_TUBE) { return Pi * Size.x * Size.x + 4.0 * Size.x * Size.y; }
	float Height = -dot(Normal, ToCenter);
	if (!bTwoSided && Height <= 0.0) { return 0.0; }
	float Cosine = abs(Height) * inversesqrt(max(dot(ToCenter, ToCenter), 1.0e-12));
	return (Type == LIGHT_RECTANGLE ? 4.0 * Size.x * Size.y : Pi * Size.x * Size.x) * max(Cosine, 0.1);
}

#endif
