// How a message of the broker came, beside what it says.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>

#include "drover/time.h"

namespace drover::publish {

enum class Retain : std::uint8_t {
  no,
  asked,   ///< sent just now, by somebody who wants the broker to keep it
  stored,  ///< kept by the broker since some other day
};

/// What a client is told whose large message found no room before the parser.
inline constexpr std::string_view kTooMuchUnread =
    "slow down: 64 large messages, or 8 MiB of them, wait to be read already";
inline constexpr std::size_t kMostUnread = 64;
inline constexpr std::size_t kMostUnreadBytes = std::size_t{8} << 20;

/// So long after a way to those who write was opened nobody's joint commands are followed, or for
/// as long as they may be apart. A stream that was there before shows by that: it is refused, and
/// has to pause.
inline constexpr Duration kJustCame = std::chrono::milliseconds(300);
inline constexpr std::string_view kJustCameWords =
    "droverd has only just come, and nobody's commands are followed yet";

struct Arrival {
  Retain retain = Retain::no;
  /// Why nothing that comes now may begin a motion: the broker holds messages back. Empty: it is
  /// prompt.
  std::string_view late{};
  Duration wall{};              ///< UTC at which it came, since 1970
  bool just_connected = false;  ///< this program, to the broker
};

}  // namespace drover::publish
