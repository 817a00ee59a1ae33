#version 460
layout(location = 0) flat in vec3 InNormal;
layout(location = 1) in vec3 InPosition;
layout(location = 0) out vec4 OutNormal; // view space, from 0 to 1

void main()
{
	// Skinned meshes have no normals: that of the triangle serves.
	vec3 Normal = InNormal;
	if (InNormal == vec3(0.0))
	{
		Normal = normalize(cross(dFdx(InPosition), dFdy(InPosition)));
		Normal = dot(Normal, InPosition) > 0.0 ? -Normal : Normal;
	}
	OutNormal = vec4(Normal * 0.5 + 0.5, 0.0);
}
