// The RTPSO compiler under bad conditions. Hundreds of programs arrive while frames go on, and some are never ready. Every
// console variable changes in every frame. The end, or the loss of the device, comes in the middle of a compile. No frame may
// ever see a wrong record.
#include <chrono>
#include <random>
#include <thread>

#include "LanternScene/Scene/Scene.h"
#include "LanternScene/ShaderTable/SectionTable.h"
#include "LanternScene/ShaderTable/ShaderTable.h"
#include "RTPSOTestTools.h"

namespace Lantern
{
namespace
{

/// A section for each program, in a table whose records follow the compiler's pipelines.
class FPipelineStressTest : public FPipelineTest
{
protected:
	void SetUp() override
	{
		FPipelineTest::SetUp();
		Scene = std::make_unique<FRTScene>(*Device);
		Bindings = std::make_unique<FShaderTable>(*Device);
		ASSERT_NO_FATAL_FAILURE(CreateGeometry());
	}
	void TearDown() override
	{
		Current.reset();
		Bindings.reset();
		Sections.reset();
		Geometry.reset();
		Scene.reset();
		FPipelineTest::TearDown();
	}
	void CreateGeometry()
	{
		FRTGeometryInfo Info;
		Info.Name = "Quad";
		for (TRTRef<IRTBuffer>* Buffer : {&Info.Positions, &Info.Attributes, &Info.Indices})
		{
			const FRTBufferDesc Desc{1024, ERTBufferUsage::Storage | ERTBufferUsage::GeometryInput, ERTMemory::Device, "Quad"};
			ASSERT_TRUE(Device->CreateBuffer(Desc, Buffer->ReleaseAndGetAddress()));
		}
		Info.VertexCount = 3;
		Info.Sections.push_back({0, 3, false});
		ASSERT_TRUE(Scene->CreateGeometry(std::move(Info), Geometry));
	}
	void AddSection(uint32_t Program, bool bMasked)
	{
		FMaterialData Material{};
		Material.Flags = bMasked ? MATERIAL_MASKED : 0u;
		const uint32_t Index = Materials.Add(Material);
		MaterialPrograms.resize(Index + 1, StandardProgram);
		MaterialPrograms[Index] = Program;
		const FSectionRangeId Range = Sections->Acquire(*Geometry, {Index});
		const FHitProgram Hit{Program, bMasked ? ERTHitClass::Masked : ERTHitClass::Opaque};
		Expected.push_back({Sections->GetRange(Range).First, Hit});
	}
	void Frame()
	{
		FConsoleVariables::Get().BeginFrame();
		Wanted.HitPrograms = Sections->GetHitPrograms();
		Maker->Update(Wanted);
		Current = Maker->GetCurrent();
		if (!Current) { return; }
		TRTRef<IRTCommandList> List;
		ASSERT_TRUE(Device->CreateCommandList("Frame", List.ReleaseAndGetAddress()));
		ASSERT_TRUE(List->Begin());
		ASSERT_TRUE(Bindings->Sync(*List, *Current, *Sections));
		ASSERT_TRUE(List->End());
		IRTCommandList* const Lists[] = {List.Get()};
		FRTFence Fence = 0;
		ASSERT_TRUE(Device->Submit(Lists, 1, &Fence));
		Device->Mock().ClearCalls();
	}
	/// Each record is good, and has an alpha test where its class has one.
	void ExpectClasses()
	{
		for (size_t Index = 0; Current && Index < Expected.size(); ++Index)
		{
			const auto& [Section, Hit] = Expected[Index];
			for (uint32_t Type = 0; Type < Current->GetRayTypeCount(); ++Type)
			{
				FRTInstance Instance{};
				Instance.TableOffsetAndFlags = Section * Current->GetRayTypeCount();
				const FRTMockRecord Record = Device->Mock().ResolveHit(Bindings->GetTable(), Instance, 0, Type, Current->GetRayTypeCount());
				ASSERT_TRUE(Record.IsGood()) << Record.Error;
				const bool bAnyHit = IsMasked(Hit.Class) && !Current->IsMissing(Hit);
				ASSERT_EQ(!Record.AnyHit.empty(), bAnyHit);
			}
		}
	}
	std::string NameOf(FHitProgram Hit, const std::string& Seen) const
	{
		// Before there is a stand-in, the standard program serves.
		if (Current->GetState(Hit) == ERTHitState::StandIn) { return Seen.ends_with(" (StandIn)") ? " (StandIn)" : ""; }
		return Hit.Program == StandardProgram ? "" : " (" + Programs->Get(Hit.Program).Name + ")";
	}
	/// Each record runs its own program, or the stand-in of its class, or, where it is to be left out, nothing.
	void ExpectRecords()
	{
		if (!Current) { return; }
		for (const auto& [Section, Hit] : Expected)
		{
			for (uint32_t Type = 0; Type < Current->GetRayTypeCount(); ++Type)
			{
				FRTInstance Instance{};
				Instance.TableOffsetAndFlags = Section * Current->GetRayTypeCount();
				const FRTMockRecord Record = Device->Mock().ResolveHit(Bindings->GetTable(), Instance, 0, Type, Current->GetRayTypeCount());
				ASSERT_TRUE(Record.IsGood()) << Record.Error;
				const bool bRuns = !Current->IsMissing(Hit);
				const bool bMasked = IsMasked(Hit.Class);
				ASSERT_EQ(Record.ClosestHit, bRuns && Type == 1 ? "MATERIAL.hit" + NameOf(Hit, Record.ClosestHit) : "");
				ASSERT_EQ(Record.AnyHit, bRuns && bMasked ? (Type == 1 ? "MATERIAL.any" : "SHADOW.any") + NameOf(Hit, Record.AnyHit) : "");
			}
		}
	}
	/// Frames, each with right records, until Condition holds.
	void FramesUntil(const char* What, const std::function<bool()>& Condition)
	{
		const auto Step = [&] {
			ASSERT_NO_FATAL_FAILURE(Frame());
			ASSERT_NO_FATAL_FAILURE(ExpectRecords());
			GiveWay();
		};
		const auto Describe = [&] {
			const uint32_t Ready = Current ? Count(ERTHitState::Ready) : 0;
			return std::to_string(Ready) + " of " + std::to_string(Expected.size()) + " programs ready";
		};
		ASSERT_TRUE(WaitUntil(What, Condition, Step, Describe));
	}
	uint32_t Count(ERTHitState State) const
	{
		return static_cast<uint32_t>(
		    std::count_if(Expected.begin(), Expected.end(), [&](const auto& Entry) { return Current->GetState(Entry.second) == State; }));
	}

