// The right shadows of the example scene: rays against its triangles in double precision.
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

enum class ELightSource : uint8_t
{
	Sun,
	Lamp, ///< as a point
};

struct FExpectedPixel
{
	EExpectation Shadow = EExpectation::Sky;
	/// What a white surface reflects if nothing hides the light. Of the sun over its irradiance, which this engine takes without π; of
	/// the lamp nits. Of sky 0.
	double Light = 0.0;
};

/// Knows nothing of the plugin, of depth buffers or of acceleration structures.
class FShadowTruth
{
public:
	FShadowTruth(const FForkScene& InScene, const FCamera& InCamera);
	/// What the pixel must show.
	FExpectedPixel ExpectPixel(uint32_t X, uint32_t Y, uint32_t Width, uint32_t Height, ELightSource Source) const;
	/// Returns what a white surface there reflects of the lamp as a square, shadows included: a sum over its points. Empty: sky, or an
	/// edge of a surface is near. Nits.
	std::optional<double> ExpectSquareLamp(uint32_t X, uint32_t Y, uint32_t Width, uint32_t Height) const;

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
		Light,  ///< all that cast shadows
	};
	struct FSample
	{
		EExpectation Expectation = EExpectation::Sky;
		const FTriangle* Triangle = nullptr;
		glm::dvec3 Position{0};
	};
	struct FToLight
	{
		glm::dvec3 Direction{0}; ///< unit length
		double Distance = 0.0;   ///< of the lamp
		double Light = 0.0;      ///< see FExpectedPixel, for a surface that faces it
	};

	FTriangle& AddTriangle(const glm::dvec3 (&Corners)[3], size_t Thing);
	std::optional<FHit> FindNearest(glm::dvec3 Origin, glm::dvec3 Direction, ESeenBy SeenBy) const;
	glm::dvec3 GetRay(glm::dvec2 Pixel, uint32_t Width, uint32_t Height) const;
	FToLight FindLight(glm::dvec3 From, ELightSource Source) const;
	bool IsHidden(const FToLight& Light, glm::dvec3 From, glm::dvec3 Normal) const;
	FSample Sample(glm::dvec3 CameraRay, glm::dvec3 Shift, ELightSource Source) const;
	static bool AreAlike(const FSample& A, const FSample& B);

	const FForkScene& Scene;
	const FCamera& Camera;
	std::vector<FTriangle> Triangles;
};

} // namespace Fork
