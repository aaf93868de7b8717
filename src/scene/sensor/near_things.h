// What scanners saw close to the robot, kept while it moves: what was beside it a moment ago may be
// where no scanner sees now, and it turns through there.
#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <tuple>
#include <vector>

#include "drover/driver.h"
#include "drover/fixed_text.h"
#include "drover/scan.h"
#include "drover/time.h"
#include "scene/plane/piece.h"
#include "scene/sensor/own_way.h"

namespace drover::scene::sensor {

/// A whole turn of one scanner.
struct SeenTurn {
  Name device;
  ScanMount mount;
  Scan scan;  ///< its `begin` is kNever: there was none
};

/// A point that was seen.
struct SeenPoint {
  Point2 at;  ///< in base_link, now
  Time seen = kNever;
  std::uint8_t scanner = 0;
};

struct NearSettings {
  /// Its outline, in base_link. What is inside is the robot itself.
  std::vector<Point2> footprint;
  double within_m = 2;  ///< of base_link, to be kept
  /// Who was not seen again is there so long.
  Duration kept = std::chrono::seconds(130);
};

/// Points are taken with the motion during the turn taken out, and go only when the scanner that
/// saw them sees their place again, when the robot drove over it, when they are far or old, or when
/// nobody knows how it moved. "Sees their place again": beams on both sides of it and at it go as
/// far, or farther; then what they meet there now stands for it.
class NearThings final {
 public:
  explicit NearThings(NearSettings settings);

  /// Once for each turn; one that it had already changes nothing.
  void see(std::uint8_t scanner, const SeenTurn& turn, const OwnWay& way);
  /// All that is kept, from where the robot is now. Nothing when nobody knows how it moved.
  std::vector<SeenPoint> all(const OwnWay& way) const;
  /// Of the newest turn that a scanner has; kNever: it has none.
  Time newest(std::uint8_t scanner) const;

 private:
  struct Kept {
    Point2 at;  ///< in the frame of the robot's own way
    Time seen = kNever;
  };
  /// Of the robot's own way, with the scanner: different heights see different things.
  using Cell = std::tuple<std::uint8_t, std::int32_t, std::int32_t>;

  bool is_beyond(Point2 at) const;

  NearSettings settings_;
  Piece body_;
  std::map<Cell, Kept> kept_;
  std::map<std::uint8_t, Time> turns_;  ///< when the newest one of each began
  std::uint32_t frame_ = 0;
};

/// Of a convex outline, negative outside.
double depth_m(const Piece& outline, Point2 point);

}  // namespace drover::scene::sensor
