// Rooms of slabs, closed or with one opening.
#include "Builtin/Stability/StabilityRoom.h"

namespace Lantern::Builtin
{

namespace
{

constexpr float Thickness = 0.2f;

/// Floor, ceiling and the walls to the left and right.
void AddFourSides(FMeshBuilder& Mesh, const glm::vec3& Min, const glm::vec3& Max)
{
	const glm::vec3 A = Min - Thickness, B = Max + Thickness;
	Mesh.AddBox(A, {B.x, Min.y, B.z});
	Mesh.AddBox({A.x, Max.y, A.z}, B);
	Mesh.AddBox(A, {Min.x, B.y, B.z});
	Mesh.AddBox({Max.x, A.y, A.z}, B);
}

} // namespace

void AddRoom(FSceneBuilder& Builder, int32_t Material, const glm::vec3& Min, const glm::vec3& Max)
{
	const glm::vec3 A = Min - Thickness, B = Max + Thickness;
	FMeshBuilder Mesh("room");
	Mesh.BeginSection(Material);
	AddFourSides(Mesh, Min, Max);
	Mesh.AddBox(A, {B.x, B.y, Min.z});
	Mesh.AddBox({A.x, A.y, Max.z}, B);
	Builder.AddNode("room", Builder.AddMesh(Mesh));
}

void AddRoom(FSceneBuilder& Builder, int32_t Material, const glm::vec3& Min, const glm::vec3& Max, const FOpening& Opening)
{
	const glm::vec3 A = Min - Thickness, B = Max + Thickness;
	const bool bFront = Opening.Side == EOpening::Front;
	FMeshBuilder Mesh("room");
	Mesh.BeginSection(Material);
	AddFourSides(Mesh, Min, Max);
	// The closed wall, then the other around its opening.
	Mesh.AddBox({A.x, A.y, bFront ? A.z : Max.z}, {B.x, B.y, bFront ? Min.z : B.z});
	const float Z0 = bFront ? Max.z : A.z, Z1 = bFront ? B.z : Min.z;
	const float Left = Opening.X - Opening.Half, Right = Opening.X + Opening.Half;
	Mesh.AddBox({A.x, A.y, Z0}, {Left, B.y, Z1});
	Mesh.AddBox({Right, A.y, Z0}, {B.x, B.y, Z1});
	Mesh.AddBox({Left, Opening.Top, Z0}, {Right, B.y, Z1});
	if (Opening.Bottom > Min.y) { Mesh.AddBox({Left, A.y, Z0}, {Right, Opening.Bottom, Z1}); }
	Builder.AddNode("room", Builder.AddMesh(Mesh));
}

} // namespace Lantern::Builtin
