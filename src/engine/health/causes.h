// Everything that can be wrong: what it does while it holds, and what is said when it is over.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

namespace drover::engine {

/// The more causal the earlier: an e-stop cuts the drives' power, so silent drives come after it.
enum class Cause : std::uint8_t {
  estop,
  line_lost,
  guard_has_bus,
  bumper,
  base_stop,  ///< by the base's own button or bumper, as its device tells
  hit,        ///< an acceleration that no drive gives
  tilt,       ///< tilted beyond the limit, or gravity on the wrong axis
  drive_silent,
  guard_silent,
  drive_fault,
  latched,           ///< not a present cause: what stopped the robot before a person acted
  steep,             ///< ground on which the base cannot be left without power
  charger,           ///< connected
  charger_unknown,   ///< was connected when the battery was heard last
  battery_critical,  ///< empty, too hot, or about to switch off
  program,           ///< a part of the daemon hangs, or it ends
  near_zone,
  surroundings,  ///< what is around the robot is not known
  constraint,    ///< one of those that were set does not hold where the robot is
  moved,         ///< pushed, carried or rolling without a command
  foreign,       ///< somebody else commands the drives
  bus,           ///< what it does to the drives is their own cause
  origin,        ///< none set
  receiver,      ///< silent
  imu,           ///< configured and silent, stuck or out of its range
  spare,         ///< a spare is in use, or could not be
  locate,
  jumped,   ///< the place changed at rest; a start is refused once, to ask a person
  sensors,  ///< contradict each other, and it is made up for
  far_zone,
  battery_low,
  battery_warning,
  battery_silent,  ///< nothing is known of it
};
inline constexpr std::size_t kCauseCount = static_cast<std::size_t>(Cause::battery_silent) + 1;

/// What is told only has none of these.
struct CauseRow {
  Cause cause;
  bool stops = false;              ///< nothing may move: at once, without a ramp
  bool ends_task = false;          ///< whatever moves it ends with a ramp, and nothing begins
  bool ends_wait = false;          ///< a task that waits ends
  bool refuses_task = false;       ///< no task starts; one that runs goes on
  bool ends_free_driving = false;  ///< joint commands and a key; no search begins
  bool by_people = false;  ///< pressed or touched: joint commands wait for one, whoever drove
  bool of_all = false;     ///< of the whole robot: joints outside the base follow nobody either
  bool severe = false;     ///< an error, not a warning
  std::string_view over;   ///< said when it holds no more
};

// clang-format off
inline constexpr std::array<CauseRow, kCauseCount> kCauses{{
  {.cause = Cause::estop, .stops = true, .by_people = true, .of_all = true,
   .severe = true,
   .over = "e-stop released"},
  {.cause = Cause::line_lost, .stops = true, .by_people = true, .of_all = true,
   .severe = true,
   .over = "safety lines readable again"},
  {.cause = Cause::guard_has_bus, .stops = true, .of_all = true, .severe = true,
   .over = "the guard gave the drives back"},
  {.cause = Cause::bumper, .stops = true, .by_people = true, .of_all = true,
   .severe = true,
   .over = "bumper free"},
  {.cause = Cause::base_stop, .stops = true, .by_people = true, .of_all = true,
   .severe = true,
   .over = "the base's own emergency stop is released"},
  {.cause = Cause::hit, .stops = true, .by_people = true, .of_all = true,
   .severe = true,
   .over = "nothing hits the robot any more"},
  {.cause = Cause::tilt, .stops = true, .of_all = true, .severe = true,
   .over = "no tilt beyond the limit any more"},
  {.cause = Cause::drive_silent, .stops = true, .severe = true,
   .over = "all drives of the base answer"},
  {.cause = Cause::guard_silent, .stops = true, .of_all = true, .severe = true,
   .over = "the guard answers"},
  {.cause = Cause::drive_fault, .severe = true,
   .over = "no drive of the base reports a fault"},
  {.cause = Cause::latched,
   .over = "ready for a new start"},
  {.cause = Cause::steep, .ends_task = true,
   .over = "on level ground again"},
  {.cause = Cause::charger, .ends_task = true,
   .over = "charger unplugged"},
  {.cause = Cause::charger_unknown, .refuses_task = true, .ends_free_driving = true,
   .over = "it is known whether the charger is connected"},
  {.cause = Cause::battery_critical, .ends_task = true, .of_all = true,
   .over = "battery good for driving again"},
  {.cause = Cause::program, .ends_task = true, .of_all = true,
   .over = "droverd runs undisturbed again"},
  {.cause = Cause::near_zone,
   .over = "nothing is in the way any more"},
  {.cause = Cause::surroundings, .refuses_task = true, .ends_free_driving = true,
   .over = "what is around the robot is known again"},
  {.cause = Cause::constraint, .refuses_task = true, .ends_free_driving = true,
   .over = "all constraints hold again"},
  {.cause = Cause::moved, .ends_wait = true, .refuses_task = true, .ends_free_driving = true,
   .over = "the robot rests again"},
  {.cause = Cause::foreign, .refuses_task = true, .ends_free_driving = true,
   .over = "nobody else commands the drives"},
  {.cause = Cause::bus,
   .over = "CAN buses good"},
  {.cause = Cause::origin,
   .over = "an origin is set"},
  {.cause = Cause::receiver,
   .over = "receiver heard"},
  {.cause = Cause::imu,
   .over = "IMU heard"},
  {.cause = Cause::spare,
   .over = "what steers is in use, and its spares could be"},
  {.cause = Cause::locate,
   .over = "position good"},
  {.cause = Cause::jumped, .ends_wait = true,
   .over = "a person has confirmed where the robot stands"},
  {.cause = Cause::sensors,
   .over = "wheels, gyro and receiver do not contradict each other any more"},
  {.cause = Cause::far_zone,
   .over = "far zone free"},
  {.cause = Cause::battery_low, .refuses_task = true,
   .over = "battery charged"},
  {.cause = Cause::battery_warning,
   .over = "battery without a warning"},
  {.cause = Cause::battery_silent,
   .over = "battery heard"},
}};
// clang-format on

consteval bool in_their_order() {
  for (std::size_t i = 0; i < kCauseCount; ++i)
    if (kCauses[i].cause != static_cast<Cause>(i) || kCauses[i].over.empty()) return false;
  return true;
}
static_assert(in_their_order());
static_assert(kCauseCount <= 64, "HealthReport has a bit for each");

constexpr std::uint64_t bit(Cause cause) {
  return std::uint64_t{1} << static_cast<unsigned>(cause);
}

inline constexpr std::uint64_t kByPeople = [] {
  std::uint64_t bits = 0;
  for (const CauseRow& row : kCauses)
    if (row.by_people) bits |= bit(row.cause);
  return bits;
}();

}  // namespace drover::engine
