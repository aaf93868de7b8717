// A task of a base that takes a twist, recorded and replayed: to the bit, and what is planted in
// the recording is found.
#include "gateway/recording/replay.h"

#include <gmock/gmock.h>

#include "whole_robot.h"

namespace drover::test {
namespace {

using gateway::an_event;
using gateway::PlantedRecording;
using gateway::Replayed;

/// What two seconds of a task leave, with something planted in it.
PlantedRecording a_task(const std::string& robot_name, PlantedRecording::Piece piece = {}) {
  WholeRobot robot(robot_name);
  PlantedRecording recording(robot.loaded, robot.gateway, std::move(piece));
  robot.record(recording);
  robot.start_task();
  EXPECT_EQ(robot.seen().nav.status, NavStatus::run) << robot.why();
  robot.run_s(2);  // its first way is slow
  EXPECT_GT(robot.seen().base.measured.vx_mps, 0.03);
  recording.end();
  return recording;
}

class ATaskOfATwistBase : public testing::TestWithParam<const char*> {};

TEST_P(ATaskOfATwistBase, IsReplayedToTheBit) {
  const PlantedRecording recording = a_task(GetParam());
  const auto it = gateway::replay(recording.bytes());
  EXPECT_EQ(it.verdict, Replayed::Verdict::equal) << it.note << it.difference.what;
  EXPECT_EQ(it.cycles, recording.cycles());
}

TEST_P(ATaskOfATwistBase, DiffersInAnEventOnly) {
  expect_found_only_in(a_task(GetParam(), an_event<NavigationStarted>()), "events[");
}

INSTANTIATE_TEST_SUITE_P(OnAnyWire, ATaskOfATwistBase, testing::Values("gt01", "agilex_v2"),
                         [](const auto& robot) { return std::string(robot.param); });

/// It is asked for more than rest.
bool drives(const engine::EngineOutput& output) {
  return output.base.twist.vx_mps > 0.03;
}

TEST(ATaskOnATty, DiffersInAPacketOnly) {
  const auto packet = [](const gateway::CycleOutput& cycle) {
    std::vector<std::uint8_t> piece;
    for (const auto& stream : cycle.streams)
      if (stream.moves && drives(cycle.engine))
        piece.assign(stream.bytes.begin(), stream.bytes.end());
    return piece;
  };
  expect_found_only_in(a_task("gt01", packet), "bytes for base[");
}

TEST(ATaskOnABus, DiffersInAFrameOnly) {
  const auto frame = [](const gateway::CycleOutput& cycle) {
    std::vector<std::uint8_t> piece(32);
    gateway::ByteWriter out(piece);
    for (const CanFrame& said : cycle.frames[0])
      if (said.id == 0x111 && drives(cycle.engine) && out.written().empty())
        gateway::write_frame(said, out);
    piece.resize(out.written().size());
    return piece;
  };
  expect_found_only_in(a_task("agilex_v2", frame), "frames of bus 0[");
}

}  // namespace
}  // namespace drover::test
