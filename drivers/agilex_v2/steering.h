// How a Hunter's wheels are steered: it is told the angle of the inner one.
#pragma once

namespace drover::agilex_v2 {

struct Steering {
  double wheelbase_m = 0.65;
  double track_m = 0.605;   ///< between the steered wheels
  double most_rad = 0.576;  ///< of the inner wheel

  /// Of the curve that the middle of the rear axle goes; left positive, as the angle.
  double radpm(double inner_rad) const;
  /// Back; of a tighter curve than it can drive the most.
  double inner_rad(double radpm) const;
  /// Of a wheel between both.
  double middle_rad(double inner_rad) const;
};

}  // namespace drover::agilex_v2
