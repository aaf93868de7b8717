// A short run of a small robot with one of everything: two drives, receiver, sensor, battery and
// lines, told what to do by joint commands; and its recording, written as the daemon would.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "config/load.h"
#include "gateway/recording/encoder.h"
#include "support/describe.h"
#include "support/small_robot.h"

namespace drover::gateway {

inline std::string robot_configuration() {
  return test::kSmallRobot;
}

inline config::Loaded load_robot(const std::string& configuration = robot_configuration()) {
  return config::load_text(configuration, std::string(DROVER_SOURCE_DIR) + "/config/maps");
}

/// `text` with `was` replaced: a robot that is a little other.
inline std::string changed(std::string text, const std::string& was, const std::string& is) {
  const auto at = text.find(was);
  if (at == std::string::npos) throw std::invalid_argument(was);
  return text.replace(at, was.size(), is);
}

/// What the daemon's recorder leaves, in memory.
class Recording final {
 public:
  Recording(const config::Loaded& loaded, const Gateway& gateway)
      : bytes_(written(RecordingHeader{"test", loaded.text, loaded.register_map,
                                       mathematics_fingerprint(), field_names(gateway)})) {}
  void add(std::span<const std::uint8_t> record) {
    std::array<std::uint8_t, 10> length{};
    ByteWriter head(length);
    head.number(record.size());
    bytes_.insert(bytes_.end(), head.written().begin(), head.written().end());
    bytes_.insert(bytes_.end(), record.begin(), record.end());
  }
  void add(RecordKind kind) {
    const std::array<std::uint8_t, 1> record{static_cast<std::uint8_t>(kind)};
    add(record);
  }
  const std::vector<std::uint8_t>& bytes() const { return bytes_; }

 private:
  std::vector<std::uint8_t> bytes_;
};

/// The inputs of a run. Bytes are owned here.
class RobotRun final {
 public:
  static constexpr Duration kTick = std::chrono::milliseconds(5);

  RobotRun() {
    add(LinkUp{0});
    add(LinkUp{1});
    add(LinkUp{2});
    add(LinkUp{3});
  }
  void add(const InputBody& body) { inputs.push_back({now, body}); }
  void command(decltype(Command::body) body) {
    add(CommandGiven{{{RequestId::Source::mqtt, ++requests_}, now, std::move(body)}});
  }
  void joints(double radps) {
    JointTargets targets;
    (void)targets.joints.push_back({0, radps});
    (void)targets.joints.push_back({1, radps});
    command(targets);
  }
  /// Both drives run and have turned a little, the lines are released, and the cycle ends.
  void cycle() {
    now += kTick;
    turned_ += 1e-3F;
    for (const std::uint32_t node : {1U, 2U}) {
      add(FrameHeard{0, make_frame(node << 5U | 1U, {0, 0, 0, 0, 8, 0, 0, 0})});
      CanFrame estimate = make_frame(node << 5U | 9U, {0, 0, 0, 0, 0, 0, 0, 0});
      const auto bits = std::bit_cast<std::uint32_t>(turned_);
      for (unsigned i = 0; i < 4; ++i)
        estimate.data[i] = static_cast<std::uint8_t>(bits >> (8 * i));
      add(FrameHeard{0, estimate});
    }
    LevelsRead released;
    released.link = 4;
    (void)released.levels.push_back(true);
    (void)released.levels.push_back(true);
    add(released);
    add(Tick{true, false});
    ++cycles;
  }
  void cycles_with_joints(int count, double radps) {
    for (int i = 0; i < count; ++i) {
      joints(radps);
      cycle();
    }
  }

  Time now{std::chrono::seconds(100)};
  std::vector<Input> inputs;
  std::uint64_t cycles = 0;

 private:
  std::uint64_t requests_ = 0;
  float turned_ = 0;
};

/// At rest for a while, then off by joint commands.
inline RobotRun a_run() {
  RobotRun run;
  for (int i = 0; i < 170; ++i) run.cycle();
  run.cycles_with_joints(70, 0);
  run.cycles_with_joints(60, 1.5);
  return run;
}

/// What was recorded when a gateway of `configuration` lived through it; `edit` may change the
/// inputs on their way to the recording (not to the gateway).
inline std::vector<std::uint8_t> record(
    const RobotRun& run, const std::string& configuration = robot_configuration(),
    const std::function<void(std::vector<Input>&)>& edit = [](auto&) {},
    const std::string& told_configuration = robot_configuration()) {
  const auto loaded = load_robot(configuration);
  auto told = load_robot(told_configuration);
  Gateway gateway(loaded.config);
  Recording recording(told, gateway);
  RecordEncoder encoder;
  auto written_inputs = run.inputs;
  edit(written_inputs);
  // Cycle by cycle: the recorded inputs of one, then what the gateway said after the true ones.
  auto next = written_inputs.begin();
  for (const auto& input : run.inputs) {
    gateway.apply(input);
    if (!std::holds_alternative<Tick>(input.body)) continue;
    while (next != written_inputs.end()) {
      recording.add(encoder.input(*next));
      if (std::holds_alternative<Tick>((next++)->body)) break;
    }
    recording.add(encoder.output(gateway));
  }
  recording.add(RecordKind::end);
  return recording.bytes();
}

}  // namespace drover::gateway
