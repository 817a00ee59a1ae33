// The example scene, the mesh of a box, and the projection of the camera.
#include "Example/ForkScene.h"

#include <cmath>

namespace Fork
{

FForkScene MakeScene(glm::dvec3 Offset)
{
	FForkScene Scene;
	Scene.Boxes = {
	    {Offset + glm::dvec3(0, -0.5, 0), {10, 0.5, 10}},
	    {Offset + glm::dvec3(-1, 2.5, 0), {1, 1, 1}},
	    {Offset + glm::dvec3(3, 2, -2), {0.4, 2, 0.4}, true, false, true},
	    {Offset + glm::dvec3(-5, 2, 3), {1, 0.2, 1}, false},
	    {Offset + glm::dvec3(4.5, 1.2, 3), {0.6, 0.6, 0.6}, true, true},
	};
	Scene.Reed = {Offset + glm::dvec3(-6.5, 2, -3), 0.5};
	Scene.SunDirection = normalize(glm::dvec3(0.6, -1.0, 0.35));
	const auto LookAt = [](FCamera& Camera, glm::dvec3 From, glm::dvec3 To) {
		Camera.Position = From;
		Camera.Forward = normalize(To - From);
		Camera.Right = normalize(cross(Camera.Forward, glm::dvec3(0, 1, 0)));
		Camera.Up = cross(Camera.Right, Camera.Forward);
	};
	LookAt(Scene.Cameras[0], Offset + glm::dvec3(2, 6, 11), Offset + glm::dvec3(0.5, 0.5, 0));
	LookAt(Scene.Cameras[1], Offset + glm::dvec3(10, 5, -5), Offset + glm::dvec3(0, 1, 0));
	return Scene;
}

FBoxMesh MakeBoxMesh(glm::vec3 HalfSize)
{
	FBoxMesh Mesh;
	for (uint32_t Face = 0; Face < 6; ++Face)
	{
		const uint32_t Axis = Face / 2;
		glm::vec3 Normal(0), U(0);
		Normal[static_cast<int>(Axis)] = Face % 2 == 0 ? 1.0f : -1.0f;
		U[static_cast<int>((Axis + 1) % 3)] = 1.0f;
		const glm::vec3 V = cross(Normal, U);
		const std::array<glm::vec3, 4> Corners = {Normal - U - V, Normal + U - V, Normal + U + V, Normal - U + V};
		for (uint32_t Corner = 0; Corner < 4; ++Corner) { Mesh.Vertices[Face * 4 + Corner] = {Corners[Corner] * HalfSize, Normal}; }
		constexpr std::array<uint32_t, 6> Quad = {0, 1, 2, 0, 2, 3};
		for (uint32_t Index = 0; Index < 6; ++Index) { Mesh.Indices[Face * 6 + Index] = Face * 4 + Quad[Index]; }
	}
	return Mesh;
}

FReedMesh MakeReedMesh()
{
	constexpr int Segments = 8;
	constexpr float HalfHeight = 2.0f, HalfWidth = 0.3f;
	FReedMesh Mesh;
	constexpr std::array<glm::vec2, 4> Corners = {glm::vec2(1, 1), glm::vec2(1, -1), glm::vec2(-1, -1), glm::vec2(-1, 1)};
	for (int Ring = 0; Ring <= Segments; ++Ring)
	{
		const float Y = HalfHeight * (2.0f * float(Ring) / Segments - 1.0f);
		for (const glm::vec2 Corner : Corners)
		{
			Mesh.Vertices.push_back({{Corner.x * HalfWidth, Y, Corner.y * HalfWidth}, glm::clamp(Y + 0.5f, 0.0f, 1.0f)});
		}
	}
	for (uint32_t Ring = 0; Ring < Segments; ++Ring)
	{
		for (uint32_t Corner = 0; Corner < 4; ++Corner)
		{
			const uint32_t A = Ring * 4 + Corner, B = Ring * 4 + (Corner + 1) % 4;
			for (const uint32_t Index : {A, B, B + 4, A, B + 4, A + 4}) { Mesh.Indices.push_back(Index); }
		}
	}
	return Mesh;
}

glm::dvec3 SkinVertex(const FSkinVertex& Vertex, double Bend)
{
	const glm::dvec3 P(Vertex.Position);
	const double Sine = std::sin(Bend), Cosine = std::cos(Bend);
	return mix(P, glm::dvec3(P.x * Cosine - P.y * Sine, P.x * Sine + P.y * Cosine, P.z), double(Vertex.Weight));
}

glm::mat4 GetViewToClip(const FCamera& Camera, double Aspect)
{
	const double Scale = 1.0 / std::tan(Camera.FovY * 0.5), Depth = Camera.Far - Camera.Near;
	glm::dmat4 Matrix(0.0);
	Matrix[0][0] = Scale / Aspect;
	Matrix[1][1] = -Scale;
	Matrix[2][2] = -Camera.Far / Depth;
	Matrix[3][2] = -Camera.Far * Camera.Near / Depth;
	Matrix[2][3] = -1.0;
	return glm::mat4(Matrix);
}

glm::dmat3 GetWorldToView(const FCamera& Camera) { return transpose(glm::dmat3(Camera.Right, Camera.Up, -Camera.Forward)); }

} // namespace Fork
