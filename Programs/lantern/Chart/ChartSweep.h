// Measures the items of a chart, scene by scene, and keeps each as a part.
#pragma once

#include <chrono>
#include <map>
#include <string>
#include <vector>

#include "Chart/ChartCommand.h"
#include "LanternMeasure/Chart/ChartParts.h"
#include "LanternMeasure/Chart/ChartPlan.h"
#include "LanternMeasure/MeasureMethod.h"
#include "Progress.h"
#include "Session.h"

namespace Lantern
{

struct FChartSweepDesc
{
	std::vector<FPictureOptions> Pictures; ///< one for each scene, with its view
	FChartSettings Settings;
	FChartSelection Selection;
	FShard Shard;
	double BudgetSeconds = 0.0;  ///< from the start of the program; 0: none
	std::string PartsFolder;     ///< exists
	std::string ReferenceFolder; ///< empty: references are not kept
	std::string Program;         ///< see FChartKeyParts
	std::chrono::steady_clock::time_point Start;
};

/// The name of each scene in the chart: that of its file without ending, or that of a built-in scene. Scenes whose names would be equal are
/// called as they were given.
std::vector<std::string> NameScenes(const std::vector<FPictureOptions>& Pictures);

class FChartSweep
{
public:
	FChartSweep(FSession& Session, const FMethods& Methods, FChartSweepDesc Desc);
	/// Returns an exit status. Parts of items that were done stay, whatever comes after.
	int Run();
	/// Parts of all items of all scenes that exist, in this shard or in another.
	const std::vector<FChartPart>& GetParts() const { return Parts; }

private:
	/// One scene while it is loaded.
	struct FScene
	{
		size_t Index = 0;
		std::string Name;
		FMeasureViews Views;
		std::unique_ptr<FLightSwitch> Switch;
		std::vector<FPathScript> Paths, ShortPaths;               ///< by EMeasurePath; short: for methods without a history, in haste
		std::map<std::pair<size_t, size_t>, FMethodProbe> Probes; ///< by method and preset; only with a budget
		FChartKeyParts Key;
		uint64_t BaselineBytes = 0;
		std::map<ESignal, uint32_t> Samples; ///< number of samples of the references
		double Deadline = 0.0;               ///< seconds after Desc.Start; 0: none
		std::map<size_t, size_t> TooDear;    ///< by method: the first preset that did not fit
		std::map<std::pair<ESignal, EMeasurePath>, FPathReferences> References;
		std::map<ESignal, double> SampleSeconds; ///< of a reference, measured; only with a budget
	};

	int RunScene(size_t Index);
	int LoadScene(FScene& Scene, std::vector<FChartItem>& OutOwn);
	int Prepare(FScene& Scene, const std::vector<FChartItem>& Own);
	int ChooseReferenceSamples(FScene& Scene, const std::vector<FChartItem>& Own);
	FRTStatus MeasureSampleSeconds(FScene& Scene, ESignal Signal);
	int RunItem(FScene& Scene, const FChartItem& Item);
	int RunPoint(FScene& Scene, const FChartItem& Item);
	int RunFacts(FScene& Scene, const FChartItem& Item);
	/// Probes the method; only with a budget. OutObstacle is empty, or says why the item is not measured.
	FRTStatus FindDelay(FScene& Scene, const FChartItem& Item, std::string& OutObstacle);
	const FPathScript& GetPath(const FScene& Scene, const FChartItem& Item) const;
	/// Says why the item is not measured; empty if it is.
	std::string FindObstacle(FScene& Scene, const FChartItem& Item);
	FRTStatus GetReferences(FScene& Scene, const FChartItem& Item, FPathReferences*& Out);
	FPathReferenceSettings MakeReferenceSettings(const FScene& Scene, ESignal Signal) const;

	FChartPart MakePart(const FScene& Scene, const FChartItem& Item) const;
	nlohmann::json MakePoint(FScene& Scene, const FChartItem& Item, const FMethodFigures& Figures, FChartPart& Part);
	int Keep(const FScene& Scene, const FChartItem& Item, FChartPart Part);
	int Skip(const FScene& Scene, const FChartItem& Item, const std::string& Reason);
	void ShowProgress(const FScene& Scene, const std::string& What);
	/// Seconds left for the scene; infinite without a budget.
	double GetLeft(const FScene& Scene) const;
	double GetSeconds() const;

	FSession& Session;
	const FMethods& Methods;
	FChartSweepDesc Desc;
	std::vector<std::string> Names;
	std::vector<FChartItem> Items; // of a scene
	std::vector<FChartPart> Parts;
	FProgressLine Progress;
	double WorkDone = 0.0, WorkLeft = 0.0; // in units of a cheap preset, for the time left
	double FirstWork = -1.0;               // seconds at which work began
};

} // namespace Lantern
