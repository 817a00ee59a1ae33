// The rules of English of CONTRIBUTING.md, as far as a program can check them: how sentences begin and how long they are.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace Lantern::Repo
{

inline constexpr size_t MaxSentenceWords = 25;

/// Splits prose into sentences. Inline code becomes one word, and a link becomes its text. ".", "!" or "?" ends a sentence if the
/// next word begins with a capital, a digit, a bracket or a quotation mark, or names a console variable.
std::vector<std::string> SplitSentences(std::string_view Prose);

/// Counts what stands between blanks and contains a letter or a digit.
size_t CountWords(std::string_view Sentence);

/// Says which rule the sentence breaks; empty if none.
std::string FindFault(std::string_view Sentence);

} // namespace Lantern::Repo
