// What path reservoirs keep, and their settings.
#include "PathReservoirs/PathReservoirs.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <string>

#include "PathReservoirTypes.h"
#include "RadianceCells/RadianceCells.h"

namespace Lantern
{

namespace
{
TRTConsoleVariable<int32_t> CVarReservoirs("r.RT.GI.Reservoirs", 0,
    "Shared paths (r.RT.GI.Reuse) are resampled. 0: not. 1: with the path that a pixel kept from the frame before, by three more rays. 2: "
    "with those of r.RT.GI.Reservoirs.Neighbors pixels around as well, by three rays for each. A frame has less noise, which the filter "
    "removes less well.",
    {0, 2});
TRTConsoleVariable<int32_t> CVarNeighbors("r.RT.GI.Reservoirs.Neighbors", 3,
    "Number of pixels around whose paths are taken over, in places drawn at random.", {1, PATH_RESERVOIR_MOST_NEIGHBORS});
TRTConsoleVariable<float> CVarRadius("r.RT.GI.Reservoirs.Radius", 30, "Pixels within which paths are taken over.", {1, 1024});
TRTConsoleVariable<float> CVarSeconds("r.RT.GI.Reservoirs.Seconds", 0.2f,
    "Seconds of paths that a kept one may stand for. With longer ones a frame has less noise, but the noise stays for longer.", {0, 2});
TRTConsoleVariable<bool> CVarJacobian("r.RT.Debug.GI.Jacobian", true,
    "Planted fault. If off, paths that are taken over count as if they filled the same solid angle seen from everywhere.");

constexpr uint32_t LeastPaths = 4, MostPaths = 30; // FPathReservoirs::MostCount
constexpr float FramesPerPath = 4.0f;              // A pixel forgets once in so many frames, times MostCount, in the mean.

uint32_t GetNeighbors() { return CVarReservoirs.GetOnRenderThread() >= 2 ? static_cast<uint32_t>(CVarNeighbors.GetOnRenderThread()) : 0u; }

FPathReservoirs MakeConstants(const FFrameContext& Context)
{
	const float Delta = std::max(Context.View.DeltaSeconds, 1.0e-3f);
	const float Frames = CVarSeconds.GetOnRenderThread() / Delta;
	const FRadianceCells* const Cells = Context.World->RadianceCells.get();
	const bool bChanges = Cells && Cells->Grid.Moment > 0.0f; // what paths bring is soon out of date
	FPathReservoirs C{};
	C.MostCount = bChanges ? LeastPaths : static_cast<uint32_t>(std::clamp(Frames, float(LeastPaths), float(MostPaths)));
	C.Chance = 1.0f / (FramesPerPath * static_cast<float>(C.MostCount));
	C.Neighbors = GetNeighbors();
	C.Radius = CVarRadius.GetOnRenderThread() * (Context.bHalf ? 0.5f : 1.0f);
	return C;
}
} // namespace

bool AreReservoirsWanted() { return CVarReservoirs.GetOnRenderThread() != 0; }

uint32_t GetMostReservoirRays() { return AreReservoirsWanted() ? 3 * (1 + GetNeighbors()) : 0; }

void AddPathReservoirDefines(FShaderDefines& InOut)
{
	InOut.emplace_back(PathReservoirsDefine, "1");
	if (!CVarJacobian.GetOnRenderThread()) { InOut.emplace_back("NO_RESERVOIR_JACOBIAN", "1"); }
}

FPathReservoirsOfFrame MakePathReservoirs(FFrameContext& Context, uint32_t Width, uint32_t Height)
{
	FPathReservoirsOfFrame Out;
	// Launches of other rows may have as many threads.
	const std::string Name = "PathReservoirs" + std::to_string(Width) + "x" + std::to_string(Height);
	if (!RequireTwoFrames(Context, Name.c_str(), uint64_t(Width) * Height * sizeof(FPathReservoir), Out.Kept)) { return {}; }
	if (FRTStatus Status = Context.Owner->GetUploads().Allocate(sizeof(FPathReservoirs), Out.Constants); !Status)
	{
		Context.Fail(Status);
		return {};
	}
	return Out;
}

void DeclarePathReservoirs(FPassBuilder& Builder, const FPathReservoirsOfFrame& Reservoirs)
{
	if (Reservoirs.Kept.bPrevious) { Builder.Read(Reservoirs.Kept.Buffer, ERTAccess::StorageRead); }
	Builder.Write(Reservoirs.Kept.Buffer, ERTAccess::StorageWrite);
	Builder.Keep(Reservoirs.Kept.Buffer);
}

FAddress WritePathReservoirs(FPassContext& Pass, const FFrameContext& Frame, const FPathReservoirsOfFrame& Reservoirs)
{
	if (!Reservoirs.IsValid()) { return 0; }
	const FAddress Buffer = GetAddress(Pass, Reservoirs.Kept.Buffer);
	FPathReservoirs C = MakeConstants(Frame);
	C.Current = Buffer + Reservoirs.Kept.Offset;
	C.Previous = Reservoirs.Kept.bPrevious ? Buffer + Reservoirs.Kept.PreviousOffset : 0;
	std::memcpy(Reservoirs.Constants.Data, &C, sizeof(C));
	return Reservoirs.Constants.Address;
}

} // namespace Lantern
