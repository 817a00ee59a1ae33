// Parts of a chart: one file for each finished item. Pages are assembled from parts. A part holds everything that the page
// shows of it, so that parts of several machines can make one page.
#pragma once

#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "LanternRHI/RTTypes.h"

namespace Lantern
{

/// A part is a JSON object:
///   version 1, key (32 hexadecimal digits), order [scene, path, method, preset],
///   device driver is_cpu settings, scene {name width height},
///   and one of: facts [{fact frame_gpu_ms without_gpu_ms}], point {…}, skipped {…} as the page's data has them,
///   signal {name title} with point and skipped, images {key: data URL} with point.
using FChartPart = nlohmann::json;

std::string GetPartFile(const std::string& Folder, const std::string& Key);

/// Writes a part atomically. Several processes may write to one folder.
FRTStatus WritePart(const std::string& Folder, const FChartPart& Part);

/// Reads a part. Returns null if there is none of this key; a damaged file counts as none.
FChartPart ReadPart(const std::string& Folder, const std::string& Key);

/// Reads all parts of folders and single files. Other files in a folder are ignored. A single file that is not a part, and a
/// folder without parts, are errors.
FRTStatus ReadAllParts(const std::vector<std::string>& Places, std::vector<FChartPart>& Out);

/// Makes the data of a page, with images. The result does not depend on the order of parts. If parts share a key, measured ones
/// take precedence over skipped ones. InvalidArgument if settings differ, or if an item has two different measurements.
FRTStatus MakeChartData(std::vector<FChartPart> Parts, nlohmann::json& Out);

/// Returns page data without images, which is written beside the page.
nlohmann::json WithoutImages(const nlohmann::json& Data);

} // namespace Lantern
