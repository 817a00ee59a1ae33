// What `lantern stability` says: rows of a table, JSON, strips, and the list of known shortfalls.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <tuple>
#include <vector>

#include <nlohmann/json.hpp>

#include "LanternMeasure/Stability/StabilityCase.h"
#include "LanternMeasure/Stability/StabilityStage.h"

namespace Lantern
{

/// One figure of one case and method.
struct FStabilityRow
{
	int Number = 0;
	std::string Name, Part, Method, Signal, Preset;
	std::string Status;                         ///< empty, or why there is no figure: "no method yet"
	bool bBroken = false;                       ///< it should have one
	std::optional<double> Figure, Worst, Limit; ///< median and worst over the seeds
	bool bFloor = false;
	std::optional<bool> Holds;
	std::string Fault;
	std::optional<double> FaultFigure;
	std::optional<bool> FaultFails;
	uint32_t Seeds = 0;
	bool bKnown = false; ///< a known shortfall
	/// What a build must not pass with, known shortfalls aside.
	bool IsBad() const { return bBroken || (Holds && !*Holds) || (FaultFails && !*FaultFails); }
};

/// Known shortfalls: lines "case | method | part | reason"; # begins a comment. Where ~ is before the case's number, the figure
/// is so near its limit that chance decides: it may fail, and need not.
class FKnownShortfalls
{
public:
	/// Errors name file and line.
	FRTStatus Load(const std::string& Path);
	bool Has(const FStabilityRow& Row) const;
	/// What is bad: rows that fail and are not known, and known ones that hold again. Only what ran.
	std::vector<std::string> Check(const std::vector<FStabilityRow>& Rows) const;

private:
	std::map<std::tuple<int, std::string, std::string>, bool> Known; // whether it must fail
};

void PrintStabilityHeader();
void PrintStabilityRow(const FStabilityRow& Row);
nlohmann::json MakeStabilityJson(const std::vector<FStabilityRow>& Rows);
/// Frames in a row, what they should be below them. Radiance is tone-mapped.
FRTStatus SaveStrip(
    const std::string& Path, const std::vector<std::pair<FImage, FImage>>& Strip, const FSignalInfo& Signal, float Exposure);

} // namespace Lantern
