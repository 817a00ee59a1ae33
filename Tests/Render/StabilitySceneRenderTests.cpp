// The scenes of `lantern stability` for methods to come, as the reference sees them.
#include <algorithm>
#include <cmath>

#include "Support/RenderFixture.h"

namespace Lantern
{
namespace
{

using FStabilitySceneTest = FRenderTest;

bool IsFinite(const FImage& Image)
{
	const std::vector<float>& Values = Image.Pixels;
	return std::all_of(Values.begin(), Values.end(), [](float V) { return std::isfinite(V); });
}

TEST_F(FStabilitySceneTest, EachIsSeen)
{
	for (const char* Name :
	    {"edge", "switch", "flicker", "boiling", "mirror", "railing", "hugemesh", "hash", "lightgrid", "caustics", "toon", "fog"})
	{
		ASSERT_TRUE(Load(std::string("stability-") + Name));
		const FImage Image = TraceReference(MakeView(48, 27), 8, 3);
		EXPECT_TRUE(IsFinite(Image)) << Name;
		EXPECT_GT(MeanGreen(Image), 1e-4) << Name;
	}
}

/// Light that only five bounces bring: none of four, some of five.
TEST_F(FStabilitySceneTest, TempleIsFiveBouncesAway)
{
	ASSERT_TRUE(Load("stability-temple"));
	const FView View = MakeView(48, 27);
	EXPECT_EQ(MeanGreen(TraceReference(View, 512, 4)), 0.0);
	const double Mean = MeanGreen(TraceReference(View, 512, 12));
	// Of a wall of albedo 0.85 that faces the sun.
	const double Sunlit = 8.0 * 0.85 / 3.14159;
	EXPECT_GT(Mean, 1e-7 * Sunlit);
	EXPECT_LT(Mean, 1e-3 * Sunlit) << "as bright as what counts as a leak";
	PrintFigure(fmt::format("temple: {:.2g} of the sunlit wall", Mean / Sunlit));
}

TEST_F(FStabilitySceneTest, LampsAreOffWhenTheyAreOff)
{
	ASSERT_TRUE(Load("stability-switch"));
	const FView View = MakeView(48, 27);
	const double On = MeanGreen(TraceReference(View, 16, 3, 1.0));
	EXPECT_GT(On, 0.1);
	EXPECT_EQ(MeanGreen(TraceReference(View, 16, 3, 3.0)), 0.0);
	EXPECT_NEAR(MeanGreen(TraceReference(View, 16, 3, 5.0)), On, 0.2 * On) << "on again";
	// Real-time passes see the same.
	EXPECT_GT(MeanGreen(RenderLighting(View, 1.0)), 0.05);
	EXPECT_EQ(MeanGreen(RenderLighting(View, 3.0)), 0.0);
}

TEST_F(FStabilitySceneTest, NothingLightsTheChamberBehindTheFog)
{
	ASSERT_TRUE(Load("stability-fog"));
	EXPECT_EQ(MeanGreen(TraceReference(LookAt({2.9, 1.6, -5}, {2.9, 1.6, 5}, 1.2f, 48, 27), 64)), 0.0);
}

/// Light that a small sun and a mirror bring to a wall is found by few paths: 15 % is what so many of them tell.
TEST_F(FStabilitySceneTest, CausticsAreAsBrightAtEveryMoment)
{
	ASSERT_TRUE(Load("stability-caustics"));
	const FView View = LookAt({0, 1.4, 0.6}, {0, 1.6, -1.2}, 0.7f, 32, 18);
	const double First = MeanGreen(TraceReference(View, 2048, 2, 0.0)), Later = MeanGreen(TraceReference(View, 2048, 2, 0.5));
	const double Without = MeanGreen(TraceReference(View, 16, 1, 0.0));
	EXPECT_NEAR(Later, First, 0.15 * First) << "energy is spread anew, not made";
	EXPECT_GT(First, 20 * Without) << "the wall has no other light to speak of";
	PrintFigure(fmt::format("caustics: {:.3g}, half a second on {:.3g}, direct light {:.3g}", First, Later, Without));
}

} // namespace
} // namespace Lantern
