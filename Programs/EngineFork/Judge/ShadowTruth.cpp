// The truth about shadows: the scene's triangles, and rays that find the nearest.
#include "Judge/ShadowTruth.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <glm/gtc/constants.hpp>

namespace Fork
{

FShadowTruth::FShadowTruth(const FForkScene& InScene, const FCamera& InCamera) : Scene(InScene), Camera(InCamera)
{
	const FBoxMesh Unit = MakeBoxMesh();
	for (size_t Box = 0; Box < Scene.Boxes.size(); ++Box)
	{
		const FBox& Item = Scene.Boxes[Box];
		for (size_t First = 0; First < Unit.Indices.size(); First += 3)
		{
			glm::dvec3 Corners[3];
			std::array<glm::dvec2, 3> UVs;
			for (size_t Corner = 0; Corner < 3; ++Corner)
			{
				const FVertex& Vertex = Unit.Vertices[Unit.Indices[First + Corner]];
				Corners[Corner] = Item.Centre + Item.HalfSize * glm::dvec3(Vertex.Position);
				UVs[Corner] = Vertex.UV;
			}
			FTriangle& Triangle = AddTriangle(Corners, Box);
			Triangle.UVs = UVs;
			Triangle.bCutOut = Item.bCutOut;
			Triangle.bCastsShadow = Item.bCastsShadow;
		}
	}
	const FReedMesh Reed = MakeReedMesh();
	for (size_t First = 0; First < Reed.Indices.size(); First += 3)
	{
		glm::dvec3 Corners[3];
		for (size_t Corner = 0; Corner < 3; ++Corner)
		{
			Corners[Corner] = Scene.Reed.Middle + SkinVertex(Reed.Vertices[Reed.Indices[First + Corner]], Scene.Reed.Bend);
		}
		AddTriangle(Corners, Scene.Boxes.size());
	}
}

FShadowTruth::FTriangle& FShadowTruth::AddTriangle(const glm::dvec3 (&Corners)[3], size_t Thing)
{
	const glm::dvec3 Edge1 = Corners[1] - Corners[0], Edge2 = Corners[2] - Corners[0];
	return Triangles.emplace_back(FTriangle{Corners[0], Edge1, Edge2, normalize(cross(Edge1, Edge2)), {}, false, Thing});
}

/// Möller and Trumbore, "Fast, Minimum Storage Ray/Triangle Intersection", 1997.
std::optional<FShadowTruth::FHit> FShadowTruth::FindNearest(glm::dvec3 Origin, glm::dvec3 Direction, ESeenBy SeenBy) const
{
	std::optional<FHit> Nearest;
	for (const FTriangle& Triangle : Triangles)
	{
		if (SeenBy == ESeenBy::Light ? !Triangle.bCastsShadow : dot(Triangle.Normal, Direction) >= 0.0) { continue; }
		const glm::dvec3 P = cross(Direction, Triangle.Edge2);
		const double Determinant = dot(Triangle.Edge1, P);
		if (Determinant == 0.0) { continue; }
		const glm::dvec3 To = Origin - Triangle.Corner, Q = cross(To, Triangle.Edge1);
		const double U = dot(To, P) / Determinant, V = dot(Direction, Q) / Determinant, Distance = dot(Triangle.Edge2, Q) / Determinant;
		if (U < 0.0 || V < 0.0 || U + V > 1.0 || Distance <= 0.0) { continue; }
		if (Triangle.bCutOut && IsCutOut(Triangle.UVs[0] * (1.0 - U - V) + Triangle.UVs[1] * U + Triangle.UVs[2] * V)) { continue; }
		if (!Nearest || Distance < Nearest->Distance) { Nearest = FHit{Distance, &Triangle}; }
	}
	return Nearest;
}

FShadowTruth::FToLight FShadowTruth::FindLight(glm::dvec3 From, ELightSource Source) const
{
	if (Source == ELightSource::Sun) { return {-Scene.SunDirection, std::numeric_limits<double>::infinity(), 1.0}; }
	const glm::dvec3 To = Scene.Lamp - From;
	const double Distance = length(To), Metres = Distance / Metre;
	return {To / Distance, Distance, Scene.LampIntensity / (Metres * Metres * glm::pi<double>())};
}

/// From: on a surface of that normal. The ray starts away from it, so that it does not shadow itself.
bool FShadowTruth::IsHidden(const FToLight& Light, glm::dvec3 From, glm::dvec3 Normal) const
{
	const std::optional<FHit> Hit = FindNearest(From + Normal * (1e-6 * Metre), Light.Direction, ESeenBy::Light);
	return Hit && Hit->Distance < Light.Distance;
}

FShadowTruth::FSample FShadowTruth::Sample(glm::dvec3 CameraRay, glm::dvec3 Shift, ELightSource Source) const
{
	const std::optional<FHit> Hit = FindNearest(Camera.Position, CameraRay, ESeenBy::Camera);
	if (!Hit) { return {}; }
	const glm::dvec3 Normal = Hit->Triangle->Normal;
	FSample Result{EExpectation::Shadowed, Hit->Triangle, Camera.Position + CameraRay * Hit->Distance};
	const glm::dvec3 Shifted = Result.Position + Shift - Normal * dot(Normal, Shift); // within the surface
	const FToLight Light = FindLight(Shifted, Source);
	if (dot(Normal, Light.Direction) > 0.0 && !IsHidden(Light, Shifted, Normal)) { Result.Expectation = EExpectation::Lit; }
	return Result;
}

/// Whether two samples are of one face with one answer.
bool FShadowTruth::AreAlike(const FSample& A, const FSample& B)
{
	if (A.Expectation != B.Expectation || !A.Triangle || !B.Triangle) { return A.Expectation == B.Expectation && A.Triangle == B.Triangle; }
	constexpr double Parallel = 1.0 - 1e-12;
	return A.Triangle->Thing == B.Triangle->Thing && dot(A.Triangle->Normal, B.Triangle->Normal) > Parallel;
}

/// Jitter has moved the picture, so a pixel shows what lies to its other side.
glm::dvec3 FShadowTruth::GetRay(glm::dvec2 Pixel, uint32_t Width, uint32_t Height) const
{
	const double TanHalf = std::tan(Camera.FovY * 0.5), Aspect = double(Width) / Height;
	const glm::dvec2 Ndc = (Pixel - Camera.Jitter) / glm::dvec2(Width, Height) * 2.0 - 1.0;
	return normalize(Camera.Forward + Camera.Right * (Ndc.x * TanHalf * Aspect) - Camera.Up * (Ndc.y * TanHalf));
}

FExpectedPixel FShadowTruth::ExpectPixel(uint32_t X, uint32_t Y, uint32_t Width, uint32_t Height, ELightSource Source) const
{
	constexpr double Margin = 0.02 * Metre; // far more than fp32 depth loses here
	std::optional<FSample> First;
	for (int Try = 0; Try < 5; ++Try)
	{
		const glm::dvec2 Shift = Try == 0 ? glm::dvec2(0) : glm::dvec2(Try % 2 ? 0.6 : -0.6, Try > 2 ? 0.6 : -0.6);
		const glm::dvec3 Ray = GetRay(glm::dvec2(X, Y) + 0.5 + Shift, Width, Height);
		const FSample Found = Sample(Ray, glm::dvec3(Shift.x, Shift.x + Shift.y, Shift.y) * (Margin / 0.6), Source);
		if (First && !AreAlike(*First, Found)) { return {EExpectation::Unsure}; }
		First = First ? First : Found;
	}
	if (!First->Triangle) { return {First->Expectation}; }
	const FToLight Light = FindLight(First->Position, Source);
	return {First->Expectation, Light.Light * std::max(dot(First->Triangle->Normal, Light.Direction), 0.0)};
}

std::optional<double> FShadowTruth::ExpectSquareLamp(uint32_t X, uint32_t Y, uint32_t Width, uint32_t Height) const
{
	constexpr int Steps = 8; // of each side
	const FExpectedPixel Pixel = ExpectPixel(X, Y, Width, Height, ELightSource::Sun);
	if (Pixel.Shadow == EExpectation::Unsure || Pixel.Shadow == EExpectation::Sky) { return {}; }
	const FSample Surface = Sample(GetRay(glm::dvec2(X, Y) + 0.5, Width, Height), glm::dvec3(0), ELightSource::Sun);
	double Sum = 0.0;
	for (int Point = 0; Point < Steps * Steps; ++Point)
	{
		const glm::dvec2 At = (glm::dvec2(Point % Steps, Point / Steps) + 0.5) / double(Steps) - 0.5;
		const glm::dvec3 To = Scene.Lamp + glm::dvec3(At * Scene.LampWidth, 0.0) - Surface.Position;
		const double Distance = length(To), Metres = Distance / Metre;
		const FToLight Light{To / Distance, Distance * (1.0 - 1e-9), 1.0};
		const double Cosine = dot(Surface.Triangle->Normal, Light.Direction), CosineAtLamp = Light.Direction.z;
		if (Cosine <= 0.0 || CosineAtLamp <= 0.0 || IsHidden(Light, Surface.Position, Surface.Triangle->Normal)) { continue; }
		Sum += Cosine * CosineAtLamp / (Metres * Metres);
	}
	return Sum / (Steps * Steps) * Scene.LampIntensity / glm::pi<double>();
}

} // namespace Fork
