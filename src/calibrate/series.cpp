#include "calibrate/series.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace drover::calibrate {

Series::Series(std::vector<double> times_s, std::vector<double> values)
    : times_s_(std::move(times_s)), values_(std::move(values)), sums_(times_s_.size(), 0.0) {
  for (std::size_t i = 1; i < times_s_.size(); ++i) {
    const double mean = 0.5 * (values_[i - 1] + values_[i]);
    sums_[i] = sums_[i - 1] + mean * (times_s_[i] - times_s_[i - 1]);
  }
  index();
}

/// As many parts of equal length as there are samples: which sample begins each.
void Series::index() {
  if (empty()) return;
  const std::size_t parts = times_s_.size();
  const double span_s = last_s() - first_s();
  per_s_ = span_s > 0 ? static_cast<double>(parts) / span_s : 0;
  parts_.resize(parts + 1);
  std::size_t sample = 0;
  for (std::size_t part = 0; part <= parts; ++part) {
    while (sample + 1 < times_s_.size() && part_of(times_s_[sample + 1]) < part) ++sample;
    parts_[part] = sample;
  }
}

std::size_t Series::part_of(double time_s) const {
  const double part = (time_s - first_s()) * per_s_;
  return part > 0 ? static_cast<std::size_t>(std::min(part, static_cast<double>(times_s_.size())))
                  : 0;
}

std::size_t Series::before(double time_s) const {
  const std::size_t part = part_of(time_s);
  const auto begin = times_s_.begin() + static_cast<std::ptrdiff_t>(parts_[part]);
  const auto end = part + 1 < parts_.size()
                       ? times_s_.begin() + static_cast<std::ptrdiff_t>(
                                                std::min(parts_[part + 1] + 2, times_s_.size()))
                       : times_s_.end();
  const auto it = std::upper_bound(begin, end, time_s);
  return it == times_s_.begin() ? 0 : static_cast<std::size_t>(it - times_s_.begin()) - 1;
}

double Series::between(std::size_t sample, double time_s) const {
  if (sample + 1 >= times_s_.size() || time_s <= times_s_[sample]) return values_[sample];
  const double share = (time_s - times_s_[sample]) / (times_s_[sample + 1] - times_s_[sample]);
  return values_[sample] + share * (values_[sample + 1] - values_[sample]);
}

double Series::at(double time_s) const {
  return empty() ? 0 : between(before(time_s), time_s);
}

double Series::integral(double time_s) const {
  if (empty()) return 0;
  const std::size_t i = before(time_s);
  return sums_[i] + 0.5 * (values_[i] + between(i, time_s)) * (time_s - times_s_[i]);
}

bool Series::covers(double from_s, double to_s, double longest_s) const {
  if (empty() || from_s < first_s() - longest_s || to_s > last_s() + longest_s) return false;
  for (std::size_t i = before(from_s); i + 1 < times_s_.size() && times_s_[i] < to_s; ++i)
    if (times_s_[i + 1] - times_s_[i] > longest_s) return false;
  return true;
}

double Series::variation(double wobble) const {
  if (empty()) return 0;
  double sum = 0;
  double from = values_.front();
  for (const double value : values_) {
    if (std::abs(value - from) < wobble) continue;
    sum += std::abs(value - from);
    from = value;
  }
  return sum;
}

}  // namespace drover::calibrate
