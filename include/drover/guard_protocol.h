// Between droverd and drover-guard: a SOCK_SEQPACKET socket for what changes seldom, and shared
// memory for what changes each cycle. Plain data; no logic. src/guard/README.md tells it in words.
//
// Order: `hello` (with the shared memory's descriptor) begins a new stop set, then a `link` or
// `absent` for each line that a drive hangs on, the `axis`es, their `stop_message`s, then `watch`
// offers the set: it becomes the one in force when it covers every axis of the one before. A
// changed link means the whole set again. The other verbs may come at any time.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <type_traits>

namespace drover {

inline constexpr std::uint32_t kGuardVersion = 4;
inline constexpr std::size_t kGuardMaxLinks = 8;
inline constexpr std::size_t kGuardMaxAxes = 64;
inline constexpr std::size_t kGuardMaxMessages = 512;
inline constexpr std::size_t kGuardMaxBytes = 128;  ///< a CAN FD frame has 72
inline constexpr std::size_t kGuardNameSize = 96;   ///< with the zero at its end

enum class GuardVerb : std::uint32_t {
  hello = 1,     ///< with the shared memory; `limit_ms`
  link,          ///< with its descriptor; `index`, `kind`, `name`
  axis,          ///< `index`, `link`, `rounds`, `period_ms`, `name`
  stop_message,  ///< of axis `index`, played in `round`; `size`, `bytes`
  watch,         ///< the set is whole
  hand_back,     ///< the daemon asks for the bus
  pulse_line,  ///< with the handle of the line that feeds a hardware watchdog; stays with the guard
  relay_line,  ///< with the enable relay's line handle; `name`. Held open, and opened for an axis
               ///< that runs on and cannot be reached
  lend,        ///< asks for a duplicate of what is kept as `name`; the answer is `lend` with it,
               ///< or without when there is none
  let_go,      ///< closes what is kept as `name`: it is dead, or to be opened anew
  absent,  ///< instead of `link`, the same without a descriptor: the line is not there just now.
           ///< The guard goes on with its own way there, if it has one
};

enum class GuardLinkKind : std::uint32_t {
  can = 1,  ///< a message is one frame, sent as one packet
  tty,      ///< a message is one whole packet of bytes, written; what waits is flushed once before
};

struct GuardMessage {
  std::uint32_t version = kGuardVersion;
  GuardVerb verb = GuardVerb::hello;
  std::uint32_t index = 0;      ///< of the link or axis within its set
  std::uint32_t link = 0;       ///< axis: where its messages go
  std::uint32_t rounds = 1;     ///< axis: how many rounds are played in turn, then from the first
  std::uint32_t round = 0;      ///< stop_message: in which of them it is sent
  std::uint32_t period_ms = 0;  ///< axis: from one round to the next; 10 and more
  /// axis: 1: it holds only by what droverd tells it, the recipe cannot. A stop at the stop socket
  /// leaves it to a droverd whose heartbeat is good, which hears of the stop.
  std::uint32_t held_by_daemon = 0;
  /// axis: 1: nothing stops it when nothing reaches it, it goes on by its last message. Its supply
  /// is cut then, by the line of `relay_line`.
  std::uint32_t runs_on = 0;
  std::uint32_t limit_ms = 50;  ///< hello: a heartbeat later than this is too late
  GuardLinkKind kind = GuardLinkKind::can;
  std::uint32_t size = 0;  ///< stop_message: bytes used
  /// link: its name. axis: what it is on the wire, so that another set's same axis is known again:
  /// the link's name and its address there ("can0 00D"). The line's name for relay_line.
  std::array<char, kGuardNameSize> name{};
  std::array<std::uint8_t, kGuardMaxBytes> bytes{};  ///< written to the descriptor as they are
};
static_assert(std::is_trivially_copyable_v<GuardMessage>);

/// What the guard may do with drives that nobody commands. Odd values, so that a broken daemon does
/// not free the drives by chance: whatever is neither of the two others means `hold`.
enum class GuardMayHold : std::uint32_t {
  hold = 0,  ///< play the stop recipe
  // To others than those `held_by_daemon`: send nothing.
  released = 0x52454C45,  ///< a person released the drives
  cut = 0x43555452,       ///< droverd cut the drives' power, a person has to reset that
};

/// Made by droverd, sealed against shrinking, mapped by both.
struct GuardShared {
  // Written by droverd's control thread each cycle:
  std::atomic<std::uint64_t> daemon_beats;
  std::atomic<GuardMayHold> may_hold;
  // Written by the guard each of its cycles:
  std::atomic<std::uint64_t> guard_beats;
  std::atomic<std::uint32_t> guard_holds;    ///< 1: it has the bus; frames of droverd's are blocked
  std::atomic<std::uint32_t> guard_latched;  ///< 1: stopped at its stop socket, until a reset there
  std::atomic<std::uint32_t> latched_by_uid;  ///< who stopped it, while latched
  std::atomic<std::uint32_t> set_refused;  ///< 1: the last set offered lacks axes of the held one
  std::atomic<std::uint64_t> unsaid;       ///< texts and notifications that it could not say
  std::atomic<std::uint64_t> unsent;       ///< stop messages that their link did not take
};
static_assert(std::atomic<std::uint64_t>::is_always_lock_free);
static_assert(std::atomic<GuardMayHold>::is_always_lock_free);

}  // namespace drover
