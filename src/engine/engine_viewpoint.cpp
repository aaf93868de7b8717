// What somebody who looks around has to know of the robot, at the end of each cycle.
#include <algorithm>

#include "engine/engine_impl.h"

namespace drover::engine {

void Engine::Impl::fill_viewpoint() {
  view.t = estimate.pose.time;
  view.pose = estimate.pose;
  // The estimate goes on with a base that stands; what was seen must not be kept as if it did.
  if (!estimate.body.known) view.pose.vx_mps = view.pose.wz_radps = view.pose.vy_mps = kAbsent;
  // Where the receiver contradicts the wheels, that counts too: a place that stands still while the
  // wheels turn may be a receiver that is stuck, and is none once it is told as that.
  view.pose.position_sigma_m = estimate.has_position && (!estimate.disagrees || estimate.disputed)
                                   ? std::max(estimate.predicted_error_m, estimate.slipped_m) / 2
                                   : kAbsent;
  view.place = place_count.number();
  view.origin_set = estimator.has_origin();
  if (view.origin_set) view.origin = estimator.origin();
  view.commanded = commanded;
  view.asked = asked;
  view.way = navigator.way();
  view.owner = snapshot.nav.owner;
  const bool level_known = imu_trusted();
  view.roll_rad = level_known ? estimate.roll_rad : kAbsent;
  view.pitch_rad = level_known ? estimate.pitch_rad : kAbsent;
  view.joint_rad.resize(snapshot.axes.size());
  for (std::size_t i = 0; i < snapshot.axes.size(); ++i)
    view.joint_rad[i] = snapshot.axes[i].motion.position_rad;
}

const Viewpoint& Engine::viewpoint() const {
  return impl_->view;
}

}  // namespace drover::engine
