// Lines of GPIO chips as a configuration names them: those of many a board have no names, and are
// given by their numbers.
#pragma once

#include <charconv>
#include <optional>
#include <string>
#include <string_view>

namespace drover::link {

/// Of digits only, as gpioinfo shows it; empty: it is a name.
inline std::optional<unsigned> line_number(std::string_view name) {
  unsigned number = 0;
  const auto [end, error] = std::from_chars(name.data(), name.data() + name.size(), number);
  if (error != std::errc{} || end != name.data() + name.size()) return {};
  return number;
}

/// For people.
inline std::string no_line(const std::string& chip, const std::string& line) {
  return "gpio " + chip + ": no line " + (line_number(line) ? line : "named \"" + line + "\"");
}
inline std::string no_chip(const std::string& chip) {
  return "gpio " + chip + ": no chip with this label or name";
}

}  // namespace drover::link
