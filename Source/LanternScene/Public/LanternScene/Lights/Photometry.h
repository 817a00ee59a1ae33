// Luminous intensity of a luminaire by direction: tables of IES LM-63 files, and the regular grids that shaders read.
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "LanternRHI/RTStatus.h"

namespace Lantern
{

/// Photometry of type C, as goniophotometers measure it. The luminaire hangs at the pole and shines down at vertical angle 0.
struct FPhotometry
{
	std::vector<float> Vertical; ///< degrees, rising: from 0 or 90 to 90 or 180. It is dark outside of them
	/// Degrees, rising. From 0 to 0 (the same all around), 90 (all quarters alike), 180 (halves alike) or 360; or from 90 to 270.
	std::vector<float> Horizontal;
	std::vector<float> Candela; ///< ≥ 0, by horizontal, then by vertical angle; not all 0
};

/// A table on a regular grid, over its peak. It is exact if all angles are multiples of 0.25° and 1°. Between angles it is linear.
struct FProfileGrid
{
	std::vector<uint16_t> Texels;   ///< column after column; 65,535 is the peak
	uint32_t Rows = 0, Columns = 0; ///< vertical and horizontal angles
	float FirstAngle = 0.0f;        ///< vertical, degrees
	float RowsPerDegree = 1.0f, ColumnsPerDegree = 1.0f;
	float Peak = 0.0f; ///< candela
	friend bool operator==(const FProfileGrid&, const FProfileGrid&) = default;
};

/// Reads a file of IES LM-63-1986, -1991, -1995 or -2002. Name: of the file, for messages, which say its line, too. Unsupported:
/// photometry of types A and B, and a tilt in a file of its own. InvalidArgument: whatever breaks the format. Factors for tilted
/// lamps are read past. On an error Out stays as it was.
FRTStatus ParseIes(std::string_view Text, std::string_view Name, FPhotometry& Out);

/// Returns whether a table is as FPhotometry says. Name: as above.
FRTStatus CheckPhotometry(const FPhotometry& Table, std::string_view Name);

/// Table: CheckPhotometry holds.
FProfileGrid MakeProfileGrid(const FPhotometry& Table);

} // namespace Lantern
