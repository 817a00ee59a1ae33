// Loads the ini files of a Config folder, which set console variables. IniFile.h describes the syntax. The folder holds:
//
//   DefaultLantern.ini           [SystemSettings] and [ConsoleVariables]: name=value
//   Scalability.ini              [ShadowQuality@0] … [ShadowQuality@4]: name=value per group and level
//   DeviceProfiles.ini           [NAME DeviceProfile]: MatchDevice=, BaseProfileName=, +CVars=name=value
//   ConsoleVariableAliases.ini   [ConsoleVariableAliases]: old or engine name=our name
//
// The usual order is that of ERTSetBy: LoadDefaults, LoadFile for each --config, LoadScalability, LoadDeviceProfile, then --set.
// The result does not depend on the order, since a higher ERTSetBy always wins. All functions are called from one thread.
// Values reach the render thread as with FConsoleVariables::Set. Each function returns its problems, which name file and line
// and are already logged as warnings. All other settings are applied.
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
/// Parses a name ("epic", case-insensitive) or a number ("3").
std::optional<ERTQuality> ParseQuality(std::string_view Text);

/// Loads the aliases. Must come first, since the other files may use them.
FConfigProblems LoadAliases(const FConfigFolder& Folder);
/// Calls LoadAliases, then loads DefaultLantern.ini.
FConfigProblems LoadDefaults(const FConfigFolder& Folder);
/// Loads another file of the kind of DefaultLantern.ini (--config, a project's own), with ERTSetBy::Ini. The file may choose
/// the quality of a group of Folder's Scalability.ini: [ScalabilityGroups] sg.ShadowQuality=3.
/// Ignores sections named /Script/…, which belong to an engine.
FConfigProblems LoadFile(const FConfigFolder& Folder, const std::string& Path);
/// Applies this level of every group of Scalability.ini.
FConfigProblems LoadScalability(const FConfigFolder& Folder, ERTQuality Quality);
/// Applies this level of one group ("ShadowQuality").
FConfigProblems LoadScalabilityGroup(const FConfigFolder& Folder, std::string_view Group, ERTQuality Quality);

struct FDeviceProfileResult
{
	std::string Profile; ///< name of the chosen profile; empty: none matched and there is no "Default"
	FConfigProblems Problems;
};
/// Applies the first profile with a MatchDevice pattern that matches the device's name, else "Default". A pattern matches a
/// part of the name or, if it contains * or ?, the whole name. Case is ignored. MatchDevice is not inherited.
FDeviceProfileResult LoadDeviceProfile(const FConfigFolder& Folder, std::string_view DeviceName);

struct FConfigReference
{
	std::string Name;  ///< console variable or alias, as written in the file
	std::string Where; ///< "Config/Scalability.ini:12"
};
/// Lists every console variable that any file of the folder names, in all sections, levels and profiles. Sets and logs
/// nothing. A test uses it to check that all of them exist.
std::vector<FConfigReference> ListConsoleVariables(const FConfigFolder& Folder);

} // namespace Lantern
