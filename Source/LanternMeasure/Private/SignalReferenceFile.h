// A reference of a signal as a file: a header, two images of float32, and a checksum over both.
#pragma once

#include <string>

#include "LanternHost/SceneHash.h"
#include "LanternMeasure/SignalReference.h"

namespace Lantern
{

/// What the two images must be like.
struct FReferenceFileShape
{
	uint32_t Width = 0, Height = 0, Channels = 0;
};

/// Whole or not at all; several processes may write the same.
FRTStatus WriteReferenceFile(const std::string& Path, const FContentHash& Key, const FSignalReference& Reference);

/// False: not there, or not what it should be, which is said. Fills A, B and Seconds.
bool ReadReferenceFile(const std::string& Path, const FContentHash& Key, const FReferenceFileShape& Shape, FSignalReference& Out);

} // namespace Lantern
