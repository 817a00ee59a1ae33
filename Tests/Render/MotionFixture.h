// Frames whose motion vectors are read back, and held against double precision.
#pragma once

#include <vector>

#include "MotionOracle.h"
#include "RenderFixture.h"

namespace Lantern
{

struct FMotionPicture
{
	std::vector<glm::vec4> OfHost, OfCamera; // FGBuffer::Motion, AddCameraMotionPass
};

class FMotionTestBase : public FRenderTest
{
protected:
	static constexpr uint32_t Width = 160, Height = 90;

	static FView MakeCamera(const glm::dvec3& Position, const glm::dvec3& Target)
	{
		return LookAt(Position, Target, 1.0f, Width, Height);
	}
	/// Adds a pass that reads Texture back, of four floats.
	static void Read(FFrameContext& Context, FGraphTexture Texture, TRTRef<IRTBuffer>& Out);
	static std::vector<glm::vec4> Take(IRTBuffer* Buffer, const FView& View);
	/// One frame, and its motion. bOwnRaster: with a raster that makes none, whose depth the camera's motion is from.
	static FMotionPicture Render(const FView& View, double Time = 0.0, bool bOwnRaster = false);

	/// To 1/100 of a pixel. Before: Now itself where nothing is carried over.
	static void ExpectExact(const char* What, const FMotionSnapshot& Before, const FMotionSnapshot& Now,
	                        const std::vector<glm::vec4>& Motion)
	{
		ExpectExact(What, Before, Now, Motion, Motion);
	}
	/// Objects: whose w says which object is seen.
	static void ExpectExact(const char* What, const FMotionSnapshot& Before, const FMotionSnapshot& Now,
	                        const std::vector<glm::vec4>& Motion, const std::vector<glm::vec4>& Objects);
};

} // namespace Lantern
