#include "gateway/recording/earlier_editions.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "gateway/recording/input_codec.h"
#include "gateway/recording/replay.h"
#include "tests/unit/gateway/recorded_run.h"

namespace drover::gateway {
namespace {

using ::testing::ElementsAre;

/// Links: can0 0, gnss 1, imu 2, battery 3, lines 4. Slots: the battery is 4.
class FirstEdition : public ::testing::Test {
 protected:
  /// What an input was whose record held the kind, 1 s since the one before it, and these bytes.
  std::string meaning(std::uint8_t kind, std::vector<std::uint8_t> body) {
    std::vector<std::uint8_t> record(16);
    ByteWriter out(record);
    out.byte(kind);
    out.signed_number(1'000'000'000);
    out.bytes(body);
    record.resize(out.written().size());
    now_ = from_first_edition(record, wiring_);
    ByteReader in(now_);
    const auto kind_now = in.byte();
    const auto input = read_input(
        kind_now, Time{std::chrono::seconds(7)}, [](auto) { return nullptr; }, in);
    return in.done() ? text_of(input, wiring_) : "damaged";
  }

  engine::Environment environment_;
  Wiring wiring_ = wire_up(load_robot().config, environment_);
  std::vector<std::uint8_t> now_;
};

TEST_F(FirstEdition, KnowsAStreamByWhatItWasFor) {
  EXPECT_EQ(meaning(1, {0, 2, 0x24, 0x47}), "at 8.000000000 s: bytes on gnss: 2447");
  EXPECT_EQ(meaning(1, {1, 1, 0x55}), "at 8.000000000 s: bytes on imu: 55");
  EXPECT_EQ(meaning(10, {0}), "at 8.000000000 s: gnss up");
  EXPECT_EQ(meaning(10, {1}), "at 8.000000000 s: imu up");
  EXPECT_EQ(meaning(10, {2}), "damaged");
}

TEST_F(FirstEdition, HadOneChip) {
  EXPECT_EQ(meaning(2, {2, 1, 0}), "at 8.000000000 s: levels of lines: 1 0");
  EXPECT_EQ(meaning(3, {}), "at 8.000000000 s: lines lost: ");
}

TEST_F(FirstEdition, HadOneBattery) {
  EXPECT_EQ(meaning(4, {1, 2, 7, 9}), "at 8.000000000 s: registers of battery, block 1: 7 9");
  EXPECT_EQ(meaning(5, {1, 3, 4}),
            "at 8.000000000 s: no registers of battery, block 1: failure 3, exception 2");
  EXPECT_EQ(meaning(6, {}), "at 8.000000000 s: battery up");
}

TEST_F(FirstEdition, NumberedTheBusesAsToday) {
  EXPECT_EQ(meaning(0, {0, 0x21, 0, 1, 0xAB}), "at 8.000000000 s: frame on can0: 021#AB");
  EXPECT_EQ(meaning(7, {0}), "at 8.000000000 s: can0 up");
  EXPECT_EQ(meaning(8, {0, 3, 'o', 'f', 'f'}), "at 8.000000000 s: can0 lost: off");
  EXPECT_EQ(meaning(9, {0, 40, 3}), "at 8.000000000 s: can0 took 40 frames so far, refused 3");
}

TEST_F(FirstEdition, RecalledNothingThatJointCommandsWaitFor) {
  EXPECT_EQ(meaning(15, {3, 'o', 'f', 'f', 1, 0, 1, 0, 0, 0}),
            "at 8.000000000 s: recalled: held stopped at the robot: off");
}

/// What `today` makes of a robot that was remembered, held and stopped at the robot; `flags` is
/// what its edition told after what joint commands wait for.
template <class Today>
std::string recalled(std::initializer_list<std::uint8_t> flags, const Today& today) {
  engine::Environment environment;
  const Wiring wiring = wire_up(load_robot().config, environment);
  std::vector<std::uint8_t> record(64);
  ByteWriter out(record);
  out.byte(static_cast<std::uint8_t>(InputBody(Recalled{}).index()));
  out.signed_number(1'000'000'000);
  out.text("off");
  for (const bool flag : {true, false, true, false, false, false}) out.byte(flag ? 1 : 0);
  out.text("");
  for (const std::uint8_t flag : flags) out.byte(flag);
  record.resize(out.written().size());
  const auto now = today(record);
  ByteReader in(now);
  const auto kind = in.byte();
  const auto input = read_input(
      kind, Time{std::chrono::seconds(7)}, [](auto) { return nullptr; }, in);
  return in.done() ? text_of(input, wiring) : "damaged";
}

TEST(SecondEdition, DidNotRememberWhetherTheRobotWasAtRest) {
  EXPECT_EQ(recalled({}, from_second_edition),
            "at 8.000000000 s: recalled: held stopped at the robot: off");
}

TEST(ThirdEdition, DidNotRememberWhetherAWheelRanAway) {
  EXPECT_EQ(recalled({1}, from_third_edition),
            "at 8.000000000 s: recalled: at rest held stopped at the robot: off");
}

TEST(FourthEdition, DidNotRememberWhereTheRobotStood) {
  EXPECT_EQ(recalled({1, 1}, from_fourth_edition),
            "at 8.000000000 s: recalled: at rest held run away stopped at the robot: off");
}

/// A command as it is recorded today.
std::vector<std::uint8_t> recorded(const decltype(Command::body)& body) {
  Command command{{RequestId::Source::ros2, 7}, Time{std::chrono::seconds(5)}, {}};
  command.body = body;
  std::vector<std::uint8_t> buffer(1024);
  ByteWriter out(buffer);
  out.byte(static_cast<std::uint8_t>(InputBody(CommandGiven{}).index()));
  write_input({Time{std::chrono::seconds(8)}, CommandGiven{command}}, Time{std::chrono::seconds(7)},
              out);
  buffer.resize(out.written().size());
  return buffer;
}

TEST(FifthEdition, KnewOfTwistsTheirSpeedsOnly) {
  for (const decltype(Command::body)& body :
       {decltype(Command::body)(FollowTwist{{0.3, -0.1}}),
        decltype(Command::body)(TwistRefused{"linear.y is 0.3"})}) {
    const auto whole = recorded(body);
    const std::size_t aside = std::holds_alternative<FollowTwist>(body) ? sizeof(double) : 0;
    // It knew neither what was before it nor of a way to the side.
    const std::span fifth(whole.data(), whole.size() - aside - 1);
    EXPECT_EQ(from_sixth_edition(from_fifth_edition(fifth)), whole);
    const std::span sixth(whole.data(), whole.size() - aside);
    EXPECT_EQ(from_sixth_edition(sixth), whole);
  }
  const auto stop = recorded(EngageStop{});
  EXPECT_EQ(from_fifth_edition(stop), stop);
  EXPECT_EQ(from_sixth_edition(stop), stop);
  EXPECT_TRUE(from_sixth_edition({}).empty());
  EXPECT_TRUE(from_fifth_edition({}).empty());
}

TEST(SeventhEdition, KnewOfNobodyWhoLookedToTheSides) {
  Clearance found;
  found.ahead_m = 2;
  found.broken = "constraint yard does not hold";
  std::vector<std::uint8_t> whole(1024);
  ByteWriter out(whole);
  out.byte(static_cast<std::uint8_t>(InputBody(ClearanceFound{}).index()));
  write_input({Time{std::chrono::seconds(8)}, ClearanceFound{found}}, Time{std::chrono::seconds(7)},
              out);
  whole.resize(out.written().size());
  const std::span seventh(whole.data(), whole.size() - 5 * sizeof(double));
  EXPECT_EQ(from_seventh_edition(seventh), whole);
  EXPECT_TRUE(from_seventh_edition({}).empty());
}

TEST(EighthEdition, SaidWhoHadBeenThereBeforeInWordsOnly) {
  for (const JointTargetsRefused& refused :
       {JointTargetsRefused{"droverd has only just come, and nobody's commands are followed yet",
                            true},
        JointTargetsRefused{"it names no joint", false}, JointTargetsRefused{}}) {
    const auto whole = recorded(refused);
    const std::span eighth(whole.data(), whole.size() - 1);
    EXPECT_EQ(from_eighth_edition(eighth), whole) << refused.reason.view();
  }
  const auto other = recorded(TwistRefused{"it names no joint", true});
  EXPECT_EQ(from_eighth_edition(other), other);
  EXPECT_TRUE(from_eighth_edition({}).empty());
  // Cut short: as it is, for the reader to refuse.
  const auto whole = recorded(JointTargetsRefused{"it names no joint"});
  const std::span cut(whole.data(), whole.size() - 4);
  EXPECT_EQ(from_eighth_edition(cut), std::vector<std::uint8_t>(cut.begin(), cut.end()));
}

TEST_F(FirstEdition, HadTheSameOfAllElse) {
  EXPECT_EQ(meaning(12, {5}), "at 8.000000000 s: tick, guard alive, stopped at the guard");
  EXPECT_EQ(meaning(12, {11}),
            "at 8.000000000 s: tick, guard alive, guard has the bus, the guard "
            "keeps another stop set");
  EXPECT_EQ(meaning(12, {32}), "damaged");
  EXPECT_EQ(meaning(13, {2, 'n', 'o'}), "at 8.000000000 s: trouble of the daemon: no");
  EXPECT_EQ(meaning(16, {1}), "at 8.000000000 s: outputs up, relay closed");
  EXPECT_EQ(meaning(17, {}), "damaged");
}

TEST_F(FirstEdition, NamesNoLinkThatIsNotConfigured) {
  auto config = load_robot().config;
  std::erase_if(config.devices, [](const auto& device) { return device.name == "imu"; });
  wiring_ = wire_up(config, environment_);
  EXPECT_EQ(meaning(10, {1}), "at 8.000000000 s: link 255 up");
  EXPECT_THAT(streams_of_first_edition(wiring_), ElementsAre(1, kNowhere));
}

TEST(FirstEditionReplayed, ComparesNoStreamThatIsNotConfigured) {
  const std::string blind = changed(
      changed(robot_configuration(), R"("imu": {"driver": "witmotion", "link": "imu"},)", ""),
      R"("imu": {"serial": "/dev/drover/imu", "baud": 115200},)", "");
  RecordingHeader header;
  const auto loaded = load_robot(blind);
  header.configuration = loaded.text;
  header.register_map = loaded.register_map;
  header.edition = 1;
  std::vector<std::uint8_t> file = written(header);
  // A cycle, and an output in which nothing is told, not even of the two streams that there were.
  for (const int byte : {3, 12, 2, 0, 1, static_cast<int>(RecordKind::output)})
    file.push_back(static_cast<std::uint8_t>(byte));
  const Replayed it = replay(file);
  EXPECT_EQ(it.inputs, 1U);
  EXPECT_EQ(it.verdict, Replayed::Verdict::unusable);
  EXPECT_THAT(it.note, ::testing::StartsWith("it has a damaged output"));
}

}  // namespace
}  // namespace drover::gateway
