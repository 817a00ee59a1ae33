// FGeometryCoarsener: levels are started, and taken once they are done.
#include "Geometry/GeometryCoarsener.h"

#include <algorithm>
#include <cstring>
#include <utility>

#include "Geometry/CoarserLevel.h"
#include "LanternCore/Config/ConsoleVariables.h"
#include "LanternCore/Text/Log.h"
#include "LanternCore/Text/Quote.h"

namespace Lantern
{

namespace
{
TRTConsoleVariable<bool> CVarCoarser("r.RT.Build.CoarserLevels", true,
    "Simplifies static geometry that does not fit into r.RT.Build.MemoryMB. Off: such geometry is left out of the scene.");

constexpr uint32_t MaxCoarsenings = 4;
constexpr double LeastShare = 1.0 / 64; // of the triangles: a coarser level than that is no picture of the geometry
constexpr double MostShare = 0.75;      // of the triangles that it has now
constexpr double Safety = 0.9;          // of the room: bytes are not quite proportional to triangles
} // namespace

FGeometryCoarsener::FGeometryCoarsener(FGeometryContext& InContext, FGeometryRefusals& InRefusals)
    : Context(InContext),
      Refusals(InRefusals)
{}

bool FGeometryCoarsener::CanCoarsen(const FGeometryEntry& Entry)
{
	const FRTGeometryInfo& Info = Entry.Geometry->GetInfo();
	const bool bBoxes =
	    std::any_of(Info.Sections.begin(), Info.Sections.end(), [](const FRTSectionInfo& Section) { return Section.bProcedural; });
	return CVarCoarser.GetOnRenderThread() && Info.CpuPositions && Info.CpuIndices && !Info.bDynamic && !bBoxes &&
	       Entry.Coarsenings < MaxCoarsenings;
}

bool FGeometryCoarsener::Start(FGeometryEntry& Entry, uint64_t Room)
{
	if (!CanCoarsen(Entry)) { return false; }
	const double Need = static_cast<double>(Context.Scratch.GetBuildBytes(Entry.Sizes));
	const double Triangles = Safety * static_cast<double>(Room) / Need * static_cast<double>(Entry.Triangles);
	uint64_t All = 0;
	for (const FRTSectionInfo& Section : Entry.Geometry->GetInfo().Sections) { All += Section.IndexCount / 3; }
	// Each level is made from the finest one: simplifying twice would add up errors.
	const double Share = std::min(Triangles, MostShare * static_cast<double>(Entry.Triangles)) / static_cast<double>(All);
	if (Share < LeastShare) { return false; }
	++Entry.Coarsenings;
	Entry.SetStructure(nullptr);
	Entry.SetCoarserLevel(std::make_unique<FCoarserLevel>(Entry.Geometry->GetInfo(), Share));
	Entry.State = EGeometryState::Coarsening;
	Coarsening.push_back(Context.Slots.MakeRef(Entry));
	return true;
}

FRTStatus FGeometryCoarsener::Finish(FGeometryEntry& Entry)
{
	Entry.GetCoarserLevel()->Wait();
	return TakeDone();
}

FRTStatus FGeometryCoarsener::TakeDone()
{
	const std::vector<FGeometrySlotRef> Work = std::exchange(Coarsening, {});
	FRTStatus Status = FRTStatus::Success();
	for (const FGeometrySlotRef Ref : Work)
	{
		FGeometryEntry* const Entry = Context.Slots.Resolve(Ref);
		if (!Entry || Entry->State != EGeometryState::Coarsening) { continue; }
		if (Status && Entry->GetCoarserLevel()->IsDone()) { Status = Take(*Entry); }
		if (Entry->State == EGeometryState::Coarsening) { Coarsening.push_back(Ref); }
	}
	return Status;
}

FRTStatus FGeometryCoarsener::CreateBuffers(
    const FGeometryEntry& Entry, uint64_t Bytes, TRTRef<IRTBuffer>& Indices, TRTRef<IRTBuffer>& Staging)
{
	const ERTBufferUsage Usage = ERTBufferUsage::Index | ERTBufferUsage::Storage | ERTBufferUsage::GeometryInput | ERTBufferUsage::CopyDest;
	const char* const Name = Entry.Geometry->GetInfo().Name.c_str();
	if (FRTStatus S = Context.Device.CreateBuffer({Bytes, Usage, ERTMemory::Device, Name}, Indices.ReleaseAndGetAddress()); !S)
	{
		return S;
	}
	const FRTBufferDesc Desc{Bytes, ERTBufferUsage::CopySource, ERTMemory::Upload, Name};
	return Context.Device.CreateBuffer(Desc, Staging.ReleaseAndGetAddress());
}

FRTStatus FGeometryCoarsener::Take(FGeometryEntry& Entry)
{
	const std::vector<uint32_t>& Level = Entry.GetCoarserLevel()->GetIndices();
	if (Level.empty())
	{
		Entry.SetCoarserLevel(nullptr);
		Refusals.Refuse(Entry, Context.Memory.GetRoom());
		return FRTStatus::Success();
	}
	const uint64_t Bytes = Level.size() * sizeof(uint32_t);
	TRTRef<IRTBuffer> Indices, Staging;
	if (FRTStatus S = CreateBuffers(Entry, Bytes, Indices, Staging); !S)
	{
		return S.Code == ERTResult::OutOfDeviceMemory ? FRTStatus::Success() : S;
	}
	std::memcpy(Staging->GetMapped(), Level.data(), Bytes);
	Context.Stats.Coarse += std::exchange(Entry.bCoarse, true) ? 0 : 1;
	const uint64_t Before = Entry.Triangles, BytesBefore = Entry.Sizes.StructureBytes;
	Entry.UseCoarserLevel(std::move(Indices));
	Entry.Staging = std::move(Staging);
	Entry.UpdateSizes(Context.Device);
	Context.Queue.Add(Entry);
	Context.Slots.MarkChanged(Entry);
	if (std::exchange(Entry.bReported, true)) { return FRTStatus::Success(); }
	LogOnce(ERTLogLevel::Warning, fmt::format("Scene: geometry \"{}\" does not fit: {:.1f} MiB of acceleration "
	                                          "structure, r.RT.Build.MemoryMB {}; a coarser "
	                                          "level of {} of its {} triangles takes its place",
	                                  EscapeText(Entry.Geometry->GetInfo().Name, MaxQuotedBytes), ToMiB(BytesBefore),
	                                  Context.Memory.GetLimit() >> 20, Entry.Triangles, Before));
	return FRTStatus::Success();
}

bool FGeometryCoarsener::IsAnyDone() const
{
	return std::any_of(Coarsening.begin(), Coarsening.end(), [&](FGeometrySlotRef Ref) {
		const FGeometryEntry* const Entry = Context.Slots.Resolve(Ref);
		return Entry && Entry->GetCoarserLevel() && Entry->GetCoarserLevel()->IsDone();
	});
}

} // namespace Lantern
