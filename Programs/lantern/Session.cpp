// Finds the plugin's folders, opens the device and loads scenes for the commands.
#include "Session.h"

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <sstream>

#include "LanternCore/Config/Config.h"
#include "LanternCore/Tasks/TaskTrace.h"
#include "LanternCore/Text/Log.h"
#include "LanternCore/Text/Quote.h"
#include "LanternHost/BuiltinScenes.h"
#include "LanternHost/SceneLoader.h"
#include "LanternRHIValidation/ValidationDevice.h"
#include "LanternRHIVulkan/VulkanDevice.h"
#include "Progress.h"

namespace Lantern
{

namespace
{
namespace fs = std::filesystem;

TRTConsoleVariable<float> CVarExposure(
    "r.RT.Exposure", 0.0f, "Exposure of the tone-mapped picture, stops, on top of the scene's own.", {-20, 20});

std::string CacheFolder()
{
	if (const char* Cache = std::getenv("LANTERN_CACHE")) { return Cache; }
	if (const char* Cache = std::getenv("XDG_CACHE_HOME"); Cache && *Cache) { return std::string(Cache) + "/lantern"; }
	if (const char* Home = std::getenv("HOME"); Home && *Home) { return std::string(Home) + "/.cache/lantern"; }
	return {};
}

void OnValidationMessage(void* User, const char* Message)
{
	LogError("{}", Message);
	++*static_cast<uint32_t*>(User);
}

void OnVulkanMessage(void*, ERTVulkanMessage Severity, const char* Text)
{
	LogLine(Severity == ERTVulkanMessage::Error     ? ERTLogLevel::Error
	        : Severity == ERTVulkanMessage::Warning ? ERTLogLevel::Warning
	                                                : ERTLogLevel::Info,
	    Text);
}

FRTVulkanDeviceDesc MakeDeviceDesc(const FDeviceOptions& Options)
{
	FRTVulkanDeviceDesc Desc;
	Desc.DeviceIndex = Options.Device;
	if (const char* Index = std::getenv("LANTERN_DEVICE"); Index && Options.Device < 0) { Desc.DeviceIndex = std::atoi(Index); }
	Desc.bValidation = Options.bValidate;
	if (FTaskTrace::WantsCalls()) { Desc.CallSink.Call = FTaskTrace::RecordCall; }
	return Desc;
}
} // namespace

FPluginFolders FindPluginFolders()
{
	std::error_code Error;
	fs::path Folder = fs::read_symlink("/proc/self/exe", Error).parent_path();
	for (; !Folder.empty(); Folder = Folder.parent_path())
	{
		if (fs::exists(Folder / "Plugin.json", Error)) { break; }
		if (Folder == Folder.root_path())
		{
			Folder.clear();
			break;
		}
	}
	if (const char* Root = std::getenv("LANTERN_ROOT")) { Folder = Root; }
	return {Folder.string(), (Folder / "Shaders").string(), (Folder / "Config").string(), CacheFolder()};
}

int ReportStatus(const FRTStatus& Status, const char* What)
{
	LogError("{}: {}", EscapePath(What), Status.Message);
	switch (Status.Code)
	{
	case ERTResult::Unsupported:
	case ERTResult::OutOfDeviceMemory:
	case ERTResult::OutOfHostMemory:
	case ERTResult::OutOfDescriptors:
	case ERTResult::DeviceLost:
	case ERTResult::Timeout: return ExitNoDevice;
	case ERTResult::IoError:
	case ERTResult::InvalidArgument: return ExitBadInput;
	default: return ExitCheckFailed;
	}
}

FSession::~FSession() = default;

int LoadSettings(const std::string& ConfigFolder, const FDeviceOptions& Options)
{
	const FConfigFolder Config{ConfigFolder};
	LoadDefaults(Config);
	for (const std::string& Path : Options.Configs)
	{
		std::error_code Error;
		if (!fs::is_regular_file(Path, Error))
		{
			LogError("--config {}: no such file", EscapePath(Path));
			return ExitBadInput;
		}
		LoadFile(Config, Path);
	}
	if (Options.bTraceCalls)
	{
		FConsoleVariables::Get().Set("r.RT.Trace", "1", ERTSetBy::CommandLine, "--trace-calls");
		FConsoleVariables::Get().Set("r.RT.Trace.Calls", "1", ERTSetBy::CommandLine, "--trace-calls");
	}
	if (const auto Quality = ParseQuality(Options.Quality)) { LoadScalability(Config, *Quality); }
	for (const std::string& Set : Options.Sets)
	{
		const size_t Equals = Set.find('=');
		FConsoleVariables::Get().Set(Set.substr(0, Equals), Set.substr(Equals + 1), ERTSetBy::CommandLine, "--set");
	}
	return ExitDone;
}

FRTStatus OpenUncachedDevice(const FDeviceOptions& Options, TRTRef<IRTDevice>& Out)
{
	// Caches of the drivers themselves, on disk; neither has a call for it.
	::setenv("__GL_SHADER_DISK_CACHE", "0", 1);
	::setenv("MESA_SHADER_CACHE_DISABLE", "true", 1);
	FRTVulkanDeviceDesc Desc = MakeDeviceDesc(Options);
	Desc.bCacheLibraries = false;
	Desc.MessageCallback = OnVulkanMessage;
	return CreateVulkanDevice(Desc, Out.ReleaseAndGetAddress());
}

int FSession::OpenDevice(const FDeviceOptions& Options)
{
	Folders = FindPluginFolders();
	if (Folders.Root.empty())
	{
		LogError("the plugin's folder was not found above the program (no Plugin.json); LANTERN_ROOT may name it");
		return ExitBadInput;
	}
	if (const int Status = LoadSettings(Folders.Config, Options); Status != ExitDone) { return Status; }
	if (!FTaskTrace::HasFolder()) { FTaskTrace::SetFolder(Folders.Cache); }
	FRTVulkanDeviceDesc Desc = MakeDeviceDesc(Options);
	Desc.MessageCallback = OnVulkanMessage;
	const std::string PipelineCache = Folders.Cache.empty() ? "" : Folders.Cache + "/pipelines.bin";
	if (!PipelineCache.empty())
	{
		std::error_code Error;
		fs::create_directories(Folders.Cache, Error);
		Desc.PipelineCacheFile = PipelineCache.c_str();
	}
	if (FRTStatus S = CreateVulkanDevice(Desc, Device.ReleaseAndGetAddress()); !S)
	{
		LogError("{}", S.Message);
		return ExitNoDevice;
	}
	LoadDeviceProfile({Folders.Config}, Device->GetCapabilities().DeviceName);
	if (Options.bValidate)
	{
		TRTRef<IRTDevice> Wrapped;
		if (FRTStatus S = WrapWithValidation(Device.Get(), OnValidationMessage, &ValidationMessages, Wrapped.ReleaseAndGetAddress()); !S)
		{
			return ReportStatus(S, "validation");
		}
		Device = std::move(Wrapped);
	}
	const FRTCapabilities& Capabilities = Device->GetCapabilities();
	LogInfo("{} ({})", Capabilities.DeviceName, Capabilities.DriverName);
	Engine = std::make_unique<FSampleEngine>(*Device, Folders.DescribeRenderer());
	return ExitDone;
}

int FSession::LoadScene(const FPictureOptions& Options)
{
	if (const uint32_t Most = Device->GetCapabilities().MaxTextureDimension; std::max(Options.Width, Options.Height) > Most)
	{
		LogError("--size {}x{}: the device allows {} pixels each way", Options.Width, Options.Height, Most);
		return ExitUsage;
	}
	const auto Start = std::chrono::steady_clock::now();
	FProgressLine Progress;
	FLoadOptions LoadOptions;
	LoadOptions.Progress = [&](std::string_view Stage, float Fraction) { Progress.Show(Stage, Fraction); };
	FLoadResult Loaded = Lantern::LoadScene(Options.Scene, LoadOptions);
	Progress.Clear();
	if (!Loaded.Scene)
	{
		LogError("{}", Loaded.Error);
		return ExitBadInput;
	}
	for (const std::string& Warning : Loaded.Scene->Warnings) { LogWarning("{}", Warning); }
	DefaultExposure = Loaded.Scene->DefaultExposure;
	if (FRTStatus S = Engine->Load(std::move(*Loaded.Scene), [&](float Fraction) { Progress.Show("upload", Fraction); }); !S)
	{
		Progress.Clear();
		return ReportStatus(S, Options.Scene.c_str());
	}
	Progress.Clear();
	ApplyLight(Options, Engine->GetScene().GetDescription());
	LoadSeconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - Start).count();
	return ExitDone;
}

