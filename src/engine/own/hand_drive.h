// A person drives with a key that is held down: the dead-man, and when he may begin.
#pragma once

#include <array>

#include "drover/command.h"
#include "drover/twist.h"
#include "engine/event_queue.h"

namespace drover::engine {

/// What is asked counts for kHeld, and nothing moves before it was asked for so long without a gap:
/// what comes in a burst, because a line or a program hung, is not a key that is held. What hinders
/// spoils the whole row: the key has to be let go before it drives again.
/// It begins with a key, and lasts while he who began says anything, also that he wants rest:
/// motion ends with kHeld of silence, his hold with kLasts, in which he can say so.
class HandDrive final {
 public:
  /// How long one message is obeyed.
  static constexpr Duration kHeld = kKeyHeld;
  /// Silence after which it has ended, and somebody else may begin. Whoever let the key go notices
  /// that after kHeld himself, and says from then on that he wants rest.
  static constexpr Duration kLasts = 2 * kHeld;

  /// `busy`: why nobody may drive by hand now; empty: he may. `note` goes with the answer.
  void take(const Command& command, const DriveByHand& wanted, const Reason& busy,
            const Reason& note, Time now, EventQueue& events);
  /// Ends it for a cause that lies elsewhere.
  void end(const Reason& why, Time now, EventQueue& events);
  /// Once a cycle: notices silence, and that the key was let go.
  void step(Time now);

  /// Somebody has the robot in his hand, whether it moves or not.
  bool active() const { return active_; }
  bool active_of(std::uint64_t hand) const { return active_ && hand_ == hand; }
  /// It has moved, or is to, since it began.
  bool moves() const { return moves_; }
  /// What is wanted now; zero while the key is up.
  Twist wanted() const { return moves_ ? wanted_ : Twist{}; }

 private:
  bool holds(Time at) const { return key_ != kNever && at - key_ <= kHeld; }
  struct Rival {
    std::uint64_t hand = 0;
    Time key = kNever;
  };
  /// His, or the place of him who was not heard for the longest time.
  Rival& rival(std::uint64_t hand);
  void change_hands(std::uint64_t to, Time at);
  void press(const Reason& busy, Time at);

  bool active_ = false;
  bool moves_ = false;
  bool spoiled_ = false;            ///< this row of keys moves nothing any more
  std::uint64_t hand_ = 0;          ///< whose it is; also of a row that has not begun anything
  Time heard_ = kNever;             ///< anything of his
  std::array<Rival, 32> rivals_{};  ///< who pressed a key meanwhile; the socket takes no more
  Time row_ = kNever;               ///< the first key of this row, since he last wanted rest
  Time key_ = kNever;               ///< and the last
  Twist wanted_;
  Reason ended_;  ///< why this row is spoiled
};

}  // namespace drover::engine
