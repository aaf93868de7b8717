#include "sim/robot/scanner.h"

#include <cmath>

#include "drover/angle.h"

namespace drover::sim {

Scanner::Scanner(const ScannerSpec& spec, std::unique_ptr<ScannerTwin> twin)
    : spec_(spec), twin_(std::move(twin)) {}

void Scanner::step(Time now, const Plant& plant) {
  const Plant::Vector place{spec_.x_m, spec_.y_m, spec_.z_m};
  const double yaw_rad = to_rad(spec_.yaw_deg);
  const auto range_m = [&](double bearing_rad) {
    const double angle_rad = yaw_rad + bearing_rad;
    return plant.ray_m(place, {std::cos(angle_rad), std::sin(angle_rad), 0}, spec_.reach_m)
        .value_or(0);
  };
  size_ = twin_->on_tick(now, range_m, bytes_);
}

bool Scanner::command(std::string_view state, Time now) {
  return !state.empty() && twin_->set_state(state == "normal" ? "" : state, now);
}

}  // namespace drover::sim
