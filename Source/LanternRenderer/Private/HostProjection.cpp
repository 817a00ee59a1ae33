// Reads a host's projection matrix.
#include "LanternRenderer/HostProjection.h"

#include <algorithm>
#include <cmath>

namespace Lantern
{

namespace
{
constexpr double OrthographicNear = 1.0; ///< metres to the near plane of an orthographic view, where it starts

FRTStatus Refuse(const char* Why) { return FRTStatus::Error(ERTResult::InvalidArgument, "the projection %s", Why); }

/// The elements that views have, scaled to a w of ±distance or 1.
struct FElements
{
	double X[3] = {}, Y[3] = {}; ///< factors of x (or y), of z, and of 1
	double DepthZ = 0.0, DepthOne = 0.0;
	double W = 0.0; ///< factor of z; 0: orthographic
};

FRTStatus ReadElements(const FHostProjection& From, FElements& Out)
{
	const auto M = [&](int Row, int Column) { return From.ViewToClip[Row * 4 + Column]; };
	if (!std::all_of(From.ViewToClip, From.ViewToClip + 16, [](double V) { return std::isfinite(V); })) { return Refuse("is not finite"); }
	const double W = M(3, 2) != 0.0 ? std::abs(M(3, 2)) : M(3, 3);
	if (M(3, 0) != 0.0 || M(3, 1) != 0.0 || (M(3, 2) != 0.0) == (M(3, 3) != 0.0) || !(W > 0.0))
	{
		return Refuse("has a w that is neither the distance nor constant");
	}
	const double FlipY = From.bViewYDown ? -1.0 : 1.0;
	Out = {{M(0, 0) / W, M(0, 2) / W, M(0, 3) / W}, {M(1, 1) * FlipY / W, M(1, 2) / W, M(1, 3) / W}, M(2, 2) / W, M(2, 3) / W, M(3, 2) / W};
	if (Out.X[0] == 0.0 || Out.Y[0] == 0.0) { return Refuse("is singular: x or y does not reach the picture"); }
	if (M(0, 1) != 0.0 || M(1, 0) != 0.0) { return Refuse("mixes x with y"); }
	if (M(2, 0) != 0.0 || M(2, 1) != 0.0) { return Refuse("has an oblique near plane"); }
	return FRTStatus::Success();
}

FRTStatus ReadPerspective(const FHostProjection& From, const FElements& E, FView& View, FHostDepth& Depth)
{
	if (E.X[2] != 0.0 || E.Y[2] != 0.0) { return Refuse("shifts the eye: move the view's Position instead"); }
	if (E.DepthOne == 0.0) { return Refuse("is singular: depth does not depend on the distance"); }
	const double Unit = From.MetersPerUnit;
	Depth.AtZero = -E.DepthZ * E.W / (E.DepthOne * Unit);
	Depth.AtOne = (1.0 - E.DepthZ * E.W) / (E.DepthOne * Unit);
	Depth.bReversed = Depth.AtOne > Depth.AtZero;
	double& Far = Depth.bReversed ? Depth.AtZero : Depth.AtOne;
	const double Near = std::max(Depth.AtZero, Depth.AtOne);
	// An infinite far plane may be off by the rounding of floats.
	if (Far < 0.0 && Far > -1e-6 * Near) { Far = 0.0; }
	if (!(Near > 0.0) || Far < 0.0) { return Refuse("has a near plane behind the camera, or sees beyond infinity"); }
	View.Near = static_cast<float>(1.0 / Near);
	View.Far = Far > 0.0 ? 1.0 / Far : 0.0;
	const double MiddleX = E.X[1] * E.W, MiddleY = E.Y[1] * E.W, Top = From.bClipYUp ? 1.0 : -1.0;
	View.Window =
	    FViewWindow{(-1.0 - MiddleX) / E.X[0], (1.0 - MiddleX) / E.X[0], (-Top - MiddleY) / E.Y[0], (Top - MiddleY) / E.Y[0], false};
	return FRTStatus::Success();
}

FRTStatus ReadOrthographic(const FHostProjection& From, const FElements& E, FView& View, FHostDepth& Depth)
{
	if (E.X[1] != 0.0 || E.Y[1] != 0.0) { return Refuse("is sheared: x or y depends on the distance"); }
	if (E.DepthZ == 0.0) { return Refuse("is singular: depth does not depend on the distance"); }
	const double Unit = From.MetersPerUnit, Sign = From.bViewZForward ? 1.0 : -1.0;
	Depth.AtZero = -Sign * E.DepthOne / E.DepthZ * Unit;
	Depth.AtOne = Sign * (1.0 - E.DepthOne) / E.DepthZ * Unit;
	Depth.bReversed = Depth.AtOne < Depth.AtZero;
	const double Moved = OrthographicNear - std::min(Depth.AtZero, Depth.AtOne);
	Depth.AtZero += Moved;
	Depth.AtOne += Moved;
	View.Position -= glm::normalize(glm::dvec3(View.Forward)) * Moved;
	View.Near = static_cast<float>(OrthographicNear);
	View.Far = std::max(Depth.AtZero, Depth.AtOne);
	const double Top = From.bClipYUp ? 1.0 : -1.0;
	View.Window = FViewWindow{(-1.0 - E.X[2]) / E.X[0] * Unit, (1.0 - E.X[2]) / E.X[0] * Unit, (-Top - E.Y[2]) / E.Y[0] * Unit,
	    (Top - E.Y[2]) / E.Y[0] * Unit, true};
	return FRTStatus::Success();
}
} // namespace

FRTStatus ReadProjection(const FHostProjection& Projection, FView& View, FHostDepth& OutDepth)
{
	FElements Elements;
	if (const FRTStatus Status = ReadElements(Projection, Elements); !Status) { return Status; }
	FView Made = View;
	FHostDepth Depth;
	Depth.bOrthographic = Elements.W == 0.0;
	const FRTStatus Status =
	    Depth.bOrthographic ? ReadOrthographic(Projection, Elements, Made, Depth) : ReadPerspective(Projection, Elements, Made, Depth);
	if (!Status) { return Status; }
	const auto IsUsable = [](double Size) { return std::abs(Size) > 1e-9 && std::abs(Size) < 1e9; };
	if (!IsUsable(Made.Window->Right - Made.Window->Left) || !IsUsable(Made.Window->Top - Made.Window->Bottom) ||
	    !IsUsable(double(Made.Near)) || !(Made.Far < 1e15))
	{
		return Refuse("is degenerate: its window or its near plane has hardly any size, or is immense");
	}
	View = Made;
	OutDepth = Depth;
	return Status;
}

glm::vec3 GetDepthError(ERTFormat Format, const FHostDepth& Depth)
{
	// Depth is off by Step + Relative · depth.
	constexpr double Float = 1.0 / (1 << 23);
	double Step = 0.0, Relative = Float;
	if (Format == ERTFormat::D16_UNORM) { Step = 1.0 / 65535.0; }
	if (Format == ERTFormat::D24_UNORM_S8_UINT) { Step = 1.0 / 16777215.0; }
	if (Step > 0.0) { Relative = 0.0; }
	if (Depth.IsNative() && Step == 0.0) { return glm::vec3(0); }
	if (Depth.bLinear) { return glm::vec3(0, Relative, 0); }
	const double Range = std::abs(Depth.AtOne - Depth.AtZero);
	if (Depth.bOrthographic) { return glm::vec3(Range * (Step + Relative), 0, 0); }
	// Distance² · Range · error of depth; depth is (1 / distance − AtZero) / (AtOne − AtZero).
	const double Linear = Depth.bReversed ? Relative : 0.0;
	return glm::vec3(0, Linear, Range * Step + (Depth.bReversed ? 0.0 : Depth.AtZero * Relative));
}

} // namespace Lantern
