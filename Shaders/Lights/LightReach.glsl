// Where light cells lie, and which lights reach them. A light that brings anything to a point of a box passes the test of the box,
// whatever rounding does; others may.
#ifndef LANTERN_LIGHT_REACH_GLSL
#define LANTERN_LIGHT_REACH_GLSL

#include "../Library/LightCells.glsl"
#include "../Library/Lights.glsl"

layout(buffer_reference, scalar, buffer_reference_align = 4) buffer FLightCellArgumentsRef { FLightCellArguments Data; };
layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer FLightReachRef { FLightReach Data[]; };

struct FLightBox
{
	ivec3 Center; // steps, as FLightGrid::Origin
	float Half;   // edge, metres
	float Margin; // metres, by which rounding in shaders may be off
};

// Returns the box of a cell or a block. Its lowest corner is at Corner.
FLightBox MakeLightBox(FLightGrid Grid, ivec3 Corner, uint EdgeShift)
{
	int HalfSteps = 1 << (EdgeShift - 1u);
	FLightBox Box;
	Box.Center = Corner + HalfSteps;
	Box.Half = float(HalfSteps) / LIGHT_POSITION_STEPS;
	// Positions relative to the scene's origin have 24 bits, and so have differences of them.
	vec3 FromOrigin = abs(vec3(Box.Center - Grid.Origin)) / LIGHT_POSITION_STEPS;
	Box.Margin = 1.0e-5 * (MaxComponent(FromOrigin) + Box.Half);
	return Box;
}

// Returns the lowest corner of the cell or block in place Index of FLightCell[], as the grid lies in this frame.
ivec3 FindLightCorner(FLightGrid Grid, uint Index, out uint Level, out uint EdgeShift)
{
	bool bBlock = Index >= LIGHT_CELLS;
	uint Less = bBlock ? LIGHT_BLOCK_BITS : 0u;
	uvec3 Bits = uvec3(LIGHT_CELL_BITS_X, LIGHT_CELL_BITS_Y, LIGHT_CELL_BITS_Z) - Less;
	uint PerLevel = bBlock ? LIGHT_BLOCKS_PER_LEVEL : LIGHT_CELLS_PER_LEVEL;
	uint Local = bBlock ? Index - LIGHT_CELLS : Index;
	Level = Local / PerLevel;
	uint InLevel = Local % PerLevel;
	EdgeShift = Grid.Shift + Level + Less;
	uvec3 Place = uvec3(InLevel, InLevel >> Bits.x, InLevel >> (Bits.x + Bits.y)) & ((uvec3(1u) << Bits) - 1u);
	uvec3 First = uvec3(Grid.First[Level]) >> EdgeShift;
	return ivec3((First + ((Place - First) & ((uvec3(1u) << Bits) - 1u))) << EdgeShift);
}

// Returns the vector from the box's centre to a light's position, metres. The difference of integers is exact.
vec3 FromBox(FLightBox Box, ivec3 Position) { return vec3(Position + LIGHT_CELL_OFFSET - Box.Center) / LIGHT_POSITION_STEPS; }

// Whether a sphere of Radius around FromCenter touches the box.
bool TouchesBox(FLightBox Box, vec3 FromCenter, float Radius)
{
	vec3 Outside = max(abs(FromCenter) - Box.Half, 0.0);
	float Reach = Radius * 1.00001 + Box.Margin + 1.0e-5 * MaxComponent(abs(FromCenter));
	return dot(Outside, Outside) <= Reach * Reach;
}

bool ReachesEverywhere(FLightData Light) { return LightType(Light) == LIGHT_DIRECTIONAL || Light.Range <= 0.0; }

// Whether a light of finite range may reach a point of the box.
bool ReachesBox(FLightData Light, FLightBox Box)
{
	vec3 FromCenter = FromBox(Box, Light.Position);
	if (!TouchesBox(Box, FromCenter, Light.Range)) { return false; }
	uint Type = LightType(Light);
	bool bFlat = (Type == LIGHT_RECTANGLE || Type == LIGHT_DISK) && (Light.Flags & LIGHT_TWO_SIDED) == 0u;
	bool bCone = (Light.Flags & LIGHT_HAS_CONE) != 0u;
	if (!bFlat && !bCone) { return true; }
	vec3 Direction = UnpackOct(Light.Direction);
	float Along = -dot(FromCenter, Direction); // of the box's centre, from the light
	float Margin = Box.Margin + 1.0e-5 * (MaxComponent(abs(FromCenter)) + Box.Half);
	if (bFlat && Along + Box.Half * dot(abs(Direction), vec3(1.0)) + Margin <= 0.0) { return false; }
	if (!bCone) { return true; }
	// A sphere around the box lies farther from the cone's surface than its radius. The angle is a little wider than the light's, since
	// shaders compare cosines, which rounding changes.
	float CosOuter = clamp(-Light.SpotOffset / Light.SpotScale - 4.0e-6, -1.0, 1.0);
	float SinOuter = sqrt(max(1.0 - CosOuter * CosOuter, 0.0));
	float Aside = sqrt(max(dot(FromCenter, FromCenter) - Along * Along, 0.0));
	float Rounding = 1.0e-3 * length(FromCenter); // of Aside where it is small
	return Aside * CosOuter - Along * SinOuter <= Box.Half * 1.7320509 + Margin + Rounding;
}

#endif
