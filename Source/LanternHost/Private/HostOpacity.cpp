// Alpha-tested triangles of a loaded scene, told apart while their texels are still on the CPU.
#include <algorithm>
#include <map>
#include <memory>

#include "HostMaterials.h"
#include "LanternCore/Tasks.h"
#include "LanternHost/HostScene.h"

namespace Lantern
{

namespace
{
struct FMaskedSection
{
	uint32_t Mesh, Section;
};
using FSectionsByImage = std::map<int32_t, std::vector<FMaskedSection>>; // -1: no texture

FSectionsByImage FindMaskedSections(const FSceneDescription& Description)
{
	FSectionsByImage Out;
	for (uint32_t Mesh = 0; Mesh < Description.Meshes.size(); ++Mesh)
	{
		const std::vector<FHostSection>& Sections = Description.Meshes[Mesh].Sections;
		for (uint32_t Section = 0; Section < Sections.size(); ++Section)
		{
			const FHostMaterial& Material = Description.Materials[Sections[Section].Material];
			if (Material.AlphaMode == EAlphaMode::Opaque)
			{
				continue;
			}
			const int32_t Texture = Material.Slots[TEXTURE_BASE_COLOR].Texture;
			Out[Texture < 0 ? -1 : Description.Textures[Texture].Image].push_back({Mesh, Section});
		}
	}
	return Out;
}

FAlphaTexels GetAlpha(const FHostImage& Image)
{
	return {Image.Rgba.data() + 3, Image.Width, Image.Height, 4};
}

FAlphaTest MakeAlphaTest(const FSceneDescription& Description, const FHostMaterial& Material,
                         const FAlphaPyramid* Texture)
{
	const FHostTextureSlot& Slot = Material.Slots[TEXTURE_BASE_COLOR];
	FAlphaTest Test;
	Test.bTextured = Slot.Texture >= 0;
	Test.Texture = Texture;
	Test.bUV1 = Slot.UVSet == 1;
	Test.BaseAlpha = Material.BaseColor.a;
	Test.Cutoff = GetAlphaCutoff(Material);
	Test.UVTransform = Slot.Transform;
	Test.UVOffset = Slot.Offset;
	if (Test.bTextured)
	{
		const FRTSamplerDesc Sampler = MakeSamplerDesc(Description.Textures[Slot.Texture]);
		Test.AddressU = Sampler.U;
		Test.AddressV = Sampler.V;
		Test.bLinear = Sampler.Mag == ERTFilter::Linear;
	}
	return Test;
}
} // namespace

void FHostScene::ClassifyOpacity()
{
	for (const FHostMesh& Mesh : Description.Meshes)
	{
		Opacity.emplace_back(Mesh.Sections.size());
	}
	const FSectionsByImage ByImage = FindMaskedSections(Description);
	const std::vector<std::pair<int32_t, std::vector<FMaskedSection>>> Groups(ByImage.begin(), ByImage.end());
	// By image: no more pyramids than workers are there at once.
	ParallelFor(Groups.size(), 1,
	            [&](size_t Begin, size_t End)
	            {
		            for (size_t Group = Begin; Group < End; ++Group)
		            {
			            const auto& [Image, Sections] = Groups[Group];
			            std::unique_ptr<FAlphaPyramid> Pyramid;
			            if (Image >= 0)
			            {
				            Pyramid = std::make_unique<FAlphaPyramid>(GetAlpha(Description.Images[Image]));
			            }
			            for (const FMaskedSection Where : Sections)
			            {
				            FHostMesh& Mesh = Description.Meshes[Where.Mesh];
				            const FHostSection& Source = Mesh.Sections[Where.Section];
				            const FHostMaterial& Material = Description.Materials[Source.Material];
				            FRTSectionInfo Section{Source.FirstIndex, Source.IndexCount, false};
				            Opacity[Where.Mesh][Where.Section] =
				                ClassifySection(MakeAlphaTest(Description, Material, Pyramid.get()), 1,
				                                Mesh.Attributes.data(), Mesh.Indices.data(), Section);
			            }
		            }
	            });
	for (const std::vector<FOpacityCounts>& Mesh : Opacity)
	{
		for (const FOpacityCounts& Section : Mesh)
		{
			OpacityCounts.Mixed += Section.Mixed;
			OpacityCounts.Opaque += Section.Opaque;
			OpacityCounts.Transparent += Section.Transparent;
		}
	}
}

} // namespace Lantern
