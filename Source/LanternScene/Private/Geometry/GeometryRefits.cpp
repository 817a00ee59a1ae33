// FGeometryRefits: refits, and rebuilds where refits have become bad.
#include "Geometry/GeometryRefits.h"

#include <algorithm>
#include <tuple>

#include "LanternCore/Config/ConsoleVariables.h"

namespace Lantern
{

namespace
{
TRTConsoleVariable<int32_t> CVarRebuildInterval("r.RT.Skinning.RebuildInterval", 16,
    "Number of frames after which deformed geometry is rebuilt instead of refitted. 1: each frame rebuilds it.", {1, 1000});
// Above 2, rays visit so many more boxes that a rebuild pays within a few frames; a walking figure stays below 1.5.
TRTConsoleVariable<float> CVarRebuildQuality("r.RT.Skinning.RebuildQuality", 2.0f,
    "Rebuilds deformed geometry if the boxes around its triangles are this many times looser than at the last build. "
    "0: never for that reason.",
    {0.0, 1000.0});

bool IsDegraded(const FGeometryEntry& Entry, float Threshold) { return Threshold > 0.0f && Entry.RefitRatio > Threshold; }
} // namespace

FGeometryRefits::FGeometryRefits(FGeometryContext& InContext) : Context(InContext) {}

bool FGeometryRefits::IsQualityWanted() { return CVarRebuildQuality.GetOnRenderThread() > 0.0f; }

void FGeometryRefits::Add(FGeometryEntry& Entry)
{
	if (Entry.bDeformed) { return; }
	Entry.bDeformed = true;
	Deformed.push_back(Context.Slots.MakeRef(Entry));
}

void FGeometryRefits::ChooseRebuilds(std::vector<FGeometryEntry*>& Due, uint32_t Interval, uint64_t& ScratchBytes)
{
	const float Threshold = CVarRebuildQuality.GetOnRenderThread();
	// Characters that came together must not all be rebuilt in one frame: the worst come first, the others follow.
	const auto MakeKey = [=](const FGeometryEntry& Entry) {
		const float NegativeRatio = IsDegraded(Entry, Threshold) ? -Entry.RefitRatio : 0.0f;
		return std::tuple(!Entry.bRebuild, NegativeRatio, -int64_t(Entry.RefitsSinceBuild), Entry.Age);
	};
	std::sort(Due.begin(), Due.end(), [&](const auto* A, const auto* B) { return MakeKey(*A) < MakeKey(*B); });
	FGeometryStoreStats& Stats = Context.Stats;
	const uint32_t Most = std::max(1u, (Context.Slots.GetDynamicCount() + Interval - 1) / Interval);
	for (FGeometryEntry* const Entry : Due)
	{
		if (Stats.Rebuilt >= Most && !Entry->bRebuild) { break; }
		const uint64_t Bytes = std::max(ScratchBytes, Entry->Sizes.BuildScratchBytes);
		if (!Entry->bRebuild && Context.Scratch.GetGrowth(Bytes) > Context.Memory.GetRoom()) { continue; }
		Entry->bUpdate = false;
		++Stats.Rebuilt;
		Stats.TrianglesBuilt += Entry->Triangles;
		ScratchBytes = Bytes;
	}
}

FRTStatus FGeometryRefits::Choose(std::vector<FGeometryEntry*>& OutWork)
{
	const uint32_t Interval = static_cast<uint32_t>(CVarRebuildInterval.GetOnRenderThread());
	const float Threshold = CVarRebuildQuality.GetOnRenderThread();
	std::vector<FGeometryEntry*> Due;
	uint64_t ScratchBytes = 0;
	uint32_t Count = 0;
	for (const FGeometrySlotRef Ref : Deformed)
	{
		FGeometryEntry* const Entry = Context.Slots.Resolve(Ref);
		if (!Entry || Entry->State != EGeometryState::Built) { continue; }
		Entry->bDeformed = false;
		Entry->bUpdate = true;
		ScratchBytes = std::max(ScratchBytes, Entry->Sizes.UpdateScratchBytes);
		OutWork.push_back(Entry);
		++Count;
		if (Entry->bRebuild || IsDegraded(*Entry, Threshold) || Entry->RefitsSinceBuild + 1 >= Interval) { Due.push_back(Entry); }
	}
	Deformed.clear();
	if (Count > 0) { Context.Scratch.SetRefitReserve(ScratchBytes); }
	ChooseRebuilds(Due, Interval, ScratchBytes);
	Context.Stats.Refitted = Count - Context.Stats.Rebuilt;
	// A build names a scratch buffer even if refits need none of it.
	return Count > 0 ? Context.Scratch.Grow(ScratchBytes) : FRTStatus::Success();
}

} // namespace Lantern
