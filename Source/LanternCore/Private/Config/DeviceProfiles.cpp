// Device profiles: choosing one by the device name, and applying it with its base profiles.
#include <algorithm>

#include <fmt/format.h>

#include "Config/ConfigFiles.h"
#include "LanternCore/Text/Quote.h"
#include "Text/TextTools.h"

namespace Lantern
{
namespace
{

constexpr std::string_view SectionSuffix = " DeviceProfile";
constexpr std::string_view DefaultProfile = "Default";
constexpr std::string_view MatchKey = "MatchDevice";
constexpr std::string_view BaseKey = "BaseProfileName";
constexpr std::string_view VariablesKey = "CVars";
/// UE's platform name. It is accepted and ignored.
constexpr std::string_view TypeKey = "DeviceType";

/// Returns "Lavapipe" for "Lavapipe DeviceProfile"; empty if the section is not a profile.
std::string_view GetProfileName(const FIniSection& Section)
{
	const std::string_view Name = Section.Name;
	if (Name.size() <= SectionSuffix.size() || !EqualsIgnoringCase(Name.substr(Name.size() - SectionSuffix.size()), SectionSuffix))
		return {};
	return Trim(Name.substr(0, Name.size() - SectionSuffix.size()));
}

const FIniSection* FindProfile(const FIniFile& File, std::string_view Name)
{
	for (const FIniSection& Section : File.GetSections())
		if (EqualsIgnoringCase(GetProfileName(Section), Name) && !Name.empty()) return &Section;
	return nullptr;
}

bool MatchesDevice(std::string_view DeviceName, std::string_view Pattern)
{
	if (Pattern.empty()) return false;
	const bool bWildcard = Pattern.find_first_of("*?") != std::string_view::npos;
	return bWildcard ? MatchesWildcard(DeviceName, Pattern) : ContainsIgnoringCase(DeviceName, Pattern);
}

const FIniSection* ChooseProfile(const FIniFile& File, std::string_view DeviceName)
{
	for (const FIniSection& Section : File.GetSections())
	{
		if (GetProfileName(Section).empty()) continue;
		for (const FIniValue& Value : ResolveSection(File, Section))
			if (EqualsIgnoringCase(Value.Key, MatchKey) && MatchesDevice(DeviceName, Value.Value)) return &Section;
	}
	return FindProfile(File, DefaultProfile);
}

void CheckProfiles(const FIniFile& File, FConfigProblems& Problems)
{
	const std::vector<std::string_view> Known = {MatchKey, BaseKey, VariablesKey, TypeKey};
	for (const FIniSection& Section : File.GetSections())
	{
		if (GetProfileName(Section).empty())
		{
			Report(Problems,
			    fmt::format("{}: [{}] is not [NAME DeviceProfile]", File.GetWhere(Section.Line), EscapeText(Section.Name, MaxQuotedBytes)));
			continue;
		}
		for (const FIniEntry& Entry : Section.Entries)
			if (std::none_of(Known.begin(), Known.end(), [&](std::string_view Key) { return EqualsIgnoringCase(Entry.Key, Key); }))
				Report(Problems, fmt::format("{}: unknown key {} in a device profile; the nearest is '{}'", File.GetWhere(Entry.Line),
				                     Quote(Entry.Key), FindNearest(Entry.Key, Known)));
	}
}

constexpr size_t MaxChain = 16;

/// Returns the profile, its base, the base's base, and so on. A cycle ends where it closes.
std::vector<const FIniSection*> GetChain(const FIniFile& File, const FIniSection* Profile, FConfigProblems& Problems)
{
	std::vector<const FIniSection*> Chain;
	while (Profile)
	{
		Chain.push_back(Profile);
		const FIniSection* Base = nullptr;
		for (const FIniValue& Value : ResolveSection(File, *Profile))
		{
			if (!EqualsIgnoringCase(Value.Key, BaseKey) || Value.Value.empty()) continue;
			Base = FindProfile(File, Value.Value);
			const bool bCircle = std::find(Chain.begin(), Chain.end(), Base) != Chain.end();
			const bool bTooLong = Chain.size() >= MaxChain;
			if (!Base || bCircle || bTooLong)
				Report(Problems, fmt::format("{}: base profile {} {}", Value.Where, Quote(Value.Value),
				                     !Base     ? "does not exist"
				                     : bCircle ? "is derived from this one"
				                               : fmt::format("is more than {} steps away", MaxChain)));
			if (bCircle || bTooLong) Base = nullptr;
		}
		Profile = Base;
	}
	return Chain;
}

void ApplyChain(const FIniFile& File, const std::vector<const FIniSection*>& Chain, FConfigProblems& Problems)
{
	FIniResolver Resolver;
	for (auto Profile = Chain.rbegin(); Profile != Chain.rend(); ++Profile) Resolver.Apply(File, **Profile);
	std::vector<FIniValue> Variables;
	for (const FIniValue& Value : Resolver.GetValues())
	{
		if (!IsProfileVariableKey(Value.Key)) continue;
		if (Value.Value.find('=') == std::string::npos)
		{
			Report(Problems, fmt::format("{}: {} is not name=value", Value.Where, Quote(Value.Value)));
			continue;
		}
		auto [Name, Text] = SplitAssignment(Value.Value);
		Variables.push_back({std::move(Name), std::move(Text), Value.Where});
	}
	SetVariables(Variables, ERTSetBy::DeviceProfile, Problems);
}

} // namespace

bool IsProfileVariableKey(std::string_view Key) { return EqualsIgnoringCase(Key, VariablesKey); }

std::pair<std::string, std::string> SplitAssignment(std::string_view Text)
{
	const size_t Equals = std::min(Text.find('='), Text.size());
	return {std::string(Trim(Text.substr(0, Equals))), std::string(Trim(Text.substr(std::min(Equals + 1, Text.size()))))};
}

FDeviceProfileResult LoadDeviceProfile(const FConfigFolder& Folder, std::string_view DeviceName)
{
	FDeviceProfileResult Result;
	const FIniFile File = LoadIni(Folder.GetDeviceProfiles(), Result.Problems);
	CheckProfiles(File, Result.Problems);
	const FIniSection* Profile = ChooseProfile(File, DeviceName);
	if (!Profile) return Result;
	Result.Profile = GetProfileName(*Profile);
	ApplyChain(File, GetChain(File, Profile, Result.Problems), Result.Problems);
	return Result;
}

} // namespace Lantern
