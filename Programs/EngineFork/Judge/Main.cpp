// EngineFork: runs the example engine (Example/ForkEngine.h) and judges its pictures. Every pixel of the shadow mask is compared with
// rays on the CPU, and ambient occlusion with what is plausible.
//
// Exit status: 0 done, 1 a check did not hold, 2 wrong usage, 3 no usable driver or device.
#include <cstdio>
#include <cstdlib>
#include <string>

#include "Example/PluginLoader.h"
#include "Judge/Checks.h"

using namespace Fork;
using namespace Lantern;

namespace
{

enum EExit
{
	Done = 0,
	CheckFailed = 1,
	WrongUsage = 2,
	NoDevice = 3,
};

struct FOptions
{
	std::string Plugin = "Plugin.json", LibraryFolder = ".", Pictures;
	// For those frames that want it. A history would bring some of the lamp that was before.
	FSettings Settings = {{"r.RT.GI", "1"}, {"r.RT.GI.Denoise", "0"}};
	glm::dvec3 Offset{0};
	int Rounds = 1;
	bool bChanges = true; ///< of the round: also judges what changes in the scene
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
	else if (Name == "-o") { Out.Pictures = Value; }
	else if (Name == "--rounds") { Out.Rounds = std::atoi(Value.c_str()); }
	else if (Name == "--set" && Equals != std::string::npos)
	{
		Out.Settings.emplace_back(Value.substr(0, Equals), Value.substr(Equals + 1));
	}
	else if (Name == "--offset") { return std::sscanf(Value.c_str(), "%lf,%lf,%lf", &Out.Offset.x, &Out.Offset.y, &Out.Offset.z) == 3; }
	else { return false; }
	return true;
}

/// The device and all that lives on it are gone when this returns.
int RunOnInstance(IRTModule& Module, const FForkInstance& Instance, const FOptions& Options)
{
	const FForkScene Scene = MakeScene(At(Options.Offset.x, Options.Offset.y, Options.Offset.z));
	FForkEngine Engine(Module, Instance);
	if (const FError Error = Engine.CreateDevice(); !Error.empty()) { return Complain(NoDevice, Error); }
	FError Error = Engine.LoadScene(Scene);
	if (Error.empty()) { Error = CheckScenes(Engine, Scene, Options.Pictures, Options.bChanges); }
	return Error.empty() ? Done : Complain(CheckFailed, Error);
}

int RunWithModule(IRTModule& Module, const FPluginManifest& Manifest, const FOptions& Options)
{
	FError Error = InitializeModule(Module, Manifest, Options.Settings);
	if (!Error.empty()) { return Complain(CheckFailed, Error); }
	FForkInstance Instance;
	Error = Instance.Create();
	if (!Error.empty()) { return Complain(NoDevice, Error); }
	if (!Instance.bValidation)
	{
		std::fprintf(stderr, "EngineFork: the Vulkan validation layer is not installed: wrong use goes unseen\n");
	}
	const int Exit = RunOnInstance(Module, Instance, Options);
	if (Instance.ValidationMessages != 0) // includes those about objects that outlived the device
	{
		return Complain(CheckFailed, std::to_string(Instance.ValidationMessages) + " validation messages");
	}
	return Exit;
}

/// Loads the plugin, renders, judges, and unloads the plugin.
int RunRound(const FPluginManifest& Manifest, const FOptions& Options)
{
	FPluginLibrary Library;
	FError Error = Library.Load(Manifest, Options.LibraryFolder);
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
			                            " [--offset X,Y,Z] [--rounds N] [-o MASKS]");
		}
	}
	FPluginManifest Manifest;
	if (const FError Error = ReadManifest(Options.Plugin, Manifest); !Error.empty()) { return Complain(CheckFailed, Error); }
	int Exit = Done;
	for (int Round = 0; Exit == Done && Round < Options.Rounds; ++Round)
	{
		Options.bChanges = Round == 0; // later rounds show that the first left nothing behind
		Exit = RunRound(Manifest, Options);
	}
	return Exit;
}
