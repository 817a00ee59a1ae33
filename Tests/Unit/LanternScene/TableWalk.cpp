#include "TableWalk.h"

#include <algorithm>
#include <cstring>
#include <deque>
#include <memory>
#include <random>
#include <utility>

#include "LanternCore/Config/ConsoleVariables.h"
#include "LanternRHIMock/MockDevice.h"
#include "LanternScene/ShaderTable/ShaderTable.h"
#include "TableModel.h"
#include "TableWalkScene.h"

namespace Lantern
{

namespace
{
constexpr uint32_t RecordsPerFrame = 16, FramesPerFullCheck = 3;

/// A frame that was submitted, and what must be on the device when it has executed.
struct FSubmittedFrame
{
	FRTFence Fence = 0;
	std::shared_ptr<FModelPipeline> Pipeline;
	TRTRef<IRTShaderTable> Table;
	std::vector<FExpectation> Sections;
};

class FWalker
{
public:
	explicit FWalker(const FWalkSettings& InSettings);
	~FWalker();
	FWalkResult Run(const std::vector<FWalkStep>& Steps);

private:
	void Do(const FWalkStep& Step);
	void Swap(uint32_t Types, uint32_t Random);
	void Corrupt(const FWalkStep& Step);

	FRTStatus Record();
	void Submit();
	void DoFrame(const FWalkStep& Step);
	void Lose()
	{
		Bindings->Invalidate();
		++Result.LostFrames;
		bQuiet = false;
	}
	void CheckQuiet();
	void CompleteOldest(uint32_t Random);
	void Check(const FSubmittedFrame& Frame, bool bAll, uint32_t Random);
	void CheckSection(const FSubmittedFrame& Frame, const FExpectation& Section);
	void CheckGeneral(const FSubmittedFrame& Frame);
	void Fail(const std::string& Why)
	{
		if (Result.Failure.empty()) { Result.Failure = Why; }
	}
	FRTMock& Mock() { return GetMock(Device.Get()); }

