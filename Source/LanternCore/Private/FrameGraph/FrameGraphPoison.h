// The pass that overwrites histories: see FFrameGraphResources::PoisonHistory.
#pragma once

#include <string>
#include <vector>

#include "FrameGraph/FrameGraphImpl.h"

namespace Lantern
{

class FPoisonPass
{
public:
	/// InResources: those of the graph. They must outlive this object.
	explicit FPoisonPass(std::vector<FGraphResource>& InResources) : Resources(InResources) {}

	/// Finds the histories whose names contain one of NameParts. InvalidArgument if one of them lacks CopyDest usage.
	FRTStatus Find(const std::vector<std::string>& NameParts);
	bool IsEmpty() const { return Textures.empty() && Buffers.empty(); }
	/// Makes the pass, and adds the buffer that it copies from to the resources.
	FGraphPass Make();

private:
	std::vector<FGraphResource>& Resources;
	std::vector<FGraphTexture> Textures;
	std::vector<FGraphBuffer> Buffers;
};

} // namespace Lantern
