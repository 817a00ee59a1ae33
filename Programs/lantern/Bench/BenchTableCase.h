// One size of lantern bench sbt: objects with sections and records, and frames in which some of them change.
#pragma once

#include <array>
#include <functional>
#include <memory>
#include <vector>

#include "Bench/BenchTimes.h"
#include "LanternCore/Shaders/ShaderCompiler.h"
#include "LanternScene/Pipelines/RTPSO.h"
#include "LanternScene/ShaderTable/SectionTable.h"
#include "LanternScene/ShaderTable/ShaderTable.h"

namespace Lantern
{

/// Microseconds of each repetition.
struct FTableTimes
{
	FBenchTimes Wall;
	FBenchTimes Processor; ///< of all threads
};

struct FTableCaseResult
{
	uint32_t Objects = 0, Records = 0;
	FTableTimes Full, Static, Dynamic, Swap;
	FTableTimes DynamicSections; ///< time of the sections in dynamic frames, which is not in Dynamic
	uint64_t BytesFull = 0, BytesStatic = 0, BytesDynamic = 0, BytesSwap = 0;
};

/// Two pipelines to swap between. Their programs are the same, their shaders differ.
struct FTablePrograms
{
	FRTPSO Pipelines[2];
	static constexpr uint32_t RayTypes = 2;
	FRTStatus Create(IRTDevice& Device, FShaderCompiler& Compiler);
};

class FTableCase
{
public:
	/// If bShared, all objects have one of a few material sets. Otherwise each has its own, so that no two share a record.
	FTableCase(IRTDevice& Device, const FTablePrograms& Programs, uint32_t ObjectCount, bool bShared);
	FRTStatus Measure(uint32_t Repetitions, FTableCaseResult& Out);

private:
	FRTStatus MakeGeometries();
	void AddObjects();
	void ChangeOnePerCent();
	FRTStatus Prepare() { return Bindings.Prepare(Programs.Pipelines[Pipeline], Sections); }
	/// Runs Change, then Prepare and Record, which are measured. Submits everything and waits for it.
	FRTStatus RunFrame(const std::function<void()>& Change, FTableTimes* Times, FTableTimes* ChangeTimes = nullptr);
	FRTStatus MeasureStatic(uint32_t Repetitions, FTableTimes& Out);

	IRTDevice& Device;
	const FTablePrograms& Programs;
	const uint32_t ObjectCount;
	const bool bShared;
	std::vector<std::unique_ptr<FRTGeometry>> Geometries;
	TGpuTable<FMaterialData> Materials{"Materials"};
	std::vector<uint32_t> MaterialPrograms;
	FSectionContext Context{Materials, MaterialPrograms};
	FSectionTable Sections{Context};
	FShaderTable Bindings;
	struct FObject
	{
		FSectionRangeId Range = 0;
		bool bOther = false; // has the second of its two material sets
	};
	std::vector<FObject> Objects;
	uint64_t Random = 1;
	uint32_t Pipeline = 0;
	TRTRef<IRTCommandList> List;
};

} // namespace Lantern
