// Joint commands that are malformed or impossible, from the broker's bytes to the frames that would
// leave: each is refused in its own words, and nothing moves by it.
#include <gtest/gtest.h>

#include <limits>

#include "json/json_text.h"
#include "runtime/outlets.h"
#include "unit/gateway/arm_bench.h"
#include "unit/publish/aimrt/wire.h"

namespace drover::runtime {
namespace {

using namespace std::chrono_literals;
using namespace std::string_literals;

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr Duration kWall = 1'700'000'000s;  // minus the monotonic clock

/// Two wheels, and a joint for each mode that one can follow.
constexpr auto kRobot = R"({
  "links": {"can0": {"can": "can0"}, "can1": {"can": "can1"}, "panel": {"gpio": "chip0"}},
  "devices": {
    "wheels": {"driver": "zlac8015d", "link": "can0",
      "joints": {"left": {"channel": "left"}, "right": {"channel": "right"}}},
    "elbow": {"driver": "damiao", "link": "can1", "options": {"id": 1, "model": "DM4310"}},
    "mast": {"driver": "damiao", "link": "can1", "options": {"id": 2, "model": "DM4310"}},
    "roll": {"driver": "damiao", "link": "can1", "options": {"id": 3, "model": "DM4310"}},
    "grip": {"driver": "damiao", "link": "can1", "options": {"id": 4, "model": "DM4310"}},
    "estop": {"driver": "gpio_line", "link": "panel", "line": "a", "is": "estop"}},
  "groups": {
    "base": {"kind": "differential", "wheel_radius_m": 0.085, "track_m": 0.42,
             "left": ["left"], "right": ["right"], "hold": "brake"},
    "arm": {"joints": {
      "elbow": {"min_rad": -1, "max_rad": 1, "max_velocity_radps": 1, "max_effort_Nm": 5,
                "stiffness_Nmprad": 40},
      "mast": {"follows": "position", "min_rad": -1, "max_rad": 1, "max_velocity_radps": 1,
               "max_effort_Nm": 5, "stiffness_Nmprad": 40},
      "roll": {"follows": "velocity", "min_rad": -1, "max_rad": 1, "max_velocity_radps": 1,
               "max_effort_Nm": 5, "stiffness_Nmprad": 40},
      "grip": {"follows": "effort", "min_rad": -1, "max_rad": 1, "max_velocity_radps": 1,
               "max_effort_Nm": 5, "stiffness_Nmprad": 40}}}},
  "guard": {"required": false},
  "mqtt": {"host": "127.0.0.1", "port": 1883}
})";
constexpr AxisId kElbow = 2;
constexpr std::size_t kMotors = 4;

struct Entry {
  std::string name;
  double position = 0, velocity = 0, effort = 0, stiffness = 0, damping = 0;
};
struct Sent {
  std::vector<Entry> joints;
  Duration age{};  ///< of its stamp; it has one where that is not 0
};

void number(json::JsonText& out, const char* key, double value) {
  out.key(key);
  if (std::isfinite(value)) return void(out.number(value));
  out.text(std::isnan(value) ? "NaN" : value > 0 ? "Infinity" : "-Infinity");
}

std::string as_json(const Sent& message, Duration wall) {
  json::JsonText out;
  out.open('{');
  if (message.age != Duration{})
    out.key("header").open('{').key("time_stamp").integer((wall - message.age).count()).close('}');
  out.key("joints").open('[');
  for (const Entry& joint : message.joints) {
    out.open('{').key("name").text(joint.name);
    number(out, "position", joint.position);
    number(out, "velocity", joint.velocity);
    number(out, "effort", joint.effort);
    number(out, "stiffness", joint.stiffness);
    number(out, "damping", joint.damping);
    out.close('}');
  }
  out.close(']').close('}');
  return "\x04json\0"s + out.take();
}

std::string as_protobuf(const Sent& message, Duration wall) {
  std::string bytes;
  if (message.age != Duration{})
    bytes = test::stamp(static_cast<std::uint64_t>((wall - message.age).count()));
  for (const Entry& joint : message.joints)
    bytes += test::joint_entry(joint.name, joint.position, joint.velocity, joint.effort,
                               joint.stiffness, joint.damping);
  return test::in_packet(bytes);
}

const Entry kGood{"elbow", 0.5, 0, 0, 40, 1};

