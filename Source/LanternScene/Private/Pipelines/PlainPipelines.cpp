// Which plain pipelines there are, which are asked for, and who waits for what.
#include "LanternScene/Pipelines/PlainPipelines.h"

#include <iterator>
#include <map>
#include <set>
#include <utility>

#include "Pipelines/PipelineVariables.h"
#include "Pipelines/PlainPipelineThreads.h"
#include "Pipelines/RTPSOFailureLog.h"

namespace Lantern
{

namespace
{
constexpr uint64_t RetryFrames = 60; ///< after a shortage of memory

std::string MakeKey(const FShaderSource& Source)
{
	std::string Key = Source.Path;
	for (const auto& [Define, Value] : Source.Defines) { Key += ' ' + Define + (Value == "1" ? "" : '=' + Value); }
	return Key;
}
const std::string& MakeKey(const FRasterSource& Source) { return Source.Key; }

uint32_t GetRevision(const FShaderSource&) { return 0; }
uint32_t GetRevision(const FRasterSource& Source) { return Source.Revision; }

const std::string& GetName(const FShaderSource&, const std::string& Key) { return Key; }
const std::string& GetName(const FRasterSource& Source, const std::string&) { return Source.Name; }

struct FEntry
{
	FPlainJobRef Job;
	FPlainJobRef Before;   ///< with the pipeline of an earlier revision, while Job has none
	uint32_t Revision = 0; ///< of Job
	uint64_t LastUsed = 0; ///< frame
	uint64_t RetryAt = 0;  ///< frame; after a shortage of memory, 0: none that is known

	/// bDone: whether the job was done when the caller looked. It may be done now, but its state must be told alike everywhere.
	IRTPipeline* GetPipeline(bool bDone) const
	{
		if (bDone && Job->Pipeline) { return Job->Pipeline.Get(); }
		return Before ? Before->Pipeline.Get() : nullptr;
	}
};
using FEntries = std::map<std::string, FEntry>;
} // namespace

struct FPlainPipelines::FImpl
{
	FImpl(IRTDevice& Device, FShaderCompiler& Compiler) : Threads(Device, Compiler) {}

	template <class TSource>
	FEntry& Ask(const TSource& Source, bool bRetry);
	template <class TSource>
	FRTStatus Find(const TSource& Source, IRTPipeline*& Out);
	template <class TSource>
	FRTStatus Get(const TSource& Source, IRTPipeline*& Out);
	FEntries& GetEntries(const FShaderSource&) { return Compute; }
	FEntries& GetEntries(const FRasterSource&) { return Raster; }
	bool IsDue(FEntry& Entry, bool bRetry) const;
	void Revise(FEntry& Entry, uint32_t Revision);
	void NoteState(const FPlainJob& Job, bool bDone);
	void DropUnused(FEntries& Entries, uint64_t KeepFrames);

