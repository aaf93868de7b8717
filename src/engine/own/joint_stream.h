// The stream of joint commands: what it asks for now.
#pragma once

#include "engine/base/kinematics.h"
#include "engine/own/stream.h"

namespace drover::engine {

class JointStream final : public Stream {
 public:
  /// One that is silent for `timeout` has ended.
  explicit JointStream(Duration timeout);

  /// `busy`: why joint commands cannot be followed now; empty: they can.
  void take(const JointTargets& targets, std::string_view busy, Time now);

  bool wants_motion() const;
  /// rad/s by AxisId; zero for joints that the last message did not name, and none behind the
  /// last that it did.
  const JointVelocities& velocities_radps() const { return following() ? velocities_ : none_; }

 private:
  JointVelocities velocities_;
  JointVelocities none_;
};

}  // namespace drover::engine
