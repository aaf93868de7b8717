#include "drivers/hipnuc_can/twin.h"

#include <cmath>

#include "drivers/twin_states.h"
#include "drover/rotation.h"

namespace drover::hipnuc_can {
namespace {

constexpr std::uint8_t kNmtStart = 1;

}  // namespace

HipnucCanTwin::HipnucCanTwin(const Settings& settings, const TwinSettings& own, std::uint64_t seed)
    : settings_(settings), own_(own), noise_(seed) {
  rate_bias_radps_ = noise(own_.rate_bias_sigma_radps);
  acceleration_bias_mps2_ = noise(own_.acceleration_bias_sigma_mps2);
}

Vector3 HipnucCanTwin::noise(double sigma) {
  const double x = sigma * noise_.normal();
  const double y = sigma * noise_.normal();
  return {x, y, sigma * noise_.normal()};
}

void HipnucCanTwin::on_frame(const CanFrame& frame, Time, TwinFrames&) {
  const bool nmt = frame.id == 0 && !frame.extended && frame.len == 2;
  if (!nmt || (frame.data[1] != 0 && frame.data[1] != settings_.address.node)) return;
  if (fault_ != Fault::silent) started_ = frame.data[0] == kNmtStart;
}

void HipnucCanTwin::on_tick(Time now, const ImuTruth& truth, TwinFrames& out) {
  const bool speaks = started_ || settings_.address.dialect == Dialect::j1939;
  if (next_ == kNever) next_ = now;
  for (; next_ <= now; next_ += own_.period)
    if (speaks && fault_ != Fault::silent) say_sample(truth, out);
}

void HipnucCanTwin::say_sample(const ImuTruth& truth, TwinFrames& out) {
  Vector3 wrong_radps = rate_bias_radps_ + noise(own_.rate_sigma_radps);
  wrong_radps.z += fault_bias_radps_;
  const Vector3 wrong_mps2 = acceleration_bias_mps2_ + noise(own_.acceleration_sigma_mps2);
  const Vector3 wrong_rad = noise(own_.attitude_sigma_rad);
  const Quaternion to_sensor = conjugate(settings_.mount);
  Vector3 acceleration_mps2 = rotate(to_sensor, truth.specific_force_mps2 + wrong_mps2);
  Vector3 rates_radps = rotate(to_sensor, truth.angular_velocity_radps + wrong_radps);
  if (fault_ == Fault::saturated) {
    acceleration_mps2.x = settings_.acceleration_range_mps2;
    rates_radps.z = settings_.rate_range_radps;
  }
  // Gravity corrects roll and pitch; nothing corrects the yaw, which counts from its first sample.
  if (std::isnan(first_yaw_rad_)) first_yaw_rad_ = yaw_of(truth.orientation);
  yaw_error_rad_ += wrong_radps.z * to_s(own_.period);
  const Quaternion told = about_z(yaw_error_rad_ - first_yaw_rad_) * truth.orientation *
                          from_angles(wrong_rad.x, wrong_rad.y, 0) * settings_.mount;
  (void)out.push_back(acceleration_frame(settings_.address, acceleration_mps2));
  if (fault_ != Fault::no_rates) (void)out.push_back(rates_frame(settings_.address, rates_radps));
  (void)out.push_back(quaternion_frame(settings_.address, told));
}

bool HipnucCanTwin::set_state(std::string_view name, Time now) {
  if (name == "restart") {
    started_ = false;
    first_yaw_rad_ = kAbsent;
    yaw_error_rad_ = 0;
    next_ = now;
    return true;
  }
  const auto bias = number_after(name, "bias");
  Fault fault = Fault::none;
  if (name == "silent") {
    fault = Fault::silent;
  } else if (name == "no_rates") {
    fault = Fault::no_rates;
  } else if (name == "saturated") {
    fault = Fault::saturated;
  } else if (!name.empty() && !bias) {
    return false;
  }
  fault_ = fault;
  fault_bias_radps_ = to_rad(bias.value_or(0));
  return true;
}

}  // namespace drover::hipnuc_can
