// States of simulated devices that carry a number.
#pragma once

#include <charconv>
#include <cmath>
#include <optional>
#include <string_view>

namespace drover {

/// "name:number".
inline std::optional<double> number_after(std::string_view text, std::string_view name) {
  if (!text.starts_with(name) || text.substr(name.size(), 1) != ":") return std::nullopt;
  text.remove_prefix(name.size() + 1);
  double value = 0;
  const auto result = std::from_chars(text.data(), text.data() + text.size(), value);
  if (result.ec != std::errc{} || result.ptr != text.data() + text.size() || !std::isfinite(value))
    return std::nullopt;
  return value;
}

}  // namespace drover
