#include "gateway/recording/replay.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/unit/gateway/recorded_run.h"

namespace drover::gateway {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::StartsWith;
using Verdict = Replayed::Verdict;

/// The first cycle, from 1, in which gateways of both configurations want another speed.
std::uint64_t first_cycle_apart(const RobotRun& run, const std::string& one,
                                const std::string& other) {
  Gateway a(load_robot(one).config);
  Gateway b(load_robot(other).config);
  std::uint64_t cycle = 0;
  for (const auto& input : run.inputs) {
    a.apply(input);
    b.apply(input);
    if (!std::holds_alternative<Tick>(input.body)) continue;
    ++cycle;
    if (a.output().engine.axes[0].velocity_radps != b.output().engine.axes[0].velocity_radps)
      return cycle;
  }
  return 0;
}

/// Of the nth cycle, from 1, the first input that `is_it`.
template <class Is>
std::size_t place(const std::vector<Input>& inputs, std::uint64_t cycle, const Is& is_it) {
  for (std::size_t i = 0; i < inputs.size(); ++i) {
    if (cycle == 1 && is_it(inputs[i])) return i;
    if (std::holds_alternative<Tick>(inputs[i].body)) --cycle;
  }
  throw std::logic_error("no such input");
}

bool is_frame(const Input& input) {
  const auto* heard = std::get_if<FrameHeard>(&input.body);
  return heard != nullptr && (heard->frame.id & 0x1FU) == 9U;
}

TEST(Replay, SaysTheSameToTheBit) {
  const RobotRun run = a_run();
  const auto it = replay(record(run));
  EXPECT_EQ(it.verdict, Verdict::equal) << it.note << it.difference.what;
  EXPECT_EQ(it.cycles, run.cycles);
  EXPECT_EQ(it.inputs, run.inputs.size());
  EXPECT_EQ(it.version, "test");
  EXPECT_THAT(it.note, IsEmpty());
  EXPECT_THAT(it.not_compared, IsEmpty());
}

TEST(Replay, FindsAChangedConstantInTheFirstCycleThatItChanges) {
  const RobotRun run = a_run();
  const auto other =
      changed(robot_configuration(), "\"acceleration_mps2\": 0.4", "\"acceleration_mps2\": 0.41");
  const auto cycle = first_cycle_apart(run, robot_configuration(), other);
  ASSERT_GT(cycle, 240U) << "it begins to move";
  const auto it = replay(record(run, other));
  ASSERT_EQ(it.verdict, Verdict::differs) << it.note;
  EXPECT_EQ(it.difference.cycle, cycle);
  EXPECT_EQ(it.difference.time, run.inputs.front().time + cycle * RobotRun::kTick);
  EXPECT_THAT(it.difference.what, HasSubstr("commanded_velocity_radps"));
  EXPECT_NE(it.difference.recorded, it.difference.replayed);
  EXPECT_THAT(it.difference.inputs.back(), HasSubstr("tick"));
  EXPECT_THAT(it.difference.inputs, Contains(HasSubstr("joint targets")));
}

TEST(Replay, FindsADroppedInputInItsCycle) {
  const auto it = replay(record(a_run(), robot_configuration(), [](auto& inputs) {
    inputs.erase(inputs.begin() + static_cast<std::ptrdiff_t>(place(inputs, 77, is_frame)));
  }));
  ASSERT_EQ(it.verdict, Verdict::differs);
  EXPECT_EQ(it.difference.cycle, 77U);
  EXPECT_THAT(it.difference.what, StartsWith("axes[0].motion"));
}

TEST(Replay, FindsAnInputThatIsNotAsItWas) {
  const auto it = replay(record(a_run(), robot_configuration(), [](auto& inputs) {
    std::get<FrameHeard>(inputs[place(inputs, 150, is_frame)].body).frame.data[0] ^= 1U;
  }));
  ASSERT_EQ(it.verdict, Verdict::differs);
  EXPECT_EQ(it.difference.cycle, 150U);
}

TEST(Replay, FindsInputsThatChangedPlaces) {
  RobotRun run = a_run();
  run.command(EngageStop{});
  run.command(ResetStop{});
  const auto cycle = run.cycles + 1;
  run.cycle();
  run.cycle();
  const auto it = replay(record(run, robot_configuration(), [&](auto& inputs) {
    const auto stop = place(inputs, cycle, [](const Input& input) {
      return std::holds_alternative<CommandGiven>(input.body);
    });
    std::swap(inputs[stop], inputs[stop + 1]);
  }));
  ASSERT_EQ(it.verdict, Verdict::differs);
  EXPECT_EQ(it.difference.cycle, cycle);
}

PlantedRecording planted(const RobotRun& run, PlantedRecording::Piece piece) {
  const auto loaded = load_robot();
  Gateway gateway(loaded.config);
  PlantedRecording recording(loaded, gateway, std::move(piece));
  for (const auto& input : run.inputs) {
    recording.input(input);
    gateway.apply(input);
    if (std::holds_alternative<Tick>(input.body)) recording.output(gateway);
  }
  recording.end();
  return recording;
}

TEST(Replay, FindsWhatDiffersInAFrameOnly) {
  const auto speed_of_the_right = [](const CycleOutput& cycle) {
    std::vector<std::uint8_t> piece(32);
    ByteWriter out(piece);
    for (const CanFrame& frame : cycle.frames[0])
      if (frame.id == (2U << 5U | 0x0DU) && frame.data[3] != 0) write_frame(frame, out);
    piece.resize(out.written().size());
    return piece;
  };
  expect_found_only_in(planted(a_run(), speed_of_the_right), "frames of bus 0[");
}

TEST(Replay, FindsWhatDiffersInAnEventOnly) {
  RobotRun run = a_run();
  run.command(EngageStop{});
  run.cycle();
  expect_found_only_in(planted(run, an_event<CommandAccepted>()), "events[");
}

TEST(Replay, FindsWhatDiffersInBytesOnly) {
  expect_found_only_in(planted(a_run(), bytes_of(3)), "bytes for imu[");
}

TEST(Replay, KnowsAPathByItsNumber) {
  RobotRun run = a_run();
  Path path;
  path.number = 7;
  path.name = "row";
  path.points = {{0, 0}, {5, 0}};
  run.command(StartTask{&path, 1, 0.5, true});  // a stop came after it
  run.command(StartTask{&path, 1, 0.5});        // refused, and given back: there is no position
  run.cycle();
  const auto loaded = load_robot();
  Gateway gateway(loaded.config);
  Recording recording(loaded, gateway);
  RecordEncoder encoder;
  recording.add(written(path));
  for (const auto& input : run.inputs) {
    recording.add(encoder.input(input));
    gateway.apply(input);
    if (std::holds_alternative<Tick>(input.body)) recording.add(encoder.output(gateway));
  }
  path = {};  // the recording has its own
  const auto& events = gateway.output().engine.events;
  EXPECT_TRUE(std::any_of(events.begin(), events.end(), [](const Event& event) {
    return std::holds_alternative<PathReleased>(event.body);
  }));
  const auto it = replay(recording.bytes());
  EXPECT_EQ(it.verdict, Verdict::equal) << it.note << it.difference.what;
  EXPECT_THAT(it.note, HasSubstr("killed")) << "it has no last word";
}

TEST(RecordedPath, KeepsWhichWayItIsDriven) {
  Path path;
  path.number = 7;
  path.name = "row";
  path.points = {{0, 0}, {5, 0}, {1, 0.5}};
  for (const bool gears : {false, true}) {
    if (gears) path.backwards = {0, 1};
    path.either = gears;
    const auto bytes = written(path);
    ByteReader in(std::span<const std::uint8_t>(bytes).subspan(1));
    const Path read = read_path(in);
    EXPECT_TRUE(in.good());
    EXPECT_EQ(read.points.size(), 3U);
    EXPECT_EQ(read.backwards, path.backwards);
    EXPECT_EQ(read.either, gears);
  }
}

TEST(Replay, IsPlayedForWhatTheGatewayMakesOfIt) {
  const RobotRun run = a_run();
  const auto file = record(run);
  std::uint64_t cycles = 0;
  Time last = kNever;
  const auto watch = [&](const Snapshot& snapshot) {
    EXPECT_GT(snapshot.time, last);
    last = snapshot.time;
    ++cycles;
  };
  const auto it = play(file, nullptr, watch);
  EXPECT_NE(it.verdict, Verdict::unusable) << it.note;
  EXPECT_EQ(cycles, replay(file).cycles);
  EXPECT_EQ(it.cycles, cycles);
}

TEST(Replay, IsPlayedWithAnotherConfigurationOfTheSameDevices) {
  const RobotRun run = a_run();
  const auto other =
      changed(robot_configuration(), "\"acceleration_mps2\": 0.4", "\"acceleration_mps2\": 0.41");
  const auto commanded = [](const std::vector<std::uint8_t>& file, const auto* config) {
    std::vector<double> speeds;
    const auto it = play(file, config, [&](const Snapshot& snapshot) {
      speeds.push_back(snapshot.axes[0].commanded_velocity_radps);
    });
    EXPECT_NE(it.verdict, Verdict::unusable) << it.note;
    return speeds;
  };
  const config::DroverConfig* recorded = nullptr;
  const auto config = load_robot(other).config;
  const auto with_other = commanded(record(run), &config);
  EXPECT_EQ(with_other, commanded(record(
                                      run, other, [](auto&) {}, other),
                                  recorded));
  EXPECT_NE(with_other, commanded(record(run), recorded));
}

TEST(Replay, IsNotPlayedWithAConfigurationOfOtherDevices) {
  auto other = load_robot().config;
  other.devices.front().name = "somebody else's";
  const auto it = play(record(a_run()), &other, {});
  EXPECT_EQ(it.verdict, Verdict::unusable);
  EXPECT_THAT(it.note, HasSubstr("not those of the configuration that is given"));
}

TEST(Replay, RefusesATaskWhosePathIsMissing) {
  RobotRun run;
  Path path;
  path.number = 7;
  run.command(StartTask{&path, 0, 0.5});
  run.cycle();
  const auto it = replay(record(run));
  EXPECT_EQ(it.verdict, Verdict::unusable);
  EXPECT_THAT(it.note, HasSubstr("damaged input (equal for 0 cycles"));
}

TEST(Replay, TakesTheRecordingOfAKilledDaemonAsFarAsItGoes) {
  auto file = record(a_run());
  file.resize(file.size() - 100);
  const auto it = replay(file);
  EXPECT_EQ(it.verdict, Verdict::equal);
  EXPECT_GT(it.cycles, 290U);
  EXPECT_THAT(it.note, HasSubstr("ends within a record"));
}

TEST(Replay, StopsAtAGapAndSaysHowFarItWasEqual) {
  const RobotRun run = a_run();
  const auto loaded = load_robot();
  Gateway gateway(loaded.config);
  Recording recording(loaded, gateway);
  RecordEncoder encoder;
  for (const auto& input : run.inputs) {
    recording.add(encoder.input(input));
    gateway.apply(input);
    if (!std::holds_alternative<Tick>(input.body)) continue;
    recording.add(encoder.output(gateway));
  }
  recording.add(RecordKind::gap);
  const auto it = replay(recording.bytes());
  EXPECT_EQ(it.verdict, Verdict::unusable);
  EXPECT_THAT(it.note, HasSubstr("gap"));
  EXPECT_THAT(it.note, HasSubstr("equal for 300 cycles"));
}

TEST(Replay, RefusesWhatIsNoRecording) {
  for (const std::string text : {"", "drover", "drover recording 5\n", "{\"a\": 1}"}) {
    const auto it = replay({reinterpret_cast<const std::uint8_t*>(text.data()), text.size()});
    EXPECT_EQ(it.verdict, Verdict::unusable) << text;
    EXPECT_THAT(it.note, HasSubstr("no recording")) << text;
  }
}

TEST(Replay, RefusesAConfigurationThatThisProgramDoesNotKnow) {
  const auto other = changed(robot_configuration(), "\"limits\"", "\"limit\"");
  const auto it = replay(record(
      RobotRun(), robot_configuration(), [](auto&) {}, other));
  EXPECT_EQ(it.verdict, Verdict::unusable);
  EXPECT_THAT(it.note, HasSubstr("limit"));
}

TEST(Replay, NamesTheValuesThatOnlyOneOfRecordingAndProgramHas) {
  auto file = record(a_run());
  const std::string known = "nav.paused";
  const auto at = std::search(file.begin(), file.end(), known.begin(), known.end());
  ASSERT_NE(at, file.end());
  std::copy_n("nav.pauses", known.size(), at);
  const auto it = replay(file);
  EXPECT_EQ(it.verdict, Verdict::equal);
  EXPECT_THAT(it.not_compared, ::testing::UnorderedElementsAre("nav.paused", "nav.pauses"));
}

}  // namespace
}  // namespace drover::gateway
