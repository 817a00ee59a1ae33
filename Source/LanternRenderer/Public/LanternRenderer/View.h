// A camera in the world.
#pragma once

#include <cstdint>

#include <glm/glm.hpp>

#include "SceneTypes.h"

namespace Lantern
{

struct FView
{
	glm::dvec3 Position{0};
	glm::vec3 Forward{0, 0, -1}; ///< need not be unit length
	glm::vec3 Up{0, 1, 0};       ///< not parallel to Forward
	float FovY = 1.0f;           ///< radians, vertical, in (0, π)
	float Near = 0.05f;          ///< metres, > 0; there is no far plane
	uint32_t Width = 0, Height = 0;
	uint32_t FrameIndex = 0;
	uint32_t Seed = 0;
	float Exposure = 0.0f; ///< stops
	/// Time since the frame before, in seconds, > 0. Histories are kept in seconds, so that 30 and 144 frames a second behave alike.
	float DeltaSeconds = 1.0f / 60.0f;
	/// Carries nothing over from the frame before: another place, another world.
	bool bCut = false;
};

/// Fills the constants of a view. Origin: the scene's (FRTScene::GetOrigin). Previous: the view of the frame before; null: nothing is
/// carried over from it.
FViewConstants MakeViewConstants(const FView& View, glm::dvec3 Origin, const FView* Previous = nullptr);

/// The volume that a view sees, for culling on the CPU.
class FViewFrustum
{
public:
	explicit FViewFrustum(const FView& View);
	/// Returns false if nothing of the sphere is seen. True may be wrong near the edges.
	bool MaySee(glm::dvec3 Center, double Radius) const;

private:
	glm::dvec3 Position, Right, Up, Forward;
	double Near, CosX, SinX, CosY, SinY; // of half the angles of view
};

/// Looks from Position to Target with y up, or with -z up if it looks along y.
FView LookAt(glm::dvec3 Position, glm::dvec3 Target, float FovY, uint32_t Width, uint32_t Height);

} // namespace Lantern
