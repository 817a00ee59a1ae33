// FModuleRenderer: how it begins and ends. ModuleFrame.cpp has the frame.
#include "ModuleRenderer.h"

namespace Lantern
{

FModuleRenderer::FModuleRenderer(IRTModule& InOwner, IRTDevice& InDevice, FRendererDesc Desc)
    : Owner(&InOwner),
      Device(&InDevice),
      Scene(InDevice),
      Renderer(InDevice, std::move(Desc)),
      Uploads(InDevice),
      Calls(InDevice, Uploads),
      State(InDevice, Scene, Uploads)
{}

FModuleRenderer::~FModuleRenderer()
{
	// Environment: a lost device can no longer be waited for, and has nothing in flight.
	(void)Renderer.WaitForAll();
}

} // namespace Lantern
