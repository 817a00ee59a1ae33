// Named views: which file lists a scene, what a view holds, and how broken files are named.
#include "LanternHost/SceneViews.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "Support/GltfTestTools.h"

namespace Lantern
{
namespace
{

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

struct SceneViews : public ::testing::Test
{
	std::string At(const std::string& Name) const { return (Folder.Get() / Name).string(); }
	FSceneViews Load(const std::string& Text)
	{
		Folder.Write("views.json", Text);
		return LoadSceneViews(At("a.gltf"));
	}
	FTemporaryFolder Folder;
};

TEST_F(SceneViews, HoldCameraSunSkyAndWhetherTheFilesLightsAreOn)
{
	const FSceneViews Views = Load(R"({"_": "a comment", "a.gltf": [
		{"name": "main", "camera": [1, 2, 3, 4, 5, 6, 60], "sun": [12, 0.25, -1, 0.35, 0.53], "sky": [0.5, 0.7, 1], "sceneLights": false},
		{"name": "bare", "_why": "a comment"}]})");
	ASSERT_EQ(Views.Error, "");
	EXPECT_THAT(Views.Warnings, IsEmpty());
	EXPECT_EQ(Views.File, At("views.json"));
	EXPECT_EQ(Views.ListNames(), "main, bare");
	const FSceneView* const Main = Views.Find("main");
	ASSERT_TRUE(Main && Main->Camera && Main->Sun && Main->Sky);
	EXPECT_EQ(Main->Camera->Position, glm::dvec3(1, 2, 3));
	EXPECT_EQ(Main->Camera->Target, glm::dvec3(4, 5, 6));
	EXPECT_EQ(Main->Camera->FovY, 60.0);
	EXPECT_EQ(Main->Sun->Irradiance, 12.0);
	EXPECT_EQ(Main->Sun->Direction, glm::dvec3(0.25, -1, 0.35));
	EXPECT_EQ(Main->Sun->Diameter, 0.53);
	EXPECT_EQ(*Main->Sky, glm::dvec3(0.5, 0.7, 1));
	EXPECT_FALSE(Main->bSceneLights);
	const FSceneView* const Bare = Views.Find("bare");
	ASSERT_TRUE(Bare);
	EXPECT_FALSE(Bare->Camera || Bare->Sun || Bare->Sky);
	EXPECT_TRUE(Bare->bSceneLights);
	EXPECT_EQ(Views.Find("night"), nullptr);
}

TEST_F(SceneViews, ComeFromTheScenesFolderOrTheOneAbove)
{
	std::filesystem::create_directories(At("x/y/z"));
	Folder.Write("views.json", R"({"x/a.gltf": [{"name": "above"}], "x/y/a.gltf": [{"name": "two above"}]})");
	EXPECT_EQ(LoadSceneViews(At("x/a.gltf")).ListNames(), "above");
	EXPECT_EQ(LoadSceneViews(At("x/y/../a.gltf")).ListNames(), "above") << "the path may be written in any way";
	EXPECT_EQ(LoadSceneViews(At("x/y/a.gltf")).ListNames(), "");
	EXPECT_EQ(LoadSceneViews(At("x/y/a.gltf")).File, "");
	Folder.Write("x/views.json", R"({"a.gltf": [{"name": "beside"}]})");
	EXPECT_EQ(LoadSceneViews(At("x/a.gltf")).ListNames(), "beside") << "the nearer file counts";
	EXPECT_EQ(LoadSceneViews(At("x/b.gltf")).File, "") << "listed by neither";
	EXPECT_EQ(LoadSceneViews(At("nowhere/a.gltf")).Error, "");
}

TEST_F(SceneViews, BrokenFilesAreNamedWithThePlace)
{
	const std::pair<const char*, const char*> Cases[] = {
	    {"{", "line 1"},
	    {"[]", "expected an object"},
	    {R"({"a.gltf": {}})", "a.gltf: expected an array"},
	    {R"({"a.gltf": [1]})", "a.gltf[0]: expected an object"},
	    {R"({"a.gltf": [{"name": "x"}, {}]})", "a.gltf[1]: a view needs a name"},
	    {R"({"a.gltf": [{"name": 3}]})", "a.gltf[0].name: expected a string"},
	    {R"({"a.gltf": [{"name": "x"}, {"name": "x"}]})", "a.gltf[1]: there is another view"},
	    {R"({"a.gltf": [{"name": "x", "camera": [1, 2, 3]}]})", "a.gltf[0].camera"},
	    {R"({"a.gltf": [{"name": "x", "camera": [1, 2, 3, 1, 2, 3, 60]}]})", "a.gltf[0].camera: position and target"},
	    {R"({"a.gltf": [{"name": "x", "camera": [1, 2, 3, 1, 2, 4, 180]}]})", "a.gltf[0].camera: the field of view"},
	    {R"({"a.gltf": [{"name": "x", "camera": [1e16, 2, 3, 1, 2, 4, 60]}]})", "a.gltf[0].camera: holds a number beyond"},
	    {R"({"a.gltf": [{"name": "x", "sun": [-1, 0, -1, 0, 1]}]})", "a.gltf[0].sun: the irradiance"},
	    {R"({"a.gltf": [{"name": "x", "sun": [1, 0, 0, 0, 1]}]})", "a.gltf[0].sun: the direction"},
	    {R"({"a.gltf": [{"name": "x", "sun": [1, 0, -1, 0, 181]}]})", "a.gltf[0].sun: the diameter"},
	    {R"({"a.gltf": [{"name": "x", "sky": [0, -1, 0]}]})", "a.gltf[0].sky: radiance"},
	    {R"({"a.gltf": [{"name": "x", "sky": "blue"}]})", "a.gltf[0].sky"},
	    {R"({"a.gltf": [{"name": "x", "sceneLights": 1}]})", "a.gltf[0].sceneLights"},
	};
	for (const auto& [Text, Place] : Cases)
	{
		const FSceneViews Views = Load(Text);
		EXPECT_THAT(Views.Error, HasSubstr("views.json: ")) << Text;
		EXPECT_THAT(Views.Error, HasSubstr(Place)) << Text;
		EXPECT_THAT(Views.Views, IsEmpty()) << Text;
	}
}

TEST_F(SceneViews, UnknownMembersAreWarnedOf)
{
	const FSceneViews Views = Load(R"({"a.gltf": [{"name": "main", "camra": [1]}]})");
	EXPECT_EQ(Views.Error, "");
	EXPECT_EQ(Views.ListNames(), "main");
	EXPECT_THAT(Views.Warnings, ElementsAre(HasSubstr("views.json: a.gltf[0]: 'camra'")));
}

} // namespace
} // namespace Lantern
