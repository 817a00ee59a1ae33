// LANTERN_WITH_OIIO=OFF: ImageIO.cpp asks IsImageLibraryPresent() before it calls the others.
#include <cassert>

#include "ImageCodecs.h"

namespace Lantern
{

bool IsImageLibraryPresent() { return false; }

FRTStatus ReadWithLibrary(const std::string&, FImage&)
{
	assert(false);
	return FRTStatus::Error(ERTResult::Unsupported, "built with LANTERN_WITH_OIIO=OFF");
}

FRTStatus WriteWithLibrary(const std::string&, const std::string&, EImageFile, const FImage&)
{
	assert(false);
	return FRTStatus::Error(ERTResult::Unsupported, "built with LANTERN_WITH_OIIO=OFF");
}

} // namespace Lantern
