// Tools for tests of the RTPSO compiler: a device whose compiles the test holds up, small programs, and the shaders that
// records run.
#pragma once

#include <condition_variable>
#include <functional>
#include <memory>
#include <mutex>
#include <set>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "LanternCore/Config/ConsoleVariables.h"
#include "LanternRHIMock/MockDevice.h"
#include "LanternScene/Pipelines/RTPSOCompiler.h"
#include "Support/CoreTestTools.h"
#include "Support/WaitTools.h"

namespace Lantern
{

/// Forwards to a mock device. Creation of ray-tracing pipelines goes through a gate.
class FGatedDevice final : public IRTDevice
{
public:
	explicit FGatedDevice(const FRTMockDesc& Desc)
	{
		const FRTStatus Status = CreateMockDevice(Desc, Inner.ReleaseAndGetAddress());
		EXPECT_TRUE(Status) << Status.Message;
	}
	FRTMock& Mock() { return GetMock(Inner.Get()); }
	IRTDevice& GetInner() { return *Inner; }

	/// Pipelines whose name contains Part stay in the driver until Open.
	void Close(const std::string& Part)
	{
		const std::lock_guard Lock(Mutex);
		Closed.insert(Part);
	}
	void Open()
	{
		{
			const std::lock_guard Lock(Mutex);
			Closed.clear();
		}
		Opened.notify_all();
	}
	/// Lets pipelines go that Close(Part) holds.
	void Open(const std::string& Part)
	{
		{
			const std::lock_guard Lock(Mutex);
			Closed.erase(Part);
		}
		Opened.notify_all();
	}
	/// Names of the pipelines that the driver was asked for, in that order.
	std::vector<std::string> GetAsked() const
	{
		const std::lock_guard Lock(Mutex);
		return Asked;
	}
	uint32_t CountAsked(const std::string& Name) const
	{
		const std::lock_guard Lock(Mutex);
		return static_cast<uint32_t>(std::count(Asked.begin(), Asked.end(), Name));
	}
	/// Whether the driver was asked for something whose name contains Part.
	bool WasAsked(const std::string& Part) const
	{
		const std::lock_guard Lock(Mutex);
		return std::any_of(Asked.begin(), Asked.end(), [&](const std::string& Name) { return Name.find(Part) != std::string::npos; });
	}
	void ForgetAsked()
	{
		const std::lock_guard Lock(Mutex);
		Asked.clear();
	}

	FRTStatus CreateRayTracingPipeline(const FRTRayTracingPipelineDesc& Desc, IRTPipeline** Out) override
	{
		{
			std::unique_lock Lock(Mutex);
			const std::string Name = Desc.Name;
			Asked.push_back(Name);
			const auto IsClosed = [&](const std::string& Part) { return Name.find(Part) != std::string::npos; };
			Opened.wait(Lock, [&] { return std::none_of(Closed.begin(), Closed.end(), IsClosed); });
		}
		return Inner->CreateRayTracingPipeline(Desc, Out);
	}

