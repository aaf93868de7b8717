#include "sim/scenario/map_sketch.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "drover/angle.h"

namespace drover::sim {
namespace {

constexpr double kMargin_m = 1.5;
constexpr double kWidth = 76;   // characters
constexpr double kHeight = 14;  // lines

const std::string kPlain = "\033[0m";

const char* escape(Colour colour) {
  switch (colour) {
    case Colour::dim: return "\033[2m";
    case Colour::bold: return "\033[1m";
    case Colour::red: return "\033[31m";
    case Colour::green: return "\033[32m";
    case Colour::yellow: return "\033[33m";
    case Colour::blue: return "\033[34m";
    default: return "";
  }
}

// Even-odd: a ray to the east.
bool is_inside(const std::vector<TrackPose>& polygon, double x_m, double y_m) {
  bool inside = false;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const auto& a = polygon[i];
    const auto& b = polygon[(i + 1) % polygon.size()];
    if ((a.y_m > y_m) == (b.y_m > y_m)) continue;
    if (x_m < a.x_m + (y_m - a.y_m) / (b.y_m - a.y_m) * (b.x_m - a.x_m)) inside = !inside;
  }
  return inside;
}

}  // namespace

MapSketch::MapSketch(const std::vector<TrackPose>& track) {
  const Extent seen = track.empty() ? Extent{} : extent(track);
  west_m_ = seen.west_m - kMargin_m, north_m_ = seen.north_m + kMargin_m;
  const double width_m = seen.width_m() + 2 * kMargin_m;
  const double height_m = seen.height_m() + 2 * kMargin_m;
  cell_m_ = std::max(width_m / kWidth, height_m / (2 * kHeight));
  const auto columns = static_cast<std::size_t>(std::ceil(width_m / cell_m_));
  const auto lines = static_cast<std::size_t>(std::ceil(height_m / (2 * cell_m_)));
  cells_.assign(lines, std::vector<Mark>(columns, " "));
  put_way(track, {"·", Colour::dim});
}

MapSketch::Extent MapSketch::extent(const std::vector<TrackPose>& points) {
  const auto x = [](const TrackPose& a, const TrackPose& b) { return a.x_m < b.x_m; };
  const auto y = [](const TrackPose& a, const TrackPose& b) { return a.y_m < b.y_m; };
  const auto [west, east] = std::minmax_element(points.begin(), points.end(), x);
  const auto [south, north] = std::minmax_element(points.begin(), points.end(), y);
  return {west->x_m, east->x_m, south->y_m, north->y_m};
}

double MapSketch::column(double x_m) const {
  return std::floor((x_m - west_m_) / cell_m_);
}

double MapSketch::line(double y_m) const {
  return std::floor((north_m_ - y_m) / (2 * cell_m_));
}

void MapSketch::put(const TrackPose& place, const Mark& mark) {
  const double line_at = line(place.y_m);
  const double column_at = column(place.x_m);
  if (!(line_at >= 0 && line_at < static_cast<double>(cells_.size()))) return;
  auto& row = cells_[static_cast<std::size_t>(line_at)];
  if (column_at >= 0 && column_at < static_cast<double>(row.size()))
    row[static_cast<std::size_t>(column_at)] = mark;
}

void MapSketch::put_line(const TrackPose& from, const TrackPose& to, const Mark& mark) {
  const double length_m = std::hypot(to.x_m - from.x_m, to.y_m - from.y_m);
  const auto steps = std::clamp(std::ceil(2 * length_m / cell_m_), 1.0, 1000.0);
  for (double step = 0; step <= steps; ++step)
    put({from.x_m + step / steps * (to.x_m - from.x_m),
         from.y_m + step / steps * (to.y_m - from.y_m), 0},
        mark);
}

void MapSketch::put_way(const std::vector<TrackPose>& points, const Mark& mark) {
  for (std::size_t i = 0; i + 1 < points.size(); ++i) put_line(points[i], points[i + 1], mark);
}

void MapSketch::put_edge(const std::vector<TrackPose>& polygon, const Mark& mark) {
  for (std::size_t i = 0; i < polygon.size(); ++i)
    put_line(polygon[i], polygon[(i + 1) % polygon.size()], mark);
}

