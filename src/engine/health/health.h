// What is good and what is not, each cycle, in an operator's words.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "drover/snapshot.h"
#include "engine/environment.h"
#include "engine/health/battery.h"
#include "engine/health/causes.h"
#include "engine/health/locate.h"
#include "engine/sensors/sensors.h"

namespace drover::engine {

/// Last known state of the lines: the levels the drivers reported since the last cycle.
struct LineTable {
  std::array<bool, kLineCount> active{true, true, true, true};
};

struct HealthInput {
  Time now = kNever;
  const Environment& environment;
  std::span<const AxisSnapshot> axes;
  const LineTable& lines;
  const Estimate& estimate;
  bool has_origin = false;
  bool task_active = false;
  const Reason& latched;             ///< empty when nothing is
  const Sensors* sensors = nullptr;  ///< nullptr: one of each, and no battery
  Reason tilt{};                     ///< why it stands too steep to move; empty when it does not
  Reason moved{};                    ///< what moves it without a command; empty when nothing does
  Reason jumped{};                   ///< what changed its place at rest; empty when nothing did
  bool power_cut = false;            ///< by this gateway: that drives are silent is no news
  Reason in_the_way{};               ///< as ClearanceWatch::blocked
  Reason unseen{};                   ///< as ClearanceWatch::unknown
  Reason broken{};                   ///< as ClearanceWatch::broken
  const Reason* steep =
      nullptr;                  ///< why the ground is too steep to be left there; empty: it is not
  const Reason* hit = nullptr;  ///< what hit it just now; empty: nothing did
};

inline constexpr const char* kJustStarted = "the gateway has just started";

struct HealthReport {
  bool ready = false;           ///< at least one cycle was looked at
  bool drives_ok = false;       ///< all heard, fresh and without a fault
  bool drives_running = false;  ///< all in closed loop
  bool lines_ok = false;        ///< no e-stop, no bumper, no line lost
  bool gnss_ok = false;         ///< the receiver talks
  bool guard_ok = false;        ///< answers, or is not required; and has not taken the bus
  bool estop = false;           ///< pressed, or its line is lost
  bool estop_known = true;      ///< false just after the start: nobody may count on it being free
  bool near_zone = false;       ///< of the scanner, or something else is in the way
  bool in_the_way = false;      ///< something was seen there, and the scanner's zone is free
  bool far_zone = false;
  LocateState locate = LocateState::uninit;
  double budget_used = 1;  ///< of the permitted position error
  /// Nothing may move now and motion stops without a ramp: why. Empty when motion is possible.
  Reason stop;
  /// The same without the guard's hold, which a reset here does not end.
  Reason stop_but_guard;
  /// Which drive is not in closed loop, and its fault: stops a task that runs, while at rest arming
  /// may clear it. Empty when all run.
  Reason not_running;
  Reason locate_reason;
  // The first cause that does it (see CauseRow); empty when none does.
  Reason end_task;
  Reason end_wait;
  Reason no_start;  ///< also what no cause is yet: see BatteryVerdict::present
  Reason end_free_driving;
  Reason end_groups;  ///< of all of the robot, so that joints outside the base follow nobody
  FixedVector<Reason, 8> why;             ///< the cause first
  std::uint32_t why_untold = 0;           ///< causes that found no room there
  std::uint64_t causes = 0;               ///< bits by Cause
  std::array<Reason, kCauseCount> texts;  ///< by Cause, for causes that hold

  bool holds(Cause cause) const { return (causes & bit(cause)) != 0; }
  /// Nothing could be commanded to move, whoever asks; a start may clear a drive's fault first.
  bool nothing_moves() const { return !stop.empty() || holds(Cause::drive_fault); }
  bool holds_any(std::uint64_t bits) const { return (causes & bits) != 0; }
  const Reason& text(Cause cause) const { return texts[static_cast<std::size_t>(cause)]; }
  /// `what` is the text of a cause that holds, whether `why` had room for it or not.
  bool gives(const Reason& what) const {
    for (std::size_t i = 0; i < kCauseCount; ++i)
      if (holds(static_cast<Cause>(i)) && texts[i] == what) return true;
    return false;
  }
  /// Why nothing may begin to move, whoever asks, or go on; empty: it may.
  Reason hinders_all() const {
    if (!ready) return kJustStarted;
    return stop.empty() ? end_task : stop;
  }
  /// What stands in the near zone or in the way.
  Reason obstacle() const {
    return holds(Cause::near_zone) ? text(Cause::near_zone) : Reason("obstacle in the near zone");
  }
};

class HealthMonitor final {
 public:
  explicit HealthMonitor(const EngineConfig& config);
  const HealthReport& update(const HealthInput& input);
  const HealthReport& report() const { return report_; }
  /// Just after the start: nothing is known of it, so that it is neither active nor lost.
  bool unknown(Line line) const { return unknown_[static_cast<std::size_t>(line)]; }

 private:
  void hold(Cause cause, const Reason& text);
  void tell(Cause cause, const Reason& text);
  bool is_silent_alone(const AxisSnapshot& one, const HealthInput& input) const;
  void look_at_lines(const HealthInput& input);
  void look_at_drives(const HealthInput& input);
  void look_at_guard(const Environment& environment);
  void look_at_imu(const HealthInput& input);
  void look_at_position(const HealthInput& input);
  void look_at_battery(const HealthInput& input);
  void look_at_one_battery(const BatteryVerdict& verdict);
  void look_at_program(const Environment& environment);
  void look_at_place(const HealthInput& input);
  void look_at_surroundings(const HealthInput& input);
  void conclude(bool power_cut);
  bool holds(Cause cause) const { return report_.holds(cause); }

  EngineConfig config_;
  Kinematics base_;
  JointSet driven_;
  LocateMonitor locate_;
  std::vector<BatteryMonitor> batteries_;  ///< by number
  HealthReport report_;
  std::array<bool, kLineCount> unknown_{};
  Time begun_ = kNever;
};

/// "e-stop", "bumper", ...
std::string_view line_name(Line line);

}  // namespace drover::engine
