// Classifies and cuts the alpha-tested triangles of a scene before upload.
#include "LanternHost/SceneOpacity.h"

#include <cmath>
#include <map>
#include <memory>

#include "HostMaterials.h"
#include "LanternCore/Config/ConsoleVariables.h"
#include "LanternCore/Tasks/Tasks.h"

namespace Lantern
{

namespace
{
TRTConsoleVariable<float> CVarPieces("r.RT.Opacity.Pieces", 0.0f,
    "Cuts alpha-tested triangles that are partly transparent into pieces without the "
    "transparent parts. Adds at most so many pieces for each such triangle on average, "
    "where they save most: it halves the alpha tests and enlarges the structures. "
    "0: none. Read when a scene is loaded.",
    {0.0, 64.0});

struct FMaskedSection
{
	uint32_t Mesh = 0, Section = 0;
	FAlphaTest Test;
};

FAlphaTexels GetAlpha(const FHostImage& Image) { return {Image.Rgba.data() + 3, Image.Width, Image.Height, 4}; }

FAlphaTest MakeAlphaTest(const FSceneDescription& Description, const FHostMaterial& Material, const FAlphaPyramid* Texture)
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

/// Finds masked sections, grouped by image, so that consecutive ones read the same texels.
std::vector<std::pair<int32_t, std::vector<FMaskedSection>>> FindMaskedSections(const FSceneDescription& Description)
{
	std::map<int32_t, std::vector<FMaskedSection>> Out; // -1: no texture
	for (uint32_t Mesh = 0; Mesh < Description.Meshes.size(); ++Mesh)
	{
		const std::vector<FHostSection>& Sections = Description.Meshes[Mesh].Sections;
		for (uint32_t Section = 0; Section < Sections.size(); ++Section)
		{
			const FHostMaterial& Material = Description.Materials[Sections[Section].Material];
			if (IsMasked(Material) && !IsTransmissive(Material)) // else no part of it stops all light
			{
				const int32_t Texture = Material.Slots[TEXTURE_BASE_COLOR].Texture;
				Out[Texture < 0 ? -1 : Description.Textures[Texture].Image].push_back({Mesh, Section, {}});
			}
		}
	}
	return {Out.begin(), Out.end()};
}

/// Returns the total world area that a square metre of each mesh represents.
std::vector<float> FindMeshWeights(const FSceneDescription& Description, const FScenePose& Pose)
{
	std::vector<float> Weights(Description.Meshes.size(), 0.0f);
	for (size_t Node = 0; Node < Description.Nodes.size(); ++Node)
	{
		if (const int32_t Mesh = Description.Nodes[Node].Mesh; Mesh >= 0)
		{
			const double Volume = std::abs(glm::determinant(glm::dmat3(Pose.World[Node])));
			Weights[Mesh] += static_cast<float>(std::pow(Volume, 2.0 / 3.0));
		}
	}
	return Weights;
}

void AddCounts(const FOpacityCounts& From, FOpacityCounts& To)
{
	To.Mixed += From.Mixed;
	To.Opaque += From.Opaque;
	To.Transparent += From.Transparent;
}

/// Excludes skinned meshes, which pieces cannot follow, and emitters, whose list counts whole triangles.
bool CanBeCut(const FSceneDescription& Description, const FMaskedSection& Masked)
{
	const FHostMesh& Mesh = Description.Meshes[Masked.Mesh];
	const FHostMaterial& Material = Description.Materials[Mesh.Sections[Masked.Section].Material];
	const bool bEmits =
	    glm::any(glm::greaterThan(glm::max(Material.Emissive, Material.LightEmissive.value_or(glm::vec3(0))), glm::vec3(0)));
	return Mesh.Skin.empty() && !bEmits && Masked.Test.Texture;
}

void CutPieces(
    const FSceneDescription& Description, const FScenePose& Pose, const std::vector<FMaskedSection>& Sections, FSceneOpacity& Out)
{
	const std::vector<float> Weights = FindMeshWeights(Description, Pose);
	std::map<int32_t, const FAlphaTest*> Tests; // of materials
	std::vector<FPieceSource> Sources;
	std::vector<const FMaskedSection*> Of;
	for (const FMaskedSection& Masked : Sections)
	{
		if (!CanBeCut(Description, Masked)) { continue; }
		const FHostMesh& Mesh = Description.Meshes[Masked.Mesh];
		const FRTSectionInfo& Info = Out.Meshes[Masked.Mesh].Sections[Masked.Section];
		const uint32_t Mixed = Info.IndexCount - Info.OpaqueIndexCount - Info.TransparentIndexCount;
		const FAlphaTest* const Test = Tests.try_emplace(Mesh.Sections[Masked.Section].Material, &Masked.Test).first->second;
		Sources.push_back(
		    {Test, Mesh.Attributes.data(), Mesh.Positions.data(), {Mesh.Indices.data() + Info.FirstIndex, Mixed}, Weights[Masked.Mesh]});
		Of.push_back(&Masked);
	}
	const auto MostExtra = static_cast<uint64_t>(double(CVarPieces.Get()) * Out.Counts.Mixed);
	const std::vector<FOpacityPieceList> Lists = CutOpacityPieces(Sources, MostExtra);
	for (size_t I = 0; I < Lists.size(); ++I)
	{
		FMeshOpacity& Mesh = Out.Meshes[Of[I]->Mesh];
		FRTSectionInfo& Section = Mesh.Sections[Of[I]->Section];
		Section.FirstPiece = Mesh.Pieces.GetCount();
		Section.PieceCount = Lists[I].GetCount();
		Out.Pieces += Section.PieceCount;
		Mesh.Pieces.Positions.insert(Mesh.Pieces.Positions.end(), Lists[I].Positions.begin(), Lists[I].Positions.end());
		Mesh.Pieces.Indices.insert(Mesh.Pieces.Indices.end(), Lists[I].Indices.begin(), Lists[I].Indices.end());
	}
}

void ClassifyGroup(FSceneDescription& Description, const FAlphaPyramid* Pyramid, std::vector<FMaskedSection>& Group,
    std::vector<FMeshOpacity>& Meshes, FOpacityCounts& Counts)
{
	for (FMaskedSection& Masked : Group)
	{
		FHostMesh& Mesh = Description.Meshes[Masked.Mesh];
		const int32_t Material = Mesh.Sections[Masked.Section].Material;
		Masked.Test = MakeAlphaTest(Description, Description.Materials[Material], Pyramid);
		constexpr uint64_t KeyToCome = 1; // materials have no indices on the GPU yet
		AddCounts(ClassifySection(
		              Masked.Test, KeyToCome, Mesh.Attributes.data(), Mesh.Indices.data(), Meshes[Masked.Mesh].Sections[Masked.Section]),
		    Counts);
	}
}
} // namespace

FSceneOpacity ClassifySceneOpacity(FSceneDescription& Description, const FScenePose& Pose)
{
	FSceneOpacity Out;
	for (const FHostMesh& Mesh : Description.Meshes)
	{
		FMeshOpacity& Of = Out.Meshes.emplace_back();
		for (const FHostSection& Section : Mesh.Sections)
		{
			const FHostMaterial& Material = Description.Materials[Section.Material];
			const bool bOpaque = !IsMasked(Material) && !IsTransmissive(Material);
			Of.Sections.push_back({Section.FirstIndex, Section.IndexCount, bOpaque});
		}
	}
	auto Groups = FindMaskedSections(Description);
	std::vector<std::unique_ptr<FAlphaPyramid>> Pyramids(Groups.size());
	std::vector<FOpacityCounts> Counts(Groups.size());
	ParallelFor(Groups.size(), 1, [&](size_t Begin, size_t End) {
		for (size_t I = Begin; I < End; ++I)
		{
			if (const int32_t Image = Groups[I].first; Image >= 0)
			{
				Pyramids[I] = std::make_unique<FAlphaPyramid>(GetAlpha(Description.Images[Image]));
			}
			ClassifyGroup(Description, Pyramids[I].get(), Groups[I].second, Out.Meshes, Counts[I]);
		}
	});
	std::vector<FMaskedSection> All;
	for (size_t I = 0; I < Groups.size(); ++I)
	{
		AddCounts(Counts[I], Out.Counts);
		All.insert(All.end(), Groups[I].second.begin(), Groups[I].second.end());
	}
	CutPieces(Description, Pose, All, Out);
	return Out;
}

} // namespace Lantern