	std::unique_ptr<FRTScene> Scene;
	FRTGeometryRef Geometry;
	TGpuTable<FMaterialData> Materials{"Materials"};
	std::vector<uint32_t> MaterialPrograms;
	FSectionContext Context{Materials, MaterialPrograms};
	std::unique_ptr<FSectionTable> Sections = std::make_unique<FSectionTable>(Context);
	std::unique_ptr<FShaderTable> Bindings;
	std::vector<std::pair<uint32_t, FHitProgram>> Expected; ///< by section
	std::shared_ptr<const FRTPSO> Current;
};

TEST_F(FPipelineStressTest, TwoHundredMaterialsArriveAndSomeAreNeverReady)
{
	Set("r.RT.Pipeline.RoundMs", "5");
	FLogCapture Log;
	Device->Close("Never");
	std::mt19937 Random(26);
	uint32_t Broken = 0, Never = 0, Added = 0;
	for (int Index = 0; Index < 60; ++Index)
	{
		for (; Added < 200u * uint32_t(Index + 1) / 60u; ++Added)
		{
			const bool bNever = Added == 150; // one of the two threads is held for the rest of the test
			const bool bBroken = Added % 17 == 3;
			Never += bNever;
			Broken += bBroken;
			const std::string Name = (bNever ? "Never" : bBroken ? "Broken" : "P") + std::to_string(Added);
			const uint32_t Program =
			    Programs->Add({.Name = Name, .Text = bBroken ? "float Value() { return wrong; }\n" : MakeText(int(Added))});
			AddSection(Program, Random() % 3 == 0);
		}
		ASSERT_NO_FATAL_FAILURE(Frame());
		ASSERT_NO_FATAL_FAILURE(ExpectRecords()) << "frame " << Index;
		GiveWay(); // else they are over before anything is compiled
	}
	const auto IsOver = [&] {
		const bool bReady = Current && Count(ERTHitState::Ready) == Added - Broken - Never;
		return bReady && Log.Count(ERTLogLevel::Error) >= Broken;
	};
	ASSERT_NO_FATAL_FAILURE(FramesUntil("all but one to be compiled or to fail", IsOver));
	EXPECT_EQ(Count(ERTHitState::StandIn), Broken + Never);
	EXPECT_EQ(Log.Count(ERTLogLevel::Error), Broken) << "each is told once";
	// The one that is held keeps the compiler busy: its figures may be old once, and are not for ever.
	const auto AreFailuresCounted = [&] {
		const FRTPSOCompilerStats& Stats = Maker->GetStats();
		return Stats.Failed >= Broken && Stats.Failed == Stats.Failures;
	};
	ASSERT_NO_FATAL_FAILURE(FramesUntil("every failure to be counted once", AreFailuresCounted));
}

TEST_F(FPipelineStressTest, SlowCompilesAreSeenByNoFrame)
{
	AddSection(StandardProgram, false);
	ASSERT_NO_FATAL_FAILURE(FramesUntil("the first pipeline", [&] { return Current != nullptr; }));
	Device->Close("Slow");
	for (int I = 0; I < 4; ++I) { AddSection(Programs->Add({.Name = "Slow" + std::to_string(I), .Text = MakeText(I)}), I % 2 == 0); }
	{
		// The driver lets go only after these: a frame that waited would wait for ever.
		const FHangGuard Guard("frames while the driver holds compiles", [&] { Device->Open(); });
		ASSERT_NO_FATAL_FAILURE(FramesUntil("a compile in the driver", [&] { return Device->WasAsked("Slow"); }));
		for (int I = 0; I < 50; ++I)
		{
			ASSERT_NO_FATAL_FAILURE(Frame());
			ASSERT_NO_FATAL_FAILURE(ExpectRecords());
		}
		EXPECT_EQ(Count(ERTHitState::Ready), 1u) << "the standard one";
	}
	Device->Open();
	const auto AreAllReady = [&] { return Count(ERTHitState::Ready) == Expected.size(); };
	ASSERT_NO_FATAL_FAILURE(FramesUntil("the slow compiles", AreAllReady));
}

TEST_F(FPipelineStressTest, EverythingIsToggledInEveryFrame)
{
	std::mt19937 Random(7);
	const auto Below = [&](size_t Limit) { return static_cast<uint32_t>(Random() % Limit); };
	const auto Toggle = [&](const char* Name, std::vector<const char*> Values) { Set(Name, Values[Below(Values.size())]); };
	const FRTPSODesc Both = Wanted;
	for (int Index = 0; Index < 300; ++Index)
	{
		Toggle("r.RT.Pipeline.Libraries", {"0", "1", "1", "1"});
		Toggle("r.RT.Pipeline.Threads", {"1", "2", "5"});
		Toggle("r.RT.Pipeline.RoundMs", {"1", "5", "1000"});
		Toggle("r.RT.Pipeline.Fallback", {"0", "1"});
		Toggle("r.RT.Pipeline.KeepFrames", {"1", "20"});
		Toggle("r.RT.SBT.Mode", {"0", "1"});
		if (Below(4) == 0) { AddSection(Programs->Add({.Name = "P" + std::to_string(Index), .Text = MakeText(Index)}), Below(2)); }
		if (Below(6) == 0) { Programs->Edit(Below(Programs->GetCount()), {.Name = "E" + std::to_string(Index), .Text = MakeText(Index)}); }
		Wanted = Both;
		if (Below(8) == 0) { Wanted.RayTypes.pop_back(); }
		if (Below(8) == 0) { Wanted.RayGens[0].Defines.emplace_back("V", "1"); }
		if (Below(10) == 0) { Maker->Reload(); }
		if (Below(30) == 0)
		{
			Wanted.HitPrograms = Sections->GetHitPrograms();
			const FRTStatus Status = Maker->Finish(Wanted);
			ASSERT_TRUE(Status) << Status.Message;
		}
		ASSERT_NO_FATAL_FAILURE(Frame());
		ASSERT_NO_FATAL_FAILURE(ExpectClasses()) << "frame " << Index;
	}
	Wanted = Both;
	const auto IsWhole = [&] { return Current && Count(ERTHitState::Ready) == Expected.size() && Current->GetRayTypeCount() == 2; };
	const auto Step = [&] {
		ASSERT_NO_FATAL_FAILURE(Frame());
		GiveWay();
	};
	EXPECT_TRUE(WaitUntil("all programs, once nothing is toggled any more", IsWhole, Step));
}

TEST_F(FPipelineStressTest, EndInTheMiddleOfACompileIsClean)
{
	for (const char* Part : {"Slow", "RTPSO"})
	{
		Device->Close(Part);
		for (int I = 0; I < 20; ++I) { AddProgram("Slow" + std::to_string(I)); }
		Until([&] { return Device->WasAsked(Part); }, "a compile in the driver");
		// The compiler waits for what is in the driver, and nobody sees it wait: right whichever of the two comes first.
		std::thread Driver([&] {
			std::this_thread::sleep_for(std::chrono::milliseconds(20));
			Device->Open();
		});
		Maker = nullptr;
		Driver.join();
		Maker = std::make_unique<FRTPSOCompiler>(*Device, *Compiler, *Programs);
		Device->ForgetAsked();
	}
}

TEST_F(FPipelineStressTest, LostDeviceEndsCompilingAndNothingElse)
{
	UntilIdle();
	for (int I = 0; I < 20; ++I) { AddProgram("P" + std::to_string(I)); }
	Device->Close("P1");
	Until([&] { return Device->WasAsked("P1"); }, "a compile in the driver");
	Device->Mock().LoseDevice();
	Device->Open();
	Until([&] { return Maker->Finish(Wanted).Code == ERTResult::DeviceLost; }, "the loss to be noticed");
	EXPECT_TRUE(Maker->GetCurrent());
}

} // namespace
} // namespace Lantern
