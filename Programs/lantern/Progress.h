// One line on standard error that is overwritten while long work runs; whole lines, seldom, where it is no terminal.
#pragma once

#include <chrono>
#include <string>
#include <string_view>

namespace Lantern
{

class FProgressLine
{
public:
	FProgressLine();
	~FProgressLine() { Clear(); }
	/// Fraction 0 … 1; Detail follows it. Shown only if the work has taken a moment, and not more than ten times a second.
	void Show(std::string_view What, double Fraction, std::string_view Detail = {});
	/// As Show, but at once.
	void Announce(std::string_view What, double Fraction, std::string_view Detail);
	void Clear();

private:
	std::chrono::steady_clock::time_point Start, Last;
	bool bTerminal = false, bShown = false;
};

/// "1 h 2 min", "3 min 4 s", "5 s".
std::string FormatSeconds(double Seconds);

} // namespace Lantern
