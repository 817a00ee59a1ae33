#include "TableWalk.h"

#include <algorithm>
#include <chrono>
#include <cstring>
#include <deque>
#include <memory>
#include <random>

#include "LanternCore/ConsoleVariables.h"
#include "LanternRHIMock/MockDevice.h"
#include "LanternScene/ShaderBindings.h"
#include "TableModel.h"

namespace Lantern
{

/// What only the geometry store may change.
struct FGeometryTestAccess
{
	static void SetIndices(FRTGeometry& Geometry, TRTRef<IRTBuffer> Indices, uint64_t Offset, ERTIndexType Type)
	{
		Geometry.Indices = std::move(Indices);
		Geometry.IndicesOffset = Offset;
		Geometry.IndexType = Type;
	}
	static void SetParts(FRTGeometry& Geometry, std::vector<FRTGeometryPart> Parts)
	{
		Geometry.Parts = std::move(Parts);
	}
};

namespace
{
constexpr uint32_t MaterialCount = 7, GeometryCount = 8, MostObjects = 160;
constexpr uint32_t RecordsPerFrame = 16, FramesPerFullCheck = 2;

struct FWalkObject
{
	uint32_t Geometry = 0;
	std::vector<uint32_t> Materials;
	FSectionRangeId Range = 0;
};

struct FExpectation
{
	uint32_t Section = 0; // number, as the instance names it
	FModelSection Has;
};

/// A frame that was submitted, and what must be on the device when it has executed.
struct FSubmittedFrame
{
	FRTFence Fence = 0;
	std::shared_ptr<FModelPipeline> Pipeline;
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
	void Add(uint32_t Geometry, uint32_t Random);
	void Remove(uint32_t Index);
	void SetMaterials(FWalkObject& Object, uint32_t Random);
	void EditMaterial(const FWalkStep& Step);
	void ChangeGeometry(const FWalkStep& Step);
	void Swap(uint32_t Types, uint32_t Random);
	void Corrupt(const FWalkStep& Step);
	std::vector<uint32_t> DrawMaterials(uint32_t Geometry, uint32_t Random) const;
	void MakeGeometries();
	TRTRef<IRTBuffer> MakeBuffer(uint64_t Size);

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
	std::vector<FExpectation> MakeExpectations() const;
	void CompleteOldest(uint32_t Random);
	void Check(const FSubmittedFrame& Frame, bool bAll, uint32_t Random);
	void CheckSection(const FSubmittedFrame& Frame, const FExpectation& Section);
	void CheckGeneral(const FSubmittedFrame& Frame);
	void Fail(const std::string& Why)
	{
		if (Result.Failure.empty())
		{
			Result.Failure = Why;
		}
	}
	FRTMock& Mock() { return GetMock(Device.Get()); }

