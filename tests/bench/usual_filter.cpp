#include "bench/usual_filter.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "drover/angle.h"

namespace drover::bench {
namespace {

constexpr Duration kKept = std::chrono::milliseconds(500);

/// From the base to the map, and how it changes with roll and pitch.
struct Rotation {
  double sr, cr, sp, cp, sy, cy;
  double of[3][3];

  explicit Rotation(const UsualVector& mean)
      : sr(std::sin(mean[kRoll])),
        cr(std::cos(mean[kRoll])),
        sp(std::sin(mean[kPitch])),
        cp(std::cos(mean[kPitch])),
        sy(std::sin(mean[kHeading])),
        cy(std::cos(mean[kHeading])),
        of{{cy * cp, cy * sp * sr - sy * cr, cy * sp * cr + sy * sr},
           {sy * cp, sy * sp * sr + cy * cr, sy * sp * cr - cy * sr},
           {-sp, cp * sr, cp * cr}} {}

  double turned(std::size_t row, const double (&way)[3]) const {
    return of[row][0] * way[0] + of[row][1] * way[1] + of[row][2] * way[2];
  }
  double by_roll(std::size_t row, const double (&way)[3]) const {
    return of[row][2] * way[1] - of[row][1] * way[2];
  }
  double by_pitch(std::size_t row, const double (&way)[3]) const {
    const double down = -sp * way[0] + cp * (sr * way[1] + cr * way[2]);
    if (row == 0) return cy * down;
    if (row == 1) return sy * down;
    return -cp * way[0] - sp * (sr * way[1] + cr * way[2]);
  }
};

bool is_angle(std::size_t state) {
  return state == kRoll || state == kPitch || state == kHeading;
}

}  // namespace

UsualVector predicted(const UsualVector& mean, double dt_s, UsualMatrix* jacobian) {
  const Rotation r(mean);
  const double half_s2 = dt_s * dt_s / 2;
  double way[3];
  for (std::size_t i = 0; i < 3; ++i)
    way[i] = mean[kSpeedX + i] * dt_s + mean[kAccelerationX + i] * half_s2;
  const double tangent = r.sp / r.cp;
  // The rate about the axis that is left when roll is undone, and its part in the base's y.
  const double about = mean[kPitchRate] * r.sr + mean[kYawRate] * r.cr;
  const double across = mean[kPitchRate] * r.cr - mean[kYawRate] * r.sr;

  UsualVector next = mean;
  for (std::size_t i = 0; i < 3; ++i) {
    next[kPlaceX + i] += r.turned(i, way);
    next[kSpeedX + i] += mean[kAccelerationX + i] * dt_s;
  }
  next[kRoll] = wrap_rad(mean[kRoll] + (mean[kRollRate] + about * tangent) * dt_s);
  next[kPitch] = wrap_rad(mean[kPitch] + across * dt_s);
  next[kHeading] = wrap_rad(mean[kHeading] + about / r.cp * dt_s);
  if (jacobian == nullptr) return next;

  UsualMatrix& f = *jacobian;
  f = UsualMatrix::one();
  for (std::size_t i = 0; i < 3; ++i) {
    f.at[kPlaceX + i][kRoll] = r.by_roll(i, way);
    f.at[kPlaceX + i][kPitch] = r.by_pitch(i, way);
    for (std::size_t j = 0; j < 3; ++j) {
      f.at[kPlaceX + i][kSpeedX + j] = r.of[i][j] * dt_s;
      f.at[kPlaceX + i][kAccelerationX + j] = r.of[i][j] * half_s2;
    }
    f.at[kSpeedX + i][kAccelerationX + i] = dt_s;
  }
  f.at[kPlaceX][kHeading] = -r.turned(1, way);
  f.at[kPlaceY][kHeading] = r.turned(0, way);
  const double secant2 = 1 / (r.cp * r.cp);
  f.at[kRoll][kRoll] += across * tangent * dt_s;
  f.at[kRoll][kPitch] = about * secant2 * dt_s;
  f.at[kRoll][kRollRate] = dt_s;
  f.at[kRoll][kPitchRate] = r.sr * tangent * dt_s;
  f.at[kRoll][kYawRate] = r.cr * tangent * dt_s;
  f.at[kPitch][kRoll] = -about * dt_s;
  f.at[kPitch][kPitchRate] = r.cr * dt_s;
  f.at[kPitch][kYawRate] = -r.sr * dt_s;
  f.at[kHeading][kRoll] = across / r.cp * dt_s;
  f.at[kHeading][kPitch] = about * tangent / r.cp * dt_s;
  f.at[kHeading][kPitchRate] = r.sr / r.cp * dt_s;
  f.at[kHeading][kYawRate] = r.cr / r.cp * dt_s;
  return next;
}

void UsualFilter::begin(const UsualBelief& belief) {
  now_ = belief;
  past_.clear();
  past_.push_back({{}, now_});
}

void UsualFilter::see(const UsualSeen& seen) {
  if (!replays_) {
    take(seen);
    return;
  }
  if (seen.time < past_.front().after.time) return;
  std::vector<UsualSeen> later;
  while (past_.back().after.time > seen.time) {
    later.push_back(past_.back().seen);
    past_.pop_back();
  }
  if (!later.empty()) now_ = past_.back().after;
  take(seen);
  past_.push_back({seen, now_});
  for (auto again = later.rbegin(); again != later.rend(); ++again) {
    take(*again);
    past_.push_back({*again, now_});
  }
  while (past_.front().after.time < now_.time - kKept) past_.pop_front();
}

void UsualFilter::take(const UsualSeen& seen) {
  advance(seen.time);
  correct(seen);
}

void UsualFilter::advance(Time to) {
  const double dt_s = to_s(to - now_.time);
  if (dt_s <= 0) return;
  UsualMatrix f;
  now_.mean = predicted(now_.mean, dt_s, &f);
  transform(f, now_.covariance);
  for (std::size_t i = 0; i < 3; ++i) {
    now_.covariance.at[kPlaceX + i][kPlaceX + i] += tuning_.place_m2 * dt_s;
    now_.covariance.at[kRoll + i][kRoll + i] += tuning_.heading_rad2 * dt_s;
    now_.covariance.at[kSpeedX + i][kSpeedX + i] += tuning_.speed_m2ps2 * dt_s;
    now_.covariance.at[kRollRate + i][kRollRate + i] += tuning_.rate_rad2ps2 * dt_s;
    now_.covariance.at[kAccelerationX + i][kAccelerationX + i] += tuning_.acceleration_m2ps4 * dt_s;
  }
  now_.time = to;
}

void UsualFilter::correct(const UsualSeen& seen) {
  const std::size_t n = seen.count;
  const Rotation r(now_.mean);
  const double lever[3] = {seen.lever_m[0], seen.lever_m[1], seen.lever_m[2]};
  std::array<double, UsualSeen::kMost> innovation{};
  SquareMatrix<UsualSeen::kMost> weight;
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t state = seen.what[i];
    innovation[i] = seen.value[i] - now_.mean[state];
    if (state <= kPlaceZ) innovation[i] -= r.turned(state, lever);
    if (is_angle(state)) innovation[i] = wrap_rad(innovation[i]);
    for (std::size_t j = 0; j < n; ++j) weight.at[i][j] = now_.covariance.at[state][seen.what[j]];
    weight.at[i][i] += seen.sigma[i] * seen.sigma[i];
  }
  invert(weight, n);
  double distance2 = 0;
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < n; ++j)
      distance2 += innovation[i] * weight.at[i][j] * innovation[j];
  if (distance2 > tuning_.gate_sigma * tuning_.gate_sigma) return;

  double gain[kUsualStates][UsualSeen::kMost] = {};
  UsualMatrix rest = UsualMatrix::one();
  for (std::size_t s = 0; s < kUsualStates; ++s) {
    for (std::size_t j = 0; j < n; ++j) {
      for (std::size_t i = 0; i < n; ++i)
        gain[s][j] += now_.covariance.at[s][seen.what[i]] * weight.at[i][j];
      now_.mean[s] += gain[s][j] * innovation[j];
      rest.at[s][seen.what[j]] -= gain[s][j];
    }
  }
  for (const std::size_t angle : {kRoll, kPitch, kHeading})
    now_.mean[angle] = wrap_rad(now_.mean[angle]);
  // In the form that keeps it positive.
  transform(rest, now_.covariance);
  for (std::size_t s = 0; s < kUsualStates; ++s)
    for (std::size_t t = 0; t < kUsualStates; ++t)
      for (std::size_t j = 0; j < n; ++j)
        now_.covariance.at[s][t] += gain[s][j] * seen.sigma[j] * seen.sigma[j] * gain[t][j];
}

}  // namespace drover::bench