void MapSketch::put_area(const std::vector<TrackPose>& polygon, const Mark& mark) {
  if (polygon.empty()) return;
  const Extent all = extent(polygon);
  if (std::max(all.width_m(), all.height_m()) < 2 * cell_m_) return put(all.middle(), mark);
  bool seen = false;
  for (std::size_t i = 0; i < cells_.size(); ++i) {
    const double y_m = north_m_ - (2 * static_cast<double>(i) + 1) * cell_m_;
    for (std::size_t k = 0; k < cells_[i].size(); ++k) {
      const double x_m = west_m_ + (static_cast<double>(k) + 0.5) * cell_m_;
      if (!is_inside(polygon, x_m, y_m)) continue;
      cells_[i][k] = mark;
      seen = true;
    }
  }
  // A wall is thinner than a character, and may pass between the middles of all.
  if (!seen || std::min(all.width_m(), all.height_m()) < cell_m_) put_edge(polygon, mark);
}

void MapSketch::put_name(const std::vector<TrackPose>& polygon, const std::string& name,
                         Colour colour) {
  if (polygon.empty()) return;
  const auto word = characters(name);
  const auto length = static_cast<double>(word.size());
  const Extent all = extent(polygon);
  const double first = column(all.west_m);
  const double last = column(all.east_m);
  const double middle_line = line(all.middle().y_m);
  const double centred = std::floor((first + last - length) / 2) + 1;
  if (last - first + 1 >= length + 2) return write(middle_line, centred, word, colour);
  const std::array<std::array<double, 2>, 4> beside{{{middle_line, last + 2},
                                                     {middle_line, first - 1 - length},
                                                     {line(all.north_m) - 1, centred},
                                                     {line(all.south_m) + 1, centred}}};
  for (const auto& [line_at, column_at] : beside)
    if (is_blank(line_at, column_at, word.size())) return write(line_at, column_at, word, colour);
}

bool MapSketch::is_blank(double line, double column, std::size_t length) const {
  if (!(line >= 0 && line < static_cast<double>(cells_.size()) && column >= 0)) return false;
  const auto& row = cells_[static_cast<std::size_t>(line)];
  const double end = column + static_cast<double>(length);
  if (!(end <= static_cast<double>(row.size()))) return false;
  const auto begin = row.begin() + static_cast<std::ptrdiff_t>(column);
  return std::all_of(begin, begin + static_cast<std::ptrdiff_t>(length),
                     [](const Mark& mark) { return mark.text == " "; });
}

void MapSketch::write(double line, double column, const std::vector<std::string>& word,
                      Colour colour) {
  if (!(line >= 0 && line < static_cast<double>(cells_.size()))) return;
  auto& row = cells_[static_cast<std::size_t>(line)];
  for (const auto& character : word) {
    if (column >= 0 && column < static_cast<double>(row.size()))
      row[static_cast<std::size_t>(column)] = {character, colour};
    ++column;
  }
}

std::vector<std::string> MapSketch::rows(bool coloured) const {
  std::vector<std::string> rows;
  for (const auto& cells : cells_) {
    const auto blank = [](const Mark& mark) { return mark.text == " "; };
    const auto end = std::find_if_not(cells.rbegin(), cells.rend(), blank).base();
    std::string row;
    auto colour = Colour::none;
    for (auto cell = cells.begin(); cell != end; ++cell) {
      if (coloured && cell->colour != colour) row += kPlain + escape(cell->colour);
      colour = cell->colour;
      row += cell->text;
    }
    if (coloured && colour != Colour::none) row += kPlain;
    rows.push_back(std::move(row));
  }
  return rows;
}

// The longest of 1, 2, 5, 10, ... that a sixth of the width holds.
std::string MapSketch::scale() const {
  double length_m = 0.1;
  for (double decade = 0.1; decade < 1e6; decade *= 10)
    for (const double step : {1.0, 2.0, 5.0})
      if (step * decade <= cell_m_ * kWidth / 6) length_m = step * decade;
  // From the one bar to the other.
  const auto width = static_cast<std::size_t>(std::lround(length_m / cell_m_));
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "| %g m", length_m);
  return "|" + std::string(width > 1 ? width - 1 : 0, '-') + text.data();
}

std::vector<std::string> characters(const std::string& text) {
  std::vector<std::string> all;
  for (const char c : text) {
    const bool goes_on = (static_cast<unsigned char>(c) & 0xC0U) == 0x80U;
    if (goes_on && !all.empty())
      all.back() += c;
    else
      all.emplace_back(1, c);
  }
  return all;
}

std::string arrow(double yaw_rad) {
  constexpr std::array<const char*, 8> kArrows{"→", "↗", "↑", "↖", "←", "↙", "↓", "↘"};
  const auto eighth = static_cast<int>(std::lround(wrap_rad(yaw_rad) / (kPi / 4)));
  return kArrows[static_cast<std::size_t>((eighth + 8) % 8)];
}

}  // namespace drover::sim
