// What followed paths have found, from the GPU.
#include "Feedback/RadianceAuditor.h"

#include <cassert>
#include <cmath>
#include <cstring>

#include "LanternCore/Config/ConsoleVariables.h"
#include "RadianceCellTypes.h"

namespace Lantern
{

namespace
{
TRTConsoleVariable<int32_t> CVarResidual("r.RT.GI.Residual", 0,
    "Follows paths of r.RT.GI 3 although a radiance cell has answered. 0: none. 1: up to 4,096 in a frame, which say how wrong cells are "
    "(lantern render --json). 2: those of one pixel in eight as well, and the difference corrects diffuse and rough specular light. Its "
    "mean is then that of whole paths, with much noise: for whoever averages frames. There is no filter then, and no r.RT.GI.Reuse.",
    {0, 2});
TRTConsoleVariable<bool> CVarChance("r.RT.Debug.GI.ResidualChance", true,
    "Planted fault. If off, what r.RT.GI.Residual 2 corrects does not count by the chance with which it is looked for.");

constexpr uint32_t Words = RADIANCE_AUDIT_PATHS * sizeof(FRadianceAuditPath) / sizeof(uint32_t);
static_assert(RADIANCE_AUDIT_PATHS == RADIANCE_AUDIT_SIDE * RADIANCE_AUDIT_SIDE);
} // namespace

EResidual GetResidual() { return static_cast<EResidual>(CVarResidual.GetOnRenderThread()); }
float GetFollowChance() { return GetResidual() == EResidual::Corrected ? 0.125f : 0.0f; }
bool IsResidualWeighted() { return CVarChance.GetOnRenderThread(); }

void FRadianceAuditor::BeginFrame(uint32_t FlightIndex)
{
	Counters.BeginFrame(FlightIndex, [this](std::span<const uint32_t> Frame) { Take(Frame); });
}

FRTStatus FRadianceAuditor::Start() { return GetResidual() != EResidual::Off ? Counters.Start(Words) : FRTStatus::Success(); }

void FRadianceAuditor::TakeAll()
{
	Counters.TakeAll([this](std::span<const uint32_t> Frame) { Take(Frame); });
}

void FRadianceAuditor::Take(std::span<const uint32_t> Frame)
{
	assert(Frame.size() == Words);
	FRadianceAuditSums* const Sums[RADIANCE_AUDIT_CLASSES] = {nullptr, &Audit.Cells, &Audit.Leaves, &Audit.Coarse, &Audit.Lost};
	for (uint32_t I = 0; I < RADIANCE_AUDIT_PATHS; ++I)
	{
		FRadianceAuditPath Path;
		std::memcpy(&Path, reinterpret_cast<const std::byte*>(Frame.data()) + I * sizeof(Path), sizeof(Path));
		if (Path.Answer == RADIANCE_AUDIT_NONE || Path.Answer >= RADIANCE_AUDIT_CLASSES) { continue; }
		if (!std::isfinite(Path.Answered) || !std::isfinite(Path.Followed)) { continue; }
		Sums[Path.Answer]->Add(Path.Answered, Path.Followed);
	}
	++Audit.Frames;
}

} // namespace Lantern
