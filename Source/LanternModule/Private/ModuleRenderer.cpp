// FModuleRenderer: how it begins, ends, and moves to another device. ModuleFrame.cpp has the frame.
#include "ModuleRenderer.h"

#include <utility>

#include "ArgumentChecks.h"
#include "LanternCore/Text/Log.h"

namespace Lantern
{

FModuleRenderer::FOnDevice::FOnDevice(IRTDevice& InDevice, FRendererDesc Desc)
    : Device(&InDevice),
      Scene(InDevice),
      Renderer(InDevice, std::move(Desc)),
      Uploads(InDevice),
      State(InDevice, Scene, Uploads),
      AheadLists(InDevice)
{}

FModuleRenderer::FOnDevice::~FOnDevice()
{
	// Environment: a lost device can no longer be waited for, and has nothing in flight.
	(void)Renderer.WaitForAll();
}

FModuleRenderer::FModuleRenderer(IRTModule& InOwner, IRTDevice& InDevice, const FModuleWorld& InWorld, FRendererDesc InDesc)
    : Owner(&InOwner),
      World(InWorld),
      Desc(std::move(InDesc)),
      On(std::make_unique<FOnDevice>(InDevice, Desc)),
      Calls(InDevice, World, On->Uploads)
{}

FModuleRenderer::~FModuleRenderer() = default;

FRTStatus FModuleRenderer::Watch(FRTStatus Status)
{
	if (Status.Code == ERTResult::DeviceLost && !std::exchange(bLost, true))
	{
		LogError("Module: the device is lost ({}). IRTModuleRenderer::Recreate takes the scene to another one", Status.Message);
	}
	return Status;
}

FRTStatus FModuleRenderer::Enter(const char* Function, std::unique_lock<std::mutex>& Out)
{
	Out = std::unique_lock(FrameMutex, std::try_to_lock);
	if (Out) { return FRTStatus::Success(); }
	return FRTStatus::Error(ERTResult::InvalidArgument, "%s: another thread is in RenderFrame, EndFrame or Recreate", Function);
}

FRTStatus FModuleRenderer::Recreate(IRTDevice* NewDevice, const FRTModuleMeshSource& Source)
{
	std::unique_lock<std::mutex> Lock;
	if (const FRTStatus Status = Enter("Recreate", Lock); !Status) { return Status; }
	if (const FRTStatus Status = CheckDevice("Recreate", NewDevice); !Status) { return Status; }
	auto New = std::make_unique<FOnDevice>(*NewDevice, Desc);
	if (const FRTStatus Status = Calls.TakeOver(*NewDevice, New->Uploads, Source, On->State.Describe()); !Status) { return Status; }
	Recorded = nullptr;
	ReleaseOutputs();
	On = std::move(New);
	bLost = false;
	return FRTStatus::Success();
}

} // namespace Lantern
