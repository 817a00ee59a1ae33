// Reads Config/Methods.ini, and applies a method to the console variables.
#include "LanternMeasure/Methods.h"

#include <algorithm>
#include <cctype>
#include <optional>

#include <fmt/format.h>

#include "LanternCore/Config/IniFile.h"
#include "LanternCore/Text/Quote.h"

namespace Lantern
{

namespace
{
bool EqualsIgnoringCase(std::string_view A, std::string_view B)
{
	return std::equal(
	    A.begin(), A.end(), B.begin(), B.end(), [](unsigned char X, unsigned char Y) { return std::tolower(X) == std::tolower(Y); });
}

bool StartsIgnoringCase(std::string_view Text, std::string_view Start)
{
	return Text.size() >= Start.size() && EqualsIgnoringCase(Text.substr(0, Start.size()), Start);
}

std::string_view Trim(std::string_view Text)
{
	constexpr const char* Blanks = " \t\r";
	const size_t First = Text.find_first_not_of(Blanks);
	return First == std::string_view::npos ? std::string_view() : Text.substr(First, Text.find_last_not_of(Blanks) - First + 1);
}

/// "A=1 B=2". False: OutProblem says why.
bool ParseSettings(std::string_view Text, const std::string& Where, std::vector<FMethodSetting>& Out, std::string& OutProblem)
{
	for (Text = Trim(Text); !Text.empty(); Text = Trim(Text))
	{
		const std::string_view Word = Text.substr(0, Text.find_first_of(" \t"));
		Text.remove_prefix(Word.size());
		const size_t Equals = Word.find('=');
		if (Equals == 0 || Equals == std::string_view::npos || Equals + 1 == Word.size())
		{
			OutProblem = fmt::format("{}: {} is not of the form NAME=VALUE", Where, Quote(Word));
			return false;
		}
		const std::string Name(Word.substr(0, Equals));
		if (!FConsoleVariables::Get().Find(Name))
		{
			OutProblem = fmt::format("{}: {} is no console variable", Where, Quote(Name));
			return false;
		}
		Out.push_back({Name, std::string(Word.substr(Equals + 1)), Where});
	}
	return true;
}

/// One section, key by key. The first problem ends it.
class FMethodParser
{
public:
	explicit FMethodParser(FMethod& InMethod) : Method(InMethod) {}
	/// Empty, or the problem.
	std::string Parse(const std::vector<FIniValue>& Values)
	{
		for (const FIniValue& Value : Values)
		{
			if (std::string Problem = ParseKey(Value); !Problem.empty()) { return Problem; }
		}
		if (Method.Title.empty()) { Method.Title = Method.Name; }
		if (!bSignal) { return Method.Where + ": no Signal"; }
		if (Method.Presets.empty()) { return Method.Where + ": no Presets"; }
		if (Typical.empty()) { return {}; }
		const FMethodPreset* const Preset = Method.FindPreset(Typical);
		if (!Preset) { return fmt::format("{}: Typical is {}, which is none of the presets", TypicalWhere, Quote(Typical)); }
		Method.Typical = static_cast<size_t>(Preset - Method.Presets.data());
		return {};
	}

private:
	std::string ParseKey(const FIniValue& Value)
	{
		std::string Problem;
		if (EqualsIgnoringCase(Value.Key, "Title")) { Method.Title = EscapeText(Value.Value); }
		else if (EqualsIgnoringCase(Value.Key, "Signal"))
		{
			const std::optional<ESignal> Signal = FindSignal(Value.Value);
			if (!Signal) { return fmt::format("{}: {} is no signal", Value.Where, Quote(Value.Value)); }
			Method.Signal = *Signal;
			bSignal = true;
		}
		else if (EqualsIgnoringCase(Value.Key, "Needs")) { Problem = ParseNeeds(Value); }
		else if (EqualsIgnoringCase(Value.Key, "CVars")) { ParseSettings(Value.Value, Value.Where, Method.Settings, Problem); }
		else if (EqualsIgnoringCase(Value.Key, "Presets")) { Problem = ParsePreset(Value); }
		else if (EqualsIgnoringCase(Value.Key, "Typical"))
		{
			Typical = Value.Value;
			TypicalWhere = Value.Where;
		}
		else { return fmt::format("{}: {} is none of Title, Signal, Needs, CVars, Presets, Typical", Value.Where, Quote(Value.Key)); }
		return Problem;
	}
	std::string ParseNeeds(const FIniValue& Value)
	{
		if (EqualsIgnoringCase(Value.Value, "any")) { Method.Needs = EMethodNeeds::Any; }
		else if (EqualsIgnoringCase(Value.Value, "pipeline")) { Method.Needs = EMethodNeeds::Pipeline; }
		else if (EqualsIgnoringCase(Value.Value, "query")) { Method.Needs = EMethodNeeds::Query; }
		else { return fmt::format("{}: Needs is {}, expected pipeline, query or any", Value.Where, Quote(Value.Value)); }
		return {};
	}
	std::string ParsePreset(const FIniValue& Value)
	{
		const size_t Colon = Value.Value.find(':');
		FMethodPreset Preset;
		Preset.Name = EscapeText(Trim(std::string_view(Value.Value).substr(0, Colon)));
		if (Colon == std::string::npos || Preset.Name.empty())
		{
			return fmt::format("{}: {} is not of the form PRESET: NAME=VALUE …", Value.Where, Quote(Value.Value));
		}
		if (Method.FindPreset(Preset.Name)) { return fmt::format("{}: a second preset {}", Value.Where, Quote(Preset.Name)); }
		std::string Problem;
		if (ParseSettings(std::string_view(Value.Value).substr(Colon + 1), Value.Where, Preset.Settings, Problem))
		{
			Method.Presets.push_back(std::move(Preset));
		}
		return Problem;
	}

