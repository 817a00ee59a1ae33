// Results of Vulkan as FRTStatus.
#pragma once

#include <string>
#include <string_view>

#include "Device/VulkanApi.h"
#include "LanternRHI/RTText.h"

namespace Lantern
{

/// Returns "VK_ERROR_…", or the number of a result that is newer than these headers.
const char* ToString(VkResult Result);
/// Returns all of a text from outside as it may stand in a message. FRTShown is for names, which it cuts.
std::string Show(std::string_view Text, ERTTextKind Kind = ERTTextKind::OneLine);
/// Returns an error that names what was tried, the object and the result. Ok for VK_SUCCESS.
FRTStatus MakeStatus(VkResult Result, const char* What, const char* Name);

} // namespace Lantern
