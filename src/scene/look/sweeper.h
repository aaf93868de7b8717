// One footprint against all of the surroundings at once.
#pragma once

#include <span>
#include <string>
#include <utility>

#include "drover/fixed_text.h"
#include "scene/look/surroundings.h"
#include "scene/plane/sweep.h"

namespace drover::scene {

/// What ends a way, and whose it is.
struct WayEnd {
  enum class Of : std::uint8_t { object, keep_out, keep_in };
  FreeWay way;
  Of of = Of::object;
};

class Sweeper final {
 public:
  /// Borrows `around`.
  Sweeper(const Surroundings& around, Piece footprint)
      : around_(around),
        footprint_(std::move(footprint)),
        stride_m_(drover::scene::stride_m(footprint_)) {}

  double stride_m() const { return stride_m_; }
  /// Of several at the same place an object before a zone.
  WayEnd sweep(std::span<const Step> steps) const;
  /// "box1", "keep-out field_north", "the fence of yard": of a way that is blocked.
  std::string name(const WayEnd& end) const;

 private:
  const Surroundings& around_;
  Piece footprint_;
  double stride_m_;
};

/// "box1" and "is" for what is known; "lidar" and "sees something" for what is seen: "box1 is in
/// the way of the turn to the left, after 12 deg". `turn_rad` of it are free.
Reason in_the_turn(const std::string& name, const char* is, double turn_rad, bool left);

/// "box1 is in the way, 1.20 m ahead".
Reason in_the_way(const std::string& name, const char* where, double way_m);
/// "box1 is where the robot is, or within its margin".
Reason is_there(const std::string& name);

}  // namespace drover::scene
