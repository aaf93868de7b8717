// Walks the registry: every driver, with every choice of its options, and a bench to run it on.
#pragma once

#include <gtest/gtest.h>

#include <cctype>
#include <optional>
#include <ostream>
#include <random>
#include <set>
#include <string>
#include <vector>

#include "drivers/drives.h"
#include "drover/registry.h"
#include "support/allocation_counter.h"
#include "support/golden.h"

namespace drover::test {

using std::chrono::milliseconds;

/// One driver with one set of options.
struct Subject {
  const DriverEntry* entry = nullptr;
  Options options;
  std::string label;  ///< letters, digits and underscores only
  friend std::ostream& operator<<(std::ostream& stream, const Subject& subject) {
    return stream << subject.label;
  }
};

inline std::string alphanumeric(std::string text) {
  for (char& c : text)
    if (!std::isalnum(static_cast<unsigned char>(c))) c = '_';
  return text;
}

/// Defaults, the required options filled with something valid, and the twin's defaults.
inline Options example_options(const DriverEntry& entry) {
  Options options(entry.options);
  for (const auto table : {entry.options, entry.twin_options}) {
    for (const OptionSpec& spec : table) {
      OptionValue value = spec.default_value;
      const double* const number = std::get_if<double>(&value);
      const bool is_example = number != nullptr && *number > spec.min;
      if (spec.required && spec.min < spec.max && !is_example)
        value = std::min(spec.min + 3, spec.max);
      if (spec.required && !spec.choices.empty()) value = std::string(spec.choices[0]);
      options.set(spec.name, value);
    }
  }
  return options;
}

inline Made made_of(const DriverEntry& entry, const Options& options,
                    const RegisterMap* registers = nullptr) {
  return entry.make(options, {.registers = registers});
}

/// Whether the entry's devices have this face. One is made to see it, of a map that asks for
/// something.
template <class Face>
bool has_face(const DriverEntry& entry, Face Made::*face) {
  RegisterMap map;
  map.fields.emplace_back();
  return made_of(entry, example_options(entry), &map).*face != nullptr;
}

/// All drivers with one face; each choice of a text option and each flag makes one more subject.
template <class Face>
std::vector<Subject> subjects(Face Made::*face) {
  std::vector<Subject> all;
  for (const DriverEntry& entry : driver_registry()) {
    if (!has_face(entry, face)) continue;
    const Options plain = example_options(entry);
    all.push_back({&entry, plain, std::string(entry.name)});
    for (const OptionSpec& spec : entry.options) {
      const std::string label = std::string(entry.name) + "_" + std::string(spec.name);
      for (const std::string_view choice : spec.choices) {
        if (std::string(choice) == plain.text(spec.name)) continue;
        Options options = plain;
        options.set(spec.name, std::string(choice));
        all.push_back({&entry, options, alphanumeric(label + "_" + std::string(choice))});
      }
      if (const bool* flag = std::get_if<bool>(&spec.default_value)) {
        Options options = plain;
        options.set(spec.name, !*flag);
        all.push_back({&entry, options, alphanumeric(label + (*flag ? "_false" : "_true"))});
      }
    }
  }
  return all;
}

/// Those of them whose twin is of this kind.
template <class MakeTwin, class Face>
std::vector<Subject> subjects_with_twin(Face Made::*face) {
  std::vector<Subject> all = subjects(face);
  std::erase_if(all, [](const Subject& subject) {
    return !std::holds_alternative<MakeTwin>(subject.entry->make_twin);
  });
  return all;
}

/// Those that are told `mode`.
inline std::vector<Subject> told(ChannelMode mode, std::vector<Subject> all) {
  std::erase_if(all, [&](const Subject& subject) {
    return subject.entry->channels.empty() || subject.entry->channels[0].mode != mode;
  });
  return all;
}

/// What its twin turns.
inline std::size_t shafts_of(const DriverEntry& entry) {
  return entry.twin_shafts != 0 ? entry.twin_shafts : entry.channels.size();
}

inline std::string label_of(const ::testing::TestParamInfo<Subject>& info) {
  return info.param.label;
}

inline bool on_list(std::span<const FrameRule> rules, const CanFrame& frame) {
  for (const FrameRule& rule : rules)
    if (rule.id == frame.id && rule.extended == frame.extended && rule.remote == frame.remote &&
        frame.len >= rule.min_len && frame.len <= rule.max_len)
      return !frame.fd && !frame.error;
  return false;
}

/// A driver and its twin on one wire, a shaft with inertia and friction, 5 ms ticks.
class CanBench {
 public:
  explicit CanBench(const Subject& subject)
      : made(made_of(*subject.entry, subject.options)),
        device(made.device.get()),
        frames(made.frames),
        actuator(made.actuator),
        twin(std::get<MakeCanTwin>(subject.entry->make_twin)(subject.options)),
        shaft(shafts[0]) {
    shafts.resize(shafts_of(*subject.entry));
    if (actuator->channels()[0].mode == ChannelMode::impedance) {
      // A joint is lighter than a wheel with its share of a robot.
      law.damping_Nmsprad = 5;
      inertia_kgm2 = 0.05;
      friction_Nms_per_rad = 0.02;
    }
    device->on_link_up(now);
  }

