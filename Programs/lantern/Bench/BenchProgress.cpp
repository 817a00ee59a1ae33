// Says the steps of a benchmark, and estimates its end.
#include "Bench/BenchProgress.h"

#include <algorithm>

#include <fmt/format.h>

namespace Lantern
{

void FBenchProgress::Begin(std::string_view Step, double StepWork)
{
	const auto Now = std::chrono::steady_clock::now();
	if (Current <= 0.0) { Start = Now; }
	Done += Current;
	Current = StepWork;
	std::string Left;
	if (Done > 0.0)
	{
		const double Seconds = std::chrono::duration<double>(Now - Start).count();
		Left = fmt::format(", {} left", FormatSeconds(Seconds / Done * std::max(0.0, Work - Done)));
	}
	Line.Announce("bench " + Name, std::min(1.0, Done / Work), std::string(Step) + Left);
}

} // namespace Lantern
