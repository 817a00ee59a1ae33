// The C entry point and what stands behind it.
#include "LanternModule/Module.h"

#include <atomic>
#include <cstdio>
#include <filesystem>
#include <mutex>
#include <string>
#include <system_error>

#include <tbb/global_control.h>

#include "ArgumentChecks.h"
#include "LanternCore/Config/Config.h"
#include "LanternCore/Config/ConsoleVariables.h"
#include "LanternCore/Shaders/ShaderCompiler.h"
#include "LanternCore/Tasks/TaskTrace.h"
#include "LanternCore/Text/Log.h"
#include "LanternCore/Text/Quote.h"
#include "LanternModule/ModuleVulkan.h"
#include "LanternRHICommon/RefCounted.h"
#include "LanternRHIVulkan/VulkanDevice.h"
#include "LanternRenderer/SkyProgram.h"
#include "ModuleRenderer.h"

namespace Lantern
{

namespace
{

/// Console variables and log are the process's: two modules would set each other's.
std::atomic<bool> bModuleAlive{false};

class FModuleVulkan final : public IRTModuleVulkan
{
public:
	FRTStatus GetRequirements(const FRTVulkanRequirementsDesc& Desc, IRTVulkanRequirements** Out) override
	{
		return Out != nullptr ? GetVulkanRequirements(Desc, Out) : RefuseNull("GetRequirements", "Out");
	}
	FRTStatus AdoptDevice(const FRTVulkanExternalDesc& Desc, IRTDevice** Out) override
	{
		return Out != nullptr ? AdoptVulkanDevice(Desc, Out) : RefuseNull("AdoptDevice", "Out");
	}
};

ERTModuleLog ToModule(ERTLogLevel Level)
{
	switch (Level)
	{
	case ERTLogLevel::Debug: return ERTModuleLog::Debug;
	case ERTLogLevel::Info: return ERTModuleLog::Info;
	case ERTLogLevel::Warning: return ERTModuleLog::Warning;
	case ERTLogLevel::Error: break;
	}
	return ERTModuleLog::Error;
}

FRTStatus CheckFolder(const char* What, const std::string& Folder)
{
	std::error_code Ignored;
	if (std::filesystem::is_directory(Folder, Ignored)) { return FRTStatus::Success(); }
	return FRTStatus::Error(ERTResult::IoError, "%s folder \"%s\" does not exist", What, EscapePath(Folder).c_str());
}

class FModule final : public TRefCounted<IRTModule>
{
public:
	FModule() : Scheduler(tbb::attach{}) {}
	~FModule() override;
	uint32_t GetVersion() const override { return ModuleVersion; }
	const char* GetVersionString() const override { return LANTERN_VERSION; }
	FRTStatus Initialize(const FRTModuleDesc& Desc) override;
	FRTStatus CreateDevice(bool bValidation, IRTDevice** Out) override;
	IRTModuleVulkan* GetVulkan() override { return &Vulkan; }
	FRTStatus CreateRenderer(IRTDevice* Device, const FRTModuleRendererDesc& Desc, IRTModuleRenderer** Out) override;
	FRTStatus SetConsoleVariable(const char* Name, const char* Value) override;
	FRTStatus GetConsoleVariable(const char* Name, char* Out, size_t Capacity) override;

private:
	FRTStatus SetQuality(const std::string& Group, const char* Value);

