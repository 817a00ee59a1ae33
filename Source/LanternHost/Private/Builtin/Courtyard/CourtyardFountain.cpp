// The fountain: basin, bowl, jets, and an armillary sphere that turns above it.
#include <cmath>
#include <vector>

#include <glm/gtc/constants.hpp>
#include <glm/gtc/matrix_transform.hpp>

#include "Builtin/Courtyard/CourtyardParts.h"

namespace Lantern::Builtin
{

namespace
{

const glm::vec3 Place(0, 0, -0.8f);

void AddStone(const FCourtyard& Yard)
{
	FMeshBuilder Mesh("fountain");
	Mesh.BeginSection(Yard.M.Trim);
	const glm::vec2 Step[] = {{2.45f, 0}, {2.45f, 0.14f}, {2.45f, 0.14f}, {2.42f, 0.16f}, {1.9f, 0.16f}};
	Mesh.AddLathe(Step, 64);
	const glm::vec2 Basin[] = {{1.95f, 0.16f}, {1.98f, 0.22f}, {1.88f, 0.28f}, {1.85f, 0.50f}, {1.90f, 0.58f}, {2.00f, 0.62f},
	    {2.02f, 0.68f}, {1.98f, 0.72f}, {1.98f, 0.72f}, {1.70f, 0.72f}, {1.70f, 0.72f}, {1.66f, 0.66f}, {1.66f, 0.20f}};
	Mesh.AddLathe(Basin, 64);
	const glm::vec2 Stem[] = {{0.42f, 0.2f}, {0.42f, 0.60f}, {0.42f, 0.60f}, {0.34f, 0.66f}, {0.20f, 0.78f}, {0.16f, 0.95f}, {0.22f, 1.10f},
	    {0.26f, 1.18f}, {0.18f, 1.27f}, {0.16f, 1.32f}, {0.30f, 1.36f}, {0.62f, 1.48f}, {0.84f, 1.66f}, {0.90f, 1.70f}, {0.90f, 1.74f},
	    {0.90f, 1.74f}, {0.84f, 1.74f}, {0.84f, 1.74f}, {0.60f, 1.58f}, {0.14f, 1.54f}, {0.14f, 1.54f}, {0.12f, 1.80f}, {0.09f, 2.00f},
	    {0.13f, 2.08f}, {0.10f, 2.16f}, {0.0f, 2.18f}};
	Mesh.AddLathe(Stem, 48);
	Mesh.AddDisk({0, 0.2f, 0}, {0, 1, 0}, 1.67f, 64); // under the water
	Yard.Builder.AddNode("fountain", Yard.Builder.AddMesh(Mesh), Place);
}

void AddWater(const FCourtyard& Yard)
{
	FMeshBuilder Mesh("water");
	Mesh.BeginSection(Yard.M.Water);
	Mesh.AddDisk({0, 0.60f, 0}, {0, 1, 0}, 1.67f, 64);
	Mesh.AddDisk({0, 1.69f, 0}, {0, 1, 0}, 0.86f, 48);
	Mesh.BeginSection(Yard.M.Spray);
	for (int Jet = 0; Jet < 8; ++Jet)
	{
		// Over the lip of the bowl, in the parabola of a free fall.
		const float Angle = glm::two_pi<float>() * (float(Jet) + 0.5f) / 8;
		std::vector<glm::vec3> Path;
		std::vector<float> Radii;
		for (int I = 0; I <= 16; ++I)
		{
			const float T = 0.47f * float(I) / 16, Out = 0.86f + 0.75f * T;
			Path.emplace_back(Out * std::cos(Angle), 1.73f - 4.905f * T * T, Out * std::sin(Angle));
			Radii.push_back(0.022f - 0.010f * float(I) / 16);
		}
		Mesh.AddTube(Path, Radii, 8);
	}
	Yard.Builder.AddNode("water", Yard.Builder.AddMesh(Mesh), Place);
}

void AddArmillary(const FCourtyard& Yard)
{
	FMeshBuilder Mesh("armillary sphere");
	Mesh.BeginSection(Yard.M.Bronze);
	const auto AddRing = [&](const glm::mat4& Turn, float Radius, float Width) {
		Mesh.SetTransform(Turn);
		const glm::vec2 Profile[] = {{Radius - 0.012f, -Width}, {Radius - 0.012f, -Width}, {Radius + 0.012f, -Width},
		    {Radius + 0.012f, -Width}, {Radius + 0.012f, Width}, {Radius + 0.012f, Width}, {Radius - 0.012f, Width},
		    {Radius - 0.012f, Width}, {Radius - 0.012f, -Width}};
		Mesh.AddLathe(Profile, 48);
	};
	const glm::mat4 One(1);
	AddRing(One, 0.40f, 0.035f);
	AddRing(glm::rotate(One, glm::half_pi<float>(), {1, 0, 0}), 0.43f, 0.018f);
	AddRing(glm::rotate(One, glm::half_pi<float>(), {0, 0, 1}), 0.43f, 0.018f);
	AddRing(glm::rotate(One, 0.41f, {0.3f, 0, 1}), 0.46f, 0.045f);
	Mesh.SetTransform(One);
	Mesh.AddSphere({0, 0, 0}, 0.10f, 3);
	const glm::vec3 Axis[] = {{0, -0.55f, 0}, {0, 0.55f, 0}};
	const float Radii[] = {0.012f, 0.012f};
	Mesh.AddTube(Axis, Radii, 10);
	const int32_t Node = Yard.Builder.AddNode("armillary sphere", Yard.Builder.AddMesh(Mesh), Place + glm::vec3(0, 2.68f, 0));
	AddTurning(Yard.Builder, Node, 12.0f);
}

} // namespace

void BuildFountain(const FCourtyard& Yard)
{
	AddStone(Yard);
	AddWater(Yard);
	AddArmillary(Yard);
}

} // namespace Lantern::Builtin
