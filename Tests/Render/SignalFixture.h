// Signals of frames and of the reference, and how the two are held against each other.
#pragma once

#include "LanternImage/ImageStatistics.h"
#include "Support/RenderFixture.h"
#include "Support/TestScene.h"

namespace Lantern
{

class FSignalTest : public FRenderTest
{
public:
	static constexpr uint32_t ShallowDivisor = 4;

protected:
	/// Whether a frame has it.
	bool HasSignal(ESignal Signal, const FView& View);
	/// Through pixel centres.
	FImage TraceSignal(ESignal Signal, FView View, uint32_t Samples, uint32_t Bounces = UnlimitedBounces, uint32_t Seed = 1);
	/// Mean of the green channel, from Batches pictures of Samples with seeds of their own.
	FEstimate EstimateSignal(
	    ESignal Signal, const FView& View, uint32_t Samples, uint32_t Bounces = UnlimitedBounces, uint32_t Batches = 8);
	/// Mean of the green channel, from Batches means of Count frames with seeds of their own.
	FEstimate EstimateFrames(ESignal Signal, const FView& View, uint32_t Count, uint32_t Batches = 8);
	/// Holds frames against the reference of the same signal: their means agree within Tolerance and three times what
	/// repetitions scatter, and so do means of blocks, at the median. All of it relative to the reference. Unless LANTERN_TEST_DEEP is set,
	/// a ShallowDivisor-th of Frames and Samples is rendered: noise is then twice as high, and faults must be larger to show.
	void ExpectUnbiased(
	    const char* What, ESignal Signal, const FView& View, uint32_t Frames, uint32_t Samples, uint32_t Bounces, double Tolerance);
	/// Everything that paths can make, at this many samples and bounces.
	static void SetIndirect(int32_t Samples, int32_t Bounces);
};

} // namespace Lantern
