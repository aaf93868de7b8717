#include "gateway/gateway.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <optional>
#include <string>
#include <vector>

#include "config/load.h"
#include "drover/bytes.h"
#include "support/describe.h"

namespace drover::gateway {
namespace {

using namespace std::chrono_literals;

constexpr auto kConfig = R"({
  "links": {"can0": {"can": "can0"}, "gnss": {"serial": "/dev/drover/gnss"},
            "panel": {"gpio": "chip0"}},
  "devices": {
    "left": {"driver": "odrive", "link": "can0",
             "options": {"node": 1, "watchdog_timeout_s": 0.2}},
    "right": {"driver": "odrive", "link": "can0", "options": {"node": 2},
              "accept": ["no_watchdog"]},
    "gnss": {"driver": "nmea0183", "link": "gnss"},
    "estop": {"driver": "gpio_line", "link": "panel", "line": "a", "is": "estop"},
    "bumper": {"driver": "gpio_line", "link": "panel", "line": "b", "is": "bumper"}},
  "groups": {"base": {"kind": "skid_steer", "wheel_radius_m": 0.165, "track_m": 0.6,
                      "left": ["left"], "right": ["right"], "hold": "brake"}},
  "mqtt": {"host": "127.0.0.1", "port": 1883}
})";

constexpr auto kChassis = R"({
  "accept": ["no_estop", "no_relay"],
  "links": {"base": {"serial": "/dev/drover/base"}, "gnss": {"serial": "/dev/drover/gnss"}},
  "devices": {
    "chassis": {"driver": "gt01_serial", "link": "base", "accept": ["no_watchdog"]},
    "gnss": {"driver": "nmea0183", "link": "gnss"}},
  "groups": {"base": {"kind": "twist", "device": "chassis", "track_m": 0.725,
                      "hold": "level_ground_only"}},
  "mqtt": {"host": "127.0.0.1", "port": 1883}
})";

/// Two drives that talk, on one bus.
class Bench {
 public:
  Bench() : gateway(config::load_text(kConfig).config) {
    apply(LinkUp{0});
    for (int i = 0; i < 20; ++i) cycle();
  }
  void apply(const InputBody& body) { gateway.apply({now, body}); }
  void cycle(bool drives_talk = true) {
    now += 5ms;
    if (drives_talk)
      for (const char* frame : said) apply(FrameHeard{0, test::parse_frame(frame)});
    LevelsRead released;
    released.link = 2;
    (void)released.levels.push_back(true);
    (void)released.levels.push_back(true);
    apply(released);
    apply(Tick{true, false});
  }
  bool told(std::string_view what) const {
    for (const auto& reason : gateway.snapshot().why)
      if (reason.view().find(what) != std::string_view::npos) return true;
    return false;
  }
  /// Heartbeat and estimates of both drives: in closed loop and at rest.
  std::array<const char*, 4> said{"021#0000000008000000", "029#0000000000000000",
                                  "041#0000000008000000", "049#0000000000000000"};
  Time now{100s};
  Gateway gateway;
};

/// Set_Input_Vel of node 1 in the last cycle, turn/s; nothing when there was none.
std::optional<float> setpoint_turnps(const Gateway& gateway) {
  for (const CanFrame& frame : gateway.output().frames[0])
    if (frame.id == 0x02D && !frame.remote) return load_le_float(frame.data);
  return std::nullopt;
}

CanFrame bus_off() {
  CanFrame frame;
  frame.error = true;
  frame.id = 0x40;
  frame.len = 8;
  return frame;
}

/// Its bus works, and something else hangs on it.
TEST(Gateway, TellsWhoSpeaksOnABusWhoseDrivesAreSilent) {
  Bench bench;
  bench.said = {"141#00", "142#00", "02D#0000000000000000", "04D#0000000000000000"};
  for (int i = 0; i < 590; ++i) bench.cycle();
  EXPECT_FALSE(bench.told("frames of other devices"));
  for (int i = 0; i < 40; ++i) bench.cycle();
  EXPECT_TRUE(
      bench.told("silent; frames of other devices come on can0 (0x141, 0x142): are the "
                 "buses swapped, or its id wrong?"));
  for (int i = 0; i < 250; ++i) bench.cycle(false);
  EXPECT_FALSE(bench.told("frames of other devices")) << "they have ceased";
}

