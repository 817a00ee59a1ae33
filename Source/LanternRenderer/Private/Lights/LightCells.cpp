// The passes that keep the grid of light cells: changes of lights, requests of pixels, and the lists themselves.
#include "Lights/LightCells.h"

#include <algorithm>
#include <atomic>
#include <bit>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <cstring>

#include "LanternCore/FrameGraph/History.h"
#include "LanternCore/Text/Log.h"
#include "PassTools.h"

namespace Lantern
{

namespace
{
TRTConsoleVariable<bool> CVarCells("r.RT.Lights.Cells", true,
    "Light cells: a grid around the camera whose cells list the lights that reach them. Off: pixels and hits of rays visit all lights.");
TRTConsoleVariable<int32_t> CVarLeast("r.RT.Lights.Cells.Least", 16,
    "Number of lights of finite range from which on there are light cells. Fewer are visited faster than they are looked up.",
    {1, 1 << 24});
TRTConsoleVariable<float> CVarCellMetres("r.RT.Lights.CellMetres", 1.0f,
    "Edge of the finest light cells, in metres, rounded to a power of two. Six levels double it; each has 32 x 16 x 32 cells.",
    {0.125f, 32});
TRTConsoleVariable<float> CVarPoolMB("r.RT.Lights.CellPoolMB", 64.0f,
    "Most memory for the lists of light cells, in MiB. It begins with 0.25, and grows with what lists need. Cells whose lists have no room "
    "visit all lights of their block, or of the scene.",
    {0.0001f, 1024});
TRTConsoleVariable<bool> CVarChanges(
    "r.RT.Debug.Lights.Changes", true, "Planted fault. Off: light cells do not hear of lights that come, move or go.");

constexpr uint32_t FirstPoolEntries = 1u << 16;
constexpr int64_t MostCellsOfTravel = 8192; // half of what keys tell apart (FLightCell::Key)

FShaderSource MakeSource(const char* Name, FShaderDefines Defines = {})
{
	return MakeComputeSource(std::string("Lights/LightCells") + Name + ".comp", std::move(Defines));
}

struct FSources
{
	FShaderSource Change = MakeSource("Change"), Mark = MakeSource("Mark"), Prepare = MakeSource("Prepare"),
	              Blocks = MakeSource("Fill", {{"BLOCKS", "1"}}), Cells = MakeSource("Fill");
};

struct FPipelines
{
	IRTPipeline *Change, *Mark, *Prepare, *Blocks, *Cells;
	bool AreReady() const { return Change && Mark && Prepare && Blocks && Cells; }
};

FPipelines FindPipelines(const FFrameContext& Context)
{
	const FSources Sources;
	return {RequireCompute(Context, Sources.Change), RequireCompute(Context, Sources.Mark), RequireCompute(Context, Sources.Prepare),
	    RequireCompute(Context, Sources.Blocks), RequireCompute(Context, Sources.Cells)};
}

bool HasLightCells(const FSceneFacts& Facts)
{
	return CVarCells.GetOnRenderThread() && Facts.FiniteLights >= static_cast<uint32_t>(CVarLeast.GetOnRenderThread());
}

uint32_t GetShift()
{
	const auto Steps = static_cast<double>(LIGHT_POSITION_STEPS) * double(CVarCellMetres.GetOnRenderThread());
	return static_cast<uint32_t>(std::lround(std::log2(Steps)));
}

/// From the grid's own origin.
glm::i64vec3 ToSteps(const glm::dvec3& World)
{
	return glm::i64vec3(glm::floor(World * double(LIGHT_POSITION_STEPS))) + int64_t(LIGHT_CELL_OFFSET);
}

/// Modulo 2³², as positions of lights.
glm::ivec3 Wrap(const glm::i64vec3& Steps)
{
	glm::ivec3 Out;
	for (int Axis = 0; Axis < 3; ++Axis) { Out[Axis] = static_cast<int32_t>(static_cast<uint32_t>(static_cast<uint64_t>(Steps[Axis]))); }
	return Out;
}

} // namespace

glm::ivec3 ToGridSteps(const glm::dvec3& World) { return Wrap(ToSteps(World)); }

namespace
{
/// Lowest corner of a level around the camera, in steps. Levels move by whole blocks.
glm::ivec3 PlaceLevel(const glm::i64vec3& Camera, uint32_t Shift)
{
	constexpr int64_t HalfCells[] = {1 << (LIGHT_CELL_BITS_X - 1), 1 << (LIGHT_CELL_BITS_Y - 1), 1 << (LIGHT_CELL_BITS_Z - 1)};
	constexpr int64_t HalfBlock = 1 << (LIGHT_BLOCK_BITS - 1);
	glm::i64vec3 Out;
	for (int Axis = 0; Axis < 3; ++Axis)
	{
		const int64_t Block = ((Camera[Axis] >> Shift) + HalfBlock) >> LIGHT_BLOCK_BITS;
		Out[Axis] = ((Block << LIGHT_BLOCK_BITS) - HalfCells[Axis]) * (int64_t(1) << Shift);
	}
	return Wrap(Out);
}
} // namespace

/// What the passes of one frame share.
struct FLightCells::FFrame
{
	FFrameContext* Context = nullptr;
	FGraphBuffer Cells, Arguments;
	FLightGrid Grid{};
	FUploadSlice GridData;
	std::vector<FLightReach> Changes;
	FAddress ChangesAddress = 0;
	uint64_t JournalEnd = 0; // place in the journal behind Changes

