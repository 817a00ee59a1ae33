// What glTF files say of lights and shadows beyond the extensions: extras.lantern.
#include "Support/GltfTestTools.h"

namespace Lantern
{
namespace
{

TEST(GltfLights, ExtrasGiveLightsAShape)
{
	const auto LoadLight = [](const std::string& Type, const nlohmann::json& Shape) {
		FGltfMaker Maker;
		Maker.AddTriangle();
		nlohmann::json Light = {{"type", Type}, {"intensity", 12}};
		Light["extras"]["lantern"] = Shape;
		Maker.Json["extensions"]["KHR_lights_punctual"]["lights"].push_back(Light);
		return Maker.Load();
	};
	const auto Read = [&](const std::string& Type, const nlohmann::json& Shape) {
		const FLoadResult Result = LoadLight(Type, Shape);
		EXPECT_TRUE(Result.Scene) << Result.Error;
		return Result.Scene ? Result.Scene->Lights.at(0) : FHostLight();
	};
	FHostLight Light = Read("point", {{"shape", "rectangle"}, {"width", 2}, {"height", 3}, {"twoSided", true}, {"castsShadow", false}});
	EXPECT_EQ(Light.Type, LIGHT_RECTANGLE);
	EXPECT_EQ(Light.Size, glm::vec2(2, 3));
	EXPECT_EQ(Light.Color, glm::vec3(2)) << "candela on the axis, by area";
	EXPECT_EQ(Light.OuterCone, 0.0f);
	EXPECT_TRUE(Light.bTwoSided);
	EXPECT_FALSE(Light.bCastsShadow);
	Light = Read("spot", {{"shape", "sphere"}, {"radius", 0.5}});
	EXPECT_EQ(Light.Type, LIGHT_SPHERE);
	EXPECT_GT(Light.OuterCone, 0.0f);
	EXPECT_NEAR(Light.Color.x, 12 / (3.14159265 * 0.25), 1e-4);
	Light = Read("point", {{"shape", "tube"}, {"radius", 0.1}, {"length", 2}});
	EXPECT_NEAR(Light.Color.x, 12 / (0.4 + 3.14159265 * 0.01), 1e-4);
	EXPECT_EQ(Read("directional", {{"angularDiameter", 0.01}}).Size.x, 0.01f);
	EXPECT_NE(LoadLight("point", {{"shape", "blob"}}).Error.find("no shape of a light"), std::string::npos);
	EXPECT_NE(LoadLight("point", {{"shape", "disk"}}).Error.find("radius"), std::string::npos);
	EXPECT_NE(LoadLight("point", {{"shape", "disk"}, {"radius", -1}}).Error.find("radius"), std::string::npos);
}

TEST(GltfLights, ExtrasGiveLightsAProfileAndChannels)
{
	const FTemporaryFolder Folder;
	Folder.Write("lamp.ies", "TILT=NONE\n1 1000 1 3 1 1 2 0 0 0\n1 1 10\n0 45 90\n0\n100 50 0\n");
	Folder.Write("bad.ies", "TILT=NONE\n1 1000 1 3 1 2 2 0 0 0\n1 1 10\n0 45 90\n0\n100 50 0\n");
	const auto LoadLights = [&](const std::vector<std::pair<std::string, nlohmann::json>>& Lights) {
		FGltfMaker Maker;
		Maker.AddTriangle();
		for (const auto& [Type, Given] : Lights)
		{
			nlohmann::json Light = {{"type", Type}, {"intensity", 2}};
			Light["extras"]["lantern"] = Given;
			Maker.Json["extensions"]["KHR_lights_punctual"]["lights"].push_back(Light);
		}
		return LoadScene(Folder.Write("scene.gltf", Maker.GetText()));
	};
	const FLoadResult Result = LoadLights({{"spot", {{"ies", "lamp.ies"}, {"channels", 6}}},
	    {"point", {{"ies", "lamp.ies"}, {"iesIntensity", true}}}, {"point", {{"channels", 0}}}});
	ASSERT_TRUE(Result.Scene) << Result.Error;
	const std::vector<FHostLight>& Lights = Result.Scene->Lights;
	ASSERT_EQ(Result.Scene->Profiles.size(), 1u) << "one file, one profile";
	EXPECT_EQ(Result.Scene->Profiles[0].Peak, 100.0f);
	EXPECT_EQ(Lights[0].Profile, 1u);
	EXPECT_EQ(Lights[0].Color, glm::vec3(2)) << "candela at the peak";
	EXPECT_EQ(Lights[0].Channels, 6);
	EXPECT_EQ(Lights[1].Profile, 1u);
	EXPECT_EQ(Lights[1].Color, glm::vec3(200)) << "times those of the file";
	EXPECT_EQ(Lights[1].Channels, CHANNELS_DEFAULT);
	EXPECT_EQ(Lights[2].Profile, 0u);
	EXPECT_EQ(Lights[2].Channels, 0);
	const std::pair<nlohmann::json, const char*> Bad[] = {{{{"ies", "bad.ies"}}, "bad.ies:2: photometry of type B"},
	    {{{"ies", "none.ies"}}, "none.ies"}, {{{"ies", "../lamp.ies"}}, "lights[0]"}, {{{"ies", 3}}, "expected a string"},
	    {{{"ies", "lamp.ies"}, {"shape", "disk"}, {"radius", 1}}, "only point lights and spots"}, {{{"channels", 256}}, "channels"}};
	for (const auto& [Given, Says] : Bad)
	{
		const std::string Error = LoadLights({{"point", Given}}).Error;
		EXPECT_NE(Error.find(Says), std::string::npos) << Error;
	}
}

TEST(GltfNodes, ExtrasSayWhatANodeShadows)
{
	FGltfMaker Maker;
	Maker.AddTriangle();
	Maker.Json["nodes"][0]["extras"]["lantern"] = {{"character", true}, {"castsLocalShadow", false}, {"channels", 5}};
	Maker.Json["nodes"].push_back({{"name", "plain"}});
	const FLoadResult Result = Maker.Load();
	ASSERT_TRUE(Result.Scene) << Result.Error;
	EXPECT_EQ(Result.Scene->Nodes[0].Traits, (FRTObjectTraits{.bCastsLocalShadow = false, .bCharacter = true, .Channels = 5}));
	EXPECT_EQ(Result.Scene->Nodes[1].Traits, FRTObjectTraits());
}

TEST(GltfNodes, ExtrasGiveANodeAStyle)
{
	FGltfMaker Maker;
	Maker.AddTriangle();
	const auto Give = [&](const nlohmann::json& Toon) {
		Maker.Json["nodes"][0]["extras"]["lantern"] = {{"toon", Toon}};
		return Maker.Load();
	};
	const FLoadResult Result = Give({{"center", {0, 1.5, 0.25}}, {"sphereWeight", 1}, {"bend", 0.25}, {"maxSaturation", 0.75},
	    {"maxValue", 2}, {"occlusion", 0.5}, {"tint", {1, 0.5, 0.25}}});
	ASSERT_TRUE(Result.Scene) << Result.Error;
	const FToonStyle Expected{.Center = {0, 1.5f, 0.25f},
	    .SphereWeight = 1,
	    .Bend = 0.25f,
	    .MaxSaturation = 0.75f,
	    .MaxValue = 2,
	    .Occlusion = 0.5f,
	    .Tint = {1, 0.5f, 0.25f}};
	EXPECT_EQ(Result.Scene->Nodes[0].Toon, Expected);
	EXPECT_EQ(Give(nlohmann::json::object()).Scene->Nodes[0].Toon, FToonStyle());
	const std::pair<nlohmann::json, const char*> Bad[] = {{{{"bend", 1.5}}, "bend is 1.5, expected a number from 0 to 1"},
	    {{{"maxValue", -1}}, "maxValue is -1"}, {{{"tint", {0, 0, 0}}}, "tint is black"}, {{{"center", {1, 2}}}, "center"}};
	for (const auto& [Toon, Says] : Bad)
	{
		const std::string Error = Give(Toon).Error;
		EXPECT_NE(Error.find(Says), std::string::npos) << Error;
		EXPECT_NE(Error.find("nodes[0]"), std::string::npos) << Error;
	}
	Maker.Json["nodes"][0].erase("extras");
	EXPECT_EQ(Maker.Load().Scene->Nodes[0].Toon, std::nullopt);
}

} // namespace
} // namespace Lantern
