// The RTPSO compiler on the mock: rounds, stand-ins, order, swaps, and that frames never wait for a compile.
#include "RTPSOTestTools.h"

namespace Lantern
{
namespace
{

using ::testing::ElementsAre;
using ::testing::HasSubstr;

using FPipelineCompilerTest = FPipelineTest;

TEST_F(FPipelineCompilerTest, UpdateNeverWaitsForACompileOrALink)
{
	for (const char* Part : {"Rust", "RTPSO"})
	{
		Start({});
		UntilIdle();
		const uint32_t Rust = AddProgram("Rust");
		Device->ForgetAsked();
		Device->Close(Part);
		const auto Before = Maker->GetCurrent();
		// The gate opens only after these: an Update that waited would wait for ever.
		{
			const FHangGuard Guard("frames while the driver holds a compile", [&] { Device->Open(); });
			Until([&] { return Device->WasAsked(Part); });
			for (int Frame = 0; Frame < 200; ++Frame)
			{
				Maker->Update(Wanted);
				EXPECT_EQ(Maker->GetCurrent(), Before);
			}
		}
		Device->Open();
		Until([&] { return IsReady(Opaque(Rust)); });
	}
}

TEST_F(FPipelineCompilerTest, PipelineIsSwappedAtTheStartOfAFrameOnly)
{
	Device->Close("Generate");
	Until([&] { return Device->WasAsked("Generate"); });
	Device->Open();
	// Only the first link can be told to be done without a frame: it has taken some time.
	WaitFor([&] { return Maker->GetStats().LastLinkMs > 0.0; });
	EXPECT_FALSE(Maker->GetCurrent()) << "there in the middle of a frame";
	UntilIdle();
	const auto Before = Maker->GetCurrent();
	ASSERT_TRUE(Before);
	const uint32_t Rust = AddProgram("Rust");
	Device->Close("Rust");
	Until([&] { return Device->CountAsked("Rust MATERIAL opaque") > 0; });
	Device->Open();
	WaitFor([&] { return Device->Mock().CountCalls(ERTMockCall::CreateRayTracingPipeline, "RTPSO") == 2; });
	EXPECT_EQ(Maker->GetCurrent(), Before) << "swapped in the middle of a frame";
	Until([&] { return Maker->GetCurrent() != Before; });
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
	EXPECT_EQ(GetIdleStats().Compiled, Count);
}

// A closest-hit shader that knows no material is one group, whatever number of programs there are.
TEST_F(FPipelineCompilerTest, WhatNoProgramChangesIsCompiledOnceForAll)
{
	Wanted.RayTypes[0].ClosestHit = MakeShader("SHADOW.hit");
	Wanted.RayTypes[0].bSharedClosestHit = true;
	const uint32_t Rust = AddProgram("Rust"), Moss = AddProgram("Moss", ERTHitClass::Masked);
	UntilIdle();
	ASSERT_TRUE(IsReady(Opaque(Rust)));
	EXPECT_EQ(Device->CountAsked("SHADOW.hit"), 1u);
	const auto Current = Maker->GetCurrent();
	for (const uint32_t Program : {uint32_t(StandardProgram), Rust})
	{
		EXPECT_EQ(ResolveHit(*Current, 0, Opaque(Program)).ClosestHit, "SHADOW.hit");
	}
	EXPECT_EQ(ResolveHit(*Current, 1, Opaque(Rust)).ClosestHit, "MATERIAL.hit (Rust)");
	const FRTMockRecord Masked = ResolveHit(*Current, 0, {Moss, ERTHitClass::Masked});
	EXPECT_EQ(Masked.ClosestHit, "SHADOW.hit (Moss)") << "beside a test that is the program's own";
	EXPECT_EQ(Masked.AnyHit, "SHADOW.any (Moss)");
}

TEST_F(FPipelineCompilerTest, RaysOfStandardHitsRunNoOtherProgram)
{
	const FRayType Material = Wanted.RayTypes[1];
	FRayType& Standard = Wanted.RayTypes.emplace_back(Material);
	Standard.Name = "STANDARD";
	Standard.bStandardProgram = true;
	const uint32_t Rust = AddProgram("Rust"), Moss = AddProgram("Moss", ERTHitClass::Masked);
	UntilIdle();
	const auto Current = Maker->GetCurrent();
	ASSERT_TRUE(Current);
	const std::string Name = ResolveHit(*Current, 1, Opaque(StandardProgram)).ClosestHit;
	EXPECT_EQ(Name, "MATERIAL.hit");
	for (const FHitProgram Program : {Opaque(StandardProgram), Opaque(Rust), FHitProgram{Moss, ERTHitClass::Masked}})
	{
		EXPECT_EQ(ResolveHit(*Current, 2, Program).ClosestHit, Name);
	}
	EXPECT_EQ(ResolveHit(*Current, 2, {Moss, ERTHitClass::Masked}).AnyHit, "MATERIAL.any");
	EXPECT_EQ(ResolveHit(*Current, 1, Opaque(Rust)).ClosestHit, "MATERIAL.hit (Rust)") << "other rays are as before";
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

// What is missing is left out of the frame: without stand-ins the first frames would have holes.
TEST_F(FPipelineCompilerTest, NothingIsTracedBeforeItsStandInIsThere)
{
	Set("r.RT.Pipeline.RoundMs", "1");
	Set("r.RT.Pipeline.Threads", "3"); // the driver holds two
	Start({});
	AddProgram("Rust");
	Device->Close("StandIn");
	Device->Close("Rust");
	Until([&] {
		const FRTPSOCompilerStats& Stats = Maker->GetStats();
		return Device->WasAsked("StandIn") && Device->WasAsked("Rust") && Stats.Ready + 2 == Stats.Wanted;
	});
	for (int Frame = 0; Frame < 100; ++Frame)
	{
		Maker->Update(Wanted);
		GiveWay(); // a round is over after a millisecond, at least once
		ASSERT_FALSE(Maker->GetCurrent());
	}
	// A link that one of these frames began, against the rule, is the first that is taken, however late.
	Device->Open();
	Until([&] { return Maker->GetCurrent() != nullptr; });
	EXPECT_NE(Maker->GetCurrent()->GetState(Wanted.HitPrograms.back()), ERTHitState::Missing);
}

TEST_F(FPipelineCompilerTest, WhatIsNotWantedForLongIsDropped)
{
	Set("r.RT.Pipeline.KeepFrames", "10");
	const FRTPSODesc Few = Wanted;
	for (int I = 0; I < 30; ++I) { AddProgram("P" + std::to_string(I)); }
	const FRTPSODesc Many = Wanted;
	FinishWanted();
	EXPECT_GE(GetIdleStats().Kept, 30u);
	Wanted = Few;
	FinishWanted();
	for (int Frame = 0; Frame < 60; ++Frame) { FinishWanted(); }
	EXPECT_LE(GetIdleStats().Kept, 6u);
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

TEST_F(FPipelineCompilerTest, ACompileErrorStaysUntilAnEdit)
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

TEST_F(FPipelineCompilerTest, FinishMissesNoResultThatComesWhileItReportsProgress)
{
	AddProgram("Rust");
	Device->Close("Rust");
	bool bOpened = false;
	const auto Progress = [&](float) {
		if (std::exchange(bOpened, true)) { return; }
		const auto IsReadyBut = [&](uint32_t Missing) {
			const FRTPSOCompilerStats& Stats = Maker->GetStats();
			return Stats.Wanted > 0 && Stats.Ready + Missing == Stats.Wanted;
		};
		EXPECT_TRUE(WaitUntil("all units but one", [&] { return IsReadyBut(1); }));
		Device->Open();
		EXPECT_TRUE(WaitUntil("the last unit", [&] { return IsReadyBut(0); }));
	};
	const FHangGuard Guard("the end of Finish, once all units are compiled", [&] { Maker->Reload(); });
	ASSERT_TRUE(Maker->Finish(Wanted, Progress));
	EXPECT_TRUE(bOpened);
	EXPECT_EQ(Maker->GetCurrent()->GetMissingCount(), 0u);
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
