// The page that `lantern chart` writes beside its JSON.
#pragma once

#include <string>

#include <nlohmann/json.hpp>

namespace Lantern
{

/// One HTML file that needs nothing else: the template, Chart.js and the data are in it, and it forbids the browser to
/// load anything. DataWithImages: the object written as JSON ("scenes", "signals", "device", …) plus "images", data
/// URLs by the keys that points name as "picture" and "heatmap". Members that are missing or null are shown as figures
/// that do not apply; bytes that are no UTF-8 are replaced. No text of the data can end the element that holds it.
std::string MakeChartPage(const nlohmann::json& DataWithImages);

} // namespace Lantern