	tbb::task_scheduler_handle Scheduler;
	FModuleVulkan Vulkan;
	std::string ConfigFolder, ShaderFolder, CacheFolder;
};

FModule::~FModule()
{
	FConsoleVariables::Get().ResetAll();
	SetLogSink({});
	FShaderCompiler::FreeSharedMemory(); // renderers keep the module alive: there is none
	// Worker threads must have left the library before the engine unloads it. It does not succeed where the engine
	// uses the same TBB, and then need not: TBB stays loaded.
	tbb::finalize(Scheduler, std::nothrow);
	bModuleAlive = false;
}

FRTStatus FModule::Initialize(const FRTModuleDesc& Desc)
{
	if (!ShaderFolder.empty()) { return FRTStatus::Error(ERTResult::InvalidArgument, "Initialize was called before"); }
	if (Desc.ShaderFolder == nullptr) { return RefuseNull("Initialize", "FRTModuleDesc::ShaderFolder"); }
	if (const FRTStatus Status = CheckFolder("shader", Desc.ShaderFolder); !Status) { return Status; }
	if (Desc.ConfigFolder != nullptr)
	{
		if (const FRTStatus Status = CheckFolder("config", Desc.ConfigFolder); !Status) { return Status; }
		ConfigFolder = Desc.ConfigFolder;
	}
	if (Desc.LogCallback != nullptr)
	{
		SetLogSink([Callback = Desc.LogCallback, User = Desc.LogUser](
		               ERTLogLevel Level, std::string_view Text) { Callback(User, ToModule(Level), std::string(Text).c_str()); });
	}
	ShaderFolder = Desc.ShaderFolder;
	CacheFolder = Desc.CacheFolder != nullptr ? Desc.CacheFolder : "";
	// A problem in a file is logged with its place and is no reason not to run.
	if (!ConfigFolder.empty()) { LoadDefaults({ConfigFolder}); }
	return FRTStatus::Success();
}

FRTStatus FModule::CreateDevice(bool bValidation, IRTDevice** Out)
{
	if (Out == nullptr) { return RefuseNull("CreateDevice", "Out"); }
	FRTVulkanDeviceDesc Desc;
	Desc.bValidation = bValidation;
	if (FTaskTrace::WantsCalls()) { Desc.CallSink.Call = FTaskTrace::RecordCall; }
	return CreateVulkanDevice(Desc, Out);
}

namespace
{
/// A file of the engine's in place of one of the plugin's.
struct FOwnShader
{
	const char* Path; ///< may be null
	const char* Name; ///< of the member
	FShaderHeader (*MakeHeader)(const std::string& Path);
};
} // namespace

FRTStatus FModule::CreateRenderer(IRTDevice* Device, const FRTModuleRendererDesc& Desc, IRTModuleRenderer** Out)
{
	if (Out == nullptr) { return RefuseNull("CreateRenderer", "Out"); }
	*Out = nullptr;
	if (ShaderFolder.empty()) { return FRTStatus::Error(ERTResult::InvalidArgument, "IRTModule::Initialize was not called"); }
	if (const FRTStatus Status = CheckDevice("CreateRenderer", Device); !Status) { return Status; }
	if (const FRTStatus Status = CheckWorld(Desc); !Status) { return Status; }
	if (!ConfigFolder.empty()) { LoadDeviceProfile({ConfigFolder}, Device->GetCapabilities().DeviceName); }
	FRendererDesc Renderer{{ShaderFolder}, CacheFolder};
	for (const auto& [Path, Name, MakeHeader] : {FOwnShader{Desc.HostShadowShader, "HostShadowShader", MakeHostShadowHeader},
	         FOwnShader{Desc.SkyShader, "SkyShader", MakeSkyProgramHeader}})
	{
		if (Path == nullptr) { continue; }
		if (!std::filesystem::path(Path).is_absolute() || !std::filesystem::is_regular_file(Path))
		{
			return FRTStatus::Error(
			    ERTResult::InvalidArgument, "FRTModuleRendererDesc::%s is no absolute path of a file: \"%s\"", Name, FRTShown(Path).Text);
		}
		Renderer.ShaderHeaders.push_back(MakeHeader(Path));
	}
	*Out = new FModuleRenderer(*this, *Device, FModuleWorld(Desc), std::move(Renderer));
	return FRTStatus::Success();
}

FRTStatus FModule::SetQuality(const std::string& Group, const char* Value)
{
	const std::optional<ERTQuality> Quality = ParseQuality(Value);
	if (!Quality || ConfigFolder.empty())
	{
		return FRTStatus::Error(
		    ERTResult::InvalidArgument, "sg.%s=%s: no such level, or no config folder", FRTShown(Group.c_str()).Text, FRTShown(Value).Text);
	}
	const FConfigProblems Problems = LoadScalabilityGroup({ConfigFolder}, Group, *Quality);
	return Problems.empty() ? FRTStatus::Success() : FRTStatus::Error(ERTResult::InvalidArgument, "%s", Problems.front().c_str());
}

FRTStatus FModule::SetConsoleVariable(const char* Name, const char* Value)
{
	if (Name == nullptr || Value == nullptr) { return RefuseNull("SetConsoleVariable", Name == nullptr ? "Name" : "Value"); }
	const std::string Text = Name;
	if (Text.rfind("sg.", 0) == 0) { return SetQuality(Text.substr(3), Value); }
	const std::optional<std::string> Problem = FConsoleVariables::Get().Set(Text, Value, ERTSetBy::Console, "SetConsoleVariable");
	return Problem ? FRTStatus::Error(ERTResult::InvalidArgument, "%s", Problem->c_str()) : FRTStatus::Success();
}

FRTStatus FModule::GetConsoleVariable(const char* Name, char* Out, size_t Capacity)
{
	if (Name == nullptr || Out == nullptr) { return RefuseNull("GetConsoleVariable", Name == nullptr ? "Name" : "Out"); }
	if (Capacity == 0) { return FRTStatus::Error(ERTResult::InvalidArgument, "GetConsoleVariable: Capacity is 0"); }
	const FRTConsoleVariable* Variable = FConsoleVariables::Get().Find(Name);
	if (Variable == nullptr)
	{
		return FRTStatus::Error(ERTResult::InvalidArgument, "no console variable is called \"%s\"", FRTShown(Name).Text);
	}
	std::snprintf(Out, Capacity, "%s", FConsoleVariables::ToString(Variable->GetValue()).c_str());
	return FRTStatus::Success();
}

} // namespace

} // namespace Lantern

extern "C" __attribute__((visibility("default"))) int32_t LanternCreateModule(uint32_t RequestedVersion, Lantern::IRTModule** Out)
{
	using namespace Lantern;
	if (Out == nullptr) { return static_cast<int32_t>(ERTResult::InvalidArgument); }
	*Out = nullptr;
	if (RequestedVersion != ModuleVersion) { return static_cast<int32_t>(ERTResult::Unsupported); }
	if (bModuleAlive.exchange(true)) { return static_cast<int32_t>(ERTResult::InvalidArgument); }
	*Out = new FModule;
	return static_cast<int32_t>(ERTResult::Ok);
}
