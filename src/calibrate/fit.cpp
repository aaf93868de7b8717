#include "calibrate/fit.h"

#include <algorithm>
#include <cmath>

namespace drover::calibrate {
namespace {

constexpr double kHuber = 3;    // sigmas: from here on a residual counts less
constexpr double kOutlier = 6;  // and from here on ever less
constexpr int kNoiseRounds = 12;
constexpr int kMostSteps = 25;
constexpr double kConverged = 0.02;   // of a sigma
constexpr double kMostStep_s = 0.15;  // of a lateness, at once
constexpr double kPseudo = 6;         // so many assumed residuals steady the noise that is seen
constexpr double kLeastScale = 1.0 / 25;
constexpr double kMostScale = 400;
constexpr double kPiece_s = 12;  // what is within belongs together
constexpr std::size_t kLeastPieces = 6;

double trust_in(double sigmas) {
  if (sigmas < kHuber) return 1;
  return sigmas < kOutlier ? kHuber / sigmas : kHuber * kOutlier / (sigmas * sigmas);
}

double quadratic(const Row& row, const Matrix<kJoint, kJoint>& covariance) {
  std::array<std::size_t, kJoint> used{};
  std::size_t count = 0;
  for (std::size_t i = 0; i < kJoint; ++i)
    if (row.slope[i] != 0) used[count++] = i;
  double sum = 0;
  for (std::size_t a = 0; a < count; ++a)
    for (std::size_t b = 0; b < count; ++b)
      sum += row.slope[used[a]] * row.slope[used[b]] * covariance[used[a]][used[b]];
  return sum;
}

class Fitting final {
 public:
  explicit Fitting(Chain& chain) : chain_(chain) { scales_.fill(1); }

  Fit run() {
    Fit result;
    if (!settle()) return result;
    for (int round = 0; round < kNoiseRounds; ++round) {
      look_at_noise();
      if (!step()) return result;
    }
    if (!settle()) return result;
    result.ok = true;
    result.value = chain_.shared();
    result.scales = scales_;
    result.covariance = covariance();
    for (const Row& row : rows_) {
      const bool of_receiver = row.noise == Noise::place_white || row.noise == Noise::heading_white;
      if (of_receiver && row.trust < kHuber / kOutlier) ++result.outliers;
    }
    return result;
  }

 private:
  double scale_of(const Row& row) const { return scales_[static_cast<std::size_t>(row.noise)]; }

  bool solve() {
    chain_.rows(rows_);
    for (Row& row : rows_) {
      const double sigmas = std::abs(row.residual) / std::sqrt(scale_of(row));
      row.trust = robust_ && row.noise != Noise::known ? trust_in(sigmas) : 1;
    }
    return elimination_.run(rows_, chain_.size(), scales_, chain_.prior());
  }
  /// One step; how far it went in sigmas is in `moved_`.
  bool step() {
    if (!solve()) return false;
    SharedValues shared = elimination_.shared_step();
    double share = 1;
    for (const std::size_t late : {kPlaceLate, kHeadingLate})
      share = std::min(share, kMostStep_s / std::max(std::abs(shared[late]), kMostStep_s));
    if (turns_back(shared)) share /= 2;
    before_ = shared;
    moved_ = 0;
    for (std::size_t i = 0; i < kShared; ++i) {
      moved_ = std::max(moved_, std::abs(shared[i]) / std::sqrt(elimination_.covariance()[i][i]));
      shared[i] *= share;
    }
    auto nodes = elimination_.node_steps();
    if (share < 1)
      for (auto& node : nodes)
        for (double& value : node) value *= share;
    chain_.step(shared, nodes);
    return std::isfinite(moved_);
  }
  /// Whether the step takes back what the last one did: both went too far.
  bool turns_back(const SharedValues& now) const {
    double product = 0;
    for (std::size_t i = 0; i < kShared; ++i)
      product += now[i] * before_[i] / elimination_.covariance()[i][i];
    return product < 0;
  }
  bool settle() {
    for (int i = 0; i < kMostSteps; ++i) {
      if (!step()) return false;
      if (i >= 2) robust_ = true;
      if (i >= 4 && moved_ < kConverged) return true;
    }
    return moved_ < 1;
  }

