// What a scenario or a person can do to the robot while it runs, as lines of text:
//   estop press|release              the button
//   bumper touch|free                forced, or left to the mechanics
//   zone near|far occupied|free      the same for the scanner's zones
//   obstacle NAME X Y|remove         a movable box of the world, centred at X, Y (m)
//   obstacle NAME box|cylinder|...   any solid, where the world can hold them: object_command.h
//   gnss STATE [NUMBER...]           see drover/twin.h: fix, float, single, none, silent, ...;
//                                    a state's numbers are words or behind colons
//   imu STATE [NUMBER]               silent, frozen, saturated, bias:2, ...; well: all is good;
//                                    of one on a bus also unplug, plug
//   lidar STATE                      covered, sun, frozen, dirty, silent, ...: twin.h of its
//   driver;
//                                    normal: all is good; unplugged
//   battery soc PERCENT              so much is left
//   battery charger plug|unplug      and see battery_port.h for the faults of its line
//   gnss NAME STATE, imu NAME STATE, battery NAME soc PERCENT, ...: a further one of its kind
//   drive NAME power on|off          a drive's own switch; NAME: its own, a joint's, "a,b" or "all"
//   drive NAME fault NAME|none       see the drive's README
//   supply dip SECONDS               the drives' common supply goes for so long
//   kick VX VY                       a shove along the base's own axes (m/s)
//   push FX FY SECONDS               somebody pushes with this force along the base's axes (N)
//   push_tip FX FY FZ SECONDS        the same at the arm's tip, along the world's axes
//   carry DX DY DEGREES SECONDS      it is moved on a trailer, along its axes; no wheel turns
//   shove DX DY SECONDS [DEGREES]    a force displaces it so far along its axes, and turns it
//   slip SHARE SECONDS [SIDE]        its wheels (left, right or all) make so much less way
//   sideslip SHARE [DEGREES]         it slides by this share of its speed: to its left as it stands
//                                    now, or in that direction of the world; 0 ends it
//   slope DEGREES                    tilts the world's side slope, north up, where there is one
//   truth                            pose and speed as JSON, and of an arm its joints and its tip
#include <algorithm>
#include <vector>

#include "drover/angle.h"
#include "sim/robot/object_command.h"
#include "sim/robot/robot.h"
#include "sim/robot/words.h"

