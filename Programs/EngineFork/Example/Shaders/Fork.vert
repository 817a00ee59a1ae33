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

void main()
{
	OutNormal = InNormal;
	gl_Position = Push.RelativeToClip * vec4(InPosition * Push.Scale.xyz + Push.Offset.xyz, 1.0);
}
