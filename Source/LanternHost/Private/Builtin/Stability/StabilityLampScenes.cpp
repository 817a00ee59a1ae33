// Scenes with lamps: switched, flickering, many.
#include <cmath>

#include <glm/gtc/constants.hpp>

#include "Builtin/Random.h"
#include "Builtin/Stability/StabilityLaterScenes.h"
#include "Builtin/Stability/StabilityParts.h"
#include "Builtin/Stability/StabilityRoom.h"

namespace Lantern::Builtin
{

namespace
{

void SetDarkness(FSceneBuilder& Builder, float Exposure)
{
	Builder.Scene.DefaultExposure = Exposure;
	Builder.SetLight({0, -1, 0}, 0.0f, glm::vec3(0));
}

void AddFlicker(FSceneBuilder& Builder, float Hz, float Phase)
{
	Builder.Scene.Lights.back().FlickerHz = Hz;
	Builder.Scene.Lights.back().FlickerPhase = Phase;
}

} // namespace

FSceneDescription BuildStabilitySwitch(float Period)
{
	FSceneBuilder Builder("stability-switch");
	AddRoom(Builder, AddPaint(Builder, "wall", {0.7f, 0.68f, 0.62f}, 0.7f), {-4, 0, -2.5f}, {4, 2.8f, 2.5f});
	AddBoxNode(Builder, "partition", AddPaint(Builder, "partition", {0.7f, 0.35f, 0.25f}, 0.7f), {0.4f, 0, -2.5f}, {0.6f, 2.8f, 1.0f});
	const int32_t Block = AddPaint(Builder, "block", {0.3f, 0.45f, 0.65f}, 0.5f);
	AddBoxNode(Builder, "near block", Block, {-2.4f, 0, -1.6f}, {-1.4f, 1.1f, -0.6f});
	AddBoxNode(Builder, "far block", Block, {1.9f, 0, -1.4f}, {2.7f, 0.8f, -0.6f});
	Builder.AddPointLight("lamp", {-2.2f, 2.4f, 0.5f}, glm::vec3(25.0f));
	AddFlicker(Builder, 1.0f / Period, 0.0f);
	Builder.AddCamera({0.5, 1.7, 2.4}, {0.45, 0.8, -1.5}, 85);
	SetDarkness(Builder, -2.0f);
	return std::move(Builder.Scene);
}

FSceneDescription BuildStabilityFlicker()
{
	FSceneBuilder Builder("stability-flicker");
	AddRoom(Builder, AddPaint(Builder, "wall", glm::vec3(0.6f), 0.6f), {-8, 0, -4}, {8, 3.2f, 4});
	const int32_t Column = AddPaint(Builder, "column", {0.6f, 0.5f, 0.4f}, 0.4f);
	for (int I = 0; I < 6; ++I)
	{
		const glm::vec3 At(-6.5f + 2.6f * float(I), 0, I % 2 ? 1.1f : -1.4f);
		AddBoxNode(Builder, "column", Column, At - glm::vec3(0.2f, 0, 0.2f), At + glm::vec3(0.2f, 3.2f, 0.2f));
	}
	for (int I = 0; I < 32; ++I)
	{
		const int X = I % 8, Z = I / 8;
		const bool bFast = (X + Z) % 2 == 1;
		const glm::vec3 Color = bFast ? glm::vec3(1.5f, 2.2f, 3.0f) : glm::vec3(3.0f, 2.0f, 1.2f);
		Builder.AddPointLight("lamp", {-7.0f + 2.0f * float(X), 2.7f, -3.0f + 2.0f * float(Z)}, Color);
		// Eight phases: their sum hardly changes, what each lights does.
		AddFlicker(Builder, bFast ? 15.0f : 5.0f, float((X * 3 + Z) % 8) / 8.0f);
	}
	Builder.AddCamera({-7.2, 1.7, 3.4}, {1.5, 0.9, -1.2}, 65);
	SetDarkness(Builder, -1.5f);
	return std::move(Builder.Scene);
}

FSceneDescription BuildStabilityBoiling()
{
	FSceneBuilder Builder("stability-boiling");
	AddRoom(Builder, AddPaint(Builder, "wall", glm::vec3(0.55f), 0.5f), {-20, 0, -8}, {20, 5, 8});
	const int32_t Column = AddPaint(Builder, "column", glm::vec3(0.6f), 0.35f);
	for (int I = 0; I < 27; ++I)
	{
		const glm::vec3 At(-18.0f + 4.5f * float(I % 9), 0, -5.0f + 5.0f * float(I / 9));
		AddBoxNode(Builder, "column", Column, At - glm::vec3(0.35f, 0, 0.35f), At + glm::vec3(0.35f, 5, 0.35f));
	}
	FRandomStream Random(640);
	for (int I = 0; I < 640; ++I)
	{
		const glm::vec3 At{-19.5f + float(I % 40) + Random.Between(-0.3f, 0.3f), Random.Between(0.4f, 4.6f),
		    -7.5f + float(I / 40) + Random.Between(-0.3f, 0.3f)};
		const glm::vec3 Color{Random.Between(0.2f, 1.0f), Random.Between(0.2f, 1.0f), Random.Between(0.2f, 1.0f)};
		Builder.AddPointLight("lamp", At, 0.35f * Color * Random.Between(0.3f, 1.7f));
	}
	Builder.AddCamera({-18.8, 1.9, 7.2}, {2, 1.2, -3}, 60);
	SetDarkness(Builder, -1.0f);
	return std::move(Builder.Scene);
}

FSceneDescription BuildStabilityLightGrid()
{
	FSceneBuilder Builder("stability-lightgrid");
	AddGround(Builder, Builder.AddLambert("floor", glm::vec3(0.5f)), 120.0f);
	for (int I = 0; I < 640; ++I)
	{
		Builder.AddPointLight("lamp", {-19.5f + float(I % 32) * 1.25f, 2.0f, -11.875f + float(I / 32) * 1.25f}, glm::vec3(1.0f));
	}
	Builder.AddCamera({0, 7, 15}, {0, 0, -1}, 60);
	SetDarkness(Builder, -1.0f);
	return std::move(Builder.Scene);
}

} // namespace Lantern::Builtin
