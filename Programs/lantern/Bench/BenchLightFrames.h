// lantern bench lights --pictures: a frame's time with few and many lights in one view.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "Options.h"

namespace Lantern
{

struct FBenchLightFramesOptions
{
	FDeviceOptions Device;
	std::vector<uint32_t> Lamps = {64, 640, 10'000};
	uint32_t Rounds = 5; ///< each measures all of Lamps in turn
	uint32_t Frames = 8; ///< of one measurement
	std::string Size;    ///< WIDTHxHEIGHT; empty: see MakeBenchPicture
};

/// Prints a table and puts its figures into Json. Returns an exit status.
int RunBenchLightFrames(const FBenchLightFramesOptions& Options, nlohmann::json& Json);

} // namespace Lantern
