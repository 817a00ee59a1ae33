// What a benchmark does, and how long it still takes, on standard error.
#pragma once

#include <chrono>
#include <string>
#include <string_view>

#include "Progress.h"

namespace Lantern
{

class FBenchProgress
{
public:
	/// Work: sum of all steps, in any unit.
	FBenchProgress(std::string InName, double InWork) : Name(std::move(InName)), Work(InWork) {}
	/// Ends the step before, and says which one begins. The line has the time left once a step has ended.
	void Begin(std::string_view Step, double StepWork);
	/// Call before a row is printed: on a terminal, the line would stand in its way.
	void Clear() { Line.Clear(); }

private:
	const std::string Name;
	const double Work;
	double Done = 0.0, Current = 0.0;
	std::chrono::steady_clock::time_point Start;
	FProgressLine Line;
};

} // namespace Lantern
