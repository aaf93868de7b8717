#include "engine/estimate/local_frame.h"

#include <cmath>

#include "drover/measurement.h"

namespace drover::engine::estimate {
namespace {

constexpr double kHighest_m = 10000;  // the highest place to drive, and well below the deepest

double sane(double altitude_m, double otherwise_m) {
  return std::abs(altitude_m) <= kHighest_m ? altitude_m : otherwise_m;
}

}  // namespace

void LocalFrame::set_origin(const GeodeticPoint& origin) {
  origin_ = origin;
  origin_.altitude_m = sane(origin.altitude_m, 0);
  frame_.Reset(origin_.latitude_deg, origin_.longitude_deg, origin_.altitude_m);
  has_origin_ = true;
}

PathPoint LocalFrame::local(const GeodeticPoint& point) const {
  if (!has_origin_) return {.x_m = kAbsent, .y_m = kAbsent};
  PathPoint local;
  double up_m = 0;
  frame_.Forward(point.latitude_deg, point.longitude_deg,
                 sane(point.altitude_m, origin_.altitude_m), local.x_m, local.y_m, up_m);
  return local;
}

GeodeticPoint LocalFrame::geodetic(const PathPoint& point, double altitude_m) const {
  if (!has_origin_) {
    return {.latitude_deg = kAbsent, .longitude_deg = kAbsent, .altitude_m = kAbsent};
  }
  const double altitude = sane(altitude_m, origin_.altitude_m);
  GeodeticPoint geodetic;
  frame_.Reverse(point.x_m, point.y_m, altitude - origin_.altitude_m, geodetic.latitude_deg,
                 geodetic.longitude_deg, geodetic.altitude_m);
  return geodetic;
}

}  // namespace drover::engine::estimate