/// What is said of numbers and names is said of either content.
struct Impossible {
  Sent message;
  const char* why;
};
const std::vector<Impossible>& impossible() {
  static const std::vector<Impossible> all{
      // Counts and names.
      {{{}}, "it names no joint"},
      {{{kGood, {"mast"}, {"roll"}, {"grip"}, {"left"}, {"right"}, {"seventh"}}},
       "it names 7 joints, this robot has 6"},
      {{{kGood, kGood}}, "joint 'elbow': it is named twice"},
      {{{{"left", 0, 1}, kGood, {"left"}}}, "joint 'left': it is named twice"},
      {{{{"elbov", 0.5, 0, 0, 40, 1}}}, "joint 'elbov': there is no such joint"},
      {{{kGood, {"wrist"}}}, "joint 'wrist': there is no such joint"},
      {{{{""}}}, "joint '': there is no such joint"},
      {{{{"Elbow", 0.5, 0, 0, 40, 1}}}, "joint 'Elbow': there is no such joint"},
      {{{{"arm"}}}, "joint 'arm': there is no such joint"},
      {{{{"el\nbow"}}}, "joint 'el?bow': there is no such joint"},
      // No numbers.
      {{{{"elbow", kNaN, 0, 0, 40, 1}}}, "joint 'elbow': position is NaN"},
      {{{{"elbow", 0.5, kNaN, 0, 40, 1}}}, "joint 'elbow': velocity is NaN"},
      {{{{"elbow", 0.5, 0, kNaN, 40, 1}}}, "joint 'elbow': effort is NaN"},
      {{{{"elbow", 0.5, 0, 0, kNaN, 1}}}, "joint 'elbow': stiffness is NaN"},
      {{{{"elbow", 0.5, 0, 0, 40, kNaN}}}, "joint 'elbow': damping is NaN"},
      {{{{"elbow", kInfinity, 0, 0, 40, 1}}}, "joint 'elbow': position is infinite"},
      {{{{"elbow", 0.5, -kInfinity, 0, 40, 1}}}, "joint 'elbow': velocity is infinite"},
      {{{{"elbow", 0.5, 0, 0, kInfinity, 1}}}, "joint 'elbow': stiffness is infinite"},
      {{{kGood, {"left", kNaN, 1}}}, "joint 'left': position is NaN"},
      {{{kGood, {"mast", 0, 0, kInfinity}}}, "joint 'mast': effort is infinite"},
      // Beyond all limits.
      {{{{"elbow", 1e6, 0, 0, 40, 1}}},
       "joint 'elbow': position 1e+06 is beyond the limit of 100000"},
      {{{{"elbow", 0.5, -1e6, 0, 40, 1}}},
       "joint 'elbow': velocity -1e+06 is beyond the limit of 100000"},
      {{{{"elbow", 0.5, 0, 1e300, 40, 1}}},
       "joint 'elbow': effort 1e+300 is beyond the limit of 100000"},
      {{{{"elbow", 0.5, 0, 0, 1e9, 1}}},
       "joint 'elbow': stiffness 1e+09 is beyond the limit of 100000"},
      {{{{"elbow", 0.5, 0, 0, 40, 2e5}}},
       "joint 'elbow': damping 200000 is beyond the limit of 100000"},
      {{{{"right", 0, 2e5}}}, "joint 'right': velocity 200000 is beyond the limit of 100000"},
      // Below zero.
      {{{{"elbow", 0.5, 0, 0, -40, 1}}}, "joint 'elbow': stiffness -40 is negative"},
      {{{{"elbow", 0.5, 0, 0, 40, -1}}}, "joint 'elbow': damping -1 is negative"},
      {{{{"roll", 0, 0.5, 0, 0, -1}}}, "joint 'roll': damping -1 is negative"},
      // What the joint does not follow.
      {{{{"left", 0, 1, 2}}}, "joint 'left': effort is 2, but this drive follows velocity only: 0"},
      {{{{"left", 0.5, 1, 0, 40}}},
       "joint 'left': stiffness is 40, but this drive follows velocity only: 0"},
      {{{{"mast", 0.5, 0, 2}}},
       "joint 'mast': effort is 2, but it follows a position, as stiffly as is configured: 0"},
      {{{{"mast", 0.5, 0, 0, 40}}},
       "joint 'mast': stiffness is 40, but it follows a position, as stiffly as is configured: 0"},
      {{{{"mast", 0.5, 0, 0, 0, 1}}},
       "joint 'mast': damping is 1, but it follows a position, as stiffly as is configured: 0"},
      {{{{"roll", 0, 0.5, 2}}}, "joint 'roll': effort is 2, but it follows a velocity: 0"},
      {{{{"roll", 0.5, 0, 0, 40}}}, "joint 'roll': stiffness is 40, but it follows a velocity: 0"},
      {{{{"grip", 0, 0.5, 1}}}, "joint 'grip': velocity is 0.5, but it follows an effort: 0"},
      {{{{"grip", 0.5, 0, 1, 40}}}, "joint 'grip': stiffness is 40, but it follows an effort: 0"},
      {{{kGood, {"left", 0, 1}, {"grip", 0, 1}}},
       "joint 'grip': velocity is 1, but it follows an effort: 0"},
      // Of another time.
      {{{kGood}, 300ms}, "time_stamp is 300 ms old, 250 ms are allowed"},
      {{{kGood}, 24h}, "time_stamp is 86400000 ms old, 250 ms are allowed"},
      {{{kGood}, -2s}, "time_stamp is 2000 ms ahead of the robot's clock"},
  };
  return all;
}

