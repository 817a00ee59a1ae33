// lantern stability: runs cases, plants their faults and judges the rows.
#include "Stability/StabilityCommand.h"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "JsonFile.h"
#include "LanternCore/Text/Log.h"
#include "LanternCore/Text/Quote.h"
#include "Progress.h"
#include "Session.h"
#include "Stability/StabilityReport.h"

namespace Lantern
{

void FStabilityOptions::AddTo(CLI::App& App)
{
	Device.AddTo(App);
	App.add_option("--case", Cases, "Number of a case; repeatable")
	    ->expected(1)
	    ->take_all()
	    ->allow_extra_args(false)
	    ->check([](const std::string& Text) {
		    const auto Number = ParseNumbers(Text, 1);
		    const auto All = GetStabilityCases();
		    const bool bKnown =
		        Number && std::any_of(All.begin(), All.end(), [&](const FStabilityCase& Case) { return Case.Number == (*Number)[0]; });
		    return bKnown ? std::string() : Quote(Text) + " is not the number of a case; --list names them";
	    });
	App.add_option("--method", Methods, "Name or title of a method of Config/Methods.ini; repeatable")
	    ->expected(1)
	    ->take_all()
	    ->allow_extra_args(false);
	App.add_option("--seeds", Seeds, "Runs of each case with other random numbers: 5, or 2 with --quick")->check(CLI::Range(1, 1000));
	App.add_option("--spp", Samples, "Samples of references: 4096, or 256 with --quick")->check(CLI::Range(2, 1 << 24));
	App.add_flag("--quick", bQuick, "Fewer seeds and samples");
	App.add_flag("--strips", bAllStrips, "With -o: pictures of what holds too");
	App.add_flag("--list", bList, "List the cases");
	App.add_option("-o,--output", Output, "Folder for strips of what fails: frames, and what they should be below them");
	App.add_option("--json", Json, "Write the figures to this file");
	App.add_option("--known", Known, "File of known shortfalls: they may fail, and must, with the figures that it states");
}

namespace
{
bool Measures(const FStabilityCase& Case, const FMethod& Method)
{
	return Case.Measure && std::find(Case.Signals.begin(), Case.Signals.end(), Method.Signal) != Case.Signals.end();
}

bool IsCaseWanted(const FStabilityCase& Case, const FStabilityOptions& Options)
{
	return Options.Cases.empty() || std::count(Options.Cases.begin(), Options.Cases.end(), Case.Number) > 0;
}

/// Runs cases for methods, and keeps their rows.
class FStabilityRun
{
public:
	FStabilityRun(FSession& InSession, const FStabilityOptions& InOptions, FStabilitySettings Settings, const FMethods& InMethods,
	    const FKnownShortfalls& InKnown)
	    : Session(InSession),
	      Options(InOptions),
	      Methods(InMethods),
	      Known(InKnown),
	      Stage(InSession.GetEngine(), std::move(Settings)),
	      Seeds(InOptions.Seeds    ? InOptions.Seeds
	            : InOptions.bQuick ? 2
	                               : 5)
	{}
	FRTStatus Run();
	std::vector<FStabilityRow>& GetRows() { return Rows; }

private:
	bool IsWanted(const FMethod& Method) const;
	FRTStatus RunCase(const FStabilityCase& Case);
	FRTStatus RunMethod(const FStabilityCase& Case, const FMethod* Method);
	FRTStatus MeasureSeeds(const FStabilityCase& Case, const FMethod* Method, std::vector<std::vector<FStabilityFigure>>& Out);
	void AddFigures(const FStabilityCase& Case, FStabilityRow Row, const std::vector<std::vector<FStabilityFigure>>& Runs,
	    const FStabilityFault& Fault, const std::vector<FStabilityFigure>& Broken);
	FRTStatus KeepStrip(const FStabilityCase& Case, const FStabilityRow& Row, ESignal Signal, size_t FirstRow);
	void Add(FStabilityRow Row);

