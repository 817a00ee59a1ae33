// The passes that keep radiance cells: places by votes, age, the list of what is updated, the updates, and their means.
#include "RadianceCells/RadianceCells.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>
#include <cstring>

#include "Feedback/RadianceAuditor.h"
#include "IndirectVolume/IndirectVolume.h"
#include "LanternCore/FrameGraph/History.h"
#include "LanternCore/Text/Log.h"
#include "Lights/LightCells.h"
#include "RadianceCells/RadianceEvents.h"
#include "ScreenProbes/ScreenProbes.h"
#include "ThreadListTypes.h"
#include "Tiles/MovedCasters.h"

namespace Lantern
{

namespace
{
TRTConsoleVariable<int32_t> CVarCapacity("r.RT.GI.Cells.Capacity", 1 << 20,
    "Number of radiance cells that there is memory for, 40 bytes each, rounded to a power of two.", {1 << 8, 1 << 24});
TRTConsoleVariable<float> CVarUpdates("r.RT.GI.Cells.UpdatesPerSecond", 2.5e6f,
    "Updates of radiance cells in a second, each of one path. A frame has 61,440 at most.", {1000, 1e8f});
TRTConsoleVariable<float> CVarSizeAngle("r.RT.GI.Cells.SizeAngle", 0.02f,
    "Edge of a radiance cell over its distance to the camera. The finest are 0.125 m wide, and each level is twice the one before.",
    {0.001f, 1});
TRTConsoleVariable<float> CVarNear("r.RT.GI.Cells.Near", 2.0f,
    "Rays of pixels that are shorter than so many cells of their place do not end there. They find the sun and lamps by themselves, and "
    "end one surface later. Keeps contact shadows and borders of light sharp.",
    {0, 16});
TRTConsoleVariable<float> CVarSeconds(
    "r.RT.GI.Cells.Seconds", 1.0f, "Time over which a radiance cell averages its light, in seconds.", {0.05f, 60});
TRTConsoleVariable<bool> CVarCaustics("r.RT.GI.Caustics", false,
    "Mirrors throw the sun on what they light, where paths end in radiance cells. Few paths find the sun that way, so that it shows as "
    "bright blotches.");
TRTConsoleVariable<bool> CVarLastMirror("r.RT.Debug.GI.LastMirror", true,
    "Planted fault. If off, paths that end at a mirror are black, as between mirrors that face each other.");
TRTConsoleVariable<bool> CVarDirection("r.RT.Debug.GI.CellDirection", true,
    "Planted fault. If off, surfaces that paths hit reflect the light of radiance cells as if it came evenly from all directions.");
TRTConsoleVariable<bool> CVarAskedFirst("r.RT.Debug.GI.AskedFirst", true,
    "Planted fault. If off, radiance cells that no path asks for are updated as often as those that all paths ask for.");
TRTConsoleVariable<bool> CVarLayers("r.RT.Debug.GI.Layers", true,
    "Planted fault. Off: radiance cells are as thick as wide and have no side, so that light leaks through walls.");

TRTConsoleVariable<bool> CVarSight("r.RT.GI.Cells.Sight", false,
    "Paths take the light of radiance cells whose place they can see. Cells that lie on both sides of what is thin become two. Hardly any "
    "light leaks there then, and paths take up to twice as long.");
TRTConsoleVariable<bool> CVarChange("r.RT.GI.Cells.Change", true,
    "Radiance cells pass on that their light changes, to cells and pixels that look them up, while the scene changes and two seconds "
    "after.");

TRTConsoleVariable<int32_t> CVarRounds("r.RT.GI.Cells.Rounds", 4,
    "Rounds in which a frame updates radiance cells whose light changes. Light goes one surface further in each. The budget of updates is "
    "that of the frame.",
    {1, RADIANCE_CELL_MOST_ROUNDS});

constexpr float LifeSeconds = 2.0f;
constexpr float PartInMoment = 0.25f;        // of the time that a cell averages over, see FRadianceGrid::Moment
constexpr float RestChance = 0.5f;           // once cells are there
constexpr float AgesInWindow = 6.0f;         // a new table averages over this part of its age
constexpr float MostUpdatesInWindow = 16.0f; // of a cell, if nothing changes
constexpr uint32_t FramesWithoutCells = 4;   // of a new table, whose pictures are made by whole paths
constexpr uint32_t MaxBounces = 64;          // of updates that meet no cell: what a new table's paths lose is missing for seconds
constexpr double HurryFactor = 4.0;          // of the updates, where something has changed
constexpr double MostBudget = RADIANCE_CELL_MOST_UPDATES * 15.0 / 16; // the last bin is cut by chance, which may give more than its share

/// FRadianceTable and FRadianceWork: the parts of the two buffers, by offset in bytes.
struct FRadianceTable
{
	static constexpr uint64_t Counters = 0;
	static constexpr uint64_t UpdateVotes = 512;
	static_assert(sizeof(FRadianceCellCounters) <= UpdateVotes);
	static constexpr uint64_t Keys = UpdateVotes + uint64_t(RADIANCE_CELL_MOST_UPDATES) * sizeof(FRadianceVote);
	static uint64_t GetCells(uint32_t Slots) { return Keys + uint64_t(Slots) * sizeof(uint32_t); }
	static uint64_t GetSize(uint32_t Slots) { return GetCells(Slots) + uint64_t(Slots) * sizeof(FRadianceCell); }
};

struct FRadianceWork
{
	static constexpr uint64_t List = 0;
	static constexpr uint64_t Results = List + 2 * uint64_t(RADIANCE_CELL_MOST_UPDATES) * sizeof(uint32_t);
	static constexpr uint64_t Votes = Results + uint64_t(RADIANCE_CELL_MOST_UPDATES) * sizeof(FRadianceResult);
	static uint64_t GetMarks(uint32_t VoteCount) { return (Votes + uint64_t(VoteCount) * sizeof(FRadianceVote) + 15) / 16 * 16; }
	static uint64_t GetSize(uint32_t VoteCount, uint32_t Slots) { return GetMarks(VoteCount) + CountMarked(Slots) / 8; }
	static uint64_t CountMarked(uint32_t Slots) { return std::max(Slots, RADIANCE_CELL_MOST_UPDATES); }
};

FShaderSource MakeSource(const char* Name) { return MakeComputeSource(std::string("RadianceCells/") + Name + ".comp"); }

static_assert(RADIANCE_CELL_GROUP_SIZE == THREAD_ORDER_GROUP_SIZE, "AddComputePass: groups of Order.comp");
static_assert(RADIANCE_CELL_MOST_UPDATES % RADIANCE_CELL_GROUP_SIZE == 0, "ListSlots.glsl: groups write whole words");

constexpr const char* SourceNames[] = {"NewCells", "Votes", "Age", "Cut", "List", "ListAgain", "Order", "Commit"};

bool AreReady(const FFrameContext& Context)
{
	bool bReady = true; // all are asked for at once
	for (const char* Name : SourceNames) { bReady &= RequireCompute(Context, MakeSource(Name)) != nullptr; }
	return bReady;
}

uint32_t GetSlots()
{
	const auto Wanted = static_cast<uint32_t>(CVarCapacity.GetOnRenderThread());
	const uint32_t Slots = std::bit_ceil(Wanted);
	if (Slots != Wanted)
	{
		LogOnce(ERTLogLevel::Warning, CVarCapacity.GetName() + "=" + std::to_string(Wanted) + ": rounded to " + std::to_string(Slots));
	}
	return Slots;
}

FRadianceGrid MakeGrid(const FFrameContext& Context, uint32_t Slots, const FRadianceEvents::FFound& Events)
{
	const float Delta = std::max(Context.View.DeltaSeconds, 1.0e-3f);
	FRadianceGrid Grid{};
	Grid.Scene = Context.Pass.Scene;
	Grid.Origin = ToGridSteps(Context.Scene.GetOrigin());
	Grid.Camera = ToGridSteps(MakeGatherView(Context.View).Position) >> glm::ivec3(RADIANCE_SEED_SHIFT);
	Grid.BucketMask = Slots / RADIANCE_CELL_BUCKET - 1;
	Grid.Life = static_cast<uint32_t>(std::clamp(LifeSeconds / Delta, 8.0f, float(RADIANCE_CELL_TURN_MASK - 1)));
	const double Updates = double(CVarUpdates.GetOnRenderThread()) * (Events.bHurry ? HurryFactor : 1.0);
	Grid.Budget = static_cast<uint32_t>(std::min(Updates * Delta, MostBudget));
	Grid.Room = DivideUp(std::min(Grid.Budget + Grid.Budget / 16 + 256, RADIANCE_CELL_MOST_UPDATES), RADIANCE_CELL_ROW) * RADIANCE_CELL_ROW;
	Grid.StillWindow = CVarSeconds.GetOnRenderThread() / Delta;
	Grid.Window = std::min(Grid.StillWindow, Events.Window);
	Grid.Rounds = 1;
	Grid.EventCount = static_cast<uint32_t>(Events.Lamps.size());
	Grid.SizeAngle = CVarSizeAngle.GetOnRenderThread();
	Grid.NearCells = CVarNear.GetOnRenderThread();
	return Grid;
}

/// Says which cells are updated, and how often. Most cells light one path in a second. Updates follow what is asked for: else the cells that
/// all paths ask for would wait for the others.
void SetPace(FRadianceGrid& Grid, bool bHurry, float DeltaSeconds)
{
	constexpr float AskedTurns = 2.0f;
	const float Turns = std::max(bHurry ? static_cast<float>(FRadianceEvents::HoldSeconds) / DeltaSeconds : 0.0f, AskedTurns);
	Grid.AskedTurns =
	    CVarAskedFirst.GetOnRenderThread() ? static_cast<uint32_t>(std::min(Turns, static_cast<float>(Grid.Life))) : Grid.Life;
	Grid.LeastWait = bHurry || Grid.Moment > 0.0f ? 1u : std::max(static_cast<uint32_t>(Grid.Window / MostUpdatesInWindow), 1u);
}

/// Says what has moved, and whether cells pass on what changes. A young table holds nothing that is out of date.
void SetChanges(FFrameContext& Context, const FRadianceEvents::FFound& Events, uint32_t Age, FRadianceGrid& Grid)
{
	if (!AreIndirectChangesTold()) { return; }
	const FMoversOfFrame& Movers = RequireMovers(Context);
	Grid.Movers = Movers.Casters;
	Grid.MoverCount = Movers.Count;
	const float Delta = std::max(Context.View.DeltaSeconds, 1.0e-3f), Seconds = CVarSeconds.GetOnRenderThread();
	const bool bOld = static_cast<float>(Age) * Delta >= static_cast<float>(FRadianceEvents::HoldSeconds);
	const bool bSun = Events.Window < Seconds / Delta; // a slow one is averaged over as ever
	const bool bChanges = bOld && (Movers.Count > 0 || !Events.Lamps.empty() || bSun);
	const bool bLately = Context.RadianceEvents->HasChangedLately(bChanges);
	Grid.Moment = bLately && CVarChange.GetOnRenderThread() ? PartInMoment * Seconds / Delta : 0.0f;
	const bool bYoung = static_cast<float>(Age) * Delta < static_cast<float>(FRadianceEvents::LivelySeconds);
	if (bLately || bYoung) { Grid.Rounds = static_cast<uint32_t>(CVarRounds.GetOnRenderThread()); }
}

std::shared_ptr<const FRadianceCells> MakeCells(FFrameContext& Context)
{
	const auto Cells = std::make_shared<FRadianceCells>();
	Cells->Slots = GetSlots();
	const FRadianceEvents::FFound Events = Context.RadianceEvents->Find(
	    Context.Scene, MakeGatherView(Context.View).Position, Context.View.DeltaSeconds, Context.World->SkyChange);
	Cells->Grid = MakeGrid(Context, Cells->Slots, Events);
	const uint32_t Blocks = DivideUp(Context.Width, 2) * DivideUp(Context.Height, 2);
	Cells->ReflectionVoters = std::max(Blocks, CountScreenProbeVoters(Context));
	Cells->TransmissionVoters = Cells->ReflectionVoters + Blocks;
	const bool bTransmission = Context.Facts.bTransmissive && Context.Signals.bTransmission;
	Cells->VolumeVoters = Cells->TransmissionVoters + (bTransmission ? Blocks : 0);
	Cells->Grid.VoteCount = Cells->VolumeVoters + CountIndirectVolumeVoters(Context);
	Cells->EventFrames = Events.Window;
	FHistoryBuffer History;
	FRTStatus Status =
	    Context.World->History->GetBuffer("RadianceCells", {FRadianceTable::GetSize(Cells->Slots)}, History, EHistoryScope::World);
	FFrameUploads& Uploads = Context.Owner->GetUploads();
	if (Status) { Status = Uploads.Allocate(sizeof(FRadianceGrid), Cells->GridData); }
	if (Status && !Events.Lamps.empty())
	{
		FUploadSlice Slice;
		Status = Uploads.Push(Events.Lamps.data(), Events.Lamps.size() * sizeof(FRadianceEvent), Slice);
		Cells->Grid.Events = Slice.Address;
	}
	if (!Status)
	{
		if (Status.Code == ERTResult::DeviceLost) { Context.Fail(Status); }
		else { LogOnce(ERTLogLevel::Warning, std::string("radiance cells are off, and paths are followed: ") + Status.Message); }
		return nullptr;
	}
	Cells->Table = History.Buffer;
	Cells->Grid.Statistics = Context.RadianceCellStatistics;
	Cells->Grid.Audit = Context.RadianceAudit;
	Cells->Grid.FollowChance = GetFollowChance();
	const uint32_t Age = Context.RadianceEvents->CountFrames(History.bFresh);
	SetChanges(Context, Events, Age, Cells->Grid);
	Cells->Grid.Turn = Age & RADIANCE_CELL_TURN_MASK;
	Cells->Grid.RestChance = Age < FramesWithoutCells ? 1.0f : RestChance;
	// What the first frames know lacks further bounces, and must not be averaged for long.
	Cells->Grid.Window = std::min(Cells->Grid.Window, std::max(float(Age) / AgesInWindow, float(FRadianceEvents::LeastWindow)));
	SetPace(Cells->Grid, Events.bHurry, std::max(Context.View.DeltaSeconds, 1.0e-3f));
	Cells->Work = Context.Graph.CreateBuffer({FRadianceWork::GetSize(Cells->Grid.VoteCount, Cells->Slots)}, "RadianceCellWork");
	if (History.bFresh)
	{
		Context.Graph.AddPass("RadianceCellsClear", [&](FPassBuilder& Builder) -> FPassExecute {
			Builder.Write(Cells->Table, ERTAccess::CopyWrite);
			Context.Tokens.LeaveAlone(Builder);
			return [Cells](FPassContext& Pass) {
				Pass.Commands().FillBuffer(Pass.GetBuffer(Cells->Table), 0, FRadianceTable::GetSize(Cells->Slots), 0);
			};
		});
	}
	return Cells;
}

FRadianceCellConstants MakeConstants(const FFrameContext& Frame, const FRadianceCells& Cells, uint32_t Round)
{
	FRadianceCellConstants C{};
	C.Pass = Frame.Pass;
	C.Grid = Cells.GridData.Address;
	C.MaxBounces = MaxBounces;
	C.Round = Round;
	return C;
}

void Declare(FPassBuilder& Builder, const FRadianceCells& Cells)
{
	for (const FGraphBuffer Buffer : {Cells.Table, Cells.Work})
	{
		Builder.Read(Buffer, ERTAccess::StorageRead);
		Builder.Write(Buffer, ERTAccess::StorageWrite);
	}
	Builder.AllowAsync();
}

void AddComputePass(
    FFrameContext& Context, const std::shared_ptr<const FRadianceCells>& Cells, const char* Name, uint32_t Threads, uint32_t Round = 0)
{
	const FFrameContext* const Frame = &Context;
	IRTPipeline* const Pipeline = RequireCompute(Context, MakeSource(Name));
	const std::string PassName = "RadianceCells" + std::string(Name) + (Round > 0 ? std::to_string(Round) : "");
	Context.Graph.AddPass(PassName.c_str(), [&](FPassBuilder& Builder) -> FPassExecute {
		Declare(Builder, *Cells);
		Context.Tokens.LeaveAlone(Builder);
		return [=](FPassContext& Pass) {
			const FRadianceCellConstants C = MakeConstants(*Frame, *Cells, Round);
			const uint32_t Groups = DivideUp(Threads, RADIANCE_CELL_GROUP_SIZE);
			Pass.Commands().SetPipeline(Pipeline);
			Pass.Commands().PushConstants(&C, sizeof(C));
			Pass.Commands().Dispatch(std::min(Groups, RADIANCE_CELL_ROW_GROUPS), DivideUp(Groups, RADIANCE_CELL_ROW_GROUPS), 1);
		};
	});
}

void AddUpdatePass(FFrameContext& Context, const FGBuffer& GBuffer, const std::shared_ptr<const FRadianceCells>& Cells,
    const FRayDispatch& Dispatch, const FBesideUpdates& Beside, uint32_t Round = 0)
{
	const FFrameContext* const Frame = &Context;
	const FLightCellsOfFrame& LightCells = RequireLightCells(Context, GBuffer);
	const std::string Name = Round == 0 ? "And" + Beside.Pass : std::to_string(Round);
	Context.Graph.AddPass(("RadianceCellsUpdate" + Name).c_str(), [&](FPassBuilder& Builder) -> FPassExecute {
		Declare(Builder, *Cells);
		ReadLightCells(Builder, LightCells, true);
		if (Beside.Declare) { Beside.Declare(Builder); }
		return [=, Record = Beside.Record](FPassContext& Pass) {
			if (Record) { Record(Pass); } // without a barrier between
			// Rounds share the budget.
			if (Round == 0) { Pass.CountRays(uint64_t(Cells->Grid.Budget) * GetMaxPathRays(Frame->Facts, 1)); }
			const FRadianceCellConstants C = MakeConstants(*Frame, *Cells, Round);
			const uint32_t Rows = Cells->Grid.Room / RADIANCE_CELL_ROW;
			if (!Dispatch.Compute) { return TraceFrameRays(Pass, *Frame, Dispatch.RayGen, C, RADIANCE_CELL_ROW, Rows); }
			Pass.Commands().SetPipeline(Dispatch.Compute);
			Pass.Commands().PushConstants(&C, sizeof(C));
			Pass.Commands().Dispatch(RADIANCE_CELL_ROW / RADIANCE_CELL_UPDATE_GROUP, Rows, 1);
		};
	});
}
} // namespace

FPassRays ChooseRadianceCellRays(const FPassQuery& Query, ERayPath Path)
{
	FPassRays Rays;
	Rays.Path = Path;
	if (Path == ERayPath::None) { return Rays; }
	Rays.Defines = MakePathDefines(Query.Facts);
	AddRadianceCellDefines(Rays.Defines);
	if (Query.Facts.Lights > 0) { Rays.Defines.emplace_back("LIGHT_CELLS_OF_VIEW", "1"); }
	if (Path == ERayPath::Pipeline) { AddReorderDefine(Query.Capabilities, Rays.Defines); }
	SetHitPrograms(EHitPrograms::Standard, Rays);
	Rays.bShadesHits = true;
	Rays.Shaders = RadianceCellShaders;
	for (const char* Name : SourceNames) { Rays.Compute.push_back(MakeSource(Name)); }
	return Rays;
}

namespace
{
std::optional<FRayDispatch> FindUpdateDispatch(const FFrameContext& Context, ERayPath Path)
{
	const FPassRays Rays = ChooseRadianceCellRays({Context.Device.GetCapabilities(), Context.Facts, Context.Signals}, Path);
	return RequireRayDispatch(
	    Context, Rays, Context.GetRayGen(EPassRayGen::RadianceCells), MakeQuerySource(Context.Facts, RadianceCellShaders, Rays));
}
} // namespace

void AddRadianceCellDefines(FShaderDefines& InOut)
{
	InOut.emplace_back("RADIANCE_CELLS", "1");
	if (!CVarCaustics.GetOnRenderThread()) { InOut.emplace_back(NoCausticsDefine, "1"); }
	if (!CVarLayers.GetOnRenderThread()) { InOut.emplace_back("NO_LAYERS", "1"); }
	if (CVarSight.GetOnRenderThread()) { InOut.emplace_back("SEES_CELLS", "1"); }
	if (!CVarDirection.GetOnRenderThread()) { InOut.emplace_back("NO_CELL_DIRECTION", "1"); }
	if (!CVarLastMirror.GetOnRenderThread()) { InOut.emplace_back("NO_LAST_MIRROR", "1"); }
}

const FRadianceCells* RequireRadianceCells(FFrameContext& Context, ERayPath Path)
{
	if (!Context.World->bRadianceCellsAsked)
	{
		assert(!Context.bHalf);
		Context.World->bRadianceCellsAsked = true;
		const bool bReady = AreReady(Context) && FindUpdateDispatch(Context, Path);
		if (bReady) { Context.World->RadianceCells = MakeCells(Context); }
	}
	return Context.World->RadianceCells.get();
}

void ReadRadianceCells(FPassBuilder& Builder, const FRadianceCells* Cells)
{
	if (!Cells) { return; }
	Builder.Read(Cells->Table, ERTAccess::StorageRead);
	Builder.Write(Cells->Table, ERTAccess::StorageWrite);
	Builder.Write(Cells->Work, ERTAccess::StorageWrite);
	// Each voter has a place of its own, and cells are told that they are used by all at once.
	Builder.ShareApart(Cells->Table);
	Builder.ShareApart(Cells->Work);
	Builder.Keep(Cells->Table);
}

FAddress WriteRadianceGrid(FPassContext& Pass, const FRadianceCells* Cells)
{
	if (!Cells) { return 0; }
	const FAddress Table = Pass.GetBuffer(Cells->Table)->GetDeviceAddress(), Work = Pass.GetBuffer(Cells->Work)->GetDeviceAddress();
	FRadianceGrid Grid = Cells->Grid;
	Grid.Counters = Table + FRadianceTable::Counters;
	Grid.UpdateVotes = Table + FRadianceTable::UpdateVotes;
	Grid.Keys = Table + FRadianceTable::Keys;
	Grid.Cells = Table + FRadianceTable::GetCells(Cells->Slots);
	Grid.List = Work + FRadianceWork::List;
	Grid.Results = Work + FRadianceWork::Results;
	Grid.Votes = Work + FRadianceWork::Votes;
	Grid.Marks = Work + FRadianceWork::GetMarks(Grid.VoteCount);
	std::memcpy(Cells->GridData.Data, &Grid, sizeof(Grid));
	return Cells->GridData.Address;
}

bool AddRadianceCellPasses(FFrameContext& Context, const FGBuffer& GBuffer, ERayPath Path, const FBesideUpdates& Beside)
{
	const std::shared_ptr<const FRadianceCells> Cells = Context.World->RadianceCells;
	if (!Cells) { return false; }
	const std::optional<FRayDispatch> Dispatch = FindUpdateDispatch(Context, Path);
	if (!Dispatch) { return false; }
	const uint32_t Notes = Cells->Grid.VoteCount + RADIANCE_CELL_MOST_UPDATES;
	AddComputePass(Context, Cells, "NewCells", Notes);
	AddComputePass(Context, Cells, "Votes", Notes);
	AddComputePass(Context, Cells, "Age", Cells->Slots);
	AddComputePass(Context, Cells, "Cut", 1);
	AddComputePass(Context, Cells, "List", Cells->Slots);
	AddComputePass(Context, Cells, "Order", DivideUp(Cells->Slots, THREAD_ORDER_BITS));
	AddUpdatePass(Context, GBuffer, Cells, *Dispatch, Beside);
	AddComputePass(Context, Cells, "Commit", RADIANCE_CELL_MOST_UPDATES);
	for (uint32_t Round = 1; Round < Cells->Grid.Rounds; ++Round)
	{
		AddComputePass(Context, Cells, "ListAgain", RADIANCE_CELL_MOST_UPDATES, Round);
		AddComputePass(Context, Cells, "Order", RADIANCE_CELL_MOST_UPDATES / THREAD_ORDER_BITS, Round);
		AddUpdatePass(Context, GBuffer, Cells, *Dispatch, {}, Round);
		AddComputePass(Context, Cells, "Commit", RADIANCE_CELL_MOST_UPDATES, Round);
	}
	return true;
}

} // namespace Lantern
