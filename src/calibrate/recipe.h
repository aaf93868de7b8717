// The drive that a calibration needs, piece after piece, as a function of what was driven so far:
// numbers in, the wanted motion out. Pure.
#pragma once

#include <cstddef>
#include <string_view>
#include <vector>

#include "drover/twist.h"

namespace drover::calibrate {

/// Faster is not driven before it is known which way round wheels, gyro and antenna are.
inline constexpr double kUnproved_mps = 0.1;

/// Circles may come to be so many times as wide as they are asked for.
inline constexpr double kWider = 1.4;

/// As they are asked for.
inline constexpr double kCircle_m = 1.2;

/// What the base may do at most.
struct DriveLimits {
  double speed_mps = 0.8;
  double yaw_rate_radps = 0.8;
  double deceleration_mps2 = 0.8;
};

/// What happened since the last look, as the estimate tells it.
struct Moved {
  double dt_s = 0;
  double way_m = 0;     ///< ahead positive
  double turn_rad = 0;  ///< to the left positive
  bool still = false;   ///< nothing moves, and nothing was wanted
};

/// One of: so long at rest; so far straight on, two speeds in turn; so far round.
struct Piece {
  std::string_view what;
  double stand_s = 0;
  double way_m = 0;
  double turn_rad = 0;  ///< to the left positive
  double radius_m = 0;
  double slow_mps = 0;
  double fast_mps = 0;  ///< straight on: in turn with the other; else the same
};

/// Metres from where the robot stands at first, as it stands there; with a metre all around, or as
/// much more as it needs to come to rest by itself.
struct Area {
  double ahead_m = 0;
  double behind_m = 0;
  double left_m = 0;
  double right_m = 0;
};

class Recipe final {
 public:
  explicit Recipe(const DriveLimits& limits);

  /// Counts towards the present piece, and goes on to the next when it is done.
  void look(const Moved& moved);
  /// To be driven now; zero while it is to stand, and when nothing is left.
  Twist wanted() const;

  /// The slow pieces are done: before proved() nothing faster is wanted.
  bool asks_for_signs() const { return !proved_ && at_ == slow_pieces_; }
  void proved() { proved_ = true; }
  /// All pieces are done.
  bool over() const { return at_ >= pieces_.size(); }
  /// Turns round, and drives the fast pieces once more; false: not a fourth time.
  bool again();

  const std::vector<Piece>& pieces() const { return pieces_; }
  std::size_t at() const { return at_; }  ///< the present piece
  /// Of the present piece: s, m or rad, of `of`.
  double done() const;
  double of() const;
  /// What all rounds need that there may be: also where the base turns as wide as an unknown slip
  /// factor lets it.
  Area area() const;

 private:
  void add_round();

  DriveLimits limits_;
  std::vector<Piece> pieces_;
  std::size_t slow_pieces_ = 0;
  int rounds_ = 0;
  std::size_t at_ = 0;
  bool proved_ = false;
  double stood_s_ = 0;
  double rolled_m_ = 0;
  double turned_rad_ = 0;
};

}  // namespace drover::calibrate
