// The scene on the CPU: rays traced triangle by triangle, projections and disocclusions.
#include "Stability/StabilityGeometry.h"

#include <cmath>

namespace Lantern
{

FCpuScene::FCpuScene(const FSceneDescription& Scene, double Time)
{
	const FScenePose Pose = EvaluatePose(Scene, Time);
	for (size_t Node = 0; Node < Scene.Nodes.size(); ++Node)
	{
		if (Scene.Nodes[Node].Mesh < 0) { continue; }
		const FHostMesh& Mesh = Scene.Meshes[static_cast<size_t>(Scene.Nodes[Node].Mesh)];
		for (size_t I = 0; I + 2 < Mesh.Indices.size(); I += 3)
		{
			glm::dvec3 P[3];
			for (size_t Corner = 0; Corner < 3; ++Corner)
			{
				P[Corner] = glm::dvec3(Pose.World[Node] * glm::dvec4(glm::dvec3(Mesh.Positions[Mesh.Indices[I + Corner]]), 1.0));
			}
			Triangles.push_back({P[0], P[1] - P[0], P[2] - P[0], static_cast<int32_t>(Node)});
		}
	}
}

// Möller & Trumbore 1997, "Fast, Minimum Storage Ray/Triangle Intersection".
std::optional<FCpuHit> FCpuScene::Trace(glm::dvec3 Origin, glm::dvec3 Direction, double MaxDistance, int32_t Skip) const
{
	FCpuHit Hit;
	Hit.Distance = MaxDistance;
	for (const FTriangle& Triangle : Triangles)
	{
		const glm::dvec3 P = glm::cross(Direction, Triangle.E2);
		const double Determinant = glm::dot(Triangle.E1, P);
		if (std::abs(Determinant) < 1e-14 || Triangle.Node == Skip) { continue; }
		const glm::dvec3 T = Origin - Triangle.P0;
		const double U = glm::dot(T, P) / Determinant;
		if (U < 0.0 || U > 1.0) { continue; }
		const glm::dvec3 Q = glm::cross(T, Triangle.E1);
		const double V = glm::dot(Direction, Q) / Determinant;
		const double Distance = glm::dot(Triangle.E2, Q) / Determinant;
		if (V < 0.0 || U + V > 1.0 || Distance <= 0.0 || Distance >= Hit.Distance) { continue; }
		Hit.Distance = Distance;
		Hit.Node = Triangle.Node;
	}
	if (Hit.Node < 0) { return std::nullopt; }
	Hit.Position = Origin + Direction * Hit.Distance;
	return Hit;
}

namespace
{
glm::dmat3 MakeAxes(const FView& View)
{
	const glm::dvec3 Forward = glm::normalize(glm::dvec3(View.Forward)), Right = glm::normalize(glm::cross(Forward, glm::dvec3(View.Up)));
	return {Right, glm::cross(Right, Forward), Forward};
}
} // namespace

glm::dvec3 GetRayDirection(const FView& View, glm::dvec2 Pixel)
{
	const glm::dmat3 Axes = MakeAxes(View);
	const double Scale = 2.0 * std::tan(0.5 * double(View.FovY)) / View.Height;
	return glm::normalize(Axes[2] + Axes[0] * ((Pixel.x - 0.5 * View.Width) * Scale) - Axes[1] * ((Pixel.y - 0.5 * View.Height) * Scale));
}

std::optional<glm::dvec2> Project(const FView& View, glm::dvec3 Point)
{
	const glm::dvec3 P = glm::transpose(MakeAxes(View)) * (Point - View.Position);
	if (P.z < double(View.Near)) { return std::nullopt; }
	const double Scale = 2.0 * std::tan(0.5 * double(View.FovY)) / View.Height;
	return glm::dvec2(0.5 * View.Width + P.x / (P.z * Scale), 0.5 * View.Height - P.y / (P.z * Scale));
}

std::vector<std::optional<FCpuHit>> TracePicture(const FCpuScene& Scene, const FView& View, int32_t Skip)
{
	std::vector<std::optional<FCpuHit>> Hits;
	for (uint32_t Y = 0; Y < View.Height; ++Y)
	{
		for (uint32_t X = 0; X < View.Width; ++X)
		{
			Hits.push_back(Scene.Trace(View.Position, GetRayDirection(View, {X + 0.5, Y + 0.5}), 1e30, Skip));
		}
	}
	return Hits;
}

std::vector<uint8_t> FindDisoccluded(const FCpuScene& Scene, const FView& View, const FView& Before)
{
	const std::vector<std::optional<FCpuHit>> Hits = TracePicture(Scene, View);
	std::vector<uint8_t> Mask(Hits.size());
	for (size_t Pixel = 0; Pixel < Hits.size(); ++Pixel)
	{
		if (!Hits[Pixel]) { continue; }
		const std::optional<glm::dvec2> At = Project(Before, Hits[Pixel]->Position);
		if (!At || At->x < 0.0 || At->y < 0.0 || At->x >= Before.Width || At->y >= Before.Height)
		{
			Mask[Pixel] = 1;
			continue;
		}
		const glm::dvec3 To = Hits[Pixel]->Position - Before.Position;
		const double Distance = glm::length(To);
		Mask[Pixel] = Scene.Trace(Before.Position, To / Distance, 0.999 * Distance) ? 1 : 0;
	}
	return Mask;
}

} // namespace Lantern
