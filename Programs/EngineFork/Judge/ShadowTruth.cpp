// The truth about the shadow of boxes: their intersections with rays in double precision.
#include "Judge/ShadowTruth.h"

#include <cmath>
#include <limits>
#include <optional>

namespace Fork
{

namespace
{

struct FHit
{
	double Distance = 0.0;
	glm::dvec3 Normal{0};
	size_t Box = 0;
};

/// Slab test; the first boundary in front of the origin.
std::optional<FHit> Intersect(const FBox& Box, glm::dvec3 Origin, glm::dvec3 Direction)
{
	double Enter = -std::numeric_limits<double>::infinity(), Leave = std::numeric_limits<double>::infinity();
	glm::dvec3 Normal{0};
	for (int Axis = 0; Axis < 3; ++Axis)
	{
		const double Middle = (Box.Centre[Axis] - Origin[Axis]) / Direction[Axis];
		const double Half = Box.HalfSize[Axis] / std::abs(Direction[Axis]);
		if (Middle - Half > Enter)
		{
			Enter = Middle - Half;
			Normal = glm::dvec3(0);
			Normal[Axis] = Direction[Axis] > 0.0 ? -1.0 : 1.0;
		}
		Leave = std::min(Leave, Middle + Half);
	}
	if (Enter > Leave || Enter <= 0.0) { return std::nullopt; }
	return FHit{Enter, Normal, 0};
}

enum class ESeenBy
{
	Camera,
	Sun,
};

std::optional<FHit> FindNearest(const FForkScene& Scene, glm::dvec3 Origin, glm::dvec3 Direction, ESeenBy SeenBy)
{
	std::optional<FHit> Nearest;
	for (size_t Index = 0; Index < Scene.Boxes.size(); ++Index)
	{
		if (SeenBy == ESeenBy::Sun && (!Scene.Boxes[Index].bCastsShadow || Scene.Boxes[Index].bCutOut)) { continue; }
		const std::optional<FHit> Hit = Intersect(Scene.Boxes[Index], Origin, Direction);
		if (Hit && (!Nearest || Hit->Distance < Nearest->Distance))
		{
			Nearest = Hit;
			Nearest->Box = Index;
		}
	}
	return Nearest;
}

struct FSample
{
	EExpectation Expectation = EExpectation::Sky;
	size_t Box = 0;
	glm::dvec3 Normal{0};
	bool operator==(const FSample&) const = default;
};

FSample Sample(const FForkScene& Scene, glm::dvec3 CameraRay, glm::dvec3 Shift)
{
	const std::optional<FHit> Hit = FindNearest(Scene, Scene.Camera.Position, CameraRay, ESeenBy::Camera);
	if (!Hit) { return {}; }
	FSample Result{EExpectation::Shadowed, Hit->Box, Hit->Normal};
	if (dot(Hit->Normal, -Scene.SunDirection) > 0.0)
	{
		// Away from the surface, so that it does not shadow itself; Shift stays within it.
		const glm::dvec3 Sideways = Shift - Hit->Normal * dot(Hit->Normal, Shift);
		const glm::dvec3 Origin = Scene.Camera.Position + CameraRay * Hit->Distance + Hit->Normal * 1e-6 + Sideways;
		const bool bHidden = FindNearest(Scene, Origin, -Scene.SunDirection, ESeenBy::Sun).has_value();
		Result.Expectation = bHidden ? EExpectation::Shadowed : EExpectation::Lit;
	}
	return Result;
}

} // namespace

EExpectation ExpectPixel(const FForkScene& Scene, uint32_t X, uint32_t Y, uint32_t Width, uint32_t Height)
{
	constexpr double Margin = 0.02; // metres: far more than fp32 depth loses here
	const FCamera& Camera = Scene.Camera;
	const double TanHalf = std::tan(Camera.FovY * 0.5), Aspect = double(Width) / Height;
	std::optional<FSample> First;
	for (int Try = 0; Try < 5; ++Try)
	{
		const glm::dvec2 Jitter = Try == 0 ? glm::dvec2(0) : glm::dvec2(Try % 2 ? 0.6 : -0.6, Try > 2 ? 0.6 : -0.6);
		const double NdcX = (X + 0.5 + Jitter.x) / Width * 2.0 - 1.0, NdcY = (Y + 0.5 + Jitter.y) / Height * 2.0 - 1.0;
		const glm::dvec3 Ray = normalize(Camera.Forward + Camera.Right * (NdcX * TanHalf * Aspect) - Camera.Up * (NdcY * TanHalf));
		const FSample Found = Sample(Scene, Ray, glm::dvec3(Jitter.x, Jitter.x + Jitter.y, Jitter.y) * (Margin / 0.6));
		if (First && !(*First == Found)) { return EExpectation::Unsure; }
		First = Found;
	}
	return First->Expectation;
}

} // namespace Fork
