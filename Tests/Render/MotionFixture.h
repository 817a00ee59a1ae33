// Frames whose motion vectors are read back, and held against double precision.
#pragma once

#include <cstring>
#include <vector>

#include "MotionOracle.h"
#include "Support/RenderFixture.h"

namespace Lantern
{

struct FMotionPicture
{
	std::vector<glm::vec4> OfHost, OfCamera; // FGBuffer::Motion, AddCameraMotionPass
	std::vector<float> Depth;                // that of the host
};

class FMotionTestBase : public FRenderTest
{
protected:
	static constexpr uint32_t Width = 160, Height = 90;

	void SetUp() override
	{
		FRenderTest::SetUp();
		GetEngine().Signals.bMotion = true; // no filter asks for it
	}
	void TearDown() override
	{
		GetEngine().Signals = {};
		FRenderTest::TearDown();
	}

	static FView MakeCamera(const glm::dvec3& Position, const glm::dvec3& Target, glm::uvec2 Size = {Width, Height})
	{
		return LookAt(Position, Target, 1.0f, Size.x, Size.y);
	}
	/// Adds a pass that reads Texture back, of floats.
	static void Read(FFrameContext& Context, FGraphTexture Texture, TRTRef<IRTBuffer>& Out);
	template <class T>
	static std::vector<T> Take(IRTBuffer* Buffer, const FView& View)
	{
		std::vector<T> Out(size_t(View.Width) * View.Height);
		if (Buffer) { std::memcpy(Out.data(), Buffer->GetMapped(), Out.size() * sizeof(T)); }
		return Out;
	}
	/// One frame, and its motion. bOwnRaster: with a raster that makes none, whose depth the camera's motion is from.
	static FMotionPicture Render(const FView& View, double Time = 0.0, bool bOwnRaster = false);

	/// The host's, to 1/100 of a pixel. Before: Now itself where nothing is carried over.
	static void ExpectExact(const char* What, const FMotionSnapshot& Before, const FMotionSnapshot& Now, const FMotionPicture& Picture)
	{
		ExpectExact(What, Before, Now, Picture, Picture.OfHost);
	}
	/// Motion: of that picture.
	static void ExpectExact(const char* What, const FMotionSnapshot& Before, const FMotionSnapshot& Now, const FMotionPicture& Picture,
	    const std::vector<glm::vec4>& Motion);
};

} // namespace Lantern