	FWalkSettings Settings;
	TRTRef<IRTDevice> Device;
	std::unique_ptr<FWalkScene> Scene;
	std::unique_ptr<FShaderTable> Bindings;
	std::shared_ptr<FModelPipeline> Pipeline;
	uint32_t PipelinesMade = 0;
	std::vector<TRTRef<IRTCommandList>> Lists;
	std::deque<FSubmittedFrame> InFlight;
	int Mode = 1;
	bool bQuiet = false; // nothing happened since the last submitted frame that a record depends on
	FWalkResult Result;
};

FWalker::FWalker(const FWalkSettings& InSettings) : Settings(InSettings)
{
	FRTMockDesc Desc;
	Desc.HandleSize = Settings.HandleSize;
	Desc.HandleAlignment = Settings.HandleAlignment;
	Desc.BaseAlignment = Settings.BaseAlignment;
	if (FRTStatus S = CreateMockDevice(Desc, Device.ReleaseAndGetAddress()); !S)
	{
		Fail(S.Message);
		return;
	}
	Mock().SetCallRecording(false);
	Mock().SetManualFences(true);
	Scene = std::make_unique<FWalkScene>(*Device);
	Bindings = std::make_unique<FShaderTable>(*Device);
	Lists.resize(Settings.InFlight + 1);
	for (TRTRef<IRTCommandList>& List : Lists) { (void)Device->CreateCommandList("Frame", List.ReleaseAndGetAddress()); }
	Swap(1, 1);
}

FWalker::~FWalker()
{
	FConsoleVariables::Get().ResetAll();
	FConsoleVariables::Get().BeginFrame();
	if (Device) { Mock().SetManualFences(false); }
}

// ------------------------------------------------------------------------------------------------ what happens

void FWalker::Swap(uint32_t Types, uint32_t Random)
{
	Pipeline = FModelPipeline::Make(*Device, PipelinesMade++, Types, Random);
	++Result.Swaps;
	if (!Pipeline) { Fail("a pipeline cannot be made"); }
}

void FWalker::Corrupt(const FWalkStep& Step)
{
	const std::vector<FWalkObject>& Objects = Scene->GetObjects();
	if (IRTShaderTable* const Table = Bindings->GetTable(); Table && !Objects.empty())
	{
		const FSectionRange& Range = Scene->GetSections().GetRange(Objects[Step.A % Objects.size()].Range);
		FSectionData Wrong = Scene->GetSections().Get(Range.First);
		Wrong.Flags ^= 0x80000000u;
		Table->SetRecord(ERTRecordKind::Hit, Range.First * Pipeline->RayTypes, 0, &Wrong, sizeof(Wrong));
	}
}

void FWalker::Do(const FWalkStep& Step)
{
	bQuiet &= Step.Kind == EWalkStep::Frame || Step.Kind == EWalkStep::MoveObject;
	switch (Step.Kind)
	{
	case EWalkStep::Frame:
	case EWalkStep::LoseFrame:
	case EWalkStep::DropFrame:
	case EWalkStep::FailAllocation: return DoFrame(Step);
	case EWalkStep::SwapPipeline: return Swap(Pipeline->RayTypes, Step.A);
	case EWalkStep::ChangeRayTypes: return Swap(1 + Step.B % 3, Step.A);
	case EWalkStep::Corrupt: return Corrupt(Step);
	case EWalkStep::ToggleMode:
		Mode = 1 - Mode;
		(void)FConsoleVariables::Get().Set("r.RT.SBT.Mode", std::to_string(Mode), ERTSetBy::Console, "walk");
		return FConsoleVariables::Get().BeginFrame();
	default: return Scene->Do(Step);
	}
}

// ------------------------------------------------------------------------------------------------ frames

FRTStatus FWalker::Record()
{
	IRTCommandList& List = *Lists[Result.Frames % Lists.size()];
	if (FRTStatus S = List.Begin(); !S) { return S; }
	FRTStatus Status = Bindings->Record(List);
	List.SetPipeline(Pipeline->Pipeline.GetPipeline());
	List.TraceRays(Bindings->GetTable(), 0, 1, 1, 1);
	const FRTStatus Ended = List.End();
	return Status ? Ended : Status;
}

void FWalker::DoFrame(const FWalkStep& Step)
{
	const bool bMayFail = Step.Kind == EWalkStep::FailAllocation;
	const uint32_t Before = Bindings->GetTable() ? Bindings->GetTable()->GetDesc().HitCount : 0;
	if (bMayFail) { Mock().FailAllocation(1 + Step.A % 2); }
	FRTStatus Status = Bindings->Prepare(Pipeline->Pipeline, Scene->GetSections());
	if (Status && Step.Kind == EWalkStep::DropFrame)
	{
		return; // never recorded, so nothing is lost
	}
	if (Status) { Status = Record(); }
	Mock().FailAllocation(0);
	Result.Growths += Bindings->GetTable() && Before > 0 && Bindings->GetTable()->GetDesc().HitCount > Before;
	if (!Status)
	{
		if (!bMayFail) { return Fail("a frame failed: " + std::string(Status.Message)); }
		++Result.FailedFrames;
		return Lose();
	}
	if (Step.Kind == EWalkStep::LoseFrame) { return Lose(); }
	CheckQuiet();
	Submit();
	while (InFlight.size() > Settings.InFlight) { CompleteOldest(Step.A); }
}

void FWalker::CheckQuiet()
{
	const FShaderTableStats& Stats = Bindings->GetStats();
	if (bQuiet && Mode == 1 && (Stats.BytesCopied || Stats.RecordsWritten || Stats.HandlesWritten))
	{
		Fail("a frame in which nothing changed wrote " + std::to_string(Stats.RecordsWritten + Stats.HandlesWritten) +
		     " records and copied " + std::to_string(Stats.BytesCopied) + " bytes");
	}
	bQuiet = true;
}

void FWalker::Submit()
{
	FSubmittedFrame& Frame = InFlight.emplace_back();
	IRTCommandList* const Submitted[] = {Lists[Result.Frames % Lists.size()].Get()};
	if (FRTStatus S = Device->Submit(Submitted, 1, &Frame.Fence); !S) { Fail(S.Message); }
	Frame.Pipeline = Pipeline;
	Frame.Table = TRTRef<IRTShaderTable>(Bindings->GetTable());
	Frame.Sections = Scene->MakeExpectations();
	++Result.Frames;
}

void FWalker::CompleteOldest(uint32_t Random)
{
	const FSubmittedFrame Frame = std::move(InFlight.front());
	InFlight.pop_front();
	Mock().CompleteUpTo(Frame.Fence);
	Check(Frame, Result.Frames % FramesPerFullCheck == 0, Random);
}

void FWalker::Check(const FSubmittedFrame& Frame, bool bAll, uint32_t Random)
{
	if (bAll) { CheckGeneral(Frame); }
	const size_t Count = bAll ? Frame.Sections.size() : std::min<size_t>(RecordsPerFrame, Frame.Sections.size());
	for (size_t I = 0; I < Count && Result.Failure.empty(); ++I)
	{
		CheckSection(Frame, Frame.Sections[bAll ? I : (Random + I * 7919) % Frame.Sections.size()]);
	}
}

void FWalker::CheckSection(const FSubmittedFrame& Frame, const FExpectation& Section)
{
	const uint32_t Types = Frame.Pipeline->RayTypes;
	for (uint32_t Type = 0; Type < Types; ++Type, ++Result.RecordsChecked)
	{
		FRTInstance Instance{};
		Instance.TableOffsetAndFlags = Section.Section * Types;
		const FRTMockRecord Record = Mock().ResolveHit(Frame.Table.Get(), Instance, 0, Type, Types);
		const std::string Where =
		    "section " + std::to_string(Section.Section) + ", ray type " + std::to_string(Type) + " of " + std::to_string(Types);
		if (!Record.IsGood()) { return Fail(Where + ": " + Record.Error); }
		const FGroupNames Expected = Frame.Pipeline->Expect(Section.Has.Program, Type);
		if (!(FGroupNames{Record.ClosestHit, Record.AnyHit, Record.Intersection} == Expected) || Record.Pipeline != Frame.Pipeline->Name)
		{
			return Fail(Where + ": runs '" + Record.ClosestHit + "' '" + Record.AnyHit + "' '" + Record.Intersection + "' of " +
			            Record.Pipeline + ", not '" + Expected.ClosestHit + "' '" + Expected.AnyHit + "' '" + Expected.Intersection +
			            "' of " + Frame.Pipeline->Name);
		}
		FSectionData Data;
		std::memcpy(&Data, Record.Data.data(), sizeof(Data));
		if (std::memcmp(&Data, &Section.Has.Data, sizeof(Data)) != 0)
		{
			return Fail(Where + ": material " + std::to_string(Data.Material) + ", flags " + std::to_string(Data.Flags) +
			            ", not material " + std::to_string(Section.Has.Data.Material) + ", flags " +
			            std::to_string(Section.Has.Data.Flags));
		}
	}
}

void FWalker::CheckGeneral(const FSubmittedFrame& Frame)
{
	const auto CheckKind = [&](ERTRecordKind Kind, uint32_t Count, const char* Stem) {
		for (uint32_t Index = 0; Index < Count; ++Index, ++Result.RecordsChecked)
		{
			const FRTMockRecord Record = Mock().ResolveRecord(Frame.Table.Get(), Kind, Index);
			if (!Record.IsGood() || Record.General != Stem + std::to_string(Index) || Record.Pipeline != Frame.Pipeline->Name)
			{
				Fail(std::string(Stem) + std::to_string(Index) + ": runs '" + Record.General + "' of " + Record.Pipeline + " " +
				     Record.Error);
			}
		}
	};
	// Also where no ray gets to: a record is null, or of this pipeline.
	const FRTShaderTableDesc& Table = Frame.Table->GetDesc();
	for (uint32_t Index = 0; Index < Table.HitCount; ++Index)
	{
		const FRTMockRecord Record = Mock().ResolveRecord(Frame.Table.Get(), ERTRecordKind::Hit, Index);
		if (Record.bInRange && Record.bStale) { return Fail(Record.Error); }
	}
	CheckKind(ERTRecordKind::RayGen, Frame.Pipeline->Pipeline.GetRayGenCount(), "gen");
	CheckKind(ERTRecordKind::Miss, Frame.Pipeline->RayTypes, "miss");
	CheckKind(ERTRecordKind::Callable, Frame.Pipeline->Pipeline.GetCallableCount(), "call");
}

FWalkResult FWalker::Run(const std::vector<FWalkStep>& Steps)
{
	for (uint32_t Step = 0; Step < Steps.size() && Result.Failure.empty(); ++Step)
	{
		Result.Step = Step;
		Do(Steps[Step]);
	}
	while (!InFlight.empty() && Result.Failure.empty())
	{
		const FSubmittedFrame Frame = std::move(InFlight.front());
		InFlight.pop_front();
		Mock().CompleteUpTo(Frame.Fence);
		Check(Frame, true, 0);
	}
	if (!Scene->GetFailure().empty()) { Fail(Scene->GetFailure()); }
	if (Mock().GetBlockingWaits() > 0) { Fail("something waited for the device"); }
	for (const std::string& Error : Mock().GetErrors()) { Fail(Error); }
	return Result;
}

} // namespace

FWalkResult RunWalk(const FWalkSettings& Settings, const std::vector<FWalkStep>& Steps) { return FWalker(Settings).Run(Steps); }

} // namespace Lantern
