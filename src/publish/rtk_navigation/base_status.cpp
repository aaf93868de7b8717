// The `base_status` topic: the snapshot in the document's words.
#include "publish/rtk_navigation/base_status.h"

#include <algorithm>
#include <cmath>

#include "drover/angle.h"
#include "json/json_text.h"
#include "publish/names.h"
#include "publish/spelling.h"

namespace drover::publish {
namespace {

// Decimals of what is published. Finer digits are noise of the arithmetic, and clients show them.
// Places have more than the receiver can tell: tracks are recorded from them.
constexpr int kElectric = 2;  // 0.01 A, V, Ah
constexpr int kPercent = 1;
constexpr int kWholePercent = 0;
constexpr int kDegrees_C = 1;
constexpr int kMetres = 4;
constexpr int kMetresLeft = 2;
constexpr int kBound_m = 3;
constexpr int kRadians = 5;
constexpr int kSpeed = 4;      // m/s, rad/s
constexpr int kDegrees = 3;    // of the compass
constexpr int kGeodetic = 10;  // degrees: 0.01 mm

bool drives_healthy(const Snapshot& snapshot) {
  if (const BaseSnapshot& base = snapshot.base; base.configured)
    return base.health == SourceState::fresh && base.state != AxisState::fault;
  // The document's motor is the vehicle's: an arm has a status of its own.
  return !snapshot.axes.empty() &&
         std::all_of(snapshot.axes.begin(), snapshot.axes.end(), [](const AxisSnapshot& axis) {
           return axis.group != 0 ||
                  (axis.health == SourceState::fresh && axis.state != AxisState::fault);
         });
}

/// Scanners and the zone contacts of others: true when there is one, and all that there are answer.
bool obstacle_sensors_healthy(const Snapshot& snapshot) {
  for (const ScannerSnapshot& scanner : snapshot.scanners)
    if (scanner.health != SourceState::fresh) return false;
  bool any = !snapshot.scanners.empty();
  for (const Line line : {Line::zone_far, Line::zone_near}) {
    const auto i = static_cast<std::size_t>(line);
    if (!snapshot.line_configured[i]) continue;
    if (snapshot.line_health[i] != SourceState::fresh) return false;
    any = true;
  }
  return any;
}

/// Heard lately, and the state of charge with it: that is what clients show.
bool known(const BatterySnapshot& battery) {
  return battery.configured && battery.health == SourceState::fresh && battery.time != kNever &&
         std::isfinite(battery.sample.soc_percent);
}

bool active(const Snapshot& snapshot, Line line) {
  const auto i = static_cast<std::size_t>(line);
  return snapshot.line_configured[i] && snapshot.line_active[i];
}

}  // namespace

int rtk_status(FixQuality quality) {
  switch (quality) {
    case FixQuality::single:
    case FixQuality::pps: return 1;
    case FixQuality::dgps: return 2;
    case FixQuality::rtk_fixed: return 4;
    case FixQuality::rtk_float: return 5;
    default: return 0;
  }
}

int robot_status(const Snapshot& snapshot) {
  constexpr int kHardEstop = 1 << 0;
  constexpr int kSoftEstop = 1 << 2;
  constexpr int kRemoteOffline = 1 << 3;
  constexpr int kFrontBumper = 1 << 4;
  const bool hard = active(snapshot, Line::estop);
  const bool bumper = active(snapshot, Line::bumper);
  return kRemoteOffline | (hard ? kHardEstop : 0) | (bumper ? kFrontBumper : 0) |
         (snapshot.stop_latched ? kSoftEstop : 0);
}

double BaseStatus::keep(double& last, double value) {
  if (std::isfinite(value)) last = value;
  return last;
}

int bms_error(const BatterySnapshot& battery) {
  if (!known(battery)) return 1;
  return battery.sample.alarm == BatteryAlarm::critical  ? 3
         : battery.sample.alarm == BatteryAlarm::warning ? 2
                                                         : 0;
}

int bms_status(const BatterySnapshot& battery) {
  constexpr int kCharger = 4;
  const int flow = battery.sample.flow == BatteryFlow::charging      ? 1
                   : battery.sample.flow == BatteryFlow::discharging ? 2
                                                                     : 0;
  return flow + (battery.sample.charger_connected ? kCharger : 0);
}

double BaseStatus::power(const Snapshot& snapshot) {
  if (config_.power == PowerUnit::percent) return soc_percent_;
  if (known(snapshot.battery)) return keep(bus_V_, snapshot.battery.sample.voltage_V);
  // Without a battery that answers the drives know the voltage; the lowest is the one that matters.
  double lowest_V = snapshot.base.bus_V;
  for (const AxisSnapshot& axis : snapshot.axes)
    if (axis.group == 0) lowest_V = std::fmin(lowest_V, axis.bus_V);
  return keep(bus_V_, lowest_V);
}

std::string BaseStatus::text(const Snapshot& snapshot) {
  const BatterySnapshot& battery = snapshot.battery;
  const NavSnapshot& nav = snapshot.nav;
  const GnssSnapshot& gnss = snapshot.gnss;
  // Clients record tracks from these messages, so pose and rtk are of one instant where there is a
  // good pose; otherwise the receiver's word while it is heard. A silent one's last word is older
  // than what was told.
  const bool located = nav.locate == LocateState::good;
  const bool receiver_fresh = gnss.health == SourceState::fresh;
  if (located || receiver_fresh) {
    keep(latitude_deg_, located ? gnss.pose_latitude_deg : gnss.position.latitude_deg);
    keep(longitude_deg_, located ? gnss.pose_longitude_deg : gnss.position.longitude_deg);
  }
  const double compass_deg = located ? compass_deg_from_yaw_rad(snapshot.pose.yaw_rad)
                             : std::isfinite(gnss.pose_heading_deg) ? gnss.pose_heading_deg
                                                                    : gnss.heading_deg;
  keep(angle_deg_, angle_deg_from_compass(config_.heading, compass_deg));

  json::JsonText out;
  out.open('{');
  out.key("bms").open('{');
  out.key("current").number(keep(current_A_, battery.sample.current_A), kElectric);
  out.key("error").integer(bms_error(battery));
  out.key("remaining_capacity").number(keep(remaining_Ah_, battery.sample.remaining_Ah), kElectric);
  out.key("soc").number(keep(soc_percent_, battery.sample.soc_percent), kPercent);
  out.key("status").integer(bms_status(battery));
  out.key("tem").number(keep(temperature_degC_, battery.sample.temperature_degC), kDegrees_C);
  out.key("voltage").number(keep(voltage_V_, battery.sample.voltage_V), kElectric);
  out.key("valid").boolean(known(battery)).close('}');

  out.key("nav").open('{');
  out.key("locate").text(spelling(nav.locate));
  out.key("obstacle").boolean(nav.obstacle);
  out.key("status").text(spelling(nav.status));
  out.key("owner").text(word(nav.owner));
  if (std::isfinite(nav.metres_left)) out.key("metres_left").number(nav.metres_left, kMetresLeft);
  if (std::isfinite(nav.error_bound_m))
    out.key("error_bound_m").number(nav.error_bound_m, kBound_m);
  out.key("why").open('[');
  for (const drover::Reason& reason : snapshot.why) out.text(reason.view());
  if (const auto more = more_reasons(snapshot); !more.empty()) out.text("and " + more);
  out.close(']').close('}');

  out.key("pose").open('{');
  out.key("x").number(keep(x_m_, snapshot.pose.x_m), kMetres);
  out.key("y").number(keep(y_m_, snapshot.pose.y_m), kMetres);
  out.key("yaw").number(keep(yaw_rad_, snapshot.pose.yaw_rad), kRadians).close('}');

  out.key("robot").open('{');
  out.key("power").number(power(snapshot),
                          config_.power == PowerUnit::percent ? kWholePercent : kElectric);
  out.key("robot_status").integer(robot_status(snapshot));
  out.key("vx").number(keep(vx_mps_, snapshot.worst_vx_mps), kSpeed);
  out.key("vy").number(keep(vy_mps_, snapshot.pose.vy_mps), kSpeed);
  const bool angle = config_.vz == TurnShown::steering_angle;
  out.key("vz").number(keep(turn_, angle ? snapshot.base.steering_rad : snapshot.pose.wz_radps),
                       kSpeed);
  out.key("valid").boolean(std::isfinite(snapshot.worst_vx_mps)).close('}');

  out.key("rtk").open('{');
  out.key("angle").number(angle_deg_ < 359.9995 ? angle_deg_ : 0, kDegrees);
  out.key("latitude").number(latitude_deg_, kGeodetic);
  out.key("longitude").number(longitude_deg_, kGeodetic);
  out.key("status").integer(receiver_fresh ? rtk_status(gnss.position.quality) : 0).close('}');

  out.key("sensor").open('{');
  out.key("imu").boolean(snapshot.imu.configured && snapshot.imu.health == SourceState::fresh);
  out.key("laser").boolean(obstacle_sensors_healthy(snapshot));
  out.key("robot").boolean(drives_healthy(snapshot)).close('}');
  return out.close('}').str();
}

}  // namespace drover::publish
