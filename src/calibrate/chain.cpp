#include "calibrate/chain.h"

#include <algorithm>
#include <cmath>

#include "drover/angle.h"

namespace drover::calibrate {
namespace {

constexpr double kNodeStep_s = 0.1;
constexpr double kMostNodes = 6000;
constexpr double kMostLate_s = 0.6;
constexpr double kMean_s = 0.1;        // of a speed or a rate
constexpr double kCourseSpan_s = 0.4;  // of the positions that show a course
constexpr double kCourseWay_m = 0.12;  // at least
constexpr double kFollow = 0.05;       // share of what a first heading is put right by

/// The row of `rows` that is nearest to each node, no farther than half a step.
template <class Value>
std::vector<std::optional<Value>> nearest(const std::vector<Value>& rows, double begin_s,
                                          double step_s, std::size_t count) {
  std::vector<std::optional<Value>> found(count);
  for (const Value& row : rows) {
    const double place = std::round((row.time_s - begin_s) / step_s);
    if (!(place >= 0 && place < static_cast<double>(count))) continue;
    auto& at = found[static_cast<std::size_t>(place)];
    const double node_s = begin_s + step_s * place;
    if (!at || std::abs(row.time_s - node_s) < std::abs(at->time_s - node_s)) at = row;
  }
  return found;
}

}  // namespace

Chain::Chain(const Drive& drive, const Configured& configured, const Signs& signs,
             const FirstGuess& guess)
    : track_(track_of(drive, signs)),
      width_m_(configured.track_m * configured.yaw_slip_factor),
      has_headings_(!drive.headings_rad.empty()) {
  begin_s_ = std::max(drive.places.front().time_s, drive.rims.front().time_s);
  const double end_s = std::min(drive.places.back().time_s, drive.rims.back().time_s);
  step_s_ = std::max(kNodeStep_s, (end_s - begin_s_) / kMostNodes);
  nodes_.resize(static_cast<std::size_t>(std::max(0.0, (end_s - begin_s_) / step_s_)) + 1);
  before_ = {1,
             1,
             guess.turn_gain,
             1,
             0,
             configured.antenna_x_m,
             configured.antenna_y_m,
             guess.heading_rad,
             0,
             0};
  shared_ = before_;
  attach(drive);
  guess_values(drive);
}

void Chain::attach(const Drive& drive) {
  const auto places = nearest(drive.places, begin_s_, step_s_, size());
  const auto headings = nearest(drive.headings_rad, begin_s_, step_s_, size());
  for (std::size_t k = 0; k < size(); ++k) {
    Node& node = nodes_[k];
    node.place = places[k];
    if (has_headings_) node.heading = headings[k];
    const double from_s = node_s(k);
    const double to_s = from_s + step_s_;
    node.rolled = track_.left_mps.covers(from_s, to_s, kLongestGap_s);
    node.gyro = track_.has_gyro() && track_.gyro_radps.covers(from_s, to_s, kLongestGap_s);
    node.left_m = track_.left_mps.integral(from_s, to_s);
    node.right_m = track_.right_mps.integral(from_s, to_s);
    node.gyro_rad = track_.gyro_radps.integral(from_s, to_s);
  }
}

std::optional<double> Chain::seen_yaw(const Drive& drive, double time_s) const {
  if (has_headings_) {
    const auto heading = heading_at(drive.headings_rad, time_s);
    if (!heading) return std::nullopt;
    return wrap_rad(*heading - shared_[kLine]);
  }
  const auto a = antenna_at(drive.places, time_s - kCourseSpan_s);
  const auto b = antenna_at(drive.places, time_s + kCourseSpan_s);
  if (!a || !b || std::hypot(b->x_m - a->x_m, b->y_m - a->y_m) < kCourseWay_m) return std::nullopt;
  const double rolled = rolled_m(time_s - kCourseSpan_s, time_s + kCourseSpan_s);
  if (std::abs(rolled) < kCourseWay_m) return std::nullopt;
  const double course = std::atan2(b->y_m - a->y_m, b->x_m - a->x_m);
  return wrap_rad(rolled > 0 ? course : course + kPi);
}

/// Turned by gyro or wheels, slowly put right by what headings or the course show.
void Chain::guess_yaws(const Drive& drive) {
  std::size_t first = 0;
  std::optional<double> seen;
  while (first < size() && !(seen = seen_yaw(drive, node_s(first)))) ++first;
  if (!seen) return;
  const auto follow = [&](std::size_t from, std::size_t to) {
    double yaw = values_[from][kYaw] + turned_rad(node_s(to)) - turned_rad(node_s(from));
    if (const auto is = seen_yaw(drive, node_s(to))) yaw += kFollow * wrap_rad(*is - yaw);
    values_[to][kYaw] = yaw;
  };
  values_[first][kYaw] = *seen;
  for (std::size_t k = first; k + 1 < size(); ++k) follow(k, k + 1);
  for (std::size_t k = size() - 1; k > 0; --k) follow(k, k - 1);
}

void Chain::guess_values(const Drive& drive) {
  values_.assign(size(), {});
  guess_yaws(drive);
  Point last{drive.places.front().east_m, drive.places.front().north_m};
  for (std::size_t k = 0; k < size(); ++k) {
    if (const auto at = antenna_at(drive.places, node_s(k))) last = *at;
    const double c = std::cos(values_[k][kYaw]);
    const double s = std::sin(values_[k][kYaw]);
    values_[k][kX] = last.x_m - (c * shared_[kArmX] - s * shared_[kArmY]);
    values_[k][kY] = last.y_m - (s * shared_[kArmX] + c * shared_[kArmY]);
  }
}

Prior Chain::prior() const {
  Prior prior;
  prior.sigma = {0.3, 0.3, 1, 0.2, 0.1, 3, 3, 3, 0.5, 0.5};
  constexpr double kFixed = 1e-9;
  if (!track_.has_gyro()) prior.sigma[kGyroScale] = prior.sigma[kGyroBias] = kFixed;
  if (!has_headings_) prior.sigma[kLine] = prior.sigma[kHeadingLate] = kFixed;
  for (std::size_t i = 0; i < kShared; ++i) prior.missing[i] = before_[i] - shared_[i];
  return prior;
}

void Chain::step(const SharedValues& shared, const std::vector<NodeValues>& nodes) {
  for (std::size_t i = 0; i < kShared; ++i) shared_[i] += shared[i];
  for (const std::size_t late : {kPlaceLate, kHeadingLate})
    shared_[late] = std::clamp(shared_[late], -kMostLate_s, kMostLate_s);
  for (std::size_t k = 0; k < size(); ++k)
    for (std::size_t i = 0; i < kOfNode; ++i) values_[k][i] += nodes[k][i];
}

double Chain::turned_rad(double time_s) const {
  if (track_.has_gyro())
    return shared_[kGyroScale] * track_.gyro_radps.integral(time_s) -
           shared_[kGyroBias] * (time_s - begin_s_);
  return shared_[kTurnGain] / width_m_ *
         (shared_[kRightScale] * track_.right_mps.integral(time_s) -
          shared_[kLeftScale] * track_.left_mps.integral(time_s));
}

double Chain::turn_radps(double time_s) const {
  return (turned_rad(time_s + kMean_s / 2) - turned_rad(time_s - kMean_s / 2)) / kMean_s;
}

double Chain::rolled_m(double from_s, double to_s) const {
  return 0.5 * (shared_[kLeftScale] * track_.left_mps.integral(from_s, to_s) +
                shared_[kRightScale] * track_.right_mps.integral(from_s, to_s));
}

double Chain::speed_mps(double time_s) const {
  return rolled_m(time_s - kMean_s / 2, time_s + kMean_s / 2) / kMean_s;
}

}  // namespace drover::calibrate
