// The RTPSO: one ray-tracing pipeline for all dispatches of a frame, made of what the scene needs. A scene
// without alpha-tested materials has no any-hit shader in it; a frame without a pass that shades hits has no
// closest-hit shader.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "LanternCore/ShaderCompiler.h"
#include "LanternRHI/RTInterfaces.h"

namespace Lantern
{

class FSectionTable;

/// A kind of ray: what it runs where it hits and where it misses. In shaders NAME_RAY and NAME_MISS are its
/// indices, RAY_TYPES their number.
struct FRayType
{
	std::string Name; ///< upper case
	FShaderSource Miss;
	std::optional<FShaderSource> ClosestHit;
	FShaderSource MaskedAnyHit;
	uint32_t PayloadBytes = 0;
};

struct FRTPSODesc
{
	std::vector<FRayType> RayTypes;
	std::vector<FShaderSource> RayGens;
	bool bMasked = false;
};

class FRTPSO
{
public:
	/// Compiles all shaders in parallel, then the pipeline. Errors name shader, file and line.
	static FRTStatus Create(IRTDevice& Device, FShaderCompiler& Compiler, const FRTPSODesc& Desc, FRTPSO& Out);
	/// Equal strings: equal pipelines.
	static std::string MakeKey(const FRTPSODesc& Desc);

	IRTPipeline* GetPipeline() const { return Pipeline.Get(); }
	uint32_t GetRayTypeCount() const { return RayTypeCount; }
	uint32_t GetRayGenCount() const { return RayGenCount; }
	uint32_t GetHitGroupCount() const { return RayTypeCount * (bMasked ? 2 : 1); }
	uint32_t RayGenGroup(uint32_t Index) const { return Index; }
	uint32_t MissGroup(uint32_t RayType) const { return RayGenCount + RayType; }
	uint32_t HitGroup(uint32_t RayType, bool bSectionMasked) const
	{
		return RayGenCount + RayTypeCount * (bMasked && bSectionMasked ? 2 : 1) + RayType;
	}

private:
	TRTRef<IRTPipeline> Pipeline;
	uint32_t RayTypeCount = 0, RayGenCount = 0;
	bool bMasked = false;
};

/// The shader table that goes with it: one hit record per section and ray type.
class FShaderBindings
{
public:
	explicit FShaderBindings(IRTDevice& InDevice) : Device(InDevice) {}
	/// Writes records of changed sections, or all of them after the pipeline, the scene or the size changed, and copies
	/// them.
	FRTStatus Sync(IRTCommandList& List, const FRTPSO& Pipeline, FSectionTable& Sections);
	/// What the last Sync recorded was never submitted: the next one writes all records again.
	void Invalidate() { Table.Reset(); }
	IRTShaderTable* GetTable() const { return Table.Get(); }
	uint32_t GetRecordsWritten() const { return RecordsWritten; } ///< by the last Sync

private:
	void WriteSection(const FRTPSO& Pipeline, const FSectionTable& Sections, uint32_t Section);

	IRTDevice& Device;
	TRTRef<IRTShaderTable> Table;
	IRTPipeline* Bound = nullptr;                 // identity only
	const FSectionTable* BoundSections = nullptr; // the same
	uint32_t RecordsWritten = 0;
};

} // namespace Lantern
