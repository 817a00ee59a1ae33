// Channels of objects: which lights light them.
#ifndef LANTERN_OBJECT_CHANNELS_GLSL
#define LANTERN_OBJECT_CHANNELS_GLSL

#include "Bindings.glsl"

layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer FObjectChannelsRef { uint Data[]; };

uint LoadObjectChannels(FSceneConstants Scene, uint Object)
{
	if (Scene.ObjectChannels == FAddress(0)) { return CHANNELS_DEFAULT; }
	return FObjectChannelsRef(Scene.ObjectChannels).Data[Object] ^ CHANNELS_DEFAULT;
}

#endif