	uint32_t AddRef() override { return 1; }
	uint32_t Release() override { return 1; }
	uint32_t GetVersion() const override { return Inner->GetVersion(); }
	const FRTCapabilities& GetCapabilities() const override { return Inner->GetCapabilities(); }
	FRTStatus CreateBuffer(const FRTBufferDesc& D, IRTBuffer** O) override { return Inner->CreateBuffer(D, O); }
	FRTStatus CreateTexture(const FRTTextureDesc& D, IRTTexture** O) override { return Inner->CreateTexture(D, O); }
	FRTStatus ImportBuffer(const FRTBufferDesc& D, const FRTNativeBuffer& N, IRTBuffer** O) override
	{
		return Inner->ImportBuffer(D, N, O);
	}
	FRTStatus ImportTexture(const FRTTextureDesc& D, uint64_t N, IRTTexture** O) override { return Inner->ImportTexture(D, N, O); }
	FRTStatus CreateSampler(const FRTSamplerDesc& D, IRTSampler** O) override { return Inner->CreateSampler(D, O); }
	FRTStatus CreateComputePipeline(const FRTComputePipelineDesc& D, IRTPipeline** O) override
	{
		return Inner->CreateComputePipeline(D, O);
	}
	FRTStatus CreateRasterPipeline(const FRTRasterPipelineDesc& D, IRTPipeline** O) override { return Inner->CreateRasterPipeline(D, O); }
	FRTStatus CreateGeometry(const FRTGeometryDesc& D, IRTGeometry** O) override { return Inner->CreateGeometry(D, O); }
	FRTBuildSizes GetGeometrySizes(const FRTGeometryDesc& D) override { return Inner->GetGeometrySizes(D); }
	FRTStatus CreateScene(const FRTSceneDesc& D, IRTScene** O) override { return Inner->CreateScene(D, O); }
	FRTStatus CreateShaderTable(const FRTShaderTableDesc& D, IRTShaderTable** O) override { return Inner->CreateShaderTable(D, O); }
	FRTStatus CreateQueryPool(ERTQuery K, uint32_t C, IRTQueryPool** O) override { return Inner->CreateQueryPool(K, C, O); }
	FRTStatus CreateCommandList(const char* N, IRTCommandList** O, ERTQueue Q = ERTQueue::Graphics) override
	{
		return Inner->CreateCommandList(N, O, Q);
	}
	FRTStatus ImportCommandList(uint64_t N, IRTCommandList** O) override { return Inner->ImportCommandList(N, O); }
	FRTStatus Submit(IRTCommandList* const* L, uint32_t C, FRTFence* O, const FRTFence* W = nullptr, uint32_t N = 0) override
	{
		return Inner->Submit(L, C, O, W, N);
	}
	FRTStatus NotifyExternalSubmit(IRTCommandList* const* L, uint32_t C, FRTFence* O, const FRTFence* W, uint32_t N) override
	{
		return Inner->NotifyExternalSubmit(L, C, O, W, N);
	}
	FRTFence GetCompletedFence(ERTQueue Q = ERTQueue::Graphics) override { return Inner->GetCompletedFence(Q); }
	FRTStatus WaitFor(FRTFence F, uint64_t T) override { return Inner->WaitFor(F, T); }
	FRTStatus WaitIdle() override { return Inner->WaitIdle(); }
	void CollectGarbage() override { Inner->CollectGarbage(); }
	FRTMemoryStats GetMemoryStats() const override { return Inner->GetMemoryStats(); }
	uint32_t GetValidationMessageCount() const override { return Inner->GetValidationMessageCount(); }
	uint64_t GetNative(ERTNative K) const override { return Inner->GetNative(K); }

private:
	TRTRef<IRTDevice> Inner;
	mutable std::mutex Mutex;
	std::condition_variable Opened;
	std::set<std::string> Closed;
	std::vector<std::string> Asked;
};

class FPipelineTest : public ::testing::Test
{
protected:
	static constexpr const char* Head = "#version 460\n#extension GL_EXT_ray_tracing : require\n";

