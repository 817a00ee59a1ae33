// Loads the ini files of a Config folder into console variables.
#include "LanternCore/Config/Config.h"

#include <algorithm>
#include <array>

#include <fmt/format.h>

#include "Config/ConfigFiles.h"
#include "Config/ConsoleVariableValues.h"
#include "LanternCore/Text/Log.h"
#include "LanternCore/Text/Quote.h"
#include "Text/TextTools.h"

namespace Lantern
{

void Report(FConfigProblems& Problems, std::string Text)
{
	LogLine(ERTLogLevel::Warning, Text);
	Problems.push_back(std::move(Text));
}

FIniFile LoadIni(const std::string& Path, FConfigProblems& Problems)
{
	FIniFile File = FIniFile::Load(Path);
	for (const std::string& Problem : File.GetProblems()) Report(Problems, Problem);
	return File;
}

void SetVariables(const std::vector<FIniValue>& Values, ERTSetBy By, FConfigProblems& Problems)
{
	// The registry has logged the message that it returns.
	for (const FIniValue& Value : Values)
		if (std::optional<std::string> Problem = FConsoleVariables::Get().Set(Value.Key, Value.Value, By, Value.Where))
			Problems.push_back(std::move(*Problem));
}

std::vector<FIniValue> ResolveSection(const FIniFile& File, const FIniSection& Section)
{
	FIniResolver Resolver;
	Resolver.Apply(File, Section);
	return Resolver.GetValues();
}

namespace
{

constexpr std::array QualityNames = {"low", "medium", "high", "epic", "cinematic"};
constexpr std::string_view AliasSection = "ConsoleVariableAliases";
constexpr std::string_view GroupSection = "ScalabilityGroups";
constexpr std::array<std::string_view, 2> VariableSections = {"SystemSettings", "ConsoleVariables"};

bool IsVariableSection(std::string_view Name)
{
	return std::any_of(
	    VariableSections.begin(), VariableSections.end(), [&](std::string_view Known) { return EqualsIgnoringCase(Name, Known); });
}

bool IsEngineSection(std::string_view Name) { return EqualsIgnoringCase(Name.substr(0, 8), "/Script/"); }

void ReportUnknownSection(
    const FIniFile& File, const FIniSection& Section, const std::vector<std::string_view>& Known, FConfigProblems& Problems)
{
	Report(Problems, fmt::format("{}: unknown section [{}]; the nearest is [{}]", File.GetWhere(Section.Line),
	                     EscapeText(Section.Name, MaxQuotedBytes), FindNearest(Section.Name, Known)));
}

/// The parts of a section's name: "ShadowQuality@3".
struct FScalabilityName
{
	std::string_view Group;
	ERTQuality Quality;
};

std::optional<FScalabilityName> ParseScalabilityName(std::string_view Name)
{
	const size_t At = Name.rfind('@');
	if (At == std::string_view::npos || At == 0) return std::nullopt;
	const std::optional<ERTQuality> Quality = ParseQuality(Name.substr(At + 1));
	return Quality ? std::optional(FScalabilityName{Name.substr(0, At), *Quality}) : std::nullopt;
}

/// Group empty: all groups.
void ApplyScalability(const FIniFile& File, std::string_view Group, ERTQuality Quality, FConfigProblems& Problems)
{
	for (const FIniSection& Section : File.GetSections())
	{
		const std::optional<FScalabilityName> Name = ParseScalabilityName(Section.Name);
		if (Name && Name->Quality == Quality && (Group.empty() || EqualsIgnoringCase(Name->Group, Group)))
			SetVariables(ResolveSection(File, Section), ERTSetBy::Scalability, Problems);
	}
}

void ReportBadScalabilitySections(const FIniFile& File, FConfigProblems& Problems)
{
	for (const FIniSection& Section : File.GetSections())
		if (!ParseScalabilityName(Section.Name))
			Report(Problems, fmt::format("{}: [{}] is not [Group@0] … [Group@4]", File.GetWhere(Section.Line),
			                     EscapeText(Section.Name, MaxQuotedBytes)));
}

std::vector<std::string_view> GetGroups(const FIniFile& File)
{
	std::vector<std::string_view> Groups;
	for (const FIniSection& Section : File.GetSections())
		if (const std::optional<FScalabilityName> Name = ParseScalabilityName(Section.Name)) Groups.push_back(Name->Group);
	return Groups;
}

/// Applies sg.ShadowQuality=3.
void ApplyGroupChoice(const FIniFile& Scalability, const FIniValue& Choice, FConfigProblems& Problems)
{
	std::string_view Group = Choice.Key;
	if (EqualsIgnoringCase(Group.substr(0, 3), "sg.")) Group.remove_prefix(3);
	const std::vector<std::string_view> Groups = GetGroups(Scalability);
	const bool bKnown = std::any_of(Groups.begin(), Groups.end(), [&](std::string_view Known) { return EqualsIgnoringCase(Known, Group); });
	const std::optional<ERTQuality> Quality = ParseQuality(Choice.Value);
	if (!bKnown)
		Report(Problems, fmt::format("{}: unknown scalability group {}; the nearest is {}", Choice.Where, Quote(Choice.Key),
		                     Quote(FindNearest(Group, Groups))));
	else if (!Quality)
		Report(Problems, fmt::format("{}: {}: {} is not a quality (0 to 4, or low, medium, high, epic, cinematic)", Choice.Where,
		                     EscapeText(Choice.Key, MaxQuotedBytes), Quote(Choice.Value)));
	else ApplyScalability(Scalability, Group, *Quality, Problems);
}

void ApplyGroupChoices(const FConfigFolder& Folder, const FIniFile& File, const FIniSection& Section, FConfigProblems& Problems)
{
	const FIniFile Scalability = LoadIni(Folder.GetScalability(), Problems);
	for (const FIniValue& Choice : ResolveSection(File, Section)) ApplyGroupChoice(Scalability, Choice, Problems);
}

} // namespace

const char* ToString(ERTQuality Quality) { return QualityNames[static_cast<size_t>(Quality)]; }

std::optional<ERTQuality> ParseQuality(std::string_view Text)
{
	for (size_t Level = 0; Level < QualityNames.size(); ++Level)
		if (EqualsIgnoringCase(Text, QualityNames[Level]) || Text == std::to_string(Level)) return static_cast<ERTQuality>(Level);
	return std::nullopt;
}

namespace
{
struct FAliasTarget
{
	std::string_view Name;
	std::optional<double> Factor; ///< nullopt: what stands behind the * is none
};

/// "Name" or "Name * Factor".
FAliasTarget SplitAliasTarget(std::string_view Text)
{
	const size_t Star = Text.find('*');
	if (Star == std::string_view::npos) { return {Trim(Text), 1.0}; }
	std::optional<double> Factor = ParseNumber(Trim(Text.substr(Star + 1)));
	if (Factor == 0.0) { Factor.reset(); }
	return {Trim(Text.substr(0, Star)), Factor};
}
} // namespace

FConfigProblems LoadAliases(const FConfigFolder& Folder)
{
	FConfigProblems Problems;
	const FIniFile File = LoadIni(Folder.GetAliases(), Problems);
	for (const FIniSection& Section : File.GetSections())
	{
		if (!EqualsIgnoringCase(Section.Name, AliasSection))
		{
			ReportUnknownSection(File, Section, {AliasSection}, Problems);
			continue;
		}
		for (const FIniValue& Value : ResolveSection(File, Section))
		{
			const FAliasTarget Target = SplitAliasTarget(Value.Value);
			if (Target.Name.empty() || EqualsIgnoringCase(Value.Key, Target.Name))
				Report(Problems, fmt::format("{}: {} names no other variable", Value.Where, Quote(Value.Key)));
			else if (!Target.Factor)
				Report(Problems, fmt::format("{}: {}: the factor behind * is not a number, or 0", Value.Where, Quote(Value.Value)));
			else FConsoleVariables::Get().AddAlias(Value.Key, Target.Name, *Target.Factor);
		}
	}
	return Problems;
}

FConfigProblems LoadFile(const FConfigFolder& Folder, const std::string& Path)
{
	FConfigProblems Problems;
	const FIniFile File = LoadIni(Path, Problems);
	for (const FIniSection& Section : File.GetSections())
	{
		if (IsVariableSection(Section.Name)) SetVariables(ResolveSection(File, Section), ERTSetBy::Ini, Problems);
		else if (EqualsIgnoringCase(Section.Name, GroupSection)) ApplyGroupChoices(Folder, File, Section, Problems);
		else if (!IsEngineSection(Section.Name))
			ReportUnknownSection(File, Section, {VariableSections[0], VariableSections[1], GroupSection}, Problems);
	}
	return Problems;
}

FConfigProblems LoadDefaults(const FConfigFolder& Folder)
{
	FConfigProblems Problems = LoadAliases(Folder);
	FConfigProblems More = LoadFile(Folder, Folder.GetDefaults());
	Problems.insert(Problems.end(), std::make_move_iterator(More.begin()), std::make_move_iterator(More.end()));
	return Problems;
}

FConfigProblems LoadScalability(const FConfigFolder& Folder, ERTQuality Quality)
{
	FConfigProblems Problems;
	const FIniFile File = LoadIni(Folder.GetScalability(), Problems);
	ReportBadScalabilitySections(File, Problems);
	ApplyScalability(File, {}, Quality, Problems);
	return Problems;
}

FConfigProblems LoadScalabilityGroup(const FConfigFolder& Folder, std::string_view Group, ERTQuality Quality)
{
	FConfigProblems Problems;
	const FIniFile File = LoadIni(Folder.GetScalability(), Problems);
	ApplyGroupChoice(File, {std::string(Group), ToString(Quality), File.GetName()}, Problems);
	return Problems;
}

std::vector<FConfigReference> ListConsoleVariables(const FConfigFolder& Folder)
{
	std::vector<FConfigReference> Result;
	const auto AddKeys = [&](const FIniFile& File, const FIniSection& Section) {
		for (const FIniEntry& Entry : Section.Entries) Result.push_back({Entry.Key, File.GetWhere(Entry.Line)});
	};
	const FIniFile Defaults = FIniFile::Load(Folder.GetDefaults());
	for (const FIniSection& Section : Defaults.GetSections())
		if (IsVariableSection(Section.Name)) AddKeys(Defaults, Section);
	const FIniFile Scalability = FIniFile::Load(Folder.GetScalability());
	for (const FIniSection& Section : Scalability.GetSections()) AddKeys(Scalability, Section);
	const FIniFile Profiles = FIniFile::Load(Folder.GetDeviceProfiles());
	for (const FIniSection& Section : Profiles.GetSections())
		for (const FIniEntry& Entry : Section.Entries)
			if (IsProfileVariableKey(Entry.Key) && !Entry.Value.empty())
				Result.push_back({SplitAssignment(Entry.Value).first, Profiles.GetWhere(Entry.Line)});
	const FIniFile Aliases = FIniFile::Load(Folder.GetAliases());
	for (const FIniSection& Section : Aliases.GetSections())
		for (const FIniEntry& Entry : Section.Entries)
			if (!Entry.Value.empty()) Result.push_back({std::string(SplitAliasTarget(Entry.Value).Name), Aliases.GetWhere(Entry.Line)});
	return Result;
}

} // namespace Lantern
