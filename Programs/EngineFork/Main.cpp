// EngineFork: an engine that loads Lantern by its Plugin.json, on a VkDevice of its own, and checks every pixel of the
// shadow mask that it gets against the closed form, and that ambient occlusion is about where it must be. A user's first example, and a test.
//
// Exit status: 0 done, 1 a check did not hold, 2 wrong usage, 3 no usable driver or device.
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <thread>
#include <vector>

#include <glm/gtc/packing.hpp>

#include "ForkRaster.h"
#include "ForkScene.h"
#include "ForkText.h"
#include "ForkVulkan.h"
#include "PluginLoader.h"
#include "PluginScene.h"

using namespace Fork;
using namespace Lantern;

namespace
{

constexpr VkExtent2D FrameSize{320, 180};
constexpr uint32_t PixelCount = FrameSize.width * FrameSize.height;
constexpr VkDeviceSize MaskBytes = PixelCount * 2; ///< of each that is read back: halves
constexpr int FrameCount = 3;                      ///< the later ones find everything built
constexpr int MostFramesUntilComplete = 600'000;   ///< each takes a millisecond at least: ends what would never end
constexpr int FramesPerLine = 5'000;

enum EExit
{
	Done = 0,
	CheckFailed = 1,
	WrongUsage = 2,
	NoDevice = 3,
};

struct FOptions
{
	std::string Plugin = "Plugin.json", LibraryFolder = ".", Picture;
	std::vector<std::pair<std::string, std::string>> Settings;
	glm::dvec3 Offset{0};
	int Rounds = 1;
};

int Complain(int Exit, const std::string& Text)
{
	std::fprintf(stderr, "EngineFork: %s\n", Show(Text).c_str());
	return Exit;
}

bool ParseOption(const std::string& Name, const std::string& Value, FOptions& Out)
{
	const size_t Equals = Value.find('=');
	if (Name == "--plugin") { Out.Plugin = Value; }
	else if (Name == "--library-folder") { Out.LibraryFolder = Value; }
	else if (Name == "-o") { Out.Picture = Value; }
	else if (Name == "--rounds") { Out.Rounds = std::atoi(Value.c_str()); }
	else if (Name == "--set" && Equals != std::string::npos)
	{
		Out.Settings.emplace_back(Value.substr(0, Equals), Value.substr(Equals + 1));
	}
	else if (Name == "--offset") { return std::sscanf(Value.c_str(), "%lf,%lf,%lf", &Out.Offset.x, &Out.Offset.y, &Out.Offset.z) == 3; }
	else { return false; }
	return true;
}

/// What of the mask is as it must be.
struct FVerdict
{
	uint32_t Lit = 0, Shadowed = 0, Sky = 0, Unsure = 0, Wrong = 0;
};

FVerdict Judge(const FForkScene& Scene, const uint16_t* Mask)
{
	FVerdict Verdict;
	for (uint32_t Y = 0; Y < FrameSize.height; ++Y)
	{
		for (uint32_t X = 0; X < FrameSize.width; ++X)
		{
			const EExpectation Expected = ExpectPixel(Scene, X, Y, FrameSize.width, FrameSize.height);
			const float Found = glm::unpackHalf1x16(Mask[Y * FrameSize.width + X]);
			const float Right = Expected == EExpectation::Shadowed ? 0.0f : 1.0f;
			Verdict.Wrong += Expected != EExpectation::Unsure && Found != Right;
			Verdict.Unsure += Expected == EExpectation::Unsure;
			Verdict.Sky += Expected == EExpectation::Sky;
			Verdict.Lit += Expected == EExpectation::Lit;
			Verdict.Shadowed += Expected == EExpectation::Shadowed;
		}
	}
	return Verdict;
}

/// The boxes occlude the floor about them, and little else. What the filter makes of it has no closed form here: Lantern's
/// own tests know better.
FError JudgeOcclusion(const uint16_t* Visibility)
{
	uint32_t Open = 0;
	for (uint32_t Pixel = 0; Pixel < PixelCount; ++Pixel)
	{
		const float Found = glm::unpackHalf1x16(Visibility[Pixel]);
		if (!(Found >= 0.0f && Found <= 1.01f)) { return "ambient occlusion is " + std::to_string(Found) + " somewhere"; }
		Open += Found > 0.95f;
	}
	const uint32_t Occluded = PixelCount - Open;
	std::printf("ambient occlusion: %u open, %u occluded\n", Open, Occluded);
	return Open > PixelCount / 2 && Occluded > PixelCount / 500 ? FError() : "ambient occlusion is not where it must be";
}

bool WritePicture(const std::string& Path, const uint16_t* Mask)
{
	std::FILE* File = std::fopen(Path.c_str(), "wb");
	if (File == nullptr) { return false; }
	std::fprintf(File, "P5\n%u %u\n255\n", FrameSize.width, FrameSize.height);
	for (uint32_t Pixel = 0; Pixel < PixelCount; ++Pixel)
	{
		std::fputc(static_cast<int>(glm::unpackHalf1x16(Mask[Pixel]) * 255.0f + 0.5f), File);
	}
	return std::fclose(File) == 0;
}

/// The plugin leaves its outputs readable by shaders; the engine copies them and puts them back as they were.
void CopyMask(VkCommandBuffer Commands, IRTTexture& Mask, const FForkBuffer& Readback, VkDeviceSize Offset)
{
	const auto Image = reinterpret_cast<VkImage>(Mask.GetNative(ERTNative::Image));
	Transition(Commands, Image, VK_IMAGE_ASPECT_COLOR_BIT, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL);
	VkBufferImageCopy Region{};
	Region.bufferOffset = Offset;
	Region.imageSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1};
	Region.imageExtent = {FrameSize.width, FrameSize.height, 1};
	vkCmdCopyImageToBuffer(Commands, Image, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, Readback.Buffer, 1, &Region);
	Transition(Commands, Image, VK_IMAGE_ASPECT_COLOR_BIT, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL);
}

