#pragma once

#include "VulkanApi.h"

namespace Lantern
{

/// "VK_ERROR_…", or the number of a result newer than these headers.
const char* ToString(VkResult Result);
/// An error that names what was tried, the object and the result. Ok for VK_SUCCESS.
FRTStatus MakeStatus(VkResult Result, const char* What, const char* Name);

} // namespace Lantern
