// What is good and what is not, each cycle, in an operator's words.
#pragma once

#include <array>
#include <span>

#include "drover/snapshot.h"
#include "engine/environment.h"
#include "engine/health/battery.h"
#include "engine/health/locate.h"

namespace drover::engine {

/// Everything that can be wrong, the more causal the earlier: an e-stop cuts the drives' power, so
/// silent drives come after it.
enum class Cause : std::uint8_t {
  estop,
  line_lost,
  guard_has_bus,
  bumper,
  tilt,  ///< tilted beyond the limit, or gravity on the wrong axis
  drive_silent,
  guard_silent,
  drive_fault,
  latched,           ///< not a present cause: what stopped the robot before a person acted
  steep,             ///< ground on which the base cannot be left without power: a task ends
  charger,           ///< connected, or was when the battery was last heard: must not move
  battery_critical,  ///< empty, too hot, or about to switch off: a task ends
  program,           ///< a part of the daemon hangs, or it ends: a task ends
  near_zone,
  moved,     ///< pushed, carried or rolling without a command: a task ends and none starts
  foreign,   ///< somebody else commands the drives: no start
  bus,       ///< told only: what it does to the drives is their own cause
  origin,    ///< none set
  receiver,  ///< silent
  imu,       ///< configured and silent, stuck or out of its range
  locate,
  jumped,   ///< the place changed at rest: a task ends; a start is refused once, to ask a person
  sensors,  ///< contradict each other, and it is made up for
  far_zone,
  battery_low,      ///< no start, a task goes on
  battery_warning,  ///< told only
  battery_silent,   ///< told only: nothing is known of it
};
inline constexpr std::size_t kCauseCount = static_cast<std::size_t>(Cause::battery_silent) + 1;

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
  const Reason& latched;  ///< empty when nothing is
  const BatterySnapshot* battery = nullptr;
  Reason tilt{};           ///< why it stands too steep to move; empty when it does not
  Reason moved{};          ///< what moves it without a command; empty when nothing does
  Reason jumped{};         ///< what changed its place at rest; empty when nothing did
  bool power_cut = false;  ///< by this gateway: that drives are silent is no news
  const Reason* steep =
      nullptr;  ///< why the ground is too steep to be left there; empty: it is not
};

struct HealthReport {
  bool ready = false;           ///< at least one cycle was looked at
  bool drives_ok = false;       ///< all heard, fresh and without a fault
  bool drives_running = false;  ///< all in closed loop
  bool lines_ok = false;        ///< no e-stop, no bumper, no line lost
  bool gnss_ok = false;         ///< the receiver talks
  bool guard_ok = false;        ///< answers, or is not required; and has not taken the bus
  bool estop = false;           ///< pressed, or its line is lost
  bool estop_known = true;      ///< false just after the start: nobody may count on it being free
  bool near_zone = false;
  bool far_zone = false;
  LocateState locate = LocateState::uninit;
  double budget_used = 1;  ///< of the permitted position error
  /// Nothing may move now and motion stops without a ramp: why. Empty when motion is possible.
  Reason stop;
  /// Which drive is not in closed loop, and its fault: stops a task that runs, while at rest arming
  /// may clear it. Empty when all run.
  Reason not_running;
  Reason locate_reason;
  Reason end_task;  ///< a task ends with a ramp and none starts: why; empty when there is nothing
  Reason no_start;  ///< a task goes on but none starts: why; empty when there is nothing
  FixedVector<Reason, 8> why;             ///< the cause first
  std::uint32_t causes = 0;               ///< bits by Cause
  std::array<Reason, kCauseCount> texts;  ///< by Cause, for causes that hold

  bool holds(Cause cause) const { return (causes >> static_cast<unsigned>(cause) & 1U) != 0; }
  const Reason& text(Cause cause) const { return texts[static_cast<std::size_t>(cause)]; }
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
  void look_at_lines(const HealthInput& input);
  void look_at_drives(const HealthInput& input);
  void look_at_guard(const Environment& environment);
  void look_at_imu(const HealthInput& input);
  void look_at_position(const HealthInput& input);
  void look_at_battery(const HealthInput& input);
  void look_at_program(const Environment& environment);
  bool holds(Cause cause) const { return report_.holds(cause); }

  EngineConfig config_;
  Kinematics base_;
  JointSet driven_;
  LocateMonitor locate_;
  BatteryMonitor battery_;
  HealthReport report_;
  std::array<bool, kLineCount> unknown_{};
  Time begun_ = kNever;
};

/// "e-stop", "bumper", ...
std::string_view line_name(Line line);

}  // namespace drover::engine
