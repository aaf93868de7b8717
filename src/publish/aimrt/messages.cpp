#include "publish/aimrt/messages.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>
#include <utility>

#include "drover/angle.h"
#include "publish/aimrt/json_form.h"
#include "publish/aimrt/sensor.pb.h"

namespace drover::publish::aimrt {

namespace {

namespace pb = ::aimrt::protocols;

constexpr const char* kBaseFrame = "base_link";
constexpr std::array<std::pair<Line, const char*>, 3> kTouchLines{
    {{Line::bumper, "bumper"}, {Line::zone_far, "zone_far"}, {Line::zone_near, "zone_near"}}};

void fill(pb::common::Header& header, Time time, const char* frame, const Stamping& stamping) {
  const auto wall_ns = (time.time_since_epoch() + stamping.wall_minus_monotonic).count();
  header.set_time_stamp(wall_ns > 0 ? static_cast<std::uint64_t>(wall_ns) : 0);
  header.set_frame_id(frame);
  header.set_sequence_num(stamping.sequence);
}

void fill(pb::geometry::Vector3& into, const Vector3& v) {
  into.set_x(v.x);
  into.set_y(v.y);
  into.set_z(v.z);
}

/// A yaw that nobody knows: half a turn either way.
constexpr double kUnknownYaw_rad = kPi;

double yaw_of(const Quaternion& q) {
  return std::atan2(2 * (q.w * q.z + q.x * q.y), 1 - 2 * (q.y * q.y + q.z * q.z));
}

/// `q` turned about the vertical.
Quaternion turned(const Quaternion& q, double yaw_rad) {
  const double c = std::cos(yaw_rad / 2);
  const double s = std::sin(yaw_rad / 2);
  return {c * q.w - s * q.z, c * q.x - s * q.y, c * q.y + s * q.x, c * q.z + s * q.w};
}

struct Orientation {
  Quaternion rotation;
  double yaw_sigma_rad = kUnknownYaw_rad;
};

/// Roll and pitch are the sensor's, its yaw counts from anywhere. Where the robot's yaw is known it
/// is that one, at the sample's instant; otherwise the sensor's, told as unknown.
Orientation orientation_of(const Snapshot& snapshot) {
  const auto& q = snapshot.imu.sample.orientation;
  const Pose& pose = snapshot.pose;
  if (!std::isfinite(pose.yaw_sigma_rad) || pose.time == kNever) return {q, kUnknownYaw_rad};
  const double since_s = to_s(pose.time - snapshot.imu.time);
  const double yaw_rad = pose.yaw_rad - pose.wz_radps * since_s;
  return {turned(q, wrap_rad(yaw_rad - yaw_of(q))), pose.yaw_sigma_rad};
}

/// The same rotation, told by the one of its two quaternions that is nearer to `near`.
Quaternion nearer(const Quaternion& q, const Quaternion& near) {
  const double along = q.w * near.w + q.x * near.x + q.y * near.y + q.z * near.z;
  return along < 0 ? Quaternion{-q.w, -q.x, -q.y, -q.z} : q;
}

bool is_heard(const AxisSnapshot& axis) {
  return axis.health == SourceState::fresh && axis.last_motion != kNever;
}

template <class Message>
std::string written(const Message& message, Content content) {
  return content == Content::json ? json_form(message) : message.SerializeAsString();
}

/// Appends a 3 x 3 matrix with the variance on its diagonal; zeros when sigma is absent.
template <class Values>
void fill_covariance(Values& into, double sigma) {
  const double variance = std::isfinite(sigma) ? sigma * sigma : 0;
  for (int i = 0; i < 9; ++i) into.Add(i % 4 == 0 ? variance : 0);
}

/// A beat of the timer before a tenth of a second is over.
constexpr Duration kTouchPeriod = std::chrono::milliseconds(90);

bool has_touch_lines(const Snapshot& snapshot) {
  return std::any_of(snapshot.line_configured.begin(), snapshot.line_configured.end(),
                     [i = std::size_t{0}](bool configured) mutable {
                       return static_cast<Line>(i++) != Line::estop && configured;
                     });
}

}  // namespace

Time joint_time(const Snapshot& snapshot) {
  Time oldest = snapshot.time;
  for (const auto& axis : snapshot.axes)
    if (is_heard(axis)) oldest = std::min(oldest, axis.last_motion);
  return oldest;
}

Time next_joint_time(const Snapshot& snapshot, Time last) {
  const Time heard = joint_time(snapshot);
  const Time at = heard > last ? heard : snapshot.time;
  return at > last ? at : kNever;
}

std::string joint_state(const Snapshot& snapshot, Time at, const Stamping& stamping,
                        Content content) {
  pb::sensor::JointState message;
  for (const auto& axis : snapshot.axes) {
    auto& joint = *message.add_joints();
    joint.set_name(std::string(axis.joint.view()));
    const bool heard = is_heard(axis);
    joint.set_position(heard ? axis.motion.position_rad : kAbsent);
    joint.set_velocity(heard ? axis.motion.velocity_radps : kAbsent);
    joint.set_effort(heard ? axis.motion.effort_Nm : kAbsent);
  }
  fill(*message.mutable_header(), at, kBaseFrame, stamping);
  return written(message, content);
}

Quaternion imu_orientation(const Snapshot& snapshot, const Quaternion& last) {
  if (!snapshot.imu.sample.has_orientation) return last;
  return nearer(orientation_of(snapshot).rotation, last);
}

double imu_yaw_sigma_rad(const Snapshot& snapshot) {
  return orientation_of(snapshot).yaw_sigma_rad;
}

std::string imu_state(const Snapshot& snapshot, const Stamping& stamping, Content content,
                      const Quaternion& last) {
  const auto& imu = snapshot.imu;
  pb::sensor::ImuState message;
  fill(*message.mutable_header(), imu.time, kBaseFrame, stamping);

  const Orientation told = orientation_of(snapshot);
  auto& orientation = *message.mutable_orientation();
  orientation.set_w(1);
  if (imu.sample.has_orientation) {
    const Quaternion q = nearer(told.rotation, last);
    orientation.set_x(q.x);
    orientation.set_y(q.y);
    orientation.set_z(q.z);
    orientation.set_w(q.w);
  }
  auto& orientation_covariance = *message.mutable_orientation_covariance();
  fill_covariance(orientation_covariance, imu.orientation_sigma_rad);
  if (!imu.sample.has_orientation) {
    orientation_covariance.Set(0, -1);
  } else if (std::isfinite(imu.orientation_sigma_rad)) {
    orientation_covariance.Set(8, told.yaw_sigma_rad * told.yaw_sigma_rad);
  }

  const auto& rate = imu.sample.angular_velocity_radps;
  const auto& bias = imu.gyro_bias_radps;
  fill(*message.mutable_angular_velocity(), {rate.x - bias.x, rate.y - bias.y, rate.z - bias.z});
  // A sample at the end of its range is a bound, no measurement.
  const auto sigma = [&imu](double known) { return imu.sample.saturated ? kAbsent : known; };
  fill_covariance(*message.mutable_angular_velocity_covariance(),
                  sigma(imu.angular_velocity_sigma_radps));

  fill(*message.mutable_linear_acceleration(), imu.sample.acceleration_mps2);
  fill_covariance(*message.mutable_linear_acceleration_covariance(),
                  sigma(imu.acceleration_sigma_mps2));
  return written(message, content);
}

std::array<bool, kLineCount> touched(const Snapshot& snapshot) {
  std::array<bool, kLineCount> lines{};
  for (std::size_t i = 0; i < kLineCount; ++i)
    // The e-stop is in no message of touch: nothing of it is a change there.
    lines[i] = static_cast<Line>(i) != Line::estop &&
               (snapshot.line_active[i] || snapshot.line_health[i] != SourceState::fresh);
  return lines;
}

bool TouchPace::due(const Snapshot& snapshot) {
  if (!has_touch_lines(snapshot)) return false;
  const auto lines = touched(snapshot);
  const bool rests = last_ != kNever && snapshot.time - last_ < kTouchPeriod;
  if (lines == touched_ && rests) return false;
  touched_ = lines;
  last_ = snapshot.time;
  return true;
}

std::string touch_state(const Snapshot& snapshot, const Stamping& stamping, Content content) {
  pb::sensor::TouchState message;
  fill(*message.mutable_header(), snapshot.time, kBaseFrame, stamping);
  const auto lines = touched(snapshot);
  for (const auto& [line, name] : kTouchLines) {
    const auto i = static_cast<std::size_t>(line);
    if (!snapshot.line_configured[i]) continue;
    message.add_names(name);
    message.add_states()->add_pressure(lines[i] ? 1 : 0);
  }
  return written(message, content);
}

}  // namespace drover::publish::aimrt