	FWalkSettings Settings;
	TRTRef<IRTDevice> Device;
	std::vector<FModelMaterial> ModelMaterials{MaterialCount};
	TGpuTable<FMaterialData> Materials{"Materials"};
	std::vector<uint32_t> Programs;
	FSectionContext Context{Materials, Programs};
	std::unique_ptr<FSectionTable> Sections;
	std::unique_ptr<FShaderBindings> Bindings;
	std::vector<std::unique_ptr<FRTGeometry>> Geometries;
	std::vector<FWalkObject> Objects;
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
	Sections = std::make_unique<FSectionTable>(Context);
	Bindings = std::make_unique<FShaderBindings>(*Device);
	for (const FModelMaterial& Material : ModelMaterials)
	{
		Materials.Add(Material.ToData());
	}
	Programs.resize(MaterialCount, StandardProgram);
	MakeGeometries();
	Lists.resize(Settings.InFlight + 1);
	for (TRTRef<IRTCommandList>& List : Lists)
	{
		(void)Device->CreateCommandList("Frame", List.ReleaseAndGetAddress());
	}
	Swap(1, 1);
}

FWalker::~FWalker()
{
	FConsoleVariables::Get().ResetAll();
	FConsoleVariables::Get().BeginFrame();
	if (Device)
	{
		Mock().SetManualFences(false);
	}
}

TRTRef<IRTBuffer> FWalker::MakeBuffer(uint64_t Size)
{
	TRTRef<IRTBuffer> Buffer;
	const FRTBufferDesc Desc{Size, ERTBufferUsage::Storage | ERTBufferUsage::GeometryInput, ERTMemory::Device,
	                         "Geometry"};
	if (FRTStatus S = Device->CreateBuffer(Desc, Buffer.ReleaseAndGetAddress()); !S)
	{
		Fail(S.Message);
	}
	return Buffer;
}

void FWalker::MakeGeometries()
{
	for (uint32_t Number = 0; Number < GeometryCount; ++Number)
	{
		FRTGeometryInfo Info;
		Info.Name = "G" + std::to_string(Number);
		Info.Positions = MakeBuffer(1024);
		Info.Attributes = MakeBuffer(1024);
		Info.Indices = MakeBuffer(4096);
		Info.Aabbs = MakeBuffer(1024);
		Info.IndexType = Number % 3 ? ERTIndexType::UInt32 : ERTIndexType::UInt16;
		for (uint32_t Section = 0; Section < 1 + Number * 2 / 3; ++Section)
		{
			FRTSectionInfo& Made = Info.Sections.emplace_back();
			Made.FirstIndex = 15 * Section;
			Made.IndexCount = 15;
			Made.bOpaque = Number == 1;
			Made.bProcedural = Number == 5 && Section == 1;
			if (Number % 2 == 0 && Section % 2 == 0)
			{
				Made.OpaqueIndexCount = 6; // classified: an opaque part of its own
			}
		}
		Geometries.push_back(std::make_unique<FRTGeometry>(std::move(Info)));
	}
}

// ------------------------------------------------------------------------------------------------ what happens

std::vector<uint32_t> FWalker::DrawMaterials(uint32_t Geometry, uint32_t Random) const
{
	std::minstd_rand Draw(Random | 1u);
	std::vector<uint32_t> Drawn(Geometries[Geometry]->GetSectionCount());
	for (uint32_t& Material : Drawn)
	{
		Material = Draw() % MaterialCount;
	}
	return Drawn;
}

void FWalker::Add(uint32_t Geometry, uint32_t Random)
{
	if (Objects.size() >= MostObjects)
	{
		return;
	}
	FWalkObject& Object = Objects.emplace_back();
	Object.Geometry = Geometry % GeometryCount;
	Object.Materials = DrawMaterials(Object.Geometry, Random);
	Object.Range = Sections->Acquire(*Geometries[Object.Geometry], Object.Materials);
}

void FWalker::Remove(uint32_t Index)
{
	Sections->Release(Objects[Index].Range);
	Objects[Index] = Objects.back();
	Objects.pop_back();
}

void FWalker::SetMaterials(FWalkObject& Object, uint32_t Random)
{
	Object.Materials = DrawMaterials(Object.Geometry, Random);
	const FSectionRangeId Range = Sections->Acquire(*Geometries[Object.Geometry], Object.Materials);
	Sections->Release(std::exchange(Object.Range, Range));
}

void FWalker::EditMaterial(const FWalkStep& Step)
{
	const uint32_t Index = Step.A % MaterialCount;
	FModelMaterial& Material = ModelMaterials[Index];
	Material.bMasked = Step.B & 1;
	Material.bDoubleSided = Step.B & 2;
	Material.bSecondUV = Step.B & 4;
	Material.Program = Step.C % 6; // one more than any pipeline has
	Materials.Set(Index, Material.ToData());
	Programs[Index] = Material.Program;
	Sections->MaterialChanged(Index);
}

void FWalker::ChangeGeometry(const FWalkStep& Step)
{
	FRTGeometry& Geometry = *Geometries[Step.A % GeometryCount];
	const FRTGeometryInfo& Info = Geometry.GetInfo();
	if (Step.B % 2)
	{
		FGeometryTestAccess::SetIndices(Geometry, MakeBuffer(4096), 2 * (Step.C % 7),
		                                Step.C % 2 ? ERTIndexType::UInt16 : ERTIndexType::UInt32);
	}
	else
	{
		FGeometryTestAccess::SetParts(Geometry, MakeGeometryParts(Info, Step.C % 2));
	}
	Sections->GeometryChanged(Geometry);
}

void FWalker::Swap(uint32_t Types, uint32_t Random)
{
	Pipeline = FModelPipeline::Make(*Device, PipelinesMade++, Types, Random);
	++Result.Swaps;
	if (!Pipeline)
	{
		Fail("a pipeline cannot be made");
	}
}

void FWalker::Corrupt(const FWalkStep& Step)
{
	if (IRTShaderTable* const Table = Bindings->GetTable(); Table && !Objects.empty())
	{
		const FSectionRange& Range = Sections->GetRange(Objects[Step.A % Objects.size()].Range);
		FSectionData Wrong = Sections->Get(Range.First);
		Wrong.Flags ^= 0x80000000u;
		Table->SetRecord(ERTRecordKind::Hit, Range.First * Pipeline->RayTypes, 0, &Wrong, sizeof(Wrong));
	}
}

void FWalker::Do(const FWalkStep& Step)
{
	const auto Chosen = [&](uint32_t Random) { return Random % static_cast<uint32_t>(Objects.size()); };
	bQuiet &= Step.Kind == EWalkStep::Frame || Step.Kind == EWalkStep::MoveObject;
	switch (Step.Kind)
	{
	case EWalkStep::Frame:
	case EWalkStep::LoseFrame:
	case EWalkStep::DropFrame:
	case EWalkStep::FailAllocation: return DoFrame(Step);
	case EWalkStep::AddObject: return Add(Step.A, Step.B);
	case EWalkStep::EditMaterial: return EditMaterial(Step);
	case EWalkStep::ChangeGeometry: return ChangeGeometry(Step);
	case EWalkStep::SwapPipeline: return Swap(Pipeline->RayTypes, Step.A);
	case EWalkStep::ChangeRayTypes: return Swap(1 + Step.B % 3, Step.A);
	case EWalkStep::Corrupt: return Corrupt(Step);
	case EWalkStep::ToggleAlphaTest: Context.bAlphaTest = !Context.bAlphaTest; return Sections->RefillAll();
	case EWalkStep::ToggleMode:
		Mode = 1 - Mode;
		(void)FConsoleVariables::Get().Set("r.RT.SBT.Mode", std::to_string(Mode), ERTSetBy::Console, "walk");
		return FConsoleVariables::Get().BeginFrame();
	case EWalkStep::Burst:
		for (uint32_t I = 0; I < 24; ++I)
		{
			Add(Step.A + I, Step.B + I * 977);
		}
		return;
	default: break;
	}
	if (Objects.empty())
	{
		return;
	}
	switch (Step.Kind)
	{
	case EWalkStep::RemoveObject: return Remove(Chosen(Step.A));
	case EWalkStep::SetMaterials: return SetMaterials(Objects[Chosen(Step.A)], Step.B);
	case EWalkStep::MoveObject: std::swap(Objects[Chosen(Step.A)], Objects[Chosen(Step.B)]); return;
	case EWalkStep::Purge:
		while (Objects.size() > 1 + Step.A % 4)
		{
			Remove(Chosen(Step.B));
		}
		return;
	default: return;
	}
}

// ------------------------------------------------------------------------------------------------ frames

FRTStatus FWalker::Record()
{
	IRTCommandList& List = *Lists[Result.Frames % Lists.size()];
	if (FRTStatus S = List.Begin(); !S)
	{
		return S;
	}
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
	if (bMayFail)
	{
		Mock().FailAllocation(1 + Step.A % 2);
	}
	FRTStatus Status = Bindings->Prepare(Pipeline->Pipeline, *Sections);
	if (Status && Step.Kind == EWalkStep::DropFrame)
	{
		return; // never recorded, so nothing is lost
	}
	if (Status)
	{
		Status = Record();
	}
	Mock().FailAllocation(0);
	Result.Growths += Bindings->GetTable() && Before > 0 && Bindings->GetTable()->GetDesc().HitCount > Before;
	if (!Status)
	{
		if (!bMayFail)
		{
			return Fail("a frame failed: " + std::string(Status.Message));
		}
		++Result.FailedFrames;
		return Lose();
	}
	if (Step.Kind == EWalkStep::LoseFrame)
	{
		return Lose();
	}
	CheckQuiet();
	Submit();
	while (InFlight.size() > Settings.InFlight)
	{
		CompleteOldest(Step.A);
	}
}

void FWalker::CheckQuiet()
{
	const FShaderBindingStats& Stats = Bindings->GetStats();
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
	if (FRTStatus S = Device->Submit(Submitted, 1, &Frame.Fence); !S)
	{
		Fail(S.Message);
	}
	Frame.Pipeline = Pipeline;
	Frame.Sections = MakeExpectations();
	++Result.Frames;
}

std::vector<FExpectation> FWalker::MakeExpectations() const
{
	std::vector<FExpectation> All;
	for (const FWalkObject& Object : Objects)
	{
		const FRTGeometry& Geometry = *Geometries[Object.Geometry];
		const uint32_t First = Sections->GetRange(Object.Range).First;
		for (uint32_t Part = 0; Part < Geometry.GetParts().size(); ++Part)
		{
			const FRTGeometryPart& Where = Geometry.GetParts()[Part];
			const uint32_t Material = Object.Materials[Where.Section];
			All.push_back(
			    {First + Part, ExpectSection(Geometry, Where, Material, ModelMaterials[Material], Context.bAlphaTest)});
		}
	}
	return All;
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
	if (bAll)
	{
		CheckGeneral(Frame);
	}
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
		const FRTMockRecord Record = Mock().ResolveHit(Bindings->GetTable(), Instance, 0, Type, Types);
		const std::string Where = "section " + std::to_string(Section.Section) + ", ray type " + std::to_string(Type) +
		                          " of " + std::to_string(Types);
		if (!Record.IsGood())
		{
			return Fail(Where + ": " + Record.Error);
		}
		const FGroupNames Expected = Frame.Pipeline->Expect(Section.Has.Program, Type);
		if (!(FGroupNames{Record.ClosestHit, Record.AnyHit, Record.Intersection} == Expected) ||
		    Record.Pipeline != Frame.Pipeline->Name)
		{
			return Fail(Where + ": runs '" + Record.ClosestHit + "' '" + Record.AnyHit + "' '" + Record.Intersection +
			            "' of " + Record.Pipeline + ", not '" + Expected.ClosestHit + "' '" + Expected.AnyHit + "' '" +
			            Expected.Intersection + "' of " + Frame.Pipeline->Name);
		}
		FSectionData Data;
		std::memcpy(&Data, Record.Data.data(), sizeof(Data));
		if (std::memcmp(&Data, &Section.Has.Data, sizeof(Data)) != 0)
		{
			return Fail(Where + ": material " + std::to_string(Data.Material) + ", flags " +
			            std::to_string(Data.Flags) + ", not material " + std::to_string(Section.Has.Data.Material) +
			            ", flags " + std::to_string(Section.Has.Data.Flags));
		}
	}
}

void FWalker::CheckGeneral(const FSubmittedFrame& Frame)
{
	const auto CheckKind = [&](ERTRecordKind Kind, uint32_t Count, const char* Stem)
	{
		for (uint32_t Index = 0; Index < Count; ++Index, ++Result.RecordsChecked)
		{
			const FRTMockRecord Record = Mock().ResolveRecord(Bindings->GetTable(), Kind, Index);
			if (!Record.IsGood() || Record.General != Stem + std::to_string(Index) ||
			    Record.Pipeline != Frame.Pipeline->Name)
			{
				Fail(std::string(Stem) + std::to_string(Index) + ": runs '" + Record.General + "' of " +
				     Record.Pipeline + " " + Record.Error);
			}
		}
	};
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
	if (Mock().GetBlockingWaits() > 0)
	{
		Fail("something waited for the device");
	}
	for (const std::string& Error : Mock().GetErrors())
	{
		Fail(Error);
	}
	return Result;
}

} // namespace

