// Opens CAN links: "can0" is a SocketCAN interface, "unix:PATH" a SOCK_SEQPACKET socket that
// carries the same frames (hosts without AF_CAN, sanitizer runs, replay).
#pragma once

#include <string>

#include "link/can_link.h"
#include "link/opened.h"

namespace drover::link {

struct CanSettings {
  std::string interface;              ///< "can0" or "unix:/run/x/can0.sock"
  std::size_t frames_per_cycle = 16;  ///< sizes the send buffer: no more than one cycle may wait
  bool error_frames = true;
  bool hears = true;  ///< false: it is only sent to, and nothing piles up in it
};

/// A bound, non-blocking descriptor, or a sentence. Used twice: for the daemon and for the guard.
UniqueFd open_can_descriptor(const CanSettings& settings, std::string& problem);
Opened<CanLink> open_can(const CanSettings& settings);

}  // namespace drover::link
