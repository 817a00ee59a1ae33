// Splits prose into sentences and checks each.
#include "English.h"

#include <algorithm>
#include <array>

namespace Lantern::Repo
{
namespace
{

constexpr size_t None = std::string_view::npos;
constexpr std::array<std::string_view, 4> RefusedOpenings = {"Of", "The same", "Both", "What must"};
constexpr std::array<std::string_view, 9> Abbreviations = {"e.g", "i.e", "al", "cf", "vs", "approx", "Fig", "Sec", "Eq"};

bool IsBlank(char C) { return C == ' ' || C == '\t' || C == '\n'; }

bool IsDigit(char C) { return C >= '0' && C <= '9'; }

bool IsUpper(char C) { return C >= 'A' && C <= 'Z'; }

bool IsWordCharacter(char C) { return IsUpper(C) || (C >= 'a' && C <= 'z') || IsDigit(C); }

std::string_view TrimBlanks(std::string_view Text)
{
	while (!Text.empty() && IsBlank(Text.front())) { Text.remove_prefix(1); }
	while (!Text.empty() && IsBlank(Text.back())) { Text.remove_suffix(1); }
	return Text;
}

/// Inline code as the word CODE, links without their addresses.
std::string Simplify(std::string_view Prose)
{
	std::string Out;
	for (size_t Place = 0; Place < Prose.size(); ++Place)
	{
		const bool bCode = Prose[Place] == '`';
		const bool bLink = Prose.substr(Place).starts_with("](");
		const size_t Close = bCode || bLink ? Prose.find(bCode ? '`' : ')', Place + 1) : None;
		if (Close == None)
		{
			Out += Prose[Place];
			continue;
		}
		Out += bCode ? "CODE" : "]";
		Place = Close;
	}
	return Out;
}

/// Dot: index of a dot in Text.
bool IsAbbreviation(std::string_view Text, size_t Dot)
{
	size_t Begin = Dot;
	while (Begin > 0 && !IsBlank(Text[Begin - 1]) && Text[Begin - 1] != '(') { --Begin; }
	const std::string_view Word = Text.substr(Begin, Dot - Begin);
	return std::find(Abbreviations.begin(), Abbreviations.end(), Word) != Abbreviations.end();
}

bool BeginsSentence(std::string_view Text)
{
	if (Text.empty()) { return false; }
	return IsUpper(Text[0]) || IsDigit(Text[0]) || std::string_view("\"'[(*_").find(Text[0]) != None || Text.starts_with("r.RT.");
}

/// Length of the sentence that ends with the mark at Place, closing brackets and quotation marks included; 0: none ends there.
size_t FindSentenceEnd(std::string_view Text, size_t Place)
{
	if (std::string_view(".!?").find(Text[Place]) == None || IsAbbreviation(Text, Place)) { return 0; }
	size_t End = Place + 1;
	while (End < Text.size() && std::string_view(")]\"'*_").find(Text[End]) != None) { ++End; }
	const bool bBlank = End < Text.size() && IsBlank(Text[End]);
	return bBlank && BeginsSentence(TrimBlanks(Text.substr(End))) ? End : 0;
}

/// Whether the character at Place, in UTF-8, is a Latin, Greek or Cyrillic letter beyond ASCII.
bool IsForeignLetter(std::string_view Text, size_t Place)
{
	const auto Lead = static_cast<unsigned char>(Text[Place]);
	if (Lead < 0xC3 || Lead > 0xD3 || Place + 1 == Text.size()) { return false; }
	const auto Next = static_cast<unsigned char>(Text[Place + 1]);
	const bool bTimesOrDivided = Lead == 0xC3 && (Next == 0x97 || Next == 0xB7);
	return !bTimesOrDivided;
}

} // namespace

std::vector<std::string> SplitSentences(std::string_view Prose)
{
	const std::string Simple = Simplify(Prose);
	std::string_view Rest = Simple;
	std::vector<std::string> Sentences;
	for (size_t Place = 0; Place < Rest.size(); ++Place)
	{
		const size_t End = FindSentenceEnd(Rest, Place);
		if (End == 0) { continue; }
		Sentences.emplace_back(TrimBlanks(Rest.substr(0, End)));
		Rest.remove_prefix(End);
		Place = 0; // a blank
	}
	Rest = TrimBlanks(Rest);
	if (!Rest.empty()) { Sentences.emplace_back(Rest); }
	return Sentences;
}

size_t CountWords(std::string_view Sentence)
{
	size_t Count = 0;
	bool bCounted = false; // this word
	for (size_t Place = 0; Place < Sentence.size(); ++Place)
	{
		if (IsBlank(Sentence[Place])) { bCounted = false; }
		else if (!bCounted && (IsWordCharacter(Sentence[Place]) || IsForeignLetter(Sentence, Place)))
		{
			++Count;
			bCounted = true;
		}
	}
	return Count;
}

std::string FindFault(std::string_view Sentence)
{
	// Emphasis, brackets and quotation marks hide no opening.
	const std::string_view Bare = Sentence.substr(std::min(Sentence.find_first_not_of("*_\"'([ "), Sentence.size()));
	for (const std::string_view Opening : RefusedOpenings)
	{
		const bool bWhole = Bare.size() == Opening.size() || (Bare.size() > Opening.size() && !IsWordCharacter(Bare[Opening.size()]));
		if (Bare.starts_with(Opening) && bWhole) { return "begins with \"" + std::string(Opening) + "\""; }
	}
	const size_t Words = CountWords(Sentence);
	return Words > MaxSentenceWords ? std::to_string(Words) + " words" : std::string();
}

} // namespace Lantern::Repo
