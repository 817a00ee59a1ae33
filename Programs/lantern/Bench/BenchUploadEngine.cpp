// FBenchUploadEngine: the library is loaded as an engine would load it, and its frames are timed.
#include "Bench/BenchUploadEngine.h"

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

FBenchUploadEngine::~FBenchUploadEngine()
{
	if (Device) { (void)Device->WaitIdle(); }
	if (Device && bMock) { GetMock(Device.Get()).SetManualFences(false); }
	for (FSlot& Slot : Slots) { Slot.List.Reset(); }
	Depth.Reset();
	Normals.Reset();
	Renderer.Reset();
	Device.Reset();
	Module.Reset();
	if (Library != nullptr) { dlclose(Library); }
}

FRTStatus FBenchUploadEngine::Load(const std::vector<std::string>& Settings)
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
	const std::string Cache = Folders.GetShaderCache();
	FRTModuleDesc Desc;
	Desc.ConfigFolder = Folders.Config.c_str();
	Desc.ShaderFolder = Folders.Shaders.c_str();
	Desc.CacheFolder = Cache.empty() ? nullptr : Cache.c_str();
	FRTStatus Status = Module->Initialize(Desc);
	for (const std::string& Setting : Settings)
	{
		const size_t Equals = Setting.find('=');
		if (Equals == std::string::npos) { return FRTStatus::Error(ERTResult::InvalidArgument, "--set NAME=VALUE"); }
		Status = Status ? Module->SetConsoleVariable(Setting.substr(0, Equals).c_str(), Setting.c_str() + Equals + 1) : Status;
	}
	return Status;
}

FRTStatus FBenchUploadEngine::MakeTextures()
{
	constexpr ERTTextureUsage Usage = ERTTextureUsage::Sampled | ERTTextureUsage::CopyDest;
	FRTStatus Status = Device->CreateTexture({Size, Size, 1, 1, ERTFormat::R32_FLOAT, Usage, "Depth"}, Depth.ReleaseAndGetAddress());
	return Status ? Device->CreateTexture({Size, Size, 1, 1, ERTFormat::RGBA16_SNORM, Usage, "Normals"}, Normals.ReleaseAndGetAddress())
	              : Status;
}

FRTStatus FBenchUploadEngine::Open(IRTDevice* Mock, bool bValidate, const std::vector<std::string>& Settings)
{
	bMock = Mock != nullptr;
	FRTStatus Status = Load(Settings);
	if (Status && bMock)
	{
		Device = TRTRef<IRTDevice>(Mock);
		GetMock(Mock).SetManualFences(true); // submissions hand over, as with a GPU, and do not execute within the measured time
	}
	else if (Status) { Status = Module->CreateDevice(bValidate, Device.ReleaseAndGetAddress()); }
	if (Status) { Status = MakeTextures(); }
	return Status ? Module->CreateRenderer(Device.Get(), {}, Renderer.ReleaseAndGetAddress()) : Status;
}

FRTStatus FBenchUploadEngine::FillTextures(IRTCommandList& List)
{
	constexpr float Far[] = {1.0f / 50.0f, 0, 0, 0}, Up[] = {0, 1, 0, 1};
	const auto Fill = [&](IRTTexture* Texture, const float* Value) {
		const FRTBarrier ToCopy{nullptr, Texture, ERTAccess::None, ERTAccess::CopyWrite};
		const FRTBarrier ToRead{nullptr, Texture, ERTAccess::CopyWrite, ERTAccess::ShaderRead};
		List.Barriers(&ToCopy, 1);
		List.ClearTexture(Texture, Value);
		List.Barriers(&ToRead, 1);
	};
	Fill(Depth.Get(), Far);
	Fill(Normals.Get(), Up);
	return FRTStatus::Success();
}

FRTStatus FBenchUploadEngine::BeginList(FSlot& Slot)
{
	// All but the last frame, as the renderer wants it.
	if (bMock) { GetMock(Device.Get()).CompleteUpTo(Slots[(FrameIndex + 1) % FramesInFlight].Fence); }
	FRTStatus Status = Device->WaitFor(Slot.Fence, WaitNs);
	if (Status && !Slot.List) { Status = Device->CreateCommandList("Engine", Slot.List.ReleaseAndGetAddress()); }
	Status = Status ? Slot.List->Begin() : Status;
	return Status && FrameIndex == 0 ? FillTextures(*Slot.List) : Status;
}

FRTStatus FBenchUploadEngine::Frame(FFrameTime& Out)
{
	FSlot& Slot = Slots[FrameIndex % FramesInFlight];
	if (FRTStatus Status = BeginList(Slot); !Status) { return Status; }
	TRTRef<IRTCommandList> Commands;
	const uint64_t Native = bMock ? MockCommandBuffer : Slot.List->GetNative(ERTNative::CommandBuffer);
	FRTStatus Status = Device->ImportCommandList(Native, Commands.ReleaseAndGetAddress());
	if (!Status) { return Status; }
	FRTModuleFrame Frame;
	Frame.Commands = Commands.Get();
	Frame.Depth = Depth.Get();
	Frame.Normals = Normals.Get();
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
