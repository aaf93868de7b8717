// What a beam meets that begins on the robot: terrain, obstacles, anything but the robot itself.
#include <array>
#include <cmath>

#include "sim/plant/plant_impl.h"

namespace drover::sim {
namespace {

/// So far behind what was the robot itself a ray goes on.
constexpr double kStep_m = 1e-4;
/// A ray meets the robot's own surfaces so often at most.
constexpr int kMostOwn = 16;

}  // namespace

std::optional<double> Plant::ray_m(const Vector& from_m, const Vector& along,
                                   double reach_m) const {
  const mjModel& m = *impl_->model;
  const mjData& d = *impl_->data;
  const mjtNum* rotation = impl_->rotation();
  const std::array<mjtNum, 3> place{from_m.x, from_m.y, from_m.z};
  const std::array<mjtNum, 3> towards{along.x, along.y, along.z};
  std::array<mjtNum, 3> at{};
  std::array<mjtNum, 3> way{};
  mju_rotVecMat(at.data(), place.data(), rotation);
  mju_addTo3(at.data(), d.xpos + 3 * impl_->base);
  mju_rotVecMat(way.data(), towards.data(), rotation);
  if (!(mju_normalize3(way.data()) > 0)) return std::nullopt;
  double gone_m = 0;
  for (int own = 0; own <= kMostOwn; ++own) {
    int geom = -1;
    const mjtNum range = mj_ray(&m, &d, at.data(), way.data(), nullptr, 1, impl_->base, &geom);
    if (range < 0 || gone_m + range > reach_m) return std::nullopt;
    // The base's own geoms were left out, but not those of its wheels.
    if (m.body_rootid[m.geom_bodyid[geom]] != impl_->base) return gone_m + range;
    mju_addToScl3(at.data(), way.data(), range + kStep_m);
    gone_m += range + kStep_m;
  }
  return std::nullopt;
}

}  // namespace drover::sim
