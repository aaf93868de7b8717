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
}

std::size_t Series::before(double time_s) const {
  const auto it = std::upper_bound(times_s_.begin(), times_s_.end(), time_s);
  return it == times_s_.begin() ? 0 : static_cast<std::size_t>(it - times_s_.begin()) - 1;
}

double Series::at(double time_s) const {
  if (empty()) return 0;
  const std::size_t i = before(time_s);
  if (i + 1 >= times_s_.size() || time_s <= times_s_[i]) return values_[i];
  const double share = (time_s - times_s_[i]) / (times_s_[i + 1] - times_s_[i]);
  return values_[i] + share * (values_[i + 1] - values_[i]);
}

double Series::integral(double time_s) const {
  if (empty()) return 0;
  const std::size_t i = before(time_s);
  const double mean = 0.5 * (values_[i] + at(time_s));
  return sums_[i] + mean * (time_s - times_s_[i]);
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
