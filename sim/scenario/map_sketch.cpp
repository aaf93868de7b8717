#include "sim/scenario/map_sketch.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "drover/angle.h"

namespace drover::sim {
namespace {

constexpr double kMargin_m = 2;
constexpr double kWidth = 76;   // characters
constexpr double kHeight = 14;  // lines

}  // namespace

MapSketch::MapSketch(const std::vector<TrackPose>& track) {
  double east_m = 0;
  double south_m = 0;
  if (!track.empty()) {
    const auto x = [](const TrackPose& a, const TrackPose& b) { return a.x_m < b.x_m; };
    const auto y = [](const TrackPose& a, const TrackPose& b) { return a.y_m < b.y_m; };
    const auto [left, right] = std::minmax_element(track.begin(), track.end(), x);
    const auto [low, high] = std::minmax_element(track.begin(), track.end(), y);
    west_m_ = left->x_m, east_m = right->x_m;
    south_m = low->y_m, north_m_ = high->y_m;
  }
  west_m_ -= kMargin_m, north_m_ += kMargin_m;
  east_m += kMargin_m, south_m -= kMargin_m;
  cell_m_ = std::max((east_m - west_m_) / kWidth, (north_m_ - south_m) / (2 * kHeight));
  const auto columns = static_cast<std::size_t>(std::ceil((east_m - west_m_) / cell_m_));
  const auto lines = static_cast<std::size_t>(std::ceil((north_m_ - south_m) / (2 * cell_m_)));
  cells_.assign(lines, std::vector<std::string>(columns, " "));
  for (std::size_t i = 0; i + 1 < track.size(); ++i)
    for (const double part : {0.0, 0.25, 0.5, 0.75, 1.0})  // or a row of points has gaps
      put({track[i].x_m + part * (track[i + 1].x_m - track[i].x_m),
           track[i].y_m + part * (track[i + 1].y_m - track[i].y_m), 0},
          ".");
}

void MapSketch::put(const TrackPose& place, const std::string& mark) {
  const double column = std::floor((place.x_m - west_m_) / cell_m_);
  const double line = std::floor((north_m_ - place.y_m) / (2 * cell_m_));
  if (!(line >= 0 && line < static_cast<double>(cells_.size()))) return;
  auto& row = cells_[static_cast<std::size_t>(line)];
  if (column >= 0 && column < static_cast<double>(row.size()))
    row[static_cast<std::size_t>(column)] = mark;
}

void MapSketch::put_edge(const std::vector<TrackPose>& polygon, const std::string& mark) {
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const auto& from = polygon[i];
    const auto& to = polygon[(i + 1) % polygon.size()];
    const double length_m = std::hypot(to.x_m - from.x_m, to.y_m - from.y_m);
    const auto steps = std::clamp(std::ceil(2 * length_m / cell_m_), 1.0, 1000.0);
    for (double step = 0; step < steps; ++step)
      put({from.x_m + step / steps * (to.x_m - from.x_m),
           from.y_m + step / steps * (to.y_m - from.y_m), 0},
          mark);
  }
}

std::vector<std::string> MapSketch::rows() const {
  std::vector<std::string> rows;
  for (const auto& cells : cells_) {
    rows.emplace_back();
    for (const auto& cell : cells) rows.back() += cell;
  }
  return rows;
}

// The longest of 1, 2, 5, 10, ... that a third of the width holds.
std::string MapSketch::scale() const {
  double length_m = 0.1;
  for (double decade = 0.1; decade < 1e6; decade *= 10)
    for (const double step : {1.0, 2.0, 5.0})
      if (step * decade <= cell_m_ * kWidth / 3) length_m = step * decade;
  // From the one bar to the other.
  const auto width = static_cast<std::size_t>(std::lround(length_m / cell_m_));
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "| %g m", length_m);
  return "|" + std::string(width > 1 ? width - 1 : 0, '-') + text.data();
}

std::string arrow(double yaw_rad) {
  constexpr std::array<const char*, 8> kArrows{"→", "↗", "↑", "↖", "←", "↙", "↓", "↘"};
  const auto eighth = static_cast<int>(std::lround(wrap_rad(yaw_rad) / (kPi / 4)));
  return kArrows[static_cast<std::size_t>((eighth + 8) % 8)];
}

}  // namespace drover::sim
