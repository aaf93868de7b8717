// Square matrices of a filter of the usual shape: dense, with rows padded to an even length, so
// that a compiler can use its vector units for them.
#pragma once

#include <array>
#include <cstddef>

namespace drover::bench {

template <std::size_t N>
struct SquareMatrix {
  static constexpr std::size_t kRow = N + N % 2;
  alignas(16) double at[N][kRow] = {};

  static SquareMatrix one() {
    SquareMatrix m;
    for (std::size_t i = 0; i < N; ++i) m.at[i][i] = 1;
    return m;
  }
};

template <std::size_t N>
void multiply(const SquareMatrix<N>& a, const SquareMatrix<N>& b, SquareMatrix<N>& out) {
  constexpr std::size_t kRow = SquareMatrix<N>::kRow;
  for (std::size_t i = 0; i < N; ++i) {
    double row[kRow] = {};
    for (std::size_t k = 0; k < N; ++k) {
      const double factor = a.at[i][k];
      for (std::size_t j = 0; j < kRow; ++j) row[j] += factor * b.at[k][j];
    }
    for (std::size_t j = 0; j < kRow; ++j) out.at[i][j] = row[j];
  }
}

template <std::size_t N>
SquareMatrix<N> transposed(const SquareMatrix<N>& m) {
  SquareMatrix<N> out;
  for (std::size_t i = 0; i < N; ++i)
    for (std::size_t j = 0; j < N; ++j) out.at[j][i] = m.at[i][j];
  return out;
}

/// a * m * a^T
template <std::size_t N>
void transform(const SquareMatrix<N>& a, SquareMatrix<N>& m) {
  SquareMatrix<N> half;
  multiply(a, m, half);
  multiply(half, transposed(a), m);
}

/// Of the first n rows and columns, positive definite, in place (Gauss and Jordan).
template <std::size_t N>
void invert(SquareMatrix<N>& m, std::size_t n) {
  for (std::size_t p = 0; p < n; ++p) {
    const double pivot = 1 / m.at[p][p];
    m.at[p][p] = 1;
    for (std::size_t j = 0; j < n; ++j) m.at[p][j] *= pivot;
    for (std::size_t i = 0; i < n; ++i) {
      if (i == p) continue;
      const double factor = m.at[i][p];
      m.at[i][p] = 0;
      for (std::size_t j = 0; j < n; ++j) m.at[i][j] -= factor * m.at[p][j];
    }
  }
}

}  // namespace drover::bench
