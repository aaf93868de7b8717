// How many of its seeds a test plays whose world runs for minutes.
#pragma once

#include <algorithm>
#include <cstdint>

namespace drover::test {

#ifdef DROVER_SANITIZED
inline constexpr bool kSanitized = true;
#else
inline constexpr bool kSanitized = false;
#endif

/// The claim is the plain build's to prove. A sanitizer looks for mistakes of memory, and a fifth
/// of the worlds run through every line that all of them do.
constexpr std::uint64_t seeds(std::uint64_t all) {
  return kSanitized ? std::max<std::uint64_t>(all / 5, 1) : all;
}

}  // namespace drover::test
