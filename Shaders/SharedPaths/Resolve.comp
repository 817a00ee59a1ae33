// Lights each pixel by the paths of pixels around it, as if its own. Each path counts by the pixel's cosine, and by the density with which
// all of these pixels together would have drawn it (Bekaert, Sbert & Halton 2002, "Accelerating Path Tracing by Re-Using Paths"). What paths
// meet is taken to be seen by all of the pixels.
// CHECKERBOARD, QUARTER: see Rate.glsl. SECOND_LOBE: specular lobes are lit as well.
// PATH_RESERVOIRS: paths were chosen among many, see PathReservoirs.glsl. Their density is the inverse of their weight.
// NO_REUSE_COSINE: planted fault (r.RT.Debug.GI.ReuseCosine).
#version 460
#include "../Library/BrdfSample.glsl"
#include "../Library/GBuffer.glsl"
#include "../Library/Rate.glsl"
#include "../Library/Rgbe.glsl"
#include "../Shared/SharedPathTypes.h"
#include "../Tiles/Tile.glsl"
#ifdef SECOND_LOBE
#include "../Rays/SecondLobe.glsl"
#endif

layout(local_size_x = TILE_SIZE, local_size_y = TILE_SIZE) in;
layout(push_constant, scalar) uniform FPush { FSharedPathConstants Push; };
layout(buffer_reference, scalar, buffer_reference_align = 4) buffer FSharedPathRef { FSharedPath Data[]; };
layout(buffer_reference, scalar, buffer_reference_align = 4) writeonly buffer FPathChangeRef { FPathChange Data[]; };

#if defined(QUARTER)
const ivec2 Pitch = ivec2(2, 2); // pixels from one site to the next
#elif defined(CHECKERBOARD)
const ivec2 Pitch = ivec2(2, 1);
#else
const ivec2 Pitch = ivec2(1, 1);
#endif
const int Width = 3, Around = Width * Width; // sites that a pixel looks at: its own and those next to it
const ivec2 Side = ivec2(TILE_SIZE) / Pitch + 2;
const int Sites = Side.x * Side.y;
const float MaxHalf = 65504.0;
const uint NoNormal = 0x80008000u; // which packing never gives
const float NoValue = -1.0;        // FDenoiseInputs::bKnownNoise
const float Alone = 0.75;          // sum of squared weights from which on one site counts for nearly all

// Sites: pixels that have traced paths in this frame, those of the tile and of a ring around it.
shared vec3 SitePlaces[Sites];  // relative to the camera
shared uint SiteNormals[Sites]; // shading, octahedral
shared uint SiteFaces[Sites];   // geometric, octahedral; NoNormal: the site shows no surface
shared uint SitePixels[Sites];  // SphereBit | y << 16 | x
shared FSharedPath SitePaths[Sites];
shared vec3 Changes[TILE_PIXELS]; // FPathChange of sites, and sums of them
#ifdef BACK_PIXELS
shared float SiteBacks[Sites]; // chance that a path leaves the back

// The surface of a pixel that shows light from behind.
FBrdf LoadSides(ivec2 Pixel)
{
	FBrdf Brdf = MakeGBufferBrdf(texelFetch(Textures[Push.BaseColor], Pixel, 0), texelFetch(Textures[Push.Material], Pixel, 0));
	AddBackLobe(Push.BackAlbedo, Pixel, Brdf);
	return Brdf;
}
#endif

// Paths that leave a toon sphere do not see what others see: see ChooseGatherMask.
const uint SphereBit = 0x80000000u;
uint SphereOf(ivec2 Pixel)
{
	return Push.ToonPixels != NO_TEXTURE && texelFetch(Textures[Push.ToonPixels], Pixel, 0).x > 0.0 ? SphereBit : 0u;
}

