// A scene for local lights: a floor of which half is glossy, posts that cast shadows, and lamps of several kinds.
#pragma once

#include <cmath>
#include <vector>

#include <glm/gtc/matrix_transform.hpp>

#include "SignalFixture.h"

namespace Lantern
{

class FLocalLightsFixture : public FSignalTest
{
protected:
	/// A floor of which half is glossy, four posts on it, and no light.
	void LoadPosts()
	{
		FTestScene Scene("posts");
		FHostMaterial Glossy;
		Glossy.BaseColor = glm::vec4(0.6f, 0.4f, 0.3f, 1.0f);
		Glossy.Metallic = 0.0f;
		Glossy.Roughness = 0.4f;
		const int32_t Floor = Scene.AddLambert(glm::vec3(0.5f)), Shiny = Scene.AddMaterial(Glossy);
		Scene.AddNode(Scene.AddMesh({FTestScene::MakeFloor(Floor, 4.0f, 0.0f, {-4, 0}), FTestScene::MakeFloor(Shiny, 4.0f, 0.0f, {4, 0})}));
		const int32_t Post = Scene.AddMesh(
		    {{Scene.AddLambert(glm::vec3(0.5f), glm::vec3(0), true), {{-0.3f, 0, 0}, {0.3f, 0, 0}, {0.3f, 1.2f, 0}, {-0.3f, 1.2f, 0}}}});
		for (const glm::dvec3 At : {glm::dvec3(-1.5, 0, 0.3), {-0.4, 0, -0.6}, {0.6, 0, 0.5}, {1.6, 0, -0.4}})
		{
			Scene.AddNode(Post, glm::translate(glm::dmat4(1), At));
		}
		ASSERT_TRUE(Load(std::move(Scene.Scene)));
		SetSun(0.0, 0.0f);
		SetSky(glm::vec3(0));
	}
	static FRTScene& GetWorld() { return GetScene().GetScene(); }
	/// Point lights over the floor, every fourth one a sphere, every fifth a spot.
	static std::vector<FLightId> AddLamps(uint32_t Count)
	{
		std::vector<FLightId> Ids;
		for (uint32_t I = 0; I < Count; ++I)
		{
			const double Angle = 2.4 * I, Far = 2.6 * std::sqrt((I + 0.5) / Count);
			FSceneLight Light;
			Light.Position = {Far * std::cos(Angle), 0.5 + 0.13 * (I % 9), Far * std::sin(Angle)};
			Light.Color = glm::vec3(1.0f + float(I % 3), 1.5f, 0.7f + 0.4f * float(I % 5)) * (4.0f / float(Count));
			Light.Range = I % 2 == 0 ? 0.0f : 3.0f;
			if (I % 4 == 3)
			{
				Light.Type = LIGHT_SPHERE;
				Light.Size = {0.1, 0};
				Light.Color *= 30.0f;
			}
			if (I % 5 == 4)
			{
				Light.InnerCone = 0.4f;
				Light.OuterCone = 0.9f;
			}
			Ids.push_back(GetWorld().AddLight(Light));
		}
		return Ids;
	}
	static FView LookAtPosts(uint32_t Width, uint32_t Height) { return LookAt({0, 3.0, 4.5}, {0, 0.2, 0}, 0.9f, Width, Height); }
};

} // namespace Lantern
