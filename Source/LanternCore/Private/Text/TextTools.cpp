// Text tools: trimming, case folding, nearest names.
#include "Text/TextTools.h"

#include <algorithm>
#include <array>

namespace Lantern
{
namespace
{

char Fold(char C) { return C >= 'A' && C <= 'Z' ? static_cast<char>(C - 'A' + 'a') : C; }

bool FoldedEqual(char A, char B) { return Fold(A) == Fold(B); }

} // namespace

std::string FoldCase(std::string_view Text)
{
	std::string Result(Text);
	std::transform(Result.begin(), Result.end(), Result.begin(), Fold);
	return Result;
}

bool EqualsIgnoringCase(std::string_view A, std::string_view B) { return std::equal(A.begin(), A.end(), B.begin(), B.end(), FoldedEqual); }

bool ContainsIgnoringCase(std::string_view Text, std::string_view Part)
{
	return std::search(Text.begin(), Text.end(), Part.begin(), Part.end(), FoldedEqual) != Text.end() || Part.empty();
}

std::string_view Trim(std::string_view Text)
{
	constexpr std::string_view Blanks = " \t\r\v\f";
	const size_t First = Text.find_first_not_of(Blanks);
	if (First == std::string_view::npos) return {};
	return Text.substr(First, Text.find_last_not_of(Blanks) - First + 1);
}

size_t GetEditDistance(std::string_view A, std::string_view B)
{
	constexpr size_t MaxLength = 128;
	A = A.substr(0, MaxLength);
	B = B.substr(0, MaxLength);
	// Rows of the table for A's last two prefixes and the current one.
	std::array<size_t, MaxLength + 1> BeforeLast{}, Last{}, Row{};
	for (size_t J = 0; J <= B.size(); ++J) Row[J] = J;
	for (size_t I = 1; I <= A.size(); ++I)
	{
		BeforeLast = Last;
		Last = Row;
		Row[0] = I;
		for (size_t J = 1; J <= B.size(); ++J)
		{
			const size_t Cost = FoldedEqual(A[I - 1], B[J - 1]) ? 0 : 1;
			Row[J] = std::min({Last[J] + 1, Row[J - 1] + 1, Last[J - 1] + Cost});
			if (I > 1 && J > 1 && FoldedEqual(A[I - 1], B[J - 2]) && FoldedEqual(A[I - 2], B[J - 1]))
				Row[J] = std::min(Row[J], BeforeLast[J - 2] + 1);
		}
	}
	return Row[B.size()];
}

std::string_view FindNearest(std::string_view Text, const std::vector<std::string_view>& Candidates)
{
	std::string_view Best;
	size_t BestDistance = ~size_t(0);
	for (const std::string_view Candidate : Candidates)
	{
		const size_t Distance = GetEditDistance(Text, Candidate);
		if (Distance < BestDistance)
		{
			BestDistance = Distance;
			Best = Candidate;
		}
	}
	return Best;
}

bool MatchesWildcard(std::string_view Text, std::string_view Pattern)
{
	// Greedy with one point of return: only the last '*' ever needs another try.
	size_t T = 0, P = 0, StarPattern = std::string_view::npos, StarText = 0;
	while (T < Text.size())
	{
		if (P < Pattern.size() && Pattern[P] == '*')
		{
			StarPattern = P++;
			StarText = T;
		}
		else if (P < Pattern.size() && (Pattern[P] == '?' || FoldedEqual(Text[T], Pattern[P])))
		{
			++T;
			++P;
		}
		else if (StarPattern != std::string_view::npos)
		{
			P = StarPattern + 1;
			T = ++StarText;
		}
		else return false;
	}
	return Pattern.find_first_not_of('*', P) == std::string_view::npos;
}

} // namespace Lantern
