// Ini files in UE's syntax. This header covers the syntax only; Config.h gives the files their meaning.
//
//   [Section]              names are case-insensitive; a section may be continued further down
//   Key=Value              sets: replaces all values that Key had
//   +Key=Value             adds, unless Key already has this value
//   .Key=Value             adds, also a second time
//   -Key=Value             removes this value; -Key alone removes all
//   !Key                   removes all values (UE writes !Key=ClearArray)
//   Key="a ; b"            quoted: blanks and ';' belong to the value; \" \\ \n \t are escapes
//   ; comment              also after a value, if a blank stands before the ';'
//
// The parser is our own, since every bad line must be named while the rest still applies. Among the packaged libraries,
// SimpleIni skips malformed lines silently and keeps no line numbers. The library inih reports only the first bad line of a file and cuts
// a line at a NUL byte.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

namespace Lantern
{

enum class ERTIniOperation : uint8_t
{
	Set,    ///< Key=Value
	Add,    ///< +Key=Value; ignored if Key has this value already
	Append, ///< .Key=Value
	Remove, ///< -Key=Value
	Clear,  ///< !Key or -Key
};

struct FIniEntry
{
	ERTIniOperation Operation = ERTIniOperation::Set;
	std::string Key, Value;
	uint32_t Line = 0; ///< from 1
};

struct FIniSection
{
	std::string Name;
	uint32_t Line = 0; ///< of its first header
	std::vector<FIniEntry> Entries;
};

/// A value that remains after all operations, spelled as in the file. Where: the place that set it ("Config/X.ini:12").
struct FIniValue
{
	std::string Key, Value, Where;
};

/// A parsed file. Nothing throws and nothing is logged; GetProblems lists what is wrong. Limits bound the cost of a hostile
/// file: 16 MiB per file, 64 KiB per line, 10,000 entries, 100 listed problems.
class FIniFile
{
public:
	/// Parses UTF-8 with or without a byte order mark, and LF, CRLF or CR. Messages call the text Name.
	static FIniFile Parse(std::string_view Text, std::string Name);
	/// Loads a file. One that is missing, not a file, unreadable or too large gives no sections and one problem.
	static FIniFile Load(const std::string& Path);

	const std::string& GetName() const { return Name; }
	/// Returns the sections in the order of their first headers.
	const std::vector<FIniSection>& GetSections() const& { return Sections; }
	const std::vector<FIniSection>& GetSections() && = delete; // for (… : FIniFile::Load(…).GetSections()) dangles
	const FIniSection* FindSection(std::string_view SectionName) const&;
	const FIniSection* FindSection(std::string_view SectionName) && = delete;
	/// Returns problems as "Name:line: text", in order of lines. Each is one line and safe to show, whatever the file holds.
	const std::vector<std::string>& GetProblems() const { return Problems; }
	/// Returns "Name:line", escaped for messages.
	std::string GetWhere(uint32_t Line) const;

private:
	friend class FIniParser;
	std::string Name;
	std::vector<FIniSection> Sections;
	std::unordered_map<std::string, size_t> SectionByName;
	std::vector<std::string> Problems;
};

/// Applies the entries of one section after another (a base profile, then a profile derived from it). Keys are
/// case-insensitive, values are not. Linear in the number of entries.
class FIniResolver
{
public:
	void Apply(const FIniFile& File, const FIniSection& Section);
	/// Returns the remaining values in the order in which they were set.
	std::vector<FIniValue> GetValues() const;

private:
	void Put(const FIniFile& File, const FIniEntry& Entry, const std::string& Key, const std::string& Pair);
	void RemoveAll(const std::string& Key);
	void RemovePair(const std::string& Pair);

	struct FSlot
	{
		FIniValue Value;
		bool bAlive = true;
	};
	std::vector<FSlot> Slots;
	std::unordered_map<std::string, std::vector<size_t>> SlotsOfKey;
	// By folded key, a NUL, and the value.
	std::unordered_map<std::string, std::vector<size_t>> SlotsOfPair;
};

} // namespace Lantern