/// One drive is there, and another has an id that nobody is configured for.
TEST(Gateway, AsksForTheIdOfADriveThatIsSilentBesideOneThatIsHeard) {
  Bench bench;
  bench.said = {"021#0000000008000000", "029#0000000000000000", "061#0000000008000000",
                "069#0000000000000000"};
  for (int i = 0; i < 700; ++i) bench.cycle();
  EXPECT_TRUE(
      bench.told("frames of other devices come on can0 (0x061, 0x069): is its id another "
                 "one?"));
}

/// They are there, and what is wrong with them their driver knows.
TEST(Gateway, TellsOfNoStrangersInsteadOfADriveThatSaysTooLittle) {
  Bench bench;
  bench.said = {"021#0000000008000000", "041#0000000008000000", "141#00", "142#00"};
  for (int i = 0; i < 700; ++i) bench.cycle();
  EXPECT_FALSE(bench.told("frames of other devices"));
}

TEST(Gateway, StopsForABusThatIsOffBeforeItsDrivesAreSilent) {
  Bench bench;
  EXPECT_FALSE(bench.told("wheel left"));
  bench.apply(FrameHeard{0, bus_off()});
  bench.cycle(false);
  EXPECT_TRUE(bench.told("no drive answers (wheel left: can0 is bus-off"));
  bench.cycle();
  EXPECT_FALSE(bench.told("bus-off")) << "it hears frames again";
}

/// At rest the drives hear zeros all the time; those are no part of the ramp.
TEST(Gateway, SendsTheRampOfAWheelThatItCatches) {
  Bench bench;
  // Both idle, and rolling with 1 turn/s.
  bench.said = {"021#0000000001000000", "029#000000000000803F", "041#0000000001000000",
                "049#000000000000803F"};
  for (int i = 0; i < 200; ++i) bench.cycle();
  bench.apply(CommandGiven{{.id = {}, .received = bench.now, .body = ArmHold{}}});
  std::vector<float> ramp;
  for (int i = 0; i < 40; ++i) {
    bench.cycle();
    const auto sent = setpoint_turnps(bench.gateway);
    if (sent) ramp.push_back(*sent);
    // The drives obey: in closed loop, and as fast as they are told.
    if (i == 10)
      bench.said = {"021#0000000008000000", "029#000000000000803F", "041#0000000008000000",
                    "049#000000000000803F"};
  }
  ASSERT_GT(ramp.size(), 5U);
  EXPECT_FLOAT_EQ(ramp.front(), 1);
  EXPECT_TRUE(std::is_sorted(ramp.rbegin(), ramp.rend()));
  EXPECT_GT(ramp.back(), 0);
  EXPECT_LT(ramp.back(), 1);
  EXPECT_EQ(bench.gateway.refused(0), 0U);
}

TEST(Gateway, TellsOfABusThatIsGoneUntilItIsBack) {
  Bench bench;
  bench.apply(LinkLost{0, "can0: lost (No such device)"});
  bench.cycle();
  EXPECT_TRUE(bench.told("wheel left: can0: lost"));
  bench.apply(LinkUp{0});
  bench.cycle();
  EXPECT_FALSE(bench.told("lost"));
}

/// The guard has lost it, too, and is not equipped: that word comes after the cause.
TEST(Gateway, TellsFirstOfALostLineOnWhichTheBaseHangs) {
  Gateway gateway(config::load_text(kChassis).config);
  Time now{100s};
  const auto why = [&](bool guard_alive) {
    gateway.apply({now += 5ms, Tick{guard_alive, false}});
    return std::string(gateway.snapshot().why[0].view());
  };
  gateway.apply({now, LinkUp{0}});
  EXPECT_EQ(why(true).find("lost"), std::string::npos);
  gateway.apply({now, LinkLost{0, "base: lost (Input/output error)"}});
  EXPECT_EQ(why(false), "the base: base: lost (Input/output error)");
  gateway.apply({now, LinkUp{0}});
  EXPECT_EQ(why(true).find("lost"), std::string::npos);
}

