// By how much each pixel's lobes have changed since the last frame, because lights have: what the filters add to their histories.
// What lights bring is known. Whether they are seen is what the rays of the tile and of those around it said in the last frames.
#version 460
#include "../Shared/LampChangeTypes.h"
#include "../Tiles/Tile.glsl"
#include "Demodulate.glsl"
#include "Guide.glsl"
#ifdef LOCAL_EMISSIVE
#include "ClusterLight.glsl"
#endif

layout(local_size_x = TILE_PIXELS) in;
layout(push_constant, scalar) uniform FPush { FFollowLampsConstants Push; };

layout(buffer_reference, scalar, buffer_reference_align = 4) buffer FLampChangesRef { FLampChanges Data; };

const float MaxHalf = 65504.0;

shared uint Order[LAMP_CHANGES]; // places of the list, by the lights' numbers: sums do not depend on the order of threads
shared vec2 Seen[LAMP_CHANGES];  // expected visibility, and its variance from pixel to pixel

#ifdef LOCAL_EMISSIVE
shared uint EmitterOrder[EMITTER_CHANGES];
shared vec2 EmitterSeen[EMITTER_CHANGES];

layout(buffer_reference, scalar, buffer_reference_align = 8) readonly buffer FBoundsRef { FEmitterCluster Data[]; };
#endif

void SortList(FLampChangesRef List, uint Count, uint Place)
{
	if (Place >= Count) { return; }
	uint Light = List.Data.Changes[Place].Light, Rank = 0u;
	for (uint I = 0u; I < Count; ++I) { Rank += List.Data.Changes[I].Light < Light ? 1u : 0u; }
	Order[Rank] = Place;
}

// Returns the expected visibility of a light from the tile, and its variance.
vec2 ExpectSeen(FViewConstants View, uint Light)
{
	ivec2 Last = ivec2((uvec2(View.Width, View.Height) - 1u) / TILE_SIZE);
	vec2 Rays = vec2(1.0, 0.5); // what is unknown
	for (int I = 0; I < 9; ++I)
	{
		ivec2 Tile = clamp(ivec2(gl_WorkGroupID.xy) + ivec2(I % 3, I / 3) - 1, ivec2(0), Last);
		uint Index = TileIndex(View, uvec2(Tile));
		FGuideLight Found = FTileGuideRef(Push.Guide).Data[Index].Lights[GuidePlace(Light, GuideTileHash(Index))];
		float Weight = (I == 4 ? 1.0 : 0.125) / float(TILE_GUIDE_RAY);
		if (Found.Light == Light) { Rays += Weight * vec2(GuideTraced(Found.Counts), GuideSeen(Found.Counts)); }
	}
	float Visibility = Rays.y / Rays.x;
	return vec2(Visibility, Visibility * (1.0 - Visibility) + 0.25 / Rays.x);
}

// By how much lobes have changed, each with the variance of that.
struct FChange
{
	vec4 Diffuse, Specular;
};

FLobes BringsTo(FSceneConstants Scene, FViewConstants View, FLocalPoint Point, FLocalBrdf Local, float Roughness, uint Number,
                FLightData Light, vec2 U)
{
	const FLobes None = FLobes(vec3(0.0), vec3(0.0));
	if (LightType(Light) == LIGHT_NONE || !SharesChannel(Light, Point.Channels)) { return None; }
	FLightSample Sample = SampleLight(Scene, Light, Point.P, U);
	if (!ReachesLight(View, Point, Sample)) { return None; }
	return Demodulate(ReflectLight(Point, Local, Sample, Number), Local.Brdf, dot(Point.Surface.BentN, Point.Surface.V), Roughness);
}

// Known: expected visibility, and its variance.
vec4 WeighLamp(vec3 More, vec2 Known)
{
	float Brightness = Luminance(More);
	return vec4(More * Known.x, Brightness * Brightness * Known.y);
}

// Returns a light of the table as it is now. Slots at its end go when they fall free.
FLightData LoadLamp(FSceneConstants Scene, uint Number)
{
	FLightData Light = FLightRef(Scene.Lights).Data[min(Number, Scene.LightCount - 1u)];
	if (Number >= Scene.LightCount) { Light.Flags = LIGHT_NONE; }
	return Light;
}

#ifdef LOCAL_EMISSIVE
void SortEmitters(FLampChangesRef List, uint Count, uint Place)
{
	if (Place >= Count) { return; }
	uint Cluster = List.Data.Emitters[Place].Cluster, Rank = 0u;
	for (uint I = 0u; I < Count; ++I) { Rank += List.Data.Emitters[I].Cluster < Cluster ? 1u : 0u; }
	EmitterOrder[Rank] = Place;
}

const float ClusterError = 1.0; // of a difference, about
const uint MostPoints = 6u;     // of a row

