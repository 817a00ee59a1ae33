// The steps of an import, in order.
#include "Gltf/GltfImport.h"

#include <algorithm>
#include <array>

#include <fmt/format.h>

#include "Gltf/GltfDocument.h"
#include "LanternCore/Text/Quote.h"

namespace Lantern::Gltf
{

namespace
{

constexpr std::array<std::string_view, 12> SupportedExtensions = {
    "KHR_lights_punctual",
    "KHR_materials_diffuse_transmission",
    "KHR_materials_emissive_strength",
    "KHR_materials_ior",
    "KHR_materials_specular",
    "KHR_materials_transmission",
    "KHR_materials_unlit",
    "KHR_materials_volume",
    "KHR_materials_volume_scatter",
    "KHR_texture_transform",
    "KHR_mesh_quantization",
    "EXT_mesh_gpu_instancing",
};

void CheckAsset(const FJson& Root)
{
	const FJson Asset = Root.Member("asset");
	if (!Asset.Exists()) { Root.Fail("not a glTF file: 'asset' is missing"); }
	const std::string Version = Asset.GetString("version", "");
	if (!Version.starts_with("2.")) { Asset.Fail(fmt::format("glTF version {} is not supported (2.0 is)", Quote(Version))); }
}

void CheckExtensions(FDocument& Document)
{
	const auto IsSupported = [](const std::string& Name) {
		return std::find(SupportedExtensions.begin(), SupportedExtensions.end(), Name) != SupportedExtensions.end();
	};
	const FJson Required = Document.Root.Member("extensionsRequired");
	for (size_t I = 0; I < Required.Count(); ++I)
	{
		const FJson Name = Required.Element(I);
		if (!IsSupported(Name.ToString())) { Name.Fail(fmt::format("extension {} is required but not supported", Quote(Name.ToString()))); }
	}
	const FJson Used = Document.Root.Member("extensionsUsed");
	std::string Ignored;
	for (size_t I = 0; I < Used.Count() && Ignored.size() < 1000; ++I)
	{
		const FJson Name = Used.Element(I);
		if (!IsSupported(Name.ToString())) { Ignored += (Ignored.empty() ? "" : ", ") + EscapeText(Name.ToString(), MaxQuotedBytes); }
	}
	if (!Ignored.empty()) { Document.Warn("extensions that are not read: " + Ignored); }
}

} // namespace

FSceneDescription ImportScene(FBytes Data, const std::filesystem::path& Folder, const FLoadOptions& Options)
{
	FSceneDescription Scene;
	FDocument Document(Options, Scene);
	Document.Folder = Folder;
	Document.ReportProgress("parsing", 0.0f);
	std::string_view Text(reinterpret_cast<const char*>(Data.data()), Data.size());
	if (IsGlb(Data))
	{
		const FGlb Glb = SplitGlb(Data);
		Text = Glb.Json;
		Document.GlbBinary = Glb.Binary;
	}
	Document.Json = ParseJson(Text);
	Document.Root = FJson(Document.Json);
	Document.Root.RequireObject();
	CheckAsset(Document.Root);
	CheckExtensions(Document);
	ReadBuffers(Document);
	ReadAccessors(Document);
	ReadMaterials(Document);
	ReadMeshes(Document);
	ReadNodes(Document);
	ReadSkins(Document);
	ReadAnimations(Document);
	ReadImages(Document);
	return Scene;
}

} // namespace Lantern::Gltf