void LoadSites(FViewConstants View)
{
	ivec2 Threads = ivec2(TurnThreads(uvec2(View.Width, View.Height))), First = ivec2(gl_WorkGroupID.xy) * (ivec2(TILE_SIZE) / Pitch) - 1;
	for (int I = int(gl_LocalInvocationIndex); I < Sites; I += int(TILE_PIXELS))
	{
		ivec2 Thread = First + ivec2(I % Side.x, I / Side.x);
		SiteFaces[I] = NoNormal;
		if (any(lessThan(Thread, ivec2(0))) || any(greaterThanEqual(Thread, Threads))) { continue; }
		uvec2 Pixel = min(TurnPixel(uvec2(Thread), View.FrameIndex), uvec2(View.Width, View.Height) - 1u);
		float Depth = LoadDepth(Push.Depth, ivec2(Pixel));
		if (Depth <= 0.0) { continue; }
		FGBufferPoint Point = LoadGBufferPoint(View, Push.Normals, ivec2(Pixel), Depth);
		SitePlaces[I] = Point.Relative;
		SiteNormals[I] = PackOct(Point.BentN);
		SiteFaces[I] = PackOct(Point.Ng);
		SitePixels[I] = SphereOf(ivec2(Pixel)) | (Pixel.y << 16u) | Pixel.x;
#ifdef BACK_PIXELS
		SiteBacks[I] = Point.bBack && Push.BackAlbedo != NO_TEXTURE ? BackChance(LoadSides(ivec2(Pixel))) : 0.0;
#endif
		SitePaths[I] = FSharedPathRef(Push.Shared).Data[Thread.y * Threads.x + Thread.x];
	}
}

vec3 GetSiteChange(int Site)
{
	if (SiteFaces[Site] == NoNormal) { return vec3(0.0); }
	FSharedPath Path = SitePaths[Site];
	float Light = Path.Share > 0.0 ? Luminance(UnpackRgbe(Path.Radiance)) * Path.Share : Luminance(UnpackRgbe(Path.Near));
	float Gone = Light * unpackHalf2x16(Path.SkyAndGone).y;
	return vec3(Light, Gone, Gone * Gone);
}

// Sums the changes of the tile's own paths, in one order whatever that of threads.
void SumChanges(FViewConstants View)
{
	uint Lane = gl_LocalInvocationIndex;
	ivec2 Own = ivec2(TILE_SIZE) / Pitch, Place = ivec2(int(Lane) % Own.x, int(Lane) / Own.x) + 1;
	Changes[Lane] = int(Lane) < Own.x * Own.y ? GetSiteChange(Place.y * Side.x + Place.x) : vec3(0.0);
	for (uint Half = TILE_PIXELS / 2u; Half > 0u; Half /= 2u)
	{
		barrier();
		if (Lane < Half) { Changes[Lane] += Changes[Lane + Half]; }
	}
	if (Lane == 0u)
	{
		FPathChangeRef(Push.Changes).Data[TileIndex(View, gl_WorkGroupID.xy)] = FPathChange(Changes[0].x, Changes[0].y, Changes[0].z);
	}
}

int SiteAt(ivec2 InTile, int Neighbor)
{
	ivec2 Site = InTile / Pitch + ivec2(Neighbor % Width, Neighbor / Width);
	return Site.y * Side.x + Site.x;
}

vec2 StepTo(int Site) { return vec2(SitePixels[Site] & 0xffffu, (SitePixels[Site] >> 16u) & 0x7fffu) - vec2(gl_GlobalInvocationID.xy); }

// Weights of the sites whose paths may stand for a pixel: those on its plane. What lies alone on its plane takes what there is.
struct FSites
{
	float Weights[Around]; // sum 1; all 0: there are none
	vec3 Normals[Around];  // shading
	int Numbers[Around];
};

