// Makes a scenario of many short drives in one run, with things that appear ahead of the robot and
// beside it while it drives: all of it from the seed. tests/mission/scenes plays them.
#include <CLI/CLI.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include "mission/robot.h"
#include "mission/scene_drive.h"

namespace {

using namespace drover::mission;
using nlohmann::ordered_json;

// Rows with U-turns between them, so that a drive is along straights and curves of both hands.
constexpr double kRow_m = 30;
constexpr double kRadius_m = 2.5;
constexpr double kUturn_m = M_PI * kRadius_m;
constexpr double kStart_x_m = -15;
constexpr double kStart_y_m = -20;

/// Numbers of a distribution of our own: the library's differ between libraries.
class Dice {
 public:
  explicit Dice(std::uint64_t seed) : random_(seed) {}
  double from(double low, double high) {
    return low + (high - low) * std::ldexp(static_cast<double>(random_() >> 11U), -53);
  }
  bool happens(double share) { return from(0, 1) < share; }
  double side() { return happens(0.5) ? 1 : -1; }

 private:
  std::mt19937_64 random_;
};

double rounded(double value) {
  return std::round(value * 1e4) / 1e4;
}

struct Spot {
  double x_m = 0;
  double y_m = 0;
  double yaw_rad = 0;
};

/// So far along the rows.
Spot spot(double s_m) {
  const double period_m = kRow_m + kUturn_m;
  const auto row = static_cast<int>(std::floor(s_m / period_m));
  const double at_m = s_m - row * period_m;
  const bool east = row % 2 == 0;
  const double y_m = kStart_y_m + 2 * kRadius_m * row;
  const double begin_m = east ? kStart_x_m : kStart_x_m + kRow_m;
  const double sign = east ? 1 : -1;
  if (at_m < kRow_m) return {begin_m + sign * at_m, y_m, east ? 0 : M_PI};
  const double turned_rad = (at_m - kRow_m) / kRadius_m;
  return {begin_m + sign * (kRow_m + kRadius_m * std::sin(turned_rad)),
          y_m + kRadius_m * (1 - std::cos(turned_rad)), east ? turned_rad : M_PI - turned_rad};
}

ordered_json track(double length_m) {
  auto shapes = ordered_json::array();
  for (int row = 0; length_m > 0; ++row) {
    shapes.push_back({{"straight_m", kRow_m}});
    shapes.push_back({{"turn_deg", row % 2 == 0 ? 180 : -180}, {"radius_m", kRadius_m}});
    length_m -= kRow_m + kUturn_m;
  }
  return shapes;
}

/// So far it is by then, to a few centimetres: it takes a moment to begin, and a ramp.
double driven_m(double v_mps, double at_s) {
  constexpr double kBegins_s = 0.2;
  constexpr double kGains_mps2 = 0.42;
  const double moves_s = std::max(at_s - kBegins_s, 0.0);
  const double ramp_s = std::min(v_mps / kGains_mps2, moves_s);
  return kGains_mps2 * ramp_s * ramp_s / 2 + v_mps * (moves_s - ramp_s);
}

struct Thing {
  ordered_json object;
  double reach_m = 0;  ///< from its middle
};

Thing draw_thing(Dice& dice, const std::string& id) {
  Thing thing;
  thing.object["id"] = id;
  const double kind = dice.from(0, 1);
  if (kind < 0.45) {
    const double length_m = dice.from(0.05, 0.8);
    const double width_m = dice.from(0.05, 0.8);
    thing.object["box"] = {rounded(length_m), rounded(width_m), rounded(dice.from(0.2, 1.5))};
    thing.object["yaw_deg"] = rounded(dice.from(-180, 180));
    thing.reach_m = std::hypot(length_m, width_m) / 2;
  } else if (kind < 0.75) {
    thing.reach_m = dice.happens(0.3) ? 0.01 : dice.from(0.05, 0.4);
    thing.object["cylinder"] = {rounded(thing.reach_m), rounded(dice.from(0.3, 1.8))};
  } else if (kind < 0.9) {
    thing.reach_m = dice.from(0.1, 0.4);
    thing.object["sphere"] = {rounded(thing.reach_m)};
  } else {
    thing.reach_m = dice.from(0.15, 0.4);
    thing.object["cone"] = {rounded(thing.reach_m), rounded(dice.from(0.4, 1.2))};
  }
  return thing;
}

constexpr double kNearStays_s = 4;

/// Something appears where the robot cannot stop any more: by the clock alone nobody knows how far
/// it came by then, so by its place, on a row. When it is gone at the latest; nothing: it is in a
/// curve there.
std::optional<double> add_near(Dice& dice, const std::string& name, double begin_m, double v_mps,
                               ordered_json& steps) {
  const double at_m = begin_m + dice.from(2.5, 4.5);  // it has its speed by then
  const Spot robot = spot(at_m);
  const bool east = robot.yaw_rad == 0;
  auto thing = draw_thing(dice, name + "_near");
  const double ahead_m = dice.from(0.03, braking_way_m(v_mps) + kMargin_m - 0.05);
  const Spot there = spot(at_m + RobotShape{}.front_m + ahead_m + thing.reach_m);
  if ((!east && robot.yaw_rad != M_PI) || there.yaw_rad != robot.yaw_rad) return std::nullopt;
  const double aside_m = dice.from(-0.2, 0.2);
  thing.object["at"] = {rounded(there.x_m), rounded(there.y_m + aside_m)};
  const std::string put = name + "_put";
  steps.push_back({{"name", put},
                   {"after", name},
                   {"when", {{east ? "x_m_above" : "x_m_below", rounded(robot.x_m)}}},
                   {"do", {{"object", thing.object}}}});
  steps.push_back({{"after", put},
                   {"delay_s", kNearStays_s},
                   {"do", {{"object", {{"id", thing.object["id"]}, {"gone", true}}}}}});
  return (at_m - begin_m) / v_mps + 2 + kNearStays_s;
}

/// The drives' latest end after the start of a scene, and its steps.
double add_scene(Dice& dice, int number, bool last, const std::string& after, double delay_s,
                 ordered_json& steps) {
  const std::string name = "s" + std::to_string(number);
  const double v_mps = rounded(dice.from(0.25, 0.8));
  const double begin_m = number * kDrive_m;
  const auto target = static_cast<int>(std::lround((begin_m + kDrive_m) / kSpacing_m)) + 1;
  steps.push_back({{"name", name},
                   {"after", after},
                   {"delay_s", delay_s},
                   {"do", {{"start_task", {{"id", target}, {"speed_mps", v_mps}}}}}});
  const double drive_s = kDrive_m / v_mps + 2;
  double over_s = 0;
  if (!last && dice.happens(0.15))
    if (const auto gone_s = add_near(dice, name, begin_m, v_mps, steps))
      return *gone_s + drive_s + 3;
  const double many = dice.from(0, 1);
  const int things = last || many < 0.05 ? 0 : many < 0.6 ? 1 : many < 0.9 ? 2 : 3;
  for (int i = 0; i < things; ++i) {
    auto thing = draw_thing(dice, name + "_" + std::to_string(i));
    const double at_s = rounded(dice.from(0.7, 0.7 + 0.7 * kDrive_m / v_mps));
    // At most so far it is by then; nearer than that the thing cannot be.
    const double farthest_m = begin_m + v_mps * at_s;
    const double stop_m = 0.3 * v_mps + braking_way_m(v_mps) + kMargin_m;
    const bool far = dice.happens(0.8);
    const double ahead_m = far ? stop_m + dice.from(0.1, 2.5) : dice.from(0.05, stop_m);
    // What is to come too near has to know better where the robot is.
    const double robot_m = far ? farthest_m : begin_m + driven_m(v_mps, at_s);
    const double beside_m =
        dice.happens(0.6) ? dice.from(-0.5, 0.5) : dice.side() * dice.from(0.5, 1.3);
    const Spot at = spot(robot_m + RobotShape{}.front_m + ahead_m + thing.reach_m);
    thing.object["at"] = {rounded(at.x_m - beside_m * std::sin(at.yaw_rad)),
                          rounded(at.y_m + beside_m * std::cos(at.yaw_rad))};
    const double gone_s = rounded(at_s + dice.from(3, 7));
    const auto& id = thing.object["id"];
    steps.push_back({{"after", name}, {"delay_s", at_s}, {"do", {{"object", thing.object}}}});
    steps.push_back(
        {{"after", name}, {"delay_s", gone_s}, {"do", {{"object", {{"id", id}, {"gone", true}}}}}});
    over_s = std::max(over_s, gone_s);
  }
  // Whatever held it was away by then, and it had the time for all of its drive.
  return over_s + drive_s + 3;
}

}  // namespace

