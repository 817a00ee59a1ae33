// A dark room with thin walls under open sky: light must not leak in.
#include "Builtin/Stability/StabilityParts.h"
#include "Builtin/Stability/StabilityScenes.h"

namespace Lantern::Builtin
{

FSceneDescription BuildStabilityWall(float Centimetres, float SlitCentimetres)
{
	FSceneBuilder Builder("stability-wall");
	AddGround(Builder, AddPaint(Builder, "ground", glm::vec3(0.5f), 0.6f), 40.0f, -0.5f);
	const int32_t Wall = AddPaint(Builder, "wall", {0.7f, 0.65f, 0.6f}, 0.6f);
	Builder.Scene.Materials[size_t(Wall)].bDoubleSided = true;
	FMeshBuilder Room("room");
	Room.BeginSection(Wall);
	const glm::vec3 Min(-2, 0, -2), Max(2, 4, 2), Thick(Centimetres / 100.0f);
	const float Slit = SlitCentimetres / 100.0f;
	for (int Axis = 0; Axis < 3; ++Axis)
	{
		for (int Side = 0; Side < 2; ++Side)
		{
			// Slabs reach over the corners: no gap there, whatever rays do at edges. Those of no thickness meet in them.
			glm::vec3 Low = Min - Thick, High = Max + Thick;
			Low[Axis] = Side ? Max[Axis] : Low[Axis];
			High[Axis] = Side ? High[Axis] : Min[Axis];
			High.x -= Axis == 1 && Side ? Slit + Thick.x : 0.0f;
			if (Centimetres > 0.0f)
			{
				Room.AddBox(Low, High);
				continue;
			}
			glm::vec3 Right(0), Up(0);
			Right[(Axis + 1) % 3] = (High - Low)[(Axis + 1) % 3];
			Up[(Axis + 2) % 3] = (High - Low)[(Axis + 2) % 3];
			Room.AddQuad(Low, Low + Right, High, Low + Up);
		}
	}
	Builder.AddNode("room", Builder.AddMesh(Room));
	AddBoxNode(Builder, "crate", AddPaint(Builder, "crate", {0.4f, 0.3f, 0.2f}, 0.5f), {-1.5f, 0, -1.5f}, {-0.5f, 1, -0.5f});
	Builder.AddCamera({1.6, 1.8, 1.6}, {-1.6, 1.2, -1.6}, 75);
	Builder.SetLight({0.5f, -1, -0.4f}, 4.0f, {0.5f, 0.7f, 1.0f});
	return std::move(Builder.Scene);
}

} // namespace Lantern::Builtin
