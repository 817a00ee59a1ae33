// A camera in the world.
#pragma once

#include <cstdint>
#include <optional>

#include <glm/glm.hpp>

#include "LanternScene/Instances/Culling.h"

namespace Lantern
{

/// What a view sees, as coordinates to the right and upwards: at distance 1 along the view, or, if orthographic, in metres.
/// Left may be greater than Right, or Bottom than Top: the picture is then mirrored.
struct FViewWindow
{
	double Left = -1, Right = 1, Bottom = -1, Top = 1;
	bool bOrthographic = false;
	friend bool operator==(const FViewWindow&, const FViewWindow&) = default;
};

struct FView
{
	glm::dvec3 Position{0};
	glm::vec3 Forward{0, 0, -1}; ///< need not be unit length
	glm::vec3 Up{0, 1, 0};       ///< not parallel to Forward
	float FovY = 1.0f;           ///< radians, vertical, in (0, π); not read if there is a Window
	float Near = 0.05f;          ///< metres, > 0; depth is Near / distance, and there is no far plane
	/// For views that FovY cannot say: off-centre, orthographic, mirrored. The sample engine's raster draws no orthographic ones.
	std::optional<FViewWindow> Window;
	/// Offset of the picture by jitter, pixels, right and down: without it, all would be seen at a position less by this.
	glm::vec2 Jitter{0};
	/// Error that texels of depth have, and the sine of the angle by which normals may be off: see FViewConstants.
	glm::vec3 DepthError{0};
	float NormalError = 0.0f;
	bool bDerivedNormals = false; ///< geometric normals come from depth
	/// Orthographic: how far the view sees, metres; culling keeps what is within.
	double Far = 0.0;
	uint32_t Width = 0, Height = 0;
	/// Number of the frame among those of all views. Shaders count the frames of a view by themselves, from the first one's number on.
	uint32_t FrameIndex = 0;
	uint32_t Seed = 0;
	float Exposure = 0.0f; ///< stops
	/// Exposure is that of the picture. If not, nothing is left out for being dim.
	bool bExposureKnown = true;
	/// Time since the frame before, in seconds, > 0. Histories are kept in seconds, so that 30 and 144 frames a second behave alike.
	float DeltaSeconds = 1.0f / 60.0f;
	/// Carries nothing over from the frame before: another place, another world.
	bool bCut = false;

	/// Returns Window, or that of FovY.
	FViewWindow GetWindow() const;
	/// Returns the height of a pixel at distance 1; if orthographic at any distance, in metres.
	double GetPixelSize() const;
};

/// Fills the constants of a view. Origin: the scene's (FRTScene::GetOrigin). Previous: the view of the frame before; null: nothing is
/// carried over from it.
FViewConstants MakeViewConstants(const FView& View, glm::dvec3 Origin, const FView* Previous = nullptr);

/// Returns what gathering has to know of a view.
FGatherView MakeGatherView(const FView& View);

/// The volume that a view sees, for culling on the CPU. A sphere is seen by neither of two opposite sides if
/// |dot(center − Eye, Axis)| · Scale − distance · Slope − Half > radius.
struct FViewFrustum
{
	explicit FViewFrustum(const FView& View);
	/// Returns false if nothing of the sphere is seen. True may be wrong near the edges.
	bool MaySee(glm::dvec3 Center, double Radius) const;

	struct FSides
	{
		glm::dvec3 Axis; ///< across the picture; sheared so that the middle of the picture lies at 0
		double Scale = 1, Slope = 0, Half = 0;
	};
	glm::dvec3 Eye, Forward;
	double Near;
	FSides X, Y;
};

/// Looks from Position to Target with y up, or with -z up if it looks along y.
FView LookAt(glm::dvec3 Position, glm::dvec3 Target, float FovY, uint32_t Width, uint32_t Height);

} // namespace Lantern