TEST(Gateway, TakesABusThatTakesNoFramesForLost) {
  Bench bench;
  bench.apply(FramesSent{0, 40, 0});
  for (int i = 1; i <= 19; ++i) {
    bench.apply(FramesSent{0, 40, static_cast<std::uint64_t>(4 * i)});
    bench.cycle();
  }
  EXPECT_FALSE(bench.told("takes no frames")) << "for less than 0.1 s";
  for (int i = 20; i <= 22; ++i) {
    bench.apply(FramesSent{0, 40, static_cast<std::uint64_t>(4 * i)});
    bench.cycle();
  }
  EXPECT_TRUE(bench.told("no drive answers (wheel left: can0 takes no frames"));
  bench.apply(FramesSent{0, 44, 88});
  bench.cycle();
  EXPECT_FALSE(bench.told("takes no frames"));
}

TEST(Gateway, NamesWhoElseCommandsItsDrivesThoughTheyOnlySayZero) {
  Bench bench;
  for (int i = 0; i < 80; ++i) {
    bench.apply(FrameHeard{0, test::parse_frame("04D#0000000000000000")});
    bench.cycle();
  }
  EXPECT_TRUE(bench.told("somebody else commands the drives: id 0x04D on can0"));
  for (int i = 0; i < 250; ++i) bench.cycle();
  EXPECT_FALSE(bench.told("somebody else"));
}

TEST(Gateway, TrustsNothingThatWasHeardBeforeTheComputerSlept) {
  Bench bench;
  EXPECT_FALSE(bench.told("wheel left"));
  bench.apply(Suspended{12});
  bench.apply(Tick{true, false});
  EXPECT_TRUE(bench.told("the computer slept for 12.0 s"));
  EXPECT_TRUE(bench.told("no drive answers"));
  EXPECT_TRUE(bench.told("line e-stop"));
  for (int i = 0; i < 300; ++i) bench.cycle();
  EXPECT_FALSE(bench.told("slept"));
  EXPECT_FALSE(bench.told("no drive answers"));
}

TEST(Gateway, TellsThatItWasHeldUpItselfAndGoesOnBelievingWhatItHears) {
  Bench bench;
  bench.apply(HeldUp{0.31});
  bench.apply(Tick{true, false});
  EXPECT_TRUE(bench.told("droverd stood still for 0.31 s"));
  EXPECT_FALSE(bench.told("no drive answers"));
  EXPECT_FALSE(bench.told("line e-stop"));
  for (int i = 0; i < 300; ++i) bench.cycle();
  EXPECT_FALSE(bench.told("stood still"));
}

TEST(Gateway, TakesTheGuardsZerosForTheGuards) {
  Bench bench;
  for (int i = 0; i < 200; ++i) {
    bench.apply(FrameHeard{0, test::parse_frame("04D#0000000000000000")});
    bench.apply(Tick{true, i < 100});
    bench.now += 5ms;
  }
  EXPECT_FALSE(bench.told("somebody else"));
}

TEST(Gateway, ForgivesAShortRefusal) {
  Bench bench;
  for (std::uint64_t i = 0; i < 100; ++i) {
    bench.apply(FramesSent{0, 40 + i / 10, i});  // one frame of eleven goes out
    bench.cycle();
    EXPECT_FALSE(bench.told("takes no frames"));
  }
}

TEST(Gateway, NamesTheDrivesThatNothingStopsWhenFramesCease) {
  Bench bench;
  const auto notes = bench.gateway.cautions();
  ASSERT_EQ(notes.size(), 1U);
  EXPECT_EQ(notes[0],
            "drive right keeps its last velocity for ever: the drive has no watchdog set");
}

TEST(Gateway, IgnoresLinksAndSlotsThatThereAreNot) {
  Bench bench;
  const auto link = static_cast<LinkId>(bench.gateway.wiring().links.size());
  const auto slot = static_cast<SlotId>(bench.gateway.wiring().slots.size());
  for (const std::uint8_t more : {std::uint8_t{0}, std::uint8_t{100}}) {
    const auto nowhere = static_cast<std::uint8_t>(link + more);
    bench.apply(FrameHeard{nowhere, bus_off()});
    bench.apply(FrameHeard{nowhere, test::parse_frame("021#0000000008000000")});
    bench.apply(BytesHeard{nowhere, {}});
    LevelsRead levels;
    levels.link = nowhere;
    (void)levels.levels.push_back(false);
    bench.apply(levels);
    bench.apply(LinkUp{nowhere});
    bench.apply(LinkLost{nowhere, "gone"});
    bench.apply(FramesSent{nowhere, 1, 1});
    RegistersRead read;
    read.slot = static_cast<SlotId>(slot + more);
    bench.apply(read);
    bench.apply(RegistersFailed{read.slot, 0, RegisterFailure::silent, 0});
  }
  bench.cycle();
  EXPECT_FALSE(bench.told("wheel left"));
  EXPECT_FALSE(bench.told("line"));
}

