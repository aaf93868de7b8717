// Any bytes into the WitMotion driver: no crash, no absurd value, the same result for any chunking,
// and nothing sent but the commands it may send.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

#include "drivers/witmotion/driver.h"
#include "drivers/witmotion/entry.h"
#include "tests/fuzz/chunking.h"

namespace {

using namespace std::chrono_literals;
using namespace drover;
using fuzz::require;

constexpr std::size_t kMaxInput = 2048;  // 64 measurements and no more
constexpr double kBaud = 115200;
const Time kStart{100s};

bool within(const Vector3& v, double limit) {
  return std::abs(v.x) <= limit && std::abs(v.y) <= limit && std::abs(v.z) <= limit;
}

void check(const Measurement& m) {
  const auto* s = std::get_if<ImuSample>(&m.value);
  require(s != nullptr && m.time <= m.received + 1s);
  // A rotation may bring three full ranges onto one axis.
  require(within(s->acceleration_mps2, 273) && within(s->angular_velocity_radps, 61));
  require(within(s->magnetic_field, 56800));
  const Quaternion& q = s->orientation;
  require(std::abs(q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z - 1) < 1e-9);
}

void check_same(const Measurement& a, const Measurement& b) {
  const auto& s = std::get<ImuSample>(a.value);
  const auto& t = std::get<ImuSample>(b.value);
  require(a.time == b.time && s.saturated == t.saturated);
  require(s.acceleration_mps2.x == t.acceleration_mps2.x);
  require(s.angular_velocity_radps.z == t.angular_velocity_radps.z);
  require(s.orientation.w == t.orientation.w && s.has_orientation == t.has_orientation);
}

void check_commands(std::span<const std::uint8_t> sent) {
  require(sent.size() % 5 == 0);
  for (std::size_t at = 0; at < sent.size(); at += 5) {
    const int address = sent[at + 2];
    require(sent[at] == 0xFF && sent[at + 1] == 0xAA);
    require(address == 0x00 || (address >= 0x02 && address <= 0x04) || address == 0x1F ||
            address == 0x24 || address == 0x27 || address == 0x69);
    require(address != 0x00 || (sent[at + 3] == 0 && sent[at + 4] == 0));
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size < 2 || size > kMaxInput) return 0;
  // The first byte chooses the format and the chunking of the second run.
  const std::uint32_t choice = data[0];
  const std::span<const std::uint8_t> bytes(data + 1, size - 1);
  Options options(kWitmotionEntry.options);
  options.set("mount_yaw_deg", -90.0);
  if (choice % 2 == 1) options.set("protocol", std::string("combined"));
  if (choice % 4 >= 2) options.set("orientation", std::string("quaternion"));
  witmotion::WitmotionDriver whole(options);
  witmotion::WitmotionDriver pieces(options);
  fuzz::check_chunking(whole, pieces, bytes, choice, kStart, kBaud, check, check_same);

  // The same bytes as answers to its questions, over some seconds.
  witmotion::WitmotionDriver asking(options);
  asking.on_link_up(kStart);
  static DriverOut out;
  Time now = kStart;
  for (std::size_t at = 0; at < bytes.size(); at += 33) {
    now += 200ms;
    out.clear();
    asking.on_bytes(bytes.subspan(at, std::min<std::size_t>(33, bytes.size() - at)), now, out);
    asking.on_tick(now, out);
    check_commands({out.bytes.data(), out.bytes.size()});
    require(out.overflows == 0);
  }
  return 0;
}
