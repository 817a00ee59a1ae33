// Fewer sun rays, on the mock: what a frame makes for it, what it is told of casters that moved, and nothing where it is not wanted.
#include <cstring>

#include "SettledTypes.h"
#include "Support/MockReads.h"
#include "Support/RendererTestTools.h"

namespace Lantern
{
namespace
{

using ::testing::Contains;
using ::testing::IsSupersetOf;
using ::testing::Not;

class FSettledTilesTest : public FRendererTest
{
protected:
	static constexpr const char* RestPasses[] = {"ShadowRestCheck", "ShadowRestQueue", "ShadowRestRays"};

	bool HasRestPasses()
	{
		EXPECT_EQ(HasPass(RestPasses[0]), HasPass(RestPasses[1]));
		return HasPass(RestPasses[0]);
	}
	/// What the tiles of the last frame were told; zeroes: nothing.
	FSettledConstants GetTold()
	{
		FSettledConstants Told{};
		for (const FRTMockCall& Call : Mock().FindCalls(ERTMockCall::Dispatch))
		{
			if (Call.Name.rfind("Tiles/Tiles.comp", 0) != 0) { continue; }
			FTilesConstants Push{};
			std::memcpy(&Push, Call.Bytes.data(), std::min(sizeof(Push), Call.Bytes.size()));
			if (Push.Settled != 0) { Told = ReadMockEntry<FSettledConstants>(Mock(), Push.Settled, 0); }
		}
		return Told;
	}
	FRTScene& GetScene() { return Engine->GetScene().GetScene(); }
	FRTObjectId GetObject() { return Engine->GetScene().GetDraws()[0].Object; }
	void MoveTo(double X)
	{
		glm::dmat4 Transform(1.0);
		Transform[3].x = X;
		GetScene().SetTransform(GetObject(), Transform);
	}
};

TEST_F(FSettledTilesTest, NothingIsMadeForItUnlessWanted)
{
	LoadAndRender({});
	EXPECT_FALSE(HasRestPasses()) << "off by default";
	EXPECT_THAT(Mock().GetCreatedPipelines(), Not(Contains("Tiles/CheckSettled.comp")));
	EXPECT_THAT(Mock().GetCreatedTextures(), Not(Contains("SunSettled")));
	Set("r.RT.Shadow.Adaptive", "1");
	Set("r.RT.Shadow.Denoise", "0");
	Render();
	EXPECT_FALSE(HasRestPasses()) << "without a filter nothing is known";
	EXPECT_EQ(GetTold().CasterCount, 0u);
	Set("r.RT.Shadow.Denoise", "1");
	Set("r.RT.Shadow", "0");
	Render();
	EXPECT_FALSE(HasRestPasses());
	for (const std::string& Name : Mock().GetCreatedTextures()) { EXPECT_EQ(Name.find("SunSettled"), std::string::npos) << Name; }
}

TEST_F(FSettledTilesTest, TilesAskTwice)
{
	Set("r.RT.Shadow.Adaptive", "1");
	Set("r.RT.Shadow.MoreRays", "0");
	for (const char* const Path : {"1", "2"})
	{
		Set("r.RT.Shadow.Path", Path);
		LoadAndRender({});
		const ERTMockCall Trace = Path[0] == '1' ? ERTMockCall::TraceRaysIndirect : ERTMockCall::DispatchIndirect;
		EXPECT_EQ(Mock().CountCalls(Trace), 2u) << Path;
		EXPECT_TRUE(HasRestPasses());
		EXPECT_FALSE(HasPass("ShadowRestShare")) << "there is room for all";
	}
	Set("r.RT.Rays.QueuePerPixel", "0.125");
	Render();
	EXPECT_THAT(GetPasses(), IsSupersetOf({"ShadowShare", "ShadowDemand", "ShadowRestShare"}));
	EXPECT_FALSE(HasPass("ShadowRestDemand")) << "what had no room asks the first queue in the next frame";
}

TEST_F(FSettledTilesTest, IsToldWhatMoved)
{
	Set("r.RT.Shadow.Adaptive", "1");
	LoadAndRender({});
	EXPECT_EQ(GetTold().Previous, NO_TEXTURE) << "there is no frame before";
	Render();
	EXPECT_NE(GetTold().Previous, NO_TEXTURE);
	EXPECT_EQ(GetTold().CasterCount, 0u);
	EXPECT_EQ(GetTold().Casters, 0u) << "nothing is allocated";
	MoveTo(3.0);
	Render();
	FSettledConstants Told = GetTold();
	ASSERT_EQ(Told.CasterCount, 1u);
	EXPECT_EQ(Told.bAnywhere, 0u);
	const auto Caster = ReadMockEntry<FMovedCaster>(Mock(), Told.Casters, 0);
	EXPECT_NEAR(Caster.To.x - Caster.From.x, 3.0f, 1e-5f);
	EXPECT_NEAR(Caster.Radius, std::sqrt(2.0f), 1e-3f);
	Render();
	EXPECT_EQ(GetTold().CasterCount, 0u) << "told once";
	for (int I = 0; I < 300; ++I) { MoveTo(double(I)); }
	Render();
	Told = GetTold();
	EXPECT_EQ(Told.bAnywhere, 1u) << "more than are kept";
	EXPECT_EQ(Told.CasterCount, 0u);
	Set("r.RT.Debug.Shadow.Capsules", "0");
	MoveTo(0.0);
	Render();
	EXPECT_EQ(GetTold().CasterCount, 0u) << "the planted fault";
}

TEST_F(FSettledTilesTest, AnotherSunStartsAnew)
{
	Set("r.RT.Shadow.Adaptive", "1");
	LoadAndRender({});
	Render();
	FSunLight Sun = GetScene().GetSun();
	const auto RenderWithTurn = [&](double Radians) {
		Sun.Direction = {std::sin(Radians), -std::cos(Radians), 0};
		Engine->GetScene().SetSun(Sun);
		Render();
		return GetTold().Previous != NO_TEXTURE;
	};
	EXPECT_FALSE(RenderWithTurn(0.01)) << "a diameter's way";
	EXPECT_TRUE(RenderWithTurn(0.01));
	EXPECT_TRUE(RenderWithTurn(0.0101)) << "less than 1/64 of the diameter";
	Sun.AngularDiameter *= 2.0f;
	EXPECT_FALSE(RenderWithTurn(0.0101));
	EXPECT_TRUE(RenderWithTurn(0.0101));
	Set("r.RT.Shadow.MaxDistance", "50");
	EXPECT_FALSE(RenderWithTurn(0.0101)) << "other rays";
	Set("r.RT.Shadow.SourceScale", "0.5");
	EXPECT_FALSE(RenderWithTurn(0.0101)) << "of another disk";
}

TEST_F(FSettledTilesTest, FarTilesTraceFewerWithoutAHistory)
{
	Set("r.RT.Shadow.RateDistance", "10");
	Set("r.RT.Shadow.Denoise", "0");
	LoadAndRender({});
	EXPECT_FALSE(HasRestPasses());
	EXPECT_FALSE(HasPass("Surface"));
	EXPECT_EQ(GetTold().RateDistance, 10.0f);
	EXPECT_EQ(GetTold().Current, NO_TEXTURE);
	const uint32_t Turn = GetTold().Turn;
	Render();
	EXPECT_EQ(GetTold().Turn, Turn + 1);
}

TEST_F(FSettledTilesTest, CountsRaysOnDemand)
{
	LoadAndRender({});
	EXPECT_FALSE(HasPass("ShadowCount"));
	Set("r.RT.Rays.Count", "1");
	Set("r.RT.Shadow.Adaptive", "1");
	Render();
	EXPECT_THAT(GetPasses(), IsSupersetOf({"ShadowCount", "ShadowRestCount"}));
	Render();
	Render();
	ASSERT_TRUE(Engine->GetRenderer().WaitForAll());
	EXPECT_EQ(Engine->GetRenderer().GetRayCounts().Frames, 3u);
}

TEST_F(FSettledTilesTest, DrawsItsPictures)
{
	LoadAndRender({});
	EXPECT_FALSE(HasPass("TileView"));
	for (const char* const Name : {"sun_tiles", "sun_rays"})
	{
		Set("r.RT.Debug.View", Name);
		Render();
		EXPECT_TRUE(HasPass("TileView")) << Name;
		EXPECT_FALSE(HasPass("DebugView")) << Name;
	}
	Set("r.RT.Shadow", "0");
	Render();
	EXPECT_FALSE(HasPass("TileView"));
	EXPECT_FALSE(HasPass("DebugView"));
}

} // namespace
} // namespace Lantern
