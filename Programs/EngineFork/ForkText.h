// What files, drivers and the command line say may hold anything; a terminal gets what can be shown of it.
#pragma once

#include <string>

#include "LanternRHI/RTText.h"

namespace Fork
{

inline std::string Show(const std::string& Text)
{
	std::string Out;
	Lantern::ShowText(
	    Text.data(), Text.size(), Lantern::ERTTextKind::Lines, [&](const char* Bytes, size_t Count) { Out.append(Bytes, Count); });
	return Out;
}

} // namespace Fork