	FMethod& Method;
	bool bSignal = false;
	std::string Typical, TypicalWhere;
};

std::vector<FIniValue> Resolve(const FIniFile& File, const FIniSection& Section)
{
	FIniResolver Resolver;
	Resolver.Apply(File, Section);
	return Resolver.GetValues();
}

void ParseDefaults(const std::vector<FIniValue>& Values, FMethods& Out)
{
	for (const FIniValue& Value : Values)
	{
		std::string Problem;
		if (!EqualsIgnoringCase(Value.Key, "CVars")) { Problem = fmt::format("{}: {} is not CVars", Value.Where, Quote(Value.Key)); }
		else { ParseSettings(Value.Value, Value.Where, Out.Defaults, Problem); }
		if (!Problem.empty()) { Out.Problems.push_back(std::move(Problem)); }
	}
}

FMethods ReadMethods(const FIniFile& File)
{
	constexpr std::string_view Prefix = "Method.";
	FMethods Out;
	Out.Problems = File.GetProblems();
	for (const FIniSection& Section : File.GetSections())
	{
		const std::vector<FIniValue> Values = Resolve(File, Section);
		if (EqualsIgnoringCase(Section.Name, "MethodDefaults"))
		{
			ParseDefaults(Values, Out);
			continue;
		}
		FMethod Method;
		Method.Where = File.GetWhere(Section.Line);
		if (!StartsIgnoringCase(Section.Name, Prefix) || Section.Name.size() == Prefix.size())
		{
			Out.Problems.push_back(
			    fmt::format("{}: section {} is neither MethodDefaults nor Method.NAME", Method.Where, Quote(Section.Name)));
			continue;
		}
		// Names are shown everywhere and kept in JSON, which takes no broken UTF-8.
		Method.Name = EscapeText(std::string_view(Section.Name).substr(Prefix.size()));
		std::string Problem = FMethodParser(Method).Parse(Values);
		if (Problem.empty() && Out.Find(Method.Title))
		{
			Problem = fmt::format("{}: a second method {}", Method.Where, Quote(Method.Title));
		}
		if (Problem.empty()) { Out.Methods.push_back(std::move(Method)); }
		else { Out.Problems.push_back(std::move(Problem)); }
	}
	return Out;
}
} // namespace

const FMethodPreset* FMethod::FindPreset(std::string_view PresetName) const
{
	const auto Found =
	    std::find_if(Presets.begin(), Presets.end(), [&](const FMethodPreset& P) { return EqualsIgnoringCase(P.Name, PresetName); });
	return Found == Presets.end() ? nullptr : &*Found;
}

const FMethod* FMethods::Find(std::string_view NameOrTitle) const
{
	const auto Found = std::find_if(Methods.begin(), Methods.end(),
	    [&](const FMethod& M) { return EqualsIgnoringCase(M.Name, NameOrTitle) || EqualsIgnoringCase(M.Title, NameOrTitle); });
	return Found == Methods.end() ? nullptr : &*Found;
}

FMethods ParseMethods(std::string_view Text, const std::string& Name) { return ReadMethods(FIniFile::Parse(Text, Name)); }

FMethods LoadMethods(const std::string& Path) { return ReadMethods(FIniFile::Load(Path)); }

std::string GetMissing(const FMethod& Method, const FRTCapabilities& Capabilities)
{
	if (Method.Needs == EMethodNeeds::Pipeline && !Capabilities.bRayTracingPipeline) { return "the device has no ray-tracing pipelines"; }
	if (Method.Needs == EMethodNeeds::Query && !Capabilities.bRayQuery) { return "the device has no ray queries"; }
	return {};
}

std::vector<std::string> FMethodScope::Apply(const std::vector<FMethodSetting>& Settings)
{
	std::vector<std::string> Refused;
	for (const FMethodSetting& Setting : Settings)
	{
		const FRTConsoleVariable* const Variable = FConsoleVariables::Get().Find(Setting.Name);
		if (Variable) { Saved.push_back({Variable, Variable->GetValue(), Variable->GetSetBy()}); }
		if (auto Problem = FConsoleVariables::Get().Set(Setting.Name, Setting.Value, ERTSetBy::Console, Setting.Where))
		{
			Refused.push_back(std::move(*Problem));
		}
	}
	if (!Refused.empty()) { Restore(); }
	return Refused;
}

std::vector<std::string> FMethodScope::Apply(const FMethods& Methods, const FMethod* Method, const FMethodPreset* Preset)
{
	std::vector<std::string> Refused = Apply(Methods.Defaults);
	if (Refused.empty() && Method) { Refused = Apply(Method->Settings); }
	if (Refused.empty() && Preset) { Refused = Apply(Preset->Settings); }
	return Refused;
}

void FMethodScope::Restore()
{
	for (auto It = Saved.rbegin(); It != Saved.rend(); ++It) { FConsoleVariables::Get().Restore(*It->Variable, It->Value, It->By); }
	Saved.clear();
}

} // namespace Lantern
