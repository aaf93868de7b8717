// Two common path followers, to have something to compare the tracker with. Written from what is
// published of them:
//  - pure pursuit: R. C. Coulter, "Implementation of the Pure Pursuit Path Tracking Algorithm",
//    CMU-RI-TR-92-01; the look-ahead may grow with speed, as is usual since.
//  - regulated pure pursuit: S. Macenski et al., "Regulated Pure Pursuit for Robot Path Tracking",
//    2023, and the documentation of Nav2's controller: look-ahead by speed, slower in bends sharper
//    than a radius and near the end, and a turn on the spot towards a carrot that is far aside.
// Kindnesses that the papers do not have: the rate of turn goes with the speed that there is and
// not with the one that is asked for, the line goes on straight beyond its end, and near the end
// both brake as hard as the gate permits, with the same share of it as Drover.
#pragma once

#include <cstddef>

#include "drover/path.h"
#include "drover/snapshot.h"
#include "engine/config.h"
#include "support/track_drive.h"

namespace drover::bench {

struct PursuitConfig {
  double lookahead_s = 1.0;
  double min_lookahead_m = 0.3;
  double max_lookahead_m = 2.0;
  // Regulated only; as Nav2 has them.
  bool regulated = false;
  double slow_radius_m = 0.9;
  double slowest_mps = 0.25;  ///< in bends
  double approach_m = 0.6;
  double slowest_approach_mps = 0.05;
  double rotate_angle_rad = 0.785;
  double rotate_radps = 1.8;
};

/// Drives from the first point to the last.
class Pursuit final {
 public:
  Pursuit(const PursuitConfig& config, const engine::LimitsConfig& limits, double braking_fraction,
          const Path& path, double speed_mps);
  test::Steered steer(const Pose& pose);

 private:
  struct Place {
    std::size_t segment = 0;
    double along_m = 0;
  };
  double segment_m(std::size_t k) const;
  track::Vector at(const Place& place) const;
  void move_on(track::Vector robot);
  track::Vector carrot(track::Vector robot, double lookahead_m) const;
  double left_m() const;

  PursuitConfig config_;
  engine::LimitsConfig limits_;
  double braking_mps2_;
  const Path& path_;
  double speed_mps_;
  double length_m_ = 0;
  double passed_m_ = 0;  ///< of the segments before the place
  Place place_;          ///< nearest to the robot
};

}  // namespace drover::bench