// Returns the colour of a cluster's light, of luminance 1: that of the middle of its first triangle.
vec3 ClusterColor(FSceneConstants Scene, FEmitterCluster Cluster)
{
	FEmissiveTriangle Triangle = FEmissiveRef(Scene.EmissiveTriangles).Data[min(Cluster.First, Scene.EmissiveTriangleCount - 1u)];
	FSectionData Section = FSectionRef(Scene.Sections).Data[Triangle.Section];
	vec3 Emission = EvaluateLightEmission(FMaterialRef(Scene.Materials).Data[Section.Material], FetchTextureInputs(Section, Triangle.Primitive, vec2(1.0 / 3.0)));
	float Brightness = Luminance(Emission);
	return Brightness > 0.0 ? Emission / Brightness : vec3(1.0);
}

// Returns how many rows and columns of points of a cluster's rectangle tell what lobes reflect of it. Near light comes from all over it, and
// a narrow lobe sees parts alone.
// To: middle of the rectangle, from the surface. Half: of its edges.
uint CountPoints(mat3 Basis, vec3 To, vec2 Half, float Roughness)
{
	vec3 At = To * Basis, Outside = vec3(max(abs(At.xy) - Half, vec2(0.0)), At.z);
	float Part = clamp(2.0 * Roughness * Roughness, 0.15, 0.25); // of the distance that lies between points
	return uint(clamp(ceil(2.0 * max(Half.x, Half.y) / max(Part * length(Outside), 1.0e-6)), 1.0, float(MostPoints)));
}

// Returns about how bright what lobes reflect of a cluster is.
vec2 ClusterBringsTo(FViewConstants View, FLocalPoint Point, FLocalBrdf Local, float Roughness, FEmitterCluster Cluster)
{
	vec3 ToCenter = Cluster.Center - Point.P;
	mat3 Basis = MakeBasis(IsFlat(Cluster) ? Cluster.Normal : NormalizeOr(ToCenter, vec3(0.0, 0.0, 1.0)));
	vec2 Half = vec2(dot(abs(Basis[0]), Cluster.Half), dot(abs(Basis[1]), Cluster.Half));
	uint Rows = CountPoints(Basis, ToCenter, Half, Roughness);
	float Share = 1.0 / float(Rows * Rows);
	FLobes Sum = FLobes(vec3(0.0), vec3(0.0));
	[[dont_unroll]] for (uint I = 0u; I < Rows * Rows; ++I)
	{
		vec2 At = ((vec2(I % Rows, I / Rows) + 0.5) * (2.0 / float(Rows)) - 1.0) * Half;
		vec3 To = ToCenter + Basis[0] * At.x + Basis[1] * At.y;
		float DistanceSquared = max(dot(To, To), 1.0e-8);
		vec3 Direction = To * inversesqrt(DistanceSquared);
		float Facing = max(-dot(Cluster.Normal, Direction), 0.0) + 0.25 * (1.0 - length(Cluster.Normal));
		if (Facing <= 0.0) { continue; }
		float Irradiance = ClusterIrradiance(Cluster, DistanceSquared / (Share * Facing)) / EmissionScale;
		FLightSample Sample = FLightSample(Direction, sqrt(DistanceSquared), vec3(Irradiance), 1.0);
		if (!ReachesLight(View, Point, Sample)) { continue; }
		FLobes Lobes = ReflectLight(Point, Local, Sample, LIGHT_TRIANGLE);
		Sum.Diffuse += Lobes.Diffuse;
		Sum.Specular += Lobes.Specular;
	}
	Sum = Demodulate(Sum, Local.Brdf, dot(Point.Surface.BentN, Point.Surface.V), Roughness);
	return vec2(Luminance(Sum.Diffuse), Luminance(Sum.Specular));
}

vec4 WeighCluster(float More, vec3 Color, vec2 Known)
{
	return vec4(More * Known.x * Color, More * More * (Known.y + ClusterError * ClusterError * Known.x * Known.x));
}

// Adds what emissive triangles have changed.
void FollowEmitters(FSceneConstants Scene, FViewConstants View, FLampChangesRef List, uint Count, FLocalPoint Point, FLocalBrdf Local,
                    float Roughness, inout FChange Sum)
{
	for (uint I = 0u; I < Count; ++I)
	{
		FEmitterChange Change = List.Data.Emitters[EmitterOrder[I]];
		if (Change.Cluster >= Scene.EmissiveClusterCount) { continue; } // memory of an earlier frame
		uint Object = FEmissiveClusterRef(Scene.EmissiveClusters).Data[Change.Cluster].Object;
		vec3 Offset = CellOffset(Scene, FObjectRef(Scene.Objects).Data[Object].Cell);
		FEmitterCluster Now = MoveCluster(FBoundsRef(Scene.EmissiveBounds).Data[Change.Cluster], Offset);
		vec2 More = ClusterBringsTo(View, Point, Local, Roughness, Now) - ClusterBringsTo(View, Point, Local, Roughness, Change.Before);
		if (More == vec2(0.0)) { continue; }
		vec3 Color = ClusterColor(Scene, Now);
		Sum.Diffuse += WeighCluster(More.x, Color, EmitterSeen[I]);
		Sum.Specular += WeighCluster(More.y, Color, EmitterSeen[I]);
	}
}
#endif

