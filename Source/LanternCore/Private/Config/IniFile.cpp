// The parser of ini files, and the resolver of their operations.
#include "LanternCore/Config/IniFile.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <optional>

#include <fmt/format.h>

#include "LanternCore/Text/Quote.h"
#include "Text/TextTools.h"

namespace Lantern
{
namespace
{

constexpr size_t MaxFileBytes = size_t(16) << 20;
constexpr size_t MaxLineBytes = size_t(64) << 10;
constexpr size_t MaxEntries = 10'000;
constexpr size_t MaxProblems = 100;

/// ';' opens a comment at the start of a text or after a blank.
std::string_view CutComment(std::string_view Text)
{
	for (size_t I = 0; I < Text.size(); ++I)
		if (Text[I] == ';' && (I == 0 || Text[I - 1] == ' ' || Text[I - 1] == '\t')) return Text.substr(0, I);
	return Text;
}

bool IsBlankOrComment(std::string_view Text)
{
	Text = Trim(Text);
	return Text.empty() || Text[0] == ';';
}

/// Text must begin with a quotation mark.
std::optional<std::string> ParseQuoted(std::string_view Text, std::string& OutError)
{
	std::string Value;
	for (size_t I = 1; I < Text.size(); ++I)
	{
		if (Text[I] == '"')
		{
			if (IsBlankOrComment(Text.substr(I + 1))) return Value;
			OutError = fmt::format("text after the closing quotation mark: {}", Quote(Trim(Text.substr(I + 1))));
			return std::nullopt;
		}
		if (Text[I] == '\\' && I + 1 < Text.size())
		{
			const char Escaped = Text[++I];
			if (Escaped == 'n' || Escaped == 't') Value += Escaped == 'n' ? '\n' : '\t';
			else if (Escaped == '"' || Escaped == '\\') Value += Escaped;
			else
				// Not an escape: a Windows path, most likely.
				(Value += '\\') += Escaped;
			continue;
		}
		Value += Text[I];
	}
	OutError = "no closing quotation mark";
	return std::nullopt;
}

std::optional<ERTIniOperation> GetOperation(char Prefix)
{
	switch (Prefix)
	{
	case '+': return ERTIniOperation::Add;
	case '.': return ERTIniOperation::Append;
	case '-': return ERTIniOperation::Remove;
	case '!': return ERTIniOperation::Clear;
	default: return std::nullopt;
	}
}

bool HasControlCharacter(std::string_view Text)
{
	for (const char C : Text)
		if ((static_cast<unsigned char>(C) < 0x20 && C != '\t') || C == 0x7f) return true;
	return false;
}

} // namespace

class FIniParser
{
public:
	explicit FIniParser(FIniFile& InFile) : File(InFile) {}

	void ParseText(std::string_view Text)
	{
		constexpr std::string_view Utf8Mark = "\xEF\xBB\xBF";
		if (Text.size() > MaxFileBytes) return AddFileProblem(fmt::format("larger than {} MiB", MaxFileBytes >> 20));
		if (Text.substr(0, 2) == "\xFF\xFE" || Text.substr(0, 2) == "\xFE\xFF") return AddFileProblem("UTF-16; save it as UTF-8");
		if (Text.substr(0, 3) == Utf8Mark) Text.remove_prefix(3);
		while (!Text.empty())
		{
			++Line;
			const size_t End = std::min(Text.find_first_of("\r\n"), Text.size());
			ParseLine(Text.substr(0, End));
			const bool bTwo = Text.substr(End, 2) == "\r\n";
			Text.remove_prefix(std::min(End + (bTwo ? 2 : 1), Text.size()));
		}
		if (SuppressedProblems > 0)
			File.Problems.push_back(fmt::format("{}: {} more problems are not listed", EscapePath(File.Name), SuppressedProblems));
	}

	void AddFileProblem(std::string_view Text) { File.Problems.push_back(fmt::format("{}: {}", EscapePath(File.Name), Text)); }

private:
	void AddProblem(std::string_view Text)
	{
		if (File.Problems.size() < MaxProblems) File.Problems.push_back(fmt::format("{}: {}", File.GetWhere(Line), Text));
		else ++SuppressedProblems;
	}

