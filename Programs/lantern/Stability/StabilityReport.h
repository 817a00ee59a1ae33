// The output of `lantern stability`: rows of a table, JSON, strips, and the list of known shortfalls.
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
	bool bBroken = false;                       ///< there should be a figure
	std::optional<double> Figure, Worst, Limit; ///< median and worst over the seeds
	bool bFloor = false;
	std::optional<bool> Holds;
	std::string Fault;
	std::optional<double> FaultFigure;
	std::optional<bool> FaultFails;
	uint32_t Seeds = 0;
	bool bKnown = false; ///< a known shortfall
	/// Whether a build must not pass with it, known shortfalls aside.
	bool IsBad() const { return bBroken || (Holds && !*Holds) || (FaultFails && !*FaultFails); }
};

/// Known shortfalls: lines "case | method | part | reason"; # begins a comment. A ~ before the number of the case means that the figure is
/// near its limit and chance decides: it may fail, and need not.
class FKnownShortfalls
{
public:
	/// Errors name file and line.
	FRTStatus Load(const std::string& Path);
	bool Has(const FStabilityRow& Row) const;
	/// Lists what is bad: rows that fail and are not known, and known ones that hold again. Cases that did not run are left out.
	std::vector<std::string> Check(const std::vector<FStabilityRow>& Rows) const;

private:
	std::map<std::tuple<int, std::string, std::string>, bool> Known; // whether it must fail
};

void PrintStabilityHeader();
void PrintStabilityRow(const FStabilityRow& Row);
nlohmann::json MakeStabilityJson(const std::vector<FStabilityRow>& Rows);
/// Saves frames in a row, with what they should be below them. Radiance is tone-mapped.
FRTStatus SaveStrip(
    const std::string& Path, const std::vector<std::pair<FImage, FImage>>& Strip, const FSignalInfo& Signal, float Exposure);

} // namespace Lantern
