// The plan of a chart: its items in a fixed order, their distribution over shards, and the keys of their results.
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
	uint32_t ReferenceSamples = 256; ///< requested; a time budget may reduce it
	uint32_t Frames = 20, WarmUp = 16;
	uint32_t Seed = 0;
	std::string Variables; ///< console variables that differ from the code's defaults: "A=1 B=2", sorted
	nlohmann::json ToJson() const;
};

/// Returns console variables that files, a device profile or the command line set to other values than the code's defaults.
std::string DescribeVariables();

struct FChartSelection
{
	std::vector<ESignal> Signals;     ///< empty: all
	std::vector<std::string> Methods; ///< names; empty: all
	std::vector<EMeasurePath> Paths;  ///< empty: all
};

/// One point of a scene, or the costs of its facts.
struct FChartItem
{
	bool bFacts = false;
	EMeasurePath Path = EMeasurePath::Still;
	size_t Method = 0, Preset = 0; ///< into FMethods
	size_t Index = 0;              ///< over all scenes
};

/// Returns a scene's items in order: facts first, then by path, method and preset.
std::vector<FChartItem> ListChartItems(const FMethods& Methods, const FChartSelection& Selection);

struct FShard
{
	uint32_t Number = 1, Count = 1; ///< Number: 1 … Count
	bool Has(size_t Item) const { return Item % Count == Number - 1; }
};
/// Parses "2/8".
std::optional<FShard> ParseShard(std::string_view Text);

/// Sorts items for measuring within a time budget: cheap ones first, and among them still paths first.
void SortByPrice(std::vector<FChartItem>& Items);

/// Returns the number of reference samples that fits: the largest power of two with SecondsPerSample · samples ≤ Budget, in 4 to
/// Most.
uint32_t ChooseSamples(double SecondsPerSample, double Budget, uint32_t Most);

/// The components of a part's key. Equal components mean an equal measurement.
struct FChartKeyParts
{
	std::string Program; ///< hash of the program and its shaders
	std::string Device, Driver;
	std::string Scene; ///< hash of its content, and its light
	FChartSettings Settings;
};
std::string MakeChartKey(const FChartKeyParts& Parts, const FMethods& Methods, const FChartItem& Item);

} // namespace Lantern
