// A value over time from samples, and its integral.
#pragma once

#include <vector>

namespace drover::calibrate {

/// Between two samples a straight line, outside of them the nearest.
class Series final {
 public:
  Series() = default;
  Series(std::vector<double> times_s, std::vector<double> values);

  bool empty() const { return times_s_.empty(); }
  double first_s() const { return times_s_.front(); }
  double last_s() const { return times_s_.back(); }
  double at(double time_s) const;
  /// From the first sample to `time_s`.
  double integral(double time_s) const;
  double integral(double from_s, double to_s) const { return integral(to_s) - integral(from_s); }
  /// Whether no two neighbours about the span are farther apart than `longest_s`, and it is inside.
  bool covers(double from_s, double to_s, double longest_s) const;
  /// Sum of all changes that are not a wobble of less than `wobble`.
  double variation(double wobble) const;
  const std::vector<double>& times_s() const { return times_s_; }

 private:
  void index();
  std::size_t part_of(double time_s) const;
  std::size_t before(double time_s) const;  ///< index of the sample at or before
  double between(std::size_t sample, double time_s) const;

  std::vector<double> times_s_;
  std::vector<double> values_;
  std::vector<double> sums_;        ///< integral up to each
  std::vector<std::size_t> parts_;  ///< the sample at or before the begin of each part
  double per_s_ = 0;                ///< parts
};

}  // namespace drover::calibrate