int main(int argc, char** argv) {
  std::uint64_t seed = 1;
  int scenes = 20;
  std::string robot;
  CLI::App app("Makes a scenario of many short drives with things in the way.", "scene_maker");
  app.add_option("--seed", seed, "of everything random")->capture_default_str();
  app.add_option("--scenes", scenes, "how many drives")->capture_default_str();
  app.add_option("--robot", robot, "the robot's file")->required();
  CLI11_PARSE(app, argc, argv);

  Dice dice(seed);
  auto steps = ordered_json::array();
  steps.push_back({{"name", "save"}, {"after", "ready"}, {"do", {{"save", true}}}});
  std::string after = "saved";
  double delay_s = 1;
  double whole_s = 30;
  for (int i = 0; i < scenes; ++i) {
    const double lasts_s = rounded(add_scene(dice, i, i + 1 == scenes, after, delay_s, steps));
    after = "s" + std::to_string(i);
    delay_s = lasts_s;
    whole_s += lasts_s;
  }
  steps.push_back(
      {{"name", "over"}, {"after", after}, {"delay_s", delay_s}, {"do", ordered_json::array()}});
  const ordered_json document{
      {"name", "scenes"},
      {"description", "Many short drives with things in the way, seed " + std::to_string(seed)},
      {"robot", robot},
      {"gateway", {{"navigate", {{"first_way_m", 0}}}}},
      {"start", {{"x_m", kStart_x_m}, {"y_m", kStart_y_m}, {"yaw_deg", 0}}},
      {"mission",
       {{"track_name", "scenes"},
        {"track", track(scenes * kDrive_m + 5)},
        {"automatic", false},
        {"steps", steps},
        {"end", {{"after", "over"}, {"delay_s", 0.5}}},
        {"timeout_s", rounded(whole_s + 60)}}}};
  std::printf("%s\n", document.dump(1).c_str());
  return 0;
}
