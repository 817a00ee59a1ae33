// Measures the items of a chart within its budget.
#include "Chart/ChartSweep.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <set>

#include <fmt/format.h>

#include "LanternCore/Text/Log.h"
#include "LanternCore/Text/Quote.h"
#include "LanternHost/BuiltinScenes.h"
#include "LanternImage/AtomicFile.h"

namespace Lantern
{

namespace
{
constexpr uint32_t ShortWarmUp = 2;
constexpr double SceneTime = 1.0; // of the home view: paths begin before it

constexpr const char* NothingThere = "the scene has nothing for it, or the device cannot run it";

/// Presets double or quadruple from one to the next.
double GuessWork(const FChartItem& Item) { return Item.bFacts ? 2.0 : std::pow(2.0, double(std::min<size_t>(Item.Preset, 6))); }

/// An empty object where there is no such file.
nlohmann::json ReadSamples(const std::string& File)
{
	std::ifstream Stream(File);
	nlohmann::json Json = nlohmann::json::parse(Stream, nullptr, false);
	return Json.is_object() ? Json : nlohmann::json::object();
}

/// What a view may change beside the light.
std::string DescribeCamera(const FPictureOptions& Picture)
{
	if (!Picture.Camera) { return "own camera"; }
	const auto& [P, T, FovY] = *Picture.Camera;
	return fmt::format("camera {} {} {} {} {} {} {}", P.x, P.y, P.z, T.x, T.y, T.z, FovY);
}

FChartItem WithIndex(FChartItem Item, size_t Index)
{
	Item.Index = Index;
	return Item;
}
} // namespace

std::vector<std::string> NameScenes(const std::vector<FPictureOptions>& Pictures)
{
	const auto GetShort = [](const std::string& Scene) {
		return IsBuiltinScene(Scene) ? Scene : std::filesystem::path(Scene).stem().string();
	};
	std::vector<std::string> Out;
	for (const FPictureOptions& Picture : Pictures)
	{
		const auto IsSame = [&](const FPictureOptions& Other) { return GetShort(Other.Scene) == GetShort(Picture.Scene); };
		const bool bUnique = std::count_if(Pictures.begin(), Pictures.end(), IsSame) == 1;
		// Escaped: JSON and pages hold no broken UTF-8.
		Out.push_back(EscapeText(bUnique ? GetShort(Picture.Scene) : Picture.Scene));
	}
	return Out;
}

FChartSweep::FChartSweep(FSession& InSession, const FMethods& InMethods, FChartSweepDesc InDesc)
    : Session(InSession),
      Methods(InMethods),
      Desc(std::move(InDesc)),
      Names(NameScenes(Desc.Pictures)),
      Items(ListChartItems(Methods, Desc.Selection))
{
	for (size_t Scene = 0; Scene < Desc.Pictures.size(); ++Scene)
	{
		for (size_t I = 0; I < Items.size(); ++I) { WorkLeft += Desc.Shard.Has(Scene * Items.size() + I) ? GuessWork(Items[I]) : 0.0; }
	}
}

double FChartSweep::GetSeconds() const { return std::chrono::duration<double>(std::chrono::steady_clock::now() - Desc.Start).count(); }

double FChartSweep::GetLeft(const FScene& Scene) const
{
	return Scene.Deadline > 0.0 ? Scene.Deadline - GetSeconds() : std::numeric_limits<double>::infinity();
}

void FChartSweep::ShowProgress(const FScene& Scene, const std::string& What)
{
	if (FirstWork < 0.0) { FirstWork = GetSeconds(); }
	std::string Left;
	if (WorkDone > 0.0)
	{
		double Seconds = (GetSeconds() - FirstWork) / WorkDone * WorkLeft;
		if (Desc.BudgetSeconds > 0.0) { Seconds = std::min(Seconds, std::max(0.0, Desc.BudgetSeconds - GetSeconds())); }
		Left = ", " + FormatSeconds(Seconds) + " left";
	}
	Progress.Show("chart", WorkDone / std::max(1e-9, WorkDone + WorkLeft), Scene.Name + ": " + What + Left);
}

int FChartSweep::Run()
{
	for (size_t Scene = 0; Scene < Desc.Pictures.size(); ++Scene)
	{
		if (const int Status = RunScene(Scene); Status != ExitDone)
		{
			Progress.Clear();
			return Status;
		}
	}
	Progress.Clear();
	return ExitDone;
}

int FChartSweep::RunScene(size_t Index)
{
	FScene Scene;
	Scene.Index = Index;
	Scene.Name = Names[Index];
	if (Desc.BudgetSeconds > 0.0)
	{
		const double Now = GetSeconds();
		Scene.Deadline = Now + (Desc.BudgetSeconds - Now) / double(Desc.Pictures.size() - Index);
	}
	std::vector<FChartItem> Own;
	if (const int Status = LoadScene(Scene, Own); Status != ExitDone) { return Status; }
	if (Own.empty()) { return ExitDone; }
	if (const int Status = Prepare(Scene, Own); Status != ExitDone) { return Status; }
	if (Scene.Deadline > 0.0) { SortByPrice(Own); }
	for (const FChartItem& Item : Own)
	{
		if (const int Status = RunItem(Scene, Item); Status != ExitDone) { return Status; }
		WorkDone += GuessWork(Item);
		WorkLeft -= GuessWork(Item);
	}
	return ExitDone;
}

int FChartSweep::LoadScene(FScene& Scene, std::vector<FChartItem>& OutOwn)
{
	const FPictureOptions& Picture = Desc.Pictures[Scene.Index];
	if (const int Status = Session.LoadScene(Picture); Status != ExitDone) { return Status; }
	FHostScene& Host = Session.GetEngine().GetScene();
	const FRTCapabilities& Device = Session.GetDevice().GetCapabilities();
	const FSunLight& Sun = Host.GetScene().GetSun();
	const glm::vec3 Sky = Host.GetScene().GetSky();
	Scene.Key = {Desc.Program, Device.DeviceName, Device.DriverName,
	    fmt::format("{} sun {} {} {} {} {} sky {} {} {} scene lights {} {}", Host.GetContentHash().ToHex(), Sun.Irradiance, Sun.Direction.x,
	        Sun.Direction.y, Sun.Direction.z, Sun.AngularDiameter, Sky.x, Sky.y, Sky.z, !Picture.bNoSceneLights, DescribeCamera(Picture)),
	    Desc.Settings};
	for (size_t I = 0; I < Items.size(); ++I)
	{
		const FChartItem Item = WithIndex(Items[I], Scene.Index * Items.size() + I);
		FChartPart Part = ReadPart(Desc.PartsFolder, MakeChartKey(Scene.Key, Methods, Item));
		// What a budget left out has another chance, if this shard is to do it.
		const bool bOwn = Desc.Shard.Has(Item.Index), bAgain = Part.is_null() || Part.contains("skipped");
		if (bOwn && bAgain) { OutOwn.push_back(Item); }
		else if (bOwn) { WorkLeft -= GuessWork(Item); }
		if (!Part.is_null() && !(bOwn && bAgain)) { Parts.push_back(std::move(Part)); }
	}
	const FScenePose Pose = EvaluatePose(Host.GetDescription(), SceneTime);
	Scene.Views = FindMeasureViews(Host.GetDescription(), Pose, Session.MakeView(Picture));
	return ExitDone;
}

int FChartSweep::Prepare(FScene& Scene, const std::vector<FChartItem>& Own)
{
	FSampleEngine& Engine = Session.GetEngine();
	ShowProgress(Scene, "first frames");
	if (FRTStatus S = MeasureBaseline(Engine, Methods, Scene.Views.Home, SceneTime, Scene.BaselineBytes); !S)
	{
		return ReportStatus(S, Scene.Name.c_str());
	}
	Scene.Switch = std::make_unique<FLightSwitch>(Engine.GetScene());
	FPathSettings Settings;
	Settings.Time = SceneTime;
	Settings.WarmUp = Desc.Settings.WarmUp;
	Settings.Frames = Desc.Settings.Frames;
	// Not below zero for the longest script, of however many frames.
	Settings.Time = std::max(SceneTime, double(Settings.WarmUp + Settings.Frames) * Settings.DeltaSeconds);
	FPathSettings Short = Settings;
	Short.WarmUp = std::min(Settings.WarmUp, ShortWarmUp);
	for (size_t P = 0; P < static_cast<size_t>(EMeasurePath::Count); ++P)
	{
		Scene.Paths.push_back(MakePathScript(static_cast<EMeasurePath>(P), Scene.Views, Settings, Scene.Switch.get()));
		Scene.ShortPaths.push_back(MakePathScript(static_cast<EMeasurePath>(P), Scene.Views, Short, Scene.Switch.get()));
	}
	for (const FChartItem& Item : Own)
	{
		if (!Item.bFacts) { Scene.Samples[Methods.Methods[Item.Method].Signal] = Desc.Settings.ReferenceSamples; }
	}
	return Scene.Deadline > 0.0 ? ChooseReferenceSamples(Scene, Own) : ExitDone;
}

FRTStatus FChartSweep::MeasureSampleSeconds(FScene& Scene, ESignal Signal)
{
	FSignalReferenceDesc Reference;
	Reference.View = Scene.Views.Home;
	Reference.Time = SceneTime;
	Reference.Signal = Signal;
	Reference.Samples = 2;
	FSignalReference Out;
	// The first compiles.
	for (size_t I = 0; I < 2; ++I)
	{
		const double Before = GetSeconds();
		if (FRTStatus S = GetSignalReference(Session.GetEngine(), Reference, Out); !S) { return S; }
		Scene.SampleSeconds[Signal] = (GetSeconds() - Before) / 2.0;
	}
	return FRTStatus::Success();
}

int FChartSweep::ChooseReferenceSamples(FScene& Scene, const std::vector<FChartItem>& Own)
{
	constexpr double ReferencePart = 0.35; // of the scene's time, the same for each signal
	std::map<ESignal, std::set<EMeasurePath>> Wanted;
	for (const FChartItem& Item : Own)
	{
		if (!Item.bFacts) { Wanted[Methods.Methods[Item.Method].Signal].insert(Item.Path); }
	}
	const double Budget = ReferencePart * GetLeft(Scene) / double(std::max<size_t>(1, Wanted.size()));
	for (const auto& [Signal, Paths] : Wanted)
	{
		ShowProgress(Scene, fmt::format("how long references of {} take", GetSignalInfo(Signal).Title));
		if (FRTStatus S = MeasureSampleSeconds(Scene, Signal); !S) { return ReportStatus(S, Scene.Name.c_str()); }
		// Each path has one more, with a quarter of the samples.
		Scene.Samples[Signal] =
		    ChooseSamples(Scene.SampleSeconds[Signal] * (1.0 + 0.25 * double(Paths.size())), Budget, Desc.Settings.ReferenceSamples);
	}
	// A sweep that is taken up again, or another shard in this folder, goes on with what was chosen first.
	const std::string File = Desc.PartsFolder + "/samples-" + MakeChartKey(Scene.Key, Methods, {.bFacts = true}) + ".json";
	nlohmann::json Chosen = ReadSamples(File);
	std::string Text;
	for (auto& [Signal, Samples] : Scene.Samples)
	{
		const char* const Name = GetSignalInfo(Signal).Name;
		const auto Before = Chosen.find(Name);
		const bool bUsable =
		    Before != Chosen.end() && Before->is_number_unsigned() && *Before >= 2u && *Before <= Desc.Settings.ReferenceSamples;
		if (bUsable) { Samples = Before->get<uint32_t>(); }
		Chosen[Name] = Samples;
		Text += fmt::format("{}{} {}", Text.empty() ? "" : ", ", GetSignalInfo(Signal).Title, Samples);
	}
	if (FRTStatus S = WriteFileAtomically(File, Chosen.dump() + "\n"); !S) { return ReportStatus(S, "-o"), ExitBadInput; }
	Progress.Clear();
	LogInfo("{}: samples of references within the budget: {}", Scene.Name, Text);
	return ExitDone;
}

std::string FChartSweep::FindObstacle(FScene& Scene, const FChartItem& Item)
{
	const FMethod& Method = Methods.Methods[Item.Method];
	if (std::string Missing = GetMissing(Method, Session.GetDevice().GetCapabilities()); !Missing.empty()) { return Missing; }
	if (GetSignalInfo(Method.Signal).bNeedsSun && !Session.GetEngine().GetScene().GetScene().GetFacts().bSun)
	{
		return "the scene has no sun";
	}
	if (const auto Dear = Scene.TooDear.find(Item.Method); Dear != Scene.TooDear.end() && Item.Preset >= Dear->second)
	{
		return "no time left within the budget: this preset or a cheaper one did not fit";
	}
	if (GetLeft(Scene) <= 0.0) { return "no time left within the budget"; }
	return {};
}

const FPathScript& FChartSweep::GetPath(const FScene& Scene, const FChartItem& Item) const
{
	const auto Probe = Scene.Probes.find({Item.Method, Item.Preset});
	const bool bShort = Probe != Scene.Probes.end() && !Probe->second.bHistory;
	return (bShort ? Scene.ShortPaths : Scene.Paths)[static_cast<size_t>(Item.Path)];
}

FRTStatus FChartSweep::FindDelay(FScene& Scene, const FChartItem& Item, std::string& OutObstacle)
{
	const FMethod& Method = Methods.Methods[Item.Method];
	const auto [Probe, bNew] = Scene.Probes.try_emplace({Item.Method, Item.Preset});
	if (bNew)
	{
		const FMethodPreset& Preset = Method.Presets[Item.Preset];
		ShowProgress(Scene, fmt::format("first frames of {}, {}", Method.Title, Preset.Name));
		if (FRTStatus S = ProbeMethod(Session.GetEngine(), Methods, Method, Preset, Scene.Views.Home, SceneTime, Probe->second); !S)
		{
			return S;
		}
	}
	if (!Probe->second.bSignal)
	{
		OutObstacle = NothingThere;
		return FRTStatus::Success();
	}
	double Seconds = Probe->second.FrameSeconds * CountPathFrames(GetPath(Scene, Item));
	// A quarter of what is left at most: others want to be measured too.
	if (Seconds > GetLeft(Scene) / 4.0)
	{
		Scene.TooDear.emplace(Item.Method, Item.Preset);
		OutObstacle = fmt::format("would take about {}, too much of the budget", FormatSeconds(Seconds));
		return FRTStatus::Success();
	}
	if (Scene.References.contains({Method.Signal, Item.Path})) { return FRTStatus::Success(); }
	bool bHome = false;
	for (const auto& [Key, References] : Scene.References) { bHome |= Key.first == Method.Signal; }
	Seconds = Scene.SampleSeconds[Method.Signal] * Scene.Samples[Method.Signal] * (bHome ? 0.25 : 1.25);
	if (Seconds > GetLeft(Scene) / 2.0)
	{
		OutObstacle = fmt::format("no time left within the budget: its reference takes about {}", FormatSeconds(Seconds));
	}
	return FRTStatus::Success();
}

FPathReferenceSettings FChartSweep::MakeReferenceSettings(const FScene& Scene, ESignal Signal) const
{
	FPathReferenceSettings Out;
	Out.Signal = Signal;
	Out.Samples = Scene.Samples.at(Signal);
	Out.OtherSamples = std::max(2u, Out.Samples / 4);
	Out.Seed = Desc.Settings.Seed;
	Out.CacheFolder = Desc.ReferenceFolder;
	return Out;
}

FRTStatus FChartSweep::GetReferences(FScene& Scene, const FChartItem& Item, FPathReferences*& Out)
{
	constexpr uint64_t SmallPixels = 640 * 360;
	const ESignal Signal = Methods.Methods[Item.Method].Signal;
	const auto Key = std::pair(Signal, Item.Path);
	if (!Scene.References.contains(Key))
	{
		// Large ones come from the disk again.
		if (uint64_t(Desc.Settings.Width) * Desc.Settings.Height > SmallPixels) { Scene.References.clear(); }
		FPathReferences References;
		for (const auto& [Other, There] : Scene.References)
		{
			if (Other.first == Signal) { References.Home = There.Home; }
		}
		FPathReferenceSettings Settings = MakeReferenceSettings(Scene, Signal);
		Settings.Progress = [&](double Done, double) {
			ShowProgress(
			    Scene, fmt::format("reference of {}, {}, {:.0f} %", GetSignalInfo(Signal).Title, GetPathName(Item.Path), 100.0 * Done));
		};
		const FPathScript& Path = Scene.Paths[static_cast<size_t>(Item.Path)];
		if (FRTStatus S = GetPathReferences(Session.GetEngine(), Path, Settings, *Scene.Switch, References); !S) { return S; }
		Scene.References.emplace(Key, std::move(References));
	}
	Out = &Scene.References.at(Key);
	return FRTStatus::Success();
}

int FChartSweep::RunItem(FScene& Scene, const FChartItem& Item) { return Item.bFacts ? RunFacts(Scene, Item) : RunPoint(Scene, Item); }

int FChartSweep::RunPoint(FScene& Scene, const FChartItem& Item)
{
	const FMethod& Method = Methods.Methods[Item.Method];
	const FMethodPreset& Preset = Method.Presets[Item.Preset];
	if (const std::string Obstacle = FindObstacle(Scene, Item); !Obstacle.empty()) { return Skip(Scene, Item, Obstacle); }
	if (Scene.Deadline > 0.0)
	{
		std::string Delay;
		if (FRTStatus S = FindDelay(Scene, Item, Delay); !S) { return ReportStatus(S, Scene.Name.c_str()); }
		if (!Delay.empty()) { return Skip(Scene, Item, Delay); }
	}
	FPathReferences* References = nullptr;
	if (FRTStatus S = GetReferences(Scene, Item, References); !S) { return ReportStatus(S, Scene.Name.c_str()); }
	ShowProgress(Scene, fmt::format("{}, {}, {}", Method.Title, Preset.Name, GetPathName(Item.Path)));
	FMeasureSettings Settings;
	Settings.BaselineBytes = Scene.BaselineBytes;
	if (Scene.Deadline > 0.0) { Settings.MaxSeconds = std::max(0.01, GetLeft(Scene)); }
	FMeasureResult Result;
	if (FRTStatus S =
	        MeasureMethod(Session.GetEngine(), Methods, Method, Preset, GetPath(Scene, Item), *References, *Scene.Switch, Settings, Result);
	    !S)
	{
		return ReportStatus(S, fmt::format("{}: {}, {}", Scene.Name, Method.Title, Preset.Name).c_str());
	}
	switch (Result.End)
	{
	case EMeasureEnd::Refused: LogError("{}", Result.Reason); return ExitBadInput;
	case EMeasureEnd::NoSignal: return Skip(Scene, Item, NothingThere);
	case EMeasureEnd::TooLong:
		Scene.TooDear.emplace(Item.Method, Item.Preset);
		return Skip(Scene, Item, fmt::format("would take about {}, too much of the budget", FormatSeconds(Result.Figures.Seconds)));
	case EMeasureEnd::Done: break;
	}
	FChartPart Part = MakePart(Scene, Item);
	Part["point"] = MakePoint(Scene, Item, Result.Figures, Part);
	return Keep(Scene, Item, std::move(Part));
}

int FChartSweep::RunFacts(FScene& Scene, const FChartItem& Item)
{
	constexpr double FactsPart = 0.15;   // of the scene's time
	constexpr double MostSeconds = 60.0; // without a budget
	ShowProgress(Scene, "what facts of the scene cost");
	FFactSettings Settings;
	Settings.View = Scene.Views.Home;
	Settings.Time = SceneTime;
	Settings.MaxSeconds = MostSeconds;
	if (Scene.Deadline > 0.0)
	{
		Settings.MaxSeconds = std::max(0.01, FactsPart * GetLeft(Scene));
		Settings.Rounds = 2;
		Settings.WarmUp = 1;
		Settings.FramesPerRound = 4;
	}
	FChartPart Part = MakePart(Scene, Item);
	Part["facts"] = nlohmann::json::array();
	// The fullest frame that there is time for.
	for (size_t M = Methods.Methods.size(); M-- > 0;)
	{
		const FMethod& Method = Methods.Methods[M];
		if (Method.Signal != ESignal::Frame || !GetMissing(Method, Session.GetDevice().GetCapabilities()).empty()) { continue; }
		std::vector<FFactCost> Costs;
		EMeasureEnd End = EMeasureEnd::Done;
		if (FRTStatus S = MeasureFacts(Session.GetEngine(), Methods, &Method, &Method.GetTypical(), Settings, Costs, End); !S)
		{
			return ReportStatus(S, Scene.Name.c_str());
		}
		if (End != EMeasureEnd::Done) { continue; }
		for (const FFactCost& Cost : Costs)
		{
			Part["facts"].push_back({{"fact", Cost.Fact}, {"frame_gpu_ms", Cost.FrameGpuMs}, {"without_gpu_ms", Cost.WithoutGpuMs},
			    {"method", Method.Title}, {"preset", Method.GetTypical().Name}});
		}
		break;
	}
	return Keep(Scene, Item, std::move(Part));
}

} // namespace Lantern
