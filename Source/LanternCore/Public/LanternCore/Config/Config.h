// What the ini files of a Config folder mean: they set console variables. Syntax: IniFile.h. The folder holds
//
//   DefaultLantern.ini           [SystemSettings] and [ConsoleVariables]: name=value
//   Scalability.ini              [ShadowQuality@0] … [ShadowQuality@4]: name=value per group and level
//   DeviceProfiles.ini           [NAME DeviceProfile]: MatchDevice=, BaseProfileName=, +CVars=name=value
//   ConsoleVariableAliases.ini   [ConsoleVariableAliases]: old or engine name=our name
//
// Load in the order of ERTSetBy (the order decides nothing, who sets does): LoadDefaults, LoadFile for each --config,
// LoadScalability, LoadDeviceProfile, then --set. From one thread; values reach the render thread as with
// FConsoleVariables::Set. Each function returns its problems, already logged as warnings, each naming file and line;
// what is not named there has been applied.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "LanternCore/Config/ConsoleVariables.h"

namespace Lantern
{

struct FConfigFolder
{
	std::string Path;
	std::string GetDefaults() const { return Path + "/DefaultLantern.ini"; }
	std::string GetScalability() const { return Path + "/Scalability.ini"; }
	std::string GetDeviceProfiles() const { return Path + "/DeviceProfiles.ini"; }
	std::string GetAliases() const { return Path + "/ConsoleVariableAliases.ini"; }
};

using FConfigProblems = std::vector<std::string>;

/// The levels of Scalability.ini, as --quality names them.
enum class ERTQuality : uint8_t
{
	Low,
	Medium,
	High,
	Epic,
	Cinematic
};
const char* ToString(ERTQuality Quality);
/// A name ("epic", case-insensitive) or a number ("3").
std::optional<ERTQuality> ParseQuality(std::string_view Text);

/// Aliases; first, since the other files may use them.
FConfigProblems LoadAliases(const FConfigFolder& Folder);
/// LoadAliases, then DefaultLantern.ini.
FConfigProblems LoadDefaults(const FConfigFolder& Folder);
/// A further file of DefaultLantern.ini's kind (--config, a project's own), set by ERTSetBy::Ini. It may choose
/// quality per group: [ScalabilityGroups] sg.ShadowQuality=3, by Folder's Scalability.ini.
/// Sections named /Script/… are an engine's and are left to it.
FConfigProblems LoadFile(const FConfigFolder& Folder, const std::string& Path);
/// Every group of Scalability.ini at this level.
FConfigProblems LoadScalability(const FConfigFolder& Folder, ERTQuality Quality);
/// One group ("ShadowQuality").
FConfigProblems LoadScalabilityGroup(const FConfigFolder& Folder, std::string_view Group, ERTQuality Quality);

struct FDeviceProfileResult
{
	std::string Profile; ///< the one chosen; empty: none matched and there is no "Default"
	FConfigProblems Problems;
};
/// The first profile of the file one of whose MatchDevice patterns matches the device's name, else "Default". A
/// pattern is a part of the name, or with * and ? the whole name; case is ignored. MatchDevice is not inherited.
FDeviceProfileResult LoadDeviceProfile(const FConfigFolder& Folder, std::string_view DeviceName);

struct FConfigReference
{
	std::string Name;  ///< of a console variable, or an alias, as written
	std::string Where; ///< "Config/Scalability.ini:12"
};
/// Every console variable that any file of the folder names, in all sections, levels and profiles. Sets nothing and
/// logs nothing; with it a test checks that all of them exist.
std::vector<FConfigReference> ListConsoleVariables(const FConfigFolder& Folder);

} // namespace Lantern
