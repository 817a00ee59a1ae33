// Finds prose in the repository's files: comments of C++, paragraphs of Markdown.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace Lantern::Repo
{

/// Text that is read in one go: a block of comment lines, a paragraph, a list item, a table cell.
struct FProse
{
	size_t Line = 0;  ///< index of its first line
	std::string Text; ///< its lines, joined by blanks, without marks of comments, headings, lists and quotes
	bool bTableCell = false;
};

/// Returns the `//` and `///` comments of C++. A blank comment line ends a block. A comment behind code is a block of its own,
/// with the `///<` lines below it. So is each list item, and each line that is indented as an example.
std::vector<FProse> FindComments(const std::vector<std::string_view>& Lines);

/// Returns paragraphs, headings, list items and table cells of Markdown. Fenced code is skipped.
std::vector<FProse> FindParagraphs(const std::vector<std::string_view>& Lines);

} // namespace Lantern::Repo
