// The example scene, the mesh of a box, and the projection of the camera.
#include "Example/ForkScene.h"

#include <cmath>

namespace Fork
{

FForkScene MakeScene(glm::dvec3 Offset)
{
	FForkScene Scene;
	Scene.Boxes = {
	    {Offset + At(0, -0.5, 0), At(10, 0.5, 10)},
	    {Offset + At(-1, 2.5, 0), At(1, 1, 1)},
	    {Offset + At(3, 2, -2), At(0.4, 2, 0.4), true, false, true},
	    {Offset + At(-5, 2, 3), At(1, 0.2, 1), false},
	    {Offset + At(4.5, 1.2, 3), At(0.6, 0.6, 0.6), true, true},
	};
	Scene.Reed = {Offset + At(-6.5, 2, -3), 0.5};
	Scene.SunDirection = normalize(At(0.6, -1.0, 0.35));
	Scene.Lamp = Offset + At(-3, 3, 2);
	const auto LookAt = [](FCamera& Camera, glm::dvec3 From, glm::dvec3 To) {
		Camera.Position = From;
		Camera.Forward = normalize(To - From);
		Camera.Right = normalize(cross(glm::dvec3(0, 0, 1), Camera.Forward)); // left-handed
		Camera.Up = cross(Camera.Forward, Camera.Right);
	};
	LookAt(Scene.Cameras[0], Offset + At(2, 6, 11), Offset + At(0.5, 0.5, 0));
	LookAt(Scene.Cameras[1], Offset + At(10, 5, -5), Offset + At(0, 1, 0));
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
		constexpr std::array<glm::vec2, 4> UVs = {glm::vec2(0, 0), glm::vec2(1, 0), glm::vec2(1, 1), glm::vec2(0, 1)};
		for (uint32_t Corner = 0; Corner < 4; ++Corner)
		{
			const glm::vec3 Position = Corners[Corner] * HalfSize;
			Mesh.Vertices[Face * 4 + Corner] = {Position, Normal, Position, UVs[Corner]};
		}
		constexpr std::array<uint32_t, 6> Quad = {0, 1, 2, 0, 2, 3};
		for (uint32_t Index = 0; Index < 6; ++Index) { Mesh.Indices[Face * 6 + Index] = Face * 4 + Quad[Index]; }
	}
	return Mesh;
}

bool IsCutOut(glm::dvec2 UV) { return UV.x > 0.25 && UV.x < 0.75 && UV.y > 0.25 && UV.y < 0.75; }

std::array<uint32_t, CutOutMapSize * CutOutMapSize> MakeCutOutMap()
{
	std::array<uint32_t, CutOutMapSize * CutOutMapSize> Texels{};
	for (uint32_t Texel = 0; Texel < Texels.size(); ++Texel)
	{
		const glm::dvec2 Centre = (glm::dvec2(Texel % CutOutMapSize, Texel / CutOutMapSize) + 0.5) / double(CutOutMapSize);
		Texels[Texel] = IsCutOut(Centre) ? 0x00c0c0c0u : 0xffc0c0c0u;
	}
	return Texels;
}

FReedMesh MakeReedMesh()
{
	constexpr int Segments = 8;
	constexpr float HalfHeight = 2.0f * float(Metre), HalfWidth = 0.3f * float(Metre);
	FReedMesh Mesh;
	constexpr std::array<glm::vec2, 4> Corners = {glm::vec2(1, 1), glm::vec2(-1, 1), glm::vec2(-1, -1), glm::vec2(1, -1)};
	for (int Ring = 0; Ring <= Segments; ++Ring)
	{
		const float Z = HalfHeight * (2.0f * float(Ring) / Segments - 1.0f);
		for (const glm::vec2 Corner : Corners)
		{
			Mesh.Vertices.push_back({{Corner.x * HalfWidth, Corner.y * HalfWidth, Z}, glm::clamp(Z / float(Metre) + 0.5f, 0.0f, 1.0f)});
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
	return mix(P, glm::dvec3(P.x * Cosine - P.z * Sine, P.y, P.x * Sine + P.z * Cosine), double(Vertex.Weight));
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