/// No message at all, or one that the content's grammar refuses.
struct Malformed {
  std::string payload;
  const char* why;
};
std::string json_packet(const std::string& text) {
  return "\x04json\0"s + text;
}
const std::vector<Malformed>& malformed() {
  static const std::vector<Malformed> all{
      {"", "the packet ends inside its content type"},
      {"\x09json", "the packet ends inside its content type"},
      {"\x02pb", "the packet has no number of context pairs"},
      {"\x02pb\x01\x05\x00k"s, "the packet ends inside its context"},
      {"\x03xml\0<joints/>"s, "the content type 'xml' is neither pb nor json"},
      {std::string(20'000, ' '), "the packet is longer than 16 KiB"},
      {test::in_packet("\xff"), "the message is no JointCommand"},
      {test::in_packet(test::joint_entry("elbow", 0.5, 0, 0, 40, 1).substr(0, 30)),
       "the message is no JointCommand"},
      {test::in_packet(test::hex("12 09 0a 05 65 6c 62 6f 77 10 01")),
       "the message is no JointCommand: joints[0].position is no double"},
      {test::in_packet(test::hex("12 03 0a 01 ff")), "the message is no JointCommand"},
      {json_packet("[]"), "the JSON is no JointCommand: it is no object"},
      {json_packet(R"({"joint": []})"), "the JSON is no JointCommand: joint is no field of it"},
      {json_packet(R"({"joints": {}})"), "the JSON is no JointCommand: joints is no list"},
      {json_packet(R"({"joints": [null]})"), "the JSON is no JointCommand: joints[0] is no object"},
      {json_packet(R"({"joints": [{"name": 7}]})"),
       "the JSON is no JointCommand: joints[0].name is no text"},
      {json_packet(R"({"joints": [{"name": "elbow", "position": "half"}]})"),
       "the JSON is no JointCommand: joints[0].position is no number"},
      {json_packet(R"({"joints": [{"name": "elbow", "angle": 0.5}]})"),
       "the JSON is no JointCommand: joints[0].angle is no field of it"},
      {json_packet(R"({"header": {"time_stamp": -1}, "joints": []})"),
       "the JSON is no JointCommand: header.time_stamp is no whole number"},
  };
  return all;
}

/// The robot with the outlet that hears its joint commands.
class RefusedJointCommands : public ::testing::Test {
 protected:
  RefusedJointCommands() {
    outlets = make_outlets(config, service, commands, [](Time) { return ""s; });
    bench.cycles(400);
  }
  Duration wall() const { return kWall + bench.now.time_since_epoch(); }

  /// Why it was refused; empty: it was not.
  std::string send(const std::string& payload) {
    publish::Actions actions;
    const publish::Arrival arrival{.wall = wall()};
    for (auto& outlet : outlets)
      for (const auto& topic : outlet->wants()) {
        if (!topic.name.ends_with("JointCommand")) continue;
        EXPECT_TRUE(outlet->on_message(topic.name, payload, arrival, bench.now, actions));
      }
    std::string why = "nothing was said of it";
    for (const publish::Action& action : actions) {
      const auto* const command = std::get_if<Command>(&action);
      if (command == nullptr) continue;
      const auto* const refused = std::get_if<JointTargetsRefused>(&command->body);
      why = refused == nullptr ? "" : std::string(refused->reason.view());
      bench.command(command->body);
    }
    return why;
  }
  /// As a stream that would be followed if it were none of these: 0.4 s at 100 Hz.
  template <class Payload>
  void stream(const Payload& payload, const char* why) {
    const auto before = places();
    for (int i = 0; i < 40; ++i) {
      ASSERT_EQ(send(payload()), why);
      cycle();
      cycle();
    }
    for (std::size_t i = 0; i < kMotors; ++i) EXPECT_NEAR(places()[i], before[i], 0.002) << why;
    EXPECT_EQ(bench.gateway.snapshot().joint_command.reason.view(), why);
  }
  template <class Look>
  void each(const Look& look) {
    for (const Impossible& one : impossible()) {
      look([&] { return as_protobuf(one.message, wall()); }, one.why);
      look([&] { return as_json(one.message, wall()); }, one.why);
    }
    for (const Malformed& one : malformed()) look([&] { return one.payload; }, one.why);
  }
  void cycle() {
    bench.cycle();
    moving += moving_frames();
  }
  /// Of all that would leave now, what may move something, by the drivers' own word.
  std::size_t moving_frames() const {
    std::size_t count = 0;
    for (const auto& slot : bench.gateway.wiring().slots) {
      if (slot.made.actuator == nullptr) continue;
      for (const CanFrame& frame : bench.gateway.output().frames[slot.link]) {
        const auto& rules = slot.made.actuator->rules();
        const bool its = std::any_of(rules.begin(), rules.end(), [&](const FrameRule& rule) {
          return engine::matches(rule, frame);
        });
        if (its && slot.made.actuator->effect(frame, bench.now).kind == FrameEffect::motion)
          ++count;
      }
    }
    return count;
  }
  std::vector<double> places() const {
    std::vector<double> all;
    for (const Shaft& shaft : bench.shafts) all.push_back(shaft.position_rad);
    return all;
  }
  void good_stream(int messages, double position_rad) {
    Sent message{{{"elbow", position_rad, 0, 0, 40, 1}}};
    for (int i = 0; i < messages; ++i) {
      ASSERT_EQ(send(as_protobuf(message, wall())), "");
      cycle();
      cycle();
    }
  }

  config::DroverConfig config = config::load_text(kRobot).config;
  publish::CommandService service{{}, {}};
  publish::aimrt::JointCommands commands{joint_commands_config(config)};
  std::vector<std::unique_ptr<publish::Outlet>> outlets;
  gateway::ArmBench bench{kRobot, kElbow, "zlac8015d", kMotors};
  std::size_t moving = 0;
};

TEST_F(RefusedJointCommands, AreFiftyAndMore) {
  EXPECT_GE(impossible().size() + malformed().size(), 50U);
}

/// Who may be so slow shows only then that he was there before.
TEST_F(RefusedJointCommands, AreThoseOfAWayThatHasJustComeForAsLongAsTheyMayBeApart) {
  EXPECT_EQ(joint_commands_config(config).just_came, publish::kJustCame);
  config.engine.groups[0].joints[0].timeout_s = 0.8;
  const auto slow = joint_commands_config(config);
  EXPECT_EQ(slow.just_came, 800ms);
  EXPECT_EQ(slow.rules.joints.at(kElbow).timeout, 800ms) << "and have their owner for as long";
}

TEST_F(RefusedJointCommands, MoveNothingThatRests) {
  std::uint64_t sent = 0;
  each([&](const auto& payload, const char* why) {
    sent += 40;
    ASSERT_NO_FATAL_FAILURE(stream(payload, why));
    EXPECT_EQ(moving, 0U) << why;
    EXPECT_EQ(bench.arm().state, GroupState::idle) << why;
  });
  const Snapshot& seen = bench.gateway.snapshot();
  EXPECT_EQ(seen.joint_command.refused, sent);
  EXPECT_EQ(seen.joint_command.accepted, 0U);
  EXPECT_EQ(seen.nav.owner, Owner::nobody);
  for (const AxisSnapshot& axis : seen.axes) EXPECT_EQ(axis.state, AxisState::idle);
  // The same robot follows what is none of these.
  good_stream(300, 0.5);
  EXPECT_NEAR(bench.shafts[0].position_rad, 0.5, 0.03);
  EXPECT_GT(moving, 0U);
}

TEST_F(RefusedJointCommands, LeaveWhatIsHeldWhereItIs) {
  good_stream(300, 0.5);
  for (int i = 0; i < 400; ++i) cycle();
  ASSERT_EQ(bench.arm().state, GroupState::holding);
  each([&](const auto& payload, const char* why) {
    ASSERT_NO_FATAL_FAILURE(stream(payload, why));
    EXPECT_EQ(bench.arm().state, GroupState::holding) << why;
  });
  EXPECT_NEAR(bench.shafts[0].position_rad, 0.5, 0.03);
  EXPECT_EQ(bench.gateway.snapshot().nav.owner, Owner::nobody);
}

}  // namespace
}  // namespace drover::runtime
