// From what is measured to what the history has: refused when it is absurd, late or repeated.
#include <algorithm>
#include <cmath>

#include "engine/estimate/estimator.h"
#include "engine/estimate/model_gnss.h"
#include "engine/estimate/model_heading.h"

namespace drover::engine {
namespace {

using namespace estimate;

constexpr double kFastestRim_mps = 20.0;  // faster is a broken encoder, not a field robot
constexpr double kFarthest_m = 100000.0;  // from the origin: another place, not this field

}  // namespace

[[gnu::hot]] void Estimator::on_measurement(const Measurement& measurement) {
  if (measurement.time == kNever) return;
  // Nothing is true later than it was heard.
  const Time time = measurement.received == kNever
                        ? measurement.time
                        : std::min(measurement.time, measurement.received);
  // A GNSS velocity is not used: it is the same carrier phase as the position, and later.
  if (const auto* motion = std::get_if<AxisMotion>(&measurement.value)) {
    on_joint(*motion, time);
  } else if (const auto* body = std::get_if<BodyMotion>(&measurement.value)) {
    on_body(*body, time);
  } else if (const auto* imu = std::get_if<ImuSample>(&measurement.value)) {
    on_imu(*imu, measurement.source, time);
  } else if (const auto* position = std::get_if<GnssPosition>(&measurement.value)) {
    on_position(*position, measurement.source, time);
  } else if (const auto* heading = std::get_if<GnssHeading>(&measurement.value)) {
    on_heading(*heading, measurement.source, time);
  }
}

[[gnu::hot]] void Estimator::on_joint(const AxisMotion& motion, Time time) {
  if (takes_twist(base_) || motion.axis >= joint_count_ || !joints_[motion.axis]) return;
  if (!(std::abs(rim_mps(base_, motion.velocity_radps)) <= kFastestRim_mps)) {
    ++counters_.absurd;
    return;
  }
  const Time slot = time - time.time_since_epoch() % kSlot;
  if (too_old(slot)) return;
  edit_slot(slot, [&](MotionInput& input) {
    input.joints_radps.resize(joint_count_);
    input.present.set(motion.axis);
    input.joints_radps[motion.axis] = motion.velocity_radps;
  });
}

void Estimator::on_body(const BodyMotion& body, Time time) {
  if (!takes_twist(base_)) return;
  const bool sane = fastest_mps(base_, body.twist) <= kFastestRim_mps && body.vx_var >= 0 &&
                    body.wz_var >= 0 && body.vy_var >= 0 &&
                    std::isfinite(body.vx_var + body.wz_var + body.vy_var);
  if (!sane) {
    ++counters_.absurd;
    return;
  }
  const Time slot = time - time.time_since_epoch() % kSlot;
  if (too_old(slot)) return;
  edit_slot(slot, [&](MotionInput& input) { input.body = body; });
}

void Estimator::on_imu(const ImuSample& sample, std::uint8_t source, Time time) {
  if (source >= imus_.size() || too_old(time)) return;
  ImuIntake& imu = imus_[source];
  const bool standing = history_.before(history_.dirty()).standing_since != kNever;
  switch (imu.take(sample, time, standing, estimate_.pose.vx_mps)) {
    case ImuIntake::Verdict::absurd: ++counters_.absurd; return;
    case ImuIntake::Verdict::repeated: ++counters_.repeated; return;
    case ImuIntake::Verdict::taken: break;
  }
  if (source != imu_in_use_) return;  // it learns its zero and its tilt until it is needed
  if (!imu.finished() || imu.finished()->slot < history_.base().time) return;
  edit_slot(imu.finished()->slot, [&](MotionInput& input) {
    input.turn = imu.finished()->rate;
    input.turn->source = source;
  });
}

/// To what is known of a slot so far; in its place, because every frame of every joint does it.
template <class Edit>
[[gnu::hot]] void Estimator::edit_slot(Time slot, const Edit& edit) {
  const std::size_t i = history_.find(slot, 0);
  if (i < history_.size()) {
    edit(*std::get_if<MotionInput>(&history_.at(i).input));
    return history_.mark_dirty(i);
  }
  MotionInput input;
  edit(input);
  insert(slot, input);
}

void Estimator::on_position(const GnssPosition& position, std::uint8_t receiver, Time time) {
  if (!frame_.has_origin()) return;
  AntennaPosition antenna;
  antenna.receiver = receiver;
  antenna.quality = class_of(position, config_);
  if (antenna.quality == GnssClass::none) return;
  const double altitude_m = position.altitude_msl_m + position.undulation_m;
  const PathPoint point = frame_.local({.latitude_deg = position.latitude_deg,
                                        .longitude_deg = position.longitude_deg,
                                        .altitude_m = altitude_m});
  antenna.x_m = point.x_m;
  antenna.y_m = point.y_m;
  antenna.sigma_x_m = sigma_m(antenna.quality, position.sigma_east_m, config_);
  antenna.sigma_y_m = sigma_m(antenna.quality, position.sigma_north_m, config_);
  antenna.told_sigma = position.sigma_east_m > 0 && position.sigma_north_m > 0;
  const bool sane = std::abs(position.latitude_deg) <= 90 &&
                    std::abs(position.longitude_deg) <= 180 &&
                    std::hypot(antenna.x_m, antenna.y_m) <= kFarthest_m;
  if (!sane) {
    ++counters_.absurd;
    return;
  }
  if (std::isfinite(altitude_m)) altitude_m_ = altitude_m;
  insert(time, antenna);
}

void Estimator::on_heading(const GnssHeading& heading, std::uint8_t receiver, Time time) {
  if (!(std::abs(heading.heading_deg) <= 360)) {
    ++counters_.absurd;
    return;
  }
  insert(time, YawInput{yaw_of_baseline_rad(heading.heading_deg, antenna_of(config_, receiver)),
                        receiver});
}

[[gnu::hot]] bool Estimator::too_old(Time time) {
  const bool old = time < history_.base().time || time < now_ - max_delay_;
  counters_.late += old ? 1 : 0;
  return old;
}

void Estimator::insert(Time time, const Input& input) {
  if (too_old(time)) return;
  if (history_.find(time, input.index()) < history_.size()) {
    ++counters_.repeated;
    return;
  }
  if (history_.full()) {
    replay();
    history_.drop_oldest();
    if (too_old(time)) return;
  }
  history_.insert(time, input);
}

}  // namespace drover::engine
