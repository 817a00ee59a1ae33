#include "ValidationObjects.h"

#include <algorithm>

namespace Lantern
{
namespace
{

constexpr const char* KindNames[] = {"ray generation", "miss", "hit", "callable"};

/// Empty where the group may stand behind a record of this kind.
std::string CheckGroupKind(ERTRecordKind Kind, const FValidatedGroup& Group)
{
	const bool bHit = Kind == ERTRecordKind::Hit;
	if (bHit)
	{
		return Group.Kind == ERTGroupKind::General ? "is a general group, not a hit group" : "";
	}
	if (Group.Kind != ERTGroupKind::General)
	{
		return "is a hit group";
	}
	const ERTShaderStage Wanted = Kind == ERTRecordKind::RayGen ? ERTShaderStage::RayGen
	                              : Kind == ERTRecordKind::Miss ? ERTShaderStage::Miss
	                                                            : ERTShaderStage::Callable;
	return Group.GeneralStage == Wanted ? "" : "has a shader of another stage";
}

} // namespace

FValidatedBuffer::FValidatedBuffer(std::shared_ptr<FValidationState> InState, TRTRef<IRTBuffer> InInner)
    : TValidated(std::move(InState), MakeLabel("buffer", InInner->GetDesc().Name), InInner),
      Track(std::make_shared<FResourceTrack>())
{
	Track->Label = Label;
	Track->Memory = GetDesc().Memory;
	std::lock_guard Lock(State->Mutex);
	std::erase_if(State->Buffers, [](const std::weak_ptr<FResourceTrack>& Item) { return Item.expired(); });
	State->Buffers.push_back(Track);
}

FValidatedTexture::FValidatedTexture(std::shared_ptr<FValidationState> InState, TRTRef<IRTTexture> InInner,
                                     bool bImported)
    : TValidated(std::move(InState), MakeLabel("texture", InInner->GetDesc().Name), InInner),
      Track(std::make_shared<FResourceTrack>())
{
	Track->Label = Label;
	Track->bTexture = true;
	Track->State.bKnown = !bImported;
}

FValidatedGeometry::FValidatedGeometry(std::shared_ptr<FValidationState> InState, TRTRef<IRTGeometry> InInner,
                                       const FRTGeometryDesc& Desc)
    : TValidated(std::move(InState), MakeLabel("geometry", Desc.Name), InInner),
      Track(std::make_shared<FGeometryTrack>())
{
	Track->Label = Label;
	Track->Address = GetDeviceAddress();
	Track->Sections.assign(Desc.Sections, Desc.Sections + Desc.SectionCount);
	Track->bAllowUpdate = Desc.bAllowUpdate;
	std::lock_guard Lock(State->Mutex);
	State->Geometries[Track->Address] = Track;
}

FValidatedGeometry::~FValidatedGeometry()
{
	// The entry stays, to name the dead one where an instance still points at it.
	std::lock_guard Lock(State->Mutex);
	Track->bDead = true;
}

FValidatedScene::FValidatedScene(std::shared_ptr<FValidationState> InState, TRTRef<IRTScene> InInner, const char* Name)
    : TValidated(std::move(InState), MakeLabel("scene", Name), InInner),
      Track(std::make_shared<FSceneTrack>())
{
	Track->Label = Label;
	std::lock_guard Lock(State->Mutex);
	std::erase_if(State->Scenes, [](const std::weak_ptr<FSceneTrack>& Item) { return Item.expired(); });
	State->Scenes.push_back(Track);
}

bool FValidatedQueryPool::GetResults(uint32_t First, uint32_t Count, uint64_t* OutValues)
{
	if (!IsInside(First, Count, GetCount()) || !OutValues)
	{
		State->Report(Print("GetResults: queries %u + %u of %u", First, Count, GetCount()));
		return false;
	}
	return Inner->GetResults(First, Count, OutValues);
}

FValidatedShaderTable::FValidatedShaderTable(std::shared_ptr<FValidationState> InState, TRTRef<IRTShaderTable> InInner,
                                             const FRTShaderTableDesc& InDesc, FValidatedPipeline* InPipeline)
    : TValidated(std::move(InState), MakeLabel("shader table", InDesc.Name), InInner),
      Desc(Inner->GetDesc()),
      Pipeline(InPipeline),
      Track(std::make_shared<FTableTrack>())
{
	Desc.Pipeline = InPipeline;
	Track->Label = Label;
	Track->Records[static_cast<size_t>(ERTRecordKind::RayGen)].resize(Desc.RayGenCount);
	Track->Records[static_cast<size_t>(ERTRecordKind::Miss)].resize(Desc.MissCount);
	Track->Records[static_cast<size_t>(ERTRecordKind::Hit)].resize(Desc.HitCount);
	Track->Records[static_cast<size_t>(ERTRecordKind::Callable)].resize(Desc.CallableCount);
}

void FValidatedShaderTable::SetRecord(ERTRecordKind Kind, uint32_t Index, uint32_t Group, const void* Data,
                                      uint32_t DataBytes)
{
	std::vector<ERecordState>& Records = Track->Records[static_cast<size_t>(Kind)];
	const std::string What =
	    Print("SetRecord: %s: %s record %u", Label.c_str(), KindNames[static_cast<size_t>(Kind)], Index);
	if (Index >= Records.size())
	{
		return State->Report(What + Print(" is out of range, the table has %zu", Records.size()));
	}
	if (Group >= Pipeline->Groups.size())
	{
		return State->Report(
		    What + Print(": group %u, but %s has %zu", Group, Pipeline->Label.c_str(), Pipeline->Groups.size()));
	}
	const std::string Mismatch = CheckGroupKind(Kind, Pipeline->Groups[Group]);
	if (!Mismatch.empty())
	{
		return State->Report(What + Print(": group %u of %s %s", Group, Pipeline->Label.c_str(), Mismatch.c_str()));
	}
	const uint32_t Most = Kind == ERTRecordKind::Hit ? Desc.RecordDataBytes : 0;
	if (DataBytes > Most)
	{
		return State->Report(What + Print(": %u bytes of data, at most %u", DataBytes, Most));
	}
	Inner->SetRecord(Kind, Index, Group, Data, DataBytes);
	std::lock_guard Lock(State->Mutex);
	Records[Index] = ERecordState::Set;
}

void FValidatedShaderTable::SetHitRecords(uint32_t First, uint32_t Count, const uint32_t* Groups, const void* Data)
{
	Inner->SetHitRecords(First, Count, Groups, Data);
	std::lock_guard Lock(State->Mutex);
	auto& Records = Track->Records[static_cast<size_t>(ERTRecordKind::Hit)];
	std::fill_n(Records.begin() + First, Count, ERecordState::Set);
}

void FValidatedShaderTable::SetGroups(ERTRecordKind Kind, uint32_t First, uint32_t Count, const uint32_t* Groups)
{
	Inner->SetGroups(Kind, First, Count, Groups);
	std::lock_guard Lock(State->Mutex);
	std::fill_n(Track->Records[static_cast<size_t>(Kind)].begin() + First, Count, ERecordState::Set);
}

void FValidatedShaderTable::SetPipeline(IRTPipeline* InPipeline)
{
	auto* Mine = State->Require<FValidatedPipeline>(InPipeline, "SetPipeline: " + Label + ": Pipeline");
	if (!Mine)
	{
		return;
	}
	Inner->SetPipeline(Mine->Inner.Get());
	Pipeline = TRTRef<FValidatedPipeline>(Mine);
	Desc.Pipeline = Mine;
}

FRTStatus FValidatedShaderTable::Reserve(const uint32_t Counts[4])
{
	FRTStatus Status = Inner->Reserve(Counts);
	if (Status)
	{
		Desc = Inner->GetDesc();
		Desc.Pipeline = Pipeline.Get();
		const uint32_t Now[] = {Desc.RayGenCount, Desc.MissCount, Desc.HitCount, Desc.CallableCount};
		std::lock_guard Lock(State->Mutex);
		for (size_t Kind = 0; Kind < 4; ++Kind)
		{
			Track->Records[Kind].resize(Now[Kind]);
		}
	}
	return Status;
}

IRTRefCounted* GetUnwrapped(IRTRefCounted* Object)
{
	const auto* Wrapper = dynamic_cast<FValidated*>(Object);
	return Wrapper ? Wrapper->GetInner() : Object;
}

} // namespace Lantern
