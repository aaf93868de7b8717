// What comes on /joint_command, as lines for droverd.
#pragma once

#include <dds/dds.h>

#include <array>
#include <functional>
#include <string>

#include "drover/time.h"
#include "publish/token_bucket.h"

namespace drover::ros2 {

struct JointCommandLimits {
  Duration oldest{};       ///< by the clock of this computer, which the writer shares
  std::size_t joints = 0;  ///< of the robot
  /// Handed on: somewhat more than droverd takes, so that it tells what is too much.
  double messages_Hz = 300;
};

class JointCommandInput final {
 public:
  /// `reader` goes with its participant. `one_clock`: all writers are on this computer, so that a
  /// message that was held up is told by its age.
  JointCommandInput(dds_entity_t reader, const JointCommandLimits& limits, bool one_clock);

  /// Takes what came since the last look. Each may name other joints: none stands for another one.
  /// Of a flood most are not looked at. `wall`: UTC now, since 1970. `came`: when the first of them
  /// has, where clocks differ. False: DDS gives nothing.
  [[nodiscard]] bool take(Time now, Duration wall, Time came,
                          const std::function<void(const std::string&)>& send);

 private:
  std::string line_of(const void* sample, const dds_sample_info_t& info, Time said, Duration wall);
  const std::string& name_of(dds_instance_handle_t writer);

  struct Name {
    dds_instance_handle_t writer = 0;
    std::string name;
  };
  dds_entity_t reader_;
  JointCommandLimits limits_;
  bool one_clock_;
  publish::TokenBucket pace_;
  std::array<Name, 8> names_;  ///< of the last that were heard
  std::size_t next_name_ = 0;
};

}  // namespace drover::ros2
