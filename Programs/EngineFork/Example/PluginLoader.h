// Finds the plugin by its Plugin.json, loads its library and creates its module.
#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "Example/ForkError.h"
#include "LanternModule/Module.h"

namespace Fork
{

struct FPluginManifest
{
	std::string Name, Version, Library, EntryPoint;
	uint32_t ModuleVersion = 0, RHIVersion = 0;
	std::filesystem::path ConfigFolder, ShaderFolder; ///< absolute
};

/// An error says what is wrong with which file.
FError ReadManifest(const std::filesystem::path& File, FPluginManifest& Out);

/// The loaded library. The module must be released before the library is unloaded.
class FPluginLibrary
{
public:
	FPluginLibrary() = default;
	FPluginLibrary(const FPluginLibrary&) = delete;
	~FPluginLibrary();
	/// Folder holds the library; the engine decides where it puts binaries.
	FError Load(const FPluginManifest& Manifest, const std::filesystem::path& Folder);
	FError CreateModule(Lantern::TRTRef<Lantern::IRTModule>& Out) const;
	/// True if the library is no longer in the process.
	bool Unload();

private:
	std::string Path;
	void* Handle = nullptr;
	Lantern::FRTCreateModule Create = nullptr;
};

/// Names and values of console variables.
using FSettings = std::vector<std::pair<std::string, std::string>>;

/// Gives the module its folders and the engine's settings. Warnings of the plugin go to standard error.
FError InitializeModule(Lantern::IRTModule& Module, const FPluginManifest& Manifest, const FSettings& Settings);

} // namespace Fork
