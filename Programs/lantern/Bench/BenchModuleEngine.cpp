// FBenchModuleEngine: the library is loaded as an engine would load it, and its frames are timed.
#include "Bench/BenchModuleEngine.h"

#include <filesystem>

#include <dlfcn.h>

#include "Bench/BenchTimes.h"
#include "LanternRHIMock/MockDevice.h"
#include "Session.h"

namespace Lantern
{

namespace
{
constexpr uint32_t Size = 64;
constexpr uint64_t WaitNs = 60'000'000'000ull;
constexpr uint64_t MockCommandBuffer = 1; // any number names one there

FRTStatus Fail(const std::string& Reason) { return FRTStatus::Error(ERTResult::IoError, "%s", Reason.c_str()); }
} // namespace

FBenchModuleEngine::~FBenchModuleEngine()
{
	if (Device) { (void)Device->WaitIdle(); }
	if (Device && Options.Mock != nullptr) { GetMock(Device.Get()).SetManualFences(false); }
	for (FSlot& Slot : Slots) { Slot.List.Reset(); }
	Depth.Reset();
	Normals.Reset();
	BaseColor.Reset();
	Material.Reset();
	Renderer.Reset();
	Device.Reset();
	Module.Reset();
	if (Library != nullptr) { dlclose(Library); }
}

FRTStatus FBenchModuleEngine::Load()
{
	std::error_code Error;
	const auto Path = std::filesystem::read_symlink("/proc/self/exe", Error).parent_path() / "libLantern.so";
	Library = dlopen(Path.c_str(), RTLD_NOW | RTLD_LOCAL);
	if (Library == nullptr) { return Fail(dlerror()); }
	const auto Create = reinterpret_cast<FRTCreateModule>(dlsym(Library, "LanternCreateModule"));
	if (Create == nullptr || Create(ModuleVersion, Module.ReleaseAndGetAddress()) != 0)
	{
		return Fail("libLantern.so has another version");
	}
	const FPluginFolders Folders = FindPluginFolders();
	const std::string Cache = Options.bCache ? Folders.GetShaderCache() : std::string();
	FRTModuleDesc Desc;
	Desc.ConfigFolder = Folders.Config.c_str();
	Desc.ShaderFolder = Folders.Shaders.c_str();
	Desc.CacheFolder = Cache.empty() ? nullptr : Cache.c_str();
	FRTStatus Status = Module->Initialize(Desc);
	for (const std::string& Setting : Options.Settings)
	{
		const size_t Equals = Setting.find('=');
		if (Equals == std::string::npos) { return FRTStatus::Error(ERTResult::InvalidArgument, "--set NAME=VALUE"); }
		Status = Status ? Module->SetConsoleVariable(Setting.substr(0, Equals).c_str(), Setting.c_str() + Equals + 1) : Status;
	}
	return Status;
}

FRTStatus FBenchModuleEngine::MakeTextures()
{
	constexpr ERTTextureUsage Usage = ERTTextureUsage::Sampled | ERTTextureUsage::CopyDest;
	const auto Make = [&](ERTFormat Format, const char* Name, TRTRef<IRTTexture>& Out) {
		return Device->CreateTexture({Size, Size, 1, 1, Format, Usage, Name}, Out.ReleaseAndGetAddress());
	};
	FRTStatus Status = Make(ERTFormat::R32_FLOAT, "Depth", Depth);
	Status = Status ? Make(ERTFormat::RGBA16_SNORM, "Normals", Normals) : Status;
	Status = Status ? Make(ERTFormat::RGBA8_SRGB, "BaseColor", BaseColor) : Status;
	return Status ? Make(ERTFormat::RGBA8_UNORM, "Material", Material) : Status;
}

FRTStatus FBenchModuleEngine::Open(const FOptions& InOptions)
{
	Options = InOptions;
	FRTStatus Status = Load();
	if (Status && Options.Mock != nullptr)
	{
		Device = TRTRef<IRTDevice>(Options.Mock);
		GetMock(Options.Mock).SetManualFences(true); // submissions hand over, as with a GPU, and do not execute within the measured time
	}
	else if (Status) { Status = Module->CreateDevice(Options.bValidate, Device.ReleaseAndGetAddress()); }
	if (Status) { Status = MakeTextures(); }
	return Status ? Module->CreateRenderer(Device.Get(), {}, Renderer.ReleaseAndGetAddress()) : Status;
}

FRTStatus FBenchModuleEngine::FillTextures(IRTCommandList& List)
{
	constexpr float Far[] = {1.0f / 50.0f, 0, 0, 0}, Up[] = {0, 1, 0, 1}, Grey[] = {0.5f, 0.5f, 0.5f, 0};
	const auto Fill = [&](IRTTexture* Texture, const float* Value) {
		const FRTBarrier ToCopy{nullptr, Texture, ERTAccess::None, ERTAccess::CopyWrite};
		const FRTBarrier ToRead{nullptr, Texture, ERTAccess::CopyWrite, ERTAccess::ShaderRead};
		List.Barriers(&ToCopy, 1);
		List.ClearTexture(Texture, Value);
		List.Barriers(&ToRead, 1);
	};
	Fill(Depth.Get(), Far);
	Fill(Normals.Get(), Up);
	Fill(BaseColor.Get(), Grey);
	Fill(Material.Get(), Grey);
	return FRTStatus::Success();
}

FRTStatus FBenchModuleEngine::BeginList(FSlot& Slot)
{
	// All but the last frame, as the renderer wants it.
	if (Options.Mock != nullptr) { GetMock(Device.Get()).CompleteUpTo(Slots[(FrameIndex + 1) % FramesInFlight].Fence); }
	FRTStatus Status = Device->WaitFor(Slot.Fence, WaitNs);
	if (Status && !Slot.List) { Status = Device->CreateCommandList("Engine", Slot.List.ReleaseAndGetAddress()); }
	Status = Status ? Slot.List->Begin() : Status;
	return Status && FrameIndex == 0 ? FillTextures(*Slot.List) : Status;
}

FRTStatus FBenchModuleEngine::Frame(FFrameTime& Out)
{
	FSlot& Slot = Slots[FrameIndex % FramesInFlight];
	if (FRTStatus Status = BeginList(Slot); !Status) { return Status; }
	TRTRef<IRTCommandList> Commands;
	const uint64_t Native = Options.Mock != nullptr ? MockCommandBuffer : Slot.List->GetNative(ERTNative::CommandBuffer);
	FRTStatus Status = Device->ImportCommandList(Native, Commands.ReleaseAndGetAddress());
	if (!Status) { return Status; }
	FRTModuleFrame Frame;
	Frame.Commands = Commands.Get();
	Frame.Depth = Depth.Get();
	Frame.Normals = Normals.Get();
	Frame.BaseColor = BaseColor.Get();
	Frame.Material = Material.Get();
	Frame.Wanted = Options.Wanted;
	Frame.View.Projection = MakeProjection(1.0f, 1.0f, 0.1f);
	FRTModuleOutputs Outputs;
	const auto Start = FBenchClock::now();
	const double ProcessorStart = GetThreadMs();
	Status = Renderer->RenderFrame(Frame, &Outputs);
	Out.Milliseconds = GetMsSince(Start);
	Out.ProcessorMilliseconds = GetThreadMs() - ProcessorStart;
	Out.bComplete = Outputs.bComplete;
	if (!Status) { return Status; }
	Status = Slot.List->End();
	IRTCommandList* const Lists[] = {Slot.List.Get()};
	Status = Status ? Device->Submit(Lists, 1, nullptr) : Status;
	const auto EndStart = FBenchClock::now();
	const double ProcessorEndStart = GetThreadMs();
	Status = Status ? Renderer->EndFrame(&Slot.Fence) : Status;
	Out.Milliseconds += GetMsSince(EndStart);
	Out.ProcessorMilliseconds += GetThreadMs() - ProcessorEndStart;
	++FrameIndex;
	return Status;
}

} // namespace Lantern
