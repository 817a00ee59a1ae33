// What the RTPSO compiler makes, on each of its ways: with libraries, with general groups in the link, and without libraries.
#include "RTPSOTestTools.h"

namespace Lantern
{
namespace
{

using ::testing::ElementsAre;
using ::testing::HasSubstr;

/// With libraries as they should be, with a driver that needs general groups in the link, and without libraries.
enum class EPath : uint8_t
{
	Libraries,
	OwnGeneralGroups,
	NoLibraries,
	LibrariesOff
};

class FPipelinePathTest : public FPipelineTest, public ::testing::WithParamInterface<EPath>
{
protected:
	void SetUp() override
	{
		FPipelineTest::SetUp();
		FRTMockDesc Desc;
		Desc.bLibraryOnlyPipelines = GetParam() != EPath::OwnGeneralGroups;
		Desc.bPipelineLibraries = GetParam() != EPath::NoLibraries;
		Set("r.RT.Pipeline.Libraries", GetParam() == EPath::LibrariesOff ? "0" : "1");
		Start(Desc);
	}
};

TEST_P(FPipelinePathTest, FinishMakesAllThatIsWanted)
{
	const uint32_t Rust = AddProgram("Rust"), Leaves = AddProgram("Leaves", ERTHitClass::Masked);
	Wanted.HitPrograms.push_back(Masked(StandardProgram));
	Wanted.Callables = {MakeShader("Call0"), MakeShader("Call1")};
	Wanted.RayGens.push_back(MakeShader("Second"));
	std::vector<float> Progress;
	ASSERT_TRUE(Maker->Finish(Wanted, [&](float Done) { Progress.push_back(Done); }));
	EXPECT_TRUE(std::is_sorted(Progress.begin(), Progress.end()));
	ASSERT_FALSE(Progress.empty());
	EXPECT_EQ(Progress.back(), 1.0f);
	const auto Current = Maker->GetCurrent();
	ASSERT_TRUE(Current);
	ExpectOwn(Opaque(StandardProgram), "");
	ExpectOwn(Masked(StandardProgram), "");
	ExpectOwn(Opaque(Rust), "Rust");
	ExpectOwn(Masked(Leaves), "Leaves");
	EXPECT_EQ(Current->GetState(Opaque(Leaves)), ERTHitState::StandIn) << "nobody asked for it: the standard program serves";
	EXPECT_EQ(Current->GetHitGroupCount(), 8u);
	EXPECT_EQ(Current->GetMissingCount(), 0u);
	for (uint32_t I = 0; I < 2; ++I)
	{
		EXPECT_EQ(ResolveGroup(*Current, ERTRecordKind::Miss, Current->MissGroup(I)).General, I ? "MATERIAL.miss" : "SHADOW.miss");
		EXPECT_EQ(ResolveGroup(*Current, ERTRecordKind::Callable, Current->CallableGroup(I)).General, "Call" + std::to_string(I));
		const uint32_t RayGen = Current->FindRayGen(Wanted.RayGens[I]);
		ASSERT_NE(RayGen, NoRayGen);
		EXPECT_EQ(ResolveGroup(*Current, ERTRecordKind::RayGen, Current->RayGenGroup(RayGen)).General, I ? "Second" : "Generate");
	}
	// Libraries alone: the link has no group of its own; with the quirk the general ones; else all in one.
	const auto Links = Device->Mock().FindCalls(ERTMockCall::CreateRayTracingPipeline, "RTPSO");
	ASSERT_EQ(Links.size(), 1u);
	const bool bLibraries = GetParam() == EPath::Libraries || GetParam() == EPath::OwnGeneralGroups;
	EXPECT_EQ(Links[0].Numbers[1] == 0, GetParam() == EPath::Libraries);
	EXPECT_EQ(Links[0].Numbers[4] > 0, bLibraries);
}

TEST_P(FPipelinePathTest, ThatFinishIsOverTheNextOneCostsNothing)
{
	AddProgram("Rust");
	FinishWanted();
	Device->ForgetAsked();
	const auto Before = Maker->GetCurrent();
	for (int Frame = 0; Frame < 10; ++Frame) { FinishWanted(); }
	EXPECT_EQ(Maker->GetCurrent(), Before);
	EXPECT_THAT(Device->GetAsked(), ElementsAre());
}

TEST_P(FPipelinePathTest, FinishWithStandInsLeavesNothingToUpdate)
{
	AddProgram("Rust");
	const FRTStatus Status = Maker->Finish(Wanted, {}, true);
	ASSERT_TRUE(Status) << Status.Message;
	Device->ForgetAsked();
	const auto Before = Maker->GetCurrent();
	UntilIdle();
	EXPECT_EQ(Maker->GetCurrent(), Before);
	EXPECT_THAT(Device->GetAsked(), ElementsAre());
	const uint32_t Moss = AddProgram("Moss");
	Maker->Update(Wanted);
	ExpectStandIn(Opaque(Moss));
	UntilIdle();
}

TEST_P(FPipelinePathTest, ProgramsArriveByAndByAndStandInsServeUntilThen)
{
	Maker->Update(Wanted);
	EXPECT_FALSE(Maker->GetCurrent()) << "Update waited";
	UntilIdle();
	ExpectOwn(Opaque(StandardProgram), "");
	const uint32_t Rust = AddProgram("Rust"), Leaves = AddProgram("Leaves", ERTHitClass::Masked);
	const bool bOneLink = GetParam() == EPath::NoLibraries || GetParam() == EPath::LibrariesOff;
	Device->Close(bOneLink ? "RTPSO" : "Leaves");
	Maker->Update(Wanted);
	ExpectStandIn(Opaque(Rust));
	EXPECT_TRUE(Maker->GetCurrent()->IsMissing(Masked(Leaves))) << "no masked stand-in was made yet";
	Device->Open();
	Until([&] { return IsReady(Masked(Leaves)) && IsReady(Opaque(Rust)); });
	ExpectOwn(Opaque(Rust), "Rust");
	ExpectOwn(Masked(Leaves), "Leaves");
	const uint32_t Vines = AddProgram("Vines", ERTHitClass::Masked);
	ExpectStandIn(Masked(Vines));
}

TEST_P(FPipelinePathTest, EditedProgramReplacesTheOldOneAndABadEditDoesNot)
{
	const uint32_t Rust = AddProgram("Rust");
	UntilIdle();
	const uint64_t First = Maker->GetCurrent()->GetRevision();
	Programs->Edit(Rust, {.Name = "Rust", .Text = "float Value() { return 7.0; }\n"});
	UntilIdle();
	const uint64_t Second = Maker->GetCurrent()->GetRevision();
	EXPECT_NE(First, Second);
	ExpectOwn(Opaque(Rust), "Rust");
	{
		FLogCapture Log;
		Programs->Edit(Rust, {.Name = "Rust", .Text = "float Value()\n{\n\treturn wrong;\n}\n"});
		UntilIdle();
		EXPECT_EQ(Maker->GetCurrent()->GetRevision(), Second) << "the old one stays";
		EXPECT_TRUE(IsReady(Opaque(Rust)));
		EXPECT_EQ(Log.Count(ERTLogLevel::Error), 1u);
		EXPECT_THAT(Log.GetTexts().at(0), HasSubstr("Materials/Rust.glsl:3:"));
	}
	Programs->Edit(Rust, {.Name = "Rust", .Text = "float Value() { return 8.0; }\n"});
	UntilIdle();
	EXPECT_NE(Maker->GetCurrent()->GetRevision(), Second);
}

TEST_P(FPipelinePathTest, OneThatFailsIsToldOnceAndTheRestGoesOn)
{
	FLogCapture Log;
	const uint32_t Broken = Programs->Add({.Name = "Broken", .Text = "float Value() { return\n wrong; }\n"});
	Wanted.HitPrograms.push_back(Opaque(Broken));
	Wanted.HitPrograms.push_back(Masked(Broken));
	const uint32_t Rust = AddProgram("Rust");
	UntilIdle();
	for (int Frame = 0; Frame < 50; ++Frame) { Maker->Update(Wanted); }
	ExpectOwn(Opaque(Rust), "Rust");
	ExpectStandIn(Opaque(Broken));
	ExpectStandIn(Masked(Broken));
	EXPECT_EQ(Log.Count(ERTLogLevel::Error), 1u) << ::testing::PrintToString(Log.GetTexts());
	EXPECT_THAT(Log.GetTexts().at(0), HasSubstr("Materials/Broken.glsl:2:"));
	// A picture that waits gets the stand-in too, and no error.
	FinishWanted();
	ExpectStandIn(Opaque(Broken));
	EXPECT_EQ(Log.Count(ERTLogLevel::Error), 1u);
}

TEST_P(FPipelinePathTest, SkippedHitProgramsAreMissing)
{
	Set("r.RT.Pipeline.Fallback", "0");
	UntilIdle();
	const uint32_t Rust = AddProgram("Rust");
	Device->Close("R"); // Rust, and RTPSO
	Maker->Update(Wanted);
	const auto Current = Maker->GetCurrent();
	EXPECT_TRUE(Current->IsMissing(Opaque(Rust)));
	EXPECT_EQ(ResolveHit(*Current, 1, Opaque(Rust)).ClosestHit, "") << "no stand-in was compiled";
	Device->Open();
	Until([&] { return IsReady(Opaque(Rust)); });
	for (const std::string& Name : Device->GetAsked()) { EXPECT_EQ(Name.find("StandIn"), std::string::npos); }
}

TEST_P(FPipelinePathTest, WithoutRayGenerationOrMissThereIsNoPipelineAndFinishSaysWhy)
{
	FRTPSODesc Bad = Wanted;
	Bad.RayTypes[0].Miss = MakeShader("Bad.miss", "void main() { wrong; }\n");
	FLogCapture Log;
	for (int Frame = 0; Frame < 3; ++Frame)
	{
		const FRTStatus Status = Maker->Finish(Bad);
		EXPECT_EQ(Status.Code, ERTResult::CompileFailed);
		EXPECT_THAT(Status.Message, HasSubstr("Bad.miss:3:"));
	}
	EXPECT_EQ(Log.Count(ERTLogLevel::Error), 1u);
	EXPECT_FALSE(Maker->GetCurrent());
	FinishWanted();
	// The one before goes on while the new one cannot be made.
	const auto Before = Maker->GetCurrent();
	Wanted = Bad;
	UntilIdle();
	EXPECT_EQ(Maker->GetCurrent(), Before);
}

TEST_P(FPipelinePathTest, RayGenerationVariantServesUntilTheNewOneIsThere)
{
	UntilIdle();
	FShaderSource Variant = Wanted.RayGens[0];
	Variant.Defines = {{"FAST", "1"}};
	Wanted.RayGens = {Variant};
	Device->Close("RTPSO");
	Maker->Update(Wanted);
	auto Current = Maker->GetCurrent();
	EXPECT_EQ(Current->FindRayGen(Variant), NoRayGen);
	EXPECT_EQ(Current->FindRayGenVariant(Variant), 0u);
	EXPECT_EQ(Current->FindRayGenVariant(MakeShader("Other")), NoRayGen);
	Device->Open();
	UntilIdle();
	EXPECT_NE(Maker->GetCurrent()->FindRayGen(Variant), NoRayGen);
}

TEST_P(FPipelinePathTest, CallableThatFailsDoesNothingAndKeepsTheOthersPlaces)
{
	Wanted.Callables = {MakeShader("Bad", "void main() { wrong; }\n"), MakeShader("Good")};
	FLogCapture Log;
	FinishWanted();
	const auto Current = Maker->GetCurrent();
	EXPECT_EQ(ResolveGroup(*Current, ERTRecordKind::Callable, Current->CallableGroup(0)).General, "EmptyCallable");
	EXPECT_EQ(ResolveGroup(*Current, ERTRecordKind::Callable, Current->CallableGroup(1)).General, "Good");
	EXPECT_EQ(Log.Count(ERTLogLevel::Error), 1u);
}

TEST_P(FPipelinePathTest, ProceduralGroupsRunTheProgramsIntersection)
{
	Folder.Write("Sphere.rint", std::string(Head) + "void main() {}\n");
	Folder.Write("Rays/NoIntersection.rint", std::string(Head) + "void main() {}\n");
	const uint32_t Ball = Programs->Add({.Name = "Ball", .Text = MakeText(1), .IntersectionPath = "Sphere.rint"});
	const FHitProgram Program{Ball, ERTHitClass::Procedural};
	Wanted.HitPrograms.push_back(Program);
	FRayType Standard = Wanted.RayTypes[1];
	Standard.Name = "STANDARD";
	Standard.bStandardProgram = true;
	Wanted.RayTypes.push_back(Standard);
	UntilIdle();
	auto Current = Maker->GetCurrent();
	EXPECT_EQ(ResolveHit(*Current, 1, Program).Intersection, "Sphere.rint (Ball)");
	EXPECT_EQ(ResolveHit(*Current, 1, Program).ClosestHit, "MATERIAL.hit (Ball)");
	EXPECT_EQ(ResolveHit(*Current, 0, Program).Intersection, "Sphere.rint (Ball)") << "shadow rays must hit it too";
	EXPECT_EQ(ResolveHit(*Current, 2, Program).Intersection, "Sphere.rint (Ball)") << "and rays that see the standard program alone";
	EXPECT_EQ(ResolveHit(*Current, 2, Program).ClosestHit, "MATERIAL.hit (Ball)");
	const FHitProgram Unknown{Ball + 1, ERTHitClass::Procedural};
	EXPECT_EQ(Current->GetState(Unknown), ERTHitState::StandIn);
	EXPECT_EQ(ResolveHit(*Current, 1, Unknown).Intersection, "Rays/NoIntersection.rint (StandIn)");
}

TEST(MaterialProgramsTest, TextOfAProgramIsPartOfItsShadersKeys)
{
	const FTemporaryFolder Folder;
	std::filesystem::create_directory(Folder.GetPath() + "/Materials");
	Folder.Write("Materials/Material.glsl", "float Value() { return 0.0; }\n");
	Folder.Write("Materials/Other.glsl", "#define OTHER 1.0\n");
	FShaderCompiler Compiler(FShaderCompilerDesc{.SearchFolders = {Folder.GetPath()}, .CacheFolder = Folder.GetPath() + "/cache"});
	FMaterialPrograms Programs;
	FShaderSource Shader;
	Shader.Path = "Test.comp";
	Shader.Text = "#version 460\n#include \"Materials/Material.glsl\"\nlayout(local_size_x = 1) in;\n"
	              "layout(set = 0, binding = 0) buffer F { float Out; };\nvoid main() { Out = Value(); }\n";
	const uint32_t One = Programs.Add({.Name = "One", .Text = "#include \"Other.glsl\"\nfloat Value() { return OTHER; }\n"});
	const uint32_t Same = Programs.Add({.Name = "Same", .Text = Programs.Get(One).Text});
	const uint32_t Two = Programs.Add({.Name = "Two", .Text = "float Value() { return 2.0; }\n"});
	const auto Compile = [&](uint32_t Program) {
		FShaderBinary Binary;
		const FRTStatus Status = Compiler.Compile(Programs.MakeSource(Shader, Program), Binary);
		EXPECT_TRUE(Status) << Status.Message;
		return Binary;
	};
	const FShaderBinary OfStandard = Compile(StandardProgram), OfOne = Compile(One), OfTwo = Compile(Two);
	EXPECT_EQ(OfOne.Name, "Test.comp (One)");
	EXPECT_NE(OfOne.Words, OfStandard.Words);
	EXPECT_NE(OfOne.Words, OfTwo.Words);
	EXPECT_FALSE(OfTwo.bFromCache);
	EXPECT_TRUE(Compile(One).bFromCache);
	EXPECT_TRUE(Compile(Same).bFromCache) << "the same text has the same key, whatever its name";
	const std::string Key = Compiler.GetKey(Programs.MakeSource(Shader, One));
	Folder.Write("Materials/Other.glsl", "#define OTHER 4.0\n");
	EXPECT_NE(Compiler.GetKey(Programs.MakeSource(Shader, One)), Key) << "files that it includes are part of it too";
	EXPECT_EQ(Programs.FindOrAdd({.Name = "Two", .Text = "float Value() { return 2.0; }\n"}), Two);
}

INSTANTIATE_TEST_SUITE_P(
    Paths, FPipelinePathTest, ::testing::Values(EPath::Libraries, EPath::OwnGeneralGroups, EPath::NoLibraries, EPath::LibrariesOff));

} // namespace
} // namespace Lantern
