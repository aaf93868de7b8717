// Any bytes of a line, any frames of a bus, any requests and any pauses into the GT01 drivers: no
// crash, no number that is none, nothing moving that was not asked for, and nothing sent but zeros
// and twists within the limits.
//
// Input: a byte of options (its highest bit: on CAN), then steps. A step's first byte is its kind
// (2 bits) and more:
//   0  as many bytes of the line as the upper bits say; on CAN a frame: id, flags, length, bytes
//   1  a request to run: two floats (m/s, rad/s), and as many cycles as the upper bits say
//   2  cycles at rest, or idle when the upper bits are odd
//   3  a pause of 5 ms times a byte; when the upper bits are odd the link comes back
#include <array>
#include <cmath>
#include <cstdlib>

#include "drivers/gt01/can/driver.h"
#include "drivers/gt01/serial/driver.h"
#include "tests/fuzz/input.h"

namespace {

using namespace std::chrono_literals;
using namespace drover;

constexpr std::size_t kMaxInput = 512;
constexpr int kMaxCycles = 300;
constexpr double kMax_mps = 0.8;
constexpr double kMax_radps = 1.1;

void require(bool holds) {
  if (!holds) std::abort();
}

gt01::Settings settings_of(std::uint8_t choice, std::span<const OptionSpec> specs) {
  Options options(specs);
  options.set("max_speed_mps", kMax_mps).set("max_turn_radps", kMax_radps);
  options.set("speed_scale", (choice & 1U) != 0 ? 2.0 : 1.0);
  options.set("zero_holds", (choice & 2U) != 0);
  return gt01::read_settings(options, specs);
}

Made make(std::uint8_t choice) {
  const auto layout =
      (choice & 4U) != 0 ? gt01::can::TwistLayout::table : gt01::can::TwistLayout::example;
  if ((choice & 0x80U) != 0)
    return make_device<gt01::can::Gt01CanDriver>(settings_of(choice, gt01::can::option_table()),
                                                 layout, AxisId{0});
  return make_device<gt01::serial::Gt01SerialDriver>(
      settings_of(choice, gt01::serial::option_table()), AxisId{0});
}

class Bench {
 public:
  explicit Bench(std::uint8_t choice) : made_(make(choice)) { made_.device->on_link_up(now_); }

  bool on_can() const { return made_.frames != nullptr; }
  void hear(const CanFrame& frame) {
    made_.frames->on_frame(frame, now_, out_);
    take();
    now_ += 100us;
  }
  void hear(std::span<const std::uint8_t> bytes) {
    made_.bytes->on_bytes(bytes, now_, out_);
    take();
    now_ += 1ms;
  }
  void cycle(AxisRequest request, const Twist& twist) {
    runs_ = request == AxisRequest::run;
    const Setpoint wanted{request, 0, twist};
    made_.actuator->on_setpoints({&wanted, 1}, now_, out_);
    made_.device->on_tick(now_, out_);
    require(out_.frames.size() + out_.packets.size() <= made_.actuator->messages_per_cycle());
    take();
    static_cast<void>(made_.device->health(now_));
    now_ += 5ms;
  }
  void link_up() { made_.device->on_link_up(now_); }
  void pass(Duration time) { now_ += time; }

 private:
  void take() {
    require(out_.overflows == 0 && out_.bytes.empty() && out_.reopen_baud == 0);
    for (const CanFrame& each : out_.frames) check(each);
    for (const Packet& each : out_.packets) check(each);
    for (const Measurement& each : out_.measurements) check(each);
    out_.clear();
  }
  void check(const Message& sent) const {
    const Effect effect = made_.actuator->effect(sent, now_);
    require(effect.kind == FrameEffect::stop || (effect.kind == FrameEffect::motion && runs_));
    const Twist asked = made_.actuator->setpoint_twist(sent, 0);
    require(std::abs(asked.vx_mps) <= kMax_mps * (1 + 1e-6));
    require(std::abs(asked.wz_radps) <= kMax_radps * (1 + 1e-6));
  }
  void check(const Measurement& m) const {
    if (const auto* motion = std::get_if<BodyMotion>(&m.value)) {
      require(std::isfinite(motion->twist.vx_mps) && std::isfinite(motion->twist.wz_radps));
      require(motion->vx_var > 0 && motion->wz_var > 0);
    } else if (const auto* status = std::get_if<AxisStatus>(&m.value)) {
      require(status->axis == 0);
      require(status->state != AxisState::fault || !made_.device->words(m).empty());
    } else {
      require(std::get<AxisSupply>(m.value).bus_V >= 0);
    }
  }

  Made made_;
  bool runs_ = false;
  DriverOut out_;
  Time now_{100s};
};

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size < 2 || size > kMaxInput) return 0;
  fuzz::Input input({data + 1, size - 1});
  Bench bench(data[0]);
  int cycles = 0;
  const auto repeat = [&](int times, AxisRequest request, const Twist& twist) {
    for (int i = 0; i < times && cycles < kMaxCycles; ++i, ++cycles) bench.cycle(request, twist);
  };
  while (input.more()) {
    const std::uint8_t step = input.byte();
    const std::uint8_t upper = step >> 2U;
    switch (step & 3U) {
      case 0: {
        if (bench.on_can()) {
          const std::uint32_t id = input.byte();
          bench.hear(fuzz::read_frame(input, id));
          break;
        }
        std::array<std::uint8_t, 64> bytes{};
        for (std::uint8_t i = 0; i < upper; ++i) bytes[i] = input.byte();
        bench.hear({bytes.data(), upper});
        break;
      }
      case 1: {
        const auto speed_mps = static_cast<double>(input.real());
        const auto turn_radps = static_cast<double>(input.real());
        repeat(2 * upper + 1, AxisRequest::run, {speed_mps, turn_radps});
        break;
      }
      case 2:
        repeat(4 * upper + 1, (upper & 1U) != 0 ? AxisRequest::idle : AxisRequest::rest, {1, 1});
        break;
      default:
        bench.pass(5ms * input.byte());
        if ((upper & 1U) != 0) bench.link_up();
        break;
    }
  }
  return 0;
}
