// Quads, boxes, lathes, spheres and tubes as triangles.
#include "Builtin/MeshBuilder.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <map>

#include <glm/gtc/constants.hpp>

#include "LanternHost/VertexPacking.h"
#include "TangentSpace.h"

namespace Lantern::Builtin
{

FMeshBuilder& FMeshBuilder::BeginSection(int32_t Material)
{
	if (Mesh.Sections.empty() || Mesh.Sections.back().IndexCount > 0) { Mesh.Sections.emplace_back(); }
	Mesh.Sections.back().FirstIndex = uint32_t(Mesh.Indices.size());
	Mesh.Sections.back().Material = Material;
	return *this;
}

FMeshBuilder& FMeshBuilder::SetTransform(const glm::mat4& InTransform)
{
	Transform = InTransform;
	NormalTransform = glm::transpose(glm::inverse(glm::mat3(InTransform)));
	return *this;
}

FMeshBuilder& FMeshBuilder::SetTexelScale(float InScale)
{
	TexelScale = InScale;
	return *this;
}

FMeshBuilder& FMeshBuilder::SetColor(const glm::vec3& InColor)
{
	Color = InColor;
	return *this;
}

uint32_t FMeshBuilder::AddVertex(const glm::vec3& Position, const glm::vec3& Normal, const glm::vec2& UV)
{
	Mesh.Positions.push_back(glm::vec3(Transform * glm::vec4(Position, 1)));
	Normals.push_back(glm::normalize(NormalTransform * Normal));
	UVs.push_back(UV);
	Colors.push_back(Color);
	return uint32_t(Mesh.Positions.size() - 1);
}

void FMeshBuilder::AddTriangle(uint32_t A, uint32_t B, uint32_t C)
{
	assert(!Mesh.Sections.empty());
	Mesh.Indices.insert(Mesh.Indices.end(), {A, B, C});
	Mesh.Sections.back().IndexCount += 3;
}

namespace
{

/// Metres along the surface, from the position alone, so that neighbouring faces fit together. v runs down.
glm::vec2 MapBox(const glm::vec3& P, const glm::vec3& Normal)
{
	const glm::vec3 Size = glm::abs(Normal);
	if (Size.y >= Size.x && Size.y >= Size.z) { return {P.x, Normal.y >= 0 ? P.z : -P.z}; }
	return Size.x > Size.z ? glm::vec2(Normal.x >= 0 ? -P.z : P.z, -P.y) : glm::vec2(Normal.z >= 0 ? P.x : -P.x, -P.y);
}

} // namespace

void FMeshBuilder::AddQuad(const glm::vec3& P0, const glm::vec3& P1, const glm::vec3& P2, const glm::vec3& P3)
{
	const glm::vec3 Normal = glm::normalize(glm::cross(P2 - P0, P3 - P1));
	uint32_t Vertices[4];
	int I = 0;
	for (const glm::vec3& P : {P0, P1, P2, P3}) { Vertices[I++] = AddVertex(P, Normal, MapBox(P, Normal) * TexelScale); }
	AddTriangle(Vertices[0], Vertices[1], Vertices[2]);
	AddTriangle(Vertices[0], Vertices[2], Vertices[3]);
}

void FMeshBuilder::AddUnitQuad(const glm::vec3& P0, const glm::vec3& P1, const glm::vec3& P2, const glm::vec3& P3)
{
	const glm::vec3 Normal = glm::normalize(glm::cross(P2 - P0, P3 - P1));
	const uint32_t A = AddVertex(P0, Normal, {0, 1});
	const uint32_t B = AddVertex(P1, Normal, {1, 1});
	const uint32_t C = AddVertex(P2, Normal, {1, 0});
	const uint32_t D = AddVertex(P3, Normal, {0, 0});
	AddTriangle(A, B, C);
	AddTriangle(A, C, D);
}

void FMeshBuilder::AddBox(const glm::vec3& Min, const glm::vec3& Max, bool bInward)
{
	for (int Axis = 0; Axis < 3; ++Axis)
	{
		const int U = (Axis + 1) % 3, V = (Axis + 2) % 3;
		for (int Side = 0; Side < 2; ++Side)
		{
			glm::vec3 P[4];
			for (int Corner = 0; Corner < 4; ++Corner)
			{
				const bool bFlip = (Side == 0) != bInward;
				const int C = bFlip ? 3 - Corner : Corner;
				P[Corner][Axis] = Side == 1 ? Max[Axis] : Min[Axis];
				P[Corner][U] = C == 1 || C == 2 ? Max[U] : Min[U];
				P[Corner][V] = C >= 2 ? Max[V] : Min[V];
			}
			// Sides stand upright: u runs along the horizontal edge.
			if (Axis != 1 && std::abs(P[1].y - P[0].y) > std::abs(P[2].y - P[1].y)) { AddQuad(P[1], P[2], P[3], P[0]); }
			else { AddQuad(P[0], P[1], P[2], P[3]); }
		}
	}
}

void FMeshBuilder::AddBeveledBox(const glm::vec3& Min, const glm::vec3& Max, float Bevel)
{
	const glm::vec3 Center = (Min + Max) * 0.5f, Half = (Max - Min) * 0.5f;
	// Corner points of the face whose normal is Axis: inset by the bevel in the two other directions.
	const auto GetPoint = [&](int Axis, const glm::vec3& Sign) {
		glm::vec3 P = Half - glm::vec3(Bevel);
		P[Axis] = Half[Axis];
		return Center + P * Sign;
	};
	const auto AddOriented = [&](glm::vec3 P0, glm::vec3 P1, glm::vec3 P2, glm::vec3 P3) {
		const glm::vec3 Normal = glm::cross(P1 - P0, P2 - P0);
		if (glm::dot(Normal, (P0 + P2) * 0.5f - Center) < 0) { std::swap(P1, P3); }
		// u horizontal, v upright, as for walls
		if (std::abs(P1.y - P0.y) > std::abs(P2.y - P1.y)) { AddQuad(P1, P2, P3, P0); }
		else { AddQuad(P0, P1, P2, P3); }
	};
	for (int Axis = 0; Axis < 3; ++Axis)
	{
		const int U = (Axis + 1) % 3, V = (Axis + 2) % 3;
		for (int Bits = 0; Bits < 4; ++Bits)
		{
			const float SA = (Bits & 1) != 0 ? 1.0f : -1.0f, SB = (Bits & 2) != 0 ? 1.0f : -1.0f;
			const auto MakeSign = [&](float A, float B, float C) {
				glm::vec3 Sign;
				Sign[Axis] = A;
				Sign[U] = B;
				Sign[V] = C;
				return Sign;
			};
			if ((Bits & 2) != 0)
			{
				AddOriented(GetPoint(Axis, MakeSign(SA, -1, -1)), GetPoint(Axis, MakeSign(SA, 1, -1)), GetPoint(Axis, MakeSign(SA, 1, 1)),
				    GetPoint(Axis, MakeSign(SA, -1, 1)));
			}
			// The edge along V, between the faces of Axis and U.
			AddOriented(GetPoint(Axis, MakeSign(SA, SB, -1)), GetPoint(Axis, MakeSign(SA, SB, 1)), GetPoint(U, MakeSign(SA, SB, 1)),
			    GetPoint(U, MakeSign(SA, SB, -1)));
		}
	}
	for (int Corner = 0; Corner < 8; ++Corner)
	{
		const glm::vec3 Sign((Corner & 1) != 0 ? 1 : -1, (Corner & 2) != 0 ? 1 : -1, (Corner & 4) != 0 ? 1 : -1);
		const bool bEven = Sign.x * Sign.y * Sign.z > 0;
		const glm::vec3 X = GetPoint(0, Sign), Y = GetPoint(bEven ? 1 : 2, Sign), Z = GetPoint(bEven ? 2 : 1, Sign);
		const glm::vec3 Normal = glm::normalize(Sign);
		const uint32_t A = AddVertex(X, Normal, {0, 0}), B = AddVertex(Y, Normal, {0, 0}), C = AddVertex(Z, Normal, {0, 0});
		AddTriangle(A, B, C);
	}
}

void FMeshBuilder::AddLatheBand(
    const glm::vec2& A, const glm::vec2& B, const glm::vec2& NormalA, const glm::vec2& NormalB, float VA, float VB, int Segments)
{
	const float Around = glm::two_pi<float>() * std::max(std::max(A.x, B.x), 0.05f);
	uint32_t PreviousA = 0, PreviousB = 0;
	for (int I = 0; I <= Segments; ++I)
	{
		const float Angle = glm::two_pi<float>() * float(I) / float(Segments);
		const float Cos = std::cos(Angle), Sin = -std::sin(Angle);
		const float U = Around * float(I) / float(Segments) * TexelScale;
		const uint32_t LowerVertex = AddVertex({A.x * Cos, A.y, A.x * Sin}, {NormalA.x * Cos, NormalA.y, NormalA.x * Sin}, {U, -VA});
		const uint32_t UpperVertex = AddVertex({B.x * Cos, B.y, B.x * Sin}, {NormalB.x * Cos, NormalB.y, NormalB.x * Sin}, {U, -VB});
		if (I > 0)
		{
			if (A.x > 0) { AddTriangle(PreviousA, LowerVertex, UpperVertex); }
			if (B.x > 0) { AddTriangle(PreviousA, UpperVertex, PreviousB); }
		}
		PreviousA = LowerVertex;
		PreviousB = UpperVertex;
	}
}

void FMeshBuilder::AddLathe(std::span<const glm::vec2> Profile, int Segments)
{
	// Outward normal of a step of the profile.
	const auto GetNormal = [&](size_t I) -> glm::vec2 {
		const glm::vec2 D = Profile[I + 1] - Profile[I];
		return glm::length(D) > 0 ? glm::normalize(glm::vec2(D.y, -D.x)) : glm::vec2(0);
	};
	float V = 0.0f;
	for (size_t I = 0; I + 1 < Profile.size(); ++I)
	{
		const glm::vec2 Own = GetNormal(I);
		const float Length = glm::length(Profile[I + 1] - Profile[I]) * TexelScale;
		if (Length == 0.0f) { continue; }
		// A zero step on either side means a crease: its normal adds nothing.
		const glm::vec2 Before = I > 0 ? GetNormal(I - 1) : glm::vec2(0);
		const glm::vec2 After = I + 2 < Profile.size() ? GetNormal(I + 1) : glm::vec2(0);
		AddLatheBand(Profile[I], Profile[I + 1], glm::normalize(Own + Before), glm::normalize(Own + After), V, V + Length, Segments);
		V += Length;
	}
}

namespace
{

struct FIcosphere
{
	std::vector<glm::dvec3> Directions;
	std::vector<glm::uvec3> Triangles;
};

FIcosphere MakeIcosphere(int Subdivisions)
{
	const double T = (1.0 + std::sqrt(5.0)) / 2.0;
	FIcosphere Sphere;
	for (const glm::dvec3& P : {glm::dvec3(-1, T, 0), glm::dvec3(1, T, 0), glm::dvec3(-1, -T, 0), glm::dvec3(1, -T, 0),
	         glm::dvec3(0, -1, T), glm::dvec3(0, 1, T), glm::dvec3(0, -1, -T), glm::dvec3(0, 1, -T), glm::dvec3(T, 0, -1),
	         glm::dvec3(T, 0, 1), glm::dvec3(-T, 0, -1), glm::dvec3(-T, 0, 1)})
	{
		Sphere.Directions.push_back(glm::normalize(P));
	}
	Sphere.Triangles = {{0, 11, 5}, {0, 5, 1}, {0, 1, 7}, {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4}, {11, 10, 2}, {10, 7, 6},
	    {7, 1, 8}, {3, 9, 4}, {3, 4, 2}, {3, 2, 6}, {3, 6, 8}, {3, 8, 9}, {4, 9, 5}, {2, 4, 11}, {6, 2, 10}, {8, 6, 7}, {9, 8, 1}};
	for (int Level = 0; Level < Subdivisions; ++Level)
	{
		std::map<std::pair<uint32_t, uint32_t>, uint32_t> Middles;
		const auto GetMiddle = [&](uint32_t A, uint32_t B) {
			const auto [Found, bNew] = Middles.try_emplace(std::minmax(A, B), uint32_t(Sphere.Directions.size()));
			if (bNew)
			{
				const glm::dvec3 Middle = glm::normalize(Sphere.Directions[A] + Sphere.Directions[B]);
				Sphere.Directions.push_back(Middle);
			}
			return Found->second;
		};
		std::vector<glm::uvec3> Finer;
		for (const glm::uvec3& Triangle : Sphere.Triangles)
		{
			const uint32_t AB = GetMiddle(Triangle.x, Triangle.y), BC = GetMiddle(Triangle.y, Triangle.z),
			               CA = GetMiddle(Triangle.z, Triangle.x);
			Finer.insert(Finer.end(), {{Triangle.x, AB, CA}, {AB, Triangle.y, BC}, {CA, BC, Triangle.z}, {AB, BC, CA}});
		}
		Sphere.Triangles = std::move(Finer);
	}
	return Sphere;
}

} // namespace

void FMeshBuilder::AddSphere(const glm::vec3& Center, float Radius, int Subdivisions, bool bInward)
{
	const FIcosphere Sphere = MakeIcosphere(Subdivisions);
	const uint32_t Base = uint32_t(Mesh.Positions.size());
	for (const glm::dvec3& Direction : Sphere.Directions)
	{
		const glm::vec3 N(Direction);
		const glm::vec2 UV(std::atan2(N.z, N.x) / glm::two_pi<float>() + 0.5f, std::acos(N.y) / glm::pi<float>());
		AddVertex(Center + N * Radius, bInward ? -N : N, UV);
	}
	for (const glm::uvec3& T : Sphere.Triangles) { AddTriangle(Base + T.x, Base + (bInward ? T.z : T.y), Base + (bInward ? T.y : T.z)); }
}

void FMeshBuilder::AddDisk(const glm::vec3& Center, const glm::vec3& Normal, float Radius, int Segments)
{
	const glm::vec3 U = GetPerpendicular(Normal), V = glm::cross(Normal, U);
	const uint32_t Middle = AddVertex(Center, Normal, {0, 0});
	uint32_t Previous = 0;
	for (int I = 0; I <= Segments; ++I)
	{
		const float Angle = glm::two_pi<float>() * float(I) / float(Segments);
		const glm::vec2 P = Radius * glm::vec2(std::cos(Angle), std::sin(Angle));
		const uint32_t Vertex = AddVertex(Center + U * P.x + V * P.y, Normal, P * TexelScale);
		if (I > 0) { AddTriangle(Middle, Previous, Vertex); }
		Previous = Vertex;
	}
}

void FMeshBuilder::AddTube(std::span<const glm::vec3> Path, std::span<const float> Radii, int Segments)
{
	const uint32_t Base = uint32_t(Mesh.Positions.size());
	glm::vec3 Side = GetPerpendicular(glm::normalize(Path[1] - Path[0]));
	float V = 0.0f;
	for (size_t I = 0; I < Path.size(); ++I)
	{
		const glm::vec3 Along = glm::normalize(Path[std::min(I + 1, Path.size() - 1)] - Path[I > 0 ? I - 1 : 0]);
		// Carried along rather than chosen anew, so that the tube does not twist.
		Side = glm::normalize(Side - Along * glm::dot(Side, Along));
		const glm::vec3 Other = glm::cross(Along, Side);
		V += I > 0 ? glm::length(Path[I] - Path[I - 1]) : 0.0f;
		for (int S = 0; S <= Segments; ++S)
		{
			const float Angle = glm::two_pi<float>() * float(S) / float(Segments);
			const glm::vec3 N = Side * std::cos(Angle) + Other * std::sin(Angle);
			const float U = glm::two_pi<float>() * Radii[I] * float(S) / float(Segments);
			AddVertex(Path[I] + N * Radii[I], N, glm::vec2(U, -V) * TexelScale);
		}
	}
	const uint32_t Row = uint32_t(Segments) + 1;
	for (uint32_t I = 0; I + 1 < Path.size(); ++I)
	{
		for (uint32_t S = 0; S < uint32_t(Segments); ++S)
		{
			const uint32_t A = Base + I * Row + S;
			AddTriangle(A, A + 1, A + Row + 1);
			AddTriangle(A, A + Row + 1, A + Row);
		}
	}
}

double FMeshBuilder::ComputeArea() const
{
	double Area = 0.0;
	for (size_t I = 0; I + 2 < Mesh.Indices.size(); I += 3)
	{
		const glm::dvec3 A(Mesh.Positions[Mesh.Indices[I]]), B(Mesh.Positions[Mesh.Indices[I + 1]]), C(Mesh.Positions[Mesh.Indices[I + 2]]);
		Area += 0.5 * glm::length(glm::cross(B - A, C - A));
	}
	return Area;
}

void FMeshBuilder::Scale(float Factor)
{
	for (glm::vec3& Position : Mesh.Positions) { Position *= Factor; }
}

FHostMesh FMeshBuilder::Build()
{
	const std::vector<glm::vec4> Tangents = ComputeTangents(Mesh.Positions, Normals, UVs, Mesh.Indices);
	Mesh.BoundsMin = Mesh.BoundsMax = Mesh.Positions[0];
	for (size_t I = 0; I < Mesh.Positions.size(); ++I)
	{
		FVertexAttributes Attributes{};
		Attributes.Normal = PackUnitVector(Normals[I]);
		Attributes.Tangent = PackTangent(Tangents[I]);
		Attributes.UV0 = UVs[I];
		Attributes.UV1 = UVs[I];
		Attributes.Color = PackColor(glm::vec4(Colors[I], 1));
		Mesh.Attributes.push_back(Attributes);
		Mesh.BoundsMin = glm::min(Mesh.BoundsMin, Mesh.Positions[I]);
		Mesh.BoundsMax = glm::max(Mesh.BoundsMax, Mesh.Positions[I]);
	}
	Mesh.bHasTangents = true;
	return std::move(Mesh);
}

} // namespace Lantern::Builtin
