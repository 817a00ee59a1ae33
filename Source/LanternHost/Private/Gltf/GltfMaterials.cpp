// Reads materials, and decides which images their textures need as colour or as data.
#include <cmath>
#include <map>

#include <fmt/format.h>

#include "Gltf/GltfDocument.h"
#include "LanternCore/Text/Quote.h"

namespace Lantern::Gltf
{

namespace
{

/// Hands out FHostTexture and FHostImage indices. An image that serves as colour and as data exists twice, since its sRGB flag is part of
/// its format. Images that share a file exist once.
class FTextureTable
{
public:
	explicit FTextureTable(FDocument& InDocument)
	    : Document(InDocument),
	      Textures(InDocument.Root.Member("textures")),
	      Images(InDocument.Root.Member("images")),
	      Samplers(InDocument.Root.Member("samplers"))
	{}

	int32_t Get(const FJson& TextureInfo, bool bSrgb)
	{
		const int32_t Index = TextureInfo.RequireIndex("index", Textures.Count(), "texture");
		const auto [Found, bNew] = TextureByUse.try_emplace({Index, bSrgb}, int32_t(Document.Scene.Textures.size()));
		if (bNew)
		{
			const FJson Json = Textures.Element(size_t(Index));
			FHostTexture Texture = ReadSampler(Json);
			Texture.Image = GetImage(Json, TextureInfo, bSrgb);
			Document.Scene.Textures.push_back(Texture);
		}
		return Found->second;
	}

private:
	FHostTexture ReadSampler(const FJson& Texture) const
	{
		constexpr uint64_t ClampToEdge = 33071, MirroredRepeat = 33648, Repeat = 10497, Nearest = 9728;
		FHostTexture Result;
		const int32_t Index = Texture.GetIndex("sampler", Samplers.Count(), "sampler");
		if (Index >= 0)
		{
			const FJson Sampler = Samplers.Element(size_t(Index));
			const uint64_t WrapS = Sampler.GetUInt("wrapS", Repeat);
			const uint64_t WrapT = Sampler.GetUInt("wrapT", Repeat);
			Result.bRepeatU = WrapS != ClampToEdge;
			Result.bRepeatV = WrapT != ClampToEdge;
			Result.bMirrorU = WrapS == MirroredRepeat;
			Result.bMirrorV = WrapT == MirroredRepeat;
			Result.bNearest = Sampler.GetUInt("magFilter", 0) == Nearest;
		}
		return Result;
	}

	int32_t GetImage(const FJson& Texture, const FJson& UsedBy, bool bSrgb)
	{
		const int32_t Source = Texture.GetIndex("source", Images.Count(), "image");
		if (Source < 0) { Texture.Fail("has no 'source' in a format that is read (PNG or JPEG)"); }
		const FJson Image = Images.Element(size_t(Source));
		const FJson UriJson = Image.Member("uri");
		const bool bFile = UriJson.Exists() && !IsDataUri(UriJson.ToString());
		// A data URI would be its own key, too long to keep; equal ones are rare.
		const std::string Key = bFile ? UriJson.ToString() : fmt::format("[{}]", Source);
		const auto [Found, bNew] = ImageByUse.try_emplace({Key, bSrgb}, int32_t(Document.Scene.Images.size()));
		if (bNew)
		{
			FHostImage Result;
			Result.Name = bFile ? Key : Image.GetString("name", "");
			if (Result.Name.empty()) { Result.Name = fmt::format("image {}", Source); }
			Result.bSrgb = bSrgb;
			Document.Scene.Images.push_back(std::move(Result));
			Document.ImageSources.push_back({size_t(Source), UsedBy.GetPath()});
		}
		return Found->second;
	}

