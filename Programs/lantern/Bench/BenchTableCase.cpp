// One size of lantern bench sbt: its objects, their changes, and the measured frames.
#include "Bench/BenchTableCase.h"

#include <algorithm>
#include <ctime>
#include <utility>

#include "Bench/BenchPipelineWhole.h"
#include "LanternCore/Config/ConsoleVariables.h"

namespace Lantern
{

namespace
{
constexpr uint64_t WaitNs = 60'000'000'000ull;
constexpr uint32_t GeometryCount = 16, SharedSets = 16;
/// Frames in which nothing changes are timed so many at once: one takes less than a clock can tell.
constexpr uint32_t StaticFrames = 1000;

double GetSeconds(clockid_t Clock)
{
	timespec Time{};
	clock_gettime(Clock, &Time);
	return double(Time.tv_sec) + 1e-9 * double(Time.tv_nsec);
}

/// Adds what passed since its creation, divided by Frames, when it goes.
class FTableTimer
{
public:
	explicit FTableTimer(FTableTimes* InTimes, uint32_t InFrames = 1) : Times(InTimes), Frames(InFrames)
	{
		Processor = GetSeconds(CLOCK_PROCESS_CPUTIME_ID);
		Wall = GetSeconds(CLOCK_MONOTONIC);
	}
	~FTableTimer()
	{
		const double WallEnd = GetSeconds(CLOCK_MONOTONIC);
		const double ProcessorEnd = GetSeconds(CLOCK_PROCESS_CPUTIME_ID);
		if (Times)
		{
			Times->Wall.Add(1e6 * (WallEnd - Wall) / Frames);
			Times->Processor.Add(1e6 * (ProcessorEnd - Processor) / Frames);
		}
	}
	FTableTimer(const FTableTimer&) = delete;
	FTableTimer& operator=(const FTableTimer&) = delete;

private:
	FTableTimes* Times;
	uint32_t Frames;
	double Wall, Processor;
};

/// Body may use P, the payload. No two shaders are the same, nor have the same code: drivers give those one handle.
FShaderSource MakeShader(const std::string& Name, const std::string& Body)
{
	FShaderSource Source;
	Source.Path = Name;
	Source.Text = "#version 460\n#extension GL_EXT_ray_tracing : require\n";
	Source.Text += Body.empty() ? "" : "layout(location = 0) rayPayloadInEXT uint P;\n";
	Source.Text += "void main() { " + Body + " }\n";
	return Source;
}

FRTPSODesc MakePrograms(uint32_t Pipeline)
{
	uint32_t Number = 100 * Pipeline;
	const auto Next = [&Number] { return std::to_string(++Number) + "u"; };
	FRTPSODesc Desc;
	Desc.RayGens = {MakeShader("BenchGenerate", "")};
	for (const std::string Name : {"SHADOW", "MATERIAL"})
	{
		FRayType& Type = Desc.RayTypes.emplace_back();
		Type.Name = Name;
		Type.Miss = MakeShader("BenchMiss" + Name, "P = " + Next() + ";");
		Type.ClosestHit = MakeShader("BenchHit" + Name, "P = gl_PrimitiveID + " + Next() + ";");
		Type.MaskedAnyHit = MakeShader("BenchAnyHit" + Name, "if (P == " + Next() + ") { ignoreIntersectionEXT; }");
		Type.PayloadBytes = 4;
	}
	Desc.HitPrograms = {{StandardProgram, ERTHitClass::Opaque}, {StandardProgram, ERTHitClass::Masked}};
	return Desc;
}

FRTStatus CreateBuffer(IRTDevice& Device, const char* Name, uint64_t Size, TRTRef<IRTBuffer>& Out)
{
	const FRTBufferDesc Desc{Size, ERTBufferUsage::Storage | ERTBufferUsage::GeometryInput, ERTMemory::Device, Name};
	return Device.CreateBuffer(Desc, Out.ReleaseAndGetAddress());
}
} // namespace

FRTStatus FTablePrograms::Create(IRTDevice& Device, FShaderCompiler& Compiler)
{
	for (uint32_t Pipeline = 0; Pipeline < 2; ++Pipeline)
	{
		const FRTStatus Status = MakeWholeRTPSO(Device, Compiler, FMaterialPrograms(), MakePrograms(Pipeline), Pipelines[Pipeline]);
		if (!Status) { return Status; }
	}
	return FRTStatus::Success();
}

FTableCase::FTableCase(IRTDevice& InDevice, const FTablePrograms& InPrograms, uint32_t InObjectCount, bool bInShared)
    : Device(InDevice),
      Programs(InPrograms),
      ObjectCount(InObjectCount),
      bShared(bInShared),
      Bindings(InDevice)
{}

FRTStatus FTableCase::MakeGeometries()
{
	for (uint32_t Number = 0; Number < GeometryCount; ++Number)
	{
		FRTGeometryInfo Info;
		Info.Name = "BenchGeometry";
		for (TRTRef<IRTBuffer>* Buffer : {&Info.Positions, &Info.Attributes, &Info.Indices})
		{
			if (FRTStatus S = CreateBuffer(Device, "BenchGeometry", 256, *Buffer); !S) { return S; }
		}
		Info.VertexCount = 3;
		Info.Sections = {{0, 3, false}};
		Geometries.push_back(std::make_unique<FRTGeometry>(std::move(Info)));
	}
	return FRTStatus::Success();
}

void FTableCase::AddObjects()
{
	const uint32_t MaterialCount = bShared ? 2 * SharedSets : 2 * ObjectCount;
	for (uint32_t Index = 0; Index < MaterialCount; ++Index)
	{
		FMaterialData Material{};
		Material.Flags = Index % 4 ? 0 : MATERIAL_MASKED;
		Materials.Add(Material);
	}
	Objects.resize(ObjectCount);
	for (uint32_t Index = 0; Index < ObjectCount; ++Index)
	{
		const uint32_t Material = bShared ? Index % SharedSets : Index;
		Objects[Index].Range = Sections.Acquire(*Geometries[Index % GeometryCount], {Material});
	}
}

void FTableCase::ChangeOnePerCent()
{
	const uint32_t Half = Materials.Num() / 2;
	for (uint32_t Change = 0; Change < ObjectCount / 100; ++Change)
	{
		Random = Random * 6364136223846793005ull + 1442695040888963407ull;
		const uint32_t Index = static_cast<uint32_t>((Random >> 33) % ObjectCount);
		FObject& Object = Objects[Index];
		Object.bOther = !Object.bOther;
		const uint32_t Material = (bShared ? Index % SharedSets : Index) + (Object.bOther ? Half : 0);
		const FSectionRangeId Old = Object.Range;
		Object.Range = Sections.Acquire(*Geometries[Index % GeometryCount], {Material});
		Sections.Release(Old);
	}
}

FRTStatus FTableCase::RunFrame(const std::function<void()>& Change, FTableTimes* Times, FTableTimes* ChangeTimes)
{
	{
		const FTableTimer Timer(ChangeTimes);
		Change();
	}
	if (FRTStatus S = List->Begin(); !S) { return S; }
	FRTStatus Status;
	{
		const FTableTimer Timer(Times);
		Status = Prepare();
		if (Status) { Status = Bindings.Record(*List); }
	}
	const FRTStatus Ended = List->End();
	if (!Status || !Ended) { return Status ? Ended : Status; }
	IRTCommandList* const Lists[] = {List.Get()};
	FRTFence Fence = 0;
	if (FRTStatus S = Device.Submit(Lists, 1, &Fence); !S) { return S; }
	return Device.WaitFor(Fence, WaitNs); // a driver that works on the CPU must not do so while the next frame is timed
}

FRTStatus FTableCase::MeasureStatic(uint32_t Repetitions, FTableTimes& Out)
{
	for (uint32_t Repetition = 0; Repetition < Repetitions; ++Repetition)
	{
		if (FRTStatus S = List->Begin(); !S) { return S; }
		FRTStatus Status;
		{
			const FTableTimer Timer(&Out, StaticFrames);
			for (uint32_t Frame = 0; Frame < StaticFrames && Status; ++Frame)
			{
				Status = Bindings.Sync(*List, Programs.Pipelines[Pipeline], Sections);
			}
		}
		const FRTStatus Ended = List->End();
		if (!Status || !Ended) { return Status ? Ended : Status; }
	}
	return FRTStatus::Success();
}

FRTStatus FTableCase::Measure(uint32_t Repetitions, FTableCaseResult& Out)
{
	constexpr uint32_t WarmFrames = 4; // host copies are made, pages touched
	if (FRTStatus S = MakeGeometries(); !S) { return S; }
	if (FRTStatus S = Device.CreateCommandList("BenchTables", List.ReleaseAndGetAddress()); !S) { return S; }
	AddObjects();
	Out.Objects = ObjectCount;
	Out.Records = Sections.GetCapacity() * FTablePrograms::RayTypes;
	const auto MeasureFrames = [&](const std::function<void()>& Change, FTableTimes& Times, FTableTimes* ChangeTimes, uint64_t& OutBytes) {
		for (uint32_t Frame = 0; Frame < WarmFrames + Repetitions; ++Frame)
		{
			const bool bMeasured = Frame >= WarmFrames;
			if (FRTStatus S = RunFrame(Change, bMeasured ? &Times : nullptr, bMeasured ? ChangeTimes : nullptr); !S) { return S; }
			OutBytes = bMeasured ? std::max(OutBytes, Bindings.GetStats().BytesCopied) : 0;
		}
		return FRTStatus::Success();
	};
	const auto SetMode = [](const char* Mode) {
		FConsoleVariables::Get().Set("r.RT.SBT.Mode", Mode, ERTSetBy::Console, "bench sbt");
		FConsoleVariables::Get().BeginFrame();
	};
	SetMode("0");
	FRTStatus Status = MeasureFrames([] {}, Out.Full, nullptr, Out.BytesFull);
	SetMode("1");
	FTableTimes Unused;
	if (Status)
	{
		Status = MeasureFrames([] {}, Unused, nullptr, Out.BytesStatic);
	}
	if (Status) { Status = MeasureStatic(Repetitions, Out.Static); }
	if (Status)
	{
		Status = MeasureFrames([this] { ChangeOnePerCent(); }, Out.Dynamic, &Out.DynamicSections, Out.BytesDynamic);
	}
	if (Status)
	{
		Status = MeasureFrames([this] { Pipeline ^= 1; }, Out.Swap, nullptr, Out.BytesSwap);
	}
	return Status;
}

} // namespace Lantern
