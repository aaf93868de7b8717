// A HiPNUC sensor's driver under any frames: what it tells is a number.
#include <cmath>
#include <cstdlib>

#include "drivers/hipnuc_can/driver.h"
#include "tests/fuzz/input.h"

namespace drover {
namespace {

constexpr std::array<std::uint32_t, 6> kIds{0x0CFF3408, 0x0CFF3708, 0x0CFF4608,
                                            0x0CFF4308, 0x188,      0x288};

bool finite(const Vector3& v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

void judge(const DriverOut& out) {
  if (!out.frames.empty() || !out.bytes.empty() || out.overflows != 0) std::abort();
  for (const Measurement& each : out.measurements) {
    const auto& sample = std::get<ImuSample>(each.value);
    const Quaternion& q = sample.orientation;
    const double length = std::sqrt(q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z);
    if (!finite(sample.acceleration_mps2) || !finite(sample.angular_velocity_radps)) std::abort();
    if (std::abs(length - 1) > 1e-6 || each.time > each.received) std::abort();
  }
}

}  // namespace
}  // namespace drover

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace drover;
  fuzz::Input input({data, size});
  hipnuc_can::Settings settings;
  if (input.byte() % 2 == 1) settings.address.dialect = hipnuc_can::Dialect::canopen;
  hipnuc_can::HipnucCanDriver driver(settings);
  Time now{std::chrono::seconds(1)};
  DriverOut out;
  while (input.more()) {
    out.clear();
    now += std::chrono::milliseconds(input.byte() % 16);
    driver.on_frame(fuzz::read_frame(input, kIds[input.byte() % kIds.size()]), now, out);
    judge(out);
    (void)driver.health(now);
  }
  return 0;
}
