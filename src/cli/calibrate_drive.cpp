#include "cli/calibrate_drive.h"

#include <algorithm>
#include <cmath>

#include "drover/angle.h"

namespace drover::cli {
namespace {

using calibrate::RimRow;

/// Edges of the base in a motion that it tells or is told as a twist.
RimRow edges(const engine::BaseConfig& base, double vx_mps, double wz_radps, Time time) {
  const double half_mps = wz_radps * base.track_m * base.yaw_slip_factor / 2;
  return {to_s(time), vx_mps - half_mps, vx_mps + half_mps};
}

void add_place(calibrate::Drive& drive, engine::estimate::LocalFrame& frame,
               const GnssPosition& position, Time time) {
  if (position.quality != FixQuality::rtk_fixed) return;
  const GeodeticPoint at{position.latitude_deg, position.longitude_deg,
                         position.altitude_msl_m + position.undulation_m};
  if (!frame.has_origin())
    frame.set_origin(
        {at.latitude_deg, at.longitude_deg, std::isfinite(at.altitude_m) ? at.altitude_m : 0.0});
  const PathPoint place = frame.local(at);
  drive.places.push_back({to_s(time), place.x_m, place.y_m});
}

template <class Row>
void cut_rows(std::vector<Row>& rows, double from_s, double to_s) {
  std::erase_if(rows, [&](const Row& row) { return row.time_s < from_s || row.time_s > to_s; });
}

/// Where the base is tilted its antenna is aside of where the level arm has it: three degrees move
/// one that is 0.6 m up by 3 cm. Without an inertial sensor nobody tells.
bool is_level(const ImuSnapshot& imu) {
  constexpr double kLevel_deg = 3;
  return !(to_deg(std::hypot(imu.roll_rad, imu.pitch_rad)) > kLevel_deg);
}

/// Whether `time` is another than `last`, which it becomes.
bool is_new(Time time, Time& last) {
  if (time == kNever || time == last) return false;
  last = time;
  return true;
}

}  // namespace

std::string rollers_of(const engine::BaseConfig& base) {
  return base.kind == engine::BaseKind::mecanum
             ? "track_m and wheelbase_m of a base on mecanum wheels act as one: measure them"
             : "";
}

calibrate::Configured configured_of(const engine::EngineConfig& config) {
  calibrate::Configured configured;
  const bool twist = engine::takes_twist(config.base.kind);
  configured.wheel_radius_m = twist ? 1.0 : config.base.wheel_radius_m;
  configured.track_m = config.base.track_m;
  configured.yaw_slip_factor = config.base.yaw_slip_factor;
  configured.antenna_x_m = config.estimate.antenna_x_m;
  configured.antenna_y_m = config.estimate.antenna_y_m;
  configured.heading_baseline_offset_deg = config.estimate.heading_baseline_offset_deg;
  configured.drive_lag_s = config.navigate.drive_lag_s;
  configured.skids = config.base.kind == engine::BaseKind::skid_steer;
  return configured;
}

RimRow DriveOfLog::rims_of(const LoggedMotion& motion, Time time) const {
  if (motion.by_rims) return {to_s(time), motion.first, motion.second};
  return edges(base_, motion.first, motion.second, time);
}

void DriveOfLog::take(const LogRow& row) {
  if (row.motion) drive.rims.push_back(rims_of(*row.motion, row.time));
  if (row.command) drive.commands.push_back(rims_of(*row.command, row.time));
  if (row.imu) drive.gyro_radps.push_back({to_s(row.time), row.imu->angular_velocity_radps.z});
  if (row.position) add_place(drive, frame_, *row.position, row.time);
  if (row.heading)
    drive.headings_rad.push_back(
        {to_s(row.time), yaw_rad_from_compass_deg(row.heading->heading_deg)});
  if (row.receiver_mps) drive.receiver_mps.push_back({to_s(row.time), *row.receiver_mps});
}

void DriveOfRecording::take(const Snapshot& snapshot) {
  snapshot.base.configured ? take_base(snapshot) : take_wheels(snapshot);
  take_receiver(snapshot.gnss, is_level(snapshot.imu));
  take_gyro(snapshot.imu);
}

void DriveOfRecording::take_wheels(const Snapshot& snapshot) {
  RimRow did;
  RimRow told;
  double times_s = 0;
  double wheels = 0;
  Time latest = kNever;
  const auto add = [&](const auto& side, double RimRow::*which) {
    const double share = base_.wheel_radius_m / static_cast<double>(side.size());
    for (const AxisId id : side) {
      if (id >= snapshot.axes.size()) continue;
      const AxisSnapshot& axis = snapshot.axes[id];
      if (axis.last_motion == kNever) return;
      did.*which += share * axis.motion.velocity_radps;
      told.*which += share * axis.commanded_velocity_radps;
      times_s += to_s(axis.last_motion);
      ++wheels;
      latest = std::max(latest, axis.last_motion);
    }
  };
  add(base_.left, &RimRow::left_mps);
  add(base_.right, &RimRow::right_mps);
  if (wheels < static_cast<double>(base_.left.size() + base_.right.size())) return;
  told.time_s = to_s(snapshot.time);
  drive.commands.push_back(told);
  if (!is_new(latest, rims_at_)) return;
  did.time_s = times_s / wheels;
  drive.rims.push_back(did);
}

void DriveOfRecording::take_base(const Snapshot& snapshot) {
  const BaseSnapshot& base = snapshot.base;
  if (base.last_motion == kNever) return;
  drive.commands.push_back(
      edges(base_, base.commanded.vx_mps, base.commanded.wz_radps, snapshot.time));
  if (is_new(base.last_motion, rims_at_))
    drive.rims.push_back(
        edges(base_, base.measured.vx_mps, base.measured.wz_radps, base.last_motion));
}

void DriveOfRecording::take_receiver(const GnssSnapshot& gnss, bool level) {
  if (is_new(gnss.position_time, place_at_) && level)
    add_place(drive, frame_, gnss.position, gnss.position_time);
  if (is_new(gnss.heading_time, heading_at_))
    drive.headings_rad.push_back(
        {to_s(gnss.heading_time), yaw_rad_from_compass_deg(gnss.receiver_heading_deg)});
  if (is_new(gnss.velocity_time, speed_at_) && std::isfinite(gnss.velocity.speed_mps))
    drive.receiver_mps.push_back({to_s(gnss.velocity_time), gnss.velocity.speed_mps});
}

void DriveOfRecording::take_gyro(const ImuSnapshot& imu) {
  if (!is_new(imu.time, gyro_at_) || imu.sample.saturated) return;
  drive.gyro_radps.push_back({to_s(imu.time), imu.sample.angular_velocity_radps.z});
}

void cut(calibrate::Drive& drive, double from_s, double to_s) {
  if (drive.rims.empty()) return;
  const double begin_s = drive.rims.front().time_s;
  from_s += begin_s;
  to_s += begin_s;
  cut_rows(drive.rims, from_s, to_s);
  cut_rows(drive.gyro_radps, from_s, to_s);
  cut_rows(drive.places, from_s, to_s);
  cut_rows(drive.headings_rad, from_s, to_s);
  cut_rows(drive.receiver_mps, from_s, to_s);
  cut_rows(drive.commands, from_s, to_s);
}

}  // namespace drover::cli
