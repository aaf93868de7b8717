// What is good and what is not, each cycle, in an operator's words.
#include "engine/health/health.h"

#include <algorithm>
#include <cmath>

#include "engine/base/words.h"
#include "engine/health/heard.h"
#include "engine/still.h"

namespace drover::engine {
namespace {

/// Chips are opened and contacts settle: in that time a line that tells nothing is no fault yet.
constexpr Duration kLinesSettle = std::chrono::seconds(1);

void put(Reason& out, std::string_view name, std::string_view text) {
  out.format("%.*s: %.*s", static_cast<int>(name.size()), name.data(),
             static_cast<int>(text.size()), text.data());
}

void put(Reason& out, const char* before, std::string_view name, std::string_view text) {
  out.format("%s %.*s: %.*s", before, static_cast<int>(name.size()), name.data(),
             static_cast<int>(text.size()), text.data());
}

/// By more than what lies between the frames of motors that talk.
constexpr Duration kLonger = std::chrono::milliseconds(10);

bool is_longer_silent(const AxisSnapshot& axis, const AxisSnapshot& other) {
  if (other.last_motion == kNever) return false;
  return axis.last_motion == kNever || other.last_motion - axis.last_motion > kLonger;
}

}  // namespace

std::string_view line_name(Line line) {
  switch (line) {
    case Line::estop: return "e-stop";
    case Line::bumper: return "bumper";
    case Line::zone_far: return "far zone";
    case Line::zone_near: return "near zone";
  }
  return "line";
}

HealthMonitor::HealthMonitor(const EngineConfig& config)
    : config_(config),
      base_(kinematics_of(config.base)),
      driven_(joints_of(base_)),
      locate_(config.estimate) {
  // With several, each speaks in its own name.
  for (std::size_t i = 0; i < std::max<std::size_t>(1, config.batteries.size()); ++i)
    batteries_.emplace_back(
        config.health, config.batteries.size() > 1 ? config.batteries[i].name : Name("battery"));
}

void HealthMonitor::hold(Cause cause, const Reason& text) {
  if (!holds(cause)) tell(cause, text);  // the first of a kind speaks for all
}

void HealthMonitor::tell(Cause cause, const Reason& text) {
  report_.causes |= bit(cause);
  report_.texts[static_cast<std::size_t>(cause)] = text;
}

void HealthMonitor::look_at_lines(const HealthInput& input) {
  report_.lines_ok = report_.estop_known = true;
  if (begun_ == kNever) begun_ = input.now;
  for (std::size_t i = 0; i < kLineCount; ++i) {
    if (!config_.line_configured[i]) continue;
    const auto line = static_cast<Line>(i);
    const SourceHealth& source = input.environment.lines[i];
    // The driver judges; the age is looked at again so that a driver never asked is noticed, too.
    const bool old = source.last_good != kNever &&
                     input.now - source.last_good > from_s(config_.health.line_stale_s);
    const bool lost = source.state != SourceState::fresh || old;
    const bool unknown = unknown_[i] =
        source.state == SourceState::never_heard && input.now - begun_ <= kLinesSettle;
    // Nothing moves while a line is lost or unknown, but only what is lost is told as active.
    const bool active = !unknown && (input.lines.active[i] || lost);
    if (lost) {
      Reason text;
      put(text, "line", line_name(line),
          unknown                 ? std::string_view("not known yet, just after the start")
          : source.reason.empty() ? std::string_view("not readable")
                                  : source.reason.view());
      hold(Cause::line_lost, text);
      report_.lines_ok = false;
    }
    switch (line) {
      case Line::estop:
        report_.estop = active;
        report_.estop_known = !unknown;
        if (active && !lost) hold(Cause::estop, "e-stop pressed");
        report_.lines_ok = report_.lines_ok && !active;
        break;
      case Line::bumper:
        if (active && !lost) hold(Cause::bumper, "bumper touched");
        report_.lines_ok = report_.lines_ok && !active;
        break;
      case Line::zone_far:
        report_.far_zone = active;
        if (active && !lost) hold(Cause::far_zone, "somebody in the far zone: slowly");
        break;
      case Line::zone_near:
        report_.near_zone = active;
        if (active && !lost) hold(Cause::near_zone, "obstacle in the near zone");
        break;
    }
  }
}

void HealthMonitor::look_at_drives(const HealthInput& input) {
  report_.drives_ok = true;
  report_.drives_running = true;
  const Duration stale = from_s(config_.health.drive_stale_s);
  std::size_t driven = 0;
  std::size_t silent = 0;
  // Motors behind one device are silent, or given up, together: the one that is it speaks.
  const AxisSnapshot* silent_one = nullptr;
  bool has_faulty_one = false;
  for (std::size_t i = 0; i < input.axes.size(); ++i) {
    if (!driven_[i]) continue;
    ++driven;
    const AxisSnapshot& axis = input.axes[i];
    const SourceHealth& source =
        takes_twist(base_) ? input.environment.base : input.environment.axes[i];
    const bool heard = axis.last_motion != kNever && source.state == SourceState::fresh &&
                       tells_motion(axis, input.now, stale);
    if (heard && axis.state == AxisState::running) continue;  // no words for what is well
    const Duration age = input.now - axis.last_motion;
    const auto joint = joint_text(base_, axis.joint);
    Reason text;
    if (axis.last_motion == kNever || source.state == SourceState::never_heard) {
      put(text, joint,
          source.reason.empty() ? std::string_view("never heard") : source.reason.view());
    } else if (!heard) {
      Reason what;
      what.format("no feedback for %.2f s", to_s(age));
      const bool known = source.state != SourceState::fresh && !source.reason.empty();
      put(text, joint, known ? source.reason.view() : what.view());
    }
    if (!text.empty()) {
      ++silent;
      if (silent_one == nullptr || is_longer_silent(axis, *silent_one)) {
        silent_one = &axis;
        tell(Cause::drive_silent, text);
      }
    } else if (axis.state == AxisState::fault) {
      put(text, joint, axis.fault.empty() ? std::string_view("fault") : axis.fault.view());
      const bool is_faulty_one = !axis.stops_all && axis.error_code != 0 && !has_faulty_one;
      if (is_faulty_one) {
        has_faulty_one = true;
        tell(Cause::drive_fault, text);
      } else {
        hold(axis.stops_all ? Cause::base_stop : Cause::drive_fault, text);
      }
    }
    report_.drives_ok = report_.drives_ok && text.empty();
    if (!text.empty() || axis.state != AxisState::running) {
      report_.drives_running = false;
      // What it says of itself: of a locked brake, of a mode that it stays in.
      const std::string_view said = axis.fault;
      if (text.empty()) put(text, joint, said.empty() ? "the drive is not in closed loop" : said);
      if (report_.not_running.empty()) report_.not_running = text;
    }
  }
  if (driven == 0) {
    report_.drives_ok = report_.drives_running = false;
    hold(Cause::drive_silent, "no drives are configured");
  }
  for (const Cause cause : {Cause::drive_fault, Cause::drive_silent})
    if (holds(cause) && driven > 0)
      report_.not_running = report_.texts[static_cast<std::size_t>(cause)];
  const bool all_silent = silent == driven && driven > 1 && !takes_twist(base_);
  if (all_silent && !is_silent_alone(*silent_one, input)) {
    // The first is named all the same: its text carries the driver's or link's own reason.
    Reason all;
    const auto& first = report_.texts[static_cast<std::size_t>(Cause::drive_silent)];
    all.format("no drive answers (%.*s)", static_cast<int>(first.view().size()),
               first.view().data());
    report_.texts[static_cast<std::size_t>(Cause::drive_silent)] = all;
  }
}

/// All the others behind its device go on telling what they do.
bool HealthMonitor::is_silent_alone(const AxisSnapshot& one, const HealthInput& input) const {
  const Duration stale = from_s(config_.health.drive_stale_s);
  for (std::size_t i = 0; i < input.axes.size(); ++i) {
    const AxisSnapshot& axis = input.axes[i];
    if (!driven_[i] || &axis == &one) continue;
    if (!is_longer_silent(one, axis) || !tells_motion(axis, input.now, stale)) return false;
  }
  return true;
}

void HealthMonitor::look_at_guard(const Environment& environment) {
  const bool silent = config_.health.guard_required && !environment.guard_alive;
  const bool refuses = config_.health.guard_required && environment.guard_refuses_set;
  report_.guard_ok =
      !silent && !refuses && !environment.guard_has_bus && !environment.guard_latched;
  if (refuses) {
    hold(Cause::guard_has_bus,
         "drover-guard keeps the stop set of another configuration, until drover reset");
  } else if (environment.guard_latched) {
    hold(Cause::guard_has_bus, "stopped by drover stop at the guard, until drover reset");
  } else if (environment.guard_has_bus) {
    hold(Cause::guard_has_bus, "the guard stopped the drives");
  }
  if (silent) hold(Cause::guard_silent, "the guard does not answer");
  if (!environment.bus.empty()) hold(Cause::bus, environment.bus);
}

void HealthMonitor::look_at_imu(const HealthInput& input) {
  const SourceHealth& imu =
      input.environment.imu[input.sensors != nullptr ? input.sensors->imu() : 0];
  const Name name = input.sensors != nullptr ? input.sensors->imu_name("IMU") : Name("IMU");
  const auto called = static_cast<int>(name.view().size());
  const Duration age = input.now - imu.last_good;
  const bool old = imu.last_good != kNever && age > from_s(config_.health.imu_stale_s);
  if (!input.environment.imu_configured || (imu.state == SourceState::fresh && !old)) return;
  Reason text;
  if (imu.last_good == kNever) {
    if (imu.reason.empty()) text.format("%.*s never heard", called, name.view().data());
  } else if (old) {
    text.format("%.*s silent for %.1f s", called, name.view().data(), to_s(age));
  }
  if (text.empty())
    put(text, "sensor", name.view(), imu.reason.empty() ? "stale" : imu.reason.view());
  hold(Cause::imu, text);
}

void HealthMonitor::look_at_position(const HealthInput& input) {
  const SourceHealth& gnss =
      input.environment.gnss[input.sensors != nullptr ? input.sensors->receiver() : 0];
  const Name name = input.sensors != nullptr ? input.sensors->receiver_name("GNSS") : Name("GNSS");
  Name spaced;  // where there are several, the name of the one in use
  if (config_.receivers.size() > 1)
    spaced.format("%.*s ", static_cast<int>(name.view().size()), name.view().data());
  const auto called = static_cast<int>(spaced.view().size());
  const bool old =
      gnss.last_good != kNever && input.now - gnss.last_good > from_s(config_.health.gnss_stale_s);
  report_.gnss_ok =
      !input.environment.gnss_configured || (gnss.state == SourceState::fresh && !old);
  if (!report_.gnss_ok) {
    Reason text;
    if (!gnss.reason.empty()) {
      put(text, "receiver", name.view(), gnss.reason);
    } else if (gnss.last_good == kNever) {
      text.format("receiver %.*snever heard", called, spaced.view().data());
    } else {
      text.format("receiver %.*ssilent for %.1f s", called, spaced.view().data(),
                  to_s(input.now - gnss.last_good));
    }
    hold(Cause::receiver, text);
  }
  report_.locate = locate_.update(input.estimate, input.has_origin, input.task_active);
  report_.locate_reason = locate_.reason();
  report_.budget_used = locate_.used();
  // On wheels alone the next outage of the receiver is a short one: slowly, from now on.
  if (holds(Cause::imu)) report_.budget_used = 1;
  if (!input.estimate.notice.empty()) hold(Cause::sensors, input.estimate.notice);
  if (!input.has_origin) {
    hold(Cause::origin, locate_.reason());
  } else if (report_.locate != LocateState::good) {
    hold(Cause::locate, locate_.reason());
  }
}

void HealthMonitor::look_at_battery(const HealthInput& input) {
  if (!config_.battery_configured || input.sensors == nullptr) return;
  const auto samples = input.sensors->batteries();
  const bool stands = input.estimate.fastest_mps <= kStands_mps;
  std::size_t counted = 0;
  std::size_t silent = 0;
  for (std::size_t i = 0; i < batteries_.size(); ++i) {
    const BatteryVerdict& verdict =
        batteries_[i].update(input.now, samples[i], input.environment.battery[i], stands);
    if (!input.sensors->battery_counts(i)) continue;
    ++counted;
    silent += verdict.silent.empty() ? 0 : 1;
    look_at_one_battery(verdict);
  }
  if (silent < 2 || silent < counted) return;
  // The first is named all the same, as with drives.
  Reason& text = report_.texts[static_cast<std::size_t>(Cause::battery_silent)];
  const Reason first = text;
  text.format("no battery is heard (%.*s)", static_cast<int>(first.view().size()),
              first.view().data());
}

/// Of several that count the worst decides: each may end a task, and each may forbid a start.
void HealthMonitor::look_at_one_battery(const BatteryVerdict& verdict) {
  const auto tell = [this](Cause cause, const Reason& text) {
    if (!text.empty()) hold(cause, text);
  };
  tell(Cause::charger, verdict.charger);
  tell(Cause::charger_unknown, verdict.plugged);
  tell(Cause::battery_critical, verdict.critical);
  tell(Cause::battery_low, verdict.low);
  tell(Cause::battery_warning, verdict.warning);
  tell(Cause::battery_silent, verdict.silent);
  if (report_.no_start.empty()) report_.no_start = verdict.present;
}

void HealthMonitor::look_at_program(const Environment& environment) {
  const Reason& why = environment.slept.empty() ? environment.program : environment.slept;
  if (!why.empty()) hold(Cause::program, why);
  if (!environment.foreign.empty()) hold(Cause::foreign, environment.foreign);
}

/// The ground, and what moved it.
void HealthMonitor::look_at_place(const HealthInput& input) {
  if (input.hit != nullptr && !input.hit->empty()) hold(Cause::hit, *input.hit);
  if (!input.tilt.empty()) hold(Cause::tilt, input.tilt);
  if (input.steep != nullptr && !input.steep->empty()) hold(Cause::steep, *input.steep);
  if (!input.moved.empty()) hold(Cause::moved, input.moved);
  if (!input.jumped.empty()) hold(Cause::jumped, input.jumped);
}

/// What the causes do that hold, by their table.
void HealthMonitor::conclude(bool power_cut) {
  const auto first = [](Reason& out, bool does, const Reason& text) {
    if (does && out.empty()) out = text;
  };
  const auto tell = [this](const Reason& text) {
    if (!report_.why.push_back(text)) ++report_.why_untold;  // the cause is the first
  };
  for (const CauseRow& row : kCauses) {
    if (!holds(row.cause)) continue;
    const Reason& text = report_.text(row.cause);
    const bool silenced = row.cause == Cause::drive_silent && power_cut;
    first(report_.stop, row.stops && !silenced, text);
    first(report_.stop_but_guard, row.stops && !silenced && row.cause != Cause::guard_has_bus,
          text);
    first(report_.end_task, row.ends_task, text);
    first(report_.end_wait, row.ends_wait, text);
    first(report_.no_start, row.refuses_task, text);
    first(report_.end_free_driving, row.ends_free_driving, text);
    first(report_.end_groups, row.of_all, text);
    if (!silenced) tell(text);
  }
  // Drives without power are silent because it was cut: no cause, and so the last.
  if (power_cut && holds(Cause::drive_silent)) tell(report_.text(Cause::drive_silent));
}

void HealthMonitor::look_at_surroundings(const HealthInput& input) {
  if (!input.unseen.empty()) hold(Cause::surroundings, input.unseen);
  if (!input.broken.empty()) hold(Cause::constraint, input.broken);
  if (input.in_the_way.empty()) return;
  report_.in_the_way = !report_.near_zone;
  report_.near_zone = true;
  hold(Cause::near_zone, input.in_the_way);
}

const HealthReport& HealthMonitor::update(const HealthInput& input) {
  // Emptied field by field: the texts are large and most stay unused.
  report_.ready = true;
  report_.estop = report_.near_zone = report_.in_the_way = report_.far_zone = false;
  report_.causes = 0;
  report_.stop.clear();
  report_.stop_but_guard.clear();
  report_.end_task.clear();
  report_.end_wait.clear();
  report_.no_start.clear();
  report_.end_free_driving.clear();
  report_.end_groups.clear();
  report_.not_running.clear();
  report_.why.clear();
  report_.why_untold = 0;
  look_at_lines(input);
  look_at_guard(input.environment);
  look_at_drives(input);
  look_at_imu(input);
  if (input.sensors != nullptr && !input.sensors->caution().empty())
    hold(Cause::spare, input.sensors->caution());
  look_at_position(input);
  look_at_battery(input);
  look_at_program(input.environment);
  look_at_place(input);
  look_at_surroundings(input);
  if (!input.latched.empty()) {
    Reason text;
    text.format("stopped: %.*s", static_cast<int>(input.latched.view().size()),
                input.latched.view().data());
    hold(Cause::latched, text);
  }
  conclude(input.power_cut);
  return report_;
}

}  // namespace drover::engine