	FEntries Compute, Raster;       ///< by key
	std::vector<FPlainJobRef> Idle; ///< of earlier revisions. Their pipelines are valid until BeginFrame
	uint64_t Frame = 0;
	std::set<const FPlainJob*> ToCome; ///< what this frame has found missing, and will not for ever
	FPlainPipelineThreads Threads;     ///< last: its end joins them
};

/// Whether a compile is to begin. bRetry: at once after a shortage of memory.
bool FPlainPipelines::FImpl::IsDue(FEntry& Entry, bool bRetry) const
{
	if (!Entry.Job) { return true; }
	if (!Entry.Job->IsDone() || !IsShortage(Entry.Job->Status)) { return false; }
	if (Entry.RetryAt == 0) { Entry.RetryAt = Frame + RetryFrames; }
	return bRetry || Frame >= Entry.RetryAt;
}

void FPlainPipelines::FImpl::NoteState(const FPlainJob& Job, bool bDone)
{
	if (bDone && !IsShortage(Job.Status)) { ToCome.erase(&Job); }
	else { ToCome.insert(&Job); }
}

void FPlainPipelines::FImpl::Revise(FEntry& Entry, uint32_t Revision)
{
	if (std::exchange(Entry.Revision, Revision) == Revision || !Entry.Job) { return; }
	if (Entry.Job->IsDone() && Entry.Job->Pipeline) { std::swap(Entry.Job, Entry.Before); }
	if (Entry.Job) { Idle.push_back(std::exchange(Entry.Job, nullptr)); }
}

template <class TSource>
FEntry& FPlainPipelines::FImpl::Ask(const TSource& Source, bool bRetry)
{
	std::string Key = MakeKey(Source);
	FEntry& Entry = GetEntries(Source)[Key];
	Entry.LastUsed = Frame;
	Revise(Entry, GetRevision(Source));
	if (IsDue(Entry, bRetry))
	{
		Entry.RetryAt = 0;
		Entry.Job = std::make_shared<FPlainJob>();
		Entry.Job->Source = Source;
		Entry.Job->Name = GetName(Source, Key);
		Threads.Add(Entry.Job, GetPipelineThreadCount());
	}
	return Entry;
}

template <class TSource>
FRTStatus FPlainPipelines::FImpl::Find(const TSource& Source, IRTPipeline*& Out)
{
	const FEntry& Entry = Ask(Source, false);
	const bool bDone = Entry.Job->IsDone();
	NoteState(*Entry.Job, bDone);
	Threads.HandOver(false);
	Out = Entry.GetPipeline(bDone);
	return bDone ? Entry.Job->Status : FRTStatus::Success();
}

template <class TSource>
FRTStatus FPlainPipelines::FImpl::Get(const TSource& Source, IRTPipeline*& Out)
{
	const FEntry& Entry = Ask(Source, true);
	Threads.HandOver(true);
	Threads.Wait(*Entry.Job);
	NoteState(*Entry.Job, true);
	Out = Entry.GetPipeline(true);
	return Entry.Job->Status;
}

/// Nothing of earlier frames is used any more but what a list has recorded, which keeps it.
void FPlainPipelines::FImpl::DropUnused(FEntries& Entries, uint64_t KeepFrames)
{
	for (auto Item = Entries.begin(); Item != Entries.end();)
	{
		FEntry& Entry = Item->second;
		const bool bUnused = Entry.Job->IsDone() && Frame - Entry.LastUsed > KeepFrames;
		if (Entry.Before && (bUnused || (Entry.Job->IsDone() && Entry.Job->Pipeline))) { Threads.Discard(std::move(Entry.Before)); }
		if (bUnused) { Threads.Discard(std::move(Entry.Job)); }
		Item = bUnused ? Entries.erase(Item) : std::next(Item);
	}
}

FPlainPipelines::FPlainPipelines(IRTDevice& Device, FShaderCompiler& Compiler) : Impl(std::make_unique<FImpl>(Device, Compiler)) {}
FPlainPipelines::~FPlainPipelines() = default;

void FPlainPipelines::BeginFrame()
{
	++Impl->Frame;
	Impl->ToCome.clear();
	const uint64_t KeepFrames = GetPipelineKeepFrames();
	Impl->DropUnused(Impl->Compute, KeepFrames);
	Impl->DropUnused(Impl->Raster, KeepFrames);
	for (FPlainJobRef& Job : Impl->Idle) { Impl->Threads.Discard(std::move(Job)); }
	Impl->Idle.clear();
	Impl->Threads.HandOver(false);
}

void FPlainPipelines::Want(const std::vector<FShaderSource>& Sources)
{
	for (const FShaderSource& Source : Sources)
	{
		const FPlainJobRef& Job = Impl->Ask(Source, false).Job;
		Impl->NoteState(*Job, Job->IsDone());
	}
	Impl->Threads.HandOver(false);
}

FRTStatus FPlainPipelines::Find(const FShaderSource& Source, IRTPipeline*& Out) { return Impl->Find(Source, Out); }
FRTStatus FPlainPipelines::Find(const FRasterSource& Source, IRTPipeline*& Out) { return Impl->Find(Source, Out); }
FRTStatus FPlainPipelines::Get(const FShaderSource& Source, IRTPipeline*& Out) { return Impl->Get(Source, Out); }
FRTStatus FPlainPipelines::Get(const FRasterSource& Source, IRTPipeline*& Out) { return Impl->Get(Source, Out); }

FRTStatus FPlainPipelines::Finish(const std::vector<FShaderSource>& Sources, const std::function<void(float)>& Progress)
{
	std::vector<FPlainJobRef> Jobs;
	Jobs.reserve(Sources.size());
	for (const FShaderSource& Source : Sources) { Jobs.push_back(Impl->Ask(Source, true).Job); }
	Impl->Threads.HandOver(true);
	FRTStatus Status;
	for (size_t I = 0; I < Jobs.size(); ++I)
	{
		Impl->Threads.Wait(*Jobs[I]);
		Impl->NoteState(*Jobs[I], true);
		if (Status) { Status = Jobs[I]->Status; }
		if (Progress) { Progress(static_cast<float>(I + 1) / static_cast<float>(Jobs.size())); }
	}
	if (Progress && Jobs.empty()) { Progress(1.0f); }
	return Status;
}

bool FPlainPipelines::IsAnyToCome() const { return !Impl->ToCome.empty(); }

size_t FPlainPipelines::GetCount() const { return Impl->Compute.size() + Impl->Raster.size(); }

std::vector<FShaderSource> FPlainPipelines::GetComputeSources() const
{
	std::vector<FShaderSource> Sources;
	Sources.reserve(Impl->Compute.size());
	for (const auto& [Key, Entry] : Impl->Compute) { Sources.push_back(std::get<FShaderSource>(Entry.Job->Source)); }
	return Sources;
}

std::vector<FRasterSource> FPlainPipelines::GetRasterSources() const
{
	std::vector<FRasterSource> Sources;
	Sources.reserve(Impl->Raster.size());
	for (const auto& [Key, Entry] : Impl->Raster) { Sources.push_back(std::get<FRasterSource>(Entry.Job->Source)); }
	return Sources;
}

} // namespace Lantern
