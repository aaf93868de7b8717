// A device that takes a twist beside its twin, on whichever wire it hangs.
#pragma once

#include <cmath>
#include <optional>
#include <set>
#include <span>
#include <variant>

#include "unit/drivers/conformance/harness.h"

namespace drover::test {

/// What left.
using Sent = std::variant<CanFrame, Packet>;
inline Message message_of(const Sent& sent) {
  return std::visit([](const auto& each) { return Message(each); }, sent);
}
inline std::string text_of(const Sent& sent) {
  std::string text;
  for (const std::uint8_t byte : message_of(sent).payload()) text += std::to_string(byte) + " ";
  return text;
}

/// 5 ms ticks; its shafts have inertia and friction, and know nothing of each other.
class TwistBench {
 public:
  explicit TwistBench(const Subject& subject)
      : entry(*subject.entry),
        made(made_of(entry, subject.options)),
        device(made.device.get()),
        actuator(made.actuator) {
    if (const auto* make = std::get_if<MakeCanTwin>(&entry.make_twin))
      can = (*make)(subject.options);
    else
      serial = std::get<MakeByteDriveTwin>(entry.make_twin)(subject.options);
    shafts.resize(shafts_of(entry));
    device->on_link_up(now);
  }

  void run(Duration time, AxisRequest request, const Twist& twist = {}) {
    for (const Time end = now + time; now < end;) step({request, 0, twist});
  }

  void step(const Setpoint& command) {
    for (int i = 0; i < 2; ++i) {
      now += std::chrono::microseconds(2500);
      turn();
    }
    if (!driver_alive) return;
    out.clear();
    AllocationCounter counter;
    actuator->on_setpoints({&command, 1}, now, out);
    device->on_tick(now, out);
    allocations += counter.count();
    most = std::max(most, out.frames.size() + out.packets.size());
    const bool moving = arms_it(command.request);
    take(moving);
  }

  FrameEffect effect_of(const Sent& one) const {
    return actuator->effect(message_of(one), now).kind;
  }
  /// Straight to the twin, as the guard does.
  void send(const Sent& one) {
    if (const auto* frame = std::get_if<CanFrame>(&one)) {
      frames.clear();
      if (can) can->on_frame(*frame, now, frames);
      hear_frames();
    } else if (serial) {
      serial->on_bytes(std::get<Packet>(one), now);
    }
  }
  void set_power(bool on) { twin().set_power(on, now); }
  bool set_fault(std::string_view name) { return twin().set_fault(name, now); }
  /// Any bytes of a stream, or frames of a bus, to the driver.
  void inject(std::span<const std::uint8_t> noise) {
    out.clear();
    AllocationCounter counter;
    if (made.bytes != nullptr) made.bytes->on_bytes(noise, now, out);
    allocations += counter.count();
    note();
  }

  /// What moves the base: of one that steers not what turns its front wheels.
  std::span<const Shaft> wheels() const {
    return std::span(shafts.data(), entry.steers ? 2 : shafts.size());
  }
  double fastest_radps() const {
    double most_radps = 0;
    for (const Shaft& shaft : wheels())
      most_radps = std::max(most_radps, std::abs(shaft.velocity_radps));
    return most_radps;
  }
  bool pushes() const {
    return std::any_of(shafts.begin(), shafts.end(),
                       [](const Shaft& shaft) { return shaft.torque_Nm != 0; });
  }

  const DriverEntry& entry;
  Made made;
  Device* device;
  Actuator* actuator;
  std::unique_ptr<CanTwin> can;
  std::unique_ptr<ByteDriveTwin> serial;
  FixedVector<Shaft, kMaxChannels> shafts;
  double load_Nm = 0;  ///< on each shaft
  bool driver_alive = true;
  std::set<std::uint32_t> ids;        ///< of what the twin said
  std::optional<std::uint32_t> lost;  ///< of them the one that does not reach the driver
  Time now{std::chrono::seconds(1)};
  DriverOut out;
  std::vector<Sent> sent;
  StatusInWords status;
  BodyMotion motion;
  int motions = 0;
  int off_list = 0;
  int forbidden = 0;
  int motion_at_rest = 0;
  std::size_t most = 0;  ///< messages in one cycle
  std::uint64_t allocations = 0;
  std::uint64_t overflows = 0;

 private:
  DriveTwin& twin() { return can ? static_cast<DriveTwin&>(*can) : *serial; }
  static bool arms_it(AxisRequest request) {
    return request == AxisRequest::run || request == AxisRequest::hold;
  }
  void turn() {
    constexpr double kInertia_kgm2 = 0.4;
    constexpr double kFriction_Nms_per_rad = 0.2;
    frames.clear();
    if (can) {
      can->on_tick(now, shafts, frames);
      hear_frames();
    } else {
      std::array<char, 4096> text{};
      const std::size_t size = serial->on_tick(now, shafts, text);
      const std::vector<std::uint8_t> bytes(text.begin(), text.begin() + static_cast<long>(size));
      if (driver_alive && !bytes.empty()) inject(bytes);
    }
    for (Shaft& each : shafts) {
      each.velocity_radps +=
          0.0025 / kInertia_kgm2 *
          (each.torque_Nm + load_Nm - kFriction_Nms_per_rad * each.velocity_radps);
      each.position_rad += 0.0025 * each.velocity_radps;
    }
  }
  void hear_frames() {
    if (!driver_alive) return;
    for (const CanFrame& frame : frames) {
      ids.insert(frame.id);
      if (frame.id == lost) continue;
      out.clear();
      AllocationCounter counter;
      made.frames->on_frame(frame, now, out);
      allocations += counter.count();
      note();
    }
  }
  void note() {
    overflows += out.overflows;
    for (const Measurement& m : out.measurements) {
      if (const auto* value = std::get_if<AxisStatus>(&m.value))
        status = {*value, made.device->words(m)};
      if (const auto* value = std::get_if<BodyMotion>(&m.value)) motion = *value, ++motions;
    }
  }
  void take(bool moving) {
    note();
    const DriverOut sending = out;
    const auto judge = [&](const Sent& one) {
      const FrameEffect effect = effect_of(one);
      forbidden += effect == FrameEffect::forbidden ? 1 : 0;
      motion_at_rest += effect == FrameEffect::motion && !moving ? 1 : 0;
      sent.push_back(one);
      send(one);
    };
    for (const CanFrame& frame : sending.frames) {
      off_list += on_list(actuator->rules(), frame) ? 0 : 1;
      judge(frame);
    }
    for (const Packet& packet : sending.packets) judge(packet);
    off_list += static_cast<int>(sending.bytes.size());
  }

  TwinFrames frames;
};

}  // namespace drover::test