std::vector<FWalkStep> MakeWalk(uint32_t Seed, uint32_t Count)
{
	// Per cent, in the order of EWalkStep; what is left is a frame.
	constexpr uint32_t Weights[] = {0, 20, 13, 3, 9, 8, 3, 1, 4, 2, 2, 1, 2, 1, 1, 1, 0};
	static_assert(std::size(Weights) == static_cast<size_t>(EWalkStep::Count));
	std::mt19937 Random(Seed);
	std::vector<FWalkStep> Steps(Count);
	for (FWalkStep& Step : Steps)
	{
		uint32_t Left = Random() % 100;
		for (uint32_t Kind = 1; Kind < std::size(Weights); ++Kind)
		{
			if (Left < Weights[Kind])
			{
				Step.Kind = static_cast<EWalkStep>(Kind);
				break;
			}
			Left -= Weights[Kind];
		}
		Step.A = static_cast<uint32_t>(Random());
		Step.B = static_cast<uint32_t>(Random());
		Step.C = static_cast<uint32_t>(Random());
	}
	return Steps;
}

FWalkResult RunWalk(const FWalkSettings& Settings, const std::vector<FWalkStep>& Steps)
{
	return FWalker(Settings).Run(Steps);
}

std::vector<FWalkStep> ShrinkWalk(const FWalkSettings& Settings, std::vector<FWalkStep> Steps)
{
	const auto Start = std::chrono::steady_clock::now();
	const auto IsOver = [&] { return std::chrono::steady_clock::now() - Start > std::chrono::seconds(20); };
	for (size_t Chunk = std::max<size_t>(1, Steps.size() / 2); Chunk > 0 && !IsOver(); Chunk /= 2)
	{
		for (size_t First = 0; First < Steps.size() && !IsOver();)
		{
			std::vector<FWalkStep> Fewer = Steps;
			Fewer.erase(Fewer.begin() + static_cast<ptrdiff_t>(First),
			            Fewer.begin() + static_cast<ptrdiff_t>(std::min(First + Chunk, Steps.size())));
			if (RunWalk(Settings, Fewer).Failure.empty())
			{
				First += Chunk;
			}
			else
			{
				Steps = std::move(Fewer);
			}
		}
	}
	return Steps;
}

std::string ToString(const std::vector<FWalkStep>& Steps)
{
	constexpr const char* Names[] = {
	    "Frame",          "AddObject",       "RemoveObject",   "MoveObject",     "SetMaterials", "EditMaterial",
	    "ChangeGeometry", "ToggleAlphaTest", "SwapPipeline",   "ChangeRayTypes", "Burst",        "Purge",
	    "LoseFrame",      "DropFrame",       "FailAllocation", "ToggleMode",     "Corrupt"};
	static_assert(std::size(Names) == static_cast<size_t>(EWalkStep::Count));
	std::string Text;
	for (const FWalkStep& Step : Steps)
	{
		Text += "\n  {EWalkStep::" + std::string(Names[static_cast<size_t>(Step.Kind)]) + ", " +
		        std::to_string(Step.A) + "u, " + std::to_string(Step.B) + "u, " + std::to_string(Step.C) + "u},";
	}
	return Text;
}

} // namespace Lantern
