// Missions of 200 m with a seeded mixture of what ordinarily goes wrong in a field.
#include "bench/field_mission.h"

#include <algorithm>
#include <cstdio>
#include <random>

namespace drover::bench {
namespace {

constexpr double kWay_m = 200;
constexpr double kTurn_m = kPi * 1.5;
// Trouble begins within so long; a receiver has some all the time, also when it takes longer.
constexpr double kNormally_s = 420;
constexpr double kAtMost_s = 1500;

/// Without the standard library's distributions, which differ.
class Dice final {
 public:
  explicit Dice(std::uint64_t seed) : random_(seed) {}
  double between(double low, double high) {
    return low + (high - low) * (static_cast<double>(random_() >> 11) + 0.5) / 9007199254740992.0;
  }
  /// As often from 1 to 2 as from 10 to 20.
  double between_scales(double low, double high) {
    return std::exp(between(std::log(low), std::log(high)));
  }
  double after(double mean) { return -mean * std::log(between(0, 1)); }
  bool chance(double share) { return between(0, 1) < share; }
  /// 0 to `most`, each as often.
  int up_to(int most) { return static_cast<int>(between(0, most + 1)); }
  double either_side(double size) { return chance(0.5) ? size : -size; }

 private:
  std::mt19937_64 random_;
};

using Kind = Trouble::Kind;

/// Fixed most of the time; what comes next depends on what is. Under trees and beside walls: a
/// float is often all, an outage mostly comes back by a float.
void draw_fixes(FieldPlan& plan, Dice& dice) {
  enum class Quality { fixed, floats, none } quality = Quality::fixed;
  for (double at_s = 0; at_s < kAtMost_s;) {
    double for_s = 0;
    switch (quality) {
      case Quality::fixed:
        for_s = 1 + dice.after(70);
        quality = dice.chance(0.75) ? Quality::floats : Quality::none;
        break;
      case Quality::floats:
        for_s = dice.between_scales(0.3, 10);
        plan.more.push_back({Kind::floats, {at_s, at_s + for_s}});
        quality = dice.chance(0.85) ? Quality::fixed : Quality::none;
        break;
      case Quality::none:
        for_s = dice.between_scales(2, 30);
        plan.more.push_back({Kind::outage, {at_s, at_s + for_s}});
        quality = dice.chance(0.7) ? Quality::floats : Quality::fixed;
        break;
    }
    at_s += for_s;
  }
}

void draw_ground(FieldPlan& plan, Dice& dice) {
  for (int i = dice.up_to(4); i > 0; --i) {
    const double at_s = dice.between(0, kNormally_s);
    plan.more.push_back(
        {Kind::slip, {at_s, at_s + dice.between_scales(1, 10)}, dice.between(0.10, 0.35)});
  }
  double at_m = 0;
  for (int i = dice.up_to(2); i > 0; --i) {
    at_m += dice.between(2, 80);
    const double long_m = dice.between(5, 40);
    plan.more.push_back({Kind::slope, {at_m, at_m + long_m}, dice.between(1, 5)});
    at_m += long_m;
  }
}

void draw_rare(FieldPlan& plan, Dice& dice) {
  if (dice.chance(0.2)) {
    const double at_s = dice.between(0, kNormally_s);
    plan.more.push_back({Kind::step,
                         {at_s, at_s + dice.between_scales(2, 20)},
                         dice.between(0.05, 0.40),
                         dice.between(0, 2 * kPi)});
  }
  if (dice.chance(0.2)) {
    const double at_s = dice.between(0, kNormally_s);
    plan.more.push_back(
        {Kind::shove, {at_s, at_s + 0.4}, dice.either_side(dice.between(0.10, 0.40))});
  }
}

std::string line(const Trouble& t) {
  char text[120] = "";
  const double for_s = t.span.to - t.span.from;
  const auto write = [&](const char* format, auto... values) {
    std::snprintf(text, sizeof text, format, values...);
  };
  switch (t.kind) {
    case Kind::slip:
      write("%.1f s: slip of %.0f %% for %.1f s", t.span.from, 100 * t.size, for_s);
      break;
    case Kind::slope:
      write("%.1f m on: side slope of %.1f degrees for %.0f m", t.span.from, t.size, for_s);
      break;
    case Kind::shove:
      write("%.1f s: shoved %.2f m to the %s", t.span.from, std::abs(t.size),
            t.size > 0 ? "left" : "right");
      break;
    case Kind::outage: write("%.1f s: no receiver for %.1f s", t.span.from, for_s); break;
    case Kind::floats: write("%.1f s: float for %.1f s", t.span.from, for_s); break;
    case Kind::step:
      write("%.1f s: positions %.2f m off for %.1f s, to %.0f degrees", t.span.from, t.size, for_s,
            to_deg(t.towards_rad));
      break;
  }
  return text;
}

}  // namespace

FieldMission draw_mission(std::uint64_t seed) {
  Dice dice(seed);
  FieldMission mission;
  FieldPlan& plan = mission.plan;
  mission.rows = 3 + dice.up_to(5);
  mission.leg_m = (kWay_m - (mission.rows - 1) * kTurn_m) / mission.rows;
  plan.heading_off_deg = dice.between(-2, 2);
  plan.late_s = dice.between(0, 0.06);
  plan.tyres = dice.between(0.98, 1.02);
  plan.gst = dice.chance(0.5);
  draw_fixes(plan, dice);
  draw_ground(plan, dice);
  draw_rare(plan, dice);
  return mission;
}

std::string in_words(const FieldMission& mission) {
  const FieldPlan& plan = mission.plan;
  char text[160];
  std::snprintf(text, sizeof text,
                "%d rows of %.1f m, antenna line %+.2f degrees, stamps %.0f ms late, tyres %+.2f "
                "%%, %s\n",
                mission.rows, mission.leg_m, plan.heading_off_deg, 1e3 * plan.late_s,
                100 * (plan.tyres - 1), plan.gst ? "GST" : "no GST");
  std::string words = text;
  std::vector<Trouble> all = plan.more;
  std::stable_sort(all.begin(), all.end(), [](const Trouble& a, const Trouble& b) {
    const bool a_slope = a.kind == Kind::slope;
    const bool b_slope = b.kind == Kind::slope;
    return a_slope != b_slope ? a_slope : a.span.from < b.span.from;
  });
  for (const Trouble& t : all) words += line(t) + "\n";
  return words;
}

}  // namespace drover::bench
