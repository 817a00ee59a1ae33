// What the compiler's own threads do.
#include <algorithm>
#include <cassert>

#ifdef __linux__
#include <sys/resource.h>
#include <sys/syscall.h>
#include <unistd.h>
#endif

#include "LanternCore/Tasks/TaskTrace.h"
#include "LanternCore/Text/Log.h"
#include "Pipelines/RTPSOCompilerImpl.h"

namespace Lantern
{

namespace
{
double MsSince(FPipelineClock::time_point Start)
{
	return std::chrono::duration<double, std::milli>(FPipelineClock::now() - Start).count();
}

bool IsShortage(const FRTStatus& Status)
{
	return Status.Code == ERTResult::OutOfDeviceMemory || Status.Code == ERTResult::OutOfHostMemory ||
	       Status.Code == ERTResult::OutOfDescriptors;
}

constexpr uint64_t RetryFrames = 60;

/// Where there are fewer cores than threads, frames come first. Linux gives each thread a nice value of its own.
void GiveWayToFrames()
{
#ifdef __linux__
	constexpr int Nice = 10;
	(void)setpriority(PRIO_PROCESS, static_cast<id_t>(syscall(SYS_gettid)), Nice);
#endif
}
} // namespace

void FRTPSOCompiler::FImpl::RunCompiler(uint32_t Index)
{
	GiveWayToFrames();
	FTaskTrace::NameThread("Pipeline compiler " + std::to_string(Index));
	std::unique_lock Lock(Mutex);
	for (;;)
	{
		WorkAdded.wait(Lock, [&] { return bStop || (Index < ThreadLimit && !IsQueueEmpty()); });
		if (bStop) { return; }
		CompileNext(Lock);
	}
}

void FRTPSOCompiler::FImpl::RunLinker()
{
	FTaskTrace::NameThread("Pipeline linker");
	std::unique_lock Lock(Mutex);
	for (;;)
	{
		WorkAdded.wait(Lock, [&] { return bStop || bLinkWanted || bReload || !Trash.empty(); });
		if (bStop) { return; }
		if (bLinkWanted) { LinkNext(Lock); }
		else if (bReload) { LookForEdits(Lock); }
		else { EmptyTrash(Lock); }
	}
}

void FRTPSOCompiler::FImpl::CompileNext(std::unique_lock<std::mutex>& Lock)
{
	FJob Job;
	Job.Slot = std::move(Queue[NextQueued++]);
	Job.Slot->State = ESlotState::Compiling;
	Job.Unit = Job.Slot->Unit;
	Job.Version = Job.Slot->GetVersion();
	auto Build = std::make_shared<FPipelineBuild>();
	Build->Id = NextBuild++;
	++Running;
	Lock.unlock();

	FRTStatus Status;
	{
		FTraceScope Trace("Compile", Job.Unit.Name);
		Job.ContentKey = GetContentKey(Job.Unit);
		Status = CompileShaders(Job, *Build);
		if (Status && Job.Slot->bLibrary) { Status = CompileLibrary(Job, *Build); }
	}

	Lock.lock();
	--Running;
	StoreResult(Job, Status, std::move(Build));
	++DoneCount;
	bDirty |= !bRound; // it took longer than its round
	EndRoundIfOver();
	SomethingDone.notify_all();
}

std::string FRTPSOCompiler::FImpl::GetContentKey(const FPipelineUnit& Unit)
{
	std::string Key;
	for (size_t I = 0; I < Unit.Shaders.size(); ++I) { Key += Compiler.GetKey(Unit.GetSource(I)) + ' '; }
	return Key;
}

FRTStatus FRTPSOCompiler::FImpl::CompileShaders(FJob& Job, FPipelineBuild& Build)
{
	const auto Start = FPipelineClock::now();
	Build.Kind = Job.Unit.Kind;
	FRTStatus Status;
	for (size_t I = 0; I < Job.Unit.Shaders.size(); ++I)
	{
		Build.Stages.push_back(Job.Unit.Shaders[I].Stage);
		Status = Status ? GetBinary(Job.Unit.GetSource(I), Job.Version, Build.Codes.emplace_back()) : Status;
	}
	Job.GlslangMs = MsSince(Start);
	return Status;
}

FRTStatus FRTPSOCompiler::FImpl::GetBinary(const FShaderSource& Source, uint64_t Version, FShaderBinaryRef& Out)
{
	std::string Key = MakeSourceKey(Source) + '|' + Source.Name + '|' + std::to_string(Version);
	for (const FShaderHeader& Header : Source.Headers) { Key += '|' + Header.Text; }
	std::shared_ptr<FSharedShader> Entry;
	{
		const std::lock_guard Lock(Mutex);
		std::shared_ptr<FSharedShader>& Found = Shared[Key];
		if (!Found) { Found = std::make_shared<FSharedShader>(); }
		Entry = Found;
	}
	const std::lock_guard Lock(Entry->Mutex);
	if (!Entry->bDone)
	{
		auto Binary = std::make_shared<FShaderBinary>();
		Entry->Status = Compiler.Compile(Source, *Binary);
		Entry->Binary = std::move(Binary);
		Entry->bDone = true;
	}
	Out = Entry->Binary;
	return Entry->Status;
}

FRTStatus FRTPSOCompiler::FImpl::CompileLibrary(FJob& Job, FPipelineBuild& Build)
{
	const auto Start = FPipelineClock::now();
	std::vector<FRTShaderCode> Codes;
	std::vector<uint32_t> Indices;
	for (const FShaderBinaryRef& Binary : Build.Codes)
	{
		Indices.push_back(static_cast<uint32_t>(Codes.size()));
		Codes.push_back(Binary->GetCode());
	}
	const FRTShaderGroup Groups[] = {MakeGroup(Build.Kind, Build.Stages, Indices), {ERTGroupKind::Triangles}};
	FRTRayTracingPipelineDesc Desc;
	Desc.Shaders = Codes.data();
	Desc.ShaderCount = static_cast<uint32_t>(Codes.size());
	Desc.Groups = Groups;
	Build.bEmptyGroup = Job.Slot->bEmptyGroup;
	Desc.GroupCount = Build.bEmptyGroup ? 2 : 1;
	Desc.bLibrary = true;
	Desc.MaxPayloadBytes = Job.Slot->PayloadBytes;
	Desc.Name = Job.Unit.Name.c_str();
	const FRTStatus Status = Device.CreateRayTracingPipeline(Desc, Build.Library.ReleaseAndGetAddress());
	Build.Codes.clear();
	Job.DriverMs = MsSince(Start);
	return Status;
}

void FRTPSOCompiler::FImpl::StoreResult(const FJob& Job, const FRTStatus& Status, std::shared_ptr<FPipelineBuild> Build)
{
	FPipelineSlot& Slot = *Job.Slot;
	Slot.State = ESlotState::Idle;
	Slot.ContentKey = Job.ContentKey;
	Slot.Error = Status;
	Stats.GlslangMs += Job.GlslangMs;
	Stats.DriverMs += Job.DriverMs;
	if (Status)
	{
		++Stats.Compiled;
		Slot.Ready = std::move(Build);
		Slot.ReadyVersion = Job.Version;
		return;
	}
	if (Status.Code == ERTResult::DeviceLost)
	{
		LoseDevice(Status);
		NextQueued = Queue.size();
	}
	else if (IsShortage(Status))
	{
		Slot.RetryAt = Frame + RetryFrames;
		RetryFrame = Slot.RetryAt;
	}
	else
	{
		++Stats.Failures;
		Slot.FailedVersion = Job.Version;
		ReportFailure(Job, Status);
	}
}

void FRTPSOCompiler::FImpl::LoseDevice(const FRTStatus& Error)
{
	bLost = true;
	LostError = Error;
	bHeld = false;
}

void FRTPSOCompiler::FImpl::ReportFailure(const FJob& Job, const FRTStatus& Status)
{
	// Several groups are made from one text; they differ in what else they say behind the first line.
	constexpr size_t MostReported = 1000;
	if (Reported.size() > MostReported) { Reported.clear(); }
	const std::string_view Text = Status.Message;
	if (!Reported.insert(std::to_string(Job.Version) + std::string(Text.substr(0, Text.find('\n')))).second) { return; }
	LogError("{} does not compile{}:\n{}", Job.Unit.Name, Job.Slot->Ready ? "; the version before stays" : "", Status.Message);
}

void FRTPSOCompiler::FImpl::LinkNext(std::unique_lock<std::mutex>& Lock)
{
	bLinkWanted = false;
	bLinking = true;
	FLinkPlan Plan = std::move(LinkPlan);
	Lock.unlock();
	const auto Start = FPipelineClock::now();
	std::shared_ptr<const FRTPSO> Pipeline;
	FRTStatus Status;
	{
		FTraceScope Trace("Link RTPSO");
		Status = Link(Plan, Pipeline);
	}
	const double Ms = MsSince(Start);
	Lock.lock();
	bLinking = false;
	bLinkDone = true;
	LinkStatus = Status;
	Stats.LastLinkMs = Ms;
	++DoneCount;
	if (Status) { Linked = {std::move(Pipeline), std::move(Plan), bLinkExact, Frame}; }
	else if (Status.Code == ERTResult::DeviceLost) { LoseDevice(Status); }
	else
	{
		FailedLink = std::move(Plan.Key);
		if (IsShortage(Status)) { RetryFrame = Frame + RetryFrames; }
		else if (Reported.insert(Status.Message).second) { LogError("RTPSO: the link fails; the one before stays: {}", Status.Message); }
	}
	SomethingDone.notify_all();
}

void FRTPSOCompiler::FImpl::EmptyTrash(std::unique_lock<std::mutex>& Lock)
{
	std::vector<std::shared_ptr<void>> Doomed;
	Doomed.swap(Trash);
	Lock.unlock();
	Doomed.clear();
	Lock.lock();
}

void FRTPSOCompiler::FImpl::LookForEdits(std::unique_lock<std::mutex>& Lock)
{
	struct FLook
	{
		FPipelineSlotRef Slot;
		FPipelineUnit Unit;
		std::string ContentKey;
		uint64_t Version;
	};
	std::vector<FLook> Looks;
	for (const auto& [Key, Slot] : Slots)
	{
		if (Slot->IsSettled()) { Looks.push_back({Slot, Slot->Unit, Slot->ContentKey, Slot->GetVersion()}); }
	}
	Lock.unlock();
	std::erase_if(Looks, [&](const FLook& Look) { return GetContentKey(Look.Unit) == Look.ContentKey; });
	Lock.lock();
	bReload = false;
	for (const FLook& Look : Looks)
	{
		if (Look.Slot->GetVersion() != Look.Version) { continue; }
		++Look.Slot->Reloads;
		bDirty = true;
		bFinished = false;
	}
	++DoneCount;
	SomethingDone.notify_all();
}

} // namespace Lantern
