// The lines of many a board's GPIO chip have no names: a configuration gives their numbers.
#pragma once

#include <charconv>
#include <optional>
#include <string_view>

namespace drover::link {

/// Of digits only, as gpioinfo shows it; empty: it is a name.
inline std::optional<unsigned> line_number(std::string_view name) {
  unsigned number = 0;
  const auto [end, error] = std::from_chars(name.data(), name.data() + name.size(), number);
  if (error != std::errc{} || end != name.data() + name.size()) return {};
  return number;
}

}  // namespace drover::link
