#include <cmath>
#include <limits>

#include "drover/angle.h"
#include "ros2/convert.h"

namespace drover::ros2 {
namespace {

// sensor_msgs/NavSatStatus and NavSatFix:
constexpr std::int8_t kNoFix = -1;
constexpr std::int8_t kFix = 0;
constexpr std::int8_t kSbasFix = 1;
constexpr std::int8_t kGbasFix = 2;
constexpr std::uint16_t kServices = 1 | 2 | 4 | 8;  // GPS, GLONASS, COMPASS, GALILEO
constexpr std::uint8_t kCovarianceUnknown = 0;
constexpr std::uint8_t kCovarianceDiagonal = 2;

// sensor_msgs/BatteryState:
constexpr std::uint8_t kStatusUnknown = 0;
constexpr std::uint8_t kCharging = 1;
constexpr std::uint8_t kDischarging = 2;
constexpr std::uint8_t kNotCharging = 3;
constexpr std::uint8_t kHealthUnknown = 0;
constexpr std::uint8_t kHealthGood = 1;
constexpr std::uint8_t kUnspecifiedFailure = 5;

constexpr float kNothingKnown = std::numeric_limits<float>::quiet_NaN();

std::int8_t status_of(FixQuality quality) {
  switch (quality) {
    case FixQuality::rtk_fixed:
    case FixQuality::rtk_float: return kGbasFix;
    case FixQuality::dgps: return kSbasFix;
    case FixQuality::single:
    case FixQuality::pps: return kFix;
    case FixQuality::none:
    case FixQuality::estimated:
    case FixQuality::manual:
    case FixQuality::simulator: return kNoFix;
  }
  return kNoFix;
}

std::uint8_t status_of(BatteryFlow flow) {
  switch (flow) {
    case BatteryFlow::charging: return kCharging;
    case BatteryFlow::discharging: return kDischarging;
    case BatteryFlow::idle: return kNotCharging;
    case BatteryFlow::unknown: return kStatusUnknown;
  }
  return kStatusUnknown;
}

/// A pack that complains is neither good nor has it failed.
std::uint8_t health_of(BatteryAlarm alarm) {
  switch (alarm) {
    case BatteryAlarm::none: return kHealthGood;
    case BatteryAlarm::warning: return kHealthUnknown;
    case BatteryAlarm::critical: return kUnspecifiedFailure;
  }
  return kHealthUnknown;
}

}  // namespace

sensor_msgs_msg_dds__NavSatFix_ nav_sat_fix(const FixTold& fix, Arena& arena) {
  sensor_msgs_msg_dds__NavSatFix_ message{};
  const GnssPosition& position = fix.position;
  message.header_ = {time_of(fix.at_ns), arena.text(fix.receiver)};
  message.status_ = {status_of(position.quality), kServices};
  message.latitude_ = position.latitude_deg;
  message.longitude_ = position.longitude_deg;
  message.altitude_ = position.altitude_msl_m + position.undulation_m;  // above the ellipsoid
  message.position_covariance_type_ = kCovarianceUnknown;
  const double east = position.sigma_east_m;
  const double north = position.sigma_north_m;
  if (!(east > 0 && north > 0)) return message;
  // Who does not tell the height's is taken to be twice as uncertain there, as receivers are.
  const double up = position.sigma_up_m > 0 ? position.sigma_up_m : 2 * std::max(east, north);
  message.position_covariance_type_ = kCovarianceDiagonal;
  message.position_covariance_[0] = east * east;
  message.position_covariance_[4] = north * north;
  message.position_covariance_[8] = up * up;
  return message;
}

sensor_msgs_msg_dds__BatteryState_ battery_state(const BatteryTold& battery, Arena& arena) {
  sensor_msgs_msg_dds__BatteryState_ message{};
  const BatterySample& sample = battery.sample;
  message.header_ = {time_of(battery.at_ns), arena.text(kBaseFrame)};
  message.voltage_ = static_cast<float>(sample.voltage_V);
  message.temperature_ = static_cast<float>(sample.temperature_degC);
  message.current_ = static_cast<float>(sample.current_A);  // negative while it is discharged
  message.charge_ = static_cast<float>(sample.remaining_Ah);
  message.capacity_ = message.design_capacity_ = static_cast<float>(kAbsent);
  message.percentage_ = static_cast<float>(sample.soc_percent / 100);
  message.power_supply_status_ = status_of(sample.flow);
  message.power_supply_health_ = battery.heard ? health_of(sample.alarm) : kHealthUnknown;
  message.present_ = battery.heard;
  (void)arena.fill(message.cell_voltage_, 0);
  (void)arena.fill(message.cell_temperature_, 0);
  message.location_ = arena.text("");
  message.serial_number_ = arena.text("");
  return message;
}

sensor_msgs_msg_dds__LaserScan_ laser_scan(const ScanTold& scan, const RangeLimits& limits,
                                           std::size_t angles, Arena& arena) {
  sensor_msgs_msg_dds__LaserScan_ message{};
  const Stamp_ns middle_ns = scan.begin_ns + (scan.end_ns - scan.begin_ns) / 2;
  message.header_ = {time_of(middle_ns), arena.text(scan.name)};
  const double part_rad = 2 * kPi / static_cast<double>(angles);
  message.angle_min_ = static_cast<float>(-kPi + part_rad / 2);
  message.angle_increment_ = static_cast<float>(part_rad);
  message.angle_max_ =
      static_cast<float>(-kPi + part_rad / 2 + part_rad * static_cast<double>(angles - 1));
  message.scan_time_ = static_cast<float>(scan.turn_Hz > 0 ? 1 / scan.turn_Hz : 0);
  message.range_min_ = static_cast<float>(limits.min_m);
  message.range_max_ = static_cast<float>(limits.max_m);
  auto* ranges = arena.fill(message.ranges_, angles);
  auto* intensities = arena.fill(message.intensities_, angles);
  std::fill_n(ranges, angles, kNothingKnown);
  for (const ScanTold::Point& point : scan.points) {
    if (!(point.range_m > 0) || !std::isfinite(point.bearing_rad)) continue;
    const auto i = std::min(
        static_cast<std::size_t>((wrap_rad(point.bearing_rad) + kPi) / part_rad), angles - 1);
    const auto range = static_cast<float>(point.range_m);
    if (ranges[i] <= range) continue;  // of two the nearer one
    ranges[i] = range;
    intensities[i] = static_cast<float>(point.intensity);
  }
  return message;
}

}  // namespace drover::ros2
