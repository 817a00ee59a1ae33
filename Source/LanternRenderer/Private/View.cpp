// Matrices and constants of a view, and its frustum.
#include "LanternRenderer/View.h"

#include <algorithm>
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
	const FViewWindow Window = View.GetWindow();
	const double Width = Window.Right - Window.Left, Height = Window.Top - Window.Bottom;
	const auto ScaleX = static_cast<float>(2.0 / Width), ScaleY = static_cast<float>(2.0 / Height);
	const auto MiddleX = static_cast<float>((Window.Left + Window.Right) / Width);
	const auto MiddleY = static_cast<float>((Window.Bottom + Window.Top) / Height);
	// Vulkan's clip space has y down; w is the distance along the view, z the constant near: depth = near / w.
	const bool bOrtho = Window.bOrthographic;
	const glm::vec3 ShearX = bOrtho ? glm::vec3(0) : Axes[2] * MiddleX, ShearY = bOrtho ? glm::vec3(0) : Axes[2] * MiddleY;
	const glm::vec4 Rows[4] = {glm::vec4(Axes[0] * ScaleX - ShearX, bOrtho ? -MiddleX : 0.0f),
	    glm::vec4(Axes[1] * -ScaleY + ShearY, bOrtho ? MiddleY : 0.0f), glm::vec4(0, 0, 0, View.Near),
	    bOrtho ? glm::vec4(0, 0, 0, 1) : glm::vec4(Axes[2], 0)};
	return glm::transpose(glm::mat4(Rows[0], Rows[1], Rows[2], Rows[3]));
}

/// Coordinates at distance 1 of the picture's points, from their pixels.
void SetRays(const FView& View, FViewConstants& Out)
{
	const FViewWindow Window = View.GetWindow();
	const glm::dvec2 Scale((Window.Right - Window.Left) / View.Width, (Window.Bottom - Window.Top) / View.Height);
	Out.RayScale = glm::vec2(Scale);
	Out.RayOffset = glm::vec2(glm::dvec2(Window.Left, Window.Top) - glm::dvec2(View.Jitter) * Scale);
	Out.ClipJitter = 2.0f * View.Jitter / glm::vec2(View.Width, View.Height);
	Out.PixelSize = static_cast<float>(View.GetPixelSize());
	Out.bOrthographic = Window.bOrthographic ? 1u : 0u;
}
} // namespace

FViewWindow FView::GetWindow() const
{
	if (Window) { return *Window; }
	const double TanY = std::tan(0.5 * double(FovY)), TanX = TanY * Width / Height;
	return {-TanX, TanX, -TanY, TanY, false};
}

double FView::GetPixelSize() const
{
	const FViewWindow Seen = GetWindow();
	return std::abs(Seen.Top - Seen.Bottom) / Height;
}

FViewConstants MakeViewConstants(const FView& View, glm::dvec3 Origin, const FView* Previous)
{
	assert(View.Width > 0 && View.Height > 0 && View.Near > 0.0f && View.DeltaSeconds > 0.0f);
	const glm::mat3 Axes = MakeAxes(View);
	FViewConstants C{};
	C.RelativeToClip = MakeRelativeToClip(View);
	C.CameraPosition = glm::vec3(View.Position - Origin);
	C.CameraRight = Axes[0];
	C.CameraUp = Axes[1];
	C.CameraForward = Axes[2];
	SetRays(View, C);
	C.Near = View.Near;
	C.FrameIndex = View.FrameIndex;
	C.Width = View.Width;
	C.Height = View.Height;
	C.Seed = View.Seed;
	C.Exposure = View.bExposureKnown ? std::exp2(View.Exposure) : 0.0f;
	C.DepthError = View.DepthError;
	C.NormalError = View.NormalError;
	C.bDerivedNormals = View.bDerivedNormals ? 1u : 0u;
	const FView& Before = Previous ? *Previous : View;
	C.PreviousRelativeToClip = MakeRelativeToClip(Before);
	C.CameraMotion = glm::vec3(View.Position - Before.Position);
	C.PreviousNear = Before.Near;
	C.PreviousForward = MakeAxes(Before)[2];
	C.PreviousWidth = Before.Width;
	C.PreviousHeight = Before.Height;
	C.DeltaSeconds = View.DeltaSeconds;
	C.bHistory = Previous ? 1u : 0u;
	return C;
}

FGatherView MakeGatherView(const FView& View)
{
	FGatherView Out(View.Position, View.Forward);
	Out.PixelSize = static_cast<float>(View.GetPixelSize());
	Out.Height = View.Height;
	const FViewWindow Window = View.GetWindow();
	if (!Window.bOrthographic) { return Out; }
	const glm::mat3 Axes = MakeAxes(View);
	const double HalfDepth = 0.5 * std::max(View.Far, 0.0);
	Out.bOrthographic = true;
	Out.Position += glm::dvec3(Axes[0]) * (0.5 * (Window.Left + Window.Right)) +
	                glm::dvec3(Axes[1]) * (0.5 * (Window.Bottom + Window.Top)) + glm::dvec3(Axes[2]) * HalfDepth;
	Out.Reach = glm::length(glm::dvec3(0.5 * (Window.Right - Window.Left), 0.5 * (Window.Top - Window.Bottom), HalfDepth));
	return Out;
}

FViewFrustum::FViewFrustum(const FView& View) : Eye(View.Position), Forward(glm::normalize(glm::dvec3(View.Forward))), Near(View.Near)
{
	const glm::dvec3 Right = glm::normalize(glm::cross(Forward, glm::dvec3(View.Up))), Up = glm::cross(Right, Forward);
	FViewWindow Window = View.GetWindow();
	// Jitter moves the picture's edges, too.
	const glm::dvec2 Jitter(View.Jitter.x / float(View.Width), View.Jitter.y / float(View.Height));
	const glm::dvec2 Moved = Jitter * glm::dvec2(Window.Right - Window.Left, Window.Bottom - Window.Top);
	Window.Left -= Moved.x;
	Window.Right -= Moved.x;
	Window.Bottom -= Moved.y;
	Window.Top -= Moved.y;
	const auto MakeSides = [&](const glm::dvec3& Axis, double A, double B) {
		const double Middle = 0.5 * (A + B), HalfWidth = 0.5 * std::abs(B - A);
		if (Window.bOrthographic)
		{
			Eye += Axis * Middle;
			return FSides{Axis, 1.0, 0.0, HalfWidth};
		}
		// Of the two planes the one with the longer normal gives the limit of both.
		const double Normal = std::sqrt(1.0 + std::max(A * A, B * B));
		return FSides{Axis - Forward * Middle, 1.0 / Normal, HalfWidth / Normal, 0.0};
	};
	X = MakeSides(Right, Window.Left, Window.Right);
	Y = MakeSides(Up, Window.Bottom, Window.Top);
}

bool FViewFrustum::MaySee(glm::dvec3 Center, double Radius) const
{
	const glm::dvec3 D = Center - Eye;
	const double Z = glm::dot(D, Forward);
	const auto IsWithin = [&](const FSides& Sides) {
		return std::abs(glm::dot(D, Sides.Axis)) * Sides.Scale - Z * Sides.Slope - Sides.Half <= Radius;
	};
	return Z + Radius >= Near && IsWithin(X) && IsWithin(Y);
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
