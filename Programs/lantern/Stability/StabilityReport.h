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

/// Known shortfalls: lines "case | method | part | figure +- band | reason"; # begins a comment. The figure must miss its limit, and lie
/// within the band: a change for the better fails as one for the worse does.
class FKnownShortfalls
{
public:
	/// Errors name file and line.
	FRTStatus Load(const std::string& Path);
	bool Has(const FStabilityRow& Row) const;
	/// Lists what is bad: rows that fail and are not known, known ones that hold again, and known ones with another figure. Cases that
	/// did not run are left out.
	std::vector<std::string> Check(const std::vector<FStabilityRow>& Rows) const;

private:
	struct FBand
	{
		double Figure = 0.0, Width = 0.0;
	};
	std::map<std::tuple<int, std::string, std::string>, FBand> Known;
};

void PrintStabilityHeader();
void PrintStabilityRow(const FStabilityRow& Row);
nlohmann::json MakeStabilityJson(const std::vector<FStabilityRow>& Rows);
/// Saves frames in a row, with what they should be below them. Radiance is tone-mapped.
FRTStatus SaveStrip(
    const std::string& Path, const std::vector<std::pair<FImage, FImage>>& Strip, const FSignalInfo& Signal, float Exposure);

} // namespace Lantern
