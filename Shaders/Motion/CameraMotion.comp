// Motion vectors of a static world, from depth and the cameras of two frames.
#version 460
#include "../Shared/CameraMotionTypes.h"
#include "../Library/Motion.glsl"
#include "../Library/View.glsl"

layout(local_size_x = CAMERA_MOTION_GROUP_SIZE, local_size_y = CAMERA_MOTION_GROUP_SIZE) in;
layout(push_constant, scalar) uniform FPush { FCameraMotionConstants Push; };

void main()
{
	FViewConstants View = FViewRef(Push.Pass.View).Data;
	uvec2 Pixel = gl_GlobalInvocationID.xy;
	if (IsOutsideView(View, Pixel)) { return; }
	float Depth = texelFetch(Textures[Push.Depth], ivec2(Pixel), 0).r;
	vec3 Motion = vec3(0.0);
	if (Depth > 0.0)
	{
		vec3 Relative = RelativePositionFromDepth(View, Pixel, Depth);
		Motion = ComputeMotion(View, Relative, Relative + View.CameraMotion);
	}
	imageStore(Images[Push.Output], ivec2(Pixel), vec4(Motion, 0.0));
}
