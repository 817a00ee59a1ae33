// A bounding volume hierarchy over triangles, in double precision.
#include "TriangleTruth.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace Lantern
{

namespace
{
glm::vec3 UnpackNormal(uint32_t Packed)
{
	const glm::vec2 E = glm::unpackSnorm2x16(Packed);
	glm::vec3 N(E, 1.0f - std::abs(E.x) - std::abs(E.y));
	const float Fold = std::max(-N.z, 0.0f);
	N.x += N.x >= 0.0f ? -Fold : Fold;
	N.y += N.y >= 0.0f ? -Fold : Fold;
	return glm::normalize(N);
}
} // namespace

FTriangleSoup MakeSoup(const FSceneDescription& Scene)
{
	FTriangleSoup Soup;
	const FScenePose Pose = EvaluatePose(Scene, 0.0);
	for (size_t Node = 0; Node < Scene.Nodes.size(); ++Node)
	{
		if (Scene.Nodes[Node].Mesh < 0) { continue; }
		const FHostMesh& Mesh = Scene.Meshes[static_cast<size_t>(Scene.Nodes[Node].Mesh)];
		const glm::dmat4& World = Pose.World[Node];
		const glm::dmat3 NormalMatrix = glm::transpose(glm::inverse(glm::dmat3(World)));
		for (size_t I = 0; I + 2 < Mesh.Indices.size(); I += 3)
		{
			glm::vec3 Corners[3], Normals[3];
			for (size_t J = 0; J < 3; ++J)
			{
				const uint32_t Vertex = Mesh.Indices[I + J];
				Corners[J] = glm::vec3(World * glm::dvec4(glm::dvec3(Mesh.Positions[Vertex]), 1.0));
				Normals[J] = glm::vec3(glm::normalize(NormalMatrix * glm::dvec3(UnpackNormal(Mesh.Attributes[Vertex].Normal))));
			}
			const glm::dvec3 A(Corners[0]), B(Corners[1]), C(Corners[2]);
			if (!(glm::length(glm::cross(B - A, C - A)) > 1e-12)) { continue; } // no area: nothing sees it
			Soup.Positions.insert(Soup.Positions.end(), Corners, Corners + 3);
			Soup.Normals.insert(Soup.Normals.end(), Normals, Normals + 3);
		}
	}
	return Soup;
}

FTriangleTruth::FTriangleTruth(const FTriangleSoup& InSoup) : Soup(InSoup), Order(InSoup.GetCount()), Centers(InSoup.GetCount())
{
	std::iota(Order.begin(), Order.end(), 0u);
	for (uint32_t I = 0; I < Centers.size(); ++I) { Centers[I] = (Corner(I, 0) + Corner(I, 1) + Corner(I, 2)) / 3.0; }
	Nodes.reserve(Centers.size() * 2 + 1);
	Nodes.emplace_back();
	Build(0, 0, static_cast<uint32_t>(Order.size()));
}

void FTriangleTruth::Build(uint32_t Node, uint32_t Begin, uint32_t End)
{
	constexpr uint32_t LeafSize = 4;
	glm::dvec3 Min(1e300), Max(-1e300), CenterMin(1e300), CenterMax(-1e300);
	for (uint32_t I = Begin; I < End; ++I)
	{
		for (uint32_t J = 0; J < 3; ++J)
		{
			Min = glm::min(Min, Corner(Order[I], J));
			Max = glm::max(Max, Corner(Order[I], J));
		}
		CenterMin = glm::min(CenterMin, Centers[Order[I]]);
		CenterMax = glm::max(CenterMax, Centers[Order[I]]);
	}
	// Rounding of the slab test must not lose what lies in the plane of a side.
	Nodes[Node].Min = Min - 1e-9;
	Nodes[Node].Max = Max + 1e-9;
	if (End - Begin <= LeafSize)
	{
		Nodes[Node].First = Begin;
		Nodes[Node].Count = End - Begin;
		return;
	}
	const glm::dvec3 Size = CenterMax - CenterMin;
	const int Axis = Size.x >= Size.y && Size.x >= Size.z ? 0 : Size.y >= Size.z ? 1 : 2;
	const uint32_t Middle = (Begin + End) / 2;
	std::nth_element(Order.begin() + Begin, Order.begin() + Middle, Order.begin() + End,
	    [&](uint32_t A, uint32_t B) { return Centers[A][Axis] < Centers[B][Axis]; });
	const auto Left = static_cast<uint32_t>(Nodes.size());
	Nodes[Node].First = Left;
	Nodes.emplace_back();
	Nodes.emplace_back();
	Build(Left, Begin, Middle);
	Build(Left + 1, Middle, End);
}

glm::dvec3 FTriangleTruth::Intersect(uint32_t Triangle, const glm::dvec3& Origin, const glm::dvec3& Direction) const
{
	// Möller and Trumbore 1997.
	const glm::dvec3 A = Corner(Triangle, 0), AB = Corner(Triangle, 1) - A, AC = Corner(Triangle, 2) - A;
	const glm::dvec3 P = glm::cross(Direction, AC);
	const double Determinant = glm::dot(AB, P);
	if (Determinant == 0.0) { return {-1, -1, -1}; }
	const glm::dvec3 FromA = Origin - A, Q = glm::cross(FromA, AB);
	return glm::dvec3(glm::dot(AC, Q), glm::dot(FromA, P), glm::dot(Direction, Q)) / Determinant;
}

bool FTriangleTruth::IsBlocked(const glm::dvec3& Origin, const glm::dvec3& Direction, uint32_t Ignored) const
{
	const glm::dvec3 Inverse = 1.0 / Direction;
	uint32_t Stack[128] = {0}, Depth = 1;
	while (Depth > 0)
	{
		const FNode& Node = Nodes[Stack[--Depth]];
		const glm::dvec3 A = (Node.Min - Origin) * Inverse, B = (Node.Max - Origin) * Inverse;
		const glm::dvec3 Near = glm::min(A, B), Far = glm::max(A, B);
		if (std::max({Near.x, Near.y, Near.z, 0.0}) > std::min({Far.x, Far.y, Far.z})) { continue; }
		if (Node.Count == 0)
		{
			Stack[Depth++] = Node.First;
			Stack[Depth++] = Node.First + 1;
			continue;
		}
		for (uint32_t I = Node.First; I < Node.First + Node.Count; ++I)
		{
			if (Order[I] == Ignored) { continue; }
			const glm::dvec3 Hit = Intersect(Order[I], Origin, Direction);
			// A neighbour that shares an edge with the ray's own triangle is met at the edge, at 0.
			if (Hit.x > 1e-9 && Hit.y >= 0.0 && Hit.z >= 0.0 && Hit.y + Hit.z <= 1.0) { return true; }
		}
	}
	return false;
}

FTriangleTruth::FPlanePoint FTriangleTruth::MeetPlane(uint32_t Triangle, const glm::dvec3& Origin, const glm::dvec3& Direction) const
{
	FPlanePoint Out;
	const glm::dvec3 Hit = Intersect(Triangle, Origin, Direction);
	Out.Point = Origin + Direction * Hit.x;
	const glm::dvec3 A = Corner(Triangle, 0);
	Out.Normal = glm::normalize(glm::cross(Corner(Triangle, 1) - A, Corner(Triangle, 2) - A));
	if (glm::dot(Out.Normal, Direction) > 0.0) { Out.Normal = -Out.Normal; }
	Out.bInside = Hit.x > 0.0 && Hit.y >= 0.0 && Hit.z >= 0.0 && Hit.y + Hit.z <= 1.0;
	return Out;
}

} // namespace Lantern
