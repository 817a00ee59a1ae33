// Projections of hosts against double precision: what a host's matrix does to a point, passes must undo.
#include <cmath>
#include <random>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "LanternRenderer/HostProjection.h"

namespace Lantern
{
namespace
{

using ::testing::HasSubstr;

/// How one kind of host writes its projection.
struct FConvention
{
	bool bReversed, bInfinite, bOrthographic, bViewYDown, bViewZForward, bClipYUp;
};

/// The projection of a host onto a window of its view space, whose edges are those of FViewWindow; distances in its own unit.
struct FHost
{
	FConvention As;
	FViewWindow Window;
	double Near, Far, MetersPerUnit;

	FHostProjection MakeProjection() const
	{
		FHostProjection P;
		P.bViewYDown = As.bViewYDown;
		P.bViewZForward = As.bViewZForward;
		P.bClipYUp = As.bClipYUp;
		P.MetersPerUnit = MetersPerUnit;
		const double Z = As.bViewZForward ? 1.0 : -1.0, Y = (As.bClipYUp ? 1.0 : -1.0), ViewY = As.bViewYDown ? -1.0 : 1.0;
		const double Width = Window.Right - Window.Left, Height = Window.Top - Window.Bottom;
		double* const M = P.ViewToClip;
		M[0] = 2.0 / Width;
		M[5] = 2.0 / Height * Y * ViewY;
		const double MiddleX = -(Window.Left + Window.Right) / Width, MiddleY = -(Window.Bottom + Window.Top) / Height * Y;
		// Depth = A + B / distance, or A + B · distance, is 0 and 1 at the planes.
		const double AtNear = As.bReversed ? 1.0 : 0.0, AtFar = 1.0 - AtNear;
		if (As.bOrthographic)
		{
			M[3] = MiddleX;
			M[7] = MiddleY;
			M[10] = (AtFar - AtNear) / (Far - Near) * Z;
			M[11] = AtNear - (AtFar - AtNear) / (Far - Near) * Near;
			M[15] = 1.0;
			return P;
		}
		const double InverseFar = As.bInfinite ? 0.0 : 1.0 / Far;
		const double B = (AtNear - AtFar) / (1.0 / Near - InverseFar), A = AtFar - B * InverseFar;
		M[2] = MiddleX * Z;
		M[6] = MiddleY * Z;
		M[10] = A * Z;
		M[11] = B;
		M[14] = Z;
		return P;
	}
};

struct FPicturePoint
{
	glm::dvec2 Pixel; ///< without jitter
	double Depth;
};

/// By the host's matrix alone. Point: right, up and forward from the host's camera, in its unit.
FPicturePoint ProjectByHost(const FHostProjection& P, const glm::dvec3& Point, glm::dvec2 Size)
{
	const glm::dvec4 View(Point.x, P.bViewYDown ? -Point.y : Point.y, P.bViewZForward ? Point.z : -Point.z, 1);
	glm::dvec4 Clip(0);
	for (int Row = 0; Row < 4; ++Row)
	{
		for (int Column = 0; Column < 4; ++Column) { Clip[Row] += P.ViewToClip[Row * 4 + Column] * View[Column]; }
	}
	const glm::dvec3 Ndc = glm::dvec3(Clip) / Clip.w;
	return {glm::dvec2(0.5 + 0.5 * Ndc.x, 0.5 + 0.5 * (P.bClipYUp ? -Ndc.y : Ndc.y)) * Size, Ndc.z};
}

/// What Shaders/Library/View.glsl does.
glm::vec3 Reconstruct(const FViewConstants& C, glm::vec2 Pixel, float Distance)
{
	const glm::vec2 Aside = (Pixel * C.RayScale + C.RayOffset) * (C.bOrthographic != 0u ? 1.0f : Distance);
	return C.CameraForward * Distance + C.CameraRight * Aside.x + C.CameraUp * Aside.y;
}

class FHostProjectionTest : public ::testing::Test
{
protected:
	double Uniform(double Min, double Max) { return std::uniform_real_distribution<double>(Min, Max)(Random); }
	FView MakeView()
	{
		const glm::dvec3 Position(Uniform(-9, 9), Uniform(-9, 9), Uniform(-9, 9));
		FView View = LookAt(Position, Position + glm::dvec3(Uniform(-1, 1), Uniform(-0.5, 0.5), Uniform(-1, 1)), 1.0f, 320, 180);
		View.Jitter = {Uniform(-0.5, 0.5), Uniform(-0.5, 0.5)};
		return View;
	}
	FHost MakeHost(uint32_t Bits)
	{
		FHost Host;
		Host.As = {(Bits & 1) != 0, (Bits & 2) != 0, (Bits & 4) != 0, (Bits & 8) != 0, (Bits & 16) != 0, (Bits & 32) != 0};
		Host.MetersPerUnit = Bits % 3 == 0 ? 0.01 : 1.0;
		const double Unit = 1.0 / Host.MetersPerUnit, Extent = Host.As.bOrthographic ? 10.0 * Unit : 1.0;
		Host.Window = {
		    Uniform(-1, 0) * Extent, Uniform(0.1, 1) * Extent, Uniform(-1, 0) * Extent, Uniform(0.1, 1) * Extent, Host.As.bOrthographic};
		Host.Near = Uniform(0.05, 1) * Unit;
		Host.Far = Host.Near + Uniform(10, 1000) * Unit;
		return Host;
	}
	/// In the window, right, up, forward; in the host's unit.
	glm::dvec3 MakePoint(const FHost& Host)
	{
		const double Z = Uniform(Host.Near, std::min(Host.Far, Host.Near + 50 / Host.MetersPerUnit)),
		             Scale = Host.As.bOrthographic ? 1.0 : Z;
		return {Uniform(Host.Window.Left, Host.Window.Right) * Scale, Uniform(Host.Window.Bottom, Host.Window.Top) * Scale, Z};
	}
	std::mt19937 Random{5};
};

constexpr uint32_t Conventions = 64;

TEST_F(FHostProjectionTest, PassesFindThePointsThatTheHostProjected)
{
	for (uint32_t Bits = 0; Bits < Conventions * 4; ++Bits)
	{
		const FHost Host = MakeHost(Bits);
		const FHostProjection Projection = Host.MakeProjection();
		FView View = MakeView();
		const FView Before = View;
		FHostDepth Depth;
		const FRTStatus Status = ReadProjection(Projection, View, Depth);
		ASSERT_TRUE(Status.IsOk()) << Bits << ": " << Status.Message;
		EXPECT_EQ(Depth.bReversed, Host.As.bReversed) << Bits;
		const FViewConstants C = MakeViewConstants(View, {});
		const glm::dvec3 Forward = glm::normalize(glm::dvec3(View.Forward)),
		                 Right = glm::normalize(glm::cross(Forward, glm::dvec3(View.Up)));
		const glm::dvec3 Up = glm::cross(Right, Forward);
		for (int I = 0; I < 20; ++I)
		{
			const glm::dvec3 Point = MakePoint(Host);
			const FPicturePoint Seen = ProjectByHost(Projection, Point, {View.Width, View.Height});
			const double Value = Depth.AtZero + (Depth.AtOne - Depth.AtZero) * Seen.Depth;
			const double Distance = Host.As.bOrthographic ? Value : 1.0 / Value;
			const glm::vec3 Found = Reconstruct(C, glm::vec2(Seen.Pixel) + View.Jitter, float(Distance));
			const glm::dvec3 World = (Right * Point.x + Up * Point.y + Forward * Point.z) * Host.MetersPerUnit + Before.Position;
			const double Size = glm::length(Point) * Host.MetersPerUnit + 1.0;
			EXPECT_LT(glm::distance(glm::dvec3(Found) + View.Position, World), 2e-6 * Size) << "convention " << Bits;
			EXPECT_GE(Distance, double(View.Near) * 0.999999);
			// The matrix of motion vectors has no jitter.
			const glm::vec4 Clip = C.RelativeToClip * glm::vec4(glm::vec3(World - View.Position), 1.0f);
			const glm::dvec2 Pixel = (glm::dvec2(Clip) / double(Clip.w) * 0.5 + 0.5) * glm::dvec2(View.Width, View.Height);
			EXPECT_LT(glm::distance(Pixel, Seen.Pixel), 2e-3) << "convention " << Bits;
		}
	}
}

TEST_F(FHostProjectionTest, EasyPerspectiveIsNative)
{
	FHost Host{{true, true, false, false, false, false}, {-2, 2, -1, 1, false}, 0.25, 0, 1.0};
	FView View = MakeView();
	FHostDepth Depth;
	ASSERT_TRUE(ReadProjection(Host.MakeProjection(), View, Depth).IsOk());
	EXPECT_TRUE(Depth.IsNative());
	EXPECT_EQ(View.Near, 0.25f);
	EXPECT_EQ(GetDepthError(ERTFormat::D32_FLOAT, Depth), glm::vec3(0));
	Host.As.bInfinite = false;
	Host.Far = 1000;
	ASSERT_TRUE(ReadProjection(Host.MakeProjection(), View, Depth).IsOk());
	EXPECT_FALSE(Depth.IsNative());
	EXPECT_NEAR(View.Far, 1000, 1e-6);
}

TEST_F(FHostProjectionTest, FrustumSeesWhatThePictureShowsAndLittleElse)
{
	uint32_t Culled = 0, Outside = 0;
	for (uint32_t Bits = 0; Bits < Conventions; ++Bits)
	{
		const FHost Host = MakeHost(Bits);
		FView View = MakeView();
		FHostDepth Depth;
		ASSERT_TRUE(ReadProjection(Host.MakeProjection(), View, Depth).IsOk());
		const FViewFrustum Frustum(View);
		const FViewConstants C = MakeViewConstants(View, {});
		for (int I = 0; I < 200; ++I)
		{
			const glm::vec2 Pixel(Uniform(-1, 2) * View.Width, Uniform(-1, 2) * View.Height);
			const double Distance = View.Near + Uniform(0.001, 30.0);
			const glm::dvec3 World = View.Position + glm::dvec3(Reconstruct(C, Pixel, float(Distance)));
			const bool bInPicture = Pixel.x >= 0 && Pixel.x <= View.Width && Pixel.y >= 0 && Pixel.y <= View.Height;
			const double Radius = 1e-4;
			if (bInPicture) { EXPECT_TRUE(Frustum.MaySee(World, Radius + 1e-3 * C.PixelSize * Distance)) << Bits; }
			else
			{
				++Outside;
				Culled += Frustum.MaySee(World, Radius) ? 0 : 1;
			}
		}
	}
	EXPECT_GT(Culled, Outside * 98 / 100);
}

// What an orthographic view sees has no point that it is seen from: culling by distance counts from all that it sees.
TEST_F(FHostProjectionTest, GatheringKeepsAllThatAnOrthographicViewSees)
{
	FHost Host{{true, false, true, false, false, false}, {-3000, 2000, -500, 4000, true}, 0, 8000, 1.0};
	FView View = MakeView();
	FHostDepth Depth;
	ASSERT_TRUE(ReadProjection(Host.MakeProjection(), View, Depth).IsOk());
	FCullingSettings Settings;
	Settings.Radius = 10.0f;
	Settings.Angle = 45.0f;
	Settings.ShadowMinPixels = Settings.VisibleMinPixels = 4.0f;
	const FCullingRule Rule(MakeGatherView(View), Settings);
	const FViewConstants C = MakeViewConstants(View, {});
	for (int I = 0; I < 1000; ++I)
	{
		const glm::vec2 Pixel(Uniform(0, View.Width), Uniform(0, View.Height));
		const glm::dvec3 World = View.Position + glm::dvec3(Reconstruct(C, Pixel, float(Uniform(1, 8000))));
		EXPECT_EQ(Rule.Test(World, 0.001), 0xff);
	}
	EXPECT_EQ(Rule.Test(View.Position - glm::dvec3(View.Forward) * 9000.0, 1.0), 0) << "far before the near plane";
	EXPECT_NEAR(Rule.ScreenSize({0, 0, 0}, 25.0), 50.0 / 25.0, 1e-5) << "4,500 m are 180 pixels";
}

TEST_F(FHostProjectionTest, WhatIsNoProjectionIsRefusedAndChangesNothing)
{
	const FHost Host{{true, true, false, false, false, false}, {-2, 2, -1, 1, false}, 0.25, 0, 1.0};
	const auto Expect = [&](int Element, double Value, const char* Why) {
		FHostProjection P = Host.MakeProjection();
		P.ViewToClip[Element] = Value;
		FView View = MakeView();
		FHostDepth Depth;
		const FRTStatus Status = ReadProjection(P, View, Depth);
		EXPECT_EQ(Status.Code, ERTResult::InvalidArgument) << Why;
		EXPECT_THAT(Status.Message, HasSubstr(Why));
		EXPECT_FALSE(View.Window.has_value());
	};
	Expect(0, NAN, "not finite");
	Expect(0, 0.0, "singular");
	Expect(5, 0.0, "singular");
	Expect(11, 0.0, "singular");
	Expect(14, 0.0, "neither the distance nor constant");
	Expect(12, 0.1, "neither the distance nor constant");
	Expect(15, 0.1, "neither the distance nor constant");
	Expect(1, 0.1, "mixes x with y");
	Expect(8, 0.1, "oblique");
	Expect(3, 0.1, "shifts the eye");
	Expect(11, -0.25, "near plane behind the camera");
	Expect(0, 1e30, "degenerate");
	Expect(5, 1e-30, "degenerate");
	Expect(11, 1e-30, "degenerate");
	FHostProjection P = Host.MakeProjection();
	std::fill(P.ViewToClip, P.ViewToClip + 16, 0.0);
	FView View = MakeView();
	FHostDepth Depth;
	EXPECT_EQ(ReadProjection(P, View, Depth).Code, ERTResult::InvalidArgument);
}

} // namespace
} // namespace Lantern
