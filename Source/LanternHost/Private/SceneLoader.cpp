// Loads a scene by name or file: built-in scenes and glTF.
#include "LanternHost/SceneLoader.h"

#include <algorithm>
#include <filesystem>
#include <new>

#include <fmt/format.h>

#include "Gltf/GltfImport.h"
#include "LanternCore/Text/Quote.h"
#include "LanternHost/BuiltinScenes.h"

namespace Lantern
{

namespace
{

/// Makes one line of bounded length, since many quoted names may still be long.
std::string MakeLine(std::string_view Text)
{
	constexpr size_t MaxLength = 600;
	return EscapeText(Text, MaxLength);
}

/// Runs Import, which may throw, and converts exceptions to errors. No exception crosses this boundary.
template <class T>
FLoadResult Guard(const std::string& Name, const T& Import)
{
	FLoadResult Result;
	try
	{
		Result.Scene = Import();
		const std::string Error = ValidateScene(*Result.Scene);
		if (!Error.empty()) { throw Gltf::FError(Error); }
		for (std::string& Warning : Result.Scene->Warnings) { Warning = MakeLine(Warning); }
	}
	catch (const std::bad_alloc&)
	{
		Result.Scene.reset();
		Result.Error = EscapePath(Name) + ": out of memory";
	}
	catch (const std::exception& Exception)
	{
		Result.Scene.reset();
		Result.Error = MakeLine(fmt::format("{}: {}", EscapePath(Name), Exception.what()));
	}
	return Result;
}

std::string GetLowerExtension(const std::filesystem::path& Path)
{
	std::string Extension = Path.extension().string();
	std::transform(Extension.begin(), Extension.end(), Extension.begin(), [](unsigned char C) { return std::tolower(C); });
	return Extension;
}

constexpr uint64_t MaxFileBytes = uint64_t(4) << 30;

} // namespace

FLoadResult LoadScene(const std::string& PathOrBuiltinName, const FLoadOptions& Options)
{
	if (IsBuiltinScene(PathOrBuiltinName))
	{
		FLoadResult Result = BuildBuiltinScene(PathOrBuiltinName);
		if (Result.Scene)
		{
			const std::string Error = ValidateScene(*Result.Scene);
			if (!Error.empty()) { return {std::nullopt, fmt::format("{}: {}", EscapePath(PathOrBuiltinName), Error)}; }
		}
		return Result;
	}
	return Guard(PathOrBuiltinName, [&] {
		const std::filesystem::path Path(PathOrBuiltinName);
		const std::string Extension = GetLowerExtension(Path);
		if (Extension != ".gltf" && Extension != ".glb")
		{
			throw Gltf::FError("neither a .gltf or .glb file nor a built-in scene (" + GetBuiltinSceneNames() + ")");
		}
		const std::vector<uint8_t> Data = Gltf::ReadFile(Path, MaxFileBytes);
		std::filesystem::path Folder = Path.parent_path();
		Folder = Folder.empty() ? std::filesystem::path(".") : Folder;
		FSceneDescription Scene = Gltf::ImportScene(Data, Folder, Options);
		Scene.Name = Path.filename().string();
		return Scene;
	});
}

FLoadResult LoadSceneFromMemory(const void* Data, size_t Size, const std::string& Name, const FLoadOptions& Options)
{
	return Guard(Name, [&] {
		const Gltf::FBytes Bytes(static_cast<const uint8_t*>(Data), Size);
		FSceneDescription Scene = Gltf::ImportScene(Bytes, {}, Options);
		Scene.Name = Name;
		return Scene;
	});
}

} // namespace Lantern
