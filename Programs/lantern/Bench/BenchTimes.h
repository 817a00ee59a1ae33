// The clock of benchmarks, and repeated measurements of one thing.
#pragma once

#include <chrono>
#include <vector>

#include <nlohmann/json_fwd.hpp>

namespace Lantern
{

using FBenchClock = std::chrono::steady_clock;
double GetMsSince(FBenchClock::time_point Start);
/// Returns the processor time of the calling thread, in milliseconds.
double GetThreadMs();

/// Values are in the unit of whoever adds them. Every figure of no values is 0.
class FBenchTimes
{
public:
	void Add(double Value) { Values.push_back(Value); }
	size_t GetCount() const { return Values.size(); }
	double GetMedian() const; ///< the mean of the middle two if the number is even
	double GetMin() const;
	double GetMax() const;
	nlohmann::json ToJson() const; ///< median, min and max

private:
	std::vector<double> Values;
};

} // namespace Lantern
