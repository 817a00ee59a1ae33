// One row for each signal. Beside Frame.cpp, this is the one place that names passes.
#include "SignalPasses.h"

#include <algorithm>
#include <cassert>

#include "AmbientOcclusion/AmbientOcclusion.h"
#include "DiffuseGI/DiffuseGI.h"
#include "LocalLights/LampView.h"
#include "LocalLights/LocalLights.h"
#include "RadianceCells/RadianceCellsView.h"
#include "Reflections/ReflectingToon.h"
#include "Reflections/Reflections.h"
#include "SunShadow/SunShadow.h"
#include "Tiles/TileView.h"

namespace Lantern
{

namespace
{
constexpr FSignalPass Passes[] = {
    {.Signal = ESignal::SunShadow,
        .ChooseRays = ChooseSunShadowRays,
        .Add = AddSunShadowPass,
        .WantsMotion = FollowsSunShadowMotion,
        .ListFilters = ListSunShadowFilters,
        .AskShadowRays = AskSunShadowRays,
        .Pictures = TilePictures},
    {.Signal = ESignal::AmbientOcclusion,
        .ChooseRays = ChooseAmbientOcclusionRays,
        .Add = AddAmbientOcclusionPass,
        .WantsMotion = IsAmbientOcclusionFiltered,
        .ListFilters = ListAmbientOcclusionFilters,
        .ReplacedBy = ESignal::DiffuseGI,
        .SetReferenceConstants = SetAmbientOcclusionReference},
    {.Signal = ESignal::DiffuseGI,
        .ChooseRays = ChooseDiffuseGIRays,
        .Add = AddDiffuseGIPass,
        .WantsMotion = IsDiffuseGIFiltered,
        .ListFilters = ListDiffuseGIFilters,
        .EmissionIn = ESignal::LocalDiffuse,
        .KeepsRadianceCells = ChooseCachedLightPath,
        .bStyled = true,
        .bToonGraded = true,
        .Pictures = RadianceCellPictures},
    {.Signal = ESignal::Reflections,
        .ChooseRays = ChooseReflectionsRays,
        .Add = AddReflectionsPass,
        .WantsMotion = AreReflectionsFiltered,
        .bFollowsHits = true,
        .ListFilters = ListReflectionFilters,
        .EmissionIn = ESignal::LocalSpecular,
        .AddSurface = AddReflectingSurface,
        .ListSurfaceShaders = ListReflectingToonShaders,
        .Pictures = ReflectionPictures},
    {.Signal = ESignal::LocalDiffuse,
        .ChooseRays = ChooseLocalLightRays,
        .Add = AddLocalDiffusePass,
        .WantsMotion = AreLocalLightsFiltered,
        .ListFilters = ListLocalLightFilters,
        .AskShadowRays = AskLocalRays,
        .IsHalf = AreLocalLightsHalf,
        .bBesideLightMask = true,
        .Pictures = LampPictures},
    {.Signal = ESignal::LocalSpecular,
        .ChooseRays = ChooseLocalLightRays,
        .Add = AddLocalSpecularPass,
        .WantsMotion = AreLocalLightsFiltered,
        .ListFilters = ListLocalLightFilters,
        .AskShadowRays = AskLocalRays,
        .IsHalf = AreLocalLightsHalf,
        .bBesideLightMask = true,
        .SetReferenceConstants = SetLocalSpecularReference},
    {.Signal = ESignal::RoughSpecular,
        .ChooseRays = ChooseRoughSpecularRays,
        .Add = AddRoughSpecularPass,
        .WantsMotion = IsDiffuseGIFiltered,
        .ListFilters = ListDiffuseGIFilters,
        .RaysOf = ESignal::DiffuseGI,
        .EmissionIn = ESignal::LocalSpecular,
        .bStyled = true},
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

ESignal GetLightMaskRow()
{
	const auto* const Found =
	    std::find_if(std::begin(Passes), std::end(Passes), [](const FSignalPass& Pass) { return Pass.bBesideLightMask; });
	assert(Found != std::end(Passes));
	return Found->Signal;
}

bool AsksForRays(ESignal Signal, const FSignalRequests& Requests)
{
	if (IsMade(Signal, Requests) || (Requests.bLightMask && Signal == GetLightMaskRow())) { return true; }
	return std::any_of(std::begin(Passes), std::end(Passes),
	    [&](const FSignalPass& Pass) { return Pass.RaysOf == Signal && IsMade(Pass.Signal, Requests); });
}

ERayPath ChooseRadianceCellPath(const FPassQuery& Query)
{
	for (const FSignalPass& Pass : Passes)
	{
		if (!Pass.KeepsRadianceCells || !AsksForRays(Pass.Signal, Query.Requests)) { continue; }
		if (const ERayPath Path = Pass.KeepsRadianceCells(Query); Path != ERayPath::None) { return Path; }
	}
	return ERayPath::None;
}

bool IsAnyMadeBesideLightMask(const FSignalRequests& Requests)
{
	return std::any_of(std::begin(Passes), std::end(Passes),
	    [&](const FSignalPass& Pass) { return Pass.bBesideLightMask && IsMade(Pass.Signal, Requests); });
}

FPassRays ChooseSignalRays(const FFrameContext& Context, ESignal Signal)
{
	const auto Choose = [&](const FSignalPass& Pass) {
		if (!AsksForRays(Pass.Signal, Context.Signals)) { return FPassRays(); }
		const bool bReplaced = Pass.ReplacedBy != ESignal::Count && Context.GetRayGen(Pass.ReplacedBy) != NoRayGen;
		return Pass.ChooseRays({Context.Device.GetCapabilities(), Context.Facts, Context.Signals, bReplaced});
	};
	if (!GetSignalPass(Signal).AskShadowRays) { return Choose(GetSignalPass(Signal)); }
	std::array<FPassRays, SignalCount> Rays;
	ForEachSignalPass([&](const FSignalPass& Pass) {
		if (Pass.AskShadowRays) { Rays[ToIndex(Pass.Signal)] = Choose(Pass); }
	});
	ShareQueueShader(Rays);
	return Rays[ToIndex(Signal)];
}

void ShareQueueShader(std::array<FPassRays, SignalCount>& Rays)
{
	const auto Asks = [&](const FSignalPass& Pass) {
		const FPassRays& Its = Rays[ToIndex(Pass.Signal)];
		return Pass.AskShadowRays && Its.Path != ERayPath::None && Its.bTraces;
	};
	FShaderDefines All;
	ForEachSignalPass([&](const FSignalPass& Pass) {
		if (!Asks(Pass)) { return; }
		for (const auto& Define : Rays[ToIndex(Pass.Signal)].Defines)
		{
			if (std::find(All.begin(), All.end(), Define) == All.end()) { All.push_back(Define); }
		}
	});
	ForEachSignalPass([&](const FSignalPass& Pass) {
		if (Asks(Pass)) { Rays[ToIndex(Pass.Signal)].Defines = All; }
	});
}

FGraphTexture AddSignalPass(FFrameContext& Context, ESignal Signal, const FGBuffer& GBuffer)
{
	return GetSignalPass(Signal).Add(Context, GBuffer);
}

} // namespace Lantern