	void SetUp() override
	{
		FConsoleVariables::Get().ResetAll();
		for (const char* Name : {"/Materials", "/Rays"}) { std::filesystem::create_directory(Folder.GetPath() + Name); }
		Folder.Write("Materials/Material.glsl", "float Value() { return 0.0; }\n");
		Set("r.RT.Pipeline.Threads", "2");
		Set("r.RT.Pipeline.RoundMs", "600000"); // rounds end when they are done
		Start({});
	}
	void TearDown() override
	{
		Device->Open();
		Maker.reset();
		EXPECT_EQ(Device->Mock().GetErrors(), std::vector<std::string>());
		Tables.clear();
		EXPECT_EQ(Device->Mock().GetLiveObjectCount(), 0u) << ::testing::PrintToString(Device->Mock().GetLiveObjects());
		FConsoleVariables::Get().ResetAll();
		FConsoleVariables::Get().BeginFrame();
	}
	void Start(const FRTMockDesc& Desc)
	{
		Maker.reset();
		Tables.clear();
		Device = std::make_unique<FGatedDevice>(Desc);
		Compiler = std::make_unique<FShaderCompiler>(FShaderCompilerDesc{.SearchFolders = {Folder.GetPath()}});
		Programs = std::make_unique<FMaterialPrograms>();
		Wanted = MakeDesc();
		Maker = std::make_unique<FRTPSOCompiler>(*Device, *Compiler, *Programs);
	}
	static void Set(const char* Name, const char* Value)
	{
		EXPECT_FALSE(FConsoleVariables::Get().Set(Name, Value, ERTSetBy::Console, "test"));
		FConsoleVariables::Get().BeginFrame();
	}
	static FShaderSource MakeShader(const std::string& Name, const std::string& Body = "void main() {}\n")
	{
		FShaderSource Source;
		Source.Path = Name;
		Source.Text = Head + Body;
		return Source;
	}
	/// SHADOW runs nothing on opaque hits; MATERIAL runs the program.
	static FRTPSODesc MakeDesc()
	{
		const std::string Hit = "#include \"Materials/Material.glsl\"\nvoid main() { float V = Value(); }\n";
		FRTPSODesc Desc;
		Desc.RayGens = {MakeShader("Generate")};
		for (const char* Name : {"SHADOW", "MATERIAL"})
		{
			FRayType& Ray = Desc.RayTypes.emplace_back();
			Ray.Name = Name;
			Ray.Miss = MakeShader(std::string(Name) + ".miss");
			Ray.MaskedAnyHit = MakeShader(std::string(Name) + ".any", Hit);
			Ray.PayloadBytes = 16;
		}
		Desc.RayTypes[1].ClosestHit = MakeShader("MATERIAL.hit", Hit);
		Desc.HitPrograms = {{StandardProgram, ERTHitClass::Opaque}};
		return Desc;
	}
	/// A program of its own text, wanted from now on.
	uint32_t AddProgram(const std::string& Name, ERTHitClass Class = ERTHitClass::Opaque)
	{
		const uint32_t Program = Programs->Add({.Name = Name, .Text = MakeText(static_cast<int>(Programs->GetCount()))});
		Wanted.HitPrograms.push_back({Program, Class});
		return Program;
	}
	static std::string MakeText(int Value) { return "float Value() { return " + std::to_string(Value) + ".0; }\n"; }

