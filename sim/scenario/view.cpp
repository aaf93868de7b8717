#include "sim/scenario/view.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <sstream>

#include "drover/angle.h"

namespace drover::sim {
namespace {

constexpr std::size_t kColumns = 100;  // of the picture
constexpr std::size_t kTold = 90;      // of an event
constexpr double kSeen_m = 0.1;        // what a step on the map is worth
constexpr double kStanding_mps = 0.02;

Duration period(ViewKind kind) {
  return kind == ViewKind::terminal ? std::chrono::milliseconds(250) : std::chrono::seconds(1);
}

template <class... Arguments>
std::string text(const char* format, Arguments... arguments) {
  std::array<char, 256> out{};
  const int n = std::snprintf(out.data(), out.size(), format, arguments...);
  return {out.data(), std::min(static_cast<std::size_t>(n), out.size() - 1)};
}

const char* rtk_word(int status) {
  switch (status) {
    case 1: return "single";
    case 2: return "DGPS";
    case 4: return "RTK fixed";
    case 5: return "RTK float";
    default: return "no position";
  }
}

double number_at(const nlohmann::json& object, const char* key) {
  const auto it = object.find(key);
  return it != object.end() && it->is_number() ? it->get<double>() : NAN;
}

nlohmann::json clearance_of(const nlohmann::json& status) {
  if (!status.is_object()) return nlohmann::json::object();
  const auto found = status.find("clearance");
  const bool there = found != status.end() && found->is_object();
  return there ? *found : nlohmann::json::object();
}

std::string words_of_clearance(const nlohmann::json& status, const char* key) {
  const auto clearance = clearance_of(status);
  const auto it = clearance.find(key);
  return it != clearance.end() && it->is_string() ? it->get<std::string>() : std::string();
}

}  // namespace

std::string wheel_words(const nlohmann::json& axes) {
  std::string out = "rad/s";
  for (const auto& axis : axes) {
    const double radps = number_at(axis, "velocity_radps");
    out += "  " + axis.value("joint", "") + (std::isfinite(radps) ? text(" %.2f", radps) : " -");
  }
  return out;
}

std::string error_words(double sigma_m) {
  return std::isfinite(sigma_m) ? text("error %.3f m (one sigma)", sigma_m) : "error -";
}

std::string way_left(double distance_m, double speed_mps) {
  if (!std::isfinite(distance_m)) return "-";
  auto out = text("%.1f m left", distance_m);
  if (speed_mps > kStanding_mps) out += text(", about %.0f s", distance_m / speed_mps);
  return out;
}

std::string free_room(const nlohmann::json& status) {
  for (const char* key : {"unknown", "broken"})
    if (auto why = words_of_clearance(status, key); !why.empty()) return why;
  const auto clearance = clearance_of(status);
  if (clearance.empty()) return {};
  const auto number = [&clearance](const char* key) { return number_at(clearance, key); };
  return text("ahead %.2f m, back %.2f m, left %.0f deg, right %.0f deg", number("ahead_m"),
              number("back_m"), to_deg(number("left_rad")), to_deg(number("right_rad")));
}

std::string first_in_the_way(const nlohmann::json& status) {
  return words_of_clearance(status, "first");
}

std::string sensor_words(const nlohmann::json& status) {
  const auto part = [&status](const char* name) {
    const auto it = status.is_object() ? status.find(name) : status.end();
    return it != status.end() && it->is_object() ? *it : nlohmann::json::object();
  };
  std::string out;
  if (const auto battery = part("battery"); std::isfinite(number_at(battery, "voltage_V")))
    out = text("battery %.1f %% %.1f V %+.1f A", number_at(battery, "soc_percent"),
               number_at(battery, "voltage_V"), number_at(battery, "current_A"));
  const auto imu = part("imu");
  const auto health = imu.find("health");
  if (health == imu.end() || !health->is_string()) return out;
  out += (out.empty() ? "IMU " : "; IMU ") + health->get<std::string>();
  if (const double roll_rad = number_at(imu, "roll_rad"); std::isfinite(roll_rad))
    out +=
        text(", roll %.1f pitch %.1f deg", to_deg(roll_rad), to_deg(number_at(imu, "pitch_rad")));
  return out;
}

View::View(ViewKind kind, bool coloured, const Mission& mission, const std::string& daemon_socket)
    : kind_(kind), coloured_(coloured), mission_(mission), status_(daemon_socket) {}

Time View::draw(Time now, const RobotReport& report) {
  if (kind_ == ViewKind::none) return Time::max();
  if (begin_ == kNever) {
    begin_ = next_ = now;
    if (kind_ == ViewKind::terminal) std::fputs("\033[2J", stdout);
  }
  if (now < next_) return next_;
  elapsed_s_ = to_s(now - begin_);
  next_ = now + period(kind_);
  note_place(report);
  auto shown = kind_ == ViewKind::lines ? line(report) : picture(report);
  if (kind_ == ViewKind::lines && report.heard() && ++lines_ % 10 == 0) {
    const auto add = [&shown](const std::string& words) {
      if (!words.empty()) shown += "       " + words + "\n";
    };
    const auto& status = status_.status();
    const auto first = first_in_the_way(status);
    add(left(report));
    add(sensor_words(status));
    add("wheels " + wheels());
    if (const auto free = free_room(status); !free.empty())
      add("free " + free + (first.empty() ? "" : "; " + first));
  }
  std::fwrite(shown.data(), 1, shown.size(), stdout);
  std::fflush(stdout);
  status_.ask();
  return next_;
}

void View::on_sim_command(const std::string& command) {
  std::istringstream words(command);
  std::string verb, name;
  TrackPose at;
  words >> verb >> name;
  if (verb != "obstacle") return;
  if (words >> at.x_m >> at.y_m)
    around_.obstacles[name] = at;
  else
    around_.obstacles.erase(name);
}

void View::on_object(const ObjectSpec& object) {
  if (object.does == ObjectSpec::Does::goes)
    around_.objects.erase(object.id);
  else
    around_.objects[object.id] = object;
}

void View::on_zone(const ZoneSpec& zone) {
  if (zone.deleted)
    around_.zones.erase(zone.name);
  else
    around_.zones[zone.name] = zone;
}

void View::on_event(const std::string& event) {
  // Ten a second while something walks; of one that is refused it is told.
  if (event.starts_with("event scene_done#")) return;
  last_event_ = fitted(event, kTold);
  if (kind_ != ViewKind::lines) return;
  std::printf("       %s\n", last_event_.c_str());
}

void View::close() {
  if (kind_ == ViewKind::lines) {
    auto rows = map();
    const auto drawn = [](const std::string& row) { return !row.empty(); };
    rows.erase(rows.begin(), std::find_if(rows.begin(), rows.end(), drawn));
    // Before the last one, which is the scale.
    rows.erase(std::find_if(rows.rbegin() + 1, rows.rend(), drawn).base(), rows.end() - 1);
    std::fputs("\n", stdout);
    for (const auto& row : rows) std::printf("%s\n", row.c_str());
  }
  kind_ = ViewKind::none;
}

void View::note_place(const RobotReport& report) {
  robot_.reset();
  if (!report.heard() || report.locate() == "LOCATE_UNINIT") return;
  const auto shift = map_shift(report.fix(), mission_.origin, mission_.antenna);
  const auto& fix = report.fix();
  robot_ = {fix.x_m - shift.x_m, fix.y_m - shift.y_m, fix.yaw_rad};
  const auto is_far = [this](const std::vector<TrackPose>& from, double far_m) {
    return from.empty() ||
           std::hypot(robot_->x_m - from.back().x_m, robot_->y_m - from.back().y_m) > far_m;
  };
  if (report.locate() == "LOCATE_TRUE" && is_far(around_.driven, kSeen_m))
    around_.driven.push_back(*robot_);
  if (report.waits() && report.speed_mps() < kStanding_mps && is_far(around_.waited, kSeen_m))
    around_.waited.push_back(*robot_);
}

std::vector<std::string> View::map() const {
  const bool coloured = coloured_ && kind_ == ViewKind::terminal;
  return map_lines(mission_.track, mission_.target_id - 1, around_, robot_, coloured);
}

std::string View::line(const RobotReport& report) const {
  if (!report.heard()) return text("%6.1f s starting\n", elapsed_s_);
  const auto& fix = report.fix();
  auto out = text("%6.1f s %-11s x %7.2f y %7.2f yaw %6.1f deg  %5.2f m/s  %s, %s%s", elapsed_s_,
                  report.nav_status().c_str(), fix.x_m, fix.y_m, to_deg(fix.yaw_rad),
                  report.speed_mps(), rtk_word(report.rtk_status()), report.locate().c_str(),
                  report.obstacle() ? ", obstacle" : "");
  if (!report.why().empty()) out += "  (" + report.why() + ")";
  return out + "\n";
}

std::string View::wheels() const {
  const auto& status = status_.status();
  if (!status.is_object() || !status.contains("axes")) return "-";
  return wheel_words(status.at("axes"));
}

std::string View::left(const RobotReport& report) const {
  const auto& status = status_.status();
  if (report.nav_status() != "NAV_RUN" || !status.is_object() || !status.contains("nav"))
    return "-";
  return way_left(number_at(status.at("nav"), "distance_left_m"), report.speed_mps());
}

std::string View::place(const RobotReport& report) const {
  double sigma_m = NAN;
  if (const auto& status = status_.status(); status.is_object() && status.contains("pose"))
    sigma_m = number_at(status.at("pose"), "position_sigma_m");
  return text("%s, %s, %s", report.locate().c_str(), rtk_word(report.rtk_status()),
              error_words(sigma_m).c_str());
}

// As many lines as an old terminal has, and the longest of them are cut rather than broken.
std::string View::picture(const RobotReport& report) const {
  std::string out = "\033[?7l\033[H";
  const auto add = [&out](const std::string& line) { out += line + "\033[K\n"; };
  const auto tell = [&add](const char* what, const std::string& words) {
    add(text("%-8s", what) + fitted(words.empty() ? "-" : words, kColumns - 8));
  };
  const char* const held = report.waits() ? ", waits" : report.obstacle() ? ", obstacle" : "";
  // Also what it slows down for, before it waits.
  const auto why = report.why().empty() ? first_in_the_way(status_.status()) : report.why();
  add(fitted(text("%s  %.1f s  %s%s", mission_.name.c_str(), elapsed_s_,
                  report.nav_status().c_str(), held) +
                 (why.empty() ? "" : ": " + why),
             kColumns));
  for (const auto& row : map()) add(row);
  tell("speed",
       text("%.2f m/s, turning %.1f deg/s; ", report.speed_mps(), to_deg(report.turn_radps())) +
           left(report));
  tell("place", place(report));
  tell("free", free_room(status_.status()));
  tell("wheels", wheels());
  tell("power", sensor_words(status_.status()));
  tell("answer", report.last_feedback());
  tell("last", last_event_);
  return out + "\033[J\033[?7h";
}

}  // namespace drover::sim
