// The pages that `lantern chart` and `lantern bench growth` write beside their JSON.
#pragma once

#include <string>

#include <nlohmann/json.hpp>

namespace Lantern
{

/// Makes one HTML file that needs nothing else. It holds the template, Chart.js and the data, and forbids the browser to load anything.
/// DataWithImages is the object written as JSON ("scenes", "signals", "device", …) plus "images". These are data URLs by the keys that
/// points name as "picture" and "heatmap". Members that are missing or null are shown as figures that do not apply. Bytes that are no
/// UTF-8 are replaced. No text of the data can end the element that holds it.
std::string MakeChartPage(const nlohmann::json& DataWithImages);

/// Makes the page of `lantern bench growth` in the same way. Figures is the object written as JSON ("lines", "device", …).
std::string MakeGrowthPage(const nlohmann::json& Figures);

} // namespace Lantern
