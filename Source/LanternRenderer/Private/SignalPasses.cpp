// One row for each signal. Beside Frame.cpp, this is the one place that names passes.
#include "SignalPasses.h"

#include <cassert>

#include "AmbientOcclusion/AmbientOcclusion.h"
#include "DiffuseGI/DiffuseGI.h"
#include "Reflections/Reflections.h"
#include "SunShadow/SunShadow.h"
#include "Tiles/TileView.h"

namespace Lantern
{

namespace
{
constexpr FSignalPass Passes[] = {
    {ESignal::SunShadow, ChooseSunShadowRays, AddSunShadowPass, FollowsSunShadowMotion, ListSunShadowFilters, ESignal::Count, nullptr,
        TilePictures},
    {ESignal::AmbientOcclusion, ChooseAmbientOcclusionRays, AddAmbientOcclusionPass, IsAmbientOcclusionFiltered,
        ListAmbientOcclusionFilters, ESignal::DiffuseGI, SetAmbientOcclusionReference},
    {ESignal::DiffuseGI, ChooseDiffuseGIRays, AddDiffuseGIPass},
    {ESignal::Reflections, ChooseReflectionsRays, AddReflectionsPass},
};
static_assert(std::size(Passes) == SignalCount - 1, "each signal but Frame needs a row, in the order of ESignal");
} // namespace

const FSignalPass& GetSignalPass(ESignal Signal)
{
	assert(Signal != ESignal::Frame && Signal < ESignal::Count);
	const FSignalPass& Pass = Passes[ToIndex(Signal) - 1];
	assert(Pass.Signal == Signal);
	return Pass;
}

FPassRays ChooseSignalRays(const FFrameContext& Context, ESignal Signal)
{
	if (!IsMade(Signal, Context.Signals)) { return {}; }
	const FSignalPass& Pass = GetSignalPass(Signal);
	const bool bReplaced = Pass.ReplacedBy != ESignal::Count && Context.GetRayGen(Pass.ReplacedBy) != NoRayGen;
	return Pass.ChooseRays({Context.Device.GetCapabilities(), Context.Facts, Context.Signals, bReplaced});
}

FGraphTexture AddSignalPass(FFrameContext& Context, ESignal Signal, const FGBuffer& GBuffer)
{
	return GetSignalPass(Signal).Add(Context, GBuffer);
}

} // namespace Lantern
