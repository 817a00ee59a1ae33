// Programs under the layer's synchronization validation: every message is one that Docs/Drivers.md explains.
#include "ProgramTools.h"
#include "Support/SynchronizationMessages.h"

namespace Lantern
{
namespace
{

/// Program: path; empty: lantern. Closing: part of what the program says at its end if there were messages.
void ExpectExplained(const char* Program, const std::vector<std::string>& Arguments, const char* Closing)
{
	FProgramOptions Options;
	Options.Program = Program;
	// What the layer keeps until the process ends is nobody's once it is unloaded, so the leak checker would blame the program.
	Options.Environment = {
	    {"VK_LAYER_ENABLES", "VK_VALIDATION_FEATURE_ENABLE_SYNCHRONIZATION_VALIDATION_EXT"}, {"ASAN_OPTIONS", "detect_leaks=0"}};
	const FProgramRun Run = RunProgram(Arguments, Options);
	FSynchronizationMessages Messages;
	for (const std::string& Line : Run.GetMessages())
	{
		if (Line.find(Closing) == std::string::npos) { Messages.Add(Line); }
	}
	EXPECT_THAT(Messages.Others, testing::IsEmpty());
	EXPECT_EQ(Run.Status, Messages.Supposed.empty() ? 0 : 1) << "programs fail by a message, and by nothing else";
}

TEST(SynchronizationTest, RenderWithRayQueries)
{
	ExpectExplained("", {"render", "courtyard", "--size", "64x36", "--frames", "3", "--validate"}, "validation: ");
}

TEST(SynchronizationTest, RenderWithPipelinesAndEverySignal)
{
	ExpectExplained("",
	    {"render", "courtyard", "--size", "64x36", "--frames", "2", "--validate", "--set", "r.RT.Shadow.Path=1", "--set", "r.RT.AO.Path=1",
	        "--set", "r.RT.GI=1", "--set", "r.RT.Reflections=1"},
	    "validation: ");
}

TEST(SynchronizationTest, RenderWithScreenProbesAndRadianceCells)
{
	ExpectExplained("", {"render", "courtyard", "--size", "64x36", "--frames", "3", "--validate", "--set", "r.RT.GI=2"}, "validation: ");
}

TEST(SynchronizationTest, SmallestEngine)
{
	ExpectExplained(LANTERN_MINIMAL, {LANTERN_SOURCE_DIR "/Plugin.json", LANTERN_LIBRARY_FOLDER, "--validate"}, "validation layers");
}

TEST(SlowSynchronizationTest, EngineFork)
{
	ExpectExplained(LANTERN_ENGINE_FORK, {"--plugin", LANTERN_SOURCE_DIR "/Plugin.json", "--library-folder", LANTERN_LIBRARY_FOLDER},
	    "validation messages");
}

} // namespace
} // namespace Lantern
