#include "MotionOracle.h"

#include <algorithm>
#include <cmath>

namespace Lantern
{

namespace
{
std::vector<glm::dvec3> FindPositions(const FHostMesh& Mesh, const std::vector<glm::mat4>& Joints, const glm::dmat4& Transform)
{
	std::vector<glm::dvec3> Out;
	for (size_t I = 0; I < Mesh.Positions.size(); ++I)
	{
		glm::dmat4 M(Mesh.Skin.empty() ? 1.0 : 0.0);
		for (size_t J = 0; !Mesh.Skin.empty() && J < 4; ++J)
		{
			M += double(Mesh.Skin[I].Weights[J]) * glm::dmat4(Joints[Mesh.Skin[I].Joints[J]]);
		}
		Out.push_back(glm::dvec3(Transform * M * glm::dvec4(Mesh.Positions[I], 1.0)));
	}
	return Out;
}

struct FHit
{
	double Distance = 1e300; // in units of the ray
	double Nearest = 0.0;    // what is not farther away is not seen
	const FMotionSnapshot::FObject* Object = nullptr;
	size_t FirstIndex = 0;
	glm::dvec3 Weights{0}; // of the corners
};

/// Cramer's rule on Origin + t · Ray = A + v · (B − A) + w · (C − A). Backs of single-sided materials are not seen.
void Intersect(
    const glm::dvec3& Origin, const glm::dvec3& Ray, const FMotionSnapshot::FObject& Object, const FSceneDescription& Scene, FHit& Hit)
{
	for (const FHostSection& Section : Object.Mesh->Sections)
	{
		const bool bDoubleSided = Scene.Materials[static_cast<size_t>(Section.Material)].bDoubleSided;
		for (size_t I = Section.FirstIndex; I < Section.FirstIndex + Section.IndexCount; I += 3)
		{
			const glm::dvec3& A = Object.Positions[Object.Mesh->Indices[I]];
			const glm::dvec3 B = Object.Positions[Object.Mesh->Indices[I + 1]] - A, C = Object.Positions[Object.Mesh->Indices[I + 2]] - A;
			const glm::dvec3 Normal = glm::cross(B, C);
			const double Volume = glm::dot(Normal, Ray), Area2 = glm::dot(Normal, Normal);
			const bool bFront = (Volume < 0.0) != Object.bMirrored;
			if (Volume == 0.0 || (!bFront && !bDoubleSided)) { continue; }
			const double T = -glm::dot(Normal, Origin - A) / Volume;
			const glm::dvec3 P = Origin + T * Ray - A;
			const double V = glm::dot(glm::cross(P, C), Normal) / Area2, W = glm::dot(glm::cross(B, P), Normal) / Area2;
			if (T <= Hit.Nearest || T >= Hit.Distance || V < 0.0 || W < 0.0 || V + W > 1.0) { continue; }
			Hit = {T, Hit.Nearest, &Object, I, {1.0 - V - W, V, W}};
		}
	}
}

glm::dvec3 Interpolate(const FMotionSnapshot::FObject& Object, const FHit& Hit)
{
	glm::dvec3 Sum(0);
	for (int Corner = 0; Corner < 3; ++Corner)
	{
		Sum += Hit.Weights[Corner] * Object.Positions[Object.Mesh->Indices[Hit.FirstIndex + static_cast<size_t>(Corner)]];
	}
	return Sum;
}
} // namespace

FMotionSnapshot TakeSnapshot(FHostScene& Scene, const FView& View)
{
	FMotionSnapshot Out;
	Out.View = View;
	const FSceneDescription& Description = Scene.GetDescription();
	for (size_t Instance = 0; Instance < Scene.GetInstanceCount(); ++Instance)
	{
		const int32_t Node = Scene.GetNode(Instance);
		const uint32_t Index = Scene.GetDraws()[Instance].Object.Index;
		const glm::dmat4 Transform = Scene.GetScene().FindObject(Index)->Transform;
		std::vector<glm::mat4> Joints;
		if (Scene.IsSkinned(Instance)) { Joints = EvaluateJoints(Description, Scene.GetPose(), Node); }
		const FHostMesh& Mesh = Description.Meshes[static_cast<size_t>(Description.Nodes[static_cast<size_t>(Node)].Mesh)];
		Out.Objects.push_back({Index, glm::determinant(glm::dmat3(Transform)) < 0.0, &Mesh, FindPositions(Mesh, Joints, Transform)});
	}
	return Out;
}

FExactCamera::FExactCamera(const FView& InView) : View(InView)
{
	Forward = glm::normalize(glm::dvec3(View.Forward));
	Right = glm::normalize(glm::cross(Forward, glm::dvec3(View.Up)));
	Up = glm::cross(Right, Forward);
	TanY = std::tan(0.5 * double(View.FovY));
	TanX = TanY * View.Width / View.Height;
}

glm::dvec3 FExactCamera::MakeRay(glm::dvec2 Pixel) const
{
	const glm::dvec2 Ndc = Pixel / glm::dvec2(View.Width, View.Height) * 2.0 - 1.0;
	return Forward + Right * (Ndc.x * TanX) - Up * (Ndc.y * TanY);
}

glm::dvec3 FExactCamera::Project(const glm::dvec3& World) const
{
	const glm::dvec3 D = World - View.Position;
	const double Z = glm::dot(D, Forward);
	const glm::dvec2 Ndc(glm::dot(D, Right) / (Z * TanX), -glm::dot(D, Up) / (Z * TanY));
	return {(Ndc * 0.5 + 0.5) * glm::dvec2(View.Width, View.Height), Z};
}

namespace
{
FExactMotion MakeMotion(const FMotionSnapshot& Before, const FMotionSnapshot& Now, const FHit& Hit, glm::dvec2 Pixel)
{
	FExactMotion Out;
	Out.Object = Hit.Object->Index;
	Out.PreviousPoint = Out.Point = Interpolate(*Hit.Object, Hit);
	for (const FMotionSnapshot::FObject& Object : Before.Objects)
	{
		if (Object.Index == Hit.Object->Index) { Out.PreviousPoint = Interpolate(Object, Hit); }
	}
	const glm::dvec3 Here = FExactCamera(Now.View).Project(Out.Point), Previous = FExactCamera(Before.View).Project(Out.PreviousPoint);
	Out.Offset = glm::dvec2(Here) - Pixel;
	Out.Distance = Here.z;
	Out.Motion = glm::dvec2(Previous) - glm::dvec2(Here);
	Out.PreviousDistance = Previous.z;
	return Out;
}

struct FTrianglePoint
{
	glm::dvec3 Weights; // of the corners
	double Distance;    // along the view
};

/// What of a convex polygon has Sign · (distance − Limit) ≥ 0 (Sutherland and Hodgman 1974).
std::vector<FTrianglePoint> ClipByDistance(const std::vector<FTrianglePoint>& Polygon, double Limit, double Sign)
{
	std::vector<FTrianglePoint> Out;
	for (size_t I = 0; I < Polygon.size(); ++I)
	{
		const FTrianglePoint &A = Polygon[I], &B = Polygon[(I + 1) % Polygon.size()];
		const double Da = Sign * (A.Distance - Limit), Db = Sign * (B.Distance - Limit);
		if (Da >= 0.0) { Out.push_back(A); }
		if ((Da >= 0.0) != (Db >= 0.0)) { Out.push_back({glm::mix(A.Weights, B.Weights, Da / (Da - Db)), Limit}); }
	}
	return Out;
}
} // namespace

std::optional<FExactMotion> FindMotion(
    const FMotionSnapshot& Before, const FMotionSnapshot& Now, const FSceneDescription& Scene, uint32_t X, uint32_t Y)
{
	const FExactCamera Camera(Now.View);
	const glm::dvec2 Pixel(X + 0.5, Y + 0.5);
	FHit Hit;
	for (const FMotionSnapshot::FObject& Object : Now.Objects)
	{
		Intersect(Camera.GetPosition(), Camera.MakeRay(Pixel), Object, Scene, Hit);
	}
	return Hit.Object ? std::optional(MakeMotion(Before, Now, Hit, Pixel)) : std::nullopt;
}

namespace
{
/// Of the points of a triangle within a range of distances, the one nearest to Pixel, if it is nearer than Best.
void FindNearest(const FExactCamera& Camera, const FMotionSnapshot::FObject& Object, size_t FirstIndex, glm::dvec2 Distances,
    glm::dvec2 Pixel, FHit& Hit, double& Best)
{
	std::vector<FTrianglePoint> Polygon;
	for (int Corner = 0; Corner < 3; ++Corner)
	{
		glm::dvec3 Weights(0);
		Weights[Corner] = 1.0;
		const glm::dvec3& P = Object.Positions[Object.Mesh->Indices[FirstIndex + static_cast<size_t>(Corner)]];
		Polygon.push_back({Weights, Camera.Project(P).z});
	}
	Polygon = ClipByDistance(ClipByDistance(Polygon, Distances[0], 1.0), Distances[1], -1.0);
	const auto Project = [&](const FTrianglePoint& Point) {
		return glm::dvec2(Camera.Project(Interpolate(Object, {0.0, 0.0, &Object, FirstIndex, Point.Weights})));
	};
	for (size_t I = 0; I < Polygon.size(); ++I)
	{
		// At what is nearly one distance, lines are divided on the screen as they are in space.
		const FTrianglePoint &A = Polygon[I], &B = Polygon[(I + 1) % Polygon.size()];
		const glm::dvec2 From = Project(A), Along = Project(B) - From;
		const double Length2 = glm::dot(Along, Along);
		const double T = Length2 > 0.0 ? std::clamp(glm::dot(Pixel - From, Along) / Length2, 0.0, 1.0) : 0.0;
		const double Offset = glm::length(From + T * Along - Pixel);
		if (Offset < Best)
		{
			Best = Offset;
			Hit = {0.0, 0.0, &Object, FirstIndex, glm::mix(A.Weights, B.Weights, T)};
		}
	}
}
} // namespace

std::optional<FExactMotion> FindMotionAt(const FMotionSnapshot& Before, const FMotionSnapshot& Now, const FSceneDescription& Scene,
    uint32_t Index, double Distance, double DistanceError, uint32_t X, uint32_t Y)
{
	const FExactCamera Camera(Now.View);
	const glm::dvec2 Pixel(X + 0.5, Y + 0.5), Distances = Distance + DistanceError * glm::dvec2(-1.0, 1.0);
	FHit Hit{Distances[1], Distances[0]};
	for (const FMotionSnapshot::FObject& Object : Now.Objects)
	{
		if (Object.Index != Index) { continue; }
		Intersect(Camera.GetPosition(), Camera.MakeRay(Pixel), Object, Scene, Hit);
		const bool bCentre = Hit.Object != nullptr;
		double Best = 1e300;
		for (size_t First = 0; !bCentre && First < Object.Mesh->Indices.size(); First += 3)
		{
			FindNearest(Camera, Object, First, Distances, Pixel, Hit, Best);
		}
	}
	return Hit.Object ? std::optional(MakeMotion(Before, Now, Hit, Pixel)) : std::nullopt;
}

} // namespace Lantern