/// What the checks look at.
struct FStage
{
	FForkDevice& Device;
	FPluginScene& Plugin;
	const FForkRaster& Raster;
	const FForkBuffer& Readback;
};

/// One frame of the engine: its own raster, the plugin's signals, a copy to where the CPU can look.
FError RunFrame(FStage& Stage, const FForkScene& Scene, bool bCut, bool& bOutHasMask)
{
	auto& [Device, Plugin, Raster, Readback] = Stage;
	FError Error = Device.BeginCommands();
	if (!Error.empty()) { return Error; }
	Raster.Draw(Device.Commands, Scene);
	FRTModuleOutputs Outputs;
	Error = Plugin.Render(Device.Commands, Scene.Camera, bCut, Outputs);
	if (!Error.empty()) { return Error; }
	VkDeviceSize Offset = 0;
	bOutHasMask = Outputs.Get(ESignal::SunShadow) != nullptr && Outputs.Get(ESignal::AmbientOcclusion) != nullptr;
	for (IRTTexture* Mask : {Outputs.Get(ESignal::SunShadow), Outputs.Get(ESignal::AmbientOcclusion)})
	{
		if (Mask != nullptr && Mask->GetDesc().Format != ERTFormat::R16_FLOAT)
		{
			return "an output has another format than this engine reads";
		}
		if (Mask != nullptr) { CopyMask(Device.Commands, *Mask, Readback, Offset); }
		Offset += MaskBytes;
	}
	Error = Device.Submit();
	if (Error.empty()) { Error = Plugin.FinishFrame(); }
	return Error.empty() ? Device.WaitForSubmit() : Error;
}

/// Some frames of the scene as it is now, then every pixel of the last mask against the truth.
FError CheckScene(FStage& Stage, const FForkScene& Scene, const char* What)
{
	FError Error;
	bool bHasMask = false;
	// The plugin waits for nothing: its first frames may be without shadows.
	for (int Frame = 0; Error.empty() && Frame < MostFramesUntilComplete; ++Frame)
	{
		Error = RunFrame(Stage, Scene, Frame == 0, bHasMask); // boxes have jumped since the scene before
		if (Stage.Plugin.IsComplete()) { break; }
		if (Frame % FramesPerLine == FramesPerLine - 1)
		{
			std::fprintf(stderr, "EngineFork: frame %d, and the plugin still compiles\n", Frame + 1);
		}
		std::this_thread::sleep_for(std::chrono::milliseconds(1));
	}
	for (int Frame = 0; Error.empty() && Frame < FrameCount; ++Frame) { Error = RunFrame(Stage, Scene, false, bHasMask); }
	if (!Error.empty() || !bHasMask) { return Error.empty() ? "the plugin gave no shadow mask, or no ambient occlusion" : Error; }
	Error = JudgeOcclusion(static_cast<const uint16_t*>(Stage.Readback.Mapped) + PixelCount);
	if (!Error.empty()) { return Error; }
	const FVerdict Verdict = Judge(Scene, static_cast<const uint16_t*>(Stage.Readback.Mapped));
	std::printf("%s: %u lit, %u shadowed, %u sky, %u near an edge; wrong: %u\n", What, Verdict.Lit, Verdict.Shadowed, Verdict.Sky,
	    Verdict.Unsure, Verdict.Wrong);
	// Enough of each that agreeing means something.
	const bool bMeaningful = Verdict.Lit > 5000 && Verdict.Shadowed > 1000 && Verdict.Sky > 2000;
	return Verdict.Wrong == 0 && bMeaningful ? FError() : std::string(What) + ": the shadows are not where they must be";
}

