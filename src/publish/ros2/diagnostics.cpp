#include "publish/ros2/diagnostics.h"

#include <cmath>
#include <string>

#include "publish/names.h"
#include "text/number.h"

namespace drover::publish::ros2 {
namespace {

using json::JsonText;

enum Level : std::uint8_t { kGood = 0, kWarning = 1, kError = 2 };

class Statuses final {
 public:
  explicit Statuses(JsonText& out) : out_(out) { out_.key("diagnostics").open('['); }
  void begin(std::string_view name, Level level, std::string_view message) {
    out_.open('{').key("name").text(name).key("level").integer(level);
    out_.key("message").text(message).key("values").open('[');
  }
  void value(std::string_view key, std::string_view text) {
    out_.open('{').key("key").text(key).key("value").text(text).close('}');
  }
  void value(std::string_view key, double number) {
    if (std::isfinite(number)) value(key, text::number_text(number));
  }
  void count(std::string_view key, std::uint64_t number) { value(key, std::to_string(number)); }
  void end() { out_.close(']').close('}'); }
  void close() { out_.close(']'); }

 private:
  JsonText& out_;
};

Level level_of(SourceState health, const Reason& reason) {
  if (health != SourceState::fresh) return kError;
  return reason.empty() ? kGood : kWarning;
}

std::string_view message_of(SourceState health, const Reason& reason) {
  return reason.empty() ? word(health) : reason.view();
}

void source(Statuses& out, const std::string& name, SourceState health,
            const SourceSnapshot& source) {
  out.begin(name, level_of(health, source.reason), message_of(health, source.reason));
  out.count("samples", source.samples);
  out.count("bad", source.bad);
  out.count("overflows", source.overflows);
}

void robot(Statuses& out, const Snapshot& s) {
  const Level level = s.stop_latched || s.nav.status == NavStatus::error ? kError
                      : s.why.empty()                                    ? kGood
                                                                         : kWarning;
  out.begin("robot", level, s.why.empty() ? "all is well" : s.why[0].view());
  for (std::size_t i = 1; i < s.why.size(); ++i) out.value("and", s.why[i].view());
  if (const auto more = more_reasons(s); !more.empty()) out.value("and", more);
  out.value("navigation", word(s.nav.status));
  out.value("place", word(s.nav.locate));
  out.value("owner", word(s.nav.owner));
  out.value("hold", word(s.hold));
  out.value("stopped_until_told", s.stop_latched ? "true" : "false");
  out.value("error_bound_m", s.nav.error_bound_m);
  out.value("guard", s.guard_alive ? "alive" : "missing");
  out.end();
}

void axes(Statuses& out, const Snapshot& s) {
  for (const AxisSnapshot& axis : s.axes) {
    const bool bad = axis.health != SourceState::fresh || axis.state == AxisState::fault;
    const Reason& why = axis.fault.empty() ? axis.source.reason : axis.fault;
    out.begin("joint " + std::string(axis.joint.view()), bad ? kError : level_of(axis.health, why),
              message_of(axis.health, why));
    out.value("state", word(axis.state));
    out.value("inverter_degC", axis.inverter_degC);
    out.value("motor_degC", axis.motor_degC);
    out.value("bus_V", axis.bus_V);
    out.value("bus_A", axis.bus_A);
    out.end();
  }
  if (!s.base.configured) return;
  const Reason& why = s.base.fault.empty() ? s.base.source.reason : s.base.fault;
  const bool bad = s.base.health != SourceState::fresh || s.base.state == AxisState::fault;
  out.begin("base", bad ? kError : level_of(s.base.health, why), message_of(s.base.health, why));
  out.value("state", word(s.base.state));
  out.value("bus_V", s.base.bus_V);
  out.end();
}

void sensors(Statuses& out, const Snapshot& s) {
  for (const SensorSnapshot& sensor : s.sensors) {
    source(out, std::string(word(sensor.kind)) + " " + std::string(sensor.name.view()),
           sensor.health, sensor.source);
    out.value("role", word(sensor.role));
    out.value("in_use", sensor.in_use ? "true" : "false");
    if (const auto* position = std::get_if<GnssPosition>(&sensor.last)) {
      out.value("quality", word(position->quality));
      out.count("satellites", static_cast<std::uint64_t>(std::max(0, position->satellites)));
      out.value("correction_age_s", position->correction_age_s);
    }
    if (const auto* pack = std::get_if<BatterySample>(&sensor.last)) {
      out.value("soc_percent", pack->soc_percent);
      out.value("min_cell_V", pack->min_cell_V);
      out.value("max_cell_V", pack->max_cell_V);
      if (!sensor.alarms.empty()) out.value("alarm", sensor.alarms.view());
    }
    out.end();
  }
  for (const ScannerSnapshot& scanner : s.scanners) {
    source(out, "scanner " + std::string(scanner.name.view()), scanner.health, scanner.source);
    out.value("turn_Hz", scanner.turn_Hz);
    out.count("points", scanner.points);
    out.end();
  }
}

void links(Statuses& out, const Snapshot& s) {
  for (std::size_t i = 0; i < kLineCount; ++i) {
    if (!s.line_configured[i]) continue;
    source(out, "line " + std::string(word(static_cast<Line>(i))), s.line_health[i],
           s.line_source[i]);
    out.value("active", s.line_active[i] ? "true" : "false");
    out.end();
  }
  for (const LinkSnapshot& link : s.links) {
    const Level level = !link.up ? kError : link.reason.empty() ? kGood : kWarning;
    out.begin("link " + std::string(link.name.view()), level,
              !link.reason.empty() ? link.reason.view()
              : link.up            ? "up"
                                   : "down");
    out.count("received", link.received);
    out.count("sent", link.sent);
    out.count("dropped", link.dropped);
    out.end();
  }
}

}  // namespace

void write_diagnostics(JsonText& out, const Snapshot& seen) {
  Statuses statuses(out);
  robot(statuses, seen);
  axes(statuses, seen);
  sensors(statuses, seen);
  links(statuses, seen);
  statuses.close();
}

}  // namespace drover::publish::ros2
