#version 460
layout(push_constant) uniform FPush
{
	mat4 RelativeToClip;
	vec4 Offset; // xyz: position of the box relative to the camera
	vec4 Scale;
} Push;

layout(location = 0) in vec3 InPosition;
layout(location = 1) in vec3 InNormal;
layout(location = 0) flat out vec3 OutNormal;
layout(location = 1) out vec3 OutRelative; // to the camera

void main()
{
	OutNormal = InNormal;
	OutRelative = InPosition * Push.Scale.xyz + Push.Offset.xyz;
	gl_Position = Push.RelativeToClip * vec4(OutRelative, 1.0);
}
