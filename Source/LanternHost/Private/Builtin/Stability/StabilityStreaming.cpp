// A street at night into which glowing objects are streamed.
#include "Builtin/Stability/StabilityParts.h"
#include "Builtin/Stability/StabilityScenes.h"

namespace Lantern::Builtin
{

FSceneDescription BuildStabilityStreaming()
{
	FSceneBuilder Builder("stability-streaming");
	constexpr float Length = 400.0f;
	FMeshBuilder Street("street");
	Street.BeginSection(AddPaint(Builder, "road", glm::vec3(0.4f), 0.7f));
	for (float Z = 20; Z > -Length; Z -= 10) { Street.AddQuad({-6, 0, Z}, {6, 0, Z}, {6, 0, Z - 10}, {-6, 0, Z - 10}); }
	Builder.AddNode("road", Builder.AddMesh(Street));
	const int32_t Walls[] = {
	    AddPaint(Builder, "red wall", {0.6f, 0.4f, 0.35f}, 0.7f), AddPaint(Builder, "wall", {0.55f, 0.55f, 0.5f}, 0.6f)};
	for (int I = 0; I < 40; ++I)
	{
		const float Z = 20.0f - 10.0f * float(I);
		AddBoxNode(Builder, "left", Walls[I % 2], {-8, 0, Z - 9}, {-5, 5.0f + float(I % 3), Z});
		AddBoxNode(Builder, "right", Walls[(I + 1) % 2], {5, 0, Z - 9}, {8, 5.0f + float((I + 1) % 3), Z});
	}
	FMeshBuilder Lantern("lantern");
	Lantern.BeginSection(Builder.AddLambert("glow", glm::vec3(0.3f), {30.0f, 22.0f, 12.0f}));
	Lantern.AddBox(glm::vec3(-0.15f), glm::vec3(0.15f));
	Builder.AddNode("lantern", Builder.AddMesh(Lantern), {0, 4.5f, 14}); // behind the camera
	Builder.AddCamera({0, 1.8, 10}, {0, 1.2, 0}, 70);
	Builder.SetLight({0.3f, -1, -0.2f}, 0.0f, {0.02f, 0.03f, 0.06f});
	return std::move(Builder.Scene);
}

} // namespace Lantern::Builtin
