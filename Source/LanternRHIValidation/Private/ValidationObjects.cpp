// Wrappers around buffers, textures, geometries and scenes: what they track.
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

IRTRefCounted* GetUnwrapped(IRTRefCounted* Object)
{
	const auto* Wrapper = dynamic_cast<FValidated*>(Object);
	return Wrapper ? Wrapper->GetInner() : Object;
}

} // namespace Lantern