	FLightCellConstants MakeConstants() const
	{
		FLightCellConstants C{};
		C.Pass = Context->Pass;
		C.Grid = GridData.Address;
		C.Changes = ChangesAddress;
		C.ChangeCount = static_cast<uint32_t>(Changes.size());
		return C;
	}
	/// For passes that declare Arguments.
	FLightCellConstants MakeConstants(FPassContext& Pass) const
	{
		FLightCellConstants C = MakeConstants();
		C.Arguments = Pass.GetBuffer(Arguments)->GetDeviceAddress();
		return C;
	}
	/// The grid's memory is known only when passes are recorded.
	void WriteGrid(FPassContext& Pass)
	{
		const FAddress Base = Pass.GetBuffer(Cells)->GetDeviceAddress();
		Grid.Cells = Base + FLightCellBuffer::Cells;
		Grid.Pool = Base + FLightCellBuffer::Pool;
		Grid.Counters = Base + FLightCellBuffer::Counters;
		Grid.Stamps = Base + FLightCellBuffer::Stamps;
		Grid.Requests = Base + FLightCellBuffer::Requests;
		std::memcpy(GridData.Data, &Grid, sizeof(Grid));
	}
	void Declare(FPassBuilder& Builder) const
	{
		Builder.Read(Cells, ERTAccess::StorageRead);
		Builder.Write(Cells, ERTAccess::StorageWrite);
		const FSceneTokens& Tokens = Context->Tokens;
		for (const FGraphToken Unused : {Tokens.Vertices, Tokens.Structures, Tokens.Records, Tokens.Sky}) { Builder.Without(Unused); }
	}
};

namespace
{
void Run(FPassContext& Pass, IRTPipeline* Pipeline, const FLightCellConstants& Constants)
{
	Pass.Commands().SetPipeline(Pipeline);
	Pass.Commands().PushConstants(&Constants, sizeof(Constants));
}

template <class TFrame>
void AddClearPass(const TFrame& Frame)
{
	Frame->Context->Graph.AddPass("LightCellsClear", [&](FPassBuilder& Builder) -> FPassExecute {
		Builder.Write(Frame->Cells, ERTAccess::CopyWrite);
		Frame->Context->Tokens.LeaveAlone(Builder);
		return [=](FPassContext& Pass) { Pass.Commands().FillBuffer(Pass.GetBuffer(Frame->Cells), 0, FLightCellBuffer::Pool, 0); };
	});
}

template <class TFrame>
void AddChangePass(const TFrame& Frame, IRTPipeline* Pipeline)
{
	Frame->Context->Graph.AddPass("LightCellsChange", [&](FPassBuilder& Builder) -> FPassExecute {
		Frame->Declare(Builder);
		return [=](FPassContext& Pass) {
			Run(Pass, Pipeline, Frame->MakeConstants());
			Pass.Commands().Dispatch(DivideUp(LIGHT_BLOCKS, LIGHT_CELL_GROUP_SIZE), 1, 1);
		};
	});
}

template <class TFrame>
void AddPreparePass(const TFrame& Frame, IRTPipeline* Pipeline)
{
	Frame->Context->Graph.AddPass("LightCellsPrepare", [&](FPassBuilder& Builder) -> FPassExecute {
		Frame->Declare(Builder);
		Builder.Write(Frame->Arguments, ERTAccess::StorageWrite);
		return [=](FPassContext& Pass) {
			Run(Pass, Pipeline, Frame->MakeConstants(Pass));
			Pass.Commands().Dispatch(1, 1, 1);
		};
	});
}

template <class TFrame>
void AddFillPass(const TFrame& Frame, const char* Name, IRTPipeline* Pipeline, uint64_t Offset)
{
	Frame->Context->Graph.AddPass(Name, [&](FPassBuilder& Builder) -> FPassExecute {
		Frame->Declare(Builder);
		Builder.Read(Frame->Arguments, ERTAccess::IndirectRead);
		Builder.Read(Frame->Arguments, ERTAccess::ShaderRead);
		return [=](FPassContext& Pass) {
			Run(Pass, Pipeline, Frame->MakeConstants(Pass));
			Pass.Commands().DispatchIndirect(Pass.GetBuffer(Frame->Arguments), Offset);
		};
	});
}
} // namespace

void FLightCells::BeginFrame(uint32_t FlightIndex)
{
	bCounted = false;
	Frame.reset();
	Ring.BeginFrame(FlightIndex, [this](const TReadbackRing<uint32_t>::FEntry& Entry) {
		FLightCellCounters Counters;
		std::memcpy(&Counters, Entry.Buffer->GetMapped(), sizeof(Counters));
		Stats = {Counters.Filled, Counters.Missing, Entry.Notes};
		if (Counters.Missing > 0)
		{
			PoolEntries = std::max(PoolEntries, std::bit_ceil(2 * std::min(Entry.Notes + Counters.Missing, 1u << 29)));
		}
	});
}

uint32_t FLightCells::GetPoolEntries()
{
	const auto Most = static_cast<uint32_t>(double(CVarPoolMB.GetOnRenderThread()) * (1 << 18));
	PoolEntries = std::max(PoolEntries, FirstPoolEntries);
	if (PoolEntries <= Most) { return PoolEntries; }
	if (Stats.Missing > 0)
	{
		LogOnce(ERTLogLevel::Warning,
		    "r.RT.Lights.CellPoolMB: lists of light cells have no room. Their pixels visit more lights than reach them, which takes time.");
	}
	return std::max(Most, 1u);
}

/// Begins a new revision of the grid where lists cannot be kept. Returns whether the frame must hear of changes.
bool FLightCells::FindChanges(const FFrameContext& Context, bool bFresh, FFrame& Of)
{
	static std::atomic<uint32_t> LastRevision = 0;
	const FLightJournal& Journal = Context.Scene.GetLights().GetJournal();
	const glm::i64vec3 Camera = ToSteps(MakeGatherView(Context.View).Position) >> glm::i64vec3(GetShift());
	Lowest = glm::min(Lowest, Camera);
	Highest = glm::max(Highest, Camera);
	Of.JournalEnd = Journal.GetCount();
	const glm::i64vec3 Travel = Highest - Lowest;
	const bool bFar = std::max({Travel.x, Travel.y, Travel.z}) > MostCellsOfTravel;
	if (bFresh || bFar || Shift != GetShift() || !Journal.GetSince(Seen, Of.Changes))
	{
		Lowest = Highest = Camera;
		Shift = GetShift();
		Revision = ++LastRevision;
		return false;
	}
	return !Of.Changes.empty() && CVarChanges.GetOnRenderThread();
}

/// Returns false after an error, which the context then has.
bool FLightCells::PlaceGrid(FFrameContext& Context, FFrame& Of)
{
	FLightGrid& Grid = Of.Grid;
	Grid.Revision = Revision;
	Grid.Turn = Newest.Turn + 1;
	Grid.Shift = Shift;
	Grid.Origin = ToGridSteps(Context.Scene.GetOrigin());
	const glm::i64vec3 Camera = ToSteps(MakeGatherView(Context.View).Position);
	for (uint32_t Level = 0; Level < LIGHT_CELL_LEVELS; ++Level) { Grid.First[Level] = PlaceLevel(Camera, Shift + Level); }
	FFrameUploads& Uploads = Context.Owner->GetUploads();
	FRTStatus Status = Uploads.Allocate(sizeof(FLightGrid), Of.GridData);
	if (Status && !Of.Changes.empty())
	{
		FUploadSlice Slice;
		Status = Uploads.Push(Of.Changes.data(), Of.Changes.size() * sizeof(FLightReach), Slice);
		Of.ChangesAddress = Slice.Address;
	}
	if (!Status) { Context.Fail(Status); }
	return static_cast<bool>(Status);
}

FGraphBuffer FLightCells::AddGrid(FFrameContext& Context)
{
	const FPipelines Pipelines = FindPipelines(Context);
	if (!Pipelines.AreReady()) { return {}; }
	const auto Made = std::make_shared<FFrame>();
	Made->Context = &Context;
	Made->Grid.PoolEntries = GetPoolEntries();
	FHistoryBuffer History;
	const uint64_t Bytes = FLightCellBuffer::Pool + Made->Grid.PoolEntries * sizeof(uint32_t);
	if (FRTStatus S = Context.World->History->GetBuffer("LightCells", {Bytes, ERTBufferUsage::CopySource}, History); !S)
	{
		if (S.Code == ERTResult::DeviceLost) { Context.Fail(S); }
		else { LogOnce(ERTLogLevel::Warning, std::string("light cells are off, and all lights are visited: ") + S.Message); }
		return {};
	}
	Made->Cells = History.Buffer;
	const bool bChanges = FindChanges(Context, History.bFresh, *Made);
	if (!PlaceGrid(Context, *Made)) { return {}; }
	if (History.bFresh) { AddClearPass(Made); }
	if (bChanges) { AddChangePass(Made, Pipelines.Change); }
	Frame = Made;
	return Frame->Cells;
}

void FLightCells::WriteGrid(FPassContext& Pass)
{
	Frame->WriteGrid(Pass);
	// The frame is recorded, so its lists will be as the journal says.
	Seen = Frame->JournalEnd;
	Newest = Frame->Grid;
	Frame->Context->World->LightCells.Address = Frame->GridData.Address;
}

void FLightCells::AddLists(FFrameContext& Context, const FGBuffer& GBuffer)
{
	const FPipelines Pipelines = FindPipelines(Context);
	Frame->Arguments = Context.Graph.CreateBuffer({sizeof(FLightCellArguments), ERTBufferUsage::Indirect}, "LightCellArguments");
	Context.Graph.AddPass("LightCellsMark", [&](FPassBuilder& Builder) -> FPassExecute {
		Builder.Read(GBuffer.Depth, ERTAccess::ShaderRead);
		Frame->Declare(Builder);
		return [this, Mark = Pipelines.Mark, Depth = GBuffer.Depth](FPassContext& Pass) {
			WriteGrid(Pass);
			FLightCellConstants C = Frame->MakeConstants();
			C.Depth = GetSampledIndex(Pass, Depth);
			Dispatch2D(Pass, Mark, C, Frame->Context->Width, Frame->Context->Height, LIGHT_CELL_MARK_SIZE);
		};
	});
	AddPreparePass(Frame, Pipelines.Prepare);
	AddFillPass(Frame, "LightCellsBlocks", Pipelines.Blocks, offsetof(FLightCellArguments, Blocks));
	AddFillPass(Frame, "LightCells", Pipelines.Cells, offsetof(FLightCellArguments, Cells));
	AddCountPass(Context, *Frame);
}

/// Copies the counters to the CPU. Nobody waits for them, so the pass runs if what it counts was counted.
void FLightCells::AddCountPass(FFrameContext& Context, FFrame& Of)
{
	FRTStatus Status;
	auto* const Entry = Ring.Write(sizeof(FLightCellCounters), Status);
	if (!Entry) { return LogOnce(ERTLogLevel::Warning, std::string("light cells are not counted: ") + Status.Message); }
	Entry->Notes = Of.Grid.PoolEntries;
	const FGraphBuffer Out = Context.Graph.ImportBuffer(Entry->Buffer.Get(), ERTAccess::HostRead, ERTAccess::HostRead, "LightCellCounters");
	Context.Graph.MarkForLater(Out, &bCounted);
	Context.World->LightCells.Counts = Out;
	Context.Graph.AddPass("LightCellsCount", [&](FPassBuilder& Builder) -> FPassExecute {
		Builder.Read(Of.Cells, ERTAccess::CopyRead);
		Builder.Write(Out, ERTAccess::CopyWrite);
		Context.Tokens.LeaveAlone(Builder);
		return [=, Cells = Of.Cells](FPassContext& Pass) {
			Pass.Commands().CopyBuffer(
			    Pass.GetBuffer(Out), 0, Pass.GetBuffer(Cells), FLightCellBuffer::Counters, sizeof(FLightCellCounters));
		};
	});
}

void ListLightCellShaders(const FSceneFacts& Facts, std::vector<FShaderSource>& Out)
{
	if (!HasLightCells(Facts)) { return; }
	const FSources Sources;
	for (const FShaderSource& Source : {Sources.Change, Sources.Mark, Sources.Prepare, Sources.Blocks, Sources.Cells})
	{
		Out.push_back(Source);
	}
}

const FLightCellsOfFrame& RequireLightCells(FFrameContext& Context, const FGBuffer& GBuffer)
{
	FLightCellsOfFrame& Cells = Context.World->LightCells;
	assert((!Context.bHalf || Cells.bAsked) && "pixels of the whole frame mark what is looked up");
	if (!Cells.bAsked && RequireLightGrid(Context).Buffer.IsValid()) { Cells.OfView->AddLists(Context, GBuffer); }
	Cells.bAsked = true;
	return Cells;
}

const FLightCellsOfFrame& RequireLightGrid(FFrameContext& Context)
{
	FLightCellsOfFrame& Cells = Context.World->LightCells;
	if (!Cells.bGridAsked && Cells.OfView && HasLightCells(Context.Facts)) { Cells.Buffer = Cells.OfView->AddGrid(Context); }
	Cells.bGridAsked = true;
	return Cells;
}

void ReadLightCells(FPassBuilder& Builder, const FLightCellsOfFrame& Cells, bool bRequests)
{
	if (!Cells.Buffer.IsValid()) { return; }
	Builder.Read(Cells.Buffer, bRequests ? ERTAccess::StorageRead : ERTAccess::ShaderRead);
	if (bRequests)
	{
		Builder.Write(Cells.Buffer, ERTAccess::StorageWrite);
		Builder.ShareApart(Cells.Buffer); // cells are asked for by atomics
	}
	if (Cells.Counts.IsValid()) { Builder.Keep(Cells.Counts); }
}

} // namespace Lantern
