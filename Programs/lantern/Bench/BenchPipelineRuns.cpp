// Pipelines made whole, from libraries, and by the RTPSO compiler, with the clock around them.
#include "Bench/BenchPipelineRuns.h"

#include <algorithm>
#include <chrono>
#include <thread>

#include <fmt/format.h>

#include "LanternCore/Config/ConsoleVariables.h"
#include "LanternScene/Pipelines/RTPSOCompiler.h"

namespace Lantern
{

namespace
{
constexpr uint32_t PayloadBytes = 32;
constexpr double GlslangWork = 0.3; // of a group, in what the driver takes for it

double GetThreadedWork(uint32_t Threads, uint32_t Groups)
{
	return double(Groups) / std::min(Threads, std::max(1u, std::thread::hardware_concurrency()));
}

FRTRayTracingPipelineDesc MakeDesc(const std::vector<FRTShaderCode>& Codes, const std::vector<FRTShaderGroup>& Groups, const char* Name)
{
	FRTRayTracingPipelineDesc Desc;
	Desc.Shaders = Codes.data();
	Desc.ShaderCount = static_cast<uint32_t>(Codes.size());
	Desc.Groups = Groups.data();
	Desc.GroupCount = static_cast<uint32_t>(Groups.size());
	Desc.MaxPayloadBytes = PayloadBytes;
	Desc.Name = Name;
	return Desc;
}

/// Ray generation and miss: first of the codes and groups of a pipeline.
void AddGeneral(const FBenchShaders& Shaders, std::vector<FRTShaderCode>& Codes, std::vector<FRTShaderGroup>& Groups)
{
	Codes.push_back(Shaders.RayGen.GetCode());
	for (const FShaderBinary& Miss : Shaders.Misses) { Codes.push_back(Miss.GetCode()); }
	for (uint32_t Index = 0; Index < Codes.size(); ++Index) { Groups.push_back({ERTGroupKind::General, Index}); }
}

FRTStatus MakeMonolithic(IRTDevice& Device, const FBenchShaders& Shaders, double& OutMs)
{
	std::vector<FRTShaderCode> Codes;
	std::vector<FRTShaderGroup> Groups;
	AddGeneral(Shaders, Codes, Groups);
	for (const FShaderBinary& Hit : Shaders.Hits)
	{
		FRTShaderGroup Group{ERTGroupKind::Triangles};
		Group.ClosestHit = static_cast<uint32_t>(Codes.size());
		Groups.push_back(Group);
		Codes.push_back(Hit.GetCode());
	}
	TRTRef<IRTPipeline> Pipeline;
	const auto Start = FBenchClock::now();
	const FRTStatus Status = Device.CreateRayTracingPipeline(MakeDesc(Codes, Groups, "Monolithic"), Pipeline.ReleaseAndGetAddress());
	OutMs = GetMsSince(Start);
	return Status;
}

FRTStatus MakeFromLibraries(IRTDevice& Device, const FBenchShaders& Shaders, uint32_t Threads, double& OutLibrariesMs, double& OutLinkMs)
{
	std::vector<FRTShaderCode> GeneralCodes;
	std::vector<FRTShaderGroup> GeneralGroups;
	AddGeneral(Shaders, GeneralCodes, GeneralGroups);
	const bool bGeneralLibraries = Device.GetCapabilities().bLibraryOnlyPipelines;
	const uint32_t Hits = static_cast<uint32_t>(Shaders.Hits.size());
	const uint32_t Count = Hits + (bGeneralLibraries ? static_cast<uint32_t>(GeneralCodes.size()) : 0);
	std::vector<TRTRef<IRTPipeline>> Libraries(Count);
	std::vector<FRTStatus> Results(Count);
	auto Start = FBenchClock::now();
	RunOnThreads(Threads, Count, [&](uint32_t Index) {
		FRTShaderGroup Group{Index < Hits ? ERTGroupKind::Triangles : ERTGroupKind::General};
		(Index < Hits ? Group.ClosestHit : Group.General) = 0;
		FRTRayTracingPipelineDesc Desc = MakeDesc({}, {}, "Library");
		const FRTShaderCode Code = Index < Hits ? Shaders.Hits[Index].GetCode() : GeneralCodes[Index - Hits];
		Desc.Shaders = &Code;
		Desc.Groups = &Group;
		Desc.ShaderCount = Desc.GroupCount = 1;
		Desc.bLibrary = true;
		Results[Index] = Device.CreateRayTracingPipeline(Desc, Libraries[Index].ReleaseAndGetAddress());
	});
	OutLibrariesMs = GetMsSince(Start);
	for (const FRTStatus& Result : Results)
	{
		if (!Result) { return Result; }
	}
	std::vector<IRTPipeline*> Linked;
	for (const TRTRef<IRTPipeline>& Library : Libraries) { Linked.push_back(Library.Get()); }
	FRTRayTracingPipelineDesc Desc = bGeneralLibraries ? MakeDesc({}, {}, "Linked") : MakeDesc(GeneralCodes, GeneralGroups, "Linked");
	Desc.Libraries = Linked.data();
	Desc.LibraryCount = static_cast<uint32_t>(Linked.size());
	TRTRef<IRTPipeline> Pipeline;
	Start = FBenchClock::now();
	const FRTStatus Status = Device.CreateRayTracingPipeline(Desc, Pipeline.ReleaseAndGetAddress());
	OutLinkMs = GetMsSince(Start);
	return Status;
}

FRTPSODesc MakeCompilerDesc()
{
	FRTPSODesc Desc;
	Desc.RayGens = {MakeBenchRayGen()};
	FRayType Shadow, Material;
	Shadow.Name = "SHADOW";
	Shadow.Miss.Path = "Rays/Shadow.rmiss";
	Material.Name = "MATERIAL";
	Material.Miss.Path = "Rays/Material.rmiss";
	Material.ClosestHit.emplace().Path = "Rays/Material.rchit";
	Shadow.MaskedAnyHit.Path = Material.MaskedAnyHit.Path = "Rays/AlphaTest.rahit";
	Shadow.PayloadBytes = Material.PayloadBytes = PayloadBytes;
	Desc.RayTypes = {Shadow, Material};
	return Desc;
}

uint32_t AddProgram(FMaterialPrograms& Programs, FRTPSODesc& Desc, uint32_t Index, uint64_t Salt)
{
	const uint32_t Program = Programs.Add(MakeBenchProgram(Index, Salt));
	Desc.HitPrograms.push_back({Program, ERTHitClass::Opaque});
	return Program;
}

void SetThreads(uint32_t Threads)
{
	FConsoleVariables::Get().Set("r.RT.Pipeline.Threads", std::to_string(Threads), ERTSetBy::Console, "bench rtpso");
	FConsoleVariables::Get().BeginFrame();
}
} // namespace

double GetPipelineRunWork(uint32_t Threads, uint32_t Groups, uint32_t Repetitions)
{
	return Repetitions * double(Groups) + (GlslangWork + Repetitions + 1.0) * GetThreadedWork(Threads, Groups);
}

FRTStatus MeasurePipelineRun(
    IRTDevice& Device, FShaderCompiler& Compiler, uint32_t Groups, uint32_t Repetitions, FBenchProgress& Progress, FPipelineRun& Run)
{
	const double Threaded = GetThreadedWork(Run.Threads, Groups);
	const auto Begin = [&](const std::string& What, double Work) {
		Progress.Begin(fmt::format("{} threads: {}", Run.Threads, What), Work);
	};
	FBenchShaders Shaders;
	Begin("glslang", GlslangWork * Threaded);
	if (FRTStatus S = CompileBenchShaders(Compiler, Groups, Run.Threads, Shaders, Run.GlslangMs); !S) { return S; }
	for (uint32_t Repetition = 0; Repetition < Repetitions; ++Repetition)
	{
		for (const bool bMonolithic : {Repetition % 2 == 0, Repetition % 2 != 0})
		{
			if (!RenewShaders(Shaders))
			{
				return FRTStatus::Error(ERTResult::InvalidArgument, "a shader has lost the constant that makes it new");
			}
			double Ms = 0.0, LinkMs = 0.0;
			Begin(fmt::format("{}, {} of {}", bMonolithic ? "whole" : "libraries", Repetition + 1, Repetitions),
			    bMonolithic ? double(Groups) : Threaded);
			const FRTStatus Status =
			    bMonolithic ? MakeMonolithic(Device, Shaders, Ms) : MakeFromLibraries(Device, Shaders, Run.Threads, Ms, LinkMs);
			if (!Status) { return Status; }
			(bMonolithic ? Run.MonolithicMs : Run.LibrariesMs).Add(Ms);
			if (!bMonolithic) { Run.LinkMs.Add(LinkMs); }
			Device.CollectGarbage();
		}
	}
	SetThreads(Run.Threads);
	Begin("from text to RTPSO", Threaded);
	FMaterialPrograms Programs;
	FRTPSODesc Desc = MakeCompilerDesc();
	const uint64_t Salt = MakeSalt();
	for (uint32_t Index = 0; Index < Groups; ++Index) { AddProgram(Programs, Desc, Index, Salt); }
	FRTPSOCompiler Maker(Device, Compiler, Programs);
	const auto Start = FBenchClock::now();
	const FRTStatus Status = Maker.Finish(Desc);
	Run.FinishMs = GetMsSince(Start);
	return Status;
}

FRTStatus MeasureIncremental(IRTDevice& Device, FShaderCompiler& Compiler, uint32_t Groups, uint32_t Added, FIncrementalRun& Out)
{
	SetThreads(0);
	FMaterialPrograms Programs;
	FRTPSODesc Desc = MakeCompilerDesc();
	const uint64_t Salt = MakeSalt();
	for (uint32_t Index = 0; Index < Groups; ++Index) { AddProgram(Programs, Desc, Index, Salt); }
	FRTPSOCompiler Maker(Device, Compiler, Programs);
	if (FRTStatus S = Maker.Finish(Desc); !S) { return S; }
	// Stand-ins, and the first link with them, are no part of what is measured.
	const auto Settle = [&] {
		do {
			Maker.Update(Desc);
			std::this_thread::sleep_for(std::chrono::microseconds(200));
		}
		while (Maker.GetStats().bBusy);
	};
	Settle();
	for (uint32_t Index = 0; Index < Added; ++Index)
	{
		const FHitProgram Program{AddProgram(Programs, Desc, Groups + Index, Salt), ERTHitClass::Opaque};
		const auto Start = FBenchClock::now();
		for (Maker.Update(Desc); Maker.GetCurrent()->GetState(Program) != ERTHitState::Ready; Maker.Update(Desc))
		{
			if (Maker.GetStats().Failed > 0)
			{
				return FRTStatus::Error(ERTResult::CompileFailed, "a material of the benchmark does not compile");
			}
			std::this_thread::sleep_for(std::chrono::microseconds(200));
		}
		Out.ReadyMs.Add(GetMsSince(Start));
		Settle();
		Out.LinkMs.Add(Maker.GetStats().LastLinkMs);
	}
	return FRTStatus::Success();
}

} // namespace Lantern
