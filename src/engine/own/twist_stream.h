// The stream of twists that a program drives the base by (ROS 2's cmd_vel): what it asks for now.
#pragma once

#include "engine/own/stream.h"

namespace drover::engine {

/// A message counts from when it came to this computer (Command::received): what was held up
/// begins nothing and ends in time.
class TwistStream final : public Stream {
 public:
  /// Silence after which it has ended; so old a message is obeyed no more.
  static constexpr Duration kTimeout = std::chrono::milliseconds(300);

  TwistStream();

  /// `busy`: why it cannot be followed now; empty: it can.
  void take(const FollowTwist& follow, Time received, std::string_view busy, Time now);
  using Stream::refuse;

  bool wants_motion() const { return !is_zero(wanted()); }
  Twist wanted() const { return following() ? wanted_ : Twist{}; }

 private:
  Twist wanted_;
  Time newest_ = kNever;
};

}  // namespace drover::engine
