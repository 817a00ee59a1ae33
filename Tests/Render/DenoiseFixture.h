// Sequences of frames with sun shadows, filtered and not, and what they should be.
#pragma once

#include <functional>

#include "Support/RenderFixture.h"

namespace Lantern
{

/// The camera of a frame.
using FCameraPath = std::function<FView(uint32_t Frame)>;

class FDenoiseTest : public FRenderTest
{
protected:
	struct FSequence
	{
		FCameraPath Camera;
		std::function<double(uint32_t Frame)> Time = [](uint32_t) { return 0.0; };
		uint32_t Frames = 1;
		uint32_t FirstIndex = 0; ///< of the random numbers
		/// Before each frame; may be empty.
		std::function<void(uint32_t Frame)> Change;
	};
	/// Visibility of each frame, the first of which is a cut. As the console variables stand.
	static std::vector<FImage> RenderSequence(const FSequence& Sequence);
	/// What the frame should show: mean of Count frames of 64 unfiltered rays.
	static FImage RenderTruth(const FView& View, uint32_t Count, double Time = 0.0);
	/// One ray a pixel, filtered; or that many, unfiltered.
	static void UseFilter();
	static void UseRays(uint32_t Rays);

	static FView Move(FView View, double Right, double Forward, double TurnDegrees);
};

/// Mean of (a − b)² / (b² + 0.01) over the pixels where the mask is not 0; all of them where it is empty.
double ComputeRelMse(const FImage& A, const FImage& B, const std::vector<uint8_t>& Mask = {});
double ComputeMeanSquare(const FImage& A, const FImage& B, const std::vector<uint8_t>& Mask = {});

} // namespace Lantern
