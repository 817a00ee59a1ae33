// The right shadow of the example scene: rays against its triangles in double precision.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "Example/ForkScene.h"

namespace Fork
{

enum class EExpectation : uint8_t
{
	Unsure, ///< an edge of a surface or of a shadow is near
	Sky,
	Lit,
	Shadowed,
};

struct FExpectedPixel
{
	EExpectation Shadow = EExpectation::Sky;
	double Facing = 0.0; ///< cosine between the surface's normal and the way to the sun, at least 0; of sky 0
};

/// Knows nothing of the plugin, of depth buffers or of acceleration structures.
class FShadowTruth
{
public:
	FShadowTruth(const FForkScene& InScene, const FCamera& InCamera);
	/// What the pixel must show.
	FExpectedPixel ExpectPixel(uint32_t X, uint32_t Y, uint32_t Width, uint32_t Height) const;

private:
	struct FTriangle
	{
		glm::dvec3 Corner, Edge1, Edge2, Normal; ///< of unit length, to where its corners are counter-clockwise
		std::array<glm::dvec2, 3> UVs;           ///< of its corners
		bool bCutOut = false;                    ///< has holes where IsCutOut says so
		size_t Thing = 0;                        ///< box, or one past them for the reed
		bool bCastsShadow = true;
	};
	struct FHit
	{
		double Distance = 0.0;
		const FTriangle* Triangle = nullptr;
	};
	enum class ESeenBy
	{
		Camera, ///< front faces
		Sun,    ///< all that cast shadows
	};
	struct FSample
	{
		EExpectation Expectation = EExpectation::Sky;
		const FTriangle* Triangle = nullptr;
	};

	FTriangle& AddTriangle(const glm::dvec3 (&Corners)[3], size_t Thing);
	std::optional<FHit> FindNearest(glm::dvec3 Origin, glm::dvec3 Direction, ESeenBy SeenBy) const;
	FSample Sample(glm::dvec3 CameraRay, glm::dvec3 Shift) const;
	static bool AreAlike(const FSample& A, const FSample& B);

	const FForkScene& Scene;
	const FCamera& Camera;
	std::vector<FTriangle> Triangles;
};

} // namespace Fork
