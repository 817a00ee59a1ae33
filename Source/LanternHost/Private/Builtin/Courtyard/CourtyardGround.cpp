// Paving, steps, gallery floors, and the land around.
#include <cmath>

#include <glm/gtc/constants.hpp>

#include "Builtin/Courtyard/CourtyardParts.h"
#include "Builtin/ProceduralTextures.h"

namespace Lantern::Builtin
{

namespace
{

/// A ring of hills from the walls to the horizon; polar, finer near the yard.
void AddHills(const FCourtyard& Yard)
{
	constexpr int Rings = 40, Segments = 96;
	FMeshBuilder Mesh("hills");
	Mesh.BeginSection(Yard.M.Grass);
	const auto GetPoint = [](int Ring, int Segment) {
		const float T = float(Ring) / float(Rings);
		const float Radius = 14.0f + 700.0f * T * T * T;
		const float Angle = glm::two_pi<float>() * float(Segment % Segments) / float(Segments);
		const glm::vec2 P(Radius * std::cos(Angle), Radius * std::sin(Angle));
		const float Rolling = SampleFractal(P / 1500.0f + 0.5f, 8, 3, 0.45f, 17) - 0.42f;
		const float Far = glm::clamp((Radius - 30.0f) / 300.0f, 0.0f, 1.0f);
		return glm::vec3(P.x, -0.06f + Far * (10.0f * Far + 150.0f * std::max(Rolling, -0.04f)), P.y);
	};
	const uint32_t Base = 0;
	for (int Ring = 0; Ring <= Rings; ++Ring)
	{
		for (int Segment = 0; Segment <= Segments; ++Segment)
		{
			const glm::vec3 P = GetPoint(Ring, Segment);
			const glm::vec3 Out = GetPoint(std::min(Ring + 1, Rings), Segment) - GetPoint(std::max(Ring - 1, 0), Segment);
			const glm::vec3 Along = GetPoint(Ring, Segment + 1) - GetPoint(Ring, Segment + Segments - 1);
			Mesh.AddVertex(P, glm::normalize(glm::cross(Along, Out)), glm::vec2(P.x, P.z));
		}
	}
	constexpr uint32_t Row = Segments + 1;
	for (uint32_t Ring = 0; Ring < Rings; ++Ring)
	{
		for (uint32_t Segment = 0; Segment < Segments; ++Segment)
		{
			const uint32_t A = Base + Ring * Row + Segment;
			Mesh.AddTriangle(A, A + Row + 1, A + Row);
			Mesh.AddTriangle(A, A + 1, A + Row + 1);
		}
	}
	Yard.Builder.AddNode("hills", Yard.Builder.AddMesh(Mesh));
}

void AddPaving(const FCourtyard& Yard)
{
	FMeshBuilder Mesh("paving");
	Mesh.BeginSection(Yard.M.Paving);
	constexpr float S = YardHalf;
	Mesh.AddQuad({-S, 0, S}, {S, 0, S}, {S, 0, -S}, {-S, 0, -S});
	// Gallery floors, west, north, east, with a step before each.
	constexpr float Out = S + GalleryDepth + 0.3f, In = S - 0.45f;
	Mesh.AddBeveledBox({-S - 0.6f, -0.2f, -Out}, {-In, GalleryHeight, S}, 0.015f);
	Mesh.AddBeveledBox({In, -0.2f, -Out}, {Out, GalleryHeight, S}, 0.015f);
	Mesh.AddBeveledBox({-In, -0.2f, -Out}, {In, GalleryHeight, -In}, 0.015f);
	Mesh.BeginSection(Yard.M.Trim);
	constexpr float Step = 0.36f, Half = GalleryHeight / 2;
	Mesh.AddBeveledBox({-In, -0.1f, -In}, {-In + Step, Half, S}, 0.015f);
	Mesh.AddBeveledBox({In - Step, -0.1f, -In}, {In, Half, S}, 0.015f);
	Mesh.AddBeveledBox({-In + Step, -0.1f, -In}, {In - Step, Half, -In + Step}, 0.015f);
	Yard.Builder.AddNode("paving", Yard.Builder.AddMesh(Mesh));
}

} // namespace

void BuildGround(const FCourtyard& Yard)
{
	AddPaving(Yard);
	AddHills(Yard);
}

} // namespace Lantern::Builtin
