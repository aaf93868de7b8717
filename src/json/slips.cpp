#include "json/slips.h"

#include <algorithm>
#include <charconv>
#include <cstdint>

#include "json/located_json.h"
#include "text/letters.h"

namespace drover::json {
namespace {

bool is_digit(char c) {
  return c >= '0' && c <= '9';
}

bool is_word_char(char c) {
  const char small = text::small_letter(c);
  return (small >= 'a' && small <= 'z') || is_digit(c) || c == '_' || c == '-' || c == '/';
}

/// A word without quotes.
std::string slip_of_word(std::string_view word) {
  const auto low = text::in_small_letters(word);
  if (low == "nan" || low == "infinity" || low == "inf") return "a number is expected";
  if (low == "none" || low == "nil") return "it is written null";
  for (const std::string_view known : {"true", "false", "null"})
    if (low == known) return "it is written " + low + ", in small letters";
  auto quoted = "\"" + shown(word, 40) + "\" needs quotes";
  if (low == "yes" || low == "on") return quoted + ", or is it true?";
  if (low == "no" || low == "off") return quoted + ", or is it false?";
  return quoted;
}

/// Only addresses of a register map are read in hexadecimal.
std::string slip_of_hexadecimal(std::string_view digits) {
  std::uint32_t value = 0;
  const auto* const begin = digits.data();
  const auto [end, error] = std::from_chars(begin, begin + digits.size(), value, 16);
  if (error != std::errc{}) return "there are no hexadecimal numbers";
  return "there are no hexadecimal numbers: write " + std::to_string(value) +
         "; or, of an address in a register map, \"0x" + std::string(begin, end) + "\" in quotes";
}

/// What a number ran into, or how it begins.
std::string slip_of_number(std::string_view text, std::size_t at) {
  const char c = text[at];
  const bool goes_on = at > 0 && text[at - 1] == '0';
  if (goes_on && (c == 'x' || c == 'X')) return slip_of_hexadecimal(text.substr(at + 1));
  if (goes_on && is_digit(c)) return "a number has no zeros before it";
  const bool before_digit = at + 1 < text.size() && is_digit(text[at + 1]);
  if (c == '.' && before_digit) return "a number begins with a digit, as 0.5 does";
  if (c == '+' && before_digit) return "a number has no + before it";
  return {};
}

}  // namespace

std::string slip_at(std::string_view text, std::size_t at, bool inside) {
  if (at >= text.size()) return {};
  const char c = text[at];
  if (c == '#') return "'#' begins no comment: // does, and /* ... */";
  if (c == '\'') return "texts and keys stand in \"double quotes\"";
  if (auto number = slip_of_number(text, at); !number.empty()) return number;
  const auto rest = text.substr(at);
  const auto word =
      rest.substr(0, static_cast<std::size_t>(
                         std::find_if_not(rest.begin(), rest.end(), is_word_char) - rest.begin()));
  // A number, or a word that is one of JSON and stands at the wrong place, is told otherwise.
  const bool is_known = word == "true" || word == "false" || word == "null";
  if (!inside || is_known || word.empty() || is_digit(c) || c == '-') return {};
  return slip_of_word(word);
}

std::string in_other_words(std::string message) {
  const auto ends = [&message](std::string_view end) { return message.ends_with(end); };
  const auto has = [&message](std::string_view piece) {
    return message.find(piece) != std::string::npos;
  };
  const bool value = has("unexpected string literal") || has("unexpected number literal") ||
                     has("unexpected true literal") || has("unexpected false literal") ||
                     has("unexpected null literal") || has("unexpected '{'") ||
                     has("unexpected '['");
  if (value && (ends("; expected '}'") || ends("; expected ']'")))
    return "a comma is missing before this";
  if (has("unexpected '}'; expected string literal") ||
      has("unexpected ']'; expected '[', '{', or a literal") ||
      (has("unexpected ','") && !ends("; expected ':'")))
    return "there is a comma too many before this";
  if (value && ends("; expected ':'")) return "a colon is missing before this";
  return message;
}

}  // namespace drover::json
