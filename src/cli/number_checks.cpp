#include "cli/number_checks.h"

#include <charconv>
#include <cmath>
#include <string>

#include "text/number.h"

namespace drover::cli {

namespace {

struct Read {
  double value = 0;
  bool plain = false;
};

Read read(const std::string& text) {
  Read number;
  const auto* end = text.data() + text.size();
  const auto taken = std::from_chars(text.data(), end, number.value);
  number.plain = taken.ec == std::errc() && taken.ptr == end && std::isfinite(number.value);
  return number;
}

std::string no_number(const std::string& text) {
  return '"' + text + "\" is no number";
}

}  // namespace

CLI::Validator plain_number(double least, double most) {
  const auto check = [least, most](const std::string& text) -> std::string {
    const auto [value, plain] = read(text);
    if (!plain) return no_number(text);
    if (value >= least && value <= most) return "";
    if (!std::isfinite(most)) return text + " is less than " + text::number_text(least);
    return text + " is not between " + text::number_text(least) + " and " + text::number_text(most);
  };
  return {check, "", "a number"};
}

CLI::Validator whole_number(std::int64_t least, std::int64_t most) {
  const auto check = [least, most](std::string& text) -> std::string {
    std::int64_t value = 0;
    const auto* end = text.data() + text.size();
    const auto taken = std::from_chars(text.data(), end, value);
    const bool whole = taken.ptr == end && taken.ec != std::errc::invalid_argument;
    if (!whole) return read(text).plain ? '"' + text + "\" is no whole number" : no_number(text);
    if (taken.ec != std::errc() || value < least || value > most)
      return text + " is not between " + std::to_string(least) + " and " + std::to_string(most);
    text = std::to_string(value);  // the library would read "010" as eight
    return "";
  };
  return {check, "", "a whole number"};
}

}  // namespace drover::cli