	FSession& Session;
	const FStabilityOptions& Options;
	const FMethods& Methods;
	const FKnownShortfalls& Known;
	FStabilityStage Stage;
	uint32_t Seeds;
	std::vector<FStabilityRow> Rows;
	std::vector<std::pair<FImage, FImage>> Strip;
	FProgressLine Progress;
	double Fraction = 0.0;
};

bool FStabilityRun::IsWanted(const FMethod& Method) const
{
	if (Options.Methods.empty()) { return true; }
	return std::any_of(
	    Options.Methods.begin(), Options.Methods.end(), [&](const std::string& Name) { return Methods.Find(Name) == &Method; });
}

void FStabilityRun::Add(FStabilityRow Row)
{
	Progress.Clear();
	Row.bKnown = Known.Has(Row);
	PrintStabilityRow(Row);
	Rows.push_back(std::move(Row));
}

FRTStatus FStabilityRun::Run()
{
	PrintStabilityHeader();
	std::vector<const FStabilityCase*> Wanted;
	for (const FStabilityCase& Case : GetStabilityCases())
	{
		if (IsCaseWanted(Case, Options)) { Wanted.push_back(&Case); }
	}
	for (size_t I = 0; I < Wanted.size(); ++I)
	{
		Fraction = double(I) / double(Wanted.size());
		if (FRTStatus S = RunCase(*Wanted[I]); !S) { return S; }
	}
	return FRTStatus::Success();
}

FRTStatus FStabilityRun::RunCase(const FStabilityCase& Case)
{
	if (Case.bNoMethod) { return Options.Methods.empty() ? RunMethod(Case, nullptr) : FRTStatus::Success(); }
	bool bAny = false;
	for (const FMethod& Method : Methods.Methods)
	{
		if (!Measures(Case, Method)) { continue; }
		bAny = true;
		if (!IsWanted(Method)) { continue; }
		if (FRTStatus S = RunMethod(Case, &Method); !S) { return S; }
	}
	if (bAny) { return FRTStatus::Success(); }
	FStabilityRow Row;
	Row.Number = Case.Number;
	Row.Name = Case.Name;
	Row.Status = "no method yet";
	Add(std::move(Row));
	return FRTStatus::Success();
}

FRTStatus FStabilityRun::MeasureSeeds(const FStabilityCase& Case, const FMethod* Method, std::vector<std::vector<FStabilityFigure>>& Out)
{
	for (uint32_t Seed = 0; Seed < (Method ? Seeds : 1); ++Seed)
	{
		Progress.Show(fmt::format("{} {}", Case.Number, Case.Name), Fraction,
		    fmt::format("{}, seed {} of {}", Method ? Method->Title : "", Seed + 1, Seeds));
		Stage.Begin(Method ? Method->Signal : ESignal::Frame, Seed + 1, nullptr);
		if (FRTStatus S = Case.Measure(Stage, Out.emplace_back()); !S) { return S; }
	}
	Strip = Stage.GetStrip();
	return FRTStatus::Success();
}

FRTStatus FStabilityRun::RunMethod(const FStabilityCase& Case, const FMethod* Method)
{
	FStabilityRow Row;
	Row.Number = Case.Number;
	Row.Name = Case.Name;
	Row.Seeds = Method ? Seeds : 1;
	FMethodScope Scope;
	std::vector<std::string> Refused;
	if (Method)
	{
		Row.Method = Method->Title;
		Row.Preset = Method->GetTypical().Name;
		Row.Signal = GetSignalInfo(Method->Signal).Name;
		Row.Status = GetMissing(*Method, Session.GetDevice().GetCapabilities());
		if (!Row.Status.empty())
		{
			Add(std::move(Row));
			return FRTStatus::Success();
		}
		Refused = Scope.Apply(Methods, Method, &Method->GetTypical());
	}
	std::vector<std::vector<FStabilityFigure>> Runs;
	std::vector<FStabilityFigure> Broken;
	FRTStatus Status =
	    Refused.empty() ? MeasureSeeds(Case, Method, Runs) : FRTStatus::Error(ERTResult::InvalidArgument, "%s", Refused[0].c_str());
	FStabilityFault Fault;
	const auto HasLimit = [](const FStabilityFigure& Figure) { return Figure.Limit.has_value(); };
	if (Status && std::any_of(Runs[0].begin(), Runs[0].end(), HasLimit))
	{
		Fault = Case.MakeFault && Method ? Case.MakeFault(*Method) : FStabilityFault{Case.FaultText, {}};
		Stage.Begin(Method ? Method->Signal : ESignal::Frame, 1, &Fault);
		Status = Case.Measure(Stage, Broken);
	}
	if (!Status)
	{
		// A device that is lost, or has no memory left, is the end of all; else the others may still run.
		if (Status.Code == ERTResult::DeviceLost || Status.Code == ERTResult::OutOfDeviceMemory) { return Status; }
		Row.Status = Status.Message;
		Row.bBroken = true;
		Add(std::move(Row));
		return FRTStatus::Success();
	}
	const size_t FirstRow = Rows.size();
	AddFigures(Case, Row, Runs, Fault, Broken);
	return KeepStrip(Case, Row, Method ? Method->Signal : ESignal::Frame, FirstRow);
}

void FStabilityRun::AddFigures(const FStabilityCase&, FStabilityRow Row, const std::vector<std::vector<FStabilityFigure>>& Runs,
    const FStabilityFault& Fault, const std::vector<FStabilityFigure>& Broken)
{
	for (size_t Part = 0; Part < Runs[0].size(); ++Part)
	{
		const FStabilityFigure& First = Runs[0][Part];
		FStabilityRow Out = Row;
		Out.Part = First.Part;
		Out.Limit = First.Limit;
		Out.bFloor = First.bFloor;
		// The better ones first, and what is not a number last.
		std::vector<double> Values;
		for (const auto& Run : Runs) { Values.push_back(Run[Part].Value); }
		std::sort(Values.begin(), Values.end(), [&](double A, double B) {
			if (std::isnan(A) || std::isnan(B)) { return !std::isnan(A); }
			return First.bFloor ? A > B : A < B;
		});
		Out.Figure = Values[Values.size() / 2];
		Out.Worst = Values.back();
		if (First.Limit) { Out.Holds = FStabilityFigure{"", *Out.Figure, First.Limit, First.bFloor}.Holds(); }
		if (Part < Broken.size() && First.Limit && Broken[Part].Limit)
		{
			Out.Fault = Fault.Text;
			Out.FaultFigure = Broken[Part].Value;
			Out.FaultFails = !Broken[Part].Holds();
		}
		Add(std::move(Out));
	}
}

FRTStatus FStabilityRun::KeepStrip(const FStabilityCase& Case, const FStabilityRow& Row, ESignal Signal, size_t FirstRow)
{
	const bool bBad =
	    std::any_of(Rows.begin() + static_cast<ptrdiff_t>(FirstRow), Rows.end(), [](const FStabilityRow& R) { return R.IsBad(); });
	if (Options.Output.empty() || Strip.empty() || !(bBad || Options.bAllStrips)) { return FRTStatus::Success(); }
	std::string Name = fmt::format("{:02}-{}", Case.Number, Row.Method.empty() ? Case.Name : Row.Method);
	for (char& C : Name)
	{
		if (!std::isalnum(static_cast<unsigned char>(C))) { C = '-'; }
	}
	return SaveStrip(Options.Output + "/" + Name + ".png", Strip, GetSignalInfo(Signal), Stage.GetExposure());
}

int CheckOutputs(const FStabilityOptions& Options)
{
	if (const int Status = CheckJsonFile(Options.Json); Status != ExitDone) { return Status; }
	if (Options.Output.empty()) { return ExitDone; }
	std::error_code Error;
	std::filesystem::create_directories(Options.Output, Error);
	if (std::filesystem::is_directory(Options.Output, Error)) { return ExitDone; }
	LogError("-o {}: cannot be made a folder", EscapePath(Options.Output));
	return ExitBadInput;
}

int ListCases()
{
	for (const FStabilityCase& Case : GetStabilityCases())
	{
		std::string Signals = Case.bNoMethod ? "the plugin" : Case.Measure ? "" : "no method yet";
		for (const ESignal Signal : Case.Signals) { Signals += (Signals.empty() ? "" : ", ") + std::string(GetSignalInfo(Signal).Name); }
		fmt::print("{:>2} {:<26} {}\n", Case.Number, Case.Name, Signals);
	}
	return ExitDone;
}

/// Config/Methods.ini, and whether --method names are in it and measured by a case: what nothing measures would seem to hold.
int LoadWantedMethods(const FStabilityOptions& Options, FMethods& Out)
{
	Out = LoadMethods(FindPluginFolders().Config + "/Methods.ini");
	for (const std::string& Problem : Out.Problems) { LogError("{}", Problem); }
	for (const std::string& Name : Options.Methods)
	{
		const FMethod* const Found = Out.Find(Name);
		const bool bMeasured = Found && std::ranges::any_of(GetStabilityCases(), [&](const FStabilityCase& Case) {
			return IsCaseWanted(Case, Options) && Measures(Case, *Found);
		});
		if (bMeasured) { continue; }
		if (Found)
		{
			LogError("--method {}: no case that is run measures it", EscapeText(Name, MaxQuotedBytes));
			return ExitUsage;
		}
		std::string Names;
		for (const FMethod& Method : Out.Methods) { Names += (Names.empty() ? "" : ", ") + Method.Name; }
		LogError("--method {}: there is none of that name; there are {}", EscapeText(Name, MaxQuotedBytes), Names);
		return ExitUsage;
	}
	return ExitDone;
}

nlohmann::json MakeJson(
    FSession& Session, const FStabilityOptions& Options, const FStabilitySettings& Settings, const std::vector<FStabilityRow>& Rows)
{
	const FRTCapabilities& Capabilities = Session.GetDevice().GetCapabilities();
	return {{"device", Capabilities.DeviceName}, {"driver", Capabilities.DriverName}, {"width", Settings.Width},
	    {"height", Settings.Height}, {"quick", Options.bQuick}, {"reference_spp", Settings.ReferenceSamples},
	    {"cases", MakeStabilityJson(Rows)}};
}

int RunInSession(FSession& Session, const FStabilityOptions& Options, const FKnownShortfalls& Known, const FMethods& Methods)
{
	FStabilitySettings Settings;
	Settings.bQuick = Options.bQuick;
	Settings.ReferenceSamples = Options.Samples ? Options.Samples : Options.bQuick ? 256 : 4096;
	const std::string Cache = FindPluginFolders().Cache;
	Settings.CacheFolder = Cache.empty() ? "" : Cache + "/references";
	FStabilityRun Run(Session, Options, Settings, Methods, Known);
	if (FRTStatus S = Run.Run(); !S) { return ReportStatus(S, "stability"); }
	const std::vector<std::string> Bad = Known.Check(Run.GetRows());
	for (const std::string& Line : Bad) { fmt::print("{}\n", Line); }
	fmt::print("{} figures, {} bad\n", Run.GetRows().size(), Bad.size());
	const std::string Text = MakeJson(Session, Options, Settings, Run.GetRows()).dump(2) + "\n";
	if (const int Status = WriteJsonFile(Options.Json, Text); Status != ExitDone) { return Status; }
	if (!Methods.Problems.empty()) { return ExitBadInput; }
	return Bad.empty() ? ExitDone : ExitCheckFailed;
}
} // namespace

int RunStability(const FStabilityOptions& Options)
{
	if (Options.bList) { return ListCases(); }
	if (const int Status = CheckOutputs(Options); Status != ExitDone) { return Status; }
	FKnownShortfalls Known;
	if (!Options.Known.empty())
	{
		if (FRTStatus S = Known.Load(Options.Known); !S) { return ReportStatus(S, "--known"), ExitBadInput; }
	}
	FSession Session;
	if (const int Status = Session.OpenDevice(Options.Device); Status != ExitDone) { return Session.Close(Status); }
	FMethods Methods;
	if (const int Status = LoadWantedMethods(Options, Methods); Status != ExitDone) { return Session.Close(Status); }
	return Session.Close(RunInSession(Session, Options, Known, Methods));
}

} // namespace Lantern
