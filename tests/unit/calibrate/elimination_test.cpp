// The chain, solved node by node, against the same equations solved as a whole.
#include "calibrate/elimination.h"

#include <gtest/gtest.h>

#include <random>

namespace drover::calibrate {
namespace {

constexpr std::size_t kNodes = 5;
constexpr std::size_t kAll = kNodes * kOfNode + kShared;
using Dense = std::vector<std::vector<double>>;

std::size_t place_of(const Row& row, std::size_t i) {
  if (i >= 2 * kOfNode) return kNodes * kOfNode + i - 2 * kOfNode;
  return row.node * kOfNode + i;  // the next node stands behind this one
}

std::vector<Row> some_rows() {
  std::mt19937_64 random(5);
  const auto number = [&] { return static_cast<double>(random() % 2001) / 1000 - 1; };
  std::vector<Row> rows;
  for (std::size_t node = 0; node < kNodes; ++node) {
    for (int i = 0; i < 20; ++i) {
      Row row;
      row.node = node;
      row.noise = static_cast<Noise>(i % 4);
      row.residual = number();
      row.trust = 0.5 + 0.5 * std::abs(number());
      for (std::size_t j = 0; j < kJoint; ++j) {
        const bool next = j >= kOfNode && j < 2 * kOfNode;
        if (!next || node + 1 < kNodes) row.slope[j] = number();
      }
      rows.push_back(row);
    }
  }
  return rows;
}

/// Gauss-Jordan; `right` becomes the solution.
Dense inverse_of(Dense m, std::vector<double>& right) {
  Dense inverse(kAll, std::vector<double>(kAll));
  for (std::size_t i = 0; i < kAll; ++i) inverse[i][i] = 1;
  for (std::size_t p = 0; p < kAll; ++p) {
    const double pivot = m[p][p];
    for (std::size_t j = 0; j < kAll; ++j) {
      m[p][j] /= pivot;
      inverse[p][j] /= pivot;
    }
    right[p] /= pivot;
    for (std::size_t i = 0; i < kAll; ++i) {
      if (i == p) continue;
      const double factor = m[i][p];
      for (std::size_t j = 0; j < kAll; ++j) {
        m[i][j] -= factor * m[p][j];
        inverse[i][j] -= factor * inverse[p][j];
      }
      right[i] -= factor * right[p];
    }
  }
  return inverse;
}

TEST(Elimination, GivesWhatTheWholeSystemGives) {
  const auto rows = some_rows();
  NoiseScales scales;
  scales.fill(1);
  scales[1] = 4;
  Prior prior;
  prior.sigma.fill(2);
  prior.missing[3] = 0.5;
  Dense normal(kAll, std::vector<double>(kAll));
  std::vector<double> step(kAll);
  for (std::size_t i = 0; i < kShared; ++i) {
    normal[kNodes * kOfNode + i][kNodes * kOfNode + i] = 0.25;
    step[kNodes * kOfNode + i] = 0.25 * prior.missing[i];
  }
  for (const Row& row : rows) {
    const double weight = row.trust / scales[static_cast<std::size_t>(row.noise)];
    for (std::size_t i = 0; i < kJoint; ++i) {
      if (row.slope[i] == 0) continue;
      step[place_of(row, i)] += weight * row.slope[i] * row.residual;
      for (std::size_t j = 0; j < kJoint; ++j)
        if (row.slope[j] != 0)
          normal[place_of(row, i)][place_of(row, j)] += weight * row.slope[i] * row.slope[j];
    }
  }
  const Dense covariance = inverse_of(normal, step);

  Elimination elimination;
  ASSERT_TRUE(elimination.run(rows, kNodes, scales, prior));
  constexpr std::size_t kFirstShared = kNodes * kOfNode;
  for (std::size_t i = 0; i < kShared; ++i) {
    EXPECT_NEAR(elimination.shared_step()[i], step[kFirstShared + i], 1e-9);
    for (std::size_t j = 0; j < kShared; ++j)
      EXPECT_NEAR(elimination.covariance()[i][j], covariance[kFirstShared + i][kFirstShared + j],
                  1e-9);
  }
  for (std::size_t k = 0; k < kNodes; ++k)
    for (std::size_t i = 0; i < kOfNode; ++i)
      EXPECT_NEAR(elimination.node_steps()[k][i], step[k * kOfNode + i], 1e-9);
  elimination.visit_covariances([&](std::size_t k, const auto& joint) {
    Row row;
    row.node = k;
    for (std::size_t i = 0; i < kJoint; ++i) {
      for (std::size_t j = 0; j < kJoint; ++j) {
        const auto next = [](std::size_t at) { return at >= kOfNode && at < 2 * kOfNode; };
        if (k + 1 == kNodes && (next(i) || next(j))) continue;
        EXPECT_NEAR(joint[i][j], covariance[place_of(row, i)][place_of(row, j)], 1e-9);
      }
    }
  });
}

TEST(Elimination, HasNoSolutionWhereNothingIsKnown) {
  Elimination elimination;
  NoiseScales scales;
  scales.fill(1);
  Prior prior;
  prior.sigma.fill(1);
  EXPECT_FALSE(elimination.run({}, 2, scales, prior));
}

}  // namespace
}  // namespace drover::calibrate