const float OtherLampError = 4.0; // variance of how visible a new lamp is, in squares of what is expected

FChange FollowPixel(FSceneConstants Scene, FViewConstants View, FLampChangesRef List, uint Count, uint Emitters, uvec2 Pixel, float Depth)
{
	FLocalPoint Point = LoadLocalPoint(Scene, View, Push.Normals, Push.Channels, Pixel, Depth);
	FLocalBrdf Local = LoadLocalBrdf(Point, Push.BaseColor, Push.Material, Push.BackAlbedo, Pixel, 0.0); // what rays show is of emitters alone
	float Roughness = texelFetch(Textures[Push.Material], ivec2(Pixel), 0).x;
	FChange Sum = FChange(vec4(0.0), vec4(0.0));
	for (uint I = 0u; I < Count; ++I)
	{
		FLampChange Change = List.Data.Changes[Order[I]];
		vec2 U = LocalNumbers(View, Pixel, Change.Light), Known = Seen[I];
		FLightData Now = LoadLamp(Scene, Change.Light);
		FLobes After = BringsTo(Scene, View, Point, Local, Roughness, Change.Light, Now, U);
		FLobes Before = BringsTo(Scene, View, Point, Local, Roughness, Change.Light, Change.Before, U);
		if (((Now.Flags | Change.Before.Flags) & LIGHT_CASTS_SHADOW) == 0u) { Known = vec2(1.0, 0.0); }
		if (Now.Number != Change.Before.Number) { Known.y += OtherLampError * Known.x * Known.x; } // what was seen is of the former lamp
		Sum.Diffuse += WeighLamp(After.Diffuse - Before.Diffuse, Known);
		Sum.Specular += WeighLamp(After.Specular - Before.Specular, Known);
	}
#ifdef LOCAL_EMISSIVE
	FollowEmitters(Scene, View, List, Emitters, Point, Local, Roughness, Sum);
#endif
	Sum.Diffuse.w = sqrt(Sum.Diffuse.w); // a variance leaves the range of fp16 early
	Sum.Specular.w = sqrt(Sum.Specular.w);
	return Sum;
}

void WriteChange(uint Output, uvec2 Pixel, vec4 Change)
{
	if (Output != NO_TEXTURE) { imageStore(Images[Output], ivec2(Pixel), clamp(Change, -MaxHalf, MaxHalf)); }
}

void main()
{
	FViewConstants View = FViewRef(Push.Pass.View).Data;
	FSceneConstants Scene = FSceneRef(Push.Pass.Scene).Data;
	FLampChangesRef List = FLampChangesRef(Push.List);
	bool bTooMany = List.Data.Count > LAMP_CHANGES; // a fresh list says so without any entry
	uint Place = gl_LocalInvocationIndex, Count = bTooMany ? 0u : List.Data.Count;
	uint Emitters = List.Data.EmitterCount > EMITTER_CHANGES ? 0u : List.Data.EmitterCount;
	uvec2 Pixel = TilePixel(gl_WorkGroupID.xy, Place);
#ifdef LOCAL_EMISSIVE
	SortEmitters(List, Emitters, Place);
#endif
	SortList(List, Count, Place);
	barrier();
	if (Place < Count) { Seen[Place] = ExpectSeen(View, List.Data.Changes[Order[Place]].Light); }
#ifdef LOCAL_EMISSIVE
	if (Place < Emitters)
	{
		EmitterSeen[Place] = ExpectSeen(View, List.Data.Emitters[EmitterOrder[Place]].Cluster | LIGHT_TRIANGLE);
	}
#endif
	barrier();
	if (IsOutsideView(View, Pixel)) { return; }
	float Depth = LoadDepth(Push.Depth, ivec2(Pixel));
	FChange Change;
	Change.Diffuse = Change.Specular = vec4(0.0, 0.0, 0.0, bTooMany ? LAMP_CHANGE_UNKNOWN : 0.0);
	if (Depth > 0.0 && !bTooMany) { Change = FollowPixel(Scene, View, List, Count, Emitters, Pixel, Depth); }
	WriteChange(Push.OutDiffuse, Pixel, Change.Diffuse);
	WriteChange(Push.OutSpecular, Pixel, Change.Specular);
}
