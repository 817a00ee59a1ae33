// lantern compare A B [--heatmap OUT.png] [--json FILE]
#pragma once

#include <string>

namespace Lantern
{

struct FCompareOptions
{
	std::string A;
	std::string B;       ///< the reference
	std::string Heatmap; ///< FLIP's error map in false colour; empty: none
	std::string Json;    ///< empty: none
};

/// Prints a table to standard output and writes what was asked for. The exit status is 0, or 4 with a message in the log. It is 4 if an
/// image cannot be read, the two cannot be compared, or a file cannot be written. In the JSON, a figure that is infinite (psnr of equal
/// images) or undefined (no finite pixel) is null.
int RunCompare(const FCompareOptions& Options);

} // namespace Lantern