	/// Frames until Condition holds.
	void Until(const std::function<bool()>& Condition, const char* What = "the pipeline compiler")
	{
		const auto Frame = [&] {
			Maker->Update(Wanted);
			GiveWay();
		};
		ASSERT_TRUE(WaitUntil(What, Condition, Frame, [&] { return DescribeProgress(); }));
	}
	/// Waits without frames until Condition holds.
	void WaitFor(const std::function<bool()>& Condition, const char* What = "the pipeline compiler, without frames")
	{
		ASSERT_TRUE(WaitUntil(What, Condition, {}, [&] { return DescribeProgress(); }));
	}
	/// Waits until the compiler is idle in several frames running. A frame that finds its lock taken starts nothing, and looks as
	/// idle as before.
	void UntilIdle()
	{
		constexpr int Running = 4;
		int Idle = 0;
		const auto IsIdle = [&] {
			Idle = Maker->GetStats().bBusy ? 0 : Idle + 1;
			return Idle >= Running;
		};
		Until(IsIdle, "the pipeline compiler to be idle");
	}
	/// Returns the figures of an idle compiler. While its lock is taken, GetStats has old figures and says that it is busy.
	FRTPSOCompilerStats GetIdleStats()
	{
		FRTPSOCompilerStats Stats;
		const auto IsIdle = [&] {
			Stats = Maker->GetStats();
			return !Stats.bBusy;
		};
		WaitFor(IsIdle, "the figures of an idle pipeline compiler");
		return Stats;
	}
	std::string DescribeProgress()
	{
		const FRTPSOCompilerStats& Stats = Maker->GetStats();
		return std::to_string(Stats.Ready) + " of " + std::to_string(Stats.Wanted) + " groups ready, " + std::to_string(Stats.Links) +
		       " links taken";
	}
	bool IsReady(FHitProgram Program)
	{
		const auto Current = Maker->GetCurrent();
		return Current && Current->GetState(Program) == ERTHitState::Ready;
	}
	void FinishWanted()
	{
		const FRTStatus Status = Maker->Finish(Wanted);
		ASSERT_TRUE(Status) << Status.Message;
		ASSERT_TRUE(Maker->GetCurrent());
	}
	/// Returns the shaders that a hit record of Program runs.
	FRTMockRecord ResolveHit(const FRTPSO& Pipeline, uint32_t RayType, FHitProgram Program)
	{
		return ResolveGroup(Pipeline, ERTRecordKind::Hit, Pipeline.HitGroup(RayType, Program));
	}
	FRTMockRecord ResolveGroup(const FRTPSO& Pipeline, ERTRecordKind Kind, uint32_t Group)
	{
		FRTShaderTableDesc Desc;
		Desc.Pipeline = Pipeline.GetPipeline();
		Desc.RayGenCount = Desc.MissCount = Desc.HitCount = Desc.CallableCount = 1;
		TRTRef<IRTShaderTable> Table;
		TRTRef<IRTCommandList> List;
		EXPECT_TRUE(Device->CreateShaderTable(Desc, Table.ReleaseAndGetAddress()));
		Table->SetRecord(Kind, 0, Group, nullptr, 0);
		EXPECT_TRUE(Device->CreateCommandList("Records", List.ReleaseAndGetAddress()));
		EXPECT_TRUE(List->Begin());
		List->UpdateShaderTable(Table.Get());
		EXPECT_TRUE(List->End());
		IRTCommandList* const Lists[] = {List.Get()};
		FRTFence Fence = 0;
		EXPECT_TRUE(Device->Submit(Lists, 1, &Fence));
		Tables.push_back(Table);
		return Device->Mock().ResolveRecord(Table.Get(), Kind, 0);
	}
	void ExpectOwn(FHitProgram Program, const std::string& Name)
	{
		const auto Current = Maker->GetCurrent();
		ASSERT_TRUE(Current);
		EXPECT_EQ(Current->GetState(Program), ERTHitState::Ready) << Name;
		const std::string Suffix = Program.Program == StandardProgram ? "" : " (" + Name + ")";
		const bool bMasked = IsMasked(Program.Class);
		EXPECT_EQ(ResolveHit(*Current, 1, Program).ClosestHit, "MATERIAL.hit" + Suffix);
		EXPECT_EQ(ResolveHit(*Current, 1, Program).AnyHit, bMasked ? "MATERIAL.any" + Suffix : "");
		EXPECT_EQ(ResolveHit(*Current, 0, Program).ClosestHit, "");
		EXPECT_EQ(ResolveHit(*Current, 0, Program).AnyHit, bMasked ? "SHADOW.any" + Suffix : "");
	}
	void ExpectStandIn(FHitProgram Program)
	{
		const auto Current = Maker->GetCurrent();
		ASSERT_TRUE(Current);
		EXPECT_EQ(Current->GetState(Program), ERTHitState::StandIn);
		const bool bMasked = IsMasked(Program.Class);
		EXPECT_EQ(ResolveHit(*Current, 1, Program).ClosestHit, "MATERIAL.hit (StandIn)");
		EXPECT_EQ(ResolveHit(*Current, 1, Program).AnyHit, bMasked ? "MATERIAL.any (StandIn)" : "");
		EXPECT_EQ(ResolveHit(*Current, 0, Program).AnyHit, bMasked ? "SHADOW.any (StandIn)" : "");
	}

	FTemporaryFolder Folder;
	std::unique_ptr<FGatedDevice> Device;
	std::unique_ptr<FShaderCompiler> Compiler;
	std::unique_ptr<FMaterialPrograms> Programs;
	FRTPSODesc Wanted;
	std::unique_ptr<FRTPSOCompiler> Maker;
	std::vector<TRTRef<IRTShaderTable>> Tables;
};

constexpr FHitProgram Opaque(uint32_t Program) { return {Program, ERTHitClass::Opaque}; }
constexpr FHitProgram Masked(uint32_t Program) { return {Program, ERTHitClass::Masked}; }

} // namespace Lantern
