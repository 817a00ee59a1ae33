// Parts of a chart: one file for each item that is done, from which pages are put together. A part holds all that the
// page says of it, so that parts of several machines make one page.
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
///   signal {name title} with the latter two, images {key: data URL} with a point.
using FChartPart = nlohmann::json;

std::string GetPartFile(const std::string& Folder, const std::string& Key);

/// Whole or not at all. Several processes may write to one folder.
FRTStatus WritePart(const std::string& Folder, const FChartPart& Part);

/// Null: there is none, or what is there is no part of this key (a damaged file counts as none).
FChartPart ReadPart(const std::string& Folder, const std::string& Key);

/// All parts of folders and of single files. What a folder holds beside parts is left alone; a file that is named and is
/// no part, and a folder without one, are errors.
FRTStatus ReadAllParts(const std::vector<std::string>& Places, std::vector<FChartPart>& Out);

/// The data of a page, with images. The same parts give the same bytes, in whichever order they come. Of parts of one key
/// one that was measured is taken before one that was skipped. InvalidArgument: parts of different settings, or two
/// different measurements of one item.
FRTStatus MakeChartData(std::vector<FChartPart> Parts, nlohmann::json& Out);

/// The same without images: what is written beside the page.
nlohmann::json WithoutImages(const nlohmann::json& Data);

} // namespace Lantern