// Returns the site of the tile and its ring that is nearest to the pixel; -1: none shows a surface that sees what the pixel sees.
int FindNearest(uint Sphere)
{
	int Nearest = -1;
	float Least = 1.0e9;
	for (int Site = 0; Site < Sites; ++Site)
	{
		if (SiteFaces[Site] == NoNormal || (SitePixels[Site] & SphereBit) != Sphere) { continue; }
		vec2 Step = StepTo(Site);
		if (dot(Step, Step) >= Least) { continue; }
		Least = dot(Step, Step);
		Nearest = Site;
	}
	return Nearest;
}

FSites FindSites(FViewConstants View, ivec2 InTile, FGBufferPoint Point)
{
	const float Deviation = 0.75; // of a pixel's kernel, in pitches
	float Slack = 0.25 * PixelHeight(View, dot(View.CameraForward, Point.Relative)), Sum = 0.0, SumOfOthers = 0.0;
	uint Sphere = SphereOf(ivec2(gl_GlobalInvocationID.xy));
#ifdef BACK_PIXELS
	bool bBack = Point.bBack && Push.BackAlbedo != NO_TEXTURE;
#endif
	FSites Found;
	float Others[Around];
	for (int I = 0; I < Around; ++I)
	{
		int Site = Found.Numbers[I] = SiteAt(InTile, I);
		Found.Weights[I] = Others[I] = 0.0;
		if (SiteFaces[Site] == NoNormal || (SitePixels[Site] & SphereBit) != Sphere) { continue; }
		vec2 Step = StepTo(Site) / vec2(Pitch);
		float Kernel = exp(-dot(Step, Step) / (2.0 * Deviation * Deviation));
		vec3 To = SitePlaces[Site] - Point.Relative;
		bool bPlane = dot(Point.Ng, UnpackOct(SiteFaces[Site])) >= 0.9 && abs(dot(Point.Ng, To)) <= 0.1 * length(To) + Slack;
#ifdef BACK_PIXELS
		bPlane = bPlane && (SiteBacks[Site] > 0.0) == bBack; // what one side gathers is not what two do
#endif
		Found.Weights[I] = bPlane ? Kernel : 0.0;
		Others[I] = Kernel;
		Sum += Found.Weights[I];
		SumOfOthers += Kernel;
	}
	if (SumOfOthers == 0.0) // a wire before the sky
	{
		int Nearest = FindNearest(Sphere);
		if (Nearest >= 0)
		{
			Found.Numbers[0] = Nearest;
			Others[0] = SumOfOthers = 1.0;
		}
	}
	for (int I = 0; I < Around; ++I)
	{
		Found.Weights[I] = Sum > 0.0 ? Found.Weights[I] / Sum : Others[I] / max(SumOfOthers, 1.0e-30);
		Found.Normals[I] = Found.Weights[I] > 0.0 ? UnpackOct(SiteNormals[Found.Numbers[I]]) : vec3(0.0);
	}
	return Found;
}

// What paths bring, and what says how much of it is chance.
struct FSum
{
	vec3 Light, Near; // Near: see FSharedPath
	// Sums over sites: of squared brightness, of brightness times weight, of squared weights.
	float Squares, Crossed, Weights;
	float NearVariance;
};

void AddPath(vec3 Light, float Weight, inout FSum Sum)
{
	float Brightness = Luminance(Light);
	Sum.Light += Light;
	Sum.Squares += Brightness * Brightness;
	Sum.Crossed += Brightness * Weight;
	Sum.Weights += Weight * Weight;
}

// Returns a texel for FDenoiseInputs::bKnownNoise.
vec4 PackSum(FSum Sum)
{
	const float MostDeviation = 100.0;
	float Mean = Luminance(Sum.Light), Variance = Sum.Squares;
	if (Sum.Weights < Alone)
	{
		Variance = max(Sum.Squares - 2.0 * Mean * Sum.Crossed + Mean * Mean * Sum.Weights, 0.0) / (1.0 - Sum.Weights);
	}
	Variance += Sum.NearVariance;
	vec3 Light = clamp(Sum.Light + Sum.Near, vec3(0.0), vec3(MaxHalf));
	return RoundToHalf(vec4(Light, min(sqrt(Variance) / max(Luminance(Light), 1.0e-6), MostDeviation)));
}

