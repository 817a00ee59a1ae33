// What Fork.vert and Fork.frag get. ForkRaster.cpp has the same structures.
layout(buffer_reference, scalar) readonly buffer FView
{
	mat4 JitteredViewToClip;
	mat4 WorldToView; // turns alone
	mat4 RelativeToClip, PreviousRelativeToClip; // from positions relative to each frame's camera
};
layout(push_constant, scalar) uniform FPush
{
	FView View;
	vec3 Offset, Scale; // of the thing relative to the camera
	vec3 PreviousOffset, PreviousScale;
	vec3 Color;
	uint bCutOut;
} Push;
