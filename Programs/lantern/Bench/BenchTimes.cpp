// Elapsed time; median, smallest and largest of repeated measurements.
#include "Bench/BenchTimes.h"

#include <algorithm>
#include <ctime>

#include <nlohmann/json.hpp>

namespace Lantern
{

double GetMsSince(FBenchClock::time_point Start) { return std::chrono::duration<double, std::milli>(FBenchClock::now() - Start).count(); }

double GetThreadMs()
{
	timespec Time{};
	clock_gettime(CLOCK_THREAD_CPUTIME_ID, &Time);
	return double(Time.tv_sec) * 1e3 + double(Time.tv_nsec) * 1e-6;
}

double FBenchTimes::GetMedian() const
{
	std::vector<double> Sorted = Values;
	std::sort(Sorted.begin(), Sorted.end());
	const size_t Half = Sorted.size() / 2;
	return Sorted.empty() ? 0.0 : Sorted.size() % 2 ? Sorted[Half] : 0.5 * (Sorted[Half - 1] + Sorted[Half]);
}

double FBenchTimes::GetMin() const { return Values.empty() ? 0.0 : *std::min_element(Values.begin(), Values.end()); }
double FBenchTimes::GetMax() const { return Values.empty() ? 0.0 : *std::max_element(Values.begin(), Values.end()); }
nlohmann::json FBenchTimes::ToJson() const { return {{"median", GetMedian()}, {"min", GetMin()}, {"max", GetMax()}}; }

} // namespace Lantern
