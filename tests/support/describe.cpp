// Text of measurements and frames, compact and the same on every machine.
#include "support/describe.h"

#include <cmath>
#include <cstdio>
#include <stdexcept>

namespace drover::test {
namespace {

class Line {
 public:
  explicit Line(std::string name) : text_(std::move(name)) {}
  Line& number(const char* key, double value, const char* pattern = "%.6g") {
    if (std::isnan(value)) return *this;
    char buffer[64];
    // What a rotation leaves of zero differs between machines. Adding zero turns minus zero into
    // it.
    const double tidy = std::abs(value) < 1e-12 ? 0.0 : value + 0.0;
    std::snprintf(buffer, sizeof buffer, pattern, tidy);
    return word(key, buffer);
  }
  Line& integer(const char* key, long long value) { return word(key, std::to_string(value)); }
  Line& word(const char* key, const std::string& value) {
    text_ += ' ';
    text_ += key;
    text_ += '=';
    text_ += value;
    return *this;
  }
  std::string text() const { return text_; }

 private:
  std::string text_;
};

const char* name(AxisState state) {
  switch (state) {
    case AxisState::unknown: return "unknown";
    case AxisState::idle: return "idle";
    case AxisState::arming: return "arming";
    case AxisState::running: return "running";
    case AxisState::fault: return "fault";
  }
  return "?";
}

const char* line_name(drover::Line line) {
  switch (line) {
    case drover::Line::estop: return "estop";
    case drover::Line::bumper: return "bumper";
    case drover::Line::zone_far: return "zone_far";
    case drover::Line::zone_near: return "zone_near";
  }
  return "?";
}

const char* name(BatteryFlow flow) {
  switch (flow) {
    case BatteryFlow::unknown: return "unknown";
    case BatteryFlow::idle: return "idle";
    case BatteryFlow::charging: return "charging";
    case BatteryFlow::discharging: return "discharging";
  }
  return "?";
}

struct Describe {
  std::string operator()(const std::monostate&) const { return "empty"; }
  std::string operator()(const AxisMotion& m) const {
    return Line("axis_motion")
        .integer("axis", m.axis)
        .number("position_rad", m.position_rad)
        .number("velocity_radps", m.velocity_radps)
        .number("effort_Nm", m.effort_Nm)
        .text();
  }
  std::string operator()(const AxisStatus& m) const {
    Line line("axis_status");
    line.integer("axis", m.axis).word("state", name(m.state));
    if (m.error_code != 0) {
      char buffer[32];
      std::snprintf(buffer, sizeof buffer, "0x%llx", static_cast<unsigned long long>(m.error_code));
      line.word("error_code", buffer);
    }
    return with_words(line, "reason");
  }
  std::string operator()(const AxisTemperature& m) const {
    return Line("axis_temperature")
        .integer("axis", m.axis)
        .number("inverter_degC", m.inverter_degC)
        .number("motor_degC", m.motor_degC)
        .text();
  }
  std::string operator()(const AxisSupply& m) const {
    return Line("axis_supply")
        .integer("axis", m.axis)
        .number("bus_V", m.bus_V)
        .number("bus_A", m.bus_A)
        .text();
  }
  std::string operator()(const GnssPosition& m) const {
    return Line("gnss_position")
        .number("latitude_deg", m.latitude_deg, "%.10f")
        .number("longitude_deg", m.longitude_deg, "%.10f")
        .number("altitude_msl_m", m.altitude_msl_m)
        .number("undulation_m", m.undulation_m)
        .integer("quality", static_cast<int>(m.quality))
        .integer("satellites", m.satellites)
        .number("hdop", m.hdop)
        .number("correction_age_s", m.correction_age_s)
        .number("sigma_east_m", m.sigma_east_m)
        .number("sigma_north_m", m.sigma_north_m)
        .text();
  }
  std::string operator()(const GnssVelocity& m) const {
    return Line("gnss_velocity")
        .number("speed_mps", m.speed_mps)
        .number("course_deg", m.course_deg)
        .text();
  }
  std::string operator()(const GnssHeading& m) const {
    return Line("gnss_heading").number("heading_deg", m.heading_deg).text();
  }
  std::string operator()(const LineState& m) const {
    return Line("line_state")
        .word("line", line_name(m.line))
        .word("active", m.active ? "true" : "false")
        .text();
  }
  std::string operator()(const ImuSample& m) const {
    Line line("imu_sample");
    line.number("ax_mps2", m.acceleration_mps2.x)
        .number("ay_mps2", m.acceleration_mps2.y)
        .number("az_mps2", m.acceleration_mps2.z)
        .number("wx_radps", m.angular_velocity_radps.x)
        .number("wy_radps", m.angular_velocity_radps.y)
        .number("wz_radps", m.angular_velocity_radps.z);
    if (m.has_orientation)
      line.number("qw", m.orientation.w)
          .number("qx", m.orientation.x)
          .number("qy", m.orientation.y)
          .number("qz", m.orientation.z);
    if (m.has_magnetic_field)
      line.number("mx", m.magnetic_field.x)
          .number("my", m.magnetic_field.y)
          .number("mz", m.magnetic_field.z);
    line.number("temperature_degC", m.temperature_degC);
    if (m.saturated) line.word("saturated", "true");
    return line.text();
  }
  std::string operator()(const BatterySample& m) const {
    Line line("battery");
    line.number("voltage_V", m.voltage_V)
        .number("current_A", m.current_A)
        .number("soc_percent", m.soc_percent)
        .number("remaining_Ah", m.remaining_Ah)
        .number("temperature_degC", m.temperature_degC)
        .number("mosfet_degC", m.mosfet_degC)
        .number("min_cell_V", m.min_cell_V)
        .number("max_cell_V", m.max_cell_V)
        .word("flow", name(m.flow));
    if (m.charger_connected) line.word("charger", "true");
    if (m.charges) line.word("charges", "true");
    return with_words(line, "alarm");
  }
  std::string operator()(const BodyMotion& m) const {
    return Line("body_motion")
        .number("vx_mps", m.twist.vx_mps)
        .number("wz_radps", m.twist.wz_radps)
        .word("known", m.known ? "true" : "false")
        .word("standing", m.standing ? "true" : "false")
        .number("steering_rad", m.steering_rad)
        .text();
  }

