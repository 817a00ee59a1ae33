// Finds the plugin by its Plugin.json and loads its library.
#pragma once

#include <filesystem>
#include <string>

#include "LanternModule/Module.h"

namespace Fork
{

struct FPluginManifest
{
	std::string Name, Version, Library, EntryPoint;
	uint32_t ModuleVersion = 0, RHIVersion = 0;
	std::filesystem::path ConfigFolder, ShaderFolder; ///< absolute
};

/// Empty, or what is wrong and where.
std::string ReadManifest(const std::filesystem::path& File, FPluginManifest& Out);

/// The loaded library; the module must be released before it goes.
class FPluginLibrary
{
public:
	FPluginLibrary() = default;
	FPluginLibrary(const FPluginLibrary&) = delete;
	~FPluginLibrary();
	/// Folder: where the library lies; the engine decides where it puts binaries.
	std::string Load(const FPluginManifest& Manifest, const std::filesystem::path& Folder);
	std::string CreateModule(Lantern::TRTRef<Lantern::IRTModule>& Out) const;
	/// True when the library is no longer in the process.
	bool Unload();

private:
	std::string Path;
	void* Handle = nullptr;
	Lantern::FRTCreateModule Create = nullptr;
};

} // namespace Fork
