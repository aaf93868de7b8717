// What the guard sends and where: bytes and descriptors that droverd handed over. The guard knows
// no protocol; it plays what it was given, round after round.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

#include "drover/guard_protocol.h"
#include "drover/time.h"

namespace drover::guard {

/// A name from outside: not empty, and it ends within its array.
bool is_name(const std::array<char, kGuardNameSize>& name);

class StopSet final {
 public:
  StopSet() = default;
  ~StopSet() { clear(); }
  StopSet(const StopSet&) = delete;
  StopSet& operator=(const StopSet&) = delete;

  void clear();
  /// The same, but what waits in the lines is somebody else's, who has them open: it stays there.
  void leave();
  void swap(StopSet& other);

  // All false for what contradicts the set so far; then nothing has changed.
  /// Takes ownership of `fd` when it returns true; -1: the link is known, and not there. The verb
  /// `absent`: nobody opened it for this set; `link` without `fd`: it was there, and is lost.
  bool add_link(const GuardMessage& message, int fd);
  bool add_axis(const GuardMessage& message);
  bool add_message(const GuardMessage& message);

  /// True when each axis of `held` is here as well, on a link with a descriptor, or on an absent
  /// one to which inherit() brings the way of `held`, or to which `held` has none either.
  bool covers(const StopSet& held) const;
  /// The first axis of `held` that is not here; empty when there is none.
  std::string_view lacks(const StopSet& held) const;
  /// Takes the descriptors of absent links out of the set before this one.
  void inherit(StopSet& held);

  /// Of lines that `held` has open as well: a packet that it began is ended by this set, and what
  /// waits there stays. `held` lets go of them.
  void go_on_from(StopSet& held);

  /// A hold begins: all rounds from the first, at once; what waits in the lines is thrown away.
  void begin_hold();
  /// Some axes only droverd can hold: those of an arm.
  enum class Whose : std::uint8_t {
    all,
    not_daemons,  ///< those it holds, now
    daemons,      ///< and no others: those were released, or have no power
  };
  /// Sends what is due. What a full or dead link refuses is sent again when it is due next.
  void play(Time now, Whose whose = Whose::all);
  /// Each axis was reached within its last five periods. True without any axis. What hangs on a
  /// link that never was there does not count: nobody can have moved it.
  bool in_command(Time now) const;
  /// An axis that nothing but its supply stops was not reached for too long. One that was told its
  /// stop in this hold, for long enough, stands by that: without its supply it would hold no more.
  bool runs_on(Time now) const;

  /// Those on a link that is, or once was, there.
  std::size_t axes() const;
  /// The others: nobody can stop them, or has moved them.
  std::size_t axes_never_reached() const { return axis_count_ - axes(); }
  std::size_t messages() const { return message_count_; }
  /// Messages that a link did not take.
  std::uint64_t unsent() const { return unsent_; }
  /// Of the link with this name, or -1; stays the set's.
  int descriptor(std::string_view link) const;
  /// The names of all links.
  std::vector<std::string_view> links() const;
  /// Of those to which there never was a descriptor.
  std::vector<std::string_view> links_never_there() const;
  /// Appends the messages that make this set, without `hello` and `watch`.
  void tell(std::vector<GuardMessage>& words) const;
  /// Closes it: it is dead, or somebody wants it for himself.
  bool let_go(std::string_view link);
  /// Links that were found dead, and closed, so far.
  std::uint64_t died() const { return died_; }

 private:
  struct Link {
    int fd = -1;
    GuardLinkKind kind = GuardLinkKind::can;
    std::array<char, kGuardNameSize> name{};
    bool was_there = false;  ///< it has a descriptor, or had one
    bool flushed = false;
    /// The rest of a packet that the line took in part: it goes first.
    std::array<std::uint8_t, kGuardMaxBytes> rest{};
    std::size_t rest_size = 0;
  };
  struct Axis {
    std::array<char, kGuardNameSize> name{};
    std::uint32_t link = 0;
    std::uint32_t rounds = 1;
    std::uint32_t round = 0;  ///< the next
    Duration period{};
    bool held_by_daemon = false;
    bool runs_on = false;
    Time due = kNever;
    Time reached = kNever;
    Time missed = kNever;  ///< since then none of its rounds left; kNever: the last one did
    Time taken = kNever;   ///< since then all of them did, in this hold
    bool told = false;     ///< and they did for so long that no line only kept them
  };
  struct Message {
    std::uint32_t axis = 0;
    std::uint32_t round = 0;
    std::uint32_t size = 0;
    std::array<std::uint8_t, kGuardMaxBytes> bytes{};
  };
  bool has(const Axis& axis, const Link& held) const;
  static bool is_same_line(const Link& a, const Link& b);
  static void close(Link& link);
  bool send(Link& link, const Message& message);
  bool write_packet(Link& link, const Message& message);
  std::size_t write_some(Link& link, const std::uint8_t* bytes, std::size_t size);

  std::array<Link, kGuardMaxLinks> links_{};
  std::array<Axis, kGuardMaxAxes> axes_{};
  std::array<Message, kGuardMaxMessages> messages_{};
  std::size_t axis_count_ = 0;
  std::size_t message_count_ = 0;
  std::uint64_t unsent_ = 0;
  std::uint64_t died_ = 0;
};

}  // namespace drover::guard
