// How much the antenna line is mounted beside what its heading offset says, from straight legs.
#pragma once

#include <array>
#include <cstdint>

#include "engine/config.h"

namespace drover::engine::estimate {

/// A straight leg with RTK positions at both ends.
struct StraightLeg {
  double way_m = 0;
  double course_rad = 0;  ///< yaw of its chord
  double across_m = 0;    ///< positions less dead reckoning by the told heading, left of the chord
  double variance_m2 = 0;
};

/// On a leg the crab of a line that is mounted askew looks like a place that drifts, or like ground
/// that falls to one side; on the way back the one is on the same side of the base, and the other
/// two are on the other. Three numbers by least squares, so that one direction alone teaches the
/// first one nothing.
struct Mounting {
  /// Crab (course less told heading, rad), and what is fixed to the map: east and north, as shares
  /// of the way.
  std::array<double, 3> mean{};
  std::array<std::array<double, 3>, 3> covariance{};
  bool begun = false;
  double course_rad = 0;   ///< of the last leg
  double applied_rad = 0;  ///< of the crab: told headings are corrected by it
  /// It is an earlier program's, and somebody may have mounted it anew meanwhile: legs there and
  /// back that fit to it prove it, and one that does not refutes it.
  enum class Recalled : std::uint8_t { no, unproved, one_way, refuted } recalled = Recalled::no;
  double first_course_rad = 0;  ///< of the first leg that fits to it

  double sigma_rad(const EstimateConfig& config) const;
  /// What a heading may be off by: of one that was recalled as much as of one that nobody knows,
  /// until a leg of this program agrees.
  double doubt_rad(const EstimateConfig& config) const;
  bool known(const EstimateConfig& config) const;
  /// And this program has seen it.
  bool proved(const EstimateConfig& config) const {
    return known(config) && recalled == Recalled::no;
  }
  void recall(double crab_rad, double sigma_rad, const EstimateConfig& config);
  /// What is known of the crab and not applied yet, rad. From here on it is. Of one that was
  /// refuted nothing is applied any more.
  double catch_up(const EstimateConfig& config);
};

void learn(Mounting& mounting, const StraightLeg& leg, const EstimateConfig& config);

}  // namespace drover::engine::estimate
