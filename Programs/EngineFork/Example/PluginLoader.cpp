// Reads Plugin.json, opens the library and initializes the module.
#include "Example/PluginLoader.h"

#include <cstdio>
#include <fstream>

#include <dlfcn.h>
#include <nlohmann/json.hpp>

namespace Fork
{

FError ReadManifest(const std::filesystem::path& File, FPluginManifest& Out)
{
	std::ifstream Stream(File);
	if (!Stream) { return File.string() + ": cannot be read"; }
	const nlohmann::json Json = nlohmann::json::parse(Stream, nullptr, false);
	if (!Json.is_object()) { return File.string() + ": not a JSON object"; }
	try
	{
		Json.at("name").get_to(Out.Name);
		Json.at("version").get_to(Out.Version);
		Json.at("library").get_to(Out.Library);
		Json.at("entryPoint").get_to(Out.EntryPoint);
		Json.at("moduleVersion").get_to(Out.ModuleVersion);
		Json.at("rhiVersion").get_to(Out.RHIVersion);
		const std::filesystem::path Folder = std::filesystem::absolute(File).parent_path();
		Out.ConfigFolder = Folder / Json.at("configFolder").get<std::string>();
		Out.ShaderFolder = Folder / Json.at("shaderFolder").get<std::string>();
	}
	catch (const nlohmann::json::exception& Error)
	{
		return File.string() + ": " + Error.what();
	}
	return {};
}

FError FPluginLibrary::Load(const FPluginManifest& Manifest, const std::filesystem::path& Folder)
{
	if (Manifest.ModuleVersion != Lantern::ModuleVersion || Manifest.RHIVersion != Lantern::RHIVersion)
	{
		return "the plugin has another version of its interface than this engine was compiled with";
	}
	Path = (Folder / Manifest.Library).string();
	Handle = dlopen(Path.c_str(), RTLD_NOW | RTLD_LOCAL);
	if (Handle == nullptr) { return dlerror(); }
	Create = reinterpret_cast<Lantern::FRTCreateModule>(dlsym(Handle, Manifest.EntryPoint.c_str()));
	return Create != nullptr ? FError() : Path + " has no " + Manifest.EntryPoint;
}

FError FPluginLibrary::CreateModule(Lantern::TRTRef<Lantern::IRTModule>& Out) const
{
	const int32_t Result = Create(Lantern::ModuleVersion, Out.ReleaseAndGetAddress());
	return Result == 0 ? FError() : "the library refused module version " + std::to_string(Lantern::ModuleVersion);
}

bool FPluginLibrary::Unload()
{
	if (Handle == nullptr) { return true; }
#if defined(__SANITIZE_ADDRESS__)
	Handle = nullptr; // the leak checker could not tell whose memory it finds, once the library is gone
	return true;
#else
	dlclose(Handle);
	Handle = nullptr;
	void* Still = dlopen(Path.c_str(), RTLD_NOW | RTLD_NOLOAD);
	if (Still != nullptr) { dlclose(Still); }
	return Still == nullptr;
#endif
}

FPluginLibrary::~FPluginLibrary() { Unload(); }

FError InitializeModule(Lantern::IRTModule& Module, const FPluginManifest& Manifest, const FSettings& Settings)
{
	using namespace Lantern;
	FRTModuleDesc Desc;
	Desc.ConfigFolder = Manifest.ConfigFolder.c_str();
	Desc.ShaderFolder = Manifest.ShaderFolder.c_str();
	Desc.LogCallback = [](void*, ERTModuleLog Level, const char* Text) {
		if (Level >= ERTModuleLog::Warning) { std::fprintf(stderr, "plugin: %s\n", Show(Text).c_str()); }
	};
	FError Error = ToError(Module.Initialize(Desc), "Initialize");
	for (size_t Index = 0; Error.empty() && Index < Settings.size(); ++Index)
	{
		const auto& [Name, Value] = Settings[Index];
		Error = ToError(Module.SetConsoleVariable(Name.c_str(), Value.c_str()), "SetConsoleVariable");
	}
	return Error;
}

} // namespace Fork
