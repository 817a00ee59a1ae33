// The module's views and worlds on a mock device: what is refused, by which name.
#include <cmath>
#include <cstring>
#include <limits>

#include "ModuleTestTools.h"

namespace Lantern
{
namespace
{

class FModuleViewTest : public FModuleTest
{
protected:
	/// RenderFrame with a view that Change has spoilt must name Part, and change nothing: the next frame is fine.
	template <class TChange>
	void ExpectRefused(const TChange& Change, const char* Part)
	{
		FRTModuleFrame Frame = DescribeFrame();
		Change(Frame.View);
		EXPECT_REFUSED(Renderer->RenderFrame(Frame, &Outputs), Part);
		Frame = DescribeFrame();
		FRTModuleView Previous = Frame.View;
		Change(Previous);
		Frame.PreviousView = &Previous;
		EXPECT_REFUSED(Renderer->RenderFrame(Frame, &Outputs), "PreviousView");
		EXPECT_TRUE(RenderWholeFrame().IsOk());
	}
};

TEST_F(FModuleViewTest, ImpossibleViewIsRefusedByName)
{
	ExpectRefused([](auto& V) { V.Projection = {}; }, "FRTModuleView::Projection");
	ExpectRefused([](auto& V) { V.Projection.ViewToClip[5] = NAN; }, "Projection: the projection is not finite");
	ExpectRefused([](auto& V) { V.Projection.ViewToClip[11] = 0; }, "singular");
	ExpectRefused([](auto& V) { V.Jitter[1] = NAN; }, "Jitter");
	ExpectRefused([](auto& V) { V.Forward[2] = -2.0f; }, "Forward");
	ExpectRefused([](auto& V) { V.Forward[2] = NAN; }, "Forward");
	ExpectRefused(
	    [](auto& V) {
		V.Up[1] = 0.0f;
		V.Up[2] = 5.0f;
	    },
	    "parallel");
	ExpectRefused([](auto& V) { V.Position[0] = std::numeric_limits<double>::infinity(); }, "Position");
}

// What is dim gets few rays, and nobody knows what is dim without an exposure.
TEST_F(FModuleViewTest, ExposureReachesShaders)
{
	ASSERT_OK(Module->SetConsoleVariable("r.RT.Shadow.Path", "2"));
	ASSERT_OK(AddObject(AddMesh(DescribeTriangle()), Solid));
	ASSERT_OK(SetSun(-1.0));
	const auto Show = [&](float Exposure) {
		FRTModuleFrame Frame = DescribeFrame();
		Frame.Exposure = Exposure;
		(void)ReadConstants(Frame);
		for (const FRTMockCall& Call : Mock().FindCalls(ERTMockCall::Dispatch))
		{
			FPassConstants Pushed{};
			if (Call.Bytes.size() < sizeof(Pushed)) { continue; }
			std::memcpy(&Pushed, Call.Bytes.data(), sizeof(Pushed));
			if (Mock().FindBuffer(Pushed.View, nullptr) != nullptr) { return ReadEntry<FViewConstants>(Pushed.View, 0).Exposure; }
		}
		return -1.0f;
	};
	EXPECT_EQ(Show(0.0f), 0.0f);
	EXPECT_EQ(Show(0.25f), 0.25f);
	EXPECT_FLOAT_EQ(Show(3e-5f), 3e-5f);
}

/// A frame in a layout that Change describes. A texture is made for each format.
class FModuleLayoutTest : public FModuleTest
{
protected:
	template <class TChange>
	FRTStatus RenderWith(const TChange& Change)
	{
		FRTModuleFrame Frame = DescribeFrame();
		Change(Frame);
		const FRTStatus Status = Renderer->RenderFrame(Frame, &Outputs);
		return Status ? Renderer->EndFrame(nullptr) : Status;
	}
	IRTTexture* Make(ERTFormat Format, uint32_t Size = 64) { return Made.emplace_back(MakeTexture(Format, Size)).Get(); }
	std::vector<TRTRef<IRTTexture>> Made;
};

TEST_F(FModuleLayoutTest, OrdinaryGBuffersAreTaken)
{
	using enum ERTFormat;
	for (const ERTFormat Format : {D32_FLOAT, D32_FLOAT_S8_UINT, D24_UNORM_S8_UINT, D16_UNORM, R32_FLOAT})
	{
		ASSERT_OK(RenderWith([&](FRTModuleFrame& Frame) { Frame.Depth = Make(Format); }));
	}
	for (const ERTFormat Format : {RGBA8_UNORM, RGBA8_SNORM, RGB10A2_UNORM, RGBA16_FLOAT, RGBA32_FLOAT})
	{
		ASSERT_OK(RenderWith([&](FRTModuleFrame& Frame) {
			Frame.Normals = Make(Format);
			Frame.Layout.Normals = ERTModuleNormals::Xyz;
		}));
	}
	ASSERT_OK(RenderWith([&](FRTModuleFrame& Frame) {
		Frame.Layout = MakeUnrealGBuffer();
		Frame.Depth = Make(D32_FLOAT_S8_UINT);
		Frame.Normals = Make(RGB10A2_UNORM);
		Frame.Motion = Make(RG16_UNORM);
		Frame.BaseColor = Make(BGRA8_SRGB);
		Frame.Material = Make(BGRA8_UNORM);
	}));
	ASSERT_OK(RenderWith([&](FRTModuleFrame& Frame) {
		Frame.Layout.Motion = ERTModuleMotion::Pixels;
		Frame.Motion = Make(RG16_FLOAT);
		Frame.Layout.bGeometricInZw = false;
		Frame.Normals = Make(RG16_SNORM);
		Frame.GeometricNormals = Make(RG16_SNORM);
		Frame.DepthAccess = Frame.NormalsAccess = Frame.GeometricNormalsAccess = ERTAccess::External;
	}));
	Made.clear();
}

// A pass over the pixels is for what is not native, and for nothing else.
TEST_F(FModuleLayoutTest, NativeGBuffersCostNoPass)
{
	ASSERT_OK(Module->SetConsoleVariable("r.RT.Shadow.Path", "2"));
	ASSERT_OK(Module->SetConsoleVariable("r.RT.Pipeline.Fallback", "2")); // frames wait for their shaders
	ASSERT_OK(AddObject(AddMesh(DescribeTriangle()), Solid));
	ASSERT_OK(SetSun(-1.0));
	ASSERT_TRUE(WaitUntil(
	    "a complete frame", [&] { return Outputs.bComplete; }, [&] { EXPECT_TRUE(RenderWholeFrame().IsOk()); }));
	const auto Count = [&](const auto& Change) {
		const uint32_t Before = Mock().CountCalls(ERTMockCall::Dispatch, "HostSurface/HostSurface.comp");
		EXPECT_TRUE(RenderWith(Change).IsOk());
		EXPECT_NE(Outputs.Get(ESignal::SunShadow), nullptr);
		return Mock().CountCalls(ERTMockCall::Dispatch, "HostSurface/HostSurface.comp") - Before;
	};
	EXPECT_EQ(Count([](FRTModuleFrame&) {}), 0u);
	EXPECT_EQ(Count([](FRTModuleFrame& Frame) { Frame.View.Jitter[0] = 0.4f; }), 0u) << "jitter is no conversion";
	EXPECT_EQ(Count([](FRTModuleFrame& Frame) { Frame.Width = Frame.Height = 32; }), 0u) << "nor is a part at the corner";
	EXPECT_EQ(Count([](FRTModuleFrame& Frame) { Frame.OffsetX = 1; }), 1u);
	EXPECT_EQ(Count([](FRTModuleFrame& Frame) { Frame.Layout.bGeometricInZw = false; }), 1u);
	EXPECT_EQ(Count([](FRTModuleFrame& Frame) {
		Frame.View.Projection.ViewToClip[10] = 0.001f; // a far plane
	}),
	    1u);
}

TEST_F(FModuleLayoutTest, WhatDoesNotFitIsRefusedByName)
{
	using enum ERTFormat;
	EXPECT_REFUSED(RenderWith([&](FRTModuleFrame& Frame) { Frame.Depth = Make(R16_FLOAT); }), "the depth texture must be D32_FLOAT");
	EXPECT_REFUSED(RenderWith([&](FRTModuleFrame& Frame) { Frame.Normals = Make(RG16_SNORM); }), "bGeometricInZw");
	EXPECT_REFUSED(RenderWith([&](FRTModuleFrame& Frame) {
		Frame.Layout.Normals = ERTModuleNormals::Xyz;
		Frame.Normals = Make(RG16_SNORM);
	}),
	    "Layout.Normals is Xyz");
	EXPECT_REFUSED(RenderWith([&](FRTModuleFrame& Frame) { Frame.Motion = Make(RG16_FLOAT); }), "Layout.Motion is Native");
	EXPECT_REFUSED(RenderWith([&](FRTModuleFrame& Frame) {
		Frame.Layout.Motion = ERTModuleMotion::UV;
		Frame.Layout.bMotionDistance = true;
		Frame.Motion = Make(RG16_FLOAT);
	}),
	    "bMotionDistance");
	EXPECT_REFUSED(RenderWith([&](FRTModuleFrame& Frame) { Frame.GeometricNormals = Make(R16_FLOAT); }), "the geometric normals texture");
	EXPECT_REFUSED(RenderWith([&](FRTModuleFrame& Frame) { Frame.OffsetX = 64; }), "OffsetX");
	EXPECT_REFUSED(RenderWith([&](FRTModuleFrame& Frame) {
		Frame.OffsetY = 10;
		Frame.Height = 55;
	}),
	    "Height is 55, the textures have 54 pixels");
	EXPECT_REFUSED(RenderWith([&](FRTModuleFrame& Frame) { Frame.Layout.Motion = static_cast<ERTModuleMotion>(9); }), "Layout::Motion");
	EXPECT_REFUSED(
	    RenderWith([&](FRTModuleFrame& Frame) { Frame.Layout.MotionScale[1] = std::numeric_limits<float>::infinity(); }), "MotionScale");
	EXPECT_TRUE(RenderWholeFrame().IsOk()) << "nothing has changed";
	Made.clear();
}

TEST_F(FModuleViewTest, ImpossibleWorldIsRefusedByName)
{
	TRTRef<IRTModuleRenderer> Other;
	const auto Create = [&](const auto& Change) {
		FRTModuleRendererDesc World = MakeUnrealWorld();
		Change(World);
		return Module->CreateRenderer(Device.Get(), World, Other.ReleaseAndGetAddress());
	};
	EXPECT_REFUSED(Create([](auto& W) { W.AxisX[2] = 0; }), "AxisX must be of unit length");
	EXPECT_REFUSED(Create([](auto& W) { W.AxisY[0] = NAN; }), "AxisY");
	EXPECT_REFUSED(Create([](auto& W) {
		W.AxisZ[1] = 0;
		W.AxisZ[2] = 1;
	}),
	    "perpendicular");
	EXPECT_REFUSED(Create([](auto& W) { W.MetersPerUnit = 0; }), "MetersPerUnit");
	EXPECT_REFUSED(Create([](auto& W) { W.MetersPerUnit = NAN; }), "MetersPerUnit");
	EXPECT_FALSE(Other);
	EXPECT_TRUE(Create([](auto&) {}).IsOk());
}

} // namespace
} // namespace Lantern
