// The residuals of the chain: each is measured less modelled, over the assumed sigma.
#include <algorithm>
#include <cmath>

#include "calibrate/chain.h"
#include "drover/angle.h"

namespace drover::calibrate {
namespace {

// Standing wheels hold the base so well; and without wheels or gyro nothing is known.
constexpr double kRest_m = 3e-5;
constexpr double kRest_rad = 2e-5;
constexpr double kUnheard_m = 0.5;
constexpr double kUnheard_rad = 0.5;
constexpr double kAnyYaw_rad = 10;
constexpr std::size_t kNext = kOfNode;
constexpr std::size_t kNumbers = 2 * kOfNode;

Row row_of(std::size_t node, Noise noise, double residual, double sigma) {
  Row row;
  row.node = node;
  row.noise = noise;
  row.residual = residual / sigma;
  return row;
}

}  // namespace

void Chain::rows(std::vector<Row>& into) const {
  into.clear();
  anchor_rows(into);
  for (std::size_t k = 0; k < size(); ++k) {
    place_rows(k, into);
    heading_row(k, into);
    if (k + 1 == size()) continue;
    slow_rows(k, into);
    way_rows(k, into);
    turn_rows(k, into);
  }
}

/// What is known of the first node: its slow errors are as large as any.
void Chain::anchor_rows(std::vector<Row>& into) const {
  const NodeValues& first = values_.front();
  const auto anchor = [&](std::size_t which, Noise noise, double sigma, double to) {
    Row row = row_of(0, noise, to - first[which], sigma);
    row.slope[which] = 1 / sigma;
    into.push_back(row);
  };
  anchor(kSlowX, Noise::place_slow, assumed_.place_slow_m, 0);
  anchor(kSlowY, Noise::place_slow, assumed_.place_slow_m, 0);
  anchor(kSlowYaw, Noise::heading_slow, assumed_.heading_slow_rad, 0);
  anchor(kYaw, Noise::known, kAnyYaw_rad, first[kYaw]);
}

void Chain::slow_rows(std::size_t k, std::vector<Row>& into) const {
  const auto slow = [&](std::size_t which, Noise noise, double sigma, double lasts_s) {
    const double keep = std::exp(-step_s_ / lasts_s);
    const double wander = sigma * std::sqrt(1 - keep * keep);
    Row row = row_of(k, noise, keep * values_[k][which] - values_[k + 1][which], wander);
    row.slope[which] = -keep / wander;
    row.slope[kNext + which] = 1 / wander;
    into.push_back(row);
  };
  slow(kSlowX, Noise::place_slow, assumed_.place_slow_m, assumed_.place_slow_s);
  slow(kSlowY, Noise::place_slow, assumed_.place_slow_m, assumed_.place_slow_s);
  slow(kSlowYaw, Noise::heading_slow, assumed_.heading_slow_rad, assumed_.heading_slow_s);
}

void Chain::way_rows(std::size_t k, std::vector<Row>& into) const {
  const Node& node = nodes_[k];
  const double turn = values_[k + 1][kYaw] - values_[k][kYaw];
  const double middle = values_[k][kYaw] + turn / 2;
  const double c = std::cos(middle);
  const double s = std::sin(middle);
  const double dx = values_[k + 1][kX] - values_[k][kX];
  const double dy = values_[k + 1][kY] - values_[k][kY];
  const double ahead = c * dx + s * dy;
  const double left = -s * dx + c * dy;
  const double half = turn / 2;
  const double chord = std::abs(half) < 1e-4 ? 1 : std::sin(half) / half;
  const double moved = (std::abs(node.left_m) + std::abs(node.right_m)) / 2;
  const auto sigma_of = [&](double per_root_m) {
    return node.rolled ? std::sqrt(per_root_m * per_root_m * moved + kRest_m * kRest_m)
                       : kUnheard_m;
  };
  const double rolled =
      chord * 0.5 * (shared_[kLeftScale] * node.left_m + shared_[kRightScale] * node.right_m);
  const double along_sigma = sigma_of(assumed_.along_m);
  Row along = row_of(k, node.rolled ? Noise::along : Noise::known, rolled - ahead, along_sigma);
  along.slope[kX] = -c / along_sigma;
  along.slope[kY] = -s / along_sigma;
  along.slope[kNext + kX] = c / along_sigma;
  along.slope[kNext + kY] = s / along_sigma;
  along.slope[kYaw] = along.slope[kNext + kYaw] = left / 2 / along_sigma;
  along.slope[kNumbers + kLeftScale] = -chord * node.left_m / 2 / along_sigma;
  along.slope[kNumbers + kRightScale] = -chord * node.right_m / 2 / along_sigma;
  into.push_back(along);
  const double across_sigma = sigma_of(assumed_.across_m);
  Row across = row_of(k, node.rolled ? Noise::across : Noise::known, -left, across_sigma);
  across.slope[kX] = s / across_sigma;
  across.slope[kY] = -c / across_sigma;
  across.slope[kNext + kX] = -s / across_sigma;
  across.slope[kNext + kY] = c / across_sigma;
  across.slope[kYaw] = across.slope[kNext + kYaw] = -ahead / 2 / across_sigma;
  into.push_back(across);
}

void Chain::turn_rows(std::size_t k, std::vector<Row>& into) const {
  const Node& node = nodes_[k];
  const double turn = values_[k + 1][kYaw] - values_[k][kYaw];
  const auto push = [&](Row row, double sigma) {
    row.slope[kYaw] = -1 / sigma;
    row.slope[kNext + kYaw] = 1 / sigma;
    into.push_back(row);
  };
  const double left = shared_[kLeftScale] * node.left_m;
  const double right = shared_[kRightScale] * node.right_m;
  const double by_wheels = shared_[kTurnGain] / width_m_ * (right - left);
  if (node.rolled) {
    const double way = (std::abs(node.left_m) + std::abs(node.right_m)) / 2;
    const double sigma =
        std::sqrt(assumed_.turn_rad * assumed_.turn_rad * std::abs(by_wheels) +
                  assumed_.turn_radpm * assumed_.turn_radpm * way + kRest_rad * kRest_rad);
    Row row = row_of(k, Noise::wheel_turn, by_wheels - turn, sigma);
    row.slope[kNumbers + kTurnGain] = -(right - left) / width_m_ / sigma;
    row.slope[kNumbers + kLeftScale] = shared_[kTurnGain] / width_m_ * node.left_m / sigma;
    row.slope[kNumbers + kRightScale] = -shared_[kTurnGain] / width_m_ * node.right_m / sigma;
    push(row, sigma);
  } else {
    push(row_of(k, Noise::known, by_wheels - turn, kUnheard_rad), kUnheard_rad);
  }
  if (!node.gyro) return;
  const double sigma = assumed_.gyro_rad * std::sqrt(step_s_);
  const double by_gyro = shared_[kGyroScale] * node.gyro_rad - shared_[kGyroBias] * step_s_;
  Row row = row_of(k, Noise::gyro_turn, by_gyro - turn, sigma);
  row.slope[kNumbers + kGyroScale] = -node.gyro_rad / sigma;
  row.slope[kNumbers + kGyroBias] = step_s_ / sigma;
  push(row, sigma);
}

/// The antenna was where it tells it to be when it measured, which is `kPlaceLate` earlier.
void Chain::place_rows(std::size_t k, std::vector<Row>& into) const {
  if (!nodes_[k].place) return;
  const PlaceRow& told = *nodes_[k].place;
  const double then_s = told.time_s - shared_[kPlaceLate];
  const double turned = turned_rad(node_s(k)) - turned_rad(then_s);
  const double rolled = rolled_m(then_s, node_s(k));
  const double middle = values_[k][kYaw] - turned / 2;
  const double way_x = rolled * std::cos(middle);
  const double way_y = rolled * std::sin(middle);
  const double yaw = values_[k][kYaw] - turned;
  const double c = std::cos(yaw);
  const double s = std::sin(yaw);
  const double arm_x = c * shared_[kArmX] - s * shared_[kArmY];
  const double arm_y = s * shared_[kArmX] + c * shared_[kArmY];
  const double speed = speed_mps(then_s);
  const double rate = turn_radps(then_s);
  const double sigma = assumed_.place_white_m;
  const NodeValues& at = values_[k];
  Row east =
      row_of(k, Noise::place_white, told.east_m - (at[kX] - way_x + arm_x + at[kSlowX]), sigma);
  east.slope[kX] = east.slope[kSlowX] = 1 / sigma;
  east.slope[kYaw] = (way_y - arm_y) / sigma;
  east.slope[kNumbers + kArmX] = c / sigma;
  east.slope[kNumbers + kArmY] = -s / sigma;
  east.slope[kNumbers + kPlaceLate] = -(speed * c - rate * arm_y) / sigma;
  into.push_back(east);
  Row north =
      row_of(k, Noise::place_white, told.north_m - (at[kY] - way_y + arm_y + at[kSlowY]), sigma);
  north.slope[kY] = north.slope[kSlowY] = 1 / sigma;
  north.slope[kYaw] = (-way_x + arm_x) / sigma;
  north.slope[kNumbers + kArmX] = s / sigma;
  north.slope[kNumbers + kArmY] = c / sigma;
  north.slope[kNumbers + kPlaceLate] = -(speed * s + rate * arm_x) / sigma;
  into.push_back(north);
}

void Chain::heading_row(std::size_t k, std::vector<Row>& into) const {
  if (!nodes_[k].heading) return;
  const ValueRow& told = *nodes_[k].heading;
  const double then_s = told.time_s - shared_[kHeadingLate];
  const double yaw = values_[k][kYaw] - (turned_rad(node_s(k)) - turned_rad(then_s));
  const double sigma = assumed_.heading_white_rad;
  const double off = wrap_rad(told.value - (yaw + shared_[kLine] + values_[k][kSlowYaw]));
  Row row = row_of(k, Noise::heading_white, off, sigma);
  row.slope[kYaw] = row.slope[kSlowYaw] = 1 / sigma;
  row.slope[kNumbers + kLine] = 1 / sigma;
  row.slope[kNumbers + kHeadingLate] = -turn_radps(then_s) / sigma;
  into.push_back(row);
}

}  // namespace drover::calibrate
