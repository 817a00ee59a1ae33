// Materials, boxes, stripes, lamps and animations of the stability scenes.
#include "Builtin/Stability/StabilityParts.h"

#include <cmath>

#include <glm/gtc/constants.hpp>

namespace Lantern::Builtin
{

int32_t AddPaint(FSceneBuilder& Builder, const char* Name, const glm::vec3& Albedo, float Roughness)
{
	FHostMaterial Material;
	Material.Name = Name;
	Material.BaseColor = glm::vec4(Albedo, 1);
	Material.Metallic = 0.0f;
	Material.Roughness = Roughness;
	return Builder.AddMaterial(Material);
}

int32_t AddMetal(FSceneBuilder& Builder, const char* Name, const glm::vec3& Color, float Roughness)
{
	const int32_t Material = AddPaint(Builder, Name, Color, Roughness);
	Builder.Scene.Materials[size_t(Material)].Metallic = 1.0f;
	return Material;
}

void AddBoxNode(FSceneBuilder& Builder, const char* Name, int32_t Material, const glm::vec3& Min, const glm::vec3& Max)
{
	FMeshBuilder Mesh(Name);
	Mesh.BeginSection(Material);
	const glm::vec3 Half = 0.5f * (Max - Min);
	Mesh.AddBox(-Half, Half);
	Builder.AddNode(Name, Builder.AddMesh(Mesh), 0.5f * (Min + Max));
}

void AddGround(FSceneBuilder& Builder, int32_t Material, float Size, float Y)
{
	FMeshBuilder Mesh("ground");
	Mesh.BeginSection(Material);
	const float S = Size / 2;
	Mesh.AddQuad({-S, Y, S}, {S, Y, S}, {S, Y, -S}, {-S, Y, -S});
	Builder.AddNode("ground", Builder.AddMesh(Mesh));
}

void AddStripes(FSceneBuilder& Builder, const char* Name, int32_t A, int32_t B, const glm::vec3& Center, const glm::vec3& Normal,
    float Width, float Height, float Stripe)
{
	const glm::vec3 Up(0, Height / 2, 0), Right = glm::cross(glm::vec3(0, 1, 0), Normal);
	const int Count = int(std::ceil(Width / Stripe));
	FMeshBuilder Mesh(Name);
	for (int Odd = 0; Odd < 2; ++Odd)
	{
		Mesh.BeginSection(Odd ? B : A);
		for (int I = Odd; I < Count; I += 2)
		{
			const glm::vec3 Left = Center + Right * (float(I) * Stripe - Width / 2),
			                Next = Center + Right * (std::min(float(I + 1) * Stripe, Width) - Width / 2);
			Mesh.AddQuad(Left - Up, Next - Up, Next + Up, Left + Up);
		}
	}
	Builder.AddNode(Name, Builder.AddMesh(Mesh));
}

void AddKeys(FSceneBuilder& Builder, int32_t Node, EAnimationPath Path, float Seconds, std::vector<glm::vec4> Values)
{
	FHostAnimation Animation;
	Animation.Name = "motion";
	Animation.Duration = Seconds;
	FHostChannel Channel;
	Channel.Node = Node;
	Channel.Path = Path;
	for (size_t I = 0; I < Values.size(); ++I) { Channel.Times.push_back(Seconds * float(I) / float(Values.size() - 1)); }
	Channel.Values = std::move(Values);
	Animation.Channels.push_back(std::move(Channel));
	Builder.Scene.Animations.push_back(std::move(Animation));
}

void SetDarkness(FSceneBuilder& Builder, float Exposure)
{
	Builder.Scene.DefaultExposure = Exposure;
	Builder.SetLight({0, -1, 0}, 0.0f, glm::vec3(0));
}

void LightByLamp(FSceneBuilder& Builder, const glm::vec3& Center, float Distance)
{
	const glm::vec4 Sun = Builder.Scene.DefaultSun.value();
	const float Radius = Distance * std::sin(0.5f * glm::radians(Builder.Scene.DefaultSunDiameter));
	const float Radiance = Sun.w * Distance * Distance / (glm::pi<float>() * Radius * Radius);
	Builder.AddPointLight("lamp", Center - Distance * glm::vec3(Sun), glm::vec3(Radiance));
	FHostLight& Lamp = Builder.Scene.Lights.back();
	Lamp.Type = LIGHT_SPHERE;
	Lamp.Size.x = Radius;
	Builder.SetLight(glm::vec3(Sun), 0.0f, glm::vec3(0));
}

void AddFlicker(FSceneBuilder& Builder, float Hz, float Phase)
{
	Builder.Scene.Lights.back().FlickerHz = Hz;
	Builder.Scene.Lights.back().FlickerPhase = Phase;
}

} // namespace Lantern::Builtin