	FDocument& Document;
	const FJson Textures, Images, Samplers;
	std::map<std::pair<int32_t, bool>, int32_t> TextureByUse;
	std::map<std::pair<std::string, bool>, int32_t> ImageByUse;
};

/// Rows of rotation · scale; glTF rotates counter-clockwise as seen with v pointing down.
void ReadTransform(FDocument& Document, const FJson& Info, FHostTextureSlot& OutSlot)
{
	const FJson Json = Info.Extension("KHR_texture_transform");
	if (Json.Exists())
	{
		const glm::vec2 Scale = Json.GetVec2("scale", glm::vec2(1));
		const float Rotation = Json.GetFloat("rotation", 0.0f);
		const float Cos = std::cos(Rotation), Sin = std::sin(Rotation);
		OutSlot.Transform = {Cos * Scale.x, Sin * Scale.y, -Sin * Scale.x, Cos * Scale.y};
		OutSlot.Offset = Json.GetVec2("offset", glm::vec2(0));
		OutSlot.UVSet = uint32_t(Json.GetUInt("texCoord", OutSlot.UVSet, UINT32_MAX));
	}
	if (OutSlot.UVSet > 1)
	{
		Document.Warn("texture coordinate sets beyond TEXCOORD_1 are not read: TEXCOORD_0 is used instead");
		OutSlot.UVSet = 0;
	}
}

void ReadSlot(FDocument& Document, FTextureTable& Table, const FJson& Parent, const char* Key, bool bSrgb, FHostTextureSlot& OutSlot)
{
	const FJson Info = Parent.Member(Key);
	if (Info.Exists())
	{
		OutSlot.Texture = Table.Get(Info, bSrgb);
		OutSlot.UVSet = uint32_t(Info.GetUInt("texCoord", 0, UINT32_MAX));
		ReadTransform(Document, Info, OutSlot);
	}
}

float Clamp01(const FJson& Json, const char* Key, float Default) { return glm::clamp(Json.GetFloat(Key, Default), 0.0f, 1.0f); }

void ReadExtensions(FDocument& Document, const FJson& Json, FHostMaterial& Material)
{
	const FJson Strength = Json.Extension("KHR_materials_emissive_strength");
	Material.Emissive *= std::max(Strength.GetFloat("emissiveStrength", 1.0f), 0.0f);
	if (!glm::all(glm::lessThan(Material.Emissive, glm::vec3(1e30f)))) { Json.Fail("emission is beyond what a float holds"); }
	const FJson Ior = Json.Extension("KHR_materials_ior");
	Material.Ior = Ior.GetFloat("ior", 1.5f);
	if (Material.Ior != 0.0f && Material.Ior < 1.0f) { Ior.Fail(fmt::format("ior {} is neither 0 nor at least 1", Material.Ior)); }
	const FJson Specular = Json.Extension("KHR_materials_specular");
	Material.Specular = Clamp01(Specular, "specularFactor", 1.0f);
	if (Specular.Member("specularTexture").Exists() || Specular.Member("specularColorTexture").Exists() ||
	    Specular.Member("specularColorFactor").Exists())
	{
		Document.Warn("KHR_materials_specular: only specularFactor is read");
	}
}

/// What shines through the material, and what of it is absorbed: −ln(attenuationColor) / attenuationDistance.
void ReadTransmission(FDocument& Document, FTextureTable& Table, const FJson& Json, FHostMaterial& Material)
{
	const FJson Transmission = Json.Extension("KHR_materials_transmission");
	Material.Transmission = Clamp01(Transmission, "transmissionFactor", 0.0f);
	ReadSlot(Document, Table, Transmission, "transmissionTexture", false, Material.Slots[TEXTURE_TRANSMISSION]);
	const FJson Volume = Json.Extension("KHR_materials_volume");
	Material.bSolid = Volume.GetFloat("thicknessFactor", 0.0f) > 0.0f;
	if (!Volume.Member("attenuationDistance").Exists()) { return; }
	const float Distance = Volume.GetFloat("attenuationDistance", 0.0f);
	if (!(Distance > 0.0f)) { Volume.Fail(fmt::format("attenuationDistance {} is not greater than 0", Distance)); }
	constexpr float Darkest = 1.0e-6f, Most = 1.0e6f; // what is black absorbs all within a fraction of the distance
	const glm::vec3 Color = glm::clamp(Volume.GetVec3("attenuationColor", glm::vec3(1)), glm::vec3(Darkest), glm::vec3(1));
	Material.Extinction = glm::min(-glm::log(Color) / Distance, glm::vec3(Most));
}

/// What the volume scatters. The file has the colour that all scatterings make together. A single one is of Kulla & Conty 2017, and of van de
/// Hulst's similarity where light is scattered forward.
void ReadScattering(FDocument& Document, const FJson& Json, FHostMaterial& Material)
{
	const FJson Scatter = Json.Extension("KHR_materials_volume_scatter");
	if (!Scatter.Exists()) { return; }
	if (!Material.bSolid || Material.Transmission <= 0.0f)
	{
		Document.Warn("KHR_materials_volume_scatter: read only beside KHR_materials_transmission and a thickness");
		return;
	}
	const glm::vec3 Color = glm::clamp(Scatter.GetVec3("multiscatterColor", glm::vec3(0)), 0.0f, 1.0f);
	const float G = Scatter.GetFloat("scatterAnisotropy", 0.0f);
	if (!(std::abs(G) < 1.0f)) { Scatter.Fail(fmt::format("scatterAnisotropy {} does not lie between -1 and 1", G)); }
	const glm::vec3 Root = 4.09712f + 4.20863f * Color - glm::sqrt(9.59217f + 41.6808f * Color + 17.7126f * Color * Color);
	const glm::vec3 Albedo = glm::clamp((1.0f - Root * Root) / (1.0f - G * Root * Root), 0.0f, 1.0f);
	Material.ScatterAlbedo = glm::mix(Albedo, glm::vec3(0), glm::equal(Color, glm::vec3(0))); // which the fit misses by little
	Material.ScatterAnisotropy = G;
}

void ReadDiffuseTransmission(FDocument& Document, FTextureTable& Table, const FJson& Json, FHostMaterial& Material)
{
	const FJson Diffuse = Json.Extension("KHR_materials_diffuse_transmission");
	Material.DiffuseTransmission = Clamp01(Diffuse, "diffuseTransmissionFactor", 0.0f);
	Material.DiffuseTransmissionColor = glm::clamp(Diffuse.GetVec3("diffuseTransmissionColorFactor", glm::vec3(1)), 0.0f, 1.0f);
	ReadSlot(Document, Table, Diffuse, "diffuseTransmissionTexture", false, Material.Slots[TEXTURE_DIFFUSE_TRANSMISSION]);
	ReadSlot(Document, Table, Diffuse, "diffuseTransmissionColorTexture", true, Material.Slots[TEXTURE_DIFFUSE_TRANSMISSION_COLOR]);
}

/// Reads extras.lantern of a material: what it lights with, if that is not what it looks like.
void ReadLightEmission(const FJson& Json, FHostMaterial& Material)
{
	const FJson Own = Json.Extra("lantern");
	if (!Own.Member("lightEmissiveFactor").Exists() && !Own.Member("lightEmissiveStrength").Exists()) { return; }
	const glm::vec3 Factor =
	    glm::max(Own.GetVec3("lightEmissiveFactor", glm::max(Json.GetVec3("emissiveFactor", glm::vec3(0)), glm::vec3(0))), glm::vec3(0));
	Material.LightEmissive = Factor * std::max(Own.GetFloat("lightEmissiveStrength", 1.0f), 0.0f);
	if (!glm::all(glm::lessThan(*Material.LightEmissive, glm::vec3(1e30f)))) { Own.Fail("emission is beyond what a float holds"); }
}

/// Unlit materials become emitters of their base colour: what they look like, although they then also light others.
void ReadUnlit(FDocument& Document, const FJson& Json, FHostMaterial& Material)
{
	if (Json.Extension("KHR_materials_unlit").Exists())
	{
		Document.Warn("KHR_materials_unlit: unlit materials are rendered as emitters of their base colour");
		Material.Emissive = glm::vec3(Material.BaseColor);
		Material.Slots[TEXTURE_EMISSIVE] = Material.Slots[TEXTURE_BASE_COLOR];
		Material.BaseColor = glm::vec4(0, 0, 0, Material.BaseColor.a);
		Material.Metallic = 0.0f;
		Material.Roughness = 1.0f;
		Material.Specular = 0.0f;
		Material.Slots[TEXTURE_METALLIC_ROUGHNESS] = {};
		Material.Slots[TEXTURE_NORMAL] = {};
	}
}

void ReadAlpha(const FJson& Json, FHostMaterial& Material)
{
	const std::string Mode = Json.GetString("alphaMode", "OPAQUE");
	if (Mode == "MASK") { Material.AlphaMode = EAlphaMode::Mask; }
	else if (Mode == "BLEND") { Material.AlphaMode = EAlphaMode::Blend; }
	else if (Mode != "OPAQUE") { Json.Fail(fmt::format("{} is no alphaMode", Quote(Mode))); }
	Material.AlphaCutoff = std::max(Json.GetFloat("alphaCutoff", 0.5f), 0.0f);
	Material.bDoubleSided = Json.GetBool("doubleSided", false);
}

FHostMaterial ReadMaterial(FDocument& Document, FTextureTable& Table, const FJson& Json)
{
	FHostMaterial Material;
	Material.Name = Json.GetString("name", "");
	const FJson Pbr = Json.Member("pbrMetallicRoughness");
	Material.BaseColor = glm::clamp(Pbr.GetVec4("baseColorFactor", glm::vec4(1)), 0.0f, 1.0f);
	Material.Metallic = Clamp01(Pbr, "metallicFactor", 1.0f);
	Material.Roughness = Clamp01(Pbr, "roughnessFactor", 1.0f);
	Material.Emissive = glm::max(Json.GetVec3("emissiveFactor", glm::vec3(0)), glm::vec3(0));
	ReadSlot(Document, Table, Pbr, "baseColorTexture", true, Material.Slots[TEXTURE_BASE_COLOR]);
	ReadSlot(Document, Table, Pbr, "metallicRoughnessTexture", false, Material.Slots[TEXTURE_METALLIC_ROUGHNESS]);
	ReadSlot(Document, Table, Json, "normalTexture", false, Material.Slots[TEXTURE_NORMAL]);
	ReadSlot(Document, Table, Json, "occlusionTexture", false, Material.Slots[TEXTURE_OCCLUSION]);
	ReadSlot(Document, Table, Json, "emissiveTexture", true, Material.Slots[TEXTURE_EMISSIVE]);
	const FJson Normal = Json.Member("normalTexture");
	Material.NormalScale = Normal.GetFloat("scale", 1.0f);
	const FJson Occlusion = Json.Member("occlusionTexture");
	Material.OcclusionStrength = Clamp01(Occlusion, "strength", 1.0f);
	ReadAlpha(Json, Material);
	ReadExtensions(Document, Json, Material);
	ReadTransmission(Document, Table, Json, Material);
	ReadScattering(Document, Json, Material);
	ReadDiffuseTransmission(Document, Table, Json, Material);
	ReadUnlit(Document, Json, Material);
	ReadLightEmission(Json, Material);
	return Material;
}

} // namespace

void ReadMaterials(FDocument& Document)
{
	FTextureTable Table(Document);
	const FJson Materials = Document.Root.Member("materials");
	for (size_t I = 0; I < Materials.Count(); ++I)
	{
		const FJson Json = Materials.Element(I);
		Document.Scene.Materials.push_back(ReadMaterial(Document, Table, Json));
	}
}

} // namespace Lantern::Gltf
