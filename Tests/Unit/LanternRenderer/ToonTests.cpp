// On the mock: what objects of a stylised look add to a frame, and that they add nothing where there are none.
#include "Support/RendererTestTools.h"

namespace Lantern
{
namespace
{

class FToonMockTest : public FRendererTest
{
protected:
	void LoadWithGI()
	{
		Set("r.RT.GI", "3");
		LoadAndRender({.bSky = true});
	}
	void SetStyle(float Occlusion)
	{
		FToonStyle Style;
		Style.Occlusion = Occlusion;
		FHostScene& Host = Engine->GetScene();
		Host.GetScene().SetToon(Host.GetDraws()[0].Object, std::make_shared<const FToonStyle>(Style));
		Render();
	}
	bool Has(const std::vector<std::string>& Names, const char* Part)
	{
		return std::any_of(Names.begin(), Names.end(), [&](const std::string& Name) { return Name.find(Part) != std::string::npos; });
	}
};

TEST_F(FToonMockTest, ScenesWithoutStylesHaveNoneOfIt)
{
	LoadWithGI();
	EXPECT_FALSE(HasPass("ToonSurface"));
	EXPECT_FALSE(HasPass("ToonGrade"));
	EXPECT_FALSE(Has(Mock().GetCreatedPipelines(), "Toon"));
	EXPECT_FALSE(Has(Mock().GetCreatedPipelines(), "HAS_TOON"));
	EXPECT_FALSE(Has(Mock().GetCreatedBuffers(), "Toon"));
	EXPECT_FALSE(Has(Mock().GetCreatedTextures(), "Toon"));
}

TEST_F(FToonMockTest, OneStyleBringsTwoPasses)
{
	LoadWithGI();
	SetStyle(0.0f);
	EXPECT_TRUE(HasPass("ToonSurface"));
	EXPECT_TRUE(HasPass("ToonGrade"));
	EXPECT_FALSE(HasPass("AmbientOcclusion")) << "no style asks for it, and global illumination stands in";
	SetStyle(0.5f);
	EXPECT_TRUE(HasPass("AmbientOcclusion"));
	Set("r.RT.GI.Toon", "0");
	Render();
	EXPECT_FALSE(HasPass("ToonSurface"));
	EXPECT_FALSE(HasPass("ToonGrade"));
	EXPECT_FALSE(HasPass("AmbientOcclusion"));
}

// Without global illumination the sky's ambient light takes its place.
TEST_F(FToonMockTest, AmbientLightNeedsTheSurfaceAlone)
{
	LoadWithGI();
	Set("r.RT.GI", "0");
	SetStyle(0.0f);
	EXPECT_TRUE(HasPass("ToonSurface"));
	EXPECT_FALSE(HasPass("ToonGrade"));
}

} // namespace
} // namespace Lantern