// What near paths of sites have brought to a lobe: how it differs from site to site.
struct FNearSpread
{
	float Mean, Square; // of brightness
};

void AddSpread(vec3 Light, float Weight, inout FNearSpread Spread)
{
	float Brightness = Luminance(Light);
	Spread.Mean += Weight * Brightness;
	Spread.Square += Weight * Brightness * Brightness;
}

// Weights: sum of squared weights of the sites. Count: of sites that the pixel takes.
float GetNearVariance(FNearSpread Spread, float Weights, float Count)
{
	float Variance = Weights < Alone ? max(Spread.Square - Spread.Mean * Spread.Mean, 0.0) / (1.0 - Weights) : Spread.Square;
	return Variance / max(Count, 1.0);
}

// Adds what near paths and light sampling have brought: the pixel's own, or those of the nearest sites.
void AddNear(FSites Found, inout FSum Diffuse, inout FSum Specular)
{
	float Count = 0.0, Least = 1.0e9;
	FNearSpread DiffuseSpread = FNearSpread(0.0, 0.0), SpecularSpread = DiffuseSpread;
	for (int I = 0; I < Around; ++I)
	{
		if (Found.Weights[I] <= 0.0) { continue; }
		int Site = Found.Numbers[I];
		vec3 Its = UnpackRgbe(SitePaths[Site].Near), ItsSpecular = UnpackRgbe(SitePaths[Site].NearSpecular);
		AddSpread(Its, Found.Weights[I], DiffuseSpread);
		AddSpread(ItsSpecular, Found.Weights[I], SpecularSpread);
		vec2 Step = abs(StepTo(Site));
		float Far = max(Step.x, Step.y);
		if (Far > Least) { continue; }
		if (Far < Least) { Diffuse.Near = Specular.Near = vec3(Count = 0.0); }
		Least = Far;
		Diffuse.Near += Its;
		Specular.Near += ItsSpecular;
		Count += 1.0;
	}
	Diffuse.Near /= max(Count, 1.0);
	Specular.Near /= max(Count, 1.0);
	Diffuse.NearVariance = GetNearVariance(DiffuseSpread, Diffuse.Weights, Count);
	Specular.NearVariance = GetNearVariance(SpecularSpread, Diffuse.Weights, Count);
}

// Returns the density with which the sites could have drawn a path, over that of a cosine.
float GetDensity(FSites Found, vec3 Direction)
{
	float Density = 0.0;
	for (int I = 0; I < Around; ++I)
	{
		float Cosine = dot(Found.Normals[I], Direction), Chance = 1.0;
#ifdef BACK_PIXELS
		float Back = Found.Weights[I] > 0.0 ? SiteBacks[Found.Numbers[I]] : 0.0;
		Chance = Cosine > 0.0 ? 1.0 - Back : Back;
		Cosine = Back > 0.0 ? abs(Cosine) : Cosine;
#endif
		Density += Found.Weights[I] * Chance * max(Cosine, 0.0);
	}
	return max(Density, 1.0e-4);
}

// What the pixel takes of a path.
struct FReceiver
{
	vec3 Normal;      // shading
	vec3 Front, Back; // weights of the light on either side
};

FReceiver MakeReceiver(FGBufferPoint Point, ivec2 Pixel)
{
	FReceiver Receiver = FReceiver(Point.BentN, vec3(1.0), vec3(0.0));
#ifdef BACK_PIXELS
	if (Point.bBack && Push.BackAlbedo != NO_TEXTURE)
	{
		Receiver.Back = ShareOfSide(LoadSides(Pixel), true);
		Receiver.Front -= Receiver.Back;
	}
#endif
	return Receiver;
}

