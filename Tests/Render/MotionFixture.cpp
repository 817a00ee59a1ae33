#include "MotionFixture.h"

#include <cmath>
#include <cstring>

namespace Lantern
{

namespace
{
constexpr double Promise = 0.01; // pixels
} // namespace

void FMotionTestBase::Read(FFrameContext& Context, FGraphTexture Texture, TRTRef<IRTBuffer>& Out)
{
	ASSERT_TRUE(Texture.IsValid());
	const uint64_t Size = uint64_t(Context.Width) * Context.Height * sizeof(glm::vec4);
	ASSERT_OK(Context.Device.CreateBuffer({Size, ERTBufferUsage::CopyDest, ERTMemory::Readback, "Motion"},
	                                      Out.ReleaseAndGetAddress()));
	const FGraphBuffer Target = Context.Graph.ImportBuffer(Out.Get(), ERTAccess::None, ERTAccess::HostRead, "Motion");
	Context.Graph.AddPass("ReadMotion",
	                      [&](FPassBuilder& Builder) -> FPassExecute
	                      {
		                      Builder.Read(Texture, ERTAccess::CopyRead);
		                      Builder.Write(Target, ERTAccess::CopyWrite);
		                      return [=](FPassContext& Pass) {
			                      Pass.Commands().CopyTextureToBuffer(Pass.GetBuffer(Target), 0,
			                                                          Pass.GetTexture(Texture), 0, 0);
		                      };
	                      });
}

std::vector<glm::vec4> FMotionTestBase::Take(IRTBuffer* Buffer, const FView& View)
{
	std::vector<glm::vec4> Out(size_t(View.Width) * View.Height);
	if (Buffer)
	{
		std::memcpy(Out.data(), Buffer->GetMapped(), Out.size() * sizeof(Out[0]));
	}
	return Out;
}

FMotionPicture FMotionTestBase::Render(const FView& View, double Time, bool bOwnRaster)
{
	TRTRef<IRTBuffer> OfHost, OfCamera;
	FGBufferPass Raster(GetEngine().GetRenderer());
	Raster.SetMotion(false);
	GetEngine().ExtraPasses = [&](FFrameContext& Context, const FGBuffer& GBuffer, const FFrameOutputs&)
	{
		Read(Context, GBuffer.Motion, OfHost);
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
	return {Take(OfHost.Get(), View), Take(OfCamera.Get(), View)};
}

void FMotionTestBase::ExpectExact(const char* What, const FMotionSnapshot& Before, const FMotionSnapshot& Now,
                                  const std::vector<glm::vec4>& Motion, const std::vector<glm::vec4>& Objects)
{
	double Worst = 0.0, WorstDistance = 0.0, Longest = 0.0;
	size_t Seen = 0, Others = 0;
	for (uint32_t Y = 0; Y < Height; ++Y)
	{
		for (uint32_t X = 0; X < Width; ++X)
		{
			const glm::vec4& Got = Motion[Y * Width + X];
			ASSERT_TRUE(std::isfinite(Got.x + Got.y + Got.z + Got.w));
			const std::optional<FExactMotion> Exact = FindMotion(Before, Now, GetScene().GetDescription(), X, Y);
			// On outlines it is the rasteriser's to say which of two neighbours a pixel's centre is in.
			const bool bSame = (Exact ? Exact->Object + 1 : 0) == static_cast<uint32_t>(Objects[Y * Width + X].w);
			if (!bSame)
			{
				++Others;
			}
			if (!bSame || !Exact)
			{
				continue;
			}
			++Seen;
			const double Error = glm::length(glm::dvec2(Got) - Exact->Motion),
			             Relative = std::abs(Got.z / Exact->PreviousDistance - 1.0);
			if (Error > Worst && Error > Promise)
			{
				ADD_FAILURE() << What << " at " << X << ", " << Y << ": " << Got.x << ", " << Got.y << " instead of "
				              << Exact->Motion.x << ", " << Exact->Motion.y;
			}
			Worst = std::max(Worst, Error);
			WorstDistance = std::max(WorstDistance, Relative);
			Longest = std::max(Longest, glm::length(Exact->Motion));
		}
	}
	PrintFigure(fmt::format("{}: {} pixels, motion up to {:.2f} px, off by at most {:.5f} px; distance by {:.1e}", What,
	                        Seen, Longest, Worst, WorstDistance));
	EXPECT_LE(Worst, Promise) << What;
	EXPECT_LE(WorstDistance, 1e-4) << What;
	EXPECT_GT(Seen, size_t(Width) * Height / 10) << What << ": too little to see";
	EXPECT_LE(Others, size_t(Width) * Height / 100) << What;
}

} // namespace Lantern
