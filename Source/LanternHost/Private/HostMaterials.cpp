// Uploads images and creates samplers and materials of a loaded scene.
#include <algorithm>
#include <bit>
#include <cmath>
#include <filesystem>

#include <glm/gtc/packing.hpp>

#include "HostMaterials.h"
#include "LanternCore/Tasks/Tasks.h"
#include "LanternCore/Text/Log.h"
#include "LanternHost/HostScene.h"
#include "LanternImage/ToneMap.h"
#include "LanternScene/Scene/TextureSlot.h"

namespace Lantern
{

namespace
{
glm::vec3 MeanColor(const FHostImage& Image)
{
	float Decode[256];
	for (int I = 0; I < 256; ++I)
	{
		Decode[I] = Image.bSrgb ? SrgbToLinear(static_cast<float>(I) / 255.0f) : static_cast<float>(I) / 255.0f;
	}
	glm::dvec3 Sum(0);
	const size_t Count = size_t(Image.Width) * Image.Height;
	for (size_t I = 0; I < Count; ++I)
	{
		for (int Channel = 0; Channel < 3; ++Channel) { Sum[Channel] += Decode[Image.Rgba[4 * I + Channel]]; }
	}
	return glm::vec3(Sum / double(std::max<size_t>(Count, 1)));
}

/// Rounds to fp16, as payloads do, since the pdf of light sampling must be one number wherever it is computed.
float MakeEmissiveWeight(glm::vec3 Emission)
{
	const float Luminance = glm::dot(Emission, glm::vec3(0.2126f, 0.7152f, 0.0722f)) / 64.0f;
	if (!(Luminance > 0.0f)) { return 0.0f; }
	return glm::unpackHalf1x16(glm::packHalf1x16(std::clamp(Luminance, 6.2e-5f, 65504.0f)));
}
} // namespace

FRTStatus FHostScene::UploadTextures(FUploader& Uploader, const std::function<void(float)>& Progress)
{
	Images.resize(Description.Images.size());
	ImageMeans.resize(Description.Images.size(), glm::vec3(1));
	// Only emissive textures need their mean.
	for (const FHostMaterial& Material : Description.Materials)
	{
		const int32_t Texture = Material.Slots[TEXTURE_EMISSIVE].Texture;
		if (Texture >= 0 && Description.Textures[Texture].Image >= 0)
		{
			const int32_t Image = Description.Textures[Texture].Image;
			ImageMeans[Image] = MeanColor(Description.Images[Image]);
		}
	}
	for (size_t I = 0; I < Images.size(); ++I)
	{
		FHostImage& Image = Description.Images[I];
		FRTTextureDesc Desc;
		Desc.Width = Image.Width;
		Desc.Height = Image.Height;
		Desc.MipCount = static_cast<uint32_t>(std::bit_width(std::max(Image.Width, Image.Height)));
		Desc.Format = Image.bSrgb ? ERTFormat::RGBA8_SRGB : ERTFormat::RGBA8_UNORM;
		Desc.Usage = ERTTextureUsage::Sampled;
		Desc.Name = Image.Name.c_str();
		if (FRTStatus S = Uploader.CreateTexture(Desc, Image.Rgba.data(), Images[I]); !S) { return S; }
		std::vector<uint8_t>().swap(Image.Rgba);
		if (Progress) { Progress(static_cast<float>(I) / static_cast<float>(Images.size())); }
	}
	return FRTStatus::Success();
}

FRTStatus FHostScene::GetSampler(const FHostTexture& Texture, uint32_t& OutIndex)
{
	const uint32_t Key =
	    Texture.bRepeatU | (Texture.bRepeatV << 1) | (Texture.bMirrorU << 2) | (Texture.bMirrorV << 3) | (Texture.bNearest << 4);
	const auto Found = std::find_if(Samplers.begin(), Samplers.end(), [&](const auto& Entry) { return Entry.first == Key; });
	if (Found != Samplers.end())
	{
		OutIndex = Found->second->GetIndex();
		return FRTStatus::Success();
	}
	FRTSamplerDesc Desc = MakeSamplerDesc(Texture);
	Desc.Name = "MaterialSampler";
	TRTRef<IRTSampler> Sampler;
	if (FRTStatus S = Device.CreateSampler(Desc, Sampler.ReleaseAndGetAddress()); !S) { return S; }
	OutIndex = Sampler->GetIndex();
	Samplers.emplace_back(Key, std::move(Sampler));
	return FRTStatus::Success();
}

FRTStatus FHostScene::AddMaterials(FMaterialPrograms& Programs)
{
	for (const FHostMaterial& Source : Description.Materials)
	{
		FMaterialData Data{};
		Data.BaseColor = Source.BaseColor;
		Data.Emissive = Source.Emissive;
		Data.LightEmissive = Source.LightEmissive.value_or(Source.Emissive);
		Data.Metallic = Source.Metallic;
		Data.Roughness = Source.Roughness;
		Data.NormalScale = Source.NormalScale;
		Data.OcclusionStrength = Source.OcclusionStrength;
		Data.AlphaCutoff = GetAlphaCutoff(Source);
		Data.Ior = Source.Ior;
		Data.Specular = Source.Specular;
		Data.Transmission = Source.Transmission;
		Data.Extinction = Source.Extinction;
		Data.ScatterAlbedo = Source.ScatterAlbedo;
		Data.ScatterAnisotropy = Source.ScatterAnisotropy;
		Data.DiffuseTransmission = Source.DiffuseTransmission;
		Data.DiffuseTransmissionColor = Source.DiffuseTransmissionColor;
		Data.Flags = (IsMasked(Source) ? MATERIAL_MASKED : 0u) | (Source.bDoubleSided ? MATERIAL_DOUBLE_SIDED : 0u) |
		             (Source.bSolid ? MATERIAL_SOLID : 0u) | (IsBlended(Source) ? MATERIAL_BLENDED : 0u);
		glm::vec3 MeanEmission = Data.LightEmissive;
		for (uint32_t Slot = 0; Slot < TEXTURE_SLOTS; ++Slot)
		{
			const FHostTextureSlot& Texture = Source.Slots[Slot];
			Data.UVTransform[Slot] = Texture.Transform;
			Data.UVOffset[Slot] = Texture.Offset;
			Data.UVSets |= Texture.UVSet << Slot;
			Data.Textures[Slot] = NO_TEXTURE;
			if (Texture.Texture < 0) { continue; }
			const FHostTexture& HostTexture = Description.Textures[Texture.Texture];
			uint32_t Sampler = 0;
			if (FRTStatus S = GetSampler(HostTexture, Sampler); !S) { return S; }
			if (!MakeTextureSlot(Images[HostTexture.Image]->GetSampledIndex(), Sampler, Data.Textures[Slot]))
			{
				return FRTStatus::Error(ERTResult::OutOfDescriptors, "more textures or samplers than a material can name");
			}
			if (Slot == TEXTURE_EMISSIVE) { MeanEmission *= ImageMeans[HostTexture.Image]; }
		}
		Data.EmissiveWeight = IsBlended(Source) ? 0.0f : MakeEmissiveWeight(MeanEmission); // light sampling counts whole triangles
		const std::string& Path = Source.Program;
		Scene.AddMaterial(
		    Data, Path.empty() ? StandardProgram : Programs.FindOrAdd({.Name = std::filesystem::path(Path).stem().string(), .Path = Path}));
	}
	return FRTStatus::Success();
}

} // namespace Lantern
