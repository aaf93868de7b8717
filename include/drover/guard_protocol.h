// Between droverd and drover-guard: a SOCK_SEQPACKET socket for what changes seldom, and shared
// memory for the heartbeats. Plain data; no logic.
//
// Order: `hello` (with the shared memory's descriptor) begins a new set, then a `descriptor` for
// each link that a drive hangs on, then the `stop_frame`s of every drive, then `watch` makes the
// set the one in force. A changed link means the whole set again. `hand_back` gives the bus back to
// the daemon. `pulse_line`, at any time, brings the handle of the line that feeds a hardware
// watchdog; it stays with the guard when the daemon ends.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <type_traits>

namespace drover {

inline constexpr std::uint32_t kGuardVersion = 1;
inline constexpr std::size_t kGuardMaxDescriptors = 8;
inline constexpr std::size_t kGuardMaxFrames = 64;
inline constexpr std::size_t kGuardMaxBytes = 72;  ///< one CAN FD frame

enum class GuardVerb : std::uint32_t {
  hello = 1,
  descriptor,
  stop_frame,
  watch,
  hand_back,
  pulse_line,
};

struct GuardMessage {
  std::uint32_t version = kGuardVersion;
  GuardVerb verb = GuardVerb::hello;
  std::uint32_t descriptor = 0;  ///< index of the link (descriptor, stop_frame)
  std::uint32_t limit_ms = 50;   ///< hello: a heartbeat later than this is too late
  std::uint32_t size = 0;        ///< stop_frame: bytes used
  std::array<std::uint8_t, kGuardMaxBytes> bytes{};  ///< written to the descriptor as they are
};
static_assert(std::is_trivially_copyable_v<GuardMessage>);

struct GuardShared {
  std::atomic<std::uint64_t> daemon_beats;  ///< counted by droverd's control thread each cycle
  std::atomic<std::uint64_t> guard_beats;   ///< counted by the guard each of its cycles
  std::atomic<std::uint32_t> guard_holds;   ///< 1 while the guard sends stop frames
};
static_assert(std::atomic<std::uint64_t>::is_always_lock_free);

}  // namespace drover
