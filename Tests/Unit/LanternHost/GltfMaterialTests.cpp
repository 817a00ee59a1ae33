// What the loader makes of a material and its extensions.
#include <cmath>

#include <glm/gtc/constants.hpp>

#include "Support/GltfTestTools.h"

namespace Lantern
{
namespace
{

TEST(GltfMaterials, LightEmissionOfAMaterialIsRead)
{
	FGltfMaker Maker = MakeTextured();
	auto& Material = Maker.Json["materials"][0];
	Material["emissiveFactor"] = {1, 0.5, 0};
	const auto Load = [&] {
		const FLoadResult Result = Maker.Load();
		EXPECT_TRUE(Result.Scene) << Result.Error;
		return Result.Scene ? Result.Scene->Materials[0].LightEmissive : std::nullopt;
	};
	EXPECT_FALSE(Load());
	Material["extras"]["lantern"] = {{"lightEmissiveStrength", 510}};
	EXPECT_EQ(Load(), glm::vec3(510, 255, 0)) << "of the factor that cameras see";
	Material["extras"]["lantern"]["lightEmissiveFactor"] = {0, -1, 0.5};
	EXPECT_EQ(Load(), glm::vec3(0, 0, 255));
	Material["extras"]["lantern"]["lightEmissiveStrength"] = 1e38;
	Material["extras"]["lantern"]["lightEmissiveFactor"] = {1e5, 0, 0};
	EXPECT_FALSE(Maker.Load().Scene) << "no float holds it";
}

TEST(GltfMaterials, MaterialExtensionsAreRead)
{
	FGltfMaker Maker = MakeTextured();
	auto& Material = Maker.Json["materials"][0];
	Material["emissiveFactor"] = {1, 0.5, 0};
	Material["alphaMode"] = "MASK";
	Material["alphaCutoff"] = 0.25;
	Material["doubleSided"] = true;
	Material["extensions"] = {{"KHR_materials_emissive_strength", {{"emissiveStrength", 8}}}, {"KHR_materials_ior", {{"ior", 1.333}}},
	    {"KHR_materials_specular", {{"specularFactor", 0.25}}},
	    {"KHR_materials_transmission", {{"transmissionFactor", 1}, {"transmissionTexture", {{"index", 0}}}}},
	    {"KHR_materials_volume", {{"thicknessFactor", 0.1}, {"attenuationDistance", 0.5}, {"attenuationColor", {1, 0.5, 0}}}}};
	Material["pbrMetallicRoughness"]["baseColorTexture"]["extensions"]["KHR_texture_transform"] = {
	    {"offset", {0.5, 0.25}}, {"rotation", glm::half_pi<double>()}, {"scale", {2, 3}}, {"texCoord", 1}};
	Maker.Json["extensionsUsed"] = {"KHR_texture_transform", "EXT_nonsense"};
	const FLoadResult Result = Maker.Load();
	ASSERT_TRUE(Result.Scene) << Result.Error;
	const FHostMaterial& M = Result.Scene->Materials[0];
	EXPECT_EQ(M.Emissive, glm::vec3(8, 4, 0));
	EXPECT_EQ(M.AlphaMode, EAlphaMode::Mask);
	EXPECT_EQ(M.AlphaCutoff, 0.25f);
	EXPECT_TRUE(M.bDoubleSided);
	EXPECT_EQ(M.Ior, 1.333f);
	EXPECT_EQ(M.Specular, 0.25f);
	EXPECT_EQ(M.Transmission, 1.0f);
	EXPECT_GE(M.Slots[TEXTURE_TRANSMISSION].Texture, 0);
	EXPECT_TRUE(M.bSolid);
	EXPECT_EQ(M.Extinction.x, 0.0f);
	EXPECT_NEAR(M.Extinction.y, 2.0f * std::log(2.0f), 1e-5f);
	EXPECT_GT(M.Extinction.z, 20.0f) << "black is finite";
	const FHostTextureSlot& Slot = M.Slots[TEXTURE_BASE_COLOR];
	EXPECT_EQ(Slot.UVSet, 1u);
	EXPECT_EQ(Slot.Offset, glm::vec2(0.5f, 0.25f));
	// A quarter turn counter-clockwise with v pointing down: u' = 3v, v' = −2u.
	EXPECT_LT(glm::length(Slot.Transform - glm::vec4(0, 3, -2, 0)), 1e-5f);
	EXPECT_TRUE(HasWarning(*Result.Scene, "EXT_nonsense"));
	EXPECT_EQ(Result.Scene->Warnings.size(), 1u);
	EXPECT_FALSE(M.LightEmissive);
}

TEST(GltfMaterials, ScatteringIsRead)
{
	FGltfMaker Maker = MakeTextured();
	auto& Extensions = Maker.Json["materials"][0]["extensions"];
	Extensions = {{"KHR_materials_transmission", {{"transmissionFactor", 1}}}, {"KHR_materials_volume", {{"thicknessFactor", 0.1}}},
	    {"KHR_materials_volume_scatter", {{"multiscatterColor", {0, 0.5, 1}}}}};
	const auto Load = [&] {
		const FLoadResult Result = Maker.Load();
		EXPECT_TRUE(Result.Scene) << Result.Error;
		return Result.Scene ? *Result.Scene : FSceneDescription();
	};
	FHostMaterial M = Load().Materials[0];
	// The mean of light that an endless volume returns is about the colour again (Kulla & Conty 2017): 0.5 takes a share of 0.916 a time.
	EXPECT_EQ(M.ScatterAlbedo.x, 0.0f);
	EXPECT_NEAR(M.ScatterAlbedo.y, 0.916f, 0.005f);
	EXPECT_NEAR(M.ScatterAlbedo.z, 1.0f, 1e-4f);
	EXPECT_EQ(M.ScatterAnisotropy, 0.0f);
	Extensions["KHR_materials_volume_scatter"]["scatterAnisotropy"] = 0.8;
	const FHostMaterial Forward = Load().Materials[0];
	EXPECT_EQ(Forward.ScatterAnisotropy, 0.8f);
	// Similar volumes return as much: (1 - a) / (1 - g a) is that of even scattering.
	EXPECT_NEAR((1.0f - Forward.ScatterAlbedo.y) / (1.0f - 0.8f * Forward.ScatterAlbedo.y), 1.0f - M.ScatterAlbedo.y, 1e-4f);
	Extensions["KHR_materials_volume_scatter"]["scatterAnisotropy"] = 1;
	EXPECT_NE(Maker.Load().Error.find("scatterAnisotropy"), std::string::npos);
	Extensions["KHR_materials_volume_scatter"]["scatterAnisotropy"] = 0;
	Extensions.erase("KHR_materials_transmission");
	const FSceneDescription Opaque = Load();
	EXPECT_EQ(Opaque.Materials[0].ScatterAlbedo, glm::vec3(0));
	EXPECT_TRUE(HasWarning(Opaque, "KHR_materials_volume_scatter"));
}

TEST(GltfMaterials, DiffuseTransmissionIsRead)
{
	FGltfMaker Maker = MakeTextured();
	auto& Extension = Maker.Json["materials"][0]["extensions"]["KHR_materials_diffuse_transmission"];
	const auto Load = [&] {
		const FLoadResult Result = Maker.Load();
		EXPECT_TRUE(Result.Scene) << Result.Error;
		return Result.Scene ? Result.Scene->Materials[0] : FHostMaterial();
	};
	Extension["diffuseTransmissionFactor"] = 0.25;
	FHostMaterial M = Load();
	EXPECT_EQ(M.DiffuseTransmission, 0.25f);
	EXPECT_EQ(M.DiffuseTransmissionColor, glm::vec3(1)) << "the default";
	EXPECT_LT(M.Slots[TEXTURE_DIFFUSE_TRANSMISSION].Texture, 0);
	Extension = {{"diffuseTransmissionFactor", 7}, {"diffuseTransmissionColorFactor", {0.5, -1, 2}},
	    {"diffuseTransmissionTexture", {{"index", 0}}}, {"diffuseTransmissionColorTexture", {{"index", 0}}}};
	M = Load();
	EXPECT_EQ(M.DiffuseTransmission, 1.0f);
	EXPECT_EQ(M.DiffuseTransmissionColor, glm::vec3(0.5f, 0.0f, 1.0f));
	const int32_t Share = M.Slots[TEXTURE_DIFFUSE_TRANSMISSION].Texture, Color = M.Slots[TEXTURE_DIFFUSE_TRANSMISSION_COLOR].Texture;
	ASSERT_GE(Share, 0);
	ASSERT_GE(Color, 0);
	EXPECT_NE(Share, Color) << "one file as data and as a colour";
	Maker.Json["materials"][0]["extensions"].erase("KHR_materials_diffuse_transmission");
	EXPECT_EQ(Load().DiffuseTransmission, 0.0f);
}

} // namespace
} // namespace Lantern
