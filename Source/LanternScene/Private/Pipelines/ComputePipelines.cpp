// Which compute pipelines there are, which are asked for, and who waits for what.
#include "LanternScene/Pipelines/ComputePipelines.h"

#include <map>
#include <string>
#include <utility>

#include "Pipelines/ComputeThreads.h"
#include "Pipelines/PipelineVariables.h"
#include "Pipelines/RTPSOFailureLog.h"

namespace Lantern
{

namespace
{
constexpr uint64_t RetryFrames = 60; ///< after a shortage of memory

std::string MakeName(const FShaderSource& Source)
{
	std::string Name = Source.Path;
	for (const auto& [Define, Value] : Source.Defines) { Name += ' ' + Define + (Value == "1" ? "" : '=' + Value); }
	return Name;
}
} // namespace

struct FComputePipelines::FImpl
{
	struct FEntry
	{
		FComputeJobRef Job;
		uint64_t LastUsed = 0; ///< frame
		uint64_t RetryAt = 0;  ///< frame; after a shortage of memory, 0: none that is known
	};
	FImpl(IRTDevice& Device, FShaderCompiler& Compiler) : Threads(Device, Compiler) {}

	FComputeJob& Ask(const FShaderSource& Source, bool bRetry);
	bool IsDue(FEntry& Entry, bool bRetry) const;

	std::map<std::string, FEntry> Entries;
	uint64_t Frame = 0;
	bool bAnyToCome = false;
	FComputeThreads Threads; ///< last: its end joins them
};

/// Whether a compile is to begin. bRetry: at once after a shortage of memory.
bool FComputePipelines::FImpl::IsDue(FEntry& Entry, bool bRetry) const
{
	if (!Entry.Job) { return true; }
	if (!Entry.Job->IsDone() || !IsShortage(Entry.Job->Status)) { return false; }
	if (Entry.RetryAt == 0) { Entry.RetryAt = Frame + RetryFrames; }
	return bRetry || Frame >= Entry.RetryAt;
}

FComputeJob& FComputePipelines::FImpl::Ask(const FShaderSource& Source, bool bRetry)
{
	std::string Name = MakeName(Source);
	FEntry& Entry = Entries[Name];
	Entry.LastUsed = Frame;
	if (IsDue(Entry, bRetry))
	{
		Entry.RetryAt = 0;
		Entry.Job = std::make_shared<FComputeJob>();
		Entry.Job->Source = Source;
		Entry.Job->Name = std::move(Name);
		Threads.Add(Entry.Job, GetPipelineThreadCount());
	}
	bAnyToCome |= !Entry.Job->IsDone() || IsShortage(Entry.Job->Status);
	return *Entry.Job;
}

FComputePipelines::FComputePipelines(IRTDevice& Device, FShaderCompiler& Compiler) : Impl(std::make_unique<FImpl>(Device, Compiler)) {}
FComputePipelines::~FComputePipelines() = default;

void FComputePipelines::BeginFrame()
{
	++Impl->Frame;
	Impl->bAnyToCome = false;
	const uint64_t KeepFrames = GetPipelineKeepFrames();
	std::erase_if(Impl->Entries, [&](const auto& Item) {
		const FImpl::FEntry& Entry = Item.second;
		if (!Entry.Job->IsDone() || Impl->Frame - Entry.LastUsed <= KeepFrames) { return false; }
		Impl->Threads.Discard(Entry.Job);
		return true;
	});
	Impl->Threads.HandOver(false);
}

void FComputePipelines::Want(const std::vector<FShaderSource>& Sources)
{
	for (const FShaderSource& Source : Sources) { (void)Impl->Ask(Source, false); }
	Impl->Threads.HandOver(false);
}

FRTStatus FComputePipelines::Find(const FShaderSource& Source, IRTPipeline*& Out)
{
	const FComputeJob& Job = Impl->Ask(Source, false);
	Impl->Threads.HandOver(false);
	const bool bDone = Job.IsDone();
	Out = bDone ? Job.Pipeline.Get() : nullptr;
	return bDone ? Job.Status : FRTStatus::Success();
}

FRTStatus FComputePipelines::GetCompute(const FShaderSource& Source, IRTPipeline*& Out)
{
	const FComputeJob& Job = Impl->Ask(Source, true);
	Impl->Threads.HandOver(true);
	Impl->Threads.Wait(Job);
	Out = Job.Pipeline.Get();
	return Job.Status;
}

FRTStatus FComputePipelines::Finish(const std::vector<FShaderSource>& Sources, const std::function<void(float)>& Progress)
{
	std::vector<const FComputeJob*> Jobs;
	Jobs.reserve(Sources.size());
	for (const FShaderSource& Source : Sources) { Jobs.push_back(&Impl->Ask(Source, true)); }
	Impl->Threads.HandOver(true);
	FRTStatus Status;
	for (size_t I = 0; I < Jobs.size(); ++I)
	{
		Impl->Threads.Wait(*Jobs[I]);
		if (Status) { Status = Jobs[I]->Status; }
		if (Progress) { Progress(static_cast<float>(I + 1) / static_cast<float>(Jobs.size())); }
	}
	if (Progress && Jobs.empty()) { Progress(1.0f); }
	return Status;
}

bool FComputePipelines::IsAnyToCome() const { return Impl->bAnyToCome; }

size_t FComputePipelines::GetCount() const { return Impl->Entries.size(); }

std::vector<FShaderSource> FComputePipelines::GetSources() const
{
	std::vector<FShaderSource> Sources;
	Sources.reserve(Impl->Entries.size());
	for (const auto& [Name, Entry] : Impl->Entries) { Sources.push_back(Entry.Job->Source); }
	return Sources;
}

} // namespace Lantern
