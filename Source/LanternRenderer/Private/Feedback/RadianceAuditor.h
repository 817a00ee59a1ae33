// Collects what paths find that are followed although a radiance cell has answered: r.RT.GI.Residual. If it is 0, nothing is allocated.
#pragma once

#include "Feedback/GpuCounters.h"
#include "LanternRenderer/RadianceAudit.h"

namespace Lantern
{

enum class EResidual : uint8_t
{
	Off,
	Audited,   ///< some paths are followed
	Corrected, ///< and what they find corrects diffuse and rough specular light
};
EResidual GetResidual(); ///< render thread
/// Returns the chance with which a pixel follows its paths, to correct what cells answer.
float GetFollowChance();
/// Whether what is followed counts by its chance.
bool IsResidualWeighted();

/// Belongs to one renderer, which calls it as FGpuCounters says. Render thread.
class FRadianceAuditor
{
public:
	explicit FRadianceAuditor(IRTDevice& InDevice) : Counters(InDevice, "RadianceAudit") {}

	void BeginFrame(uint32_t FlightIndex);
	/// Audits this frame, if r.RT.GI.Residual is not 0. OutOfMemory: nothing is followed.
	FRTStatus Start();
	FGpuCounters& GetCounters() { return Counters; }
	/// Takes frames that are still in flight, after they have ended on the GPU.
	void TakeAll();
	const FRadianceAudit& Get() const { return Audit; }

private:
	void Take(std::span<const uint32_t> Frame);

	FGpuCounters Counters;
	FRadianceAudit Audit;
};

} // namespace Lantern
