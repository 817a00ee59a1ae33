// Matrices and constants of a view, and its frustum.
#include "LanternRenderer/View.h"

#include <cassert>
#include <cmath>

namespace Lantern
{

namespace
{
/// Right, up and forward of unit length.
glm::mat3 MakeAxes(const FView& View)
{
	const glm::vec3 Forward = glm::normalize(View.Forward);
	const glm::vec3 Right = glm::normalize(glm::cross(Forward, View.Up));
	return {Right, glm::cross(Right, Forward), Forward};
}

glm::mat4 MakeRelativeToClip(const FView& View)
{
	const glm::mat3 Axes = MakeAxes(View);
	const float ScaleY = 1.0f / std::tan(0.5f * View.FovY);
	const float ScaleX = ScaleY * static_cast<float>(View.Height) / static_cast<float>(View.Width);
	// Vulkan's clip space has y down; w is the distance along the view, z the constant near: depth = near / w.
	const glm::vec4 Rows[4] = {
	    glm::vec4(Axes[0] * ScaleX, 0), glm::vec4(Axes[1] * -ScaleY, 0), glm::vec4(0, 0, 0, View.Near), glm::vec4(Axes[2], 0)};
	return glm::transpose(glm::mat4(Rows[0], Rows[1], Rows[2], Rows[3]));
}
} // namespace

FViewConstants MakeViewConstants(const FView& View, glm::dvec3 Origin, const FView* Previous)
{
	assert(View.Width > 0 && View.Height > 0 && View.Near > 0.0f && View.DeltaSeconds > 0.0f);
	const glm::mat3 Axes = MakeAxes(View);
	FViewConstants C{};
	C.TanHalfFovY = std::tan(0.5f * View.FovY);
	C.Aspect = static_cast<float>(View.Width) / static_cast<float>(View.Height);
	C.RelativeToClip = MakeRelativeToClip(View);
	C.CameraPosition = glm::vec3(View.Position - Origin);
	C.CameraRight = Axes[0];
	C.CameraUp = Axes[1];
	C.CameraForward = Axes[2];
	C.Near = View.Near;
	C.FrameIndex = View.FrameIndex;
	C.Width = View.Width;
	C.Height = View.Height;
	C.Seed = View.Seed;
	C.Exposure = std::exp2(View.Exposure);
	const FView& Before = Previous ? *Previous : View;
	C.PreviousRelativeToClip = MakeRelativeToClip(Before);
	C.CameraMotion = glm::vec3(View.Position - Before.Position);
	C.PreviousNear = Before.Near;
	C.PreviousForward = MakeAxes(Before)[2];
	C.DeltaSeconds = View.DeltaSeconds;
	C.bHistory = Previous ? 1u : 0u;
	return C;
}

FViewFrustum::FViewFrustum(const FView& View) : Position(View.Position), Forward(glm::normalize(glm::dvec3(View.Forward))), Near(View.Near)
{
	Right = glm::normalize(glm::cross(Forward, glm::dvec3(View.Up)));
	Up = glm::cross(Right, Forward);
	const double HalfY = 0.5 * double(View.FovY);
	const double HalfX = std::atan(std::tan(HalfY) * double(View.Width) / double(View.Height));
	CosX = std::cos(HalfX);
	SinX = std::sin(HalfX);
	CosY = std::cos(HalfY);
	SinY = std::sin(HalfY);
}

bool FViewFrustum::MaySee(glm::dvec3 Center, double Radius) const
{
	const glm::dvec3 D = Center - Position;
	const double Z = glm::dot(D, Forward);
	if (Z + Radius < Near) { return false; }
	// Distances from the side planes, all of which pass through the camera.
	return std::abs(glm::dot(D, Right)) * CosX - Z * SinX <= Radius && std::abs(glm::dot(D, Up)) * CosY - Z * SinY <= Radius;
}

FView LookAt(glm::dvec3 Position, glm::dvec3 Target, float FovY, uint32_t Width, uint32_t Height)
{
	FView View;
	View.Position = Position;
	View.Forward = glm::vec3(glm::normalize(Target - Position));
	View.Up = std::abs(View.Forward.y) > 0.9999f ? glm::vec3(0, 0, -1) : glm::vec3(0, 1, 0);
	View.FovY = FovY;
	View.Width = Width;
	View.Height = Height;
	return View;
}

} // namespace Lantern
