#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <vector>

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

/// A beam that came back tells of the angle that is nearest to it; of two the nearer range. One
/// that falls between two angles tells of the other one as well, where no beam fell: beams of a
/// scanner stand as far apart as the angles do, and would leave a gap beside each two that share
/// one.
void fill_angles(const ScanTold& scan, double part_rad, std::span<float> ranges,
                 float* intensities) {
  constexpr float kNothingCameBack = -1;
  constexpr double kBeside = 0.75;  // of the way from one angle to the next
  const auto angles = static_cast<std::int64_t>(ranges.size());
  const auto place = [&](std::int64_t i) {
    return static_cast<std::size_t>((i + angles) % angles);
  };
  std::vector<float> beside(ranges.size(), kNothingKnown);
  std::fill(ranges.begin(), ranges.end(), kNothingKnown);
  const auto each = [&](const auto& take) {
    for (const ScanTold::Point& point : scan.points) {
      if (!std::isfinite(point.bearing_rad)) continue;
      const double at = (wrap_rad(point.bearing_rad) + kPi) / part_rad;
      const double nearest = std::round(at);
      take(point, static_cast<std::int64_t>(nearest), at - nearest);
    }
  };
  each([&](const ScanTold::Point& point, std::int64_t nearest, double) {
    const std::size_t i = place(nearest);
    const auto range = static_cast<float>(point.range_m);
    if (!(range > 0)) {
      if (std::isnan(ranges[i])) ranges[i] = kNothingCameBack;
    } else if (!(ranges[i] > 0 && ranges[i] <= range)) {
      ranges[i] = range;
      intensities[i] = static_cast<float>(point.intensity);
    }
  });
  each([&](const ScanTold::Point& point, std::int64_t nearest, double off) {
    const std::size_t i = place(nearest + (off < 0 ? -1 : 1));
    const auto range = static_cast<float>(point.range_m);
    if (!(range > 0) || 1 - std::abs(off) > kBeside) return;
    if (!std::isnan(ranges[i]) || beside[i] <= range) return;
    beside[i] = range;
    intensities[i] = static_cast<float>(point.intensity);
  });
  for (std::size_t i = 0; i < ranges.size(); ++i) {
    if (std::isnan(ranges[i])) ranges[i] = beside[i];
    if (ranges[i] == kNothingCameBack) ranges[i] = kNothingKnown;
  }
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
  message.angle_min_ = static_cast<float>(-kPi);
  message.angle_increment_ = static_cast<float>(part_rad);
  message.angle_max_ = static_cast<float>(-kPi + part_rad * static_cast<double>(angles - 1));
  message.scan_time_ = static_cast<float>(scan.turn_Hz > 0 ? 1 / scan.turn_Hz : 0);
  message.range_min_ = static_cast<float>(limits.min_m);
  message.range_max_ = static_cast<float>(limits.max_m);
  auto* ranges = arena.fill(message.ranges_, angles);
  auto* intensities = arena.fill(message.intensities_, angles);
  fill_angles(scan, part_rad, {ranges, angles}, intensities);
  return message;
}

}  // namespace drover::ros2