  /// Of each kind of noise: what the residuals show, over what they can show.
  void look_at_noise() {
    // What is left after the step, or one noise takes over from another in turn.
    chain_.rows(after_);
    for (std::size_t i = 0; i < rows_.size(); ++i) rows_[i].residual = after_[i].residual;
    NoiseScales seen{};
    NoiseScales freedom{};
    std::vector<std::size_t> first(chain_.size() + 1, rows_.size());
    for (std::size_t i = rows_.size(); i-- > 0;) first[rows_[i].node] = i;
    elimination_.visit_covariances([&](std::size_t k, const auto& joint) {
      for (std::size_t i = first[k]; i < rows_.size() && rows_[i].node == k; ++i) {
        const Row& row = rows_[i];
        const auto n = static_cast<std::size_t>(row.noise);
        seen[n] += row.trust * row.residual * row.residual;
        freedom[n] += 1 - row.trust * quadratic(row, joint) / scales_[n];
      }
    });
    for (std::size_t n = 0; n + 1 < kNoises; ++n) {
      const double scale = (seen[n] + kPseudo) / (std::max(freedom[n], 0.0) + kPseudo);
      scales_[n] = std::clamp(scale, kLeastScale, kMostScale);
    }
  }

  /// What the residuals pull at the shared numbers, summed up piece by piece: noise that lasts for
  /// seconds, or is another one in each turn, shows in how unlike these sums are.
  Matrix<kShared, kShared> covariance() const {
    const auto& model = elimination_.covariance();
    const auto per_piece = static_cast<std::size_t>(std::max(1.0, kPiece_s / chain_.step_s()));
    const std::size_t pieces = (chain_.size() + per_piece - 1) / per_piece;
    auto worse = model;
    if (pieces < kLeastPieces) return worse;
    const auto follow = elimination_.sensitivities();
    std::vector<SharedValues> pulls(pieces);
    for (const Row& row : rows_) {
      const double weight = row.trust * row.residual / scale_of(row);
      for (std::size_t c = 0; c < kShared; ++c) {
        double slope = row.slope[2 * kOfNode + c];
        for (std::size_t i = 0; i < kOfNode; ++i) {
          slope += row.slope[i] * follow[row.node][i][c];
          if (row.slope[kOfNode + i] != 0)
            slope += row.slope[kOfNode + i] * follow[row.node + 1][i][c];
        }
        pulls[row.node / per_piece][c] += weight * slope;
      }
    }
    Matrix<kShared, kShared> shown{};
    for (const auto& pull : pulls) {
      SharedValues moves{};
      for (std::size_t i = 0; i < kShared; ++i)
        for (std::size_t c = 0; c < kShared; ++c) moves[i] += model[i][c] * pull[c];
      for (std::size_t i = 0; i < kShared; ++i)
        for (std::size_t j = 0; j < kShared; ++j) shown[i][j] += moves[i] * moves[j];
    }
    const double few = static_cast<double>(pieces) / static_cast<double>(pieces - 1);
    std::array<double, kShared> grow{};
    for (std::size_t i = 0; i < kShared; ++i)
      grow[i] = std::sqrt(std::max(1.0, few * shown[i][i] / model[i][i]));
    for (std::size_t i = 0; i < kShared; ++i)
      for (std::size_t j = 0; j < kShared; ++j) worse[i][j] *= grow[i] * grow[j];
    return worse;
  }

  Chain& chain_;
  Elimination elimination_;
  std::vector<Row> rows_;
  std::vector<Row> after_;
  NoiseScales scales_{};
  SharedValues before_{};  ///< the last step
  bool robust_ = false;
  double moved_ = 0;
};

}  // namespace

Fit fit(Chain& chain) {
  return Fitting(chain).run();
}

}  // namespace drover::calibrate
