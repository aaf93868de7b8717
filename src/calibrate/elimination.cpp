#include "calibrate/elimination.h"

#include <cmath>

namespace drover::calibrate {
namespace {

/// The equations of the node that is next to go, of the one behind it and of what is shared.
struct Front {
  Matrix<kJoint, kJoint> normal{};
  std::array<double, kJoint> right{};

  void add(const Row& row, double weight) {
    std::array<std::size_t, kJoint> used{};
    std::size_t count = 0;
    for (std::size_t i = 0; i < kJoint; ++i)
      if (row.slope[i] != 0) used[count++] = i;
    for (std::size_t a = 0; a < count; ++a) {
      const std::size_t i = used[a];
      const double weighted = weight * row.slope[i];
      right[i] += weighted * row.residual;
      for (std::size_t b = 0; b < count; ++b) normal[i][used[b]] += weighted * row.slope[used[b]];
    }
  }
  /// The first node is gone, the next one is the first.
  void advance() {
    for (std::size_t i = 0; i < kJoint; ++i) {
      for (std::size_t j = 0; j < kOfNode; ++j) {
        if (i < kOfNode) {
          normal[i][j] = normal[i + kOfNode][j + kOfNode];
        } else if (i >= 2 * kOfNode) {
          normal[i][j] = normal[j][i] = normal[i][j + kOfNode];
        }
      }
    }
    for (std::size_t j = 0; j < kOfNode; ++j) right[j] = right[j + kOfNode];
    for (std::size_t i = kOfNode; i < 2 * kOfNode; ++i) {
      right[i] = 0;
      for (std::size_t j = 0; j < kJoint; ++j) normal[i][j] = normal[j][i] = 0;
    }
  }
};

}  // namespace

bool Elimination::run(std::span<const Row> rows, std::size_t nodes, const NoiseScales& scales,
                      const Prior& prior) {
  nodes_.assign(nodes, {});
  Front front;
  for (std::size_t i = 0; i < kShared; ++i) {
    const double weight = 1 / (prior.sigma[i] * prior.sigma[i]);
    front.normal[2 * kOfNode + i][2 * kOfNode + i] = weight;
    front.right[2 * kOfNode + i] = weight * prior.missing[i];
  }
  std::size_t next = 0;
  for (std::size_t k = 0; k < nodes; ++k) {
    for (; next < rows.size() && rows[next].node == k; ++next)
      front.add(rows[next], rows[next].trust / scales[static_cast<std::size_t>(rows[next].noise)]);
    Matrix<kOfNode, kOfNode> own{};
    for (std::size_t i = 0; i < kOfNode; ++i)
      for (std::size_t j = 0; j < kOfNode; ++j) own[i][j] = front.normal[i][j];
    const auto inverse = inverse_of(own);
    if (!inverse) return false;
    Node& node = nodes_[k];
    node.inverse = *inverse;
    for (std::size_t i = 0; i < kOfNode; ++i) {
      for (std::size_t j = 0; j < kOfNode; ++j) {
        node.own[i] += (*inverse)[i][j] * front.right[j];
        for (std::size_t c = 0; c < kBehind; ++c)
          node.follow[i][c] += (*inverse)[i][j] * front.normal[j][kOfNode + c];
      }
    }
    for (std::size_t i = 0; i < kBehind; ++i) {
      for (std::size_t j = 0; j < kOfNode; ++j) {
        const double from = front.normal[j][kOfNode + i];
        if (from == 0) continue;
        front.right[kOfNode + i] -= from * node.own[j];
        for (std::size_t c = 0; c < kBehind; ++c)
          front.normal[kOfNode + i][kOfNode + c] -= from * node.follow[j][c];
      }
    }
    front.advance();
  }
  Matrix<kShared, kShared> shared{};
  for (std::size_t i = 0; i < kShared; ++i)
    for (std::size_t j = 0; j < kShared; ++j)
      shared[i][j] = front.normal[2 * kOfNode + i][2 * kOfNode + j];
  const auto covariance = inverse_of(shared);
  if (!covariance) return false;
  covariance_ = *covariance;
  shared_step_ = {};
  for (std::size_t i = 0; i < kShared; ++i)
    for (std::size_t j = 0; j < kShared; ++j)
      shared_step_[i] += covariance_[i][j] * front.right[2 * kOfNode + j];
  node_steps_.assign(nodes, {});
  std::array<double, kBehind> behind{};
  for (std::size_t i = 0; i < kShared; ++i) behind[kOfNode + i] = shared_step_[i];
  for (std::size_t k = nodes; k-- > 0;) {
    node_steps_[k] = nodes_[k].own;
    for (std::size_t i = 0; i < kOfNode; ++i)
      for (std::size_t c = 0; c < kBehind; ++c)
        node_steps_[k][i] -= nodes_[k].follow[i][c] * behind[c];
    for (std::size_t i = 0; i < kOfNode; ++i) behind[i] = node_steps_[k][i];
  }
  return true;
}

std::vector<Matrix<kOfNode, kShared>> Elimination::sensitivities() const {
  std::vector<Matrix<kOfNode, kShared>> all(nodes_.size());
  for (std::size_t k = nodes_.size(); k-- > 0;) {
    const auto& follow = nodes_[k].follow;
    for (std::size_t i = 0; i < kOfNode; ++i) {
      for (std::size_t c = 0; c < kShared; ++c) {
        all[k][i][c] = -follow[i][kOfNode + c];
        if (k + 1 == nodes_.size()) continue;
        for (std::size_t j = 0; j < kOfNode; ++j) all[k][i][c] -= follow[i][j] * all[k + 1][j][c];
      }
    }
  }
  return all;
}

void Elimination::visit_covariances(
    const std::function<void(std::size_t, const Matrix<kJoint, kJoint>&)>& visit) const {
  // Of what stands behind; there is no node behind the last one, and nothing follows from it.
  Matrix<kBehind, kBehind> behind{};
  for (std::size_t i = 0; i < kShared; ++i)
    for (std::size_t j = 0; j < kShared; ++j) behind[kOfNode + i][kOfNode + j] = covariance_[i][j];
  for (std::size_t k = nodes_.size(); k-- > 0;) {
    const Node& node = nodes_[k];
    Matrix<kJoint, kJoint> joint{};
    for (std::size_t i = 0; i < kBehind; ++i)
      for (std::size_t j = 0; j < kBehind; ++j) joint[kOfNode + i][kOfNode + j] = behind[i][j];
    for (std::size_t i = 0; i < kOfNode; ++i) {
      for (std::size_t j = 0; j < kBehind; ++j) {
        double sum = 0;
        for (std::size_t c = 0; c < kBehind; ++c) sum -= node.follow[i][c] * behind[c][j];
        joint[i][kOfNode + j] = joint[kOfNode + j][i] = sum;
      }
    }
    for (std::size_t i = 0; i < kOfNode; ++i) {
      for (std::size_t j = 0; j < kOfNode; ++j) {
        double sum = node.inverse[i][j];
        for (std::size_t c = 0; c < kBehind; ++c) sum -= node.follow[i][c] * joint[j][kOfNode + c];
        joint[i][j] = sum;
      }
    }
    visit(k, joint);
    for (std::size_t i = 0; i < kBehind; ++i) {
      const std::size_t from_i = i < kOfNode ? i : i + kOfNode;
      for (std::size_t j = 0; j < kBehind; ++j)
        behind[i][j] = joint[from_i][j < kOfNode ? j : j + kOfNode];
    }
  }
}

}  // namespace drover::calibrate
