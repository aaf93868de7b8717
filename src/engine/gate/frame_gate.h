// The second gate: which messages may leave on which link.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "drover/driver.h"
#include "drover/fixed_vector.h"
#include "drover/measurement.h"

namespace drover::engine {

enum class FrameVerdict : std::uint8_t {
  pass,
  refused_not_allowed,  ///< not on the sender's list for this link, or a forbidden effect
  refused_motion,       ///< may move a channel that may not, or while the guard has the link
};

/// The one motion that needs no owner: a wheel or a base that rolls is brought to rest.
struct Slowing {
  bool permitted = false;
  double measured_radps = 0;  ///< of the joint, fresh
  Twist measured{};           ///< of the base, of a channel that takes a twist
};

/// What the sender may do in this cycle.
struct Permission {
  ChannelMask motion = 0;  ///< the channels that may be moved
  bool guard_has_bus = false;
  std::span<const Slowing> slowing = {};  ///< by channel; none: nothing is slowed
};

/// Built once from the allow-lists of the drivers; refuses all else. Pure but for its counts.
class FrameGate final {
 public:
  static constexpr std::size_t kMaxLinks = 32;

  /// At start-up. `driver` must outlive the gate. Throws std::runtime_error when there are too many
  /// drivers or links, or when two drivers of one bus would send the same frame and do not share
  /// it.
  void add(std::size_t link, const Actuator& driver);

  /// While a channel is slowed, a set point passes that is no faster than its wheel, in its
  /// direction, and no faster than the one before; of a twist both its parts are.
  FrameVerdict admit(std::size_t link, const Message& message, const Actuator& from,
                     const Permission& permission, Time now);

  /// The next ramp of this channel begins anew.
  void end_slowing(const Actuator& driver, std::size_t channel);

  struct Counts {
    std::uint64_t passed = 0;
    std::uint64_t not_allowed = 0;
    std::uint64_t motion = 0;
  };
  /// Of one link; what was asked of a link that does not exist is counted on none.
  const Counts& counts(std::size_t link) const { return counts_.at(link); }

 private:
  struct Sender {
    std::size_t link = 0;
    const Actuator* driver = nullptr;
  };
  /// What is asked of a channel: a joint's velocity and nothing, or a twist's both parts.
  using Parts = std::array<double, 2>;
  /// By channel: the size of the last set point while slowing; infinite before the first.
  using Slowest = std::array<Parts, kMaxChannels>;

  static Parts asked_of(const Actuator& driver, const Message& message, std::size_t channel);
  static bool is_slower(const Parts& asked, const Actuator& driver, std::size_t channel,
                        const Slowing& slowing, const Parts& slowest);
  std::size_t place_of(const Actuator& driver) const;
  FrameVerdict judge(std::size_t link, const Message& message, const Actuator& from,
                     const Permission& permission, Time now);
  bool may_move(std::size_t sender, const Message& message, ChannelMask moves,
                const Permission& permission);
  bool may_slow(std::size_t sender, const Message& message, ChannelMask moves,
                const Permission& permission);
  void note_zeros(std::size_t sender, const Message& message, const Permission& permission);
  void note(std::size_t sender, std::size_t channel, const Parts& asked);

  FixedVector<Sender, kMaxAxes> senders_;
  mutable std::size_t asked_ = 0;            ///< whose place was looked for last
  std::array<Slowest, kMaxAxes> slowest_{};  ///< by sender
  std::array<Counts, kMaxLinks> counts_{};
};

/// Whether a frame is what a rule describes: id, kind and length.
inline bool matches(const FrameRule& rule, const CanFrame& frame) {
  constexpr std::uint8_t kClassicLength = 8;
  // A rule that allows more than 8 bytes speaks of CAN FD; only then an FD frame is meant.
  return rule.id == frame.id && rule.extended == frame.extended && rule.remote == frame.remote &&
         frame.fd == (rule.max_len > kClassicLength) && frame.len >= rule.min_len &&
         frame.len <= rule.max_len;
}

}  // namespace drover::engine
