#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_buffer_reference : require
#extension GL_EXT_scalar_block_layout : require
#include "ForkDraw.glsl"

layout(location = 0) in vec3 InPosition;
layout(location = 1) in vec3 InNormal;
layout(location = 2) in vec3 InPrevious;
layout(location = 3) in vec2 InUV;
layout(location = 0) flat out vec3 OutNormal; // in view space, as all of this engine's G-buffer
layout(location = 1) out vec3 OutPosition;
layout(location = 2) out vec4 OutClip; // without jitter
layout(location = 3) out vec4 OutPreviousClip;
layout(location = 4) out vec2 OutUV;

void main()
{
	vec4 Relative = vec4(InPosition * Push.Scale + Push.Offset, 1.0);
	OutNormal = mat3(Push.View.WorldToView) * InNormal;
	OutPosition = mat3(Push.View.WorldToView) * Relative.xyz;
	OutClip = Push.View.RelativeToClip * Relative;
	OutPreviousClip = Push.View.PreviousRelativeToClip * vec4(InPrevious * Push.PreviousScale + Push.PreviousOffset, 1.0);
	OutUV = InUV;
	gl_Position = Push.View.JitteredViewToClip * vec4(OutPosition, 1.0);
}
