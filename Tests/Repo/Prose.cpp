// Scanners of C++ comments, Markdown and console variables.
#include "Prose.h"

#include <algorithm>
#include <utility>

namespace Lantern::Repo
{
namespace
{

constexpr std::string_view Blanks = " \t\r";
constexpr size_t None = std::string_view::npos;

bool IsDigit(char C) { return C >= '0' && C <= '9'; }

bool IsWordCharacter(char C) { return (C >= 'a' && C <= 'z') || (C >= 'A' && C <= 'Z') || IsDigit(C) || C == '_'; }

std::string_view Trim(std::string_view Text)
{
	const size_t Begin = Text.find_first_not_of(Blanks);
	return Begin == None ? std::string_view() : Text.substr(Begin, Text.find_last_not_of(Blanks) + 1 - Begin);
}

/// Length of the mark of a list item, "- ", "* " or "12. ", at the start of Text; 0: none.
size_t GetListMark(std::string_view Text)
{
	size_t Length = 0;
	while (Length < Text.size() && IsDigit(Text[Length])) { ++Length; }
	const bool bNumber = Length > 0 && Text.substr(Length).starts_with(". ");
	if (bNumber) { return Length + 2; }
	return Text.starts_with("- ") || Text.starts_with("* ") ? 2 : 0;
}

class FProseCollector
{
public:
	void Begin(size_t Line, std::string_view Text, bool bTableCell = false)
	{
		Found.push_back({Line, std::string(Text), bTableCell});
		bOpen = true;
	}
	void Continue(size_t Line, std::string_view Text)
	{
		if (!bOpen) { return Begin(Line, Text); }
		Found.back().Text += ' ';
		Found.back().Text += Text;
	}
	void End() { bOpen = false; }
	bool IsOpen() const { return bOpen; }
	std::vector<FProse> Take() { return std::move(Found); }

private:
	std::vector<FProse> Found;
	bool bOpen = false;
};

/// Where a comment begins outside of string and character literals; None: nowhere.
size_t FindCommentStart(std::string_view Line)
{
	char Quote = 0;
	for (size_t Place = 0; Place < Line.size(); ++Place)
	{
		const char C = Line[Place];
		const bool bDigitSeparator = C == '\'' && Place > 0 && IsWordCharacter(Line[Place - 1]); // 1'000
		if (Quote != 0)
		{
			if (C == '\\') { ++Place; }
			else if (C == Quote) { Quote = 0; }
		}
		else if (C == '"' || (C == '\'' && !bDigitSeparator)) { Quote = C; }
		else if (Line.substr(Place).starts_with("//")) { return Place; }
	}
	return None;
}

enum class ECommentKind
{
	Text,
	Item,     ///< of a list
	Example,  ///< an indented line
	Trailing, ///< behind code
	Member,   ///< `///<` on a line of its own
};

struct FCommentLine
{
	ECommentKind Kind = ECommentKind::Text;
	std::string_view Text;
};

/// Comment: from its slashes on.
FCommentLine ParseComment(std::string_view Comment, bool bBehindCode)
{
	Comment.remove_prefix(Comment.starts_with("///") ? 3 : 2);
	const bool bMember = Comment.starts_with("<");
	if (bMember) { Comment.remove_prefix(1); }
	const bool bIndented = Comment.starts_with("  ") || Comment.starts_with("\t");
	const std::string_view Text = Trim(Comment);
	if (bBehindCode) { return {ECommentKind::Trailing, Text}; }
	if (bMember) { return {ECommentKind::Member, Text}; }
	if (const size_t Mark = GetListMark(Text)) { return {ECommentKind::Item, Trim(Text.substr(Mark))}; }
	return {bIndented ? ECommentKind::Example : ECommentKind::Text, Text};
}

/// Whether a line of kind Next belongs to the block whose last line is of kind Last.
bool ContinuesComment(ECommentKind Last, ECommentKind Next)
{
	switch (Next)
	{
	case ECommentKind::Text: return Last == ECommentKind::Text;
	case ECommentKind::Example: return Last == ECommentKind::Item;
	case ECommentKind::Member: return true;
	default: return false;
	}
}

/// The cells of a row. Bars in inline code and escaped ones divide nothing.
std::vector<std::string_view> SplitRow(std::string_view Row)
{
	std::vector<std::string_view> Cells;
	size_t Begin = 0;
	bool bCode = false;
	for (size_t Place = 0; Place <= Row.size(); ++Place)
	{
		const bool bEnd = Place == Row.size();
		if (!bEnd && Row[Place] == '`') { bCode = !bCode; }
		const bool bBar = !bEnd && Row[Place] == '|' && !bCode && (Place == 0 || Row[Place - 1] != '\\');
		if (!bBar && !bEnd) { continue; }
		const std::string_view Cell = Trim(Row.substr(Begin, Place - Begin));
		if (!Cell.empty()) { Cells.push_back(Cell); }
		Begin = Place + 1;
	}
	return Cells;
}

/// Line is neither blank nor part of fenced code.
void AddMarkdownLine(FProseCollector& Out, size_t Line, std::string_view Text)
{
	if (Text[0] == '|')
	{
		for (const std::string_view Cell : SplitRow(Text)) { Out.Begin(Line, Cell, true); }
		return Out.End();
	}
	if (Text[0] == '#')
	{
		Out.Begin(Line, Trim(Text.substr(std::min(Text.find_first_not_of('#'), Text.size()))));
		return Out.End();
	}
	while (Text.starts_with(">")) { Text = Trim(Text.substr(1)); }
	const size_t Mark = GetListMark(Text);
	if (Mark > 0) { return Out.Begin(Line, Trim(Text.substr(Mark))); }
	Out.Continue(Line, Text);
}

} // namespace

std::vector<FProse> FindComments(const std::vector<std::string_view>& Lines)
{
	FProseCollector Out;
	ECommentKind Last = ECommentKind::Text;
	for (size_t Line = 0; Line < Lines.size(); ++Line)
	{
		const size_t Start = FindCommentStart(Lines[Line]);
		const FCommentLine Comment =
		    Start == None ? FCommentLine() : ParseComment(Lines[Line].substr(Start), !Trim(Lines[Line].substr(0, Start)).empty());
		if (Comment.Text.empty()) { Out.End(); }
		else if (Out.IsOpen() && ContinuesComment(Last, Comment.Kind))
		{
			Out.Continue(Line, Comment.Text);
			continue; // the block keeps its kind
		}
		else { Out.Begin(Line, Comment.Text); }
		Last = Comment.Kind;
	}
	return Out.Take();
}

std::vector<FProse> FindParagraphs(const std::vector<std::string_view>& Lines)
{
	FProseCollector Out;
	bool bFenced = false;
	for (size_t Line = 0; Line < Lines.size(); ++Line)
	{
		const std::string_view Text = Trim(Lines[Line]);
		const bool bFence = Text.starts_with("```") || Text.starts_with("~~~");
		if (bFence) { bFenced = !bFenced; }
		if (bFence || bFenced || Text.empty()) { Out.End(); }
		else { AddMarkdownLine(Out, Line, Text); }
	}
	return Out.Take();
}

} // namespace Lantern::Repo
