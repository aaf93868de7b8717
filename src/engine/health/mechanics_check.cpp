// The first way of a boot or a configuration: wheels, gyro and receiver have to agree on it.
#include "engine/health/mechanics_check.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "drover/angle.h"
#include "engine/base/words.h"
#include "engine/health/first_way_words.h"
#include "engine/health/ground_way.h"
#include "engine/health/place_sigma.h"
#include "engine/still.h"

namespace drover::engine {
namespace {

constexpr double kFirst_mps = 0.05;
constexpr double kSpeedUp_s = 1.0;  // a ratio of ten is ten times as fast
constexpr double kStill_s = 1.0;
constexpr Duration kSettles = std::chrono::milliseconds(200);
constexpr Duration kHardlyMoves = std::chrono::milliseconds(300);  // it begins with a centimetre
constexpr double kGyroStale_s = 0.1;
constexpr double kHeadingStale_s = 0.5;
constexpr double kMostDifference = 1.4;  // of a rim from the base, as a share of its speed
// Soil turns a base by itself, and the yaw gain is known within a factor; a wrong sign is twice the
// turn.
const double kTurnMargin_rad = to_rad(4.0);
constexpr double kTurnShare = 0.7;
// Of ways: slip is less than this, a wrong ratio is at least 2.
constexpr double kWayRatio = 1.5;
constexpr double kWaySigmas = 2.5;        // two positions in succession
constexpr double kWaySigmasAtOnce = 5.0;  // one
constexpr double kFewestPlaces = 3;
constexpr double kMostRatio = 12;  // of gears that somebody got wrong
constexpr double kJumpSigmas = 5.0;
constexpr double kJumpsFrom_m = 0.05;
const double kSameWay = std::cos(to_rad(60.0));  // of two jumps
// A position is a second apart from the next one, and late.
constexpr double kComparedShare = 2.0 / 3;
constexpr double kShortest_m = 0.1;  // of a way that is found too short

/// Of the newest in a running mean of about a second.
double share_of_mean(int count) {
  return 1.0 / std::min(count, 10);
}

}  // namespace

MechanicsCheck::MechanicsCheck(const EngineConfig& config)
    : config_(config),
      words_(&words_of(kinematics_of(config.base))),
      proved_(!(config.navigate.first_way_m > 0)),
      swing_(config.base, Swing::way_m(config.base, config.navigate.first_way_m)),
      has_sides_(!takes_twist(kinematics_of(config.base))),
      antenna_(antenna_of(config.estimate, kMaxOfKind)) {
  // A base that steers needs a longer way for the same turns.
  config_.navigate.first_way_m = Swing::way_m(config.base, config.navigate.first_way_m);
}

void MechanicsCheck::begin() {
  moving_ = true;
  began_ = now_;
  rolled_m_ = compared_m_ = asked_rad_ = 0;
  swing_.begin();
  place_turn_.begin();
  began_yaw_rad_ = yaw_rad_;
  guided_ = turn_known_ = false;
  last_ = {};
  marks_.clear();
  heading_turn_rad_ = kAbsent;
  odd_places_ = 0;
  last_way_ = jumped_ = {};
  last_rolled_m_ = 0;
}

void MechanicsCheck::on_position(const GnssPosition& position, Time at) {
  const bool usable = position.quality == FixQuality::rtk_fixed &&
                      std::isfinite(position.latitude_deg) && std::isfinite(position.longitude_deg);
  if (proved_ || !usable) return;
  position_ = position;
  position_at_ = at;
  fresh_position_ = true;
  Rest* rest = rest_at(at);
  if (rest == nullptr) return;
  const double share = share_of_mean(++rest->places);
  rest->north_deg += share * (position.latitude_deg - rest->north_deg);
  rest->east_deg += share * (position.longitude_deg - rest->east_deg);
}

/// What is said of that moment is part of this mean; nullptr: it moved.
MechanicsCheck::Rest* MechanicsCheck::rest_at(Time at) {
  const bool few = rest_.places < kFewestPlaces;
  if (!moving_ || at < began_ + (few ? kHardlyMoves : Duration{})) return &rest_;
  const bool settled = still_since_ != kNever && at - still_since_ > kSettles;
  return settled ? &settled_ : nullptr;
}

void MechanicsCheck::on_heading(const GnssHeading& heading, Time at) {
  if (proved_ || !std::isfinite(heading.heading_deg)) return;
  const double yaw_rad = yaw_rad_from_compass_deg(heading.heading_deg);
  if (Rest* rest = rest_at(at); rest != nullptr) {
    const double share = share_of_mean(++rest->headings);
    rest->heading_cos += share * (std::cos(yaw_rad) - rest->heading_cos);
    rest->heading_sin += share * (std::sin(yaw_rad) - rest->heading_sin);
    return;
  }
  if (rest_.headings == 0) return;
  heading_turn_rad_ = wrap_rad(yaw_rad - std::atan2(rest_.heading_sin, rest_.heading_cos));
  heading_at_ = at;
}

void MechanicsCheck::on_turn(double turn_radps, Time at) {
  if (proved_ || !std::isfinite(turn_radps)) return;
  const bool gap = gyro_at_ == kNever || to_s(at - gyro_at_) > kGyroStale_s;
  if (moving_ && !gap) last_.gyro_rad += turn_radps * std::max(to_s(at - gyro_at_), 0.0);
  gyro_at_ = at;
}

void MechanicsCheck::forget_receiver(const AntennaConfig& antenna) {
  antenna_ = antenna;
  rest_ = settled_ = {};
  fresh_position_ = false;
  heading_turn_rad_ = kAbsent;
  heading_at_ = kNever;
  odd_places_ = 0;
}

void MechanicsCheck::begin_anew() {
  if (proved_ || !past_first_way() || !fault_.empty()) return;
  moving_ = false;
  rest_ = settled_;
}

bool MechanicsCheck::hears_gyro(const MechanicsInput& input) const {
  return input.gyro_zero_known && gyro_at_ != kNever &&
         std::abs(to_s(input.now - gyro_at_)) < kGyroStale_s;
}

double MechanicsCheck::turned_rad(const MechanicsInput& input) const {
  if (hears_gyro(input)) return last_.gyro_rad;
  const bool heading =
      std::isfinite(heading_turn_rad_) && to_s(input.now - heading_at_) < kHeadingStale_s;
  return heading ? heading_turn_rad_ : kAbsent;
}

void MechanicsCheck::compare_turn(const MechanicsInput& input) {
  const auto apart = [](double other_rad, double wheels_rad) {
    return std::abs(other_rad - wheels_rad) > kTurnMargin_rad + kTurnShare * std::abs(wheels_rad);
  };
  if (hears_gyro(input)) {
    if (apart(last_.gyro_rad, last_.wheels.turn_rad)) fault_ = odd_turn(*words_, turns());
    return;
  }
  const Mark* then = std::isfinite(heading_turn_rad_) ? marks_.at(heading_at_) : nullptr;
  if (then == nullptr || !apart(heading_turn_rad_, then->wheels.turn_rad)) return;
  fault_ = odd_turn_by_receiver(*words_, then->wheels.turn_rad, heading_turn_rad_);
}

void MechanicsCheck::say_no_swing(bool by_gyro) {
  const bool gyro_is_odd = by_gyro && std::isfinite(heading_turn_rad_) &&
                           std::abs(heading_turn_rad_ - last_.gyro_rad) > kTurnMargin_rad;
  fault_ = gyro_is_odd ? odd_turn(*words_, turns())
                       : no_swing(config_, {.asked_rad = swing_.asked_rad(),
                                            .wheels_rad = swing_.wheels_rad(),
                                            .turned_rad = swing_.turned_rad(),
                                            .by_gyro = by_gyro});
}

/// Wheels of one axle that work against those of the other turn nothing, and their mean is what
/// was asked for, or near to it: no comparison with it tells.
void MechanicsCheck::watch_swing(const MechanicsInput& input) {
  const double told = input.yaw_slip_factor / config_.base.yaw_slip_factor;
  asked_rad_ += input.asked_radps * told * std::max(to_s(input.dt), 0.0);
  const double turned = turned_rad(input);
  turn_known_ = turn_known_ || std::isfinite(turned);
  if (!guided_) return;
  swing_.step({rolled_m_, asked_rad_, last_.wheels.turn_rad, turned, shown_by_places(),
               place_turn_.verdict() == PlaceTurn::Verdict::right});
  if (swing_.failed()) say_no_swing(hears_gyro(input));
}

/// What comes at once is no ratio: another integer solution, or a shove, on which others look. Two
/// that go the same way are one: of a receiver that tells a position each second.
bool MechanicsCheck::jumps(const PathPoint& way, const Mark& wheels, double sigma_m) {
  const PathPoint step{way.x_m - last_way_.x_m, way.y_m - last_way_.y_m};
  const double rolled_m = std::abs(wheels.way_m - last_rolled_m_);
  last_way_ = way;
  last_rolled_m_ = wheels.way_m;
  const double most_m = kMostRatio * rolled_m + std::max(kJumpSigmas * sigma_m, kJumpsFrom_m);
  if (!(std::hypot(step.x_m, step.y_m) > most_m)) return false;
  const double along_m2 = step.x_m * jumped_.x_m + step.y_m * jumped_.y_m;
  const double most_m2 = std::hypot(step.x_m, step.y_m) * std::hypot(jumped_.x_m, jumped_.y_m);
  if (most_m2 > 0 && along_m2 > kSameWay * most_m2) return false;
  jumped_.x_m += step.x_m;
  jumped_.y_m += step.y_m;
  return true;
}

/// With one antenna and no gyro. What takes a twist turns by itself, and has no sides that somebody
/// could have swapped.
bool MechanicsCheck::shown_by_places() const {
  return has_sides_ && !turn_known_ && rest_.places >= kFewestPlaces &&
         std::isfinite(began_yaw_rad_);
}

void MechanicsCheck::compare_aside(const PathPoint& went, const Mark& wheels, double sigma_m) {
  if (!shown_by_places()) return;
  const double c = std::cos(began_yaw_rad_);
  const double s = std::sin(began_yaw_rad_);
  place_turn_.look(wheels.wheels, {went.x_m * c + went.y_m * s, went.y_m * c - went.x_m * s},
                   antenna_, sigma_m);
  if (place_turn_.verdict() == PlaceTurn::Verdict::open ||
      place_turn_.verdict() == PlaceTurn::Verdict::right)
    return;
  fault_ = odd_turn_by_places(config_, place_turn_.wheels_rad(), place_turn_.turned_rad(),
                              place_turn_.verdict() == PlaceTurn::Verdict::against);
}

void MechanicsCheck::compare_place(const Mark& wheels) {
  GnssPosition from = position_;
  from.latitude_deg = rest_.north_deg;
  from.longitude_deg = rest_.east_deg;
  const PathPoint went = ground_way(from, position_);
  const double sigma_m = place_sigma_m(position_, config_.estimate);
  if (!compare_way(went, wheels, sigma_m) || !fault_.empty()) return;
  compare_aside({went.x_m - jumped_.x_m, went.y_m - jumped_.y_m}, wheels, sigma_m);
}

/// False: the position jumps, and tells nothing of a way.
bool MechanicsCheck::compare_way(const PathPoint& went, const Mark& wheels, double sigma_m) {
  PathPoint way = went;
  const double turn_rad =
      std::isfinite(heading_turn_rad_) ? heading_turn_rad_ : wheels.wheels.turn_rad;
  const double yaw0_rad = yaw_rad_ - turn_rad;
  if (std::isfinite(yaw_rad_)) {
    // The antenna swings about the base as it turns.
    const double ax = antenna_.x_m;
    const double ay = antenna_.y_m;
    const auto arm = [&](double yaw) {
      return PathPoint{ax * std::cos(yaw) - ay * std::sin(yaw),
                       ax * std::sin(yaw) + ay * std::cos(yaw)};
    };
    const PathPoint before = arm(yaw0_rad);
    const PathPoint after = arm(yaw_rad_);
    way.x_m -= after.x_m - before.x_m;
    way.y_m -= after.y_m - before.y_m;
  }
  if (jumps(way, wheels, sigma_m)) return false;
  compared_m_ = wheels.rolled_m;
  way.x_m -= jumped_.x_m;
  way.y_m -= jumped_.y_m;
  const double rolled_m = wheels.way_m;
  const double gone_m = std::hypot(way.x_m, way.y_m);
  const double ahead_m = std::isfinite(yaw_rad_)
                             ? way.x_m * std::cos(yaw0_rad) + way.y_m * std::sin(yaw0_rad)
                             : gone_m;
  const bool back = ahead_m * rolled_m < 0;
  const double too_much_m = back ? std::abs(ahead_m) : gone_m - kWayRatio * std::abs(rolled_m);
  const double too_little_m =
      std::abs(rolled_m) > kShortest_m ? std::abs(rolled_m) - kWayRatio * gone_m : 0.0;
  const double odd_m = std::max(too_much_m, too_little_m);
  odd_places_ = odd_m > kWaySigmas * sigma_m ? odd_places_ + 1 : 0;
  if (odd_places_ < 2 && !(odd_m > kWaySigmasAtOnce * sigma_m)) return true;
  fault_ = odd_way(*words_, {.wheels_m = rolled_m,
                             .ahead_m = ahead_m,
                             .gone_m = gone_m,
                             .is_short = too_little_m > too_much_m});
  return true;
}

void MechanicsCheck::step(const MechanicsInput& input) {
  now_ = input.now;
  if (proved_) return;
  yaw_rad_ = input.yaw_rad;
  yaw_slip_factor_ = input.yaw_slip_factor;
  const bool still = !input.commanded && input.fastest_mps < kStands_mps;
  if (!still) {
    still_since_ = kNever;
    settled_ = {};
  }
  if (still && still_since_ == kNever) still_since_ = input.now;
  if (moving_ && still && input.now - still_since_ >= from_s(kStill_s)) {
    moving_ = false;
    rest_ = settled_;
    fault_.clear();
  }
  if (!moving_ && input.commanded) begin();
  if (!moving_) return;
  // By single joints: rollers slip, and no way aside is in the comparison.
  if (goes_sideways(input.body)) rest_ = {};
  const double dt_s = std::max(to_s(input.dt), 0.0);
  last_.way_m += input.body.vx_mps * dt_s;
  WheelsWay& wheels = last_.wheels;
  wheels.turn_rad += input.body.wz_radps / config_.base.yaw_slip_factor * dt_s;
  wheels.left_m += input.body.vx_mps * std::sin(wheels.turn_rad) * dt_s;
  const bool was_past = past_first_way();
  rolled_m_ += std::abs(input.body.vx_mps) * dt_s;
  last_.rolled_m = rolled_m_;
  last_.at = input.now;
  marks_.remember(last_);
  if (!fault_.empty() || was_past) return;
  watch_swing(input);
  if (fault_.empty()) compare_turn(input);
  if (fresh_position_ && fault_.empty() && rest_.places >= kFewestPlaces) {
    if (const Mark* then = marks_.at(position_at_); then != nullptr) compare_place(*then);
  }
  fresh_position_ = false;
  if (!fault_.empty() || !past_first_way()) return;
  went_first_ = true;
  const bool by_places = has_sides_ && !turn_known_;
  const bool swung = by_places ? place_turn_.verdict() == PlaceTurn::Verdict::right
                               : !turn_known_ || (guided_ && swing_.happened());
  proved_ =
      swung && odd_places_ == 0 && compared_m_ >= kComparedShare * config_.navigate.first_way_m;
}

double MechanicsCheck::speed_cap_mps(FirstWay who) const {
  const bool gone = fault_.empty() && ((who == FirstWay::task && past_first_way()) ||
                                       (who == FirstWay::joints && went_first_));
  if (proved_ || gone) return std::numeric_limits<double>::infinity();
  const double age_s = moving_ ? to_s(now_ - began_) : 0.0;
  return kFirst_mps * std::clamp(age_s / kSpeedUp_s, 0.2, 1.0);
}

Reason MechanicsCheck::slowly(FirstWay who) const {
  Reason why;
  if (!moving_ || !fault_.empty() || std::isinf(speed_cap_mps(who))) return why;
  const double first_m = config_.navigate.first_way_m;
  const double left_m = first_m - rolled_m_;
  if (left_m > 0) {
    // Never "0.00 m are left".
    why.format("slowly: %s, gyro and receiver are compared on the first %.3g m, %.2f m are left",
               words_->wheels, first_m, std::max(left_m, 0.01));
  } else if (guided_ && !swing_.is_over()) {
    why = "slowly: it was not seen to turn to both sides yet";
  } else if (awaits_turn()) {
    // So far from where it began nothing shows it any more.
    why = "slowly: its turn was not seen; let it rest for two seconds, and it turns again";
  } else {
    why.format("slowly: %s, gyro and receiver could not be compared yet", words_->wheels);
  }
  return why;
}

Twist MechanicsCheck::guide(const Twist& wanted) {
  if (proved_ || past_first_way() || !(std::abs(wanted.vx_mps) > 0)) return wanted;
  guided_ = true;
  Twist twist = wanted;
  const double cap_mps = speed_cap_mps(FirstWay::hand);
  twist.vx_mps = std::clamp(wanted.vx_mps, -cap_mps, cap_mps);
  // Nobody saw it turn; it is steered again, on the same curve, until it rests.
  if (swing_.is_over()) {
    twist.wz_radps *= std::abs(twist.vx_mps / wanted.vx_mps);
    return twist;
  }
  // What was learned of a turn that never came would ask for more and more.
  const double half_m = config_.base.track_m / 2;
  const double most =
      std::max(kMostDifference, swing_.usual_radpm() * half_m * config_.base.yaw_slip_factor);
  const double most_radpm = most / (half_m * std::max(yaw_slip_factor_, 0.1));
  twist.wz_radps = std::clamp(swing_.radpm(), -most_radpm, most_radpm) * std::abs(twist.vx_mps);
  return twist;
}

}  // namespace drover::engine
