#include "MotionFixture.h"

#include <cmath>
#include <cstring>

namespace Lantern
{

namespace
{
constexpr double Promise = 0.01;       // pixels
constexpr double DistanceError = 1e-4; // metres; what FRTScene promises of positions
} // namespace

void FMotionTestBase::Read(FFrameContext& Context, FGraphTexture Texture, TRTRef<IRTBuffer>& Out)
{
	ASSERT_TRUE(Texture.IsValid());
	const uint64_t Size = uint64_t(Context.Width) * Context.Height * BytesPerTexel(Context.Graph.GetDesc(Texture).Format);
	ASSERT_OK(Context.Device.CreateBuffer({Size, ERTBufferUsage::CopyDest, ERTMemory::Readback, "Motion"}, Out.ReleaseAndGetAddress()));
	const FGraphBuffer Target = Context.Graph.ImportBuffer(Out.Get(), ERTAccess::None, ERTAccess::HostRead, "Motion");
	Context.Graph.AddPass("ReadMotion", [&](FPassBuilder& Builder) -> FPassExecute {
		Builder.Read(Texture, ERTAccess::CopyRead);
		Builder.Write(Target, ERTAccess::CopyWrite);
		return [=](FPassContext& Pass) { Pass.Commands().CopyTextureToBuffer(Pass.GetBuffer(Target), 0, Pass.GetTexture(Texture), 0, 0); };
	});
}

FMotionPicture FMotionTestBase::Render(const FView& View, double Time, bool bOwnRaster)
{
	TRTRef<IRTBuffer> OfHost, OfCamera, HostDepth;
	FGBufferPass Raster(GetEngine().GetRenderer());
	Raster.SetMotion(false);
	GetEngine().ExtraPasses = [&](FFrameContext& Context, const FGBuffer& GBuffer, const FFrameOutputs&) {
		Read(Context, GBuffer.Motion, OfHost);
		Read(Context, GBuffer.Depth, HostDepth);
		FGraphTexture Depth = GBuffer.Depth;
		if (bOwnRaster)
		{
			const FGBuffer Own = Raster.Add(Context, GetScene());
			EXPECT_FALSE(Own.Motion.IsValid());
			Depth = Own.Depth;
		}
		Read(Context, AddCameraMotionPass(Context, Depth), OfCamera);
	};
	EXPECT_OK(GetEngine().RenderFrame(View, Time, {}, nullptr));
	EXPECT_OK(GetEngine().GetRenderer().WaitForAll());
	GetEngine().ExtraPasses = {};
	return {Take<glm::vec4>(OfHost.Get(), View), Take<glm::vec4>(OfCamera.Get(), View), Take<float>(HostDepth.Get(), View)};
}

namespace
{
/// What a raster saw in a pixel; nothing: the sky.
struct FSeen
{
	std::optional<FExactMotion> Exact;
	bool bOutline = false; // the pixel's centre shows another surface
};

bool IsInPixelsCentre(const FExactMotion& Exact) { return glm::length(Exact.Offset) <= Promise; }

FSeen FindSeen(const FMotionSnapshot& Before, const FMotionSnapshot& Now, const FSceneDescription& Scene, const FMotionPicture& Picture,
    uint32_t X, uint32_t Y)
{
	const size_t Pixel = size_t(Y) * Now.View.Width + X;
	const uint32_t Object = static_cast<uint32_t>(Picture.OfHost[Pixel].w);
	FSeen Out{FindMotion(Before, Now, Scene, X, Y)};
	if (Object == 0) { return {std::nullopt, Out.Exact.has_value()}; }
	const double Distance = double(Now.View.Near) / Picture.Depth[Pixel];
	const bool bSame = Out.Exact && Out.Exact->Object + 1 == Object;
	const double Behind = bSame ? std::abs(Out.Exact->Distance - Distance) : 1e300;
	Out.bOutline = Behind > DistanceError;
	if (Behind <= 0.1 * DistanceError) { return Out; }
	// The distance is taken at its word as far as the pixel allows.
	Out.Exact.reset();
	for (double Error = DistanceError / 64; Error <= DistanceError && !(Out.Exact && IsInPixelsCentre(*Out.Exact)); Error *= 4)
	{
		Out.Exact = FindMotionAt(Before, Now, Scene, Object - 1, Distance, Error, X, Y);
	}
	EXPECT_TRUE(Out.Exact) << "object " << Object - 1 << " has nothing " << Distance << " m away; pixel " << X << ", " << Y;
	return Out;
}
} // namespace

void FMotionTestBase::ExpectExact(const char* What, const FMotionSnapshot& Before, const FMotionSnapshot& Now,
    const FMotionPicture& Picture, const std::vector<glm::vec4>& Motion)
{
	double Worst = 0.0, WorstDistance = 0.0, WorstOffset = 0.0, Longest = 0.0;
	size_t Seen = 0, Outlines = 0;
	const uint32_t Columns = Now.View.Width, Rows = Now.View.Height;
	for (uint32_t Y = 0; Y < Rows; ++Y)
	{
		for (uint32_t X = 0; X < Columns; ++X)
		{
			const glm::vec4& Got = Motion[size_t(Y) * Columns + X];
			ASSERT_TRUE(std::isfinite(Got.x + Got.y + Got.z + Got.w));
			const auto [Exact, bOutline] = FindSeen(Before, Now, GetScene().GetDescription(), Picture, X, Y);
			Outlines += bOutline ? 1 : 0;
			if (!Exact) { continue; }
			++Seen;
			const double Error = glm::length(glm::dvec2(Got) - Exact->Motion), Offset = glm::length(Exact->Offset);
			if ((Error > Worst && Error > Promise) || (Offset > WorstOffset && Offset > Promise))
			{
				ADD_FAILURE() << What << " at " << X << ", " << Y << ": " << Got.x << ", " << Got.y << " instead of " << Exact->Motion.x
				              << ", " << Exact->Motion.y << ", " << Offset << " px from its centre";
			}
			Worst = std::max(Worst, Error);
			WorstOffset = std::max(WorstOffset, Offset);
			WorstDistance = std::max(WorstDistance, std::abs(Got.z / Exact->PreviousDistance - 1.0));
			Longest = std::max(Longest, glm::length(Exact->Motion));
		}
	}
	PrintFigure(fmt::format("{}: {} pixels, motion up to {:.2f} px, off by at most {:.5f} px; distance by {:.1e}; {} on "
	                        "outlines, up to {:.5f} px from the pixel's centre",
	    What, Seen, Longest, Worst, WorstDistance, Outlines, WorstOffset));
	EXPECT_LE(Worst, Promise) << What;
	EXPECT_LE(WorstOffset, Promise) << What;
	EXPECT_LE(WorstDistance, 1e-4) << What;
	EXPECT_GT(Seen, size_t(Columns) * Rows / 10) << What << ": too little to see";
	EXPECT_LE(Outlines, size_t(Columns) * Rows / 100) << What;
}

} // namespace Lantern
