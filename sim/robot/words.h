// The words of a command, and what is answered.
#pragma once

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace drover::sim {

inline std::vector<std::string_view> split(std::string_view text) {
  std::vector<std::string_view> words;
  std::size_t at = 0;
  while ((at = text.find_first_not_of(" \t\r\n", at)) != std::string_view::npos) {
    const auto end = std::min(text.find_first_of(" \t\r\n", at), text.size());
    words.push_back(text.substr(at, end - at));
    at = end;
  }
  return words;
}

inline std::optional<double> number(std::string_view text) {
  double value = 0;
  const auto result = std::from_chars(text.data(), text.data() + text.size(), value);
  if (result.ec != std::errc{} || result.ptr != text.data() + text.size() || !std::isfinite(value))
    return std::nullopt;
  return value;
}

/// "drift 20 90" is the state "drift:20:90".
inline std::string state_of(std::span<const std::string_view> words) {
  std::string state;
  for (const auto word : words) {
    if (word.empty()) break;
    state += state.empty() ? "" : ":";
    state += word;
  }
  return state;
}

inline std::string error(std::string text) {
  return "error: " + std::move(text);
}

}  // namespace drover::sim