	void ParseLine(std::string_view Text)
	{
		if (Text.size() > MaxLineBytes)
			return AddProblem(fmt::format("a line of {} bytes; at most {} are read", Text.size(), MaxLineBytes));
		Text = Trim(Text);
		if (Text.empty() || Text[0] == ';') return;
		if (HasControlCharacter(Text)) return AddProblem(fmt::format("control character in {}", Quote(Text)));
		if (Text[0] == '[') ParseHeader(Text);
		else ParseEntry(Text);
	}

	void ParseHeader(std::string_view Text)
	{
		// Entries after a broken header must not go to the previous section.
		State = EState::Skip;
		const size_t End = Text.find(']');
		if (End == std::string_view::npos) return AddProblem(fmt::format("section without ']': {}; its entries are ignored", Quote(Text)));
		const std::string_view SectionName = Trim(Text.substr(1, End - 1));
		if (SectionName.empty()) return AddProblem("section without a name; its entries are ignored");
		if (!IsBlankOrComment(Text.substr(End + 1)))
			return AddProblem(fmt::format("text after ']': {}; the section's entries are ignored", Quote(Text)));
		const auto [Place, bNew] = File.SectionByName.emplace(FoldCase(SectionName), File.Sections.size());
		if (bNew)
		{
			if (!CountEntry())
			{
				File.SectionByName.erase(Place);
				return;
			}
			File.Sections.push_back({.Name = std::string(SectionName), .Line = Line});
		}
		Section = Place->second;
		State = EState::InSection;
	}

	void ParseEntry(std::string_view Text)
	{
		if (State == EState::Skip) return;
		if (State == EState::BeforeSections) return AddProblem(fmt::format("{} stands before any [Section]", Quote(Text)));
		const std::string_view Whole = Text;
		FIniEntry Entry{.Line = Line};
		if (const std::optional<ERTIniOperation> Operation = GetOperation(Text[0]))
		{
			Entry.Operation = *Operation;
			Text.remove_prefix(1);
		}
		const size_t Equals = Text.find('=');
		const bool bMayLackValue = Entry.Operation == ERTIniOperation::Remove || Entry.Operation == ERTIniOperation::Clear;
		if (Equals == std::string_view::npos && !bMayLackValue)
			return AddProblem(fmt::format("{} is neither Key=Value nor [Section]", Quote(Whole)));
		Entry.Key = Trim(Equals == std::string_view::npos ? CutComment(Text) : Text.substr(0, Equals));
		if (Entry.Key.empty()) return AddProblem(fmt::format("no key in {}", Quote(Whole)));
		if (Equals == std::string_view::npos) Entry.Operation = ERTIniOperation::Clear;
		else if (!ParseValue(Trim(Text.substr(Equals + 1)), Entry.Value)) return;
		if (CountEntry()) File.Sections[Section].Entries.push_back(std::move(Entry));
	}

	bool ParseValue(std::string_view Text, std::string& OutValue)
	{
		if (Text.empty() || Text[0] != '"')
		{
			OutValue = Trim(CutComment(Text));
			return true;
		}
		std::string Error;
		std::optional<std::string> Value = ParseQuoted(Text, Error);
		if (!Value)
		{
			AddProblem(fmt::format("{} in {}", Error, Quote(Text)));
			return false;
		}
		OutValue = std::move(*Value);
		return true;
	}

	bool CountEntry()
	{
		if (++EntryCount == MaxEntries + 1) AddProblem(fmt::format("more than {} entries; the rest is ignored", MaxEntries));
		return EntryCount <= MaxEntries;
	}

