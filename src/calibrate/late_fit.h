// Gauss-Newton of a few numbers on residuals that a function gives, with an interval that holds
// when neighbouring residuals are alike.
#pragma once

#include <array>
#include <cmath>
#include <vector>

#include "calibrate/matrix.h"

namespace drover::calibrate {

template <std::size_t kNumbers>
struct SmallFit {
  using Numbers = std::array<double, kNumbers>;
  Numbers value{};
  std::array<Numbers, kNumbers> covariance{};
  bool ok = false;

  /// `residuals(numbers)` gives measured less modelled; `clamped` keeps numbers where they mean
  /// something; `small` is what each is varied by; so many residuals in a row belong together.
  template <class Residuals, class Clamped>
  void run(Numbers from, const Numbers& small, std::size_t together, const Residuals& residuals,
           const Clamped& clamped) {
    value = clamped(from);
    for (int i = 0; i < 12; ++i) {
      if (!look(small, residuals)) return;
      Numbers next = value;
      for (std::size_t a = 0; a < kNumbers; ++a)
        for (std::size_t b = 0; b < kNumbers; ++b) next[a] += inverse_[a][b] * right_[b];
      value = clamped(next);
    }
    if (!look(small, residuals)) return;
    spread(together);
    ok = true;
  }

 private:
  template <class Residuals>
  bool look(const Numbers& small, const Residuals& residuals) {
    off_ = residuals(value);
    for (std::size_t a = 0; a < kNumbers; ++a) {
      Numbers more = value;
      Numbers less = value;
      more[a] += small[a];
      less[a] -= small[a];
      slopes_[a] = residuals(less);
      const auto other = residuals(more);
      for (std::size_t i = 0; i < off_.size(); ++i)
        slopes_[a][i] = (slopes_[a][i] - other[i]) / (2 * small[a]);
    }
    double square = 0;
    for (const double r : off_) square += r * r;
    const double mean = square / static_cast<double>(off_.size()) + 1e-12;
    weights_.resize(off_.size());
    Matrix<kNumbers, kNumbers> normal{};
    right_ = {};
    for (std::size_t i = 0; i < off_.size(); ++i) {
      weights_[i] = 1 / (1 + off_[i] * off_[i] / (9 * mean));
      for (std::size_t a = 0; a < kNumbers; ++a) {
        right_[a] += weights_[i] * slopes_[a][i] * off_[i];
        for (std::size_t b = 0; b < kNumbers; ++b)
          normal[a][b] += weights_[i] * slopes_[a][i] * slopes_[b][i];
      }
    }
    for (std::size_t a = 0; a < kNumbers; ++a) normal[a][a] = normal[a][a] * (1 + 1e-9) + 1e-15;
    const auto inverse = inverse_of(normal);
    if (inverse) inverse_ = *inverse;
    return inverse.has_value();
  }

  void spread(std::size_t together) {
    std::array<Numbers, kNumbers> shown{};
    Numbers pull{};
    for (std::size_t i = 0; i < off_.size(); ++i) {
      for (std::size_t a = 0; a < kNumbers; ++a) pull[a] += weights_[i] * slopes_[a][i] * off_[i];
      if ((i + 1) % together != 0 && i + 1 != off_.size()) continue;
      for (std::size_t a = 0; a < kNumbers; ++a)
        for (std::size_t b = 0; b < kNumbers; ++b) shown[a][b] += pull[a] * pull[b];
      pull = {};
    }
    covariance = {};
    for (std::size_t a = 0; a < kNumbers; ++a)
      for (std::size_t b = 0; b < kNumbers; ++b)
        for (std::size_t c = 0; c < kNumbers; ++c)
          for (std::size_t d = 0; d < kNumbers; ++d)
            covariance[a][b] += inverse_[a][c] * shown[c][d] * inverse_[d][b];
  }

  std::vector<double> off_;
  std::array<std::vector<double>, kNumbers> slopes_;
  std::vector<double> weights_;
  Numbers right_{};
  Matrix<kNumbers, kNumbers> inverse_{};
};

}  // namespace drover::calibrate