  std::string with_words(Line& line, const char* key) const {
    if (!words.empty()) line.word(key, '"' + std::string(words.view()) + '"');
    return line.text();
  }
  const Reason& words;
};

int nibble(char c) {
  if (c >= '0' && c <= '9') return c - '0';
  if (c >= 'a' && c <= 'f') return c - 'a' + 10;
  if (c >= 'A' && c <= 'F') return c - 'A' + 10;
  throw std::invalid_argument(std::string("not a hex digit: ") + c);
}

}  // namespace

std::string describe(const Measurement& measurement, const Reason& words) {
  return std::visit(Describe{words}, measurement.value);
}

std::string describe(const DriverOut& out, const Device& device) {
  std::string text;
  for (const Measurement& m : out.measurements) {
    if (!text.empty()) text += "; ";
    text += describe(m, device.words(m));
  }
  return text.empty() ? "nothing" : text;
}

std::string describe(const DriverOut& out) {
  struct : Device {
    void on_link_up(Time) override {}
    void on_tick(Time, DriverOut&) override {}
    SourceHealth health(Time) const override { return {}; }
  } silent;
  return describe(out, silent);
}

std::string describe(const CanFrame& frame) {
  char buffer[16];
  std::snprintf(buffer, sizeof buffer, frame.extended ? "%08X#" : "%03X#", frame.id);
  std::string text = buffer;
  if (frame.remote) text += 'R';
  for (const std::uint8_t byte : frame.payload()) {
    std::snprintf(buffer, sizeof buffer, "%02X", byte);
    text += buffer;
  }
  return text;
}

CanFrame parse_frame(std::string_view text) {
  const auto hash = text.find('#');
  if (hash != 3 && hash != 8) throw std::invalid_argument("id must have 3 or 8 digits");
  CanFrame frame;
  frame.extended = hash == 8;
  for (const char c : text.substr(0, hash))
    frame.id = frame.id << 4U | static_cast<std::uint32_t>(nibble(c));
  std::string_view data = text.substr(hash + 1);
  if (!data.empty() && data[0] == 'R') {
    frame.remote = true;
    data.remove_prefix(1);
  }
  if (data.size() % 2 != 0 || data.size() > 2 * frame.data.size())
    throw std::invalid_argument("data must be whole bytes, 64 at most");
  for (std::size_t i = 0; i < data.size(); i += 2)
    frame.data[frame.len++] = static_cast<std::uint8_t>(nibble(data[i]) << 4 | nibble(data[i + 1]));
  return frame;
}

}  // namespace drover::test
