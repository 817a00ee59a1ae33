// Files of IES LM-63: lines of labels up to TILT=, then numbers.
#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include "LanternCore/Text/Quote.h"
#include "LanternScene/Lights/Photometry.h"

namespace Lantern
{

namespace
{
bool IsBlank(char C) { return C == ' ' || C == '\t' || C == '\r' || C == '\n' || C == ',' || C == '\x1a'; }

std::string_view Trim(std::string_view Text)
{
	while (!Text.empty() && IsBlank(Text.front())) { Text.remove_prefix(1); }
	while (!Text.empty() && IsBlank(Text.back())) { Text.remove_suffix(1); }
	return Text;
}

/// Reads a file from its start on. The first error stays.
class FReader
{
public:
	FReader(std::string_view InText, std::string_view InName) : Text(InText), Name(InName) {}

	FRTStatus Status;
	void Fail(const std::string& Message, ERTResult Code = ERTResult::InvalidArgument)
	{
		if (!Status) { return; }
		Status = FRTStatus::Error(Code, "%s:%u: %s", EscapeText(Name, MaxQuotedBytes).c_str(), Line, Message.c_str());
	}
	/// Returns whether there is a line.
	bool ReadLine(std::string_view& Out)
	{
		if (At >= Text.size()) { return false; }
		const size_t End = std::min(Text.find('\n', At), Text.size());
		Out = Trim(Text.substr(At, End - At));
		At = std::min(End + 1, Text.size());
		++Line;
		return true;
	}
	/// Fails at what is no finite number. What: what it is, for the message.
	double ReadNumber(const char* What)
	{
		while (At < Text.size() && IsBlank(Text[At])) { Step(); }
		const size_t First = At;
		while (At < Text.size() && !IsBlank(Text[At])) { ++At; }
		std::string_view Word = Text.substr(First, At - First);
		if (Word.empty()) { Fail(std::string("the file ends before ") + What); }
		if (Word.starts_with('+')) { Word.remove_prefix(1); }
		double Value = 0.0;
		const auto [End, Error] = std::from_chars(Word.data(), Word.data() + Word.size(), Value);
		const bool bNumber = Error == std::errc() && End == Word.data() + Word.size() && std::isfinite(Value);
		if (!bNumber) { Fail(std::string(What) + " is no number: " + Quote(Word)); }
		return Status ? Value : 0.0;
	}
	float ReadFloat(const char* What)
	{
		const double Value = ReadNumber(What);
		if (std::abs(Value) > double(std::numeric_limits<float>::max())) { Fail(std::string(What) + " is beyond what a float holds"); }
		return Status ? static_cast<float>(Value) : 0.0f;
	}
	/// Fails at what is no whole number from Least to Most.
	uint32_t ReadCount(const char* What, uint32_t Least, uint32_t Most)
	{
		const double Value = ReadNumber(What);
		if (Value != std::floor(Value) || Value < double(Least) || Value > double(Most))
		{
			Fail(std::string(What) + " is not a whole number from " + std::to_string(Least) + " to " + std::to_string(Most));
		}
		return Status ? static_cast<uint32_t>(Value) : 0;
	}
	/// The most numbers that the rest of the file can hold: each has a character and a blank.
	uint32_t GetMostNumbers() const { return static_cast<uint32_t>(std::min<size_t>((Text.size() - At + 1) / 2, 1u << 30)); }
	std::vector<float> ReadList(const char* What, uint64_t Count, double Scale = 1.0)
	{
		std::vector<float> Out;
		if (Status && Count > GetMostNumbers()) { Fail("the file ends before " + std::to_string(Count) + " numbers: " + What); }
		if (!Status) { return Out; }
		Out.reserve(Count);
		for (uint64_t I = 0; I < Count && Status; ++I)
		{
			const double Value = ReadNumber(What) * Scale;
			if (!(std::abs(Value) <= double(std::numeric_limits<float>::max())))
			{
				Fail(std::string(What) + " is beyond what a float holds");
			}
			Out.push_back(Status ? static_cast<float>(Value) : 0.0f);
		}
		return Out;
	}

	void BeginNumbers() { ++Line; }

private:
	void Step()
	{
		if (Text[At] == '\n') { ++Line; }
		++At;
	}
	std::string_view Text, Name;
	size_t At = 0;
	uint32_t Line = 0; ///< before the numbers: that was read; among them: that is read
};

/// Finds TILT=, behind a line of the standard's year, which files of 1986 lack, and labels.
std::string ReadTilt(FReader& Reader)
{
	std::string_view Line;
	while (Reader.ReadLine(Line))
	{
		if (Line.starts_with("TILT=")) { return std::string(Trim(Line.substr(5))); }
	}
	Reader.Fail("no line begins with TILT=: this is no file of IES LM-63");
	return {};
}

void SkipTilt(FReader& Reader, const std::string& Tilt)
{
	if (Tilt == "NONE") { return; }
	if (Tilt != "INCLUDE") { return Reader.Fail("a tilt in another file is not supported: " + Quote(Tilt), ERTResult::Unsupported); }
	(void)Reader.ReadCount("the lamp's geometry", 1, 3);
	const uint32_t Count = Reader.ReadCount("the number of tilt angles", 1, Reader.GetMostNumbers());
	(void)Reader.ReadList("a tilt angle", Count);
	(void)Reader.ReadList("a tilt factor", Count);
}

void CheckType(FReader& Reader, uint32_t Type)
{
	if (Type == 1 || !Reader.Status) { return; }
	Reader.Fail(std::string("photometry of type ") + (Type == 2 ? "B" : "A") + " is not supported, only type C is", ERTResult::Unsupported);
}
} // namespace

FRTStatus ParseIes(std::string_view Text, std::string_view Name, FPhotometry& Out)
{
	FReader Reader(Text, Name);
	const std::string Tilt = ReadTilt(Reader);
	if (!Reader.Status) { return Reader.Status; }
	if (Tilt != "NONE" && Tilt != "INCLUDE") { SkipTilt(Reader, Tilt); }
	Reader.BeginNumbers();
	if (Reader.Status) { SkipTilt(Reader, Tilt); }
	(void)Reader.ReadNumber("the number of lamps");
	(void)Reader.ReadNumber("the lumens of a lamp"); // -1: absolute photometry
	const double Multiplier = Reader.ReadNumber("the multiplier of candela");
	const uint32_t Verticals = Reader.ReadCount("the number of vertical angles", 2, Reader.GetMostNumbers());
	const uint32_t Horizontals = Reader.ReadCount("the number of horizontal angles", 1, Reader.GetMostNumbers());
	CheckType(Reader, Reader.ReadCount("the photometric type", 1, 3));
	(void)Reader.ReadCount("the type of units", 1, 2);
	for (const char* Edge : {"the width", "the length", "the height"}) { (void)Reader.ReadFloat(Edge); }
	// The second was the factor of ballast and lamp until 1991, and is 1 since.
	const double Ballast = Reader.ReadNumber("the ballast factor"), Second = Reader.ReadNumber("the second ballast factor");
	(void)Reader.ReadNumber("the input watts");
	FPhotometry Table;
	Table.Vertical = Reader.ReadList("a vertical angle", Verticals);
	Table.Horizontal = Reader.ReadList("a horizontal angle", Horizontals);
	Table.Candela = Reader.ReadList("an intensity", uint64_t(Verticals) * Horizontals, Multiplier * Ballast * Second);
	if (!Reader.Status) { return Reader.Status; }
	if (const FRTStatus Status = CheckPhotometry(Table, Name); !Status) { return Status; }
	Out = std::move(Table);
	return FRTStatus::Success();
}

} // namespace Lantern