namespace drover::sim {

std::string Robot::command(std::string_view text) {
  auto words = split(text);
  if (words.empty()) return error("no command");
  const std::string_view verb = words[0];
  if (verb == "obstacle" && words.size() > 2 && plant_.object_slots() > 0) {
    const std::span<const std::string_view> rest(words.data() + 2, words.size() - 2);
    // The world's own boxes are moved, and taken away, as ever.
    if (is_object_command(rest) || (rest[0] == "remove" && plant_.remove_object(words[1])))
      return rest[0] == "remove" ? "ok" : command_object(plant_, words[1], rest);
  }
  words.resize(5);  // missing words are empty
  const auto force = [this](LineName line, std::string_view word, std::string_view on,
                            std::string_view off) {
    if (word != on && word != off)
      return error("say " + std::string(on) + " or " + std::string(off));
    forced_[static_cast<std::size_t>(line)] = word == on ? Override(true) : Override();
    return std::string("ok");
  };
  if (verb == "estop") {
    const auto answer = force(LineName::estop, words[1], "press", "release");
    supply_drives();
    return answer;
  }
  if (verb == "bumper") return force(LineName::bumper, words[1], "touch", "free");
  if (verb == "zone" && words[1] == "near")
    return force(LineName::zone_near, words[2], "occupied", "free");
  if (verb == "zone" && words[1] == "far")
    return force(LineName::zone_far, words[2], "occupied", "free");
  if (verb == "obstacle") return command_obstacle(words[1], words[2], words[3]);
  // A further one has a name, the first of its kind goes without.
  const std::span<const std::string_view> rest(words.data() + 1, words.size() - 1);
  const std::string what = verb == "battery" ? std::string(words[2]) : state_of(rest.subspan(1));
  if (auto answer = more_.command(verb, words[1], what, words[3], now_)) return *answer;
  if (verb == "gnss") return command_gnss(state_of(rest));
  if (verb == "imu") return command_imu(state_of(rest));
  if (verb == "lidar") return command_lidar(words[1]);
  if (verb == "battery") return command_battery(words[1], words[2]);
  if (verb == "drive") return drives_.command(words[1], words[2], words[3], now_);
  if (verb == "kick") {
    const auto vx_mps = number(words[1]);
    const auto vy_mps = number(words[2]);
    if (!vx_mps || !vy_mps) return error("say: kick VX VY");
    plant_.kick(*vx_mps, *vy_mps);
    return "ok";
  }
  if (verb == "supply") return command_supply(words[1], words[2]);
  if (verb == "push") return command_push(rest);
  if (verb == "push_tip") return command_push_tip(rest);
  if (verb == "carry") return command_carry(rest);
  if (verb == "shove") return command_shove(rest);
  if (verb == "slip") return command_slip(rest);
  if (verb == "sideslip") return command_sideslip(rest);
  if (verb == "slope") return command_slope(rest[0]);
  if (verb == "truth") return truth_text();
  return error("unknown command '" + std::string(verb) + "'");
}

std::string Robot::command_obstacle(std::string_view name, std::string_view x, std::string_view y) {
  const auto x_m = number(x);
  const auto y_m = number(y);
  if (x != "remove" && (!x_m || !y_m)) return error("say: obstacle NAME X Y, or NAME remove");
  const bool known =
      x == "remove" ? plant_.remove_obstacle(name) : plant_.set_obstacle(name, *x_m, *y_m);
  return known ? "ok" : error("no movable obstacle '" + std::string(name) + "' in the world");
}

std::string Robot::command_gnss(std::string_view state) {
  if (!gnss_) return error("the scenario has no receiver");
  return gnss_->set_state(state, now_) ? "ok"
                                       : error("no receiver state '" + std::string(state) + "'");
}

std::string Robot::command_imu(std::string_view state) {
  if (!imu_ && !can_imu_) return error("the scenario has no inertial sensor");
  if (state.empty()) return error("say: imu STATE, or imu well");
  return (can_imu_ ? can_imu_->command(state, now_)
                   : imu_->set_state(state == "well" ? "" : state, now_))
             ? "ok"
             : error("no state '" + std::string(state) + "' of an inertial sensor");
}

std::string Robot::command_lidar(std::string_view state) {
  if (!lidar_) return error("the scenario has no lidar");
  return lidar_->command(state, now_) ? "ok"
                                      : error("no state '" + std::string(state) + "' of a lidar");
}

std::string Robot::command_battery(std::string_view what, std::string_view value) {
  if (!battery_) return error("the scenario has no battery");
  const auto percent = number(value);
  if (what == "soc" && percent && *percent >= 0 && *percent <= 100) {
    battery_->set_soc(*percent);
  } else if (what == "charger" && (value == "plug" || value == "unplug")) {
    battery_->set_charger(value == "plug");
  } else {
    return error("say: battery soc PERCENT, or battery charger plug|unplug");
  }
  return "ok";
}

std::string Robot::command_supply(std::string_view verb, std::string_view seconds) {
  const auto lasts_s = number(seconds);
  if (verb != "dip" || !lasts_s || !(*lasts_s > 0 && *lasts_s <= 60))
    return error("say: supply dip SECONDS");
  dip_until_ = now_ + from_s(*lasts_s);
  supply_drives();
  return "ok";
}

std::string Robot::command_push(std::span<const std::string_view> numbers) {
  const auto ahead_N = number(numbers[0]);
  const auto left_N = number(numbers[1]);
  const auto lasts_s = number(numbers[2]);
  if (!ahead_N || !left_N || !lasts_s || !(*lasts_s > 0)) return error("say: push FX FY SECONDS");
  plant_.push(*ahead_N, *left_N);
  push_until_ = now_ + from_s(*lasts_s);
  return "ok";
}

std::string Robot::command_push_tip(std::span<const std::string_view> numbers) {
  const auto east_N = number(numbers[0]);
  const auto north_N = number(numbers[1]);
  const auto up_N = number(numbers[2]);
  const auto lasts_s = number(numbers[3]);
  if (!east_N || !north_N || !up_N || !lasts_s || !(*lasts_s > 0))
    return error("say: push_tip FX FY FZ SECONDS");
  if (!plant_.push_tip({*east_N, *north_N, *up_N})) return error("the world has no arm's tip");
  push_tip_until_ = now_ + from_s(*lasts_s);
  return "ok";
}

std::string Robot::command_carry(std::span<const std::string_view> numbers) {
  const auto ahead_m = number(numbers[0]);
  const auto left_m = number(numbers[1]);
  const auto turn_deg = number(numbers[2]);
  const auto lasts_s = number(numbers[3]);
  if (!ahead_m || !left_m || !turn_deg || !lasts_s || !(*lasts_s > 0))
    return error("say: carry DX DY DEGREES SECONDS");
  carry_ = Carry{now_, *lasts_s, *ahead_m, *left_m, to_rad(*turn_deg)};
  return "ok";
}

std::string Robot::truth_text() const {
  std::array<char, 512> text{};
  const auto& t = truth_;
  const int n = std::snprintf(
      text.data(), text.size(),
      "{\"time_s\":%.9f,\"x_m\":%.6f,\"y_m\":%.6f,\"z_m\":%.6f,\"roll_rad\":%.6f,"
      "\"pitch_rad\":%.6f,\"yaw_rad\":%.6f,\"vx_mps\":%.6f,\"vy_mps\":%.6f,\"wz_radps\":%.6f,"
      "\"free_ahead_m\":%.3f,\"supply\":%s",
      to_s(t.time), t.pose.x_m, t.pose.y_m, t.pose.z_m, t.pose.roll_rad, t.pose.pitch_rad,
      t.pose.yaw_rad, t.velocity.vx_mps, t.velocity.vy_mps, t.velocity.wz_radps,
      std::min(t.free_ahead_m, 999.0), t.supply ? "true" : "false");
  return std::string(text.data(), static_cast<std::size_t>(n)) + arm_text() + "}";
}

std::string Robot::arm_text() const {
  const auto tip_m = plant_.tip_m();
  if (truth_.arm.empty() || !tip_m) return "";
  std::array<char, 160> text{};
  int n = std::snprintf(text.data(), text.size(), ",\"tip_m\":[%.6f,%.6f,%.6f],\"arm_rad\":{",
                        tip_m->x, tip_m->y, tip_m->z);
  std::string all(text.data(), static_cast<std::size_t>(n));
  const auto names = drives_.arm_joints();
  for (std::size_t i = 0; i < names.size(); ++i) {
    n = std::snprintf(text.data(), text.size(), "\":%.6f", truth_.arm[i].position_rad);
    all += (i > 0 ? ",\"" : "\"") + names[i];
    all.append(text.data(), static_cast<std::size_t>(n));
  }
  return all + "}";
}

}  // namespace drover::sim
