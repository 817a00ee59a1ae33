// Random walks over everything that can happen to a shader table, on the mock, with a model of brute force beside it.
// A walk is a list of steps that are data: any sublist of it can be walked too, so that one that fails can be shrunk.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace Lantern
{

enum class EWalkStep : uint8_t
{
	Frame, ///< prepare, record, submit; then the oldest frame in flight executes and is checked
	AddObject,
	RemoveObject,
	MoveObject,
	SetMaterials,
	EditMaterial,   ///< masked or not, another program, other texture coordinates
	ChangeGeometry, ///< other indices, other parts
	ToggleAlphaTest,
	SwapPipeline,   ///< one in which other programs are ready, stood in for, or missing
	ChangeRayTypes, ///< the same, and another number of ray types
	Burst,          ///< many objects at once
	Purge,          ///< most objects go
	LoseFrame,      ///< recorded, never submitted
	DropFrame,      ///< prepared, never recorded
	FailAllocation, ///< a frame in which an allocation fails
	ToggleMode,     ///< r.RT.SBT.Mode
	Corrupt,        ///< a wrong record behind the bindings' back: the walk must notice
	Count
};

struct FWalkStep
{
	EWalkStep Kind = EWalkStep::Frame;
	uint32_t A = 0, B = 0, C = 0; ///< random numbers, taken modulo whatever there is
};

struct FWalkSettings
{
	uint32_t HandleSize = 32, HandleAlignment = 32, BaseAlignment = 64;
	uint32_t InFlight = 0; ///< frames submitted and not executed while the next is prepared
};

struct FWalkResult
{
	std::string Failure; ///< empty: none
	uint32_t Step = 0;   ///< at which it failed
	uint64_t Frames = 0, RecordsChecked = 0, Growths = 0, Swaps = 0, LostFrames = 0, FailedFrames = 0;
};

std::vector<FWalkStep> MakeWalk(uint32_t Seed, uint32_t Steps);
FWalkResult RunWalk(const FWalkSettings& Settings, const std::vector<FWalkStep>& Steps);
/// Leaves out steps as long as the rest still fails.
std::vector<FWalkStep> ShrinkWalk(const FWalkSettings& Settings, std::vector<FWalkStep> Steps);
std::string ToString(const std::vector<FWalkStep>& Steps);

} // namespace Lantern
