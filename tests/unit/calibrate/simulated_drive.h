// A drive with planted errors: a base that slips and drifts a little, a receiver whose errors stay
// for half a minute, a gyro. Pure and seeded: equal seeds give equal drives everywhere.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

#include "calibrate/calibrate.h"
#include "drover/angle.h"

namespace drover::calibrate {

/// What is wrong with the robot, against `Configured`.
struct Planted {
  double left_scale = 1;
  double right_scale = 1;
  double yaw_slip_factor = 1.2;
  double antenna_x_m = 0;
  double antenna_y_m = 0;
  double heading_offset_deg = 0;
  double position_late_s = 0;
  double heading_late_s = 0;
  double gyro_scale = 1;
  double gyro_bias_radps = 0;
  double dead_s = 0.02;
  double lag_s = 0.1;
  double speed_late_s = 0;
  bool speed_by_positions = false;
  bool left_reversed = false;
  bool right_reversed = false;
  bool swapped = false;
  bool gyro_reversed = false;
};

struct Leg {
  double for_s;
  double vx_mps;
  double wz_radps;
};
using Legs = std::vector<Leg>;

/// Rest, changes of speed while straight, a left and a right circle, there and back.
inline Legs good_legs() {
  return {{6, 0, 0},      {4, 0.3, 0}, {4, 0.7, 0},     {4, 0.3, 0},  {4, 0.7, 0},   {4, 0.3, 0},
          {18, 0.4, 0.4}, {6, 0.6, 0}, {18, 0.4, -0.4}, {5, 0.7, 0},  {8, 0.2, 0.4}, {8, 0.7, 0},
          {4, 0.3, 0},    {6, 0.7, 0}, {5, 0, 0.6},     {5, 0, -0.6}, {8, 0.6, 0},   {6, 0, 0}};
}

/// How noisy it is: one sigma each.
struct Noisy {
  double place_white_m = 0.004;
  double place_slow_m = 0.008;
  double place_slow_s = 30;
  double heading_white_deg = 0.25;
  double heading_slow_deg = 0.12;
  double gyro_radps = 0.003;
  double rim_share = 0.002;
  double along = 0.008;      ///< per square root of metre
  double across = 0.005;     ///< likewise
  double turn = 0.02;        ///< per square root of radian
  double gain_share = 0.01;  ///< of the turn, for ten seconds or so
  double spot_share = 0;     ///< so much less of it on the spot than in a wide curve
};

class SimulatedDrive final {
 public:
  SimulatedDrive(const Planted& planted, const Configured& configured, std::uint64_t seed,
                 const Noisy& noisy = {})
      : planted_(planted), configured_(configured), noisy_(noisy), random_(seed) {}

  Drive drive(const Legs& legs) {
    for (double& slow : slow_) slow = normal();
    gain_ = normal();
    for (const Leg& leg : legs)
      for (double t = 0; t < leg.for_s - kTick_s / 2; t += kTick_s) tick(leg);
    return made_;
  }

 private:
  static constexpr double kTick_s = 0.005;
  struct State {
    double x_m = 0, y_m = 0, yaw_rad = 0.3, antenna_mps = 0;
  };

  void tick(const Leg& leg) {
    ++ticks_;
    now_s_ = 1000 + kTick_s * static_cast<double>(ticks_);
    command(leg);
    move();
    if (ticks_ % 4 == 0) tell_rims();
    if (ticks_ % 2 == 0) tell_gyro();
    if (ticks_ % 20 == 0) tell_receiver();
  }

  void command(const Leg& leg) {
    const auto towards = [](double& is, double wanted, double most) {
      is += std::clamp(wanted - is, -most, most);
    };
    towards(vx_mps_, leg.vx_mps, 0.5 * kTick_s);
    towards(wz_radps_, leg.wz_radps, 0.8 * kTick_s);
    const double half = wz_radps_ * configured_.track_m * configured_.yaw_slip_factor / 2;
    told_.push_back({now_s_ - kTick_s, vx_mps_ - half, vx_mps_ + half});
    if (ticks_ % 4 == 0) made_.commands.push_back(told_.back());
    const auto dead = static_cast<std::size_t>(std::lround(planted_.dead_s / kTick_s));
    const RimRow& now = told_[told_.size() > dead ? told_.size() - 1 - dead : 0];
    before_ = {0, left_mps_, right_mps_};
    const double blend = 1 - std::exp(-kTick_s / planted_.lag_s);
    left_mps_ += blend * (now.left_mps - left_mps_);
    right_mps_ += blend * (now.right_mps - right_mps_);
  }

