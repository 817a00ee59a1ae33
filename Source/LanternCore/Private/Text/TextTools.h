// Small text helpers shared by console variables and ini files. ASCII case rules: names are ASCII, and the result
// must not depend on the machine's locale.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace Lantern
{

std::string FoldCase(std::string_view Text);
bool EqualsIgnoringCase(std::string_view A, std::string_view B);
bool ContainsIgnoringCase(std::string_view Text, std::string_view Part);
/// Removes blanks (space, tab, CR, vertical tab, form feed) at both ends.
std::string_view Trim(std::string_view Text);

/// Returns the optimal-string-alignment distance, ignoring case: edits (insert, delete, replace, swap of neighbours) from A to B.
/// Only the first 128 characters of each count.
size_t GetEditDistance(std::string_view A, std::string_view B);
/// Returns the nearest candidate, the first one if several are equal; empty if there are no candidates.
std::string_view FindNearest(std::string_view Text, const std::vector<std::string_view>& Candidates);

/// Case-insensitive; '*' matches any run of characters, '?' one character. Time is linear in the product of lengths.
bool MatchesWildcard(std::string_view Text, std::string_view Pattern);

} // namespace Lantern
