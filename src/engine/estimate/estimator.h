// Position, heading and velocity of the base, with covariance, from wheels and GNSS.
//
// Measurements are applied at their own time: a short history of states is kept, a late measurement
// goes in where it belongs and what came after is applied again. Fixed size, no allocation.
#pragma once

#include "drover/measurement.h"
#include "drover/path.h"
#include "drover/snapshot.h"
#include "engine/config.h"

namespace drover::engine {

struct Estimate {
  bool has_position = false;
  bool has_heading = false;
  Pose pose;                    ///< predicted to the asked time
  double predicted_error_m = kAbsent;  ///< two sigma of the larger horizontal axis
  double yaw_error_rad = kAbsent;      ///< two sigma
  double left_mps = 0;          ///< mean rim speed of the left wheels
  double right_mps = 0;
  double yaw_slip_factor = 1.0; ///< as refined
  Reason reason;                ///< why it is not good ("position disagrees with odometry"), or empty
  bool disagrees = false;       ///< GNSS and odometry contradict each other beyond the gate
};

class Estimator final {
 public:
  Estimator(const EstimateConfig& config, const BaseConfig& base);

  /// Takes an origin; the state is forgotten and found again from the next measurements.
  void set_origin(const GeodeticPoint& origin);
  bool has_origin() const;
  const GeodeticPoint& origin() const;
  /// Position of the antenna for a pose of base_link, degrees (for rtk.latitude/longitude).
  GeodeticPoint antenna_geodetic(const Pose& pose) const;
  /// base_link position in the map frame of a geodetic point (for tracks).
  PathPoint local(const GeodeticPoint& point) const;

  void on_measurement(const Measurement& measurement);  ///< others than wheels/GNSS are ignored
  /// Advances to `now` (monotonic) and returns the state there.
  const Estimate& step(Time now);

 private:
  struct Impl;  // see estimator.cpp
  // The implementer decides: members directly here, fixed size. (A pimpl is allocated once at start.)
};

}  // namespace drover::engine