	enum class EState : uint8_t
	{
		BeforeSections,
		InSection,
		Skip
	};
	FIniFile& File;
	EState State = EState::BeforeSections;
	size_t Section = 0;
	size_t EntryCount = 0;
	size_t SuppressedProblems = 0;
	uint32_t Line = 0;
};

FIniFile FIniFile::Parse(std::string_view Text, std::string Name)
{
	FIniFile File;
	File.Name = std::move(Name);
	FIniParser(File).ParseText(Text);
	return File;
}

FIniFile FIniFile::Load(const std::string& Path)
{
	FIniFile File;
	File.Name = Path;
	FIniParser Parser(File);
	std::error_code Error;
	const std::filesystem::file_status Status = std::filesystem::status(Path, Error);
	// A device or a pipe could keep the reader waiting for ever.
	if (!std::filesystem::is_regular_file(Status))
	{
		Parser.AddFileProblem(!std::filesystem::exists(Status)        ? "no such file"
		                      : std::filesystem::is_directory(Status) ? "is a folder, not a file"
		                                                              : "is not a regular file");
		return File;
	}
	std::ifstream Stream(Path, std::ios::binary);
	// One byte more than allowed shows that the file is too large, whatever size the file system reported.
	std::string Text(std::min<uintmax_t>(std::filesystem::file_size(Path, Error), MaxFileBytes) + 1, '\0');
	if (Stream) Stream.read(Text.data(), static_cast<std::streamsize>(Text.size()));
	if (!Stream.is_open() || Stream.bad())
	{
		Parser.AddFileProblem("cannot be read");
		return File;
	}
	Text.resize(static_cast<size_t>(Stream.gcount()));
	Parser.ParseText(Text);
	return File;
}

const FIniSection* FIniFile::FindSection(std::string_view SectionName) const&
{
	const auto Place = SectionByName.find(FoldCase(SectionName));
	return Place == SectionByName.end() ? nullptr : &Sections[Place->second];
}

std::string FIniFile::GetWhere(uint32_t Line) const { return fmt::format("{}:{}", EscapePath(Name), Line); }

// FIniResolver

void FIniResolver::Apply(const FIniFile& File, const FIniSection& Section)
{
	for (const FIniEntry& Entry : Section.Entries)
	{
		const std::string Key = FoldCase(Entry.Key);
		std::string Pair = Key;
		(Pair += '\0') += Entry.Value;
		switch (Entry.Operation)
		{
		case ERTIniOperation::Set:
			RemoveAll(Key);
			Put(File, Entry, Key, Pair);
			break;
		case ERTIniOperation::Add:
			if (SlotsOfPair.find(Pair) == SlotsOfPair.end()) Put(File, Entry, Key, Pair);
			break;
		case ERTIniOperation::Append: Put(File, Entry, Key, Pair); break;
		case ERTIniOperation::Remove: RemovePair(Pair); break;
		case ERTIniOperation::Clear: RemoveAll(Key); break;
		}
	}
}

void FIniResolver::Put(const FIniFile& File, const FIniEntry& Entry, const std::string& Key, const std::string& Pair)
{
	SlotsOfKey[Key].push_back(Slots.size());
	SlotsOfPair[Pair].push_back(Slots.size());
	Slots.push_back({.Value = {Entry.Key, Entry.Value, File.GetWhere(Entry.Line)}});
}

void FIniResolver::RemoveAll(const std::string& Key)
{
	const auto Place = SlotsOfKey.find(Key);
	if (Place == SlotsOfKey.end()) return;
	for (const size_t Index : Place->second)
	{
		if (!Slots[Index].bAlive) continue;
		Slots[Index].bAlive = false;
		std::string Pair = Key;
		(Pair += '\0') += Slots[Index].Value.Value;
		SlotsOfPair.erase(Pair);
	}
	SlotsOfKey.erase(Place);
}

void FIniResolver::RemovePair(const std::string& Pair)
{
	const auto Place = SlotsOfPair.find(Pair);
	if (Place == SlotsOfPair.end()) return;
	for (const size_t Index : Place->second) Slots[Index].bAlive = false;
	SlotsOfPair.erase(Place);
}

std::vector<FIniValue> FIniResolver::GetValues() const
{
	std::vector<FIniValue> Result;
	for (const FSlot& Slot : Slots)
		if (Slot.bAlive) Result.push_back(Slot.Value);
	return Result;
}

} // namespace Lantern
