// Writes the channels of the object that each pixel shows.
#version 460
#include "../Shared/PixelChannelsTypes.h"
#include "../Library/HostNumbers.glsl"
#include "../Library/ObjectChannels.glsl"

layout(local_size_x = PIXEL_CHANNELS_GROUP_SIZE, local_size_y = PIXEL_CHANNELS_GROUP_SIZE) in;
layout(push_constant, scalar) uniform FPush { FPixelChannelsConstants Push; };

uint FindChannels(FSceneConstants Scene, ivec2 Pixel)
{
	if (Push.Host != NO_TEXTURE) { return LoadHostNumber(Push.Host, Push.HostOffset, Pixel); }
	float Object = texelFetch(Textures[Push.Motion], Pixel, 0).w;
	return Object >= 1.0 ? LoadObjectChannels(Scene, uint(Object) - 1u) : CHANNELS_DEFAULT;
}

void main()
{
	FViewConstants View = FViewRef(Push.Pass.View).Data;
	ivec2 Pixel = ivec2(gl_GlobalInvocationID.xy);
	if (Pixel.x >= int(View.Width) || Pixel.y >= int(View.Height)) { return; }
	uint Channels = FindChannels(FSceneRef(Push.Pass.Scene).Data, Pixel);
	imageStore(Images[Push.Output], Pixel, vec4(float(Channels) / 255.0));
}
