#include "publish/ros2/line.h"

#include <algorithm>
#include <cmath>
#include <initializer_list>

#include "json/json_text.h"
#include "publish/aimrt/messages.h"
#include "publish/names.h"
#include "publish/ros2/diagnostics.h"

namespace drover::publish::ros2 {
namespace {

using json::JsonText;
using namespace std::chrono_literals;

/// A beat of the timer before a second is over.
constexpr Duration kSlowPeriod = 990ms;

class Line final {
 public:
  explicit Line(Duration wall) : wall_(wall) { out_.open('{'); }

  void stamp(std::string_view name, Time time) { out_.key(name).integer(wall_ns(time)); }
  std::int64_t wall_ns(Time time) const { return (time.time_since_epoch() + wall_).count(); }
  void number(std::string_view name, double value) {
    out_.key(name);
    number(value);
  }
  void number(double value) { std::isfinite(value) ? out_.number(value) : out_.null(); }
  void numbers(std::string_view name, std::initializer_list<double> values) {
    out_.key(name).open('[');
    for (const double value : values) number(value);
    out_.close(']');
  }
  JsonText& out() { return out_; }
  std::string take() { return out_.close('}').take(); }

 private:
  JsonText out_;
  Duration wall_;
};

bool is_fresh(const AxisSnapshot& axis) {
  return axis.health == SourceState::fresh && axis.last_motion != kNever;
}

void joints(Line& line, const Snapshot& s, Told& told) {
  const Time at = aimrt::next_joint_time(s, told.joints);
  if (s.axes.empty() || at == kNever) return;
  told.joints = at;
  line.out().key("joints").open('{');
  line.stamp("at_ns", at);
  line.out().key("each").open('[');
  for (const AxisSnapshot& axis : s.axes) {
    const bool heard_now = is_fresh(axis);
    line.out().open('{').key("name").text(axis.joint.view());
    line.number("position_rad", heard_now ? axis.motion.position_rad : kAbsent);
    line.number("velocity_radps", heard_now ? axis.motion.velocity_radps : kAbsent);
    line.number("effort_Nm", heard_now ? axis.motion.effort_Nm : kAbsent);
    line.out().close('}');
  }
  line.out().close(']').close('}');
}

void imu(Line& line, const Snapshot& s, Told& told) {
  const ImuSnapshot& imu = s.imu;
  if (!imu.configured || imu.health != SourceState::fresh || imu.time <= told.imu) return;
  told.imu = imu.time;
  told.orientation = aimrt::imu_orientation(s, told.orientation);
  const Quaternion& q = told.orientation;
  const Vector3& rate = imu.sample.angular_velocity_radps;
  const Vector3& bias = imu.gyro_bias_radps;
  const Vector3& felt = imu.sample.acceleration_mps2;
  line.out().key("imu").open('{');
  line.stamp("at_ns", imu.time);
  if (imu.sample.has_orientation) {
    line.numbers("orientation_xyzw", {q.x, q.y, q.z, q.w});
    line.number("orientation_sigma_rad", imu.orientation_sigma_rad);
    line.number("yaw_sigma_rad", aimrt::imu_yaw_sigma_rad(s));
  }
  line.numbers("rate_radps", {rate.x - bias.x, rate.y - bias.y, rate.z - bias.z});
  line.numbers("acceleration_mps2", {felt.x, felt.y, felt.z});
  // A sample at the end of its range is a bound, no measurement.
  line.number("rate_sigma_radps",
              imu.sample.saturated ? kAbsent : imu.angular_velocity_sigma_radps);
  line.number("acceleration_sigma_mps2",
              imu.sample.saturated ? kAbsent : imu.acceleration_sigma_mps2);
  line.out().close('}');
}

std::string_view receiver_in_use(const Snapshot& s) {
  for (const SensorSnapshot& sensor : s.sensors)
    if (sensor.kind == SensorKind::receiver && sensor.in_use) return sensor.name.view();
  return {};
}

void fix(Line& line, const Snapshot& s, Told& told) {
  const GnssSnapshot& gnss = s.gnss;
  if (!gnss.configured || gnss.position_time <= told.fix) return;
  if (gnss.health != SourceState::fresh && gnss.position.quality != FixQuality::none) return;
  told.fix = gnss.position_time;
  const GnssPosition& position = gnss.position;
  line.out().key("fix").open('{');
  line.stamp("at_ns", gnss.position_time);
  line.out().key("receiver").text(receiver_in_use(s));
  line.out().key("quality").integer(static_cast<int>(position.quality));
  line.number("latitude_deg", position.latitude_deg);
  line.number("longitude_deg", position.longitude_deg);
  line.number("altitude_msl_m", position.altitude_msl_m);
  line.number("undulation_m", position.undulation_m);
  line.number("sigma_east_m", position.sigma_east_m);
  line.number("sigma_north_m", position.sigma_north_m);
  line.number("sigma_up_m", position.sigma_up_m);
  line.out().close('}');
}

void places(Line& line, const Snapshot& s, Told& told) {
  const Odometry& way = s.odometry;
  if (way.time == kNever || way.time <= told.odometry) return;
  told.odometry = way.time;
  line.out().key("odometry").open('{');
  line.stamp("at_ns", way.time);
  line.number("x_m", way.x_m);
  line.number("y_m", way.y_m);
  line.number("yaw_rad", way.yaw_rad);
  line.number("vx_mps", way.vx_mps);
  line.number("wz_radps", way.wz_radps);
  line.number("vy_mps", way.vy_mps);
  line.numbers("variances", {way.x_var, way.xy_var, way.y_var, way.x_yaw_var, way.y_yaw_var,
                             way.yaw_var, way.vx_var, way.wz_var, way.vy_var});
  line.out().close('}');
  const Pose& pose = s.pose;
  const bool placed = s.origin_set && std::isfinite(pose.position_sigma_m) &&
                      std::isfinite(pose.yaw_sigma_rad) && pose.time == way.time;
  if (!placed) return;
  line.out().key("pose").open('{');
  line.number("x_m", pose.x_m);
  line.number("y_m", pose.y_m);
  line.number("yaw_rad", pose.yaw_rad);
  line.number("position_sigma_m", pose.position_sigma_m);
  line.number("yaw_sigma_rad", pose.yaw_sigma_rad);
  line.out().close('}');
}

/// Each sample, and once a second that there is none.
void battery(Line& line, const Snapshot& s, Told& told) {
  const BatterySnapshot& pack = s.battery;
  if (!pack.configured) return;
  const bool heard = pack.health == SourceState::fresh && pack.time != kNever;
  const bool again = told.battery_at == kNever || s.time - told.battery_at >= kSlowPeriod;
  if (heard ? pack.time <= told.battery && !again : !again) return;
  told.battery_at = s.time;
  if (heard && pack.time != told.battery) told.battery_ns = line.wall_ns(pack.time);
  if (heard) told.battery = pack.time;
  const BatterySample none;
  const BatterySample& sample = heard ? pack.sample : none;
  line.out().key("battery").open('{');
  line.out().key("at_ns").integer(heard ? told.battery_ns : line.wall_ns(s.time));
  line.out().key("heard").boolean(heard);
  line.number("voltage_V", sample.voltage_V);
  line.number("current_A", sample.current_A);
  line.number("soc_percent", sample.soc_percent);
  line.number("remaining_Ah", sample.remaining_Ah);
  line.number("temperature_degC", sample.temperature_degC);
  line.out().key("flow").text(word(sample.flow));
  line.out().key("alarm").integer(static_cast<int>(sample.alarm));
  line.out().close('}');
}

void touch(Line& line, const Snapshot& s, Told& told) {
  constexpr std::array kLines{drover::Line::bumper, drover::Line::zone_far,
                              drover::Line::zone_near};
  if (!told.touch.due(s)) return;
  const auto touched = aimrt::touched(s);
  line.out().key("touch").open('{');
  line.stamp("at_ns", s.time);
  line.out().key("each").open('[');
  for (const auto one : kLines) {
    const auto i = static_cast<std::size_t>(one);
    if (!s.line_configured[i]) continue;
    line.out().open('{').key("name").text(word(one));
    line.out().key("touched").boolean(touched[i]).close('}');
  }
  line.out().close(']').close('}');
}

void scans(Line& line, std::span<const scene::sensor::SeenTurn* const> turns, Told& told) {
  bool any = false;
  for (std::size_t i = 0; i < std::min(turns.size(), told.turns.size()); ++i) {
    const Scan& scan = turns[i]->scan;
    if (scan.begin == kNever || scan.end <= told.turns[i]) continue;
    told.turns[i] = scan.end;
    if (!any) line.out().key("scans").open('[');
    any = true;
    line.out().open('{').key("name").text(turns[i]->device.view());
    line.stamp("begin_ns", scan.begin);
    line.stamp("end_ns", scan.end);
    line.number("turn_Hz", scan.turn_Hz);
    line.out().key("points").open('[');  // bearing, range, intensity, ...
    for (const ScanPoint& point : scan.points) {
      line.out().number(point.bearing_rad, 5);
      line.out().number(point.range_m, 4);
      line.out().integer(point.intensity);
    }
    line.out().close(']').close('}');
  }
  if (any) line.out().close(']');
}

}  // namespace

std::string state_line(const Snapshot& seen, Duration wall_minus_monotonic,
                       std::span<const scene::sensor::SeenTurn* const> turns, Told& told) {
  Line line(wall_minus_monotonic);
  line.stamp("at_ns", seen.time);
  joints(line, seen, told);
  imu(line, seen, told);
  fix(line, seen, told);
  places(line, seen, told);
  battery(line, seen, told);
  touch(line, seen, told);
  scans(line, turns, told);
  if (told.diagnostics_at == kNever || seen.time - told.diagnostics_at >= kSlowPeriod) {
    told.diagnostics_at = seen.time;
    write_diagnostics(line.out(), seen);
  }
  return line.take();
}

}  // namespace drover::publish::ros2
