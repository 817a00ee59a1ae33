// Diffuse GI whose rays end in radiance cells, on small pictures: without a filter, and with a table that suits them.
#pragma once

#include "SignalFixture.h"

namespace Lantern
{

class FCachedGITest : public FSignalTest
{
protected:
	static constexpr uint32_t WarmFrames = 48;

	/// Route: of r.RT.GI.
	void SetRoute(const char* Route)
	{
		SetVariable("r.RT.GI.Denoise", "0");
		SetVariable("r.RT.Reflections", "0");
		SetVariable("r.RT.GI", Route);
		// Pictures here have few pixels, so they need few cells.
		SetVariable("r.RT.GI.Cells.Capacity", "65536");
		SetVariable("r.RT.GI.Cells.SizeAngle", "0.1");
		SetVariable("r.RT.GI.Cells.UpdatesPerSecond", "120000");
	}

	/// Mean of Count frames behind Warm ones of a table that begins empty.
	static FImage RenderSettled(const FView& View, uint32_t Count = 8, uint32_t Warm = WarmFrames)
	{
		RenderSignal(ESignal::DiffuseGI, View, Warm);
		return RenderSignal(ESignal::DiffuseGI, View, Count, Warm);
	}

	/// Two runs from empty tables.
	void ExpectTheSameBitsAgain(const std::string& Scene, const FView& View)
	{
		FImage Pictures[2];
		for (FImage& Picture : Pictures)
		{
			ASSERT_TRUE(Load(Scene));
			Picture = RenderSettled(View, 4);
		}
		EXPECT_EQ(FractionDiffering(Pictures[0], Pictures[1], 0.0), 0.0);
	}
};

} // namespace Lantern
