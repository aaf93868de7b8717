// A motor that turns as it should and takes nothing along: its wheel is loose on the shaft. Pure.
#pragma once

#include "drivers/robomaster_c620/settings.h"

namespace drover::robomaster {

/// What a motor tells of a moment.
struct Load {
  double velocity_radps = 0;
  double effort_Nm = 0;
};

/// Such a motor has the effort of its own friction, whatever the robot does. A wheel that carries
/// little has as little, too, for a while: but it changes when what the others carry changes, and
/// is braked by them as often as not.
class LooseWatch final {
 public:
  /// `friction_Nm`: with which a wheel goes on turning.
  explicit LooseWatch(double friction_Nm) : friction_Nm_(friction_Nm) {}

  void step(const std::array<Load, kMotors>& loads, Duration dt);
  bool is_loose(std::size_t channel) const;
  /// Somebody looked after it, or says so.
  void begin_anew() { wheels_ = {}; }

 private:
  struct Wheel {
    double along_Nm = 0;  ///< the way it turns; a mean
    double free_s = 0;    ///< with its own friction, while another one pulls
    double least_Nm = 0;  ///< of the one that pulled most meanwhile
    double most_Nm = 0;
  };
  void judge(std::size_t channel, const Load& load, double dt_s);

  double friction_Nm_;
  std::array<Wheel, kMotors> wheels_{};
};

}  // namespace drover::robomaster