FError CheckMoved(FStage& Stage, FForkScene& Scene)
{
	Scene.Boxes[2].Centre += glm::dvec3(-3.0, 0.0, 4.0);
	FError Error = Stage.Plugin.MoveBox(2, Scene.Boxes[2]);
	Scene.Boxes.erase(Scene.Boxes.begin() + 1);
	if (Error.empty()) { Error = Stage.Plugin.RemoveBox(1); }
	return Error.empty() ? CheckScene(Stage, Scene, "pillar moved, cube gone") : Error;
}

/// Boxes as CheckMoved left them: floor, pillar, slab, cut-out.
FError CheckChanged(FStage& Stage, FForkScene& Scene)
{
	constexpr float Scale = 0.75f;
	Scene.Boxes[1].HalfSize *= Scale;
	FError Error = Stage.Plugin.ScaleVertices(Scale);
	Scene.Boxes[2].bCastsShadow = true;
	Scene.Boxes[3].bCutOut = false;
	for (size_t Box = 2; Error.empty() && Box <= 3; ++Box) { Error = Stage.Plugin.SetBox(Box, Scene.Boxes[Box]); }
	return Error.empty() ? CheckScene(Stage, Scene, "pillar deformed, slab and cut-out cast shadows") : Error;
}

/// As it was made, then changed as in a game.
FError CheckScenes(FStage& Stage, FForkScene Scene, const FOptions& Options)
{
	FError Error = CheckScene(Stage, Scene, "as made");
	if (Error.empty() && !Options.Picture.empty() && !WritePicture(Options.Picture, static_cast<const uint16_t*>(Stage.Readback.Mapped)))
	{
		Error = Options.Picture + " cannot be written";
	}
	if (!Error.empty()) { return Error; }
	Error = CheckMoved(Stage, Scene);
	return Error.empty() ? CheckChanged(Stage, Scene) : Error;
}

int RenderAndCheck(FForkDevice& Device, FPluginScene& Plugin, const FOptions& Options)
{
	const FForkScene Scene = MakeScene(Options.Offset);
	FForkRaster Raster;
	FForkBuffer Readback;
	FError Error = Raster.Create(Device, FrameSize);
	if (Error.empty()) { Error = Readback.Create(Device, 2 * MaskBytes, VK_BUFFER_USAGE_TRANSFER_DST_BIT); }
	if (Error.empty()) { Error = Plugin.AddScene(Scene); }
	if (Error.empty()) { Error = Plugin.ImportGBuffer(Raster, FrameSize); }
	if (Error.empty())
	{
		FStage Stage{Device, Plugin, Raster, Readback};
		Error = CheckScenes(Stage, Scene, Options);
	}
	Plugin.ReleaseGBuffer();
	return Error.empty() ? Done : Complain(CheckFailed, Error);
}

/// The first device that the plugin can use, created with what it asks for.
FError CreateDevice(IRTModule& Module, const FForkInstance& Instance, FForkDevice& Out, TRTRef<IRTVulkanRequirements>& OutRequirements)
{
	FError Reasons = "no Vulkan device";
	for (VkPhysicalDevice Physical : Instance.ListDevices())
	{
		FRTVulkanRequirementsDesc Desc;
		Desc.Instance = Instance.Instance;
		Desc.PhysicalDevice = Physical;
		const FRTStatus Status = Module.GetVulkan()->GetRequirements(Desc, OutRequirements.ReleaseAndGetAddress());
		if (!Status.IsOk())
		{
			Reasons += std::string("; ") + Status.Message;
			continue;
		}
		const IRTVulkanRequirements& Requirements = *OutRequirements;
		FDeviceWishes Wishes;
		Wishes.Extensions.assign(Requirements.GetExtensions(), Requirements.GetExtensions() + Requirements.GetExtensionCount());
		Wishes.MergeFeatures = [&](VkPhysicalDeviceFeatures2* Chain) { OutRequirements->MergeInto(Chain); };
		std::printf("device: %s, %s\n", Requirements.GetCapabilities().DeviceName, Requirements.GetCapabilities().DriverName);
		return Out.Create(Physical, Wishes);
	}
	return Reasons;
}

