// A metal railing whose bars are a pixel wide.
#include <cmath>

#include "Builtin/Stability/StabilityParts.h"
#include "Builtin/Stability/StabilityScenes.h"

namespace Lantern::Builtin
{

FSceneDescription BuildStabilityRailing(float Rows, int Lamps)
{
	constexpr float Distance = 6.0f, FovY = 40.0f;
	// The width of a pixel at the railing's distance.
	const float Width = 2.0f * Distance * std::tan(glm::radians(FovY) / 2) / Rows;
	FSceneBuilder Builder("stability-railing");
	AddGround(Builder, AddPaint(Builder, "floor", {0.35f, 0.33f, 0.3f}, 0.7f), 60.0f);
	AddBoxNode(Builder, "wall", AddPaint(Builder, "wall", {0.12f, 0.14f, 0.18f}, 0.8f), {-8, 0, -5.2f}, {8, 5, -5});
	FMeshBuilder Railing("railing");
	Railing.BeginSection(AddMetal(Builder, "steel", glm::vec3(0.8f), 0.15f));
	const float Radius[2] = {Width / 2, Width / 2};
	const auto AddBar = [&](const glm::vec3& From, const glm::vec3& To) {
		const glm::vec3 Path[2] = {From, To};
		Railing.AddTube(Path, Radius, 12);
	};
	for (int I = -22; I <= 22; ++I)
	{
		// A little out of plumb, as no real one is exact: bars cross columns of pixels.
		const float X = 0.16f * float(I);
		AddBar({X, 0, 0}, {X + 0.02f * std::sin(float(I)), 1.9f, 0});
	}
	for (const float Y : {0.2f, 1.1f, 1.9f}) { AddBar({-3.8f, Y, 0}, {3.8f, Y, 0}); }
	Builder.AddNode("railing", Builder.AddMesh(Railing));
	Builder.AddCamera({0, 1.4, double(Distance)}, {0, 1.15, 0}, FovY);
	for (int I = 0; I < Lamps; ++I)
	{
		const float Across = (float(I) + 0.5f) / float(Lamps) - 0.5f;
		Builder.AddPointLight("lamp", {9.0f * Across, 1.6f + 0.4f * float(I % 4), I % 2 ? 2.5f : -1.5f}, glm::vec3(3.0f));
	}
	if (Lamps > 0)
	{
		SetDarkness(Builder, -1.0f);
		return std::move(Builder.Scene);
	}
	Builder.SetLight({-0.3f, -0.8f, -0.6f}, 4.0f, {0.25f, 0.35f, 0.5f});
	return std::move(Builder.Scene);
}

} // namespace Lantern::Builtin
