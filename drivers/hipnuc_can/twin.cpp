#include "drivers/hipnuc_can/twin.h"

#include "drivers/rotation.h"

namespace drover::hipnuc_can {
namespace {

constexpr Duration kPeriod = std::chrono::milliseconds(10);
constexpr std::uint8_t kNmtStart = 1;

}  // namespace

void HipnucCanTwin::on_frame(const CanFrame& frame) {
  const bool nmt = frame.id == 0 && !frame.extended && frame.len == 2;
  if (!nmt || (frame.data[1] != 0 && frame.data[1] != settings_.address.node)) return;
  started_ = frame.data[0] == kNmtStart;
}

void HipnucCanTwin::on_tick(Time now, const ImuTruth& truth, TwinFrames& out) {
  const bool speaks = started_ || settings_.address.dialect == Dialect::j1939;
  if (silent_ || !speaks || now < next_) return;
  next_ = now + kPeriod;
  const Quaternion to_sensor = conjugate(settings_.mount);
  const Vector3 acceleration_mps2 = rotate(to_sensor, truth.specific_force_mps2);
  const Vector3 rates_radps = rotate(to_sensor, truth.angular_velocity_radps);
  (void)out.push_back(acceleration_frame(settings_.address, acceleration_mps2));
  if (!no_rates_) (void)out.push_back(rates_frame(settings_.address, rates_radps));
  (void)out.push_back(quaternion_frame(settings_.address, truth.orientation * settings_.mount));
}

bool HipnucCanTwin::set_state(std::string_view name) {
  if (name != "silent" && name != "no_rates" && !name.empty()) return false;
  silent_ = name == "silent";
  no_rates_ = name == "no_rates";
  return true;
}

}  // namespace drover::hipnuc_can
