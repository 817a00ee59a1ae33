// The RTPSO compiler on the mock: rounds, stand-ins, order, swaps, and that frames never wait for a compile.
#include "PipelineTestTools.h"

namespace Lantern
{
namespace
{

using ::testing::ElementsAre;
using ::testing::HasSubstr;

/// With libraries as they should be, with a driver that needs general groups in the link, and without libraries.
enum class EPath : uint8_t { Libraries, OwnGeneralGroups, NoLibraries, LibrariesOff };

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
	EXPECT_TRUE(Current->IsStandIn(Opaque(Leaves))) << "nobody asked for it: the standard program serves";
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
	UntilIdle();
	auto Current = Maker->GetCurrent();
	EXPECT_EQ(ResolveHit(*Current, 1, Program).Intersection, "Sphere.rint (Ball)");
	EXPECT_EQ(ResolveHit(*Current, 1, Program).ClosestHit, "MATERIAL.hit (Ball)");
	EXPECT_EQ(ResolveHit(*Current, 0, Program).Intersection, "Sphere.rint (Ball)") << "shadow rays must hit it too";
	const FHitProgram Unknown{Ball + 1, ERTHitClass::Procedural};
	EXPECT_TRUE(Current->IsStandIn(Unknown));
	EXPECT_EQ(ResolveHit(*Current, 1, Unknown).Intersection, "Rays/NoIntersection.rint (StandIn)");
}

INSTANTIATE_TEST_SUITE_P(Paths, FPipelinePathTest, ::testing::Values(EPath::Libraries, EPath::OwnGeneralGroups, EPath::NoLibraries, EPath::LibrariesOff));

using FPipelineCompilerTest = FPipelineTest;

TEST_F(FPipelineCompilerTest, UpdateNeverWaitsForACompileOrALink)
{
	for (const char* Part : {"Rust", "RTPSO"})
	{
		Start({});
		UntilIdle();
		const uint32_t Rust = AddProgram("Rust");
		Device->Close(Part);
		const auto Before = Maker->GetCurrent();
		// The gate opens only after these: an Update that waited would wait for ever.
		for (int Frame = 0; Frame < 200; ++Frame)
		{
			Maker->Update(Wanted);
			EXPECT_EQ(Maker->GetCurrent(), Before);
		}
		Device->Open();
		Until([&] { return IsReady(Opaque(Rust)); });
	}
}

TEST_F(FPipelineCompilerTest, PipelineIsSwappedAtTheStartOfAFrameOnly)
{
	UntilIdle();
	const auto Before = Maker->GetCurrent();
	const uint32_t Rust = AddProgram("Rust");
	Device->ForgetAsked();
	Maker->Update(Wanted);
	WaitFor([&] { return Device->Mock().CountCalls(ERTMockCall::CreateRayTracingPipeline, "RTPSO") == 2; });
	WaitFor([&] { return Maker->GetStats().bBusy; });
	std::this_thread::sleep_for(std::chrono::milliseconds(20));
	EXPECT_EQ(Maker->GetCurrent(), Before) << "swapped in the middle of a frame";
	Maker->Update(Wanted);
	EXPECT_NE(Maker->GetCurrent(), Before);
	EXPECT_TRUE(IsReady(Opaque(Rust)));
	EXPECT_EQ(ResolveHit(*Before, 1, Opaque(0)).ClosestHit, "MATERIAL.hit") << "who holds the old one can still use it";
}

TEST_F(FPipelineCompilerTest, RoundEndsInTimeAndWhatIsStuckComesLater)
{
	UntilIdle();
	Set("r.RT.Pipeline.RoundMs", "1");
	const uint32_t Stuck = AddProgram("Stuck"), Rust = AddProgram("Rust");
	Device->Close("Stuck");
	Until([&] { return IsReady(Opaque(Rust)); });
	ExpectStandIn(Opaque(Stuck));
	Device->Open();
	Until([&] { return IsReady(Opaque(Stuck)); });
	EXPECT_EQ(Device->CountAsked("Stuck MATERIAL opaque"), 1u) << "compiled once, though it outlived its round";
}

TEST_F(FPipelineCompilerTest, NothingIsCompiledTwice)
{
	for (int I = 0; I < 20; ++I)
	{
		AddProgram("P" + std::to_string(I));
		Maker->Update(Wanted);
	}
	UntilIdle();
	std::vector<std::string> Names = Device->GetAsked();
	std::erase(Names, "RTPSO");
	const size_t Count = Names.size();
	std::sort(Names.begin(), Names.end());
	Names.erase(std::unique(Names.begin(), Names.end()), Names.end());
	EXPECT_EQ(Names.size(), Count);
	EXPECT_EQ(Maker->GetStats().Compiled, Count);
}

TEST_F(FPipelineCompilerTest, MostHitComesFirstThenNearest)
{
	Set("r.RT.Pipeline.Threads", "1");
	Start({});
	Device->Close("Generate"); // the first of all
	const std::vector<std::string> Names = {"Far", "Near", "Seen", "MoreSeen"};
	for (const std::string& Name : Names) { AddProgram(Name); }
	Maker->SetPriorities({{}, {0, 50.0f}, {0, 2.0f}, {10, 90.0f}, {500, 100.0f}});
	Maker->Update(Wanted);
	Device->Open();
	UntilIdle();
	std::vector<std::string> Order;
	for (const std::string& Asked : Device->GetAsked())
	{
		for (const std::string& Name : Names)
		{
			if (Asked == Name + " MATERIAL opaque") { Order.push_back(Name); }
		}
	}
	EXPECT_THAT(Order, ElementsAre("MoreSeen", "Seen", "Near", "Far"));
}

TEST_F(FPipelineCompilerTest, StandInsComeBeforeThoseTheyStandInFor)
{
	Set("r.RT.Pipeline.Threads", "1");
	Start({});
	AddProgram("Rust");
	UntilIdle();
	const std::vector<std::string> Asked = Device->GetAsked();
	const auto Find = [&](const char* Name) { return std::find(Asked.begin(), Asked.end(), Name) - Asked.begin(); };
	EXPECT_LT(Find("StandIn MATERIAL opaque"), Find("Rust MATERIAL opaque"));
}

TEST_F(FPipelineCompilerTest, WhatIsNotWantedForLongIsDropped)
{
	Set("r.RT.Pipeline.KeepFrames", "10");
	const FRTPSODesc Few = Wanted;
	for (int I = 0; I < 30; ++I) { AddProgram("P" + std::to_string(I)); }
	const FRTPSODesc Many = Wanted;
	FinishWanted();
	const uint32_t Kept = Maker->GetStats().Kept;
	EXPECT_GE(Kept, 30u);
	Wanted = Few;
	FinishWanted();
	for (int Frame = 0; Frame < 60; ++Frame) { FinishWanted(); }
	EXPECT_LE(Maker->GetStats().Kept, 6u);
	// Pipelines and libraries; another thread destroys them.
	WaitFor([&] { return Device->Mock().GetLiveObjectCount() <= 12u; });
	Wanted = Many;
	FinishWanted();
	EXPECT_EQ(Maker->GetCurrent()->GetMissingCount(), 0u);
}

TEST_F(FPipelineCompilerTest, LibrariesComeBackUsedAgain)
{
	const FRTPSODesc Few = Wanted;
	AddProgram("Rust");
	FinishWanted();
	Device->ForgetAsked();
	const FRTPSODesc Many = Wanted;
	for (int I = 0; I < 3; ++I)
	{
		ASSERT_TRUE(Maker->Finish(Few));
		ASSERT_TRUE(Maker->Finish(Many));
	}
	EXPECT_THAT(Device->GetAsked(), ElementsAre("RTPSO")) << "one link for Few; the rest was kept";
}

TEST_F(FPipelineCompilerTest, ShortageOfMemoryPassesAndACompileErrorDoesNot)
{
	FLogCapture Log;
	Device->Mock().FailCompile("Standard MATERIAL");
	for (int I = 0; I < 3; ++I)
	{
		const FRTStatus Status = Maker->Finish(Wanted);
		EXPECT_EQ(Status.Code, ERTResult::CompileFailed);
		EXPECT_THAT(Status.Message, HasSubstr("Standard MATERIAL opaque"));
	}
	EXPECT_EQ(Device->CountAsked("Standard MATERIAL opaque"), 1u);
	EXPECT_EQ(Log.Count(ERTLogLevel::Error), 1u);
	// An edit is another chance.
	Device->Mock().ClearCompileFaults();
	Programs->Edit(StandardProgram, {.Name = "Standard", .Text = MakeText(3)});
	FinishWanted();
}

TEST_F(FPipelineCompilerTest, LinkThatFailsIsToldOnceAndTheOldOneStays)
{
	UntilIdle();
	const auto Before = Maker->GetCurrent();
	FLogCapture Log;
	Device->Mock().FailCompile("RTPSO");
	AddProgram("Rust");
	UntilIdle();
	for (int Frame = 0; Frame < 100; ++Frame) { Maker->Update(Wanted); }
	UntilIdle();
	EXPECT_EQ(Maker->GetCurrent(), Before);
	EXPECT_EQ(Log.Count(ERTLogLevel::Error), 1u);
	EXPECT_EQ(Device->CountAsked("RTPSO"), 2u) << "tried once";
	const FRTStatus Status = Maker->Finish(Wanted);
	EXPECT_EQ(Status.Code, ERTResult::CompileFailed);
	EXPECT_THAT(Status.Message, HasSubstr("RTPSO"));
	Device->Mock().ClearCompileFaults();
	const uint32_t Moss = AddProgram("Moss");
	Until([&] { return IsReady(Opaque(Moss)); });
}

TEST_F(FPipelineCompilerTest, EditedFilesAreNoticedByReload)
{
	Folder.Write("Materials/Rust.glsl", "#include \"Shared.glsl\"\nfloat Value() { return Shared(); }\n");
	Folder.Write("Materials/Shared.glsl", "float Shared() { return 1.0; }\n");
	const uint32_t Rust = Programs->Add({.Name = "Rust", .Path = "Materials/Rust.glsl"});
	Wanted.HitPrograms.push_back(Opaque(Rust));
	AddProgram("Moss");
	UntilIdle();
	const uint64_t First = Maker->GetCurrent()->GetRevision();
	Device->ForgetAsked();
	Maker->Reload();
	UntilIdle();
	EXPECT_EQ(Maker->GetCurrent()->GetRevision(), First) << "nothing was edited";
	Folder.Write("Materials/Shared.glsl", "float Shared() { return 2.5; }\n");
	Maker->Reload();
	UntilIdle();
	EXPECT_NE(Maker->GetCurrent()->GetRevision(), First);
	EXPECT_THAT(Device->GetAsked(), ElementsAre("Rust MATERIAL opaque", "RTPSO")) << "what includes it, and no more";
	FLogCapture Log;
	Folder.Write("Materials/Shared.glsl", "float Shared() { return wrong; }\n");
	Maker->Reload();
	UntilIdle();
	EXPECT_TRUE(IsReady(Opaque(Rust)));
	EXPECT_EQ(Log.Count(ERTLogLevel::Error), 1u);
	EXPECT_THAT(Log.GetTexts().at(0), HasSubstr("Materials/Shared.glsl:1:"));
	Folder.Write("Materials/Shared.glsl", "float Shared() { return 3.5; }\n");
	Maker->Reload();
	UntilIdle();
	EXPECT_EQ(Device->CountAsked("Rust MATERIAL opaque"), 2u);
}

} // namespace
} // namespace Lantern
