#include "calibrate/course.h"

#include <algorithm>

#include "drover/angle.h"

namespace drover::calibrate {
namespace {

constexpr double kPlaceGap_s = 1.0;

Series side(const std::vector<RimRow>& rims, double RimRow::*which, bool reversed) {
  std::vector<double> times;
  std::vector<double> values;
  times.reserve(rims.size());
  values.reserve(rims.size());
  for (const RimRow& row : rims) {
    times.push_back(row.time_s);
    values.push_back(reversed ? -(row.*which) : row.*which);
  }
  return {std::move(times), std::move(values)};
}

/// The last row at or before `time_s` that has one after it, close enough to go between.
template <class Row>
std::optional<std::pair<const Row*, double>> between(const std::vector<Row>& rows, double time_s) {
  const auto after = std::upper_bound(rows.begin(), rows.end(), time_s,
                                      [](double at, const Row& row) { return at < row.time_s; });
  if (after == rows.begin() || after == rows.end()) return std::nullopt;
  const Row* before = &*after - 1;
  const double span_s = after->time_s - before->time_s;
  if (!(span_s > 0) || span_s > kPlaceGap_s) return std::nullopt;
  return std::pair{before, (time_s - before->time_s) / span_s};
}

}  // namespace

Track track_of(const Drive& drive) {
  return track_of(drive, {});
}

Track track_of(const Drive& drive, const Signs& signs) {
  Track track;
  const auto left = signs.swapped ? &RimRow::right_mps : &RimRow::left_mps;
  const auto right = signs.swapped ? &RimRow::left_mps : &RimRow::right_mps;
  // A sign is that of the column, whichever side it is of.
  track.left_mps =
      side(drive.rims, left, signs.swapped ? signs.right_reversed : signs.left_reversed);
  track.right_mps =
      side(drive.rims, right, signs.swapped ? signs.left_reversed : signs.right_reversed);
  std::vector<double> times;
  std::vector<double> values;
  for (const ValueRow& row : drive.gyro_radps) {
    times.push_back(row.time_s);
    values.push_back(signs.gyro_reversed ? -row.value : row.value);
  }
  track.gyro_radps = Series(std::move(times), std::move(values));
  return track;
}

std::optional<Point> antenna_at(const std::vector<PlaceRow>& places, double time_s) {
  const auto found = between(places, time_s);
  if (!found) return std::nullopt;
  const auto& [row, share] = *found;
  return Point{row->east_m + share * (row[1].east_m - row->east_m),
               row->north_m + share * (row[1].north_m - row->north_m)};
}

std::optional<double> heading_at(const std::vector<ValueRow>& headings, double time_s) {
  const auto found = between(headings, time_s);
  if (!found) return std::nullopt;
  const auto& [row, share] = *found;
  return wrap_rad(row->value + share * wrap_rad(row[1].value - row->value));
}

}  // namespace drover::calibrate
