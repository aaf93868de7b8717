// From a recorded track to the line that is driven: latitude and longitude are the truth, x and y
// must fit them.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "drover/path.h"
#include "drover/result.h"
#include "store/derive.h"
#include "store/gears.h"
#include "store/track.h"

namespace drover::store {

/// A point whose x, y are not where its latitude and longitude are.
struct Disagreement {
  std::size_t index = 0;  ///< of the point, from 0
  double distance_m = 0;
  double allowed_m = 0;
};

/// How far x, y and latitude, longitude may be apart, beside what their digits can tell.
inline constexpr double kAgreement_m = 0.05;
/// Numbers coarser than six decimals of a degree are no place to drive to: no more is allowed for.
inline constexpr double kCoarsest_m = 0.25;

/// One unit of the last digit of the track's numbers, m: those of latitude and longitude together
/// with those of x and y. The point with the most digits tells, since zeros at the end are lost.
double resolution_m(const Track& track);

/// The first point that does not fit, in the frame of the origin that the track was saved under:
/// the antenna's place less its arm, turned by the point's yaw or angle, whichever fits better,
/// against x, y. Allowed are kAgreement_m and the resolution; a point without yaw and angle (both
/// 0) may be anywhere within the whole arm. Points without a place (latitude and longitude both 0)
/// and tracks that were saved without an origin have nothing to compare.
std::optional<Disagreement> find_disagreement(const Track& track, const AntennaOffset& antenna);

/// The polyline to drive, in the frame of `origin`, and which way; it shares nothing with the
/// track. Points come from latitude and longitude; from x and y where those are absent, have no
/// angle to take the arm off by, or are coarser than 2 cm. O(points). The failure is a sentence
/// with point (as the operator counts, from 1) and distance.
Result<std::unique_ptr<Path>, std::string> build_path(const Track& track,
                                                      const GeodeticPoint& origin,
                                                      const AntennaOffset& antenna = {},
                                                      TrackDrive drive = TrackDrive::ahead);

}  // namespace drover::store
