// Intensity of point lights by direction (HAS_LIGHT_PROFILES: some light has a profile), and which objects lights light
// (HAS_LIGHT_CHANNELS: some light or object is not of channel 0). Neither costs anything where it is not defined.
#ifndef LANTERN_LIGHT_PROFILE_GLSL
#define LANTERN_LIGHT_PROFILE_GLSL

#include "Bindings.glsl"
#include "Math.glsl"

#ifdef HAS_LIGHT_PROFILES
layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer FLightProfileRef { FLightProfile Data[]; };
layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer FProfileTexelRef { uint Data[]; };

float LoadProfileTexel(FSceneConstants Scene, uint Index)
{
	return float((FProfileTexelRef(Scene.ProfileTexels).Data[Index >> 1u] >> (16u * (Index & 1u))) & 0xffffu) * (1.0 / 65535.0);
}

// Interpolates a column. Row: at least 0, at most the last one.
float SampleProfileColumn(FSceneConstants Scene, FLightProfile Profile, uint Column, float Row)
{
	uint Low = min(uint(Row), Profile.Rows - 1u), High = min(Low + 1u, Profile.Rows - 1u), First = Profile.First + Column * Profile.Rows;
	return mix(LoadProfileTexel(Scene, First + Low), LoadProfileTexel(Scene, First + High), Row - float(Low));
}

// Returns the intensity over its peak, 0 to 1. FromLight: unit length.
float LightProfile(FSceneConstants Scene, FLightData Light, vec3 FromLight)
{
	uint Number = Light.Flags >> LIGHT_PROFILE_SHIFT;
	if (Number == 0u) { return 1.0; }
	FLightProfile Profile = FLightProfileRef(Scene.LightProfiles).Data[Number - 1u];
	if (Profile.Rows == 0u) { return 0.0; }
	vec3 Axis = UnpackOct(Light.Direction);
	float Angle = AccurateAcos(clamp(dot(Axis, FromLight), -1.0, 1.0)) * (180.0 / Pi);
	float Row = (Angle - Profile.FirstAngle) * Profile.RowsPerDegree, Last = float(Profile.Rows - 1u), Margin = 0.001 * Profile.RowsPerDegree;
	if (Row < -Margin || Row > Last + Margin) { return 0.0; }
	Row = clamp(Row, 0.0, Last);
	if (Profile.Columns == 1u) { return SampleProfileColumn(Scene, Profile, 0u, Row); }
	vec3 Tangent = UnpackOct(Light.Tangent);
	vec2 Across = vec2(dot(FromLight, Tangent), dot(FromLight, cross(Tangent, Axis)));
	float Turn = AccurateAcos(clamp(Across.x * inversesqrt(max(dot(Across, Across), 1.0e-20)), -1.0, 1.0)) * (180.0 / Pi);
	float Column = (Across.y < 0.0 ? 360.0 - Turn : Turn) * Profile.ColumnsPerDegree;
	uint Low = uint(Column) % Profile.Columns, High = (Low + 1u) % Profile.Columns;
	return mix(SampleProfileColumn(Scene, Profile, Low, Row), SampleProfileColumn(Scene, Profile, High, Row), fract(Column));
}
#else
float LightProfile(FSceneConstants Scene, FLightData Light, vec3 FromLight) { return 1.0; }
#endif

const uint AllChannels = 255u;

// Whether a light lights a surface of an object with these channels.
bool SharesChannel(FLightData Light, uint Channels)
{
#ifdef HAS_LIGHT_CHANNELS
	return (((Light.Flags >> LIGHT_CHANNELS_SHIFT) ^ CHANNELS_DEFAULT) & Channels & AllChannels) != 0u;
#else
	return true;
#endif
}

bool SunSharesChannel(FSceneConstants Scene, uint Channels)
{
#ifdef HAS_LIGHT_CHANNELS
	return (Scene.SunChannels & Channels) != 0u;
#else
	return true;
#endif
}

#ifdef HAS_LIGHT_CHANNELS
// Texture: sampled index of what PixelChannels.comp wrote; or NO_TEXTURE: nobody knows the pixels' objects.
uint LoadPixelChannels(uint Texture, uvec2 Pixel)
{
	return Texture == NO_TEXTURE ? CHANNELS_DEFAULT : uint(round(texelFetch(Textures[Texture], ivec2(Pixel), 0).x * 255.0));
}
#endif

#endif
