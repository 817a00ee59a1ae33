// A: scene, B: ray flags, C: mask, D: ray type, E: ray types, F: miss shader.
#extension GL_GOOGLE_include_directive : require
#include "Common.glsl"
layout(set = 0, binding = 3) uniform accelerationStructureEXT Scenes[];

// Pixel (x, y) looks down at the unit square above (x, y), off its diagonal.
vec3 GetOrigin(uvec2 Pixel) { return vec3(vec2(Pixel) + vec2(0.5, 0.25), 1.0); }
const vec3 Down = vec3(0, 0, -1);
const float Far = 10.0;
