// Which ray generation shaders and ray types a frame needs.
#pragma once

#include "LanternRenderer/Renderer.h"

namespace Lantern
{

struct FRayPrograms
{
	FRTPSODesc Desc; ///< no ray generation shaders: no pipeline is needed
	uint32_t SunShadowRayGen = NoRayGen;
	uint32_t ReferenceRayGen = NoRayGen;
};

/// Equal strings: equal pipelines.
std::string MakeRayProgramsKey(const FRTPSODesc& Desc);
FRayPrograms ChooseRayPrograms(const FRTCapabilities& Capabilities, const FSceneFacts& Facts, const FFrameFeatures& Features);

} // namespace Lantern
