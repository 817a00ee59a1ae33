// The progress line on standard error.
#include "Progress.h"

#include <cmath>
#include <cstdio>

#include <unistd.h>

#include <fmt/format.h>

#include "LanternCore/Text/Quote.h"

namespace Lantern
{

namespace
{
double SecondsSince(std::chrono::steady_clock::time_point Time)
{
	return std::chrono::duration<double>(std::chrono::steady_clock::now() - Time).count();
}
} // namespace

FProgressLine::FProgressLine() : Start(std::chrono::steady_clock::now()), Last(Start), bTerminal(isatty(STDERR_FILENO) != 0) {}

void FProgressLine::Show(std::string_view What, double Fraction, std::string_view Detail)
{
	if (SecondsSince(Start) < 0.5 || SecondsSince(Last) < (bTerminal ? 0.1 : 5.0)) { return; }
	Announce(What, Fraction, Detail);
}

void FProgressLine::Announce(std::string_view What, double Fraction, std::string_view Detail)
{
	Last = std::chrono::steady_clock::now();
	// Names of scenes and methods are in it; a line break would leave the line that is overwritten.
	const std::string Line = EscapeText(fmt::format("{}: {:3.0f} %  {}", What, 100.0 * Fraction, Detail));
	if (bTerminal) { fmt::print(stderr, "\r{}\033[K", Line); }
	else { fmt::print(stderr, "{}\n", Line); }
	std::fflush(stderr);
	bShown = true;
}

void FProgressLine::Clear()
{
	if (bShown && bTerminal) { fmt::print(stderr, "\r\033[K"); }
	bShown = false;
}

std::string FormatSeconds(double Seconds)
{
	const long Whole = std::lround(Seconds);
	if (Whole >= 3600) { return fmt::format("{} h {} min", Whole / 3600, Whole / 60 % 60); }
	if (Whole >= 60) { return fmt::format("{} min {} s", Whole / 60, Whole % 60); }
	return fmt::format("{} s", Whole);
}

} // namespace Lantern
