#version 460
layout(location = 0) flat in vec3 InNormal;
layout(location = 1) in vec3 InRelative;
layout(location = 0) out vec4 OutNormals; // shading and geometric normal, the same in this engine

vec2 EncodeOctahedral(vec3 N)
{
	vec2 P = N.xy / (abs(N.x) + abs(N.y) + abs(N.z));
	return N.z >= 0.0 ? P : (1.0 - abs(P.yx)) * vec2(P.x >= 0.0 ? 1.0 : -1.0, P.y >= 0.0 ? 1.0 : -1.0);
}

void main()
{
	// Skinned meshes have no normals: that of the triangle serves.
	vec3 Normal = InNormal;
	if (InNormal == vec3(0.0))
	{
		Normal = normalize(cross(dFdx(InRelative), dFdy(InRelative)));
		Normal = dot(Normal, InRelative) > 0.0 ? -Normal : Normal;
	}
	vec2 Encoded = EncodeOctahedral(Normal);
	OutNormals = vec4(Encoded, Encoded);
}
