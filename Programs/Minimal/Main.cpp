// Minimal: an engine's smallest use of the plugin. A camera looks down on a floor and a box; Lantern traces the shadow of the sun.
// Usage: Minimal PLUGIN.JSON LIBRARY_FOLDER [--validate]. It prints the shadow, and exits with 1 unless the shadow lies where it must.
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <initializer_list>
#include <string>

#include <dlfcn.h>
#include <nlohmann/json.hpp>

#include "LanternModule/Module.h"

using namespace Lantern;

namespace
{

constexpr uint32_t Size = 32, Pixels = Size * Size;    // the picture is a square
constexpr float Near = 0.1f, FovY = 1.5707964f;        // 90 degrees
constexpr float CameraHeight = 6.0f, BoxHeight = 2.0f; // metres above the floor
constexpr uint16_t Lit = 0x3c00, Shadowed = 0;         // 1 and 0 in half precision

// A cube from −1 to 1. Bits 0, 1 and 2 of a vertex's number choose the sides of x, y and z.
constexpr float Positions[] = {-1, -1, -1, 1, -1, -1, -1, 1, -1, 1, 1, -1, -1, -1, 1, 1, -1, 1, -1, 1, 1, 1, 1, 1};
constexpr uint32_t Indices[] = {1, 3, 7, 1, 7, 5, 0, 4, 6, 0, 6, 2, 2, 6, 7, 2, 7, 3, 0, 1, 5, 0, 5, 4, 4, 5, 7, 4, 7, 6, 0, 2, 3, 0, 3, 1};

void Require(bool bHolds, const char* What)
{
	if (bHolds) { return; }
	std::fflush(stdout);
	std::fprintf(stderr, "Minimal: %s\n", What);
	std::_Exit(1); // at once: the plugin's threads may be at work
}

void Check(const FRTStatus& Status) { Require(Status.IsOk(), Status.Message); }

std::string GetText(const nlohmann::json& Manifest, const char* Key)
{
	const auto Found = Manifest.find(Key);
	const auto Text = Found != Manifest.end() ? Found->get_ptr<const std::string*>() : nullptr;
	Require(Text != nullptr, "Plugin.json cannot be read, or lacks an entry");
	return *Text;
}

/// The engine's part of a frame: a command buffer, a G-buffer, and a buffer through which the CPU reads the shadow.
struct FEngineFrame
{
	using enum ERTAccess;
	explicit FEngineFrame(IRTDevice& InDevice) : Device(InDevice)
	{
		Check(Device.CreateCommandList("Frame", List.ReleaseAndGetAddress()));
		Check(List->Begin());
		// Lantern takes any command buffer that is being recorded. An engine has a VkCommandBuffer of its own; this one is a list's.
		Check(Device.ImportCommandList(List->GetNative(ERTNative::CommandBuffer), Commands.ReleaseAndGetAddress()));
		constexpr ERTTextureUsage Usage = ERTTextureUsage::Sampled | ERTTextureUsage::CopyDest;
		Check(Device.CreateTexture({Size, Size, 1, 1, ERTFormat::R32_FLOAT, Usage, "Depth"}, Depth.ReleaseAndGetAddress()));
		Check(Device.CreateTexture({Size, Size, 1, 1, ERTFormat::RGBA16_SNORM, Usage, "Normals"}, Normals.ReleaseAndGetAddress()));
		TRTRef<IRTBuffer> Texels;
		Check(Device.CreateBuffer({Pixels * 4, ERTBufferUsage::CopySource, ERTMemory::Upload, "Depth"}, Texels.ReleaseAndGetAddress()));
		for (uint32_t Pixel = 0; Pixel < Pixels; ++Pixel)
		{
			// At a distance of d the picture reaches d from its middle. Only the top of the box is seen.
			const float X = std::abs((Pixel % Size + 0.5f) * 2 / Size - 1), Y = std::abs((Pixel / Size + 0.5f) * 2 / Size - 1);
			const bool bBox = std::fmax(X, Y) * (CameraHeight - BoxHeight) < 1.0f;
			static_cast<float*>(Texels->GetMapped())[Pixel] = Near / (bBox ? CameraHeight - BoxHeight : CameraHeight);
		}
		Barriers({{nullptr, Depth.Get(), None, CopyWrite}, {nullptr, Normals.Get(), None, CopyWrite}});
		List->CopyBufferToTexture(Depth.Get(), 0, 0, Texels.Get(), 0);
		constexpr float Up[] = {0, 1, 0, 1}; // shading and geometric normal, each (0, 1, 0) in octahedral form
		List->ClearTexture(Normals.Get(), Up);
		Barriers({{nullptr, Depth.Get(), CopyWrite, ShaderRead}, {nullptr, Normals.Get(), CopyWrite, ShaderRead}});
	}

