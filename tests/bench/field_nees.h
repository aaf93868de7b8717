// Whether errors are as large as what is published of them, over independent drives.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "drover/angle.h"
#include "drover/snapshot.h"

namespace drover::bench {

/// Of one instant of one drive. Squares are normalised by what is published.
struct ErrorSample {
  double place2 = 0;
  double yaw2 = 0;
  double place_m = 0;
  double yaw_rad = 0;
  double place_sigma_m = 0;
  double yaw_sigma_rad = 0;
};

inline ErrorSample sample_of(const Snapshot& seen, const Pose& truth) {
  ErrorSample s;
  s.place_m = std::hypot(seen.pose.x_m - truth.x_m, seen.pose.y_m - truth.y_m);
  s.yaw_rad = std::abs(wrap_rad(seen.pose.yaw_rad - truth.yaw_rad));
  s.place_sigma_m = seen.pose.position_sigma_m;
  s.yaw_sigma_rad = seen.pose.yaw_sigma_rad;
  s.place2 = (s.place_m / s.place_sigma_m) * (s.place_m / s.place_sigma_m);
  s.yaw2 = (s.yaw_rad / s.yaw_sigma_rad) * (s.yaw_rad / s.yaw_sigma_rad);
  return s;
}

/// What a chi-square of so many degrees of freedom is below in 95 of 100 cases (Wilson and
/// Hilferty; to a thousandth from ten degrees on).
inline double chi_square_95(double freedom) {
  const double a = 2 / (9 * freedom);
  const double root = 1 - a + 1.6448536 * std::sqrt(a);
  return freedom * root * root * root;
}

/// Of a span of time.
struct Consistency {
  int instants = 0;
  double place2 = 0;  ///< mean over drives and instants
  double yaw2 = 0;
  double worst_place2 = 0;  ///< of an instant, mean over drives
  double worst_yaw2 = 0;
  double place_over = 0;  ///< share of instants whose mean is beyond the bound
  double yaw_over = 0;
  double place_inside = 0;  ///< share of samples inside three sigma
  double yaw_inside = 0;
  double place_m = 0;  ///< means
  double yaw_rad = 0;
  double place_sigma_m = 0;
  double yaw_sigma_rad = 0;
};

/// Samples by instant, of drives that all begin at the first one.
class ErrorTable final {
 public:
  void add(std::size_t instant, const ErrorSample& sample) {
    if (samples_.size() <= instant) samples_.resize(instant + 1);
    samples_[instant].push_back(sample);
  }
  /// Of the instants [first, last) that all of so many drives have.
  Consistency weigh(std::size_t first, std::size_t last, std::size_t drives) const {
    Consistency sum;
    const double n = static_cast<double>(drives);
    const double most_place2 = chi_square_95(2 * n) / n;
    const double most_yaw2 = chi_square_95(n) / n;
    for (std::size_t i = first; i < std::min(last, samples_.size()); ++i) {
      if (samples_[i].size() != drives) continue;
      ++sum.instants;
      const double place2 = total(samples_[i], &ErrorSample::place2) / n;
      const double yaw2 = total(samples_[i], &ErrorSample::yaw2) / n;
      sum.place2 += place2;
      sum.yaw2 += yaw2;
      sum.worst_place2 = std::max(sum.worst_place2, place2);
      sum.worst_yaw2 = std::max(sum.worst_yaw2, yaw2);
      sum.place_over += place2 > most_place2 ? 1 : 0;
      sum.yaw_over += yaw2 > most_yaw2 ? 1 : 0;
      for (const ErrorSample& s : samples_[i]) {
        sum.place_inside += s.place2 <= 9 ? 1 / n : 0;
        sum.yaw_inside += s.yaw2 <= 9 ? 1 / n : 0;
      }
      sum.place_m += total(samples_[i], &ErrorSample::place_m) / n;
      sum.yaw_rad += total(samples_[i], &ErrorSample::yaw_rad) / n;
      sum.place_sigma_m += total(samples_[i], &ErrorSample::place_sigma_m) / n;
      sum.yaw_sigma_rad += total(samples_[i], &ErrorSample::yaw_sigma_rad) / n;
    }
    if (sum.instants == 0) return sum;
    for (double* value :
         {&sum.place2, &sum.yaw2, &sum.place_over, &sum.yaw_over, &sum.place_inside,
          &sum.yaw_inside, &sum.place_m, &sum.yaw_rad, &sum.place_sigma_m, &sum.yaw_sigma_rad}) {
      *value /= sum.instants;
    }
    return sum;
  }

 private:
  static double total(const std::vector<ErrorSample>& samples, double ErrorSample::*value) {
    double sum = 0;
    for (const ErrorSample& s : samples) sum += s.*value;
    return sum;
  }

  std::vector<std::vector<ErrorSample>> samples_;
};

}  // namespace drover::bench
