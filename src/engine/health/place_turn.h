// A turn by the wheels beside where the antenna goes: the one witness of a robot that has one
// antenna and no gyro.
#pragma once

#include <cstdint>

#include "drover/path.h"
#include "engine/config.h"

namespace drover::engine {

/// Since the motion began; left is that of that moment.
struct WheelsWay {
  double left_m = 0;  ///< where the base is
  double turn_rad = 0;
};

/// Which way a robot turned is seen behind the turn only: by how far aside it went. Places are
/// compared with those of a robot that turns as its wheels say, and of one that turns the other
/// way.
class PlaceTurn final {
 public:
  enum class Verdict : std::uint8_t {
    open,     ///< it has not turned enough, or not gone far enough behind it
    right,    ///< it turned as the wheels say
    against,  ///< the other way
    not_at_all
  };

  void begin();
  /// The antenna went so since the motion began, known as well as `sigma_m`.
  void look(const WheelsWay& wheels, const PathPoint& antenna_went, const AntennaConfig& antenna,
            double sigma_m);
  Verdict verdict() const { return verdict_; }
  /// By how much it turned as far as the last place shows, as the wheels count it.
  double turned_rad() const { return turned_rad_; }
  double wheels_rad() const { return wheels_rad_; }

 private:
  void count(Verdict what, bool clear);

  Verdict verdict_ = Verdict::open;
  Verdict last_ = Verdict::open;  ///< by the last place alone
  double turned_rad_ = 0;
  double wheels_rad_ = 0;
};

}  // namespace drover::engine
