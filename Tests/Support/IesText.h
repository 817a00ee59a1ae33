// Text of IES LM-63 files for tests.
#pragma once

#include <string>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace Lantern
{

/// A file of 2002 whose intensity, in candela, is a function of the horizontal and the vertical angle, degrees.
template <class TIntensity>
std::string MakeIesText(const std::vector<double>& Vertical, const std::vector<double>& Horizontal, TIntensity&& Intensity)
{
	std::string Text = fmt::format("IESNA:LM-63-2002\n[TEST] none\nTILT=NONE\n1 1000 1 {} {} 1 2 0.1 0.1 0\n1 1 10\n{}\n{}\n",
	    Vertical.size(), Horizontal.size(), fmt::join(Vertical, " "), fmt::join(Horizontal, " "));
	for (const double H : Horizontal)
	{
		for (const double V : Vertical) { Text += fmt::format("{:.9g} ", Intensity(H, V)); }
		Text += '\n';
	}
	return Text;
}

inline std::vector<double> MakeAngles(double First, double Last, double Step)
{
	std::vector<double> Out;
	for (int I = 0; First + I * Step <= Last + 1e-9; ++I) { Out.push_back(First + I * Step); }
	return Out;
}

} // namespace Lantern