  /// Runs with one command; the plant steps at 2.5 ms.
  void run(Duration time, AxisRequest request, double velocity_radps = 0) {
    for (const Time end = now + time; now < end;) step(wish(request, velocity_radps));
  }

  /// Of a channel with impedance by damping alone.
  Setpoint wish(AxisRequest request, double velocity_radps = 0) const {
    return {request, velocity_radps, {}, law, held};
  }

  void step(const Setpoint& command) {
    step(command, [&](std::size_t) { return command.velocity_radps; });
  }
  /// `velocity_radps` of each channel.
  template <class Velocity>
  void step(const Setpoint& command, Velocity velocity_radps) {
    for (int i = 0; i < 2; ++i) {
      now += std::chrono::microseconds(2500);
      twin_frames.clear();
      twin->on_tick(now, {shafts.data(), shafts.size()}, twin_frames);
      to_driver();
      for (Shaft& each : shafts) move(each);
    }
    if (!driver_alive) return;
    out.clear();
    AllocationCounter counter;
    static_cast<void>(to_all(command));
    for (std::size_t i = 0; i < wanted.size(); ++i) wanted[i].velocity_radps = velocity_radps(i);
    actuator->on_setpoints({wanted.data(), wanted.size()}, now, out);
    device->on_tick(now, out);
    allocations += counter.count();
    take(command);
  }

  FrameEffect effect_of(const CanFrame& frame) const { return actuator->effect(frame, now).kind; }

  /// Every channel is told the same.
  std::span<const Setpoint> to_all(const Setpoint& command) {
    wanted.clear();
    for (std::size_t i = 0; i < actuator->channels().size(); ++i) (void)wanted.push_back(command);
    return {wanted.data(), wanted.size()};
  }

  /// Straight to the twin, as the guard does.
  void send(const CanFrame& frame) {
    twin_frames.clear();
    twin->on_frame(frame, now, twin_frames);
    to_driver();
  }

  /// Something on the wire that is not from the twin.
  void inject(const CanFrame& frame) {
    out.clear();
    AllocationCounter counter;
    frames->on_frame(frame, now, out);
    allocations += counter.count();
    overflows += out.overflows;
    note();
  }

