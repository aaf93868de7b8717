// Least squares over a chain: each row of it touches one node and the next, and numbers that all
// nodes share. Solved node by node, so that an hour costs no more for each second than a minute.
#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <span>
#include <vector>

#include "calibrate/matrix.h"

namespace drover::calibrate {

inline constexpr std::size_t kOfNode = 6;
inline constexpr std::size_t kShared = 10;
inline constexpr std::size_t kBehind = kOfNode + kShared;  ///< the next node and what is shared
inline constexpr std::size_t kJoint = kOfNode + kBehind;   ///< a node, the next, what is shared

using NodeValues = std::array<double, kOfNode>;
using SharedValues = std::array<double, kShared>;

/// Whose noise a row has.
enum class Noise : std::size_t {
  along,        ///< of the way by wheels
  across,       ///< beside it
  wheel_turn,   ///< of the turn by wheels
  gyro_turn,    ///< of the turn by the gyro
  place_white,  ///< of a position, for itself
  place_slow,   ///< of the positions' error that stays
  heading_white,
  heading_slow,
  known,  ///< what is assumed
};
inline constexpr std::size_t kNoises = 9;
using NoiseScales = std::array<double, kNoises>;  ///< variance over the assumed one

/// One residual over its assumed sigma, and how the model's value changes (over that sigma).
struct Row {
  std::size_t node = 0;
  Noise noise = Noise::known;
  double residual = 0;
  double trust = 1;                    ///< less for an outlier
  std::array<double, kJoint> slope{};  ///< by this node, the next node, what is shared
};

/// What is known of the shared numbers before: one sigma of each, and what is still missing to it.
struct Prior {
  SharedValues missing{};
  SharedValues sigma{};
};

class Elimination final {
 public:
  /// `rows` in the order of their nodes, none beyond `nodes`. False: it has no solution.
  bool run(std::span<const Row> rows, std::size_t nodes, const NoiseScales& scales,
           const Prior& prior);

  const SharedValues& shared_step() const { return shared_step_; }
  const std::vector<NodeValues>& node_steps() const { return node_steps_; }
  const Matrix<kShared, kShared>& covariance() const { return covariance_; }
  /// How each node follows the shared numbers when all else fits as well as it can.
  std::vector<Matrix<kOfNode, kShared>> sensitivities() const;
  /// Backwards along the chain: the joint covariance of a node, the next and what is shared.
  void visit_covariances(
      const std::function<void(std::size_t, const Matrix<kJoint, kJoint>&)>& visit) const;

 private:
  struct Node {
    Matrix<kOfNode, kOfNode> inverse{};
    Matrix<kOfNode, kBehind> follow{};  ///< less what stands behind, times this
    NodeValues own{};
  };

  std::vector<Node> nodes_;
  SharedValues shared_step_{};
  std::vector<NodeValues> node_steps_;
  Matrix<kShared, kShared> covariance_{};
};

}  // namespace drover::calibrate
