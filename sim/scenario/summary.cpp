#include "sim/scenario/summary.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <sstream>
#include <stdexcept>
#include <string_view>

namespace drover::sim {
namespace {

std::vector<std::string_view> split(std::string_view line) {
  std::vector<std::string_view> cells;
  while (true) {
    const auto comma = std::min(line.find(','), line.size());
    cells.push_back(line.substr(0, comma));
    if (comma == line.size()) return cells;
    line.remove_prefix(comma + 1);
  }
}

double number(std::string_view text) {
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size())
    throw std::runtime_error("truth: '" + std::string(text) + "' is no number");
  return value;
}

std::size_t column(const std::vector<std::string_view>& header, std::string_view name) {
  const auto at = std::find(header.begin(), header.end(), name);
  if (at == header.end()) throw std::runtime_error("truth: no column " + std::string(name));
  return static_cast<std::size_t>(at - header.begin());
}

}  // namespace

std::vector<TruthSample> read_truth(std::istream& csv) {
  std::string line;
  std::getline(csv, line);
  const std::string header = line;
  const auto names = split(header);
  const std::array columns{column(names, "time_s"), column(names, "x_m"), column(names, "y_m")};
  std::vector<TruthSample> samples;
  while (std::getline(csv, line)) {
    if (csv.eof()) break;  // no line end: cut short
    const auto cells = split(line);
    if (cells.size() != names.size()) throw std::runtime_error("truth: a line of another length");
    samples.push_back(
        {number(cells[columns[0]]), number(cells[columns[1]]), number(cells[columns[2]])});
  }
  return samples;
}

std::optional<std::vector<std::string>> read_touches(std::istream& log) {
  std::optional<std::vector<std::string>> touched;
  for (std::string line; std::getline(log, line);) {
    std::istringstream words(line);
    std::string stamp, what, name;
    words >> stamp >> what >> name;
    if (what == "watching" && !touched) touched.emplace();
    if (what != "touch") continue;
    if (!touched) touched.emplace();
    if (std::find(touched->begin(), touched->end(), name) == touched->end())
      touched->push_back(name);
  }
  return touched;
}

DriveFigures measure_drive(const std::vector<TruthSample>& truth,
                           const std::vector<TrackPose>& track, std::size_t goal, double begin_s,
                           double end_s) {
  DriveFigures figures;
  CrossTrack cross_track(track);
  const TruthSample* last = nullptr;
  double first_s = 0;
  double square_sum = 0;
  for (const auto& sample : truth) {
    if (sample.time_s < begin_s || sample.time_s > end_s) continue;
    const double beside_m = cross_track.distance_m(sample.x_m, sample.y_m);
    figures.cross_track_max_m = std::max(figures.cross_track_max_m, beside_m);
    if (last == nullptr) first_s = sample.time_s;
    const double way_m =
        last == nullptr ? 0 : std::hypot(sample.x_m - last->x_m, sample.y_m - last->y_m);
    figures.distance_m += way_m;
    square_sum += way_m * beside_m * beside_m;
    last = &sample;
  }
  if (last == nullptr) return figures;
  figures.time_s = last->time_s - first_s;
  if (figures.distance_m > 0)
    figures.cross_track_rms_m = std::sqrt(square_sum / figures.distance_m);
  if (goal < track.size())
    figures.goal_distance_m = std::hypot(last->x_m - track[goal].x_m, last->y_m - track[goal].y_m);
  return figures;
}

}  // namespace drover::sim
