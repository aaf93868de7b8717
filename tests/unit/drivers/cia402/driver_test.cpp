// What is a CiA 402 drive's own, beside what the conformance suite asks of every drive.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "drivers/cia402/driver.h"
#include "support/describe.h"
#include "unit/drivers/conformance/harness.h"

namespace drover::cia402 {
namespace {

using std::chrono::milliseconds;
using test::describe;
using test::parse_frame;

constexpr auto kRun = AxisRequest::run;
constexpr auto kRest = AxisRequest::rest;

Options options() {
  const DriverEntry* const entry = find_driver("cia402");
  Options all = test::example_options(*entry);
  all.set("acceleration", 0.0).set("deceleration", 0.0);
  return all.set("node", 5.0).set("velocity_units_per_rps", 600.0).set("gear_ratio", 1.0);
}

/// The registry's driver beside its twin.
struct Bench : test::CanBench {
  explicit Bench(const Options& with = options()) : CanBench(subject(with)) {}
  static test::Subject subject(const Options& with) {
    return {find_driver("cia402"), with, "cia402"};
  }
  void arm() {
    run(milliseconds(800), kRest);
    run(milliseconds(500), kRun, 0.0);
    ASSERT_EQ(status.state, AxisState::running) << status.reason.view();
  }
  bool has_sent(const std::string& frame) const {
    return std::any_of(sent.begin(), sent.end(),
                       [&](const CanFrame& each) { return describe(each) == frame; });
  }
};

FrameEffect effect_of(const std::string& frame) {
  const Settings settings = read_settings(options());
  return effect(parse_frame(frame), settings, steps_of(settings)).kind;
}

std::string refusal(const Options& with) {
  try {
    static_cast<void>(read_settings(with));
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return {};
}

TEST(Cia402Codec, HasTheBytesOfTheStandard) {
  EXPECT_EQ(describe(encode_command(5, {0x0F, 1000})), "205#0F00E8030000");
  EXPECT_EQ(describe(encode_command(5, {0x0F, -1000})), "205#0F0018FCFFFF");
  const auto status = decode_status(parse_frame("185#37161AFCFFFF"), 5);
  ASSERT_TRUE(status);
  EXPECT_EQ(status->state(), canopen::DriveState::operation_enabled);
  EXPECT_EQ(status->velocity, -998);
  const auto position = decode_position(parse_frame("285#00F0FFFF06FF"), 5, true);
  ASSERT_TRUE(position);
  EXPECT_EQ(position->counts, -4096);
  EXPECT_EQ(position->torque_permille, -250);
}

TEST(Cia402Codec, LeavesADriveInEachStateThatItMayBeIn) {
  using canopen::DriveState;
  EXPECT_EQ(keeping_controlword(DriveState::switch_on_disabled), 0x00);
  EXPECT_EQ(keeping_controlword(DriveState::ready_to_switch_on), 0x06);
  EXPECT_EQ(keeping_controlword(DriveState::switched_on), 0x07);
  EXPECT_EQ(keeping_controlword(DriveState::operation_enabled), 0x0F);
  EXPECT_EQ(keeping_controlword(DriveState::quick_stop_active), 0x02);
  EXPECT_EQ(keeping_controlword(DriveState::fault), 0x00);
}

TEST(Cia402Rules, ForbidFlashOtherNodesAndATargetBesideAnyOtherWord) {
  for (const char* const frame :
       {"605#2310100173617665", "605#231110016C6F6164", "605#23FF600064000000", "000#0100",
        "000#8105", "000#8005", "000#0104", "205#1F0000000000", "205#0F0100000000",
        "205#060064000000", "205#000064000000", "605#2B40600000000000", "77F#7F"})
    EXPECT_EQ(effect_of(frame), FrameEffect::forbidden) << frame;
  EXPECT_EQ(effect_of("205#0F0064000000"), FrameEffect::motion);
  for (const char* const frame : {"205#0F0000000000", "205#020000000000", "605#23FF600000000000"})
    EXPECT_EQ(effect_of(frame), FrameEffect::stop) << frame;
}

TEST(Cia402, WritesEachObjectInItsOrder) {
  Bench bench;
  bench.run(milliseconds(800), kRest);
  std::vector<std::string> writes;
  for (const CanFrame& frame : bench.sent)
    if (frame.id == 0x605 && frame.data[0] != 0x40) writes.push_back(describe(frame));
  const std::vector<std::string> expected = {
      "605#23FF600000000000", "605#2B17100064000000", "605#23161001C8007F00",
      "605#2B07600003000000", "605#2B5A600006000000", "605#2F60600003000000",
      "605#2300140105020080", "605#2F001402FF000000", "605#2F00160000000000",
      "605#2300160110004060", "605#230016022000FF60", "605#2F00160002000000",
      "605#2300140105020000", "605#23001801850100C0", "605#2F001802FF000000",
      "605#2B0018050A000000", "605#2F001A0000000000", "605#23001A0110004160",
      "605#23001A0220006C60", "605#2F001A0002000000", "605#2300180185010040",
      "605#23011801850200C0", "605#2F011802FF000000", "605#2B0118050A000000",
      "605#2F011A0000000000", "605#23011A0120006460", "605#2F011A0001000000",
      "605#2301180185020040"};
  EXPECT_EQ(writes, expected);
  EXPECT_TRUE(bench.has_sent("000#0105"));
  EXPECT_TRUE(bench.has_sent("77F#05")) << "the heartbeat that the drive watches";
}

TEST(Cia402, TellsTheEffortWhereTheRatedTorqueIsKnown) {
  Bench bench(options().set("rated_torque_Nm", 2.0).set("reversed", true));
  bench.arm();
  bench.inject(parse_frame("285#0000000006FF"));
  bench.inject(parse_frame("185#371600000000"));
  EXPECT_NEAR(bench.motion.effort_Nm, 0.5, 1e-9);
}

TEST(Cia402, NamesTheObjectThatTheDriveDoesNotHave) {
  for (const auto& [object, option] :
       {std::pair{"1016:01", "no_consumer_heartbeat"}, {"6007:00", "no_abort_option"}}) {
    // The driver writes the object all the same: its twin was told that there is none.
    test::Subject twins = Bench::subject(options().set(option, true));
    Bench bench;
    bench.twin = std::get<MakeCanTwin>(twins.entry->make_twin)(twins.options);
    bench.run(milliseconds(800), kRest);
    EXPECT_EQ(bench.status.state, AxisState::fault);
    EXPECT_EQ(bench.status.reason,
              "object " + std::string(object) + " cannot be written: no such object (06020000)");
    Bench without(twins.options);
    without.arm();
    EXPECT_FALSE(without.actuator->silence().stops) << option;
  }
}

TEST(Cia402, StopsByItselfAndHoldsWhenTheHeartbeatCeases) {
  Bench bench;
  bench.arm();
  bench.run(milliseconds(1000), kRun, 3.0);
  bench.driver_alive = false;
  for (int i = 0; i < 200; ++i) bench.step({kRun, 3.0});
  EXPECT_NEAR(bench.shaft.velocity_radps, 0, 0.02);
  EXPECT_TRUE(bench.shaft.energized);
}

/// The drive stopped meanwhile, and the next word that enables would set it going again.
TEST(Cia402, DoesNotGoOnAfterAPauseOfItsOwn) {
  Bench bench;
  bench.arm();
  bench.run(milliseconds(1000), kRun, 3.0);
  bench.now += milliseconds(400);
  bench.moving.clear();
  bench.run(milliseconds(1000), kRun, 3.0);
  EXPECT_LE(bench.moving.size(), 1U);
  EXPECT_EQ(bench.status.state, AxisState::fault);
  EXPECT_NEAR(bench.shaft.velocity_radps, 0, 0.02);
}

TEST(Cia402, ResetsAFaultByAnEdgeAndOnlyByANewRequest) {
  Bench bench;
  bench.arm();
  ASSERT_TRUE(bench.twin->set_fault("over_temperature", bench.now));
  bench.sent.clear();
  bench.run(milliseconds(500), kRun, 1.0);
  EXPECT_EQ(bench.status.state, AxisState::fault);
  EXPECT_NE(bench.status.reason.view().find("drive reports a fault"), std::string_view::npos)
      << bench.status.reason.view();
  EXPECT_EQ(bench.status.error_code, 0x4210U);
  EXPECT_FALSE(bench.has_sent("205#800000000000"));
  bench.run(milliseconds(50), kRest);
  bench.run(milliseconds(500), kRun, 0.0);
  EXPECT_TRUE(bench.has_sent("205#800000000000"));
  EXPECT_EQ(bench.status.state, AxisState::running) << bench.status.reason.view();
}

TEST(Cia402, ReadsTheErrorWhenItsEmergencyMessageWasLost) {
  Bench bench;
  bench.arm();
  bench.lost = id_of(Cob::emergency, 5);
  ASSERT_TRUE(bench.twin->set_fault("over_temperature", bench.now));
  bench.run(milliseconds(300), kRun, 1.0);
  EXPECT_EQ(bench.status.error_code, 0x4210U);
}

TEST(Cia402, IsGivenUpWhenItsNodeDiesAndRunsAgainOnlyByANewRequest) {
  Bench bench;
  bench.arm();
  bench.run(milliseconds(500), kRun, 2.0);
  ASSERT_TRUE(bench.twin->set_fault("dead", bench.now));
  bench.run(milliseconds(400), kRun, 2.0);
  EXPECT_EQ(bench.status.state, AxisState::unknown);
  EXPECT_EQ(bench.status.reason.view().substr(0, 13), "nothing heard");
  bench.moving.clear();
  ASSERT_TRUE(bench.twin->set_fault("", bench.now));
  bench.run(milliseconds(1500), kRun, 2.0);
  EXPECT_EQ(bench.status.state, AxisState::fault);
  EXPECT_TRUE(bench.moving.empty());
  bench.run(milliseconds(50), kRest);
  bench.run(milliseconds(500), kRun, 0.0);
  EXPECT_EQ(bench.status.state, AxisState::running) << bench.status.reason.view();
}

/// Holding the robot on a slope, or driving it down there; then its answers are lost, and it obeys.
struct MuteBench : Bench {
  explicit MuteBench(double radps = 0, const Options& with = options()) : Bench(with) {
    arm();
    load_Nm = 4;
    run(milliseconds(1500), kRun, radps);
    if (radps == 0) run(milliseconds(300), kRest);
  }
  void mute() {
    sent.clear();
    ASSERT_TRUE(twin->set_fault("silent", now));
  }
  std::ptrdiff_t zeros() const {
    return std::count_if(sent.begin(), sent.end(),
                         [](const CanFrame& each) { return describe(each) == "205#0F0000000000"; });
  }
};

/// The gateway's heartbeat goes on, so it would follow its last target for ever.
TEST(Cia402, IsStoppedAndHoldsOnWhileItsAnswersAreLost) {
  for (const double radps : {0.0, 3.0}) {
    MuteBench bench(radps);
    bench.mute();
    for (int i = 0; i < 600; ++i) {
      bench.step({radps == 0 || i > 200 ? kRest : kRun, radps});
      ASSERT_TRUE(bench.shaft.energized) << radps << " rad/s, cycle " << i;
    }
    EXPECT_GT(bench.zeros(), 400);
    EXPECT_EQ(bench.status.state, AxisState::unknown);
    EXPECT_NEAR(bench.shaft.velocity_radps, 0, 0.02) << "from " << radps << " rad/s";
    bench.twin->set_fault("", bench.now);
    for (int i = 0; i < 300; ++i) {
      bench.step({kRest, 0});
      ASSERT_TRUE(bench.shaft.energized) << "while it is set up anew, cycle " << i;
    }
    EXPECT_EQ(bench.status.state, AxisState::running) << bench.status.reason.view();
    EXPECT_NEAR(bench.shaft.velocity_radps, 0, 0.02);
  }
}

/// A person lets go of it, and no time-out would: it is told so, and nothing enables it any more.
TEST(Cia402, IsLetGoInSilenceWhenItIsReleased) {
  MuteBench bench;
  bench.mute();
  bench.run(milliseconds(1000), kRest);
  EXPECT_GT(bench.zeros(), 0);
  bench.run(milliseconds(1500), AxisRequest::idle);
  EXPECT_FALSE(bench.shaft.energized);
  bench.sent.clear();
  bench.run(milliseconds(500), kRest);
  EXPECT_EQ(bench.zeros(), 0) << "it is to hold nothing any more";
}

/// Its adapter was plugged in again meanwhile: nothing that it said counts any more.
TEST(Cia402, IsLetGoInSilenceBehindANewLinkToo) {
  MuteBench bench;
  bench.mute();
  bench.run(milliseconds(1000), kRest);
  bench.device->on_link_up(bench.now);
  bench.run(milliseconds(500), kRest);
  bench.run(milliseconds(1500), AxisRequest::idle);
  EXPECT_FALSE(bench.shaft.energized);
}

TEST(Cia402, IsLetGoByADriverThatNeverHeardItToo) {
  MuteBench before;
  before.mute();
  before.run(milliseconds(500), kRest);
  Bench bench;
  bench.twin = std::move(before.twin);
  bench.shafts[0] = before.shafts[0];
  bench.now = before.now;
  bench.load_Nm = 4;
  bench.held = true;
  bench.device->on_link_up(bench.now);
  bench.run(milliseconds(1000), kRest);
  ASSERT_TRUE(bench.shaft.energized);
  bench.held = false;  // as the gateway says of what a person lets go of
  bench.run(milliseconds(1500), AxisRequest::idle);
  EXPECT_FALSE(bench.shaft.energized);
}

/// What was not enabled yet is not enabled by what holds.
TEST(Cia402, IsNotArmedToItsEndInSilence) {
  Bench bench;
  bench.run(milliseconds(1500), kRest);
  for (int i = 0; i < 400 && !bench.has_sent("205#070000000000"); ++i) bench.step({kRun, 0});
  ASSERT_TRUE(bench.has_sent("205#070000000000"));
  ASSERT_FALSE(bench.has_sent("205#0F0000000000"));
  ASSERT_TRUE(bench.twin->set_fault("silent", bench.now));
  bench.run(milliseconds(1500), kRest);
  EXPECT_FALSE(bench.has_sent("205#0F0000000000"));
}

TEST(Cia402, IsNotFedInSilenceWhenItHoldsNothing) {
  Bench off;
  off.run(milliseconds(1500), kRest);
  ASSERT_EQ(off.status.state, AxisState::idle);
  MuteBench restarted;
  restarted.inject(parse_frame("705#00"));
  for (Bench* bench : {&off, static_cast<Bench*>(&restarted)}) {
    ASSERT_TRUE(bench->twin->set_fault("silent", bench->now));
    bench->run(milliseconds(500), kRest);
    bench->sent.clear();
    bench->run(milliseconds(1000), kRest);
    EXPECT_FALSE(bench->has_sent("205#0F0000000000"));
  }
}

TEST(Cia402, SomebodyElsesCommandsAreAFaultAndTheGuardsAreNot) {
  for (const char* const frame :
       {"205#0F0064000000", "205#000000000000", "205#020000000000", "000#8000"}) {
    Bench bench;
    bench.arm();
    for (const StopRound& round : bench.actuator->stop_recipe().rounds)
      for (const CanFrame& guards : round.frames) bench.inject(guards);
    bench.inject(parse_frame("77F#05"));
    bench.run(milliseconds(20), kRun, 1.0);
    ASSERT_EQ(bench.status.state, AxisState::running);
    bench.inject(parse_frame(frame));
    bench.run(milliseconds(20), kRun, 1.0);
    EXPECT_EQ(bench.status.state, AxisState::fault) << frame;
  }
}

TEST(Cia402Options, AreRefusedByName) {
  EXPECT_EQ(refusal(options()), "");
  EXPECT_EQ(refusal(options().set("gateway_node", 5.0)).substr(0, 12), "gateway_node");
  EXPECT_EQ(refusal(options().set("silence_ms", 20.0)).substr(0, 10), "silence_ms");
  EXPECT_EQ(refusal(options().set("quick_stop_option", 2.0)).substr(0, 17), "quick_stop_option");
  EXPECT_EQ(refusal(options().set("velocity_units_per_rps", 1.0)).substr(0, 22),
            "velocity_units_per_rps");
  EXPECT_EQ(refusal(options().set("velocity_units_per_rps", 1e8)).substr(0, 7), "max_rpm");
}

/// One that ramps more slowly than the gateway looks like a robot that does not stop: its power is
/// cut, and a person has to come.
TEST(Cia402Options, AskForTheDrivesOwnRamps) {
  for (const char* name : {"acceleration", "deceleration"}) {
    Options told(option_table());
    told.set("node", 5.0).set("velocity_units_per_rps", 600.0).set("gear_ratio", 1.0);
    for (const char* other : {"acceleration", "deceleration"})
      if (std::string_view(other) != name) told.set(other, 0.0);
    EXPECT_THAT(refusal(told), testing::HasSubstr(name));
    EXPECT_EQ(refusal(told.set(name, 0.0)), "");
  }
}

}  // namespace
}  // namespace drover::cia402
