// Light cells: a grid in the world around a view, whose cells list the lights that reach them. Pixels, and hits of rays, walk the list
// of their cell instead of all lights (Shaders/Library/LightCells.glsl).
//
// The grid has levels of cells, each twice as large as those of the level before, and follows the camera. Only cells that something
// asked for are filled, and they stay so until a light changes that reaches them.
#pragma once

#include "Feedback/ReadbackRing.h"
#include "LanternRenderer/Frame.h"
#include "LightCellTypes.h"

namespace Lantern
{

/// What the GPU counted in a frame of light cells; it arrives two frames later.
struct FLightCellStats
{
	uint32_t Filled = 0;      ///< lists that the frame made
	uint32_t Missing = 0;     ///< entries that found no room in the pool
	uint32_t PoolEntries = 0; ///< size of the pool
};

/// The parts of a grid's buffer, by offset in bytes. It is one buffer, so that all is lost together if something overwrites it.
struct FLightCellBuffer
{
	static constexpr uint64_t Counters = 0; ///< FLightCellCounters
	static constexpr uint64_t Cells = 256;  ///< FLightCell[LIGHT_CELL_HEADERS]
	static constexpr uint64_t Stamps = Cells + LIGHT_CELL_HEADERS * sizeof(FLightCell);
	static constexpr uint64_t Requests = Stamps + LIGHT_CELL_HEADERS * sizeof(uint32_t);
	static constexpr uint64_t Pool = Requests + LIGHT_CELL_HEADERS * sizeof(uint32_t);
};

/// What a view knows of its grid from frame to frame. The lists themselves are one of its histories. Render thread.
class FLightCells
{
public:
	explicit FLightCells(IRTDevice& Device) : Ring(Device, "LightCellCounters", ERTBufferUsage::CopyDest) {}

	/// FlightIndex: as in TReadbackRing::BeginFrame.
	void BeginFrame(uint32_t FlightIndex);
	/// bSubmitted: false if the frame never runs.
	void EndFrame(bool bSubmitted) { Ring.EndFrame(bSubmitted && bCounted); }
	const FLightCellStats& GetStats() const { return Stats; }
	/// Returns the grid of the newest frame that was recorded with one.
	const FLightGrid& GetGrid() const { return Newest; }

	/// Adds what a frame does before it looks for pixels, and returns the buffer. Invalid: shaders are being compiled, or an error, which
	/// the context has. A pass that looks up cells before AddLists finds those of earlier frames, without what has changed.
	FGraphBuffer AddGrid(FFrameContext& Context);
	/// Adds the passes that make lists, after AddGrid gave a buffer.
	void AddLists(FFrameContext& Context, const FGBuffer& GBuffer);
	/// For the first pass that looks up cells, while it is recorded.
	void WriteGrid(FPassContext& Pass);

private:
	struct FFrame;
	std::shared_ptr<FFrame> Frame; // between BeginFrame and the next one
	bool PlaceGrid(FFrameContext& Context, FFrame& Of);
	bool FindChanges(const FFrameContext& Context, bool bFresh, FFrame& Of);
	void AddCountPass(FFrameContext& Context, FFrame& Of);
	uint32_t GetPoolEntries();

	TReadbackRing<uint32_t> Ring; // notes: entries of the pool
	FLightCellStats Stats;
	FLightGrid Newest{};
	uint32_t PoolEntries = 0;           // that frames have asked for
	uint32_t Revision = 0, Shift = 0;   // of the grid
	uint64_t Seen = 0;                  // place in the journal of lights
	glm::i64vec3 Lowest{0}, Highest{0}; // finest cell of the camera, since the grid has its revision
	bool bCounted = false;
};

/// Returns where a point of the world lies in the grid of positions that keys of cells are made of, in steps (LIGHT_POSITION_STEPS)
/// modulo 2³².
glm::ivec3 ToGridSteps(const glm::dvec3& World);

/// Lists the shaders of the passes, if a scene has a use for them.
void ListLightCellShaders(const FSceneFacts& Facts, std::vector<FShaderSource>& Out);

/// Returns the light cells of the frame's view, for a pass that walks lights; the first call adds their passes. Without a buffer,
/// shaders visit all lights. A pass that walks lights calls ReadLightCells.
const FLightCellsOfFrame& RequireLightCells(FFrameContext& Context, const FGBuffer& GBuffer);

/// Returns the light cells for a pass ahead of the G-buffer, which WriteGrid must know of. They have what earlier frames asked for.
/// RequireLightCells must follow in the frame.
const FLightCellsOfFrame& RequireLightGrid(FFrameContext& Context);

/// Declares that a pass looks up light cells. bRequests: it asks for those that it misses. Does nothing if there are none.
void ReadLightCells(FPassBuilder& Builder, const FLightCellsOfFrame& Cells, bool bRequests);

} // namespace Lantern
