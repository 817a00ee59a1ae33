// What a chart measures: items in a fixed order, which of them a shard does, and under which names they are kept.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <nlohmann/json.hpp>

#include "LanternMeasure/MeasurePaths.h"
#include "LanternMeasure/Methods.h"

namespace Lantern
{

struct FChartSettings
{
	uint32_t Width = 320, Height = 180;
	uint32_t ReferenceSamples = 256; ///< asked for; a budget may take fewer
	uint32_t Frames = 20, WarmUp = 16;
	uint32_t Seed = 0;
	std::string Variables; ///< console variables that are not as the code has them: "A=1 B=2", sorted
	nlohmann::json ToJson() const;
};

/// Console variables that files, a device profile or the command line set to other values than the code's.
std::string DescribeVariables();

struct FChartSelection
{
	std::vector<ESignal> Signals;     ///< empty: all
	std::vector<std::string> Methods; ///< names; empty: all
	std::vector<EMeasurePath> Paths;  ///< empty: all
};

/// One point of a scene, or its facts.
struct FChartItem
{
	bool bFacts = false;
	EMeasurePath Path = EMeasurePath::Still;
	size_t Method = 0, Preset = 0; ///< into FMethods
	size_t Index = 0;              ///< over all scenes
};

/// A scene's items in their order: facts, then by path, method, preset.
std::vector<FChartItem> ListChartItems(const FMethods& Methods, const FChartSelection& Selection);

struct FShard
{
	uint32_t Number = 1, Count = 1; ///< Number: 1 … Count
	bool Has(size_t Item) const { return Item % Count == Number - 1; }
};
/// "2/8".
std::optional<FShard> ParseShard(std::string_view Text);

/// The order in which to measure within a budget: what is cheap first, and of that what stands still.
void SortByPrice(std::vector<FChartItem>& Items);

/// Samples of references that fit: the largest power of two with Seconds · samples ≤ Budget, 4 to Most.
uint32_t ChooseSamples(double SecondsPerSample, double Budget, uint32_t Most);

/// What a part's key is made of. Equal texts: the same measurement.
struct FChartKeyParts
{
	std::string Program; ///< hash of the program and its shaders
	std::string Device, Driver;
	std::string Scene; ///< hash of its content, and its light
	FChartSettings Settings;
};
std::string MakeChartKey(const FChartKeyParts& Parts, const FMethods& Methods, const FChartItem& Item);

} // namespace Lantern
