// A short run of a small robot with one of everything: two drives, receiver, sensor, battery and
// lines, told what to do by joint commands; and its recording, written as the daemon would.
#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <string>
#include <vector>

#include "config/load.h"
#include "gateway/recording/encoder.h"
#include "gateway/recording/replay.h"
#include "gateway/recording/text.h"
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

/// A recording in which one bit of one cycle's output is not as it was.
class PlantedRecording final {
 public:
  /// What of a cycle's output is changed, as the record has it; empty: not in this cycle. The
  /// change is in its last byte, in the first cycle that has something.
  using Piece = std::function<std::vector<std::uint8_t>(const CycleOutput&)>;

  PlantedRecording(const config::Loaded& loaded, const Gateway& gateway, Piece piece = {})
      : piece_(std::move(piece)), recording_(loaded, gateway) {}
  void path(const Path& path) { recording_.add(written(path)); }
  void input(const Input& input) { recording_.add(encoder_.input(input)); }
  void output(const Gateway& gateway) {
    ++cycles_;
    const auto output = encoder_.output(gateway);
    std::vector<std::uint8_t> record(output.begin(), output.end());
    const auto piece = cycle_ != 0 || !piece_ ? decltype(record)() : piece_(gateway.output());
    if (!piece.empty()) {
      const auto at = std::find_end(record.begin(), record.end(), piece.begin(), piece.end());
      if (at == record.end()) throw std::logic_error("it is not in the record");
      at[static_cast<std::ptrdiff_t>(piece.size()) - 1] ^= 1U;
      cycle_ = cycles_;
    }
    recording_.add(record);
  }
  void end() { recording_.add(RecordKind::end); }

  const std::vector<std::uint8_t>& bytes() const { return recording_.bytes(); }
  std::uint64_t cycle() const { return cycle_; }  ///< of the change, from 1; 0: there was none
  std::uint64_t cycles() const { return cycles_; }

 private:
  Piece piece_;
  Recording recording_;
  RecordEncoder encoder_;
  std::uint64_t cycles_ = 0;
  std::uint64_t cycle_ = 0;
};

/// What leaves on a line, where it is at least so long.
inline PlantedRecording::Piece bytes_of(std::size_t size) {
  return [size](const CycleOutput& cycle) {
    std::vector<std::uint8_t> piece;
    for (const StreamOutput& stream : cycle.streams)
      if (stream.bytes.size() >= size) piece.assign(stream.bytes.begin(), stream.bytes.end());
    return piece;
  };
}

/// What is told.
template <class Kind>
PlantedRecording::Piece an_event() {
  return [](const CycleOutput& cycle) {
    std::vector<std::uint8_t> piece;
    for (const Event& event : cycle.engine.events) {
      if (!std::holds_alternative<Kind>(event.body)) continue;
      const Line line = text_of(event);
      piece.assign(line.view().begin(), line.view().end());
    }
    return piece;
  };
}

/// Of what the snapshot shows nothing differs: only what left, or was told, does.
inline void expect_found_only_in(const PlantedRecording& recording, const char* what) {
  ASSERT_GT(recording.cycle(), 0U) << "nothing of the kind was recorded";
  const auto it = replay(recording.bytes());
  ASSERT_EQ(it.verdict, Replayed::Verdict::differs) << it.note;
  EXPECT_EQ(it.difference.cycle, recording.cycle());
  EXPECT_THAT(it.difference.what, ::testing::StartsWith(what));
  EXPECT_NE(it.difference.recorded, it.difference.replayed);
  EXPECT_EQ(it.difference.more, 0U);
}

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
