// The snapshot as AimRT messages: serialized protobuf or JSON, without the packet around it.
//
// Field numbers and types: the .proto files beside this one. A message's time stamp is the wall
// time at which its values were true.
#pragma once

#include <array>
#include <cstdint>
#include <string>

#include "drover/snapshot.h"
#include "publish/aimrt/packet.h"

namespace drover::publish::aimrt {

struct Stamping {
  Duration wall_minus_monotonic{};
  std::uint64_t sequence = 0;
};

/// When the joints were so: the oldest heard axis' own time, that of the snapshot when none is
/// heard.
Time joint_time(const Snapshot& snapshot);

/// What the joints are stamped with, newer than `last`: joint_time(), and while a drive is late the
/// cycle's own time, so that no stamp comes twice. kNever: nothing newer is known.
Time next_joint_time(const Snapshot& snapshot, Time last);

/// Every driven axis: rad, rad/s, N*m; NaN where the drive does not tell or is not heard. `at` is
/// what it is stamped with: joint_time(), or a later instant at which nothing newer was known.
std::string joint_state(const Snapshot& snapshot, Time at, const Stamping& stamping,
                        Content content = Content::pb);

/// The orientation that imu_state() tells: of the two quaternions of a rotation the one nearer to
/// `last`, so that what is told message by message never jumps to the other side. The identity as
/// the first `last` gives w >= 0; without an orientation it stays as it was.
Quaternion imu_orientation(const Snapshot& snapshot, const Quaternion& last);

/// One sigma of that orientation's yaw: the robot's own, or of a yaw that nobody knows.
double imu_yaw_sigma_rad(const Snapshot& snapshot);

/// The inertial sensor's last sample in base_link, the learned gyro bias taken off. Its yaw is the
/// robot's own, fused one (counter-clockwise from east) with that one's variance; while that is not
/// known the sensor's, which counts from anywhere, with a variance of pi squared. Covariances are
/// diagonal; as in sensor_msgs/Imu they are all 0 when unknown, as those of a saturated sample are
/// (the truth is larger), and the orientation's first is -1 when there is no orientation (which is
/// then the identity). `last`: the orientation of the message before, see imu_orientation().
std::string imu_state(const Snapshot& snapshot, const Stamping& stamping,
                      Content content = Content::pb, const Quaternion& last = {});

/// What the robot takes for touched, by Line: a line that cannot be read is.
std::array<bool, kLineCount> touched(const Snapshot& snapshot);

/// Contacts and zones at each change, and ten times a second.
class TouchPace final {
 public:
  /// False, too, where none is configured. True counts as told.
  bool due(const Snapshot& snapshot);

 private:
  Time last_ = kNever;
  std::array<bool, kLineCount> touched_{};
};

/// The configured contacts and zones: "bumper", "zone_far", "zone_near", one pressure each: 1
/// touched() or occupied, 0 free.
std::string touch_state(const Snapshot& snapshot, const Stamping& stamping,
                        Content content = Content::pb);

}  // namespace drover::publish::aimrt
