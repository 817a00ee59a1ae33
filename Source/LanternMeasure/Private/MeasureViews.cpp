// Views for camera paths: what is in the way and what there is to see, by rays on the CPU.
#include <algorithm>
#include <cmath>
#include <limits>

#include <glm/gtc/matrix_transform.hpp>

#include "LanternMeasure/MeasurePaths.h"

namespace Lantern
{

namespace
{
constexpr double Infinity = std::numeric_limits<double>::infinity();

bool HitsBox(glm::dvec3 Origin, glm::dvec3 Direction, glm::dvec3 Min, glm::dvec3 Max, double Nearest)
{
	double Enter = 0.0, Leave = Nearest;
	for (int Axis = 0; Axis < 3; ++Axis)
	{
		if (Direction[Axis] == 0.0)
		{
			if (Origin[Axis] < Min[Axis] || Origin[Axis] > Max[Axis]) { return false; }
			continue;
		}
		const double A = (Min[Axis] - Origin[Axis]) / Direction[Axis], B = (Max[Axis] - Origin[Axis]) / Direction[Axis];
		Enter = std::max(Enter, std::min(A, B));
		Leave = std::min(Leave, std::max(A, B));
	}
	return Enter <= Leave;
}

/// Möller & Trumbore 1997, "Fast, Minimum Storage Ray/Triangle Intersection".
double HitTriangle(glm::dvec3 Origin, glm::dvec3 Direction, glm::dvec3 A, glm::dvec3 B, glm::dvec3 C)
{
	const glm::dvec3 AB = B - A, AC = C - A, P = glm::cross(Direction, AC);
	const double Determinant = glm::dot(AB, P);
	if (Determinant == 0.0) { return Infinity; }
	const glm::dvec3 AO = Origin - A, Q = glm::cross(AO, AB);
	const double U = glm::dot(AO, P) / Determinant, V = glm::dot(Direction, Q) / Determinant;
	if (U < 0.0 || V < 0.0 || U + V > 1.0) { return Infinity; }
	const double T = glm::dot(AC, Q) / Determinant;
	return T > 0.0 ? T : Infinity;
}

std::vector<glm::vec3> Bend(const FSceneDescription& Scene, const FScenePose& Pose, int32_t Node, const FHostMesh& Mesh)
{
	const std::vector<glm::mat4> Joints = EvaluateJoints(Scene, Pose, Node);
	std::vector<glm::vec3> Out(Mesh.Positions.size());
	for (size_t I = 0; I < Out.size(); ++I)
	{
		const FSkinWeights& Skin = Mesh.Skin[I];
		glm::mat4 Matrix(0.0f);
		for (size_t J = 0; J < 4; ++J)
		{
			if (Skin.Weights[J] > 0.0f && Skin.Joints[J] < Joints.size()) { Matrix += Skin.Weights[J] * Joints[Skin.Joints[J]]; }
		}
		Out[I] = glm::vec3(Matrix * glm::vec4(Mesh.Positions[I], 1.0f));
	}
	return Out;
}

glm::dvec3 GetRight(const FView& View) { return glm::normalize(glm::cross(glm::dvec3(View.Forward), glm::dvec3(View.Up))); }

/// Distances along rays of a Count × Count grid in the middle of the picture; infinity for sky.
std::vector<double> LookThrough(const FSceneRays& Rays, const FView& View, int Count)
{
	const glm::dvec3 Forward = glm::normalize(glm::dvec3(View.Forward)), Right = GetRight(View), Up = glm::cross(Right, Forward);
	const double TanY = std::tan(0.5 * View.FovY), TanX = TanY * View.Width / std::max(1u, View.Height);
	std::vector<double> Out;
	for (int Y = 0; Y < Count; ++Y)
	{
		for (int X = 0; X < Count; ++X)
		{
			// The outer fifth of the picture is left out.
			const double U = 0.8 * (2.0 * (X + 0.5) / Count - 1.0), V = 0.8 * (2.0 * (Y + 0.5) / Count - 1.0);
			const glm::dvec3 Direction = Forward + U * TanX * Right + V * TanY * Up;
			Out.push_back(Rays.Trace(View.Position, Direction));
		}
	}
	return Out;
}

size_t CountHits(const std::vector<double>& Distances)
{
	return static_cast<size_t>(std::count_if(Distances.begin(), Distances.end(), [](double D) { return std::isfinite(D); }));
}

FView Turn(const FView& View, double Radians)
{
	FView Out = View;
	const glm::dmat4 Rotation = glm::rotate(glm::dmat4(1), Radians, glm::normalize(glm::dvec3(View.Up)));
	Out.Forward = glm::vec3(glm::dvec3(Rotation * glm::dvec4(glm::dvec3(View.Forward), 0)));
	return Out;
}

/// Views to cut from, best first: around what is looked at, then elsewhere from the same place.
FView FindCutView(const FSceneRays& Rays, const FMeasureViews& Views)
{
	const FView& Home = Views.Home;
	std::vector<FView> Candidates;
	for (const double Degrees : {60.0, -60.0, 30.0, -30.0})
	{
		const glm::dmat4 Rotation = glm::rotate(glm::dmat4(1), glm::radians(Degrees), glm::normalize(glm::dvec3(Home.Up)));
		const glm::dvec3 Arm = glm::dvec3(Rotation * glm::dvec4(Home.Position - Views.Focus, 0));
		// From the focus outwards and back: free all the way, so not inside of anything.
		if (!(Rays.Trace(Views.Focus + 0.5 * Arm, 0.75 * Arm) > 1.0) || !(Rays.Trace(Views.Focus + Arm, -0.5 * Arm) > 1.0)) { continue; }
		FView View = Home;
		View.Position = Views.Focus + Arm;
		View.Forward = glm::vec3(-Arm);
		Candidates.push_back(View);
	}
	for (const double Degrees : {90.0, -90.0, 180.0, 45.0, -45.0, 20.0}) { Candidates.push_back(Turn(Home, glm::radians(Degrees))); }
	const double Enough = 0.75 * double(CountHits(LookThrough(Rays, Home, 5)));
	const FView* Best = nullptr;
	size_t BestHits = 0;
	for (const FView& View : Candidates)
	{
		const size_t Hits = CountHits(LookThrough(Rays, View, 5));
		if (double(Hits) >= Enough) { return View; }
		if (!Best || Hits > BestHits)
		{
			Best = &View;
			BestHits = Hits;
		}
	}
	return *Best;
}
} // namespace

FSceneRays::FSceneRays(const FSceneDescription& Scene, const FScenePose& Pose)
{
	for (size_t Node = 0; Node < Scene.Nodes.size(); ++Node)
	{
		const FHostNode& Source = Scene.Nodes[Node];
		if (Source.Mesh < 0 || !(std::abs(glm::determinant(glm::dmat3(Pose.World[Node]))) > 0.0)) { continue; }
		FInstance Instance;
		Instance.Mesh = &Scene.Meshes[Source.Mesh];
		Instance.Positions = &Instance.Mesh->Positions;
		if (Source.Skin >= 0 && !Instance.Mesh->Skin.empty())
		{
			Bent.push_back(std::make_unique<std::vector<glm::vec3>>(Bend(Scene, Pose, static_cast<int32_t>(Node), *Instance.Mesh)));
			Instance.Positions = Bent.back().get();
		}
		Instance.ToLocal = glm::inverse(Pose.World[Node]);
		Instance.Min = glm::dvec3(Infinity);
		Instance.Max = glm::dvec3(-Infinity);
		for (const glm::vec3& Position : *Instance.Positions)
		{
			Instance.Min = glm::min(Instance.Min, glm::dvec3(Position));
			Instance.Max = glm::max(Instance.Max, glm::dvec3(Position));
		}
		Instances.push_back(Instance);
	}
}

double FSceneRays::Trace(glm::dvec3 Origin, glm::dvec3 Direction) const
{
	double Nearest = Infinity;
	for (const FInstance& Instance : Instances)
	{
		const glm::dvec3 LocalOrigin(Instance.ToLocal * glm::dvec4(Origin, 1)), LocalDirection(Instance.ToLocal * glm::dvec4(Direction, 0));
		if (!HitsBox(LocalOrigin, LocalDirection, Instance.Min, Instance.Max, Nearest)) { continue; }
		const std::vector<uint32_t>& Indices = Instance.Mesh->Indices;
		const std::vector<glm::vec3>& P = *Instance.Positions;
		for (size_t I = 0; I + 2 < Indices.size(); I += 3)
		{
			Nearest = std::min(Nearest, HitTriangle(LocalOrigin, LocalDirection, P[Indices[I]], P[Indices[I + 1]], P[Indices[I + 2]]));
		}
	}
	return Nearest;
}

FView FMeasureViews::GetView(double Way) const
{
	if (PanRadians != 0.0) { return Turn(Home, Way * PanRadians); }
	FView Out = Home;
	Out.Position = Home.Position + Way * Travel;
	Out.Forward = glm::vec3(Focus - Out.Position);
	return Out;
}

FMeasureViews FindMeasureViews(const FSceneDescription& Scene, const FScenePose& Pose, const FView& Home)
{
	const FSceneRays Rays(Scene, Pose);
	FMeasureViews Out;
	Out.Home = Home;
	Out.Home.Forward = glm::normalize(Home.Forward);
	std::vector<double> Distances = LookThrough(Rays, Out.Home, 5);
	std::erase_if(Distances, [](double D) { return !std::isfinite(D); });
	double Distance = 1.0;
	if (!Distances.empty())
	{
		std::nth_element(Distances.begin(), Distances.begin() + Distances.size() / 2, Distances.end());
		Distance = Distances[Distances.size() / 2];
	}
	Out.Focus = Out.Home.Position + Distance * glm::dvec3(Out.Home.Forward);
	const glm::dvec3 Right = GetRight(Out.Home);
	const double FreeRight = Rays.Trace(Out.Home.Position, Right), FreeLeft = Rays.Trace(Out.Home.Position, -Right);
	const double Length = std::min(0.4 * Distance, 0.5 * std::max(FreeRight, FreeLeft));
	Out.Travel = (FreeRight >= FreeLeft ? Length : -Length) * Right;
	if (Length < 0.02 * Distance) { Out.PanRadians = glm::radians(20.0); }
	Out.Cut = FindCutView(Rays, Out);
	return Out;
}

} // namespace Lantern