// Returns by how much more a path lights the pixel than the sites that could have drawn it. OutFront: the same, of light on the front alone.
vec3 GetGain(FSites Found, FReceiver Receiver, vec3 Direction, out float OutFront)
{
#ifdef NO_REUSE_COSINE
	OutFront = 1.0;
	return vec3(1.0);
#else
	float Cosine = dot(Receiver.Normal, Direction), Density = GetDensity(Found, Direction);
	OutFront = max(Cosine, 0.0) / Density;
	return Cosine > 0.0 ? Receiver.Front * OutFront : Receiver.Back * (-Cosine / Density);
#endif
}

void LightPixel(FViewConstants View, ivec2 Pixel, float Depth, inout FSum Diffuse, inout FSum Specular)
{
	// Of a lobe for which a path counts. The pixel's own reach 4. Where normals or lobes differ, a few would count for hundreds. Lower limits
	// lose light: 4 for specular lobes took 0.7 % of the courtyard's.
	const float MostShare = 8.0, MostSpecularShare = 16.0;
	ivec2 InTile = ivec2(gl_LocalInvocationID.xy);
	FGBufferPoint Point = LoadGBufferPoint(View, Push.Normals, Pixel, Depth);
	FSites Found = FindSites(View, InTile, Point);
	FReceiver Receiver = MakeReceiver(Point, Pixel);
#ifdef SECOND_LOBE
	FBrdf Lobe;
	float LobeShare;
	vec3 Albedo = max(FindSecondLobe(Push.BaseColor, Push.Material, Pixel, Point, Lobe, LobeShare), vec3(1.0e-4));
	mat3 Basis = MakeBasis(Point.BentN);
	vec3 V = Point.V * Basis;
#endif
	for (int I = 0; I < Around; ++I)
	{
		float Weight = Found.Weights[I];
		if (Weight <= 0.0) { continue; }
		FSharedPath Path = SitePaths[Found.Numbers[I]];
		vec3 Direction = (Path.SkyAndGone & 1u) != 0u ? Path.Hit : normalize(Path.Hit - Point.Relative);
		vec3 Light = UnpackRgbe(Path.Radiance) * Weight;
#ifdef PATH_RESERVOIRS
		Light *= Path.Share; // a dim path that was chosen stands for many
		Path.Share = 1.0;
#endif
		float Front;
		vec3 Gain = GetGain(Found, Receiver, Direction, Front);
		AddPath(Light * min(Path.Share * Gain, vec3(MostShare)), Weight, Diffuse);
#ifdef SECOND_LOBE
		vec3 L = Direction * Basis;
		vec3 Reflected = L.z > 0.0 ? EvaluateBrdfCos(Lobe, V, L) * (Pi / max(L.z, 1.0e-4)) / Albedo : vec3(0.0);
		AddPath(Light * min(Path.Share * Front * Reflected, vec3(MostSpecularShare)), Weight, Specular);
#endif
	}
	AddNear(Found, Diffuse, Specular);
}

void main()
{
	FViewConstants View = FViewRef(Push.Pass.View).Data;
	LoadSites(View);
	barrier();
	if (Push.Changes != FAddress(0)) { SumChanges(View); }
	ivec2 Pixel = ivec2(gl_GlobalInvocationID.xy);
	if (IsOutsideView(View, uvec2(Pixel))) { return; }
	FSum Diffuse = FSum(vec3(0.0), vec3(0.0), 0.0, 0.0, 0.0, 0.0), Specular = Diffuse;
	float Depth = LoadDepth(Push.Depth, Pixel);
	if (Depth > 0.0) { LightPixel(View, Pixel, Depth, Diffuse, Specular); }
	bool bNone = Depth > 0.0 && Diffuse.Weights == 0.0;
	imageStore(Images[Push.Output], Pixel, bNone ? vec4(vec3(0.0), NoValue) : PackSum(Diffuse));
#ifdef SECOND_LOBE
	imageStore(Images[Push.SecondOutput], Pixel, bNone ? vec4(vec3(0.0), NoValue) : PackSum(Specular));
#endif
}
