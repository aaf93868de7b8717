// Small matrices of a size that is known.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <optional>

namespace drover::calibrate {

template <std::size_t kRows, std::size_t kColumns>
using Matrix = std::array<std::array<double, kColumns>, kRows>;

/// Of a symmetric positive definite matrix; nothing when it is none.
template <std::size_t kSize>
std::optional<Matrix<kSize, kSize>> inverse_of(const Matrix<kSize, kSize>& m) {
  Matrix<kSize, kSize> low{};
  for (std::size_t i = 0; i < kSize; ++i) {
    for (std::size_t j = 0; j <= i; ++j) {
      double sum = m[i][j];
      for (std::size_t k = 0; k < j; ++k) sum -= low[i][k] * low[j][k];
      if (i != j) {
        low[i][j] = sum / low[j][j];
      } else if (sum > 0 && std::isfinite(sum)) {
        low[i][i] = std::sqrt(sum);
      } else {
        return std::nullopt;
      }
    }
  }
  Matrix<kSize, kSize> inverse{};
  for (std::size_t column = 0; column < kSize; ++column) {
    std::array<double, kSize> x{};
    for (std::size_t i = column; i < kSize; ++i) {
      double sum = i == column ? 1 : 0;
      for (std::size_t k = column; k < i; ++k) sum -= low[i][k] * x[k];
      x[i] = sum / low[i][i];
    }
    for (std::size_t i = kSize; i-- > 0;) {
      double sum = x[i];
      for (std::size_t k = i + 1; k < kSize; ++k) sum -= low[k][i] * inverse[k][column];
      inverse[i][column] = sum / low[i][i];
    }
  }
  return inverse;
}

}  // namespace drover::calibrate
