// Wrappers around buffers, textures, geometries, scenes and query pools: what they track.
#include "ValidationObjects.h"

#include <algorithm>

namespace Lantern
{
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

FValidatedTexture::FValidatedTexture(std::shared_ptr<FValidationState> InState, TRTRef<IRTTexture> InInner, bool bImported)
    : TValidated(std::move(InState), MakeLabel("texture", InInner->GetDesc().Name), InInner),
      Track(std::make_shared<FResourceTrack>())
{
	Track->Label = Label;
	Track->bTexture = true;
	Track->State.bKnown = !bImported;
}

FValidatedGeometry::FValidatedGeometry(std::shared_ptr<FValidationState> InState, TRTRef<IRTGeometry> InInner, const FRTGeometryDesc& Desc)
    : TValidated(std::move(InState), MakeLabel("geometry", Desc.Name), InInner),
      Track(std::make_shared<FGeometryTrack>())
{
	Track->Label = Label;
	Track->Address = GetDeviceAddress();
	Track->Sections.assign(Desc.Sections, Desc.Sections + Desc.SectionCount);
	Track->bAllowUpdate = Desc.bAllowUpdate;
	Track->bFastBuild = Desc.bFastBuild;
	Track->bAllowCompaction = Desc.bAllowCompaction;
	Track->CompactedBytes = Desc.CompactedBytes;
	std::lock_guard Lock(State->Mutex);
	State->Geometries[Track->Address] = Track;
}

FValidatedGeometry::~FValidatedGeometry()
{
	// The entry stays, so that a message can name it if an instance still points at it.
	State->Bury(Track);
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

FValidatedQueryPool::FValidatedQueryPool(std::shared_ptr<FValidationState> InState, TRTRef<IRTQueryPool> InInner)
    : TValidated(std::move(InState), Print("query pool of %u", InInner->GetCount()), InInner),
      Track(std::make_shared<FQueryTrack>())
{
	Track->Label = Label;
	Track->Queries.resize(GetCount());
}

bool FValidatedQueryPool::GetResults(uint32_t First, uint32_t Count, uint64_t* OutValues)
{
	if (!IsInside(First, Count, GetCount()) || !OutValues)
	{
		State->Report(Print("GetResults: queries %u + %u of %u", First, Count, GetCount()));
		return false;
	}
	const bool bThere = Inner->GetResults(First, Count, OutValues);
	if (!bThere || GetKind() != ERTQuery::CompactedSize) { return bThere; }
	FRTFence Completed[QueueCount];
	for (uint32_t Queue = 0; Queue < QueueCount; ++Queue)
	{
		Completed[Queue] = State->Inner->GetCompletedFence(static_cast<ERTQueue>(Queue));
	}
	std::lock_guard Lock(State->Mutex);
	for (uint32_t i = 0; i < Count; ++i)
	{
		const FQueryTrack::FQuery& Query = Track->Queries[First + i];
		// Until the submission that writes it has finished, the pool may still hold the size of another geometry.
		const bool bDone = Query.Fence <= Completed[static_cast<size_t>(GetFenceQueue(Query.Fence))];
		if (Query.Geometry && bDone) { Query.Geometry->CompactedSize = OutValues[i]; }
	}
	return true;
}

void FValidatedQueryPool::MarkReset(uint32_t First, uint32_t Count)
{
	std::lock_guard Lock(State->Mutex);
	for (uint32_t i = First; i < First + Count; ++i) { Track->Queries[i].bReset = true; }
}

IRTRefCounted* GetUnwrapped(IRTRefCounted* Object)
{
	const auto* Wrapper = dynamic_cast<FValidated*>(Object);
	return Wrapper ? Wrapper->GetInner() : Object;
}

} // namespace Lantern
