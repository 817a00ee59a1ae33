// Wrong use and bad input: the right exit status, one clear message on standard error, nothing on standard output, and
// no file left behind.
#include <sys/stat.h>
#include <unistd.h>

#include "ProgramTools.h"

namespace Lantern
{
namespace
{

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

struct FUsage
{
	const char* Name;
	std::vector<std::string> Arguments;
	int Status;
	std::vector<std::string> Message; ///< parts that it must have
	friend void PrintTo(const FUsage& Usage, std::ostream* Out) { *Out << Usage.Name; }
};

class FUsageTest : public ::testing::TestWithParam<FUsage>
{};

TEST_P(FUsageTest, GetsOneClearMessage)
{
	const FTemporaryFolder Folder;
	Folder.Write("truncated.gltf", R"({"asset":{"version":"2.0"},"meshes":[{"primitives":[{"attrib)");
	Folder.Write("empty.glb", "");
	Folder.Write("text.png", "not a picture");
	Folder.Write("views.json", R"({"a.gltf": [{"name": "main"}, {"name": "night"}], "b.gltf": [{"name": "main", "camera": [1]}]})");
	const std::vector<std::string> Before = ListFolder(Folder.GetPath());
	FProgramOptions Options;
	Options.Folder = Folder.GetPath();
	const FProgramRun Run = RunProgram(GetParam().Arguments, Options);
	EXPECT_EQ(Run.Status, GetParam().Status) << Run.Err;
	EXPECT_EQ(Run.Out, "");
	ASSERT_EQ(Run.GetMessages().size(), 1u) << Run.Err;
	for (const std::string& Part : GetParam().Message) { EXPECT_THAT(Run.GetMessages()[0], HasSubstr(Part)); }
	EXPECT_LT(Run.GetMessages()[0].size(), 300u) << "a message is to be read";
	EXPECT_EQ(ListFolder(Folder.GetPath()), Before) << "something was left behind";
}

const FUsage Usages[] = {
    {"NoCommand", {}, 2, {"subcommand"}},
    {"WrongCommand", {"frobnicate"}, 2, {"frobnicate"}},
    {"WrongOption", {"render", "--nonsense"}, 2, {"--nonsense"}},
    {"OptionWithoutValue", {"render", "--size"}, 2, {"--size"}},
    {"SizeZero", {"render", "furnace", "--size", "0x0", "-o", "a.png"}, 2, {"0x0", "1 to"}},
    {"SizeHuge", {"render", "furnace", "--size", "100000x100000", "-o", "a.png"}, 2, {"100000x100000", "1 to"}},
    {"SizeHuger", {"render", "--size", "99999999999999999999x1"}, 2, {"--size"}},
    {"SizeOneSideZero", {"render", "--size", "0x720"}, 2, {"0x720"}},
    {"SizeNegative", {"render", "--size=-1x10"}, 2, {"-1x10"}},
    {"SizeFraction", {"render", "--size", "1.5x10"}, 2, {"1.5x10"}},
    {"SizeOfOneNumber", {"render", "--size", "640"}, 2, {"WIDTHxHEIGHT"}},
    {"CameraShort", {"render", "--camera", "1,2,3"}, 2, {"--camera", "px,py,pz,tx,ty,tz,fovY"}},
    {"CameraWord", {"render", "--camera", "a,0,0,1,0,0,60"}, 2, {"--camera"}},
    {"CameraNan", {"render", "--camera", "nan,0,0,1,0,0,60"}, 2, {"--camera"}},
    {"CameraFar", {"render", "--camera", "1e300,0,0,1,0,0,60"}, 2, {"--camera", "1e15"}},
    {"CameraNowhere", {"render", "--camera", "0,0,0,0,0,0,60"}, 2, {"--camera", "same point"}},
    {"CameraAngle", {"render", "--camera", "0,0,0,1,0,0,180"}, 2, {"--camera", "180"}},
    {"SunShort", {"render", "--sun", "1,2"}, 2, {"--sun", "E,dx,dy,dz,diameter"}},
    {"SunWithoutDirection", {"render", "--sun", "1,0,0,0,1"}, 2, {"--sun", "direction"}},
    {"SunNegative", {"render", "--sun=-1,0,-1,0,1"}, 2, {"--sun", "negative"}},
    {"SunWide", {"render", "--sun", "1,0,-1,0,181"}, 2, {"--sun", "180"}},
    {"SkyNegative", {"render", "--sky=-1,0,0"}, 2, {"--sky"}},
    {"SkyInfinite", {"render", "--sky", "1e39,0,0"}, 2, {"--sky"}},
    {"TimeNan", {"render", "--time", "nan"}, 2, {"--time", "nan"}},
    {"TimeInfinite", {"render", "--time", "inf"}, 2, {"--time", "inf"}},
    {"SeedNegative", {"render", "--seed=-1"}, 2, {"--seed"}},
    {"NoFrames", {"render", "--frames", "0"}, 2, {"--frames"}},
    {"ExplainOneNumber", {"render", "--explain", "3"}, 2, {"--explain", "X,Y"}},
    {"ExplainThree", {"render", "--explain", "3,4,5"}, 2, {"--explain", "X,Y"}},
    {"ExplainOutside", {"render", "furnace", "--size", "8x8", "--explain", "3,8"}, 2, {"--explain", "3,8", "8x8"}},
    {"NoSamples", {"reference", "--spp", "0"}, 2, {"--spp"}},
    {"NegativeBounces", {"reference", "--bounces=-1"}, 2, {"--bounces"}},
    {"ResumeOfNothing", {"reference", "furnace", "--resume"}, 2, {"--resume", "-o"}},
    {"QualityUnknown", {"render", "--quality", "ultra"}, 2, {"ultra", "cinematic"}},
    {"SetWithoutValue", {"render", "--set", "r.RT.Shadow"}, 2, {"r.RT.Shadow", "NAME=VALUE"}},
    {"DeviceWord", {"render", "--device", "abc"}, 2, {"--device", "abc"}},
    {"DeviceNegative", {"render", "--device=-1"}, 2, {"--device", "-1"}},
    {"DeviceMissing", {"render", "furnace", "--device", "99", "-o", "a.png"}, 3, {"99"}},
    {"ReferenceDeviceMissing", {"reference", "furnace", "--device", "99"}, 3, {"99"}},
    {"SceneMissing", {"render", "missing.gltf", "-o", "a.png"}, 4, {"missing.gltf"}},
    {"SceneUnknown", {"render", "nosuchscene"}, 4, {"nosuchscene", "courtyard", "furnace", "emptysky"}},
    {"SceneParameter", {"render", "furnace:2"}, 4, {"furnace:2", "ALBEDO"}},
    {"SceneTruncated", {"render", "truncated.gltf", "-o", "a.png"}, 4, {"truncated.gltf", "line 1"}},
    {"SceneEmpty", {"render", "empty.glb"}, 4, {"empty.glb"}},
    {"SceneFolder", {"render", "."}, 4, {"."}},
    {"ReferenceSceneMissing", {"reference", "missing.glb", "-o", "a.pfm"}, 4, {"missing.glb"}},
    {"OutputFolderMissing", {"render", "furnace", "-o", "nowhere/a.png"}, 4, {"nowhere/a.png", "folder"}},
    {"OutputIsFolder", {"render", "furnace", "-o", "/"}, 4, {"/"}},
    {"OutputEnding", {"render", "furnace", "-o", "a.jpg"}, 4, {"a.jpg", ".exr"}},
    {"JsonFolderMissing", {"render", "furnace", "--json", "nowhere/a.json"}, 4, {"--json", "nowhere/a.json"}},
    {"ReferenceOutput", {"reference", "furnace", "-o", "nowhere/a.pfm"}, 4, {"nowhere/a.pfm"}},
    {"CvarsOutput", {"cvars", "--json", "nowhere/a.json"}, 4, {"nowhere/a.json"}},
    {"ConfigMissing", {"render", "furnace", "--config", "none.ini"}, 4, {"none.ini"}},
    {"ConfigFolder", {"render", "furnace", "--config", "."}, 4, {"--config"}},
    {"ViewUnknown", {"render", "a.gltf", "--view", "dusk"}, 2, {"--view 'dusk'", "a.gltf", "views.json has main, night"}},
    {"ViewOfReference", {"reference", "a.gltf", "--view", "dusk"}, 2, {"--view 'dusk'", "main, night"}},
    {"ViewOfChart", {"chart", "a.gltf", "--view", "dusk", "-o", "a.html"}, 2, {"--view 'dusk'", "main, night"}},
    {"ViewNowhere", {"render", "c.gltf", "--view", "main"}, 2, {"--view 'main'", "c.gltf", "no views.json"}},
    {"ViewOfBuiltinScene", {"render", "courtyard", "--view", "main"}, 2, {"--view 'main'", "courtyard"}},
    {"ViewWithoutName", {"render", "--view", ""}, 2, {"--view"}},
    {"ViewsBroken", {"render", "b.gltf"}, 4, {"views.json: b.gltf[0].camera: expected 7 numbers, found 1"}},
    {"ViewsBrokenChart", {"chart", "b.gltf", "-o", "a.html"}, 4, {"views.json: b.gltf[0].camera"}},
    {"CompareOne", {"compare", "a.exr"}, 2, {"B is required"}},
    {"CompareMissing", {"compare", "a.exr", "b.exr"}, 4, {"a.exr"}},
    {"CompareNoPicture", {"compare", "text.png", "text.png"}, 4, {"text.png"}},
    {"CompareOutput", {"compare", "text.png", "text.png", "--heatmap", "nowhere/h.png"}, 4, {"nowhere/h.png"}},
};

INSTANTIATE_TEST_SUITE_P(All, FUsageTest, ::testing::ValuesIn(Usages), [](const auto& Info) { return std::string(Info.param.Name); });

TEST(UsageTest, WithoutADriverEveryCommandThatNeedsOneSaysSo)
{
	FProgramOptions Options;
	Options.Environment = {{"VK_DRIVER_FILES", "/nowhere.json"}, {"VK_ICD_FILENAMES", "/nowhere.json"}};
	for (const std::vector<std::string>& Arguments : {std::vector<std::string>{"render", "furnace"}, {"reference", "furnace"}, {"info"}})
	{
		const FProgramRun Run = RunProgram(Arguments, Options);
		EXPECT_EQ(Run.Status, 3) << Run.Err;
		ASSERT_EQ(Run.GetMessages().size(), 1u) << Run.Err;
		EXPECT_THAT(Run.GetMessages()[0], HasSubstr("driver"));
	}
	EXPECT_EQ(RunProgram({"render", "--list"}, Options).Status, 0);
	EXPECT_EQ(RunProgram({"cvars"}, Options).Status, 0);
}

TEST(UsageTest, WithoutThePluginFolderItIsNamed)
{
	FProgramOptions Options;
	const FTemporaryFolder Empty;
	Options.Environment = {{"LANTERN_ROOT", Empty.GetPath()}};
	const FProgramRun Run = RunProgram({"render", "furnace", "--size", "8x8", "-o", "a.png"}, Options);
	EXPECT_NE(Run.Status, 0);
	EXPECT_LT(Run.Status, 128) << Run.Err;
	EXPECT_THAT(Run.Err, HasSubstr("shader not found (searched " + Empty.GetPath()));
}

TEST(UsageTest, ProtectedFilesAndFoldersStayAsTheyAre)
{
	const FTemporaryFolder Folder;
	const std::string Picture = Folder.Write("kept.png", "precious");
	std::filesystem::create_directory(Folder.GetPath() + "/locked");
	ASSERT_EQ(chmod(Folder.GetPath().c_str(), 0777), 0);
	ASSERT_EQ(chmod(Picture.c_str(), 0444), 0);
	ASSERT_EQ(chmod((Folder.GetPath() + "/locked").c_str(), 0555), 0);
	FProgramOptions Options;
	Options.Folder = Folder.GetPath();
	Options.bUnprivileged = true;
	if (RunProgram({"--version"}, Options).Status != 0) { GTEST_SKIP() << "another user may not run the program where it lies"; }
	for (const char* Output : {"kept.png", "locked/new.png"})
	{
		const FProgramRun Run = RunProgram({"render", "furnace", "--size", "8x8", "-o", Output}, Options);
		EXPECT_EQ(Run.Status, 4) << Run.Err;
		ASSERT_EQ(Run.GetMessages().size(), 1u) << Run.Err;
		EXPECT_THAT(Run.GetMessages()[0], HasSubstr(Output));
		EXPECT_THAT(Run.GetMessages()[0], HasSubstr("ermission denied"));
	}
	EXPECT_EQ(ReadFile(Picture), "precious");
	EXPECT_THAT(ListFolder(Folder.GetPath()), ElementsAre("kept.png", "locked"));
	EXPECT_THAT(ListFolder(Folder.GetPath() + "/locked"), IsEmpty());
}

TEST(UsageTest, ResultsThatCannotBeWrittenAreAnError)
{
	FProgramOptions Options;
	Options.StandardOutput = "/dev/full";
	const FProgramRun Run = RunProgram({"render", "--list"}, Options);
	EXPECT_EQ(Run.Status, 4);
	ASSERT_EQ(Run.GetMessages().size(), 1u) << Run.Err;
	EXPECT_THAT(Run.GetMessages()[0], HasSubstr("standard output"));
}

TEST(UsageTest, HelpAndVersionGoToStandardOutput)
{
	for (const std::vector<std::string>& Arguments :
	    {std::vector<std::string>{"--help"}, {"--version"}, {"render", "--help"}, {"reference", "--help"}, {"compare", "--help"}})
	{
		const FProgramRun Run = RunProgram(Arguments);
		EXPECT_EQ(Run.Status, 0);
		EXPECT_NE(Run.Out, "");
		EXPECT_EQ(Run.Err, "");
	}
}

} // namespace
} // namespace Lantern