	/// Copies the shadow to where the CPU can read it, and submits all that was recorded.
	void Submit(IRTTexture* Shadow)
	{
		Require(Shadow != nullptr && Shadow->GetDesc().Format == ERTFormat::R16_FLOAT, "the plugin gave no shadow");
		Check(Device.CreateBuffer({Pixels * 2, ERTBufferUsage::CopyDest, ERTMemory::Readback, "Shadow"}, Readback.ReleaseAndGetAddress()));
		Barriers({{nullptr, Shadow, ShaderRead, CopyRead}});
		List->CopyTextureToBuffer(Readback.Get(), 0, Shadow, 0, 0);
		Barriers({{nullptr, Shadow, CopyRead, ShaderRead}, {Readback.Get(), nullptr, CopyWrite, HostRead}});
		Check(List->End());
		IRTCommandList* const Lists[] = {List.Get()};
		Check(Device.Submit(Lists, 1, nullptr));
	}

	void Barriers(std::initializer_list<FRTBarrier> Items) { List->Barriers(Items.begin(), uint32_t(Items.size())); }

	IRTDevice& Device;
	FRTModuleView View = {{0, CameraHeight, 0}, {0, -1, 0}, {0, 0, -1}, MakeProjection(FovY, 1.0f, Near)}; // straight down
	TRTRef<IRTCommandList> List, Commands;
	TRTRef<IRTTexture> Depth, Normals;
	TRTRef<IRTBuffer> Readback;
};

} // namespace

int main(int Count, char** Arguments)
{
	const bool bValidate = Count == 4 && std::strcmp(Arguments[3], "--validate") == 0;
	Require(Count == 3 || bValidate, "usage: Minimal PLUGIN.JSON LIBRARY_FOLDER [--validate]");
	const nlohmann::json Manifest = nlohmann::json::parse(std::ifstream(Arguments[1]), nullptr, false);
	const auto Folder = std::filesystem::path(Arguments[1]).parent_path(), Libraries = std::filesystem::path(Arguments[2]);
	const std::string ConfigFolder = Folder / GetText(Manifest, "configFolder"), ShaderFolder = Folder / GetText(Manifest, "shaderFolder");

	// README begin
	void* const Library = dlopen((Libraries / GetText(Manifest, "library")).c_str(), RTLD_NOW | RTLD_LOCAL);
	Require(Library != nullptr, "the plugin's library cannot be loaded");
	const auto Create = reinterpret_cast<FRTCreateModule>(dlsym(Library, GetText(Manifest, "entryPoint").c_str()));
	TRTRef<IRTModule> Module;
	Require(Create != nullptr && Create(ModuleVersion, Module.ReleaseAndGetAddress()) == 0, "the library has another version");
	Check(Module->Initialize({ConfigFolder.c_str(), ShaderFolder.c_str()}));
	Check(Module->SetConsoleVariable("r.RT.Pipeline.Fallback", "2"));    // a frame waits for its shaders
	Check(Module->SetConsoleVariable("r.RT.Upload.TransferQueue", "0")); // and finds its meshes
	TRTRef<IRTDevice> Device;                                            // or AdoptDevice, for an engine's VkDevice
	Check(Module->CreateDevice(bValidate, Device.ReleaseAndGetAddress()));
	TRTRef<IRTModuleRenderer> Renderer;
	Check(Module->CreateRenderer(Device.Get(), {}, Renderer.ReleaseAndGetAddress()));
	ERTMaterialHandle White = ERTMaterialHandle::None;
	ERTMeshHandle Cube = ERTMeshHandle::None;
	ERTObjectHandle Floor, Box; // by which an engine moves them
	Check(Renderer->AddMaterial({}, &White));
	Check(Renderer->AddMesh({.Positions = Positions, .VertexCount = 8, .Indices = Indices, .IndexCount = 36}, &Cube));
	Check(Renderer->AddObject({Cube, &White, 1, {9, 0, 0, 0, 0, 1, 0, -1, 0, 0, 9, 0}}, &Floor)); // 18 m × 18 m, its top at y = 0
	Check(Renderer->AddObject({Cube, &White, 1, {1, 0, 0, 0, 0, 1, 0, 1, 0, 0, 1, 0}}, &Box));    // stands on the floor
	Check(Renderer->SetSun({.Direction = {1, -1, 0}, .Irradiance = 1.0f}));

	FEngineFrame Engine(*Device);
	FRTModuleOutputs Outputs;
	Check(Renderer->RenderFrame({Engine.Commands.Get(), Engine.View, Engine.Depth.Get(), Engine.Normals.Get()}, &Outputs));
	Engine.Submit(Outputs.Get(ESignal::SunShadow));
	Check(Renderer->EndFrame(nullptr));
	// README end

	Check(Device->WaitIdle());
	const auto* const Shadow = static_cast<const uint16_t*>(Engine.Readback->GetMapped());
	for (uint32_t Pixel = 0; Pixel < Pixels; ++Pixel)
	{
		std::printf("%s%s", Shadow[Pixel] == Lit ? ".." : "##", (Pixel + 1) % Size ? "" : "\n");
	}
	Require(Shadow[16 * Size + 22] == Shadowed, "the floor behind the box, seen from the sun, must be in shadow");
	Require(Shadow[16 * Size + 9] == Lit && Shadow[16 * Size + 16] == Lit, "the floor before the box and the box's top must be lit");
	Require(Device->GetValidationMessageCount() == 0, "the Vulkan validation layers found a fault");
	return 0;
}
