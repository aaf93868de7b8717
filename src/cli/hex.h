// Digits of recorded bytes.
#pragma once

#include <charconv>
#include <cstdint>
#include <optional>
#include <string_view>

namespace drover::cli {

/// Nothing when `text` holds anything but hexadecimal digits, or none.
inline std::optional<std::uint32_t> from_hex(std::string_view text) {
  std::uint32_t value = 0;
  const auto* end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, value, 16);
  if (text.empty() || error != std::errc() || stop != end) return std::nullopt;
  return value;
}

}  // namespace drover::cli
