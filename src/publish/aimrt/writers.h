// Whose joint commands are followed when two programs write them at once.
//
// DDS tells who sent a message, the broker does not. What then tells programs apart is in the
// message: the family of names, how it is written, frame_id, whether it carries a time_stamp, and
// the sequence_num, which only its own program counts on. The one that is followed keeps the joints
// until it is silent. What two programs without a count have in common is judged by what they do:
// time stamps that interleave, velocities that jump to and fro.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "publish/aimrt/joint_command.h"
#include "publish/aimrt/packet.h"
#include "publish/aimrt/topic.h"
#include "publish/token_bucket.h"

namespace drover::publish::aimrt {

/// What one message tells of the program that wrote it.
struct Writer {
  Names names = Names::document;
  Content content = Content::pb;
  std::uint64_t stamp_ns = 0;  ///< 0: none
  std::uint64_t sequence = 0;  ///< 0: none
  std::string frame_id{};
  std::string guid{};  ///< its writer of DDS, which no other program has; empty: of the broker
};

class Writers final {
 public:
  /// A program that was not followed for longer than `silence` has lost the joints.
  explicit Writers(Duration silence) : silence_(silence) {}

  /// Why a message of `writer` is not followed; empty: nothing here hinders it. `rests`: all its
  /// velocities are 0, as at the beginning of a stream.
  Reason hindrance(const Writer& writer, bool rests, Time now);
  /// A message that is sound in all other respects, of the joints that it tells something. Why it
  /// is not followed all the same; empty: it may be.
  Reason weigh(const Writer& writer, const JointTargets& targets, Time now);
  /// Then: its program has the joints.
  void take(const Writer& writer, Time now);

  /// Which programs write at once; empty when there was only one for the last second.
  std::string_view rivals(Time now) const;
  /// Messages that were refused because another program writes too.
  std::uint64_t refused() const { return refused_; }

 private:
  struct Asked {
    double velocity_radps = 0;
    double position_rad = 0;
  };
  using Asks = std::array<std::optional<Asked>, 3>;  ///< the newest first

  bool is_owner(const Writer& writer) const;
  bool jumps_to_and_fro(const JointTargets& targets);
  Reason refuse(std::string why, Time now);

  Duration silence_;
  std::optional<Writer> owner_;  ///< its last message that was followed
  bool counts_ = false;          ///< its second message or a later one
  Time heard_ = kNever;
  Time counted_twice_ = kNever;  ///< a number with two time stamps
  bool followed_since_late_ = false;
  std::array<Asks, kMaxAxes> before_;  ///< by axis
  /// One program alone is odd now and then, two are all the time.
  TokenBucket oddities_{3, 5};
  std::string text_;
  Time told_ = kNever;         ///< when that was noticed last
  Time mixed_until_ = kNever;  ///< nobody is followed: whose is whose cannot be told
  std::uint64_t refused_ = 0;
};

}  // namespace drover::publish::aimrt
