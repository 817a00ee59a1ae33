// Views that are jittered and off-centre, held against the same view without.
#include <cmath>

#include "MotionFixture.h"

namespace Lantern
{
namespace
{

class FViewTest : public FMotionTestBase
{
protected:
	[[nodiscard]] bool LoadCourtyard()
	{
		if (!Load("courtyard")) { return false; }
		SetSun(0.0);
		return true;
	}
	/// Share of pixels whose sun shadow differs from that of Whole, whose point (X + ShiftX, Y + ShiftY) they show.
	static double CountDifferences(const FImage& Part, const FImage& Whole, int ShiftX, int ShiftY)
	{
		size_t Different = 0, Count = 0;
		for (int Y = 0; Y < int(Part.Height); ++Y)
		{
			for (int X = 0; X < int(Part.Width); ++X)
			{
				const int WholeX = X + ShiftX, WholeY = Y + ShiftY;
				if (WholeX < 0 || WholeY < 0 || WholeX >= int(Whole.Width) || WholeY >= int(Whole.Height)) { continue; }
				Different += Part.At(X, Y, 0) != Whole.At(WholeX, WholeY, 0) ? 1 : 0;
				++Count;
			}
		}
		EXPECT_GT(Count, Part.GetPixelCount() / 2);
		return double(Different) / double(Count);
	}
};

// Rounding decides in pixels at a shadow's edge, and at the raster's edges.
constexpr double LimitOfRounding = 0.002;

TEST_F(FViewTest, JitterOfWholePixelsMovesThePicture)
{
	ASSERT_TRUE(LoadCourtyard());
	FView View = MakeView(Width, Height);
	const FImage Still = RenderSunShadow(View);
	View.Jitter = {3.0f, -2.0f};
	const double Different = CountDifferences(RenderSunShadow(View), Still, -3, 2);
	PrintFigure(fmt::format("pixels that jitter changes: {:.4f} %", 100 * Different));
	EXPECT_LE(Different, LimitOfRounding);
	View.Jitter = {};
	EXPECT_GT(CountDifferences(RenderSunShadow(View), Still, -3, 2), 10 * LimitOfRounding) << "the test could not fail";
}

TEST_F(FViewTest, TilesOfAPictureAreTheWhole)
{
	ASSERT_TRUE(LoadCourtyard());
	FView View = MakeView(Width, Height);
	const FImage Whole = RenderSunShadow(View);
	const FViewWindow Window = View.GetWindow();
	FView Tile = View; // the right and lower quarter
	Tile.Width /= 2;
	Tile.Height /= 2;
	Tile.Window = FViewWindow{0.5 * (Window.Left + Window.Right), Window.Right, Window.Bottom, 0.5 * (Window.Bottom + Window.Top)};
	EXPECT_LE(CountDifferences(RenderSunShadow(Tile), Whole, Width / 2, Height / 2), LimitOfRounding);
}

// A camera that stands still has no motion, however its frames are jittered: accumulation stays with its pixels.
TEST_F(FViewTest, JitterIsNoMotion)
{
	ASSERT_TRUE(LoadCourtyard());
	FView View = MakeView(Width, Height);
	for (const glm::vec2 Jitter : {glm::vec2(0.0f), glm::vec2(0.45f, -0.3f), glm::vec2(-0.2f, 0.41f)})
	{
		View.Jitter = Jitter;
		const FMotionPicture Picture = Render(View);
		float Most = 0.0f;
		for (size_t I = 0; I < Picture.Depth.size(); ++I)
		{
			if (Picture.Depth[I] <= 0.0f) { continue; }
			for (const glm::vec4& Motion : {Picture.OfHost[I], Picture.OfCamera[I]})
			{
				Most = std::max({Most, std::abs(Motion.x), std::abs(Motion.y)});
			}
		}
		EXPECT_EQ(Most, 0.0f);
	}
}

} // namespace
} // namespace Lantern