  void move() {
    const double left = (before_.left_mps + left_mps_) / 2 * planted_.left_scale * kTick_s;
    const double right = (before_.right_mps + right_mps_) / 2 * planted_.right_scale * kTick_s;
    const double keep = std::exp(-kTick_s / 10);
    gain_ = keep * gain_ + std::sqrt(1 - keep * keep) * normal();
    const double root = std::sqrt((std::abs(left) + std::abs(right)) / 2);
    double turn = (right - left) / (configured_.track_m * planted_.yaw_slip_factor);
    turn *= 1 + noisy_.gain_share * gain_;
    const double spot = std::abs(right - left) / (std::abs(right) + std::abs(left) + 1e-9);
    turn *= 1 - noisy_.spot_share * spot;
    turn += (noisy_.turn * std::sqrt(std::abs(turn)) + 0.004 * root) * normal();
    const double along = (left + right) / 2 + noisy_.along * root * normal();
    const double across = noisy_.across * root * normal();
    const double middle = at_.yaw_rad + turn / 2;
    at_.x_m += along * std::cos(middle) - across * std::sin(middle);
    at_.y_m += along * std::sin(middle) + across * std::cos(middle);
    at_.yaw_rad += turn;
    turned_rad_ += turn;
    const double left_mps = left_mps_ * planted_.left_scale;
    const double right_mps = right_mps_ * planted_.right_scale;
    const double rate = (right_mps - left_mps) / (configured_.track_m * planted_.yaw_slip_factor);
    at_.antenna_mps = std::hypot((left_mps + right_mps) / 2 - rate * planted_.antenna_y_m,
                                 rate * planted_.antenna_x_m);
    past_.push_back(at_);
  }

  void tell_rims() {
    double left = left_mps_ * (1 + noisy_.rim_share * normal());
    double right = right_mps_ * (1 + noisy_.rim_share * normal());
    if (planted_.left_reversed) left = -left;
    if (planted_.right_reversed) right = -right;
    if (planted_.swapped) std::swap(left, right);
    made_.rims.push_back({now_s_, left, right});
  }
  void tell_gyro() {
    const double rate = turned_rad_ / (2 * kTick_s);
    turned_rad_ = 0;
    const double told = (rate + planted_.gyro_bias_radps) / planted_.gyro_scale;
    made_.gyro_radps.push_back(
        {now_s_ - kTick_s, (planted_.gyro_reversed ? -told : told) + noisy_.gyro_radps * normal()});
  }

  State then(double late_s) const {
    const auto back = static_cast<std::size_t>(std::max(0L, std::lround(late_s / kTick_s)));
    return past_[past_.size() > back ? past_.size() - 1 - back : 0];
  }
  void tell_receiver() {
    const double keep = std::exp(-0.1 / noisy_.place_slow_s);
    for (double& slow : slow_) slow = keep * slow + std::sqrt(1 - keep * keep) * normal();
    const State at = then(planted_.position_late_s);
    const double c = std::cos(at.yaw_rad);
    const double s = std::sin(at.yaw_rad);
    const auto error = [&](double slow) {
      return noisy_.place_slow_m * slow + noisy_.place_white_m * normal();
    };
    const PlaceRow place{
        now_s_,
        500 + at.x_m + c * planted_.antenna_x_m - s * planted_.antenna_y_m + error(slow_[0]),
        300 + at.y_m + s * planted_.antenna_x_m + c * planted_.antenna_y_m + error(slow_[1])};
    made_.places.push_back(place);
    const double error_deg =
        noisy_.heading_slow_deg * slow_[2] + noisy_.heading_white_deg * normal();
    made_.headings_rad.push_back(
        {now_s_, wrap_rad(then(planted_.heading_late_s).yaw_rad +
                          to_rad(error_deg - planted_.heading_offset_deg))});
    tell_speed();
  }
  void tell_speed() {
    if (!planted_.speed_by_positions) {
      const double speed = then(planted_.speed_late_s).antenna_mps + 0.02 * normal();
      made_.receiver_mps.push_back({now_s_, std::max(0.0, speed)});
    } else if (made_.places.size() > 1) {
      const PlaceRow& a = made_.places[made_.places.size() - 2];
      const PlaceRow& b = made_.places.back();
      const double speed = std::hypot(b.east_m - a.east_m, b.north_m - a.north_m) / 0.1;
      smooth_mps_ += 0.3 * (speed - smooth_mps_);
      made_.receiver_mps.push_back({now_s_, smooth_mps_});
    }
  }

  /// Box-Muller, so that every standard library gives the same numbers.
  double normal() {
    const double u = (static_cast<double>(random_() >> 11) + 0.5) / 9007199254740992.0;
    const double v = static_cast<double>(random_() >> 11) / 9007199254740992.0;
    return std::sqrt(-2 * std::log(u)) * std::cos(2 * kPi * v);
  }

  Planted planted_;
  Configured configured_;
  Noisy noisy_;
  std::mt19937_64 random_;
  Drive made_;
  std::int64_t ticks_ = 0;
  double now_s_ = 0;
  double vx_mps_ = 0, wz_radps_ = 0, left_mps_ = 0, right_mps_ = 0;
  double turned_rad_ = 0, gain_ = 0, smooth_mps_ = 0;
  std::array<double, 3> slow_{};
  State at_;
  RimRow before_;
  std::vector<RimRow> told_;
  std::vector<State> past_;
};

}  // namespace drover::calibrate
