// Marks the mirrors' pixels that further paths are traced for: what they show is new, or its light has changed. The filter could only spread
// what few paths have found, over the edges of shadows as well. Rougher surfaces hide these edges.
#version 460
#include "../Shared/DenoiseTypes.h"
#include "../Shared/ReflectionTypes.h"
#include "../Denoise/ChangedShare.glsl"
#include "../Library/Brdf.glsl"
#include "../Library/GBuffer.glsl"
#include "../Library/History.glsl"
#include "../Rays/MarkThreads.glsl"

layout(local_size_x = RAY_QUEUE_GROUP_SIZE) in;
layout(push_constant, scalar) uniform FPush { FReflectionChangedConstants Push; };

const float LeastAlbedo = 0.1; // of a mirror whose noise is seen

// Whether a change of light, or of what the mirror shows, has left too little of the history. The paths of this frame have no say: who is
// traced further would else depend on what they found, and the mean with it.
bool HasLostHistory(ivec2 Pixel)
{
	FAnchor Anchor = LoadAnchor(Push.Anchors, Pixel);
	if (Push.History == NO_TEXTURE || !Anchor.bFound) { return true; }
	vec4 History = texelFetch(Textures[Push.History], Anchor.Texel, 0);
	vec2 Changed = texelFetch(Textures[Push.ChangedShare], Pixel, 0).xy;
	if (!AreFinite(History)) { return true; }
	float Brightness = Luminance(History.rgb), Error = GetChangeError(Changed, Brightness);
	if (Brightness <= 0.0) { return Changed.x > 0.0 || Changed.y > 0.0; }
	return Error > 0.0 && GetAnchoredFrames(Anchor, History.w) * GetKeptShare(Error, Brightness) < Push.LeastFrames;
}

bool IsTracedFurther(FViewConstants View, ivec2 Pixel)
{
	float Chance = texelFetch(Textures[Push.Radiance], Pixel, 0).w;
	vec4 Material = texelFetch(Textures[Push.Pixels.Material], Pixel, 0);
	FBrdf Brdf = MakeGBufferBrdf(texelFetch(Textures[Push.Pixels.BaseColor], Pixel, 0), Material);
	if (!IsMirror(MakeSpecularLobe(Brdf)) || Chance == CHANCE_NONE || !HasLostHistory(Pixel)) { return false; }
	FGBufferPoint Point = LoadGBufferPoint(View, Push.Pixels.Normals, Pixel, LoadDepth(Push.Pixels.Depth, Pixel));
	return MaxComponent(SpecularReflectance(Brdf, dot(Point.BentN, Point.V), Material.x)) >= LeastAlbedo;
}

void main()
{
	FViewConstants View = FViewRef(Push.Pass.View).Data;
	uint Number = gl_GlobalInvocationID.y * (RAY_QUEUE_GROUP_SIZE * RAY_QUEUE_ROW_GROUPS) + gl_GlobalInvocationID.x, Thread;
	bool bFurther = FindThread(Push.List, Number, Thread) && IsTracedFurther(View, ivec2(Thread % View.Width, Thread / View.Width));
	MarkThreads(Push.OutList, Number - gl_LocalInvocationIndex, bFurther);
}
