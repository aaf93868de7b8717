// Any frames of a bus, any requests and any pauses into the CiA 402 driver: no crash, no number
// that is none, nothing arming or moving that was not asked for, and nothing sent but what its own
// rules allow.
//
// Input: a byte of options (its highest bit: the node answers what it is asked, and so is set up),
// then steps. A step's first byte is its kind (3 bits) and more:
//   0..3  a frame of the node: the upper bits choose its id; flags, length, that many bytes
//   4     a frame of any id: two bytes of id, flags, length, bytes
//   5     requests to run: a float (rad/s) and as many cycles as the upper bits say
//   6     cycles at rest, or idle when the upper bits are odd
//   7     a pause of 5 ms times a byte; then, by the upper bits, the link comes back, and a cycle
//         passes in which nobody decides
#include <cmath>
#include <cstdlib>

#include "drivers/cia402/driver.h"
#include "tests/fuzz/input.h"

namespace {

using namespace std::chrono_literals;
using namespace drover;
using namespace drover::cia402;

constexpr std::size_t kMaxInput = 512;
constexpr int kMaxCycles = 300;  // longer than its set-up and every time-out
constexpr double kMax_rpm = 120;
constexpr double kUnitsPerRps = 600;
constexpr std::uint8_t kRead = 0x40;

void require(bool holds) {
  if (!holds) std::abort();
}

Settings settings_of(std::uint8_t choice) {
  Options options(option_table());
  options.set("max_rpm", kMax_rpm);
  options.set("node", 5.0);
  options.set("velocity_units_per_rps", kUnitsPerRps);
  options.set("reversed", (choice & 1U) != 0);
  options.set("rated_torque_Nm", (choice & 4U) != 0 ? 2.0 : 0.0);
  options.set("gear_ratio", (choice & 2U) != 0 ? 1000.0 : 0.5);
  options.set("arming_timeout_s", 0.3);
  options.set("acceleration", 0.0).set("deceleration", 0.0);
  return read_settings(options);
}

class Bench {
 public:
  explicit Bench(std::uint8_t choice)
      : settings_(settings_of(choice)), driver_(settings_, 0), answers_((choice & 0x80U) != 0) {
    driver_.on_link_up(now_);
  }
  void frame(const CanFrame& frame) {
    driver_.on_frame(frame, now_, out_);
    take();
    now_ += 100us;
  }
  void cycle(const Setpoint& wanted) {
    runs_ = wanted.request == AxisRequest::run;
    driver_.on_setpoints({&wanted, 1}, now_, out_);
    undecided();
  }
  void undecided() {
    driver_.on_tick(now_, out_);
    require(out_.frames.size() <= driver_.messages_per_cycle());
    const auto sent = out_.frames;
    take();
    if (answers_)
      for (const CanFrame& each : sent) answer(each);
    static_cast<void>(driver_.health(now_));
    now_ += 5ms;
  }
  void link_up() { driver_.on_link_up(now_); }
  void pass(Duration time) { now_ += time; }
  std::uint8_t node() const { return settings_.node; }

 private:
  /// As a node that takes everything, and has what was written.
  void answer(const CanFrame& asked) {
    if (asked.id != id_of(Cob::sdo_request, settings_.node) || asked.data[0] == 0x80) return;
    CanFrame reply = asked;
    reply.id = 0x580U + settings_.node;
    if (asked.data[0] == kRead) {
      for (std::size_t i = 4; i < 8; ++i) reply.data[i] = written_.data[i];
      reply.data[0] = 0x43;
    } else {
      written_ = asked;
      reply.data[0] = 0x60;
    }
    frame(reply);
  }
  void take() {
    require(out_.overflows == 0 && out_.bytes.empty() && out_.packets.empty());
    for (const CanFrame& each : out_.frames) check(each);
    for (const Measurement& each : out_.measurements) check(each);
    out_.clear();
  }
  void check(const CanFrame& sent) const {
    bool listed = false;
    for (const FrameRule& rule : driver_.rules())
      listed =
          listed || (rule.id == sent.id && sent.len >= rule.min_len && sent.len <= rule.max_len);
    require(listed && sent.is_plain());
    const Effect effect = driver_.effect(sent, now_);
    require(effect.kind != FrameEffect::forbidden);
    require(effect.kind != FrameEffect::motion || (runs_ && effect.moves != 0));
    if (const auto command = decode_command(sent, settings_.node))
      require(std::abs(command->target) <= kMax_rpm / 60 * kUnitsPerRps);
  }
  void check(const Measurement& m) const {
    if (const auto* motion = std::get_if<AxisMotion>(&m.value)) {
      require(motion->axis == 0 && std::isfinite(motion->velocity_radps));
      require(!std::isinf(motion->position_rad));
    } else {
      const auto& status = std::get<AxisStatus>(m.value);
      require(status.axis == 0);
      require(status.state != AxisState::arming || runs_);
      require(status.state != AxisState::fault || !driver_.words(m).empty());
    }
  }

  Settings settings_;
  Cia402Driver driver_;
  bool answers_;
  bool runs_ = false;
  CanFrame written_;
  DriverOut out_;
  Time now_{100s};
};

constexpr std::uint32_t kIds[] = {0x000, 0x080, 0x180, 0x280, 0x200, 0x580, 0x600, 0x700};

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size < 2 || size > kMaxInput) return 0;
  fuzz::Input input({data + 1, size - 1});
  Bench bench(data[0]);
  int cycles = 0;
  const auto repeat = [&](int times, const Setpoint& wanted) {
    for (int i = 0; i < times && cycles < kMaxCycles; ++i, ++cycles) bench.cycle(wanted);
  };
  while (input.more()) {
    const std::uint8_t step = input.byte();
    const std::uint8_t upper = step >> 3U;
    switch (step & 7U) {
      case 4: {
        const std::uint32_t id = input.word();
        bench.frame(fuzz::read_frame(input, id));
        break;
      }
      case 5: {
        const auto velocity_radps = static_cast<double>(input.real());
        repeat(4 * upper + 1, {AxisRequest::run, velocity_radps});
        break;
      }
      case 6: {
        repeat(8 * upper + 1, {(upper & 1U) != 0 ? AxisRequest::idle : AxisRequest::rest, 1});
        break;
      }
      case 7:
        bench.pass(5ms * input.byte());
        if ((upper & 1U) != 0) bench.link_up();
        if ((upper & 2U) != 0) bench.undecided();
        break;
      default: {
        const std::uint32_t base = kIds[upper % std::size(kIds)];
        bench.frame(fuzz::read_frame(input, base == 0 ? 0 : base + bench.node()));
        break;
      }
    }
  }
  return 0;
}
