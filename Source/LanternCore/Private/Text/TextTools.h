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
/// Without blanks (space, tab, CR, vertical tab, form feed) at both ends.
std::string_view Trim(std::string_view Text);

/// Edits (insert, delete, replace, swap of neighbours) from A to B, ignoring case; the optimal-string-alignment
/// distance. Only the first 128 characters of each are looked at.
size_t GetEditDistance(std::string_view A, std::string_view B);
/// The candidate of the least distance, the first of equals; empty if there are no candidates.
std::string_view FindNearest(std::string_view Text, const std::vector<std::string_view>& Candidates);

/// Case-insensitive; '*' stands for any run of characters, '?' for one. Time is linear in the product of lengths.
bool MatchesWildcard(std::string_view Text, std::string_view Pattern);

} // namespace Lantern