void FSession::ApplyLight(const FPictureOptions& Options, const FSceneDescription& Description)
{
	FHostScene& Scene = Engine->GetScene();
	if (Options.bNoSceneLights) { Scene.SetSceneLights(false); }
	// A scene from a file that says nothing of light, or has a sun but no sky, stands in open air.
	bool bEmissive = false;
	for (const FHostMaterial& Material : Description.Materials)
	{
		bEmissive |= glm::any(glm::greaterThan(Material.LightEmissive.value_or(Material.Emissive), glm::vec3(0)));
	}
	const std::optional<FSunLight> OwnSun = Scene.GetOwnSun();
	// Whoever names some of the light means that and no more.
	const bool bNamed = Options.Sun || Options.Sky || Options.bNoSceneLights;
	const bool bOpenAir = !bNamed && !IsBuiltinScene(Options.Scene) && (OwnSun || (Description.Lights.empty() && !bEmissive));
	FSunLight Sun;
	Sun.AngularDiameter = glm::radians(Description.DefaultSunDiameter);
	if (Options.Sun)
	{
		Sun.Irradiance = static_cast<float>(Options.Sun->Irradiance);
		Sun.Direction = Options.Sun->Direction;
		Sun.AngularDiameter = static_cast<float>(glm::radians(Options.Sun->Diameter));
	}
	else if (OwnSun && !Options.bNoSceneLights) { Sun = *OwnSun; }
	else if (Description.DefaultSun)
	{
		Sun.Direction = glm::dvec3(*Description.DefaultSun);
		Sun.Irradiance = Description.DefaultSun->w;
	}
	else if (bOpenAir)
	{
		Sun.Irradiance = 4.0f;
		Sun.Direction = {0.25, -1.0, 0.35};
	}
	Scene.SetSun(Sun);
	const glm::vec3 DefaultSky = bOpenAir ? glm::vec3(0.5f, 0.7f, 1.0f) : glm::vec3(0);
	Scene.GetScene().SetSky(Options.Sky ? *Options.Sky : Description.DefaultSky.value_or(DefaultSky));
}

