#version 460
layout(push_constant) uniform FPush
{
	mat4 ViewToClip;
	vec4 WorldToView; // quaternion
	vec4 Offset;      // xyz: position of the box relative to the camera
	vec4 Scale;
} Push;

layout(location = 0) in vec3 InPosition;
layout(location = 1) in vec3 InNormal;
layout(location = 0) flat out vec3 OutNormal; // in view space, as all of this engine's G-buffer
layout(location = 1) out vec3 OutPosition;

vec3 ToView(vec3 V) { return V + 2.0 * cross(Push.WorldToView.xyz, cross(Push.WorldToView.xyz, V) + Push.WorldToView.w * V); }

void main()
{
	OutNormal = ToView(InNormal);
	OutPosition = ToView(InPosition * Push.Scale.xyz + Push.Offset.xyz);
	gl_Position = Push.ViewToClip * vec4(OutPosition, 1.0);
}
