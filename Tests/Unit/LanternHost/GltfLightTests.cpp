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

TEST(GltfNodes, ExtrasSayWhatANodeShadows)
{
	FGltfMaker Maker;
	Maker.AddTriangle();
	Maker.Json["nodes"][0]["extras"]["lantern"] = {{"character", true}, {"castsLocalShadow", false}};
	Maker.Json["nodes"].push_back({{"name", "plain"}});
	const FLoadResult Result = Maker.Load();
	ASSERT_TRUE(Result.Scene) << Result.Error;
	EXPECT_EQ(Result.Scene->Nodes[0].Traits, (FRTObjectTraits{.bCastsLocalShadow = false, .bCharacter = true}));
	EXPECT_EQ(Result.Scene->Nodes[1].Traits, FRTObjectTraits());
}

} // namespace
} // namespace Lantern
