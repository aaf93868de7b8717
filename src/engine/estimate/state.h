// Everything the estimate knows at one instant; the history keeps one per measurement, so that a
// late one can be put where it belongs. All that steers the filter is in here, none beside it.
#pragma once

#include <cstdint>

#include "drover/measurement.h"
#include "drover/time.h"
#include "engine/base/kinematics.h"
#include "engine/estimate/antenna_fit.h"
#include "engine/estimate/course.h"
#include "engine/estimate/dispute.h"
#include "engine/estimate/filter.h"
#include "engine/estimate/gyro_track.h"
#include "engine/estimate/heading_late.h"
#include "engine/estimate/jump_watch.h"
#include "engine/estimate/motion_watch.h"
#include "engine/estimate/mounting.h"
#include "engine/estimate/reach.h"
#include "engine/estimate/shove.h"
#include "engine/estimate/unseen_way.h"

namespace drover::engine::estimate {

/// Qualities that share a kind of error; when the class changes, the old error says nothing of the
/// new one.
enum class GnssClass : std::uint8_t { none, fixed, floating, dgps, single };

/// The way since the place was the receiver's: an error of the heading bends it.
struct Reckoned {
  double east_m = 0;
  double north_m = 0;
};

/// A receiver that told a heading so lately tells the next one soon.
inline constexpr Duration kHeadingTold = std::chrono::seconds(2);

struct GnssTrack {
  std::uint8_t receiver = 0;  ///< whose positions these are
  GnssClass quality = GnssClass::none;
  bool told_sigma = false;  ///< by the receiver, in GST
  double sigma_x_m = 0;     ///< of the class, or of GST when that is larger
  double sigma_y_m = 0;
  Time improved = kNever;  ///< when the quality last became better
  double old_sigma_m = 0;  ///< what it was before
  JumpWatch jumps;
  double place_x_m = 0;  ///< the refused place that must repeat
  double place_y_m = 0;
  double contradiction_m = 0;  ///< how far the last refused position was off
  Dispute dispute;
  // How well the place was known when the positions of the dispute began to keep their distance:
  double disputed_xx_m2 = 0;
  double disputed_yy_m2 = 0;
  UnseenWay disputed_unseen;
  Reckoned disputed_reckoned;
  // The last believed position, and how far beside the estimate it was left:
  Time believed = kNever;
  double beside_x_m = 0;
  double beside_y_m = 0;
  // Where its antenna was taken to be, ahead of base_link and to the left; guessed: the sensor of
  // the tilt was silent. And how far the place may be off by such guesses, as a sigma, m.
  LeverArm arm;
  bool arm_guessed = false;
  double guessed_m = 0;
  Time fixed = kNever;       ///< the last believed RTK fix
  Time heard = kNever;       ///< the last one, believed or not
  Time found = kNever;       ///< when there was one again after a while without
  Time renewed = kNever;     ///< of two places the new one was believed then
  double unconfirmed_m = 0;  ///< and so far away is the other one, until another fix is there
  /// There, where that is known; and how well it is, two sigma.
  Dispute::Offset unbelieved;
  double unbelieved_m = 0;
  // A place that jumped while the base stood was believed then, so far from where it had been:
  Time replaced = kNever;
  double replaced_m = 0;
  double corrected_way_m = 0;  ///< since a position corrected the place
};

struct HeadingTrack {
  std::uint8_t receiver = 0;  ///< whose headings these are
  Time last = kNever;
  JumpWatch jumps;
  double place_rad = 0;
  double contradiction_rad = 0;  ///< how far the last refused heading was off
};

/// A robot that has been turned by more than this without being seen has no heading any more: the
/// filter's straight-line approximations end here.
inline constexpr double kLostYaw_rad = 0.5;

struct State {
  Time time = kNever;
  bool has_position = false;
  bool has_heading = false;
  Belief belief;
  Told told;
  Time standing_since = kNever;  ///< kNever while the base moves or may move
  GnssTrack gnss;
  HeadingTrack heading;
  Mounting mounting;  ///< of the line of that receiver's antennas
  Reckoned reckoned;
  UnseenWay unseen;
  bool way_unknown = false;  ///< since the last believed fix: wheels silent, or somebody pushed it
  GyroTrack gyro;
  AntennaFit fit;
  double late_s = 0;  ///< of positions: what was learned of it and is applied
  HeadingLate heading_late;
  Shove shove;
  MotionWatch watch;
  Course course;

  /// Of the mounting, as long as the heading is a receiver's.
  double mount_sigma_rad(const EstimateConfig& config) const {
    return heading.last == kNever ? 0.0 : mounting.doubt_rad(config);
  }
  /// What was learned of it and is not made up for yet.
  double mount_left_rad() const {
    return heading.last == kNever ? 0.0 : mounting.mean[0] - mounting.applied_rad;
  }
  /// What both and the belief make the heading, and the way since the last fix, uncertain by.
  HeadingDoubt doubt(const EstimateConfig& config) const {
    return {mount_sigma_rad(config), reckoned.east_m, reckoned.north_m};
  }
  std::uint32_t refused = 0;  ///< by the gates, since the start
  std::uint32_t broken = 0;   ///< times the filter lost its numbers and was started again
};

}  // namespace drover::engine::estimate
