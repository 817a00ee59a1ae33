// Checks of an engine's image or buffer before it is wrapped.
#pragma once

#include "LanternRHI/RTTypes.h"

#include <vulkan/vulkan_core.h>

namespace Lantern
{

class FVulkanDevice;

/// InvalidArgument names what of Desc cannot be, or does not fit the image. Vulkan tells nothing of an image but the memory that
/// it needs, so another size, format or number of mips is found only if that needs other memory.
FRTStatus CheckImport(FVulkanDevice& Device, const FRTTextureDesc& Desc, VkImage Image);
/// The same of a buffer: Vulkan tells of one only how much memory it needs.
FRTStatus CheckImport(FVulkanDevice& Device, const FRTBufferDesc& Desc, const FRTNativeBuffer& Native);

} // namespace Lantern
