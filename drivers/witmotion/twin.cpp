// Measuring: from the truth, with a sensor's errors, to words.
#include "drivers/witmotion/twin.h"

#include <algorithm>
#include <cmath>

#include "drivers/twin_states.h"
#include "drover/angle.h"
#include "drover/rotation.h"

namespace drover::witmotion {
namespace {

constexpr double kVibration_Hz = 60;
constexpr double kField = 400;  // counts, horizontally; as much again downwards
constexpr double kTemperatureSigma_degC = 0.02;
constexpr std::size_t kLongestCycle = 6 * kFrameSize;

std::int16_t to_word(double share_of_range) {
  return static_cast<std::int16_t>(
      std::clamp(std::round(share_of_range * 32768), -32768.0, 32767.0));
}
Words to_words(const Vector3& v, double range) {
  return {to_word(v.x / range), to_word(v.y / range), to_word(v.z / range)};
}

struct EulerAngles {
  double roll_rad;
  double pitch_rad;
  double yaw_rad;
};
EulerAngles angles_of(const Quaternion& q) {
  return {std::atan2(2 * (q.w * q.x + q.y * q.z), 1 - 2 * (q.x * q.x + q.y * q.y)),
          std::asin(std::clamp(2 * (q.w * q.y - q.z * q.x), -1.0, 1.0)), yaw_of(q)};
}

}  // namespace

WitmotionTwin::WitmotionTwin(const Options& options, std::uint64_t seed)
    : combined_(options.text("protocol") == "combined"),
      to_base_(from_angles(to_rad(options.number("mount_roll_deg")),
                           to_rad(options.number("mount_pitch_deg")),
                           to_rad(options.number("mount_yaw_deg")))),
      rate_sigma_radps_(to_rad(options.number("rate_sigma_dps"))),
      acceleration_sigma_mps2_(options.number("acceleration_sigma_mps2")),
      bias_walk_(to_rad(options.number("bias_walk_dps_per_sqrt_s"))),
      attitude_sigma_rad_(to_rad(options.number("attitude_sigma_deg"))),
      temperature_degC_(options.number("temperature_degC")),
      magnetic_error_rad_(to_rad(options.number("magnetic_error_deg"))),
      active_(options.flag("factory") && !combined_ ? kFactory : wanted_settings(options)),
      saved_(active_),
      noise_(seed) {
  rate_bias_radps_ = noise(to_rad(options.number("bias_sigma_dps")));
  acceleration_bias_mps2_ = noise(options.number("acceleration_bias_sigma_mps2"));
  said_.reserve(1024);
}

std::uint32_t WitmotionTwin::baud() const {
  return baud_of(active_.baud).value_or(9600);
}

double WitmotionTwin::pace_Hz() const {
  return std::isnan(fault_pace_Hz_) ? rate_Hz(active_.rate).value_or(0) : fault_pace_Hz_;
}

Vector3 WitmotionTwin::noise(double sigma) {
  const double x = sigma * noise_.normal();
  const double y = sigma * noise_.normal();
  return {x, y, sigma * noise_.normal()};
}

std::size_t WitmotionTwin::on_tick(Time now, const ImuTruth& truth, std::span<char> out) {
  if (start_ == kNever) start_ = next_cycle_ = last_cycle_ = now;
  const double pace = pace_Hz();
  if (pace <= 0) next_cycle_ = now;  // it is told when to begin again
  while (pace > 0 && next_cycle_ <= now) {
    measure(next_cycle_, truth);
    if (fault_ != Fault::silent && said_.size() + kLongestCycle <= out.size())
      say_cycle(next_cycle_);
    next_cycle_ += from_s(1 / pace);
  }
  if (fault_ == Fault::silent) said_.clear();
  const std::size_t size = std::min(said_.size(), out.size());
  for (std::size_t i = 0; i < size; ++i)
    out[i] = static_cast<char>(fault_ == Fault::garbage ? noise_.bits() & 0x0FU : said_[i]);
  said_.erase(said_.begin(), said_.begin() + static_cast<long>(size));
  return size;
}

void WitmotionTwin::measure(Time now, const ImuTruth& truth) {
  const double elapsed_s = std::max(0.0, to_s(now - last_cycle_));
  last_cycle_ = now;
  rate_bias_radps_ = rate_bias_radps_ + noise(bias_walk_ * std::sqrt(elapsed_s));
  Vector3 bias_radps = rate_bias_radps_;
  bias_radps.z += fault_bias_radps_;
  Vector3 rate_radps = truth.angular_velocity_radps;
  rate_radps = {rate_radps.x * fault_scale_, rate_radps.y * fault_scale_,
                rate_radps.z * fault_scale_};
  rate_radps = rate_radps + bias_radps + noise(rate_sigma_radps_);
  Vector3 force_mps2 =
      truth.specific_force_mps2 + acceleration_bias_mps2_ + noise(acceleration_sigma_mps2_);
  force_mps2.z += vibration_mps2_ * std::sin(2 * kPi * kVibration_Hz * to_s(now - start_));

  // The attitude: gravity corrects roll and pitch, nothing corrects the yaw of six axes.
  const EulerAngles base = angles_of(truth.orientation);
  if (std::isnan(first_yaw_rad_)) first_yaw_rad_ = base.yaw_rad;
  yaw_error_rad_ += (rate_radps.z - truth.angular_velocity_radps.z) * elapsed_s;
  const bool nine_axis = active_.algorithm == static_cast<std::uint16_t>(Algorithm::nine_axis);
  const Vector3 wrong_rad = noise(attitude_sigma_rad_);
  const double yaw_rad = wrap_rad(base.yaw_rad + (nine_axis ? magnetic_error_rad_ + wrong_rad.z
                                                            : yaw_error_rad_ - first_yaw_rad_));
  const Quaternion sensor =
      from_angles(base.roll_rad + wrong_rad.x, base.pitch_rad + wrong_rad.y, yaw_rad) * to_base_;
  const double at_degC = temperature_degC_ + kTemperatureSigma_degC * noise_.normal();
  if (fault_ == Fault::frozen) return;

  const Quaternion to_sensor = conjugate(to_base_);
  readings_.acceleration = to_words(rotate(to_sensor, force_mps2), 16 * kGravity_mps2);
  readings_.rate = to_words(rotate(to_sensor, rate_radps), to_rad(2000));
  const EulerAngles told = angles_of(sensor);
  readings_.angles = to_words({told.roll_rad, told.pitch_rad, told.yaw_rad}, kPi);
  readings_.quaternion = {to_word(sensor.w), to_word(sensor.x), to_word(sensor.y),
                          to_word(sensor.z)};
  // North and down, in the world; the world's x is east.
  const Vector3 field = rotate(to_sensor * conjugate(truth.orientation), {0, kField, -kField});
  readings_.field = to_words(field, 32768);
  readings_.temperature = static_cast<std::int16_t>(std::lround(at_degC * 100));
  if (fault_ == Fault::saturated) readings_.acceleration[0] = readings_.rate[2] = 32767;
}

bool WitmotionTwin::set_state(std::string_view name, Time now) {
  if (name == "restart") {
    active_ = saved_;
    unlocked_until_ = kNever;
    said_.clear();
    next_cycle_ = now;
    first_yaw_rad_ = kAbsent;
    yaw_error_rad_ = 0;
    return true;
  }
  Fault fault = Fault::none;
  double bias_radps = 0;
  double scale = 1;
  double vibration_mps2 = 0;
  double pace = kAbsent;
  if (name == "silent") {
    fault = Fault::silent;
  } else if (name == "frozen") {
    fault = Fault::frozen;
  } else if (name == "saturated") {
    fault = Fault::saturated;
  } else if (name == "garbage") {
    fault = Fault::garbage;
  } else if (const auto bias = number_after(name, "bias")) {
    bias_radps = to_rad(*bias);
  } else if (const auto factor = number_after(name, "scale")) {
    scale = *factor;
  } else if (const auto amplitude = number_after(name, "vibration")) {
    vibration_mps2 = *amplitude;
  } else if (const auto asked = number_after(name, "rate"); asked && *asked >= 0.1) {
    pace = *asked;
  } else if (!name.empty()) {
    return false;
  }
  fault_ = fault;
  fault_bias_radps_ = bias_radps;
  fault_scale_ = scale;
  vibration_mps2_ = vibration_mps2;
  fault_pace_Hz_ = pace;
  next_cycle_ = std::min(next_cycle_, now + from_s(1 / std::max(pace_Hz(), 0.1)));
  return true;
}

}  // namespace drover::witmotion