/// Bytes on the bus, frames on the stream, levels at the receiver: nobody there hears such a thing.
TEST(Gateway, IgnoresWhatALinkCannotCarry) {
  Bench bench;
  const std::uint8_t byte = 0x24;
  for (LinkId link = 0; link < bench.gateway.wiring().links.size(); ++link) {
    if (bench.gateway.wiring().links[link].wire != Wire::bytes)
      bench.apply(BytesHeard{link, {&byte, 1}});
    if (bench.gateway.wiring().links[link].wire != Wire::can) {
      bench.apply(FrameHeard{link, bus_off()});
      bench.apply(FramesSent{link, 1, 1});
    }
    LevelsRead levels;
    levels.link = link;
    (void)levels.levels.push_back(false);
    if (bench.gateway.wiring().links[link].wire != Wire::levels) bench.apply(levels);
  }
  for (SlotId slot = 0; slot < bench.gateway.wiring().slots.size(); ++slot) {
    RegistersRead read;
    read.slot = slot;
    bench.apply(read);
  }
  bench.cycle();
  EXPECT_FALSE(bench.told("wheel left"));
  EXPECT_FALSE(bench.told("line"));
}

TEST(Gateway, TellsTheGuardHowEachDriveOfABusIsStopped) {
  Bench bench;
  const auto duties = bench.gateway.duties();
  ASSERT_EQ(duties.size(), bench.gateway.wiring().links.size());
  EXPECT_EQ(duties[0].messages_per_cycle, 4U);
  const auto& recipes = duties[0].stops;
  ASSERT_EQ(recipes.size(), 2U);
  EXPECT_EQ(recipes[0].recipe.rounds[0].frames[0].id, 0x02DU);
  EXPECT_EQ(recipes[1].recipe.rounds[0].frames[0].id, 0x04DU);
  EXPECT_EQ(recipes[1].recipe.period, 10ms);
  EXPECT_FALSE(recipes[0].held_by_daemon);
  EXPECT_FALSE(recipes[0].runs_on) << "its watchdog stops it";
  EXPECT_TRUE(recipes[1].runs_on) << "it has none";
}

TEST(StreamOutput, TakesAPacketWholeOrNotAtAll) {
  StreamOutput waiting;
  Packet packet;
  packet.resize(kMaxPacket);
  std::size_t dropped = 0;
  for (int i = 0; i < 8; ++i) dropped += waiting.add(packet);
  EXPECT_EQ(dropped, kMaxPacket);
  EXPECT_EQ(waiting.bytes.size(), 7 * kMaxPacket);
}

TEST(StreamOutput, GathersWhatADriverSaysUntilTheNextCycle) {
  StreamOutput waiting;
  DriverOut said;
  for (const std::uint8_t byte : {1, 2, 3}) EXPECT_TRUE(said.bytes.push_back(byte));
  EXPECT_EQ(waiting.add(said), 0U);
  said.clear();
  said.reopen_baud = 9600;
  EXPECT_EQ(waiting.add(said), 0U);
  EXPECT_EQ(waiting.bytes.size(), 3U);
  EXPECT_EQ(waiting.reopen_baud, 9600U);
}

TEST(StreamOutput, CountsTheBytesThatFindNoRoom) {
  StreamOutput waiting;
  DriverOut said;
  for (int i = 0; i < 300; ++i) EXPECT_TRUE(said.bytes.push_back(0x55));
  EXPECT_EQ(waiting.add(said), 0U);
  EXPECT_EQ(waiting.add(said), 600U - waiting.bytes.capacity());
}

}  // namespace
}  // namespace drover::gateway