  Made made;
  Device* device;
  FrameFace* frames;
  Actuator* actuator;
  std::unique_ptr<CanTwin> twin;
  FixedVector<Shaft, kMaxChannels> shafts;  ///< by channel
  Shaft& shaft;                             ///< of the first
  Impedance law;  ///< how a velocity is followed; not used by who is told that alone
  double load_Nm = 0;
  double inertia_kgm2 = 0.4;
  double friction_Nms_per_rad = 0.2;
  bool driver_alive = true;
  bool held = false;                  ///< before its driver began
  std::set<std::uint32_t> ids;        ///< of what the twin said
  std::optional<std::uint32_t> lost;  ///< of them the one that does not reach the driver
  Time now{std::chrono::seconds(1)};
  FixedVector<Setpoint, kMaxChannels> wanted;
  DriverOut out;
  TwinFrames twin_frames;
  std::vector<CanFrame> sent;
  std::vector<CanFrame> moving;  ///< of those: motion, by what was known when they left
  StatusInWords status;          ///< the last of any channel
  std::array<StatusInWords, kMaxChannels> statuses{};
  AxisMotion motion;  ///< of the first channel
  std::array<AxisMotion, kMaxChannels> motions{};
  int off_list = 0;
  int forbidden = 0;
  int motion_at_rest = 0;
  std::size_t most_frames = 0;  ///< in a cycle
  std::uint64_t allocations = 0;
  std::uint64_t overflows = 0;

 private:
  void to_driver() {
    if (!driver_alive) return;
    for (const CanFrame& frame : twin_frames) {
      ids.insert(frame.id);
      if (frame.id != lost) inject(frame);
    }
  }
  void move(Shaft& each) const {
    each.velocity_radps += 0.0025 / inertia_kgm2 *
                           (each.torque_Nm + load_Nm - friction_Nms_per_rad * each.velocity_radps);
    each.position_rad += 0.0025 * each.velocity_radps;
  }
  void note() {
    for (const Measurement& m : out.measurements) {
      if (const auto* value = std::get_if<AxisStatus>(&m.value))
        statuses[value->axis] = status = {*value, made.device->words(m)};
      if (const auto* value = std::get_if<AxisMotion>(&m.value)) {
        motions[value->axis] = *value;
        if (value->axis == 0) motion = *value;
      }
    }
  }
  void take(const Setpoint& command) {
    note();
    overflows += out.overflows;
    const DriverOut sending = out;
    most_frames = std::max(most_frames, sending.frames.size());
    for (const CanFrame& frame : sending.frames) {
      sent.push_back(frame);
      off_list += on_list(actuator->rules(), frame) ? 0 : 1;
      const FrameEffect effect = effect_of(frame);
      forbidden += effect == FrameEffect::forbidden ? 1 : 0;
      if (effect == FrameEffect::motion) moving.push_back(frame);
      motion_at_rest += effect == FrameEffect::motion && command.request != AxisRequest::run &&
                        command.request != AxisRequest::hold;
      send(frame);
    }
  }
};

/// Frames that look like the driver's own traffic, broken in every way.
inline CanFrame random_frame(std::mt19937& random, std::span<const CanFrame> like) {
  CanFrame frame;
  const auto roll = random() % 8;
  if (roll < 5 && !like.empty()) {
    frame = like[random() % like.size()];
  } else {
    frame.id = static_cast<std::uint32_t>(random() % (random() % 4 == 0 ? 0x20000000U : 0x800U));
  }
  const auto break_how = random() % 8;
  if (break_how == 0) frame.extended = !frame.extended;
  if (break_how == 1) frame.remote = !frame.remote;
  if (break_how == 2) frame.fd = true;
  if (break_how == 3) frame.error = true;
  if (break_how != 4) frame.len = static_cast<std::uint8_t>(random() % (frame.fd ? 65 : 9));
  if (break_how < 7)
    for (auto& byte : frame.data)
      if (random() % 3 == 0) byte = static_cast<std::uint8_t>(random());
  return frame;
}

inline std::vector<CanFrame> golden_frames(const DriverEntry& entry) {
  std::vector<CanFrame> frames;
  for (const GoldenFile& file : read_goldens(DROVER_SOURCE_DIR, entry))
    for (const GoldenCase& one : file.cases)
      if (one.is_frame) frames.push_back(one.frame);
  return frames;
}

inline std::vector<std::uint8_t> golden_bytes(const DriverEntry& entry) {
  std::vector<std::uint8_t> bytes;
  for (const GoldenFile& file : read_goldens(DROVER_SOURCE_DIR, entry))
    for (const GoldenCase& one : file.cases)
      bytes.insert(bytes.end(), one.bytes.begin(), one.bytes.end());
  return bytes;
}

}  // namespace drover::test
