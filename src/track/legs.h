// A route from one true corner to the next: where it turns so sharply that a robot turns there on
// the spot.
#pragma once

#include <cstddef>

#include "track/path_geometry.h"

namespace drover::track {

/// Chords of this length tell the direction in which a leg begins and ends.
inline constexpr double kEndChord_m = 0.25;
/// A turn by more is a cusp: who does not turn round there drives on the other way.
inline constexpr double kCusp_rad = 2.1;  // 120 degrees
/// Of points tested for corners, where points are dense.
inline constexpr double kTestSpacing_m = 0.02;

/// From a point to the target at `end_m`, as long as no corner on the way is known.
Leg leg_to_target(const Route& route, std::size_t first, double first_m, double end_m);
/// The same leg, once its corner is.
Leg leg_to_corner(const Route& route, const Leg& leg, const Station& corner);

/// The robot drives backwards on the leg: as the route tells a little after its beginning, which
/// may lie beside the point where that changes.
bool is_backwards(const Route& route, const Leg& leg);

/// How far a route was looked along for corners.
struct CornerScan {
  Station known;        ///< corners are known up to here
  double tested_m = 0;  ///< of the last point tested
};

/// Looks on, up to `until_m`, for the first point after the leg's beginning where the route turns
/// by more than `sharp_rad`; of points close together it is the sharpest. A short step back (up to
/// 0.3 m), after which the route goes on as before, is none: whoever recorded it rolled back a
/// little, and a robot that drives ahead only would turn round twice for it. Segment 0: there is
/// none.
Station find_corner(const Route& route, const Leg& leg, double sharp_rad, double until_m,
                    CornerScan& scan);

/// All legs of a route in their order, from its first point to its target at `end_m`.
template <class Visit>
void each_leg(const Route& route, double sharp_rad, double end_m, const Visit& visit) {
  Leg leg = leg_to_target(route, 0, 0, end_m);
  CornerScan scan;
  for (Station corner = find_corner(route, leg, sharp_rad, end_m, scan); corner.segment != 0;
       corner = find_corner(route, leg, sharp_rad, end_m, scan)) {
    visit(leg_to_corner(route, leg, corner));
    leg = leg_to_target(route, corner.segment, corner.start_m, end_m);
  }
  visit(leg);
}

}  // namespace drover::track