FRTModuleDesc DescribeModule(const FPluginManifest& Manifest)
{
	FRTModuleDesc Desc;
	Desc.ConfigFolder = Manifest.ConfigFolder.c_str();
	Desc.ShaderFolder = Manifest.ShaderFolder.c_str();
	Desc.LogCallback = [](void*, ERTModuleLog Level, const char* Text) {
		if (Level >= ERTModuleLog::Warning) { std::fprintf(stderr, "plugin: %s\n", Show(Text).c_str()); }
	};
	return Desc;
}

/// The device and all that lives on it are gone when this returns.
int RunOnInstance(IRTModule& Module, const FForkInstance& Instance, const FOptions& Options)
{
	FForkDevice Device;
	TRTRef<IRTVulkanRequirements> Requirements;
	FError Error = CreateDevice(Module, Instance, Device, Requirements);
	if (!Error.empty()) { return Complain(NoDevice, Error); }
	FPluginScene Plugin;
	Error = Plugin.Create(Module, Instance, Device, *Requirements);
	return Error.empty() ? RenderAndCheck(Device, Plugin, Options) : Complain(CheckFailed, Error);
}

int RunWithModule(IRTModule& Module, const FPluginManifest& Manifest, const FOptions& Options)
{
	FError Error = ToError(Module.Initialize(DescribeModule(Manifest)), "Initialize");
	for (size_t Index = 0; Error.empty() && Index < Options.Settings.size(); ++Index)
	{
		const auto& [Name, Value] = Options.Settings[Index];
		Error = ToError(Module.SetConsoleVariable(Name.c_str(), Value.c_str()), "SetConsoleVariable");
	}
	if (!Error.empty()) { return Complain(CheckFailed, Error); }
	FForkInstance Instance;
	Error = Instance.Create();
	if (!Error.empty()) { return Complain(NoDevice, Error); }
	if (!Instance.bValidation)
	{
		std::fprintf(stderr, "EngineFork: the Vulkan validation layer is not installed: wrong use goes unseen\n");
	}
	const int Exit = RunOnInstance(Module, Instance, Options);
	if (Instance.ValidationMessages != 0) // also of the device's end: what was left undestroyed
	{
		return Complain(CheckFailed, std::to_string(Instance.ValidationMessages) + " validation messages");
	}
	return Exit;
}

/// Loads, renders, unloads.
int RunRound(const FPluginManifest& Manifest, const FOptions& Options)
{
	FPluginLibrary Library;
	std::string Error = Library.Load(Manifest, Options.LibraryFolder);
	TRTRef<IRTModule> Module;
	if (Error.empty()) { Error = Library.CreateModule(Module); }
	if (!Error.empty()) { return Complain(CheckFailed, Error); }
	std::printf("plugin: %s %s\n", Show(Manifest.Name).c_str(), Module->GetVersionString());
	const int Exit = RunWithModule(*Module, Manifest, Options);
	Module.Reset();
	if (!Library.Unload()) { return Complain(CheckFailed, "the library is still in the process after unloading"); }
	return Exit;
}

} // namespace

int main(int Count, char** Arguments)
{
	FOptions Options;
	for (int Index = 1; Index < Count; Index += 2)
	{
		if (Index + 1 == Count || !ParseOption(Arguments[Index], Arguments[Index + 1], Options))
		{
			return Complain(WrongUsage, "usage: EngineFork [--plugin Plugin.json] [--library-folder FOLDER] [--set NAME=VALUE]"
			                            " [--offset X,Y,Z] [--rounds N] [-o MASK.pgm]");
		}
	}
	FPluginManifest Manifest;
	if (const std::string Error = ReadManifest(Options.Plugin, Manifest); !Error.empty()) { return Complain(CheckFailed, Error); }
	int Exit = Done;
	for (int Round = 0; Exit == Done && Round < Options.Rounds; ++Round) { Exit = RunRound(Manifest, Options); }
	return Exit;
}