FView FSession::MakeView(const FPictureOptions& Options) const
{
	Engine->SeekTo(Options.Time); // a camera may be animated
	FView View = Engine->GetScene().MakeDefaultView(Options.Width, Options.Height);
	if (Options.Camera)
	{
		View = LookAt(Options.Camera->Position, Options.Camera->Target, static_cast<float>(glm::radians(Options.Camera->FovY)),
		    Options.Width, Options.Height);
	}
	View.Near = Engine->GetScene().NearPlane();
	View.Seed = Options.Seed;
	View.Exposure = DefaultExposure + CVarExposure.Get();
	return View;
}

std::string FSession::MakeSceneKey(const FPictureOptions& Options, ESignal Signal) const
{
	std::error_code Error;
	std::string Key = fs::weakly_canonical(Options.Scene, Error).string() + '\n';
	if (fs::is_regular_file(Options.Scene, Error))
	{
		// An edited file is another scene.
		Key += fmt::format(
		    "{} {}\n", fs::file_size(Options.Scene, Error), fs::last_write_time(Options.Scene, Error).time_since_epoch().count());
	}
	const FSunLight& Sun = Engine->GetScene().GetScene().GetSun();
	const glm::vec3 Sky = Engine->GetScene().GetScene().GetSky();
	Key += fmt::format("{} {} {} {} {} {} {} {}\n", Sun.Irradiance, Sun.Direction.x, Sun.Direction.y, Sun.Direction.z, Sun.AngularDiameter,
	    Sky.x, Sky.y, Sky.z);
	Key += Options.bNoSceneLights ? "no scene lights\n" : "";
	std::istringstream Names(std::string("r.RT.Material.Override r.RT.AlphaTest r.RT.Lights.Shadows.Point r.RT.Lights.Shadows.Spot "
	                                     "r.RT.Lights.Shadows.Rect r.Sky.Program r.Sky.Clouds r.Sky.HighClouds r.Sky.Wind ") +
	                         GetSignalInfo(Signal).ReferenceVariables);
	for (std::string Name; Names >> Name;)
	{
		Key += Name + '=' + FConsoleVariables::ToString(FConsoleVariables::Get().Find(Name)->GetValue()) + '\n';
	}
	return Key;
}

int FSession::Close(int Status)
{
	Engine.reset();
	const uint32_t Vulkan = Device ? Device->GetValidationMessageCount() : 0;
	Device.Reset();
	if (ValidationMessages + Vulkan > 0)
	{
		LogError("validation: {} messages", ValidationMessages + Vulkan);
		return Status == ExitDone ? ExitCheckFailed : Status;
	}
	return Status;
}

} // namespace Lantern
