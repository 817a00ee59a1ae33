// When frames of a still view have stopped to change.
#pragma once

#include <cstddef>
#include <vector>

#include "LanternImage/Image.h"

namespace Lantern
{

/// Watches frames of a still view, whose filters accumulate. The change of a frame is the mean of |L − L'| / (L + M) over its pixels. L is
/// the luminance, L' that of the frame before, and M the picture's mean luminance. Filters divide their noise by the number of frames
/// at first, and so the change falls. Frames have settled once it is invisible, or once it falls no more.
class FSettling
{
public:
	/// A change below it is none: a quarter of a step of 8 bits at middle grey.
	static constexpr double InvisibleChange = 0.002;
	/// Number of frames over which changes are averaged. Two such windows are compared.
	static constexpr size_t Window = 4;
	/// The change falls if a window has less than this share of the window before it. A mean of n frames falls so until n = 21.
	static constexpr double FallingShare = 0.8;

	/// Adds a frame's linear radiance. All frames have one size. Returns whether they have settled.
	bool Add(const FImage& Radiance);
	/// Changes of all frames but the first.
	const std::vector<double>& GetChanges() const { return Changes; }

private:
	std::vector<float> Previous; // luminance
	std::vector<double> Changes;
};

} // namespace Lantern
