// Every check of a mission finds the fault it is for, in a small record made by hand.
#include "mission/conduct.h"

#include <gmock/gmock.h>

#include <unistd.h>
#include <array>
#include <cmath>
#include <fstream>

#include <functional>

namespace drover::mission {
namespace {

using nlohmann::json;
using testing::IsEmpty;
using testing::Not;

const auto kScenario = json::parse(R"({
  "can": {"can0": {"kind": "vcan"}},
  "origin": {"latitude_deg": 23.0, "longitude_deg": 113.0, "altitude_m": 20},
  "gnss": {"antenna": {"x_m": 0, "y_m": 0}}})");

std::string stamp(int ms) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "(%d.%03d000000) ", ms / 1000, ms % 1000);
  return text.data();
}

json status(const std::string& nav) {
  auto document = json::parse(R"({
    "bms": {"current": 0, "error": 1, "remaining_capacity": 0, "soc": 0, "status": 0, "tem": 0,
            "voltage": 0, "valid": false},
    "nav": {"locate": "LOCATE_TRUE", "obstacle": false, "status": "", "owner": "", "why": []},
    "pose": {"x": 0, "y": 0, "yaw": 0},
    "robot": {"power": 0, "robot_status": 8, "vx": 0, "vy": 0, "vz": 0,
              "valid": true},
    "rtk": {"angle": 90, "latitude": 23, "longitude": 113, "status": 4},
    "sensor": {"imu": false, "laser": false, "robot": true}})");
  document["nav"]["status"] = nav;
  return document;
}

/// Ten seconds: started at 2 s, driven from 3 s to 7 s, succeeded at 8 s.
struct Logs {
  struct Line {
    int ms;
    std::string text;
  };
  std::vector<Line> can, mqtt, events;
  double truth_x_m = 0;

  Logs() {
    events = {{0, "start mosquitto"}, {0, "start droverd"}, {10'050, "the end"}};
    for (int ms = 0; ms <= 10'000; ms += 10)
      can.push_back({ms, ms >= 3000 && ms < 7000 ? "can0 02D#0000803F00000000"
                                                 : "can0 02D#0000000000000000"});
    for (int ms = 100; ms <= 10'000; ms += 100)
      mqtt.push_back({ms, "base_status 0 " + status(ms < 2100   ? "NAV_FREE"
                                                    : ms < 8000 ? "NAV_RUN"
                                                                : "NAV_SUCCESS")
                                                 .dump()});
    say(2000, R"(mqtt_control 0 {"cmd_type":"task_control","cmd":"start_task","id":1})");
    say(2005, R"(feedback 0 {"cmd":"start_task_success","cmd_type":"feedback"})");
    say(3005, R"(feedback 0 {"cmd":"start_nav_success","cmd_type":"feedback"})");
  }
  void say(int ms, const std::string& text) {
    const auto at =
        std::find_if(mqtt.begin(), mqtt.end(), [ms](const Line& line) { return line.ms > ms; });
    mqtt.insert(at, {ms, text});
  }
  void tell(int ms, const std::string& text) { events.insert(events.end() - 1, {ms, text}); }
  /// Changes every status from `begin` to `end` (ms).
  void change(int begin, int end, const std::function<void(json&)>& how) {
    constexpr std::string_view kTopic = "base_status 0 ";
    for (auto& line : mqtt) {
      if (line.ms < begin || line.ms > end || !line.text.starts_with(kTopic)) continue;
      auto document = json::parse(line.text.substr(kTopic.size()));
      how(document);
      line.text = std::string(kTopic) + document.dump();
    }
  }
  void drop_statuses(int begin, int end) {
    std::erase_if(mqtt, [=](const Line& line) {
      return line.ms >= begin && line.ms <= end && line.text.starts_with("base_status");
    });
  }

  std::filesystem::path write() const {
    const auto* test = testing::UnitTest::GetInstance()->current_test_info();
    const std::filesystem::path folder =
        testing::TempDir() + "drover-mission-" + std::to_string(::getpid()) + test->name();
    std::filesystem::create_directories(folder);
    const auto put = [&folder](const char* name, const std::vector<Line>& lines) {
      std::ofstream stream(folder / name);
      for (const auto& line : lines) stream << stamp(line.ms) << line.text << "\n";
    };
    put("can.log", can);
    put("mqtt.log", mqtt);
    put("events.log", events);
    std::ofstream truth(folder / "truth.csv");
    truth << "time_s,x_m,y_m,z_m,yaw_rad,vx_mps,free_ahead_m,wz_radps\n";
    for (int i = 0; i <= 220; ++i) truth << 0.05 * i << "," << truth_x_m << ",0,0,0,0,999,0\n";
    return folder;
  }
  Record read() const {
    const auto folder = write();
    const auto forget = [&folder] { std::filesystem::remove_all(folder); };
    try {
      auto record = read_record(folder, kScenario);
      forget();
      return record;
    } catch (...) {
      forget();
      throw;
    }
  }
};

TEST(MissionRecord, IsRefusedWhenALogIsMissingEmptyOrCutShort) {
  for (const char* name : {"can.log", "mqtt.log", "events.log", "truth.csv"}) {
    const auto folder = Logs().write();
    const auto size = std::filesystem::file_size(folder / name);
    EXPECT_NO_THROW(read_record(folder, kScenario)) << name;
    std::filesystem::resize_file(folder / name, size - 1);
    EXPECT_THROW(read_record(folder, kScenario), std::runtime_error) << name << " cut short";
    std::filesystem::resize_file(folder / name, 0);
    EXPECT_THROW(read_record(folder, kScenario), std::runtime_error) << name << " empty";
    std::filesystem::remove(folder / name);
    EXPECT_THROW(read_record(folder, kScenario), std::runtime_error) << name << " missing";
    std::filesystem::remove_all(folder);
  }
}

TEST(MissionRecord, IsRefusedWhenTimeGoesBack) {
  Logs logs;
  std::swap(logs.can[3], logs.can[4]);
  EXPECT_THROW(logs.read(), std::runtime_error);
}

TEST(MissionChecks, FindNothingInAGoodRecord) {
  const auto record = Logs().read();
  EXPECT_THAT(check_frames(record), IsEmpty());
  EXPECT_THAT(check_form(record), IsEmpty());
  EXPECT_THAT(check_rate(record), IsEmpty());
  EXPECT_THAT(check_motion(record), IsEmpty());
  EXPECT_THAT(check_pose(record), IsEmpty());
  EXPECT_THAT(check_truth(record, 0.3), IsEmpty());
}

TEST(MissionChecks, FindAFrameOffTheList) {
  Logs logs;
  logs.can[5].text = "can0 02C#0000000000000000";
  EXPECT_THAT(check_frames(logs.read()), testing::SizeIs(1));
}

TEST(MissionChecks, FindABusWithoutSetPoints) {
  Logs logs;
  for (auto& line : logs.can) line.text = "can0 021#0000000001000000";
  EXPECT_THAT(check_frames(logs.read()), Not(IsEmpty()));
}

TEST(MissionChecks, FindOneMovingFrameOutsideOfTheTask) {
  for (const std::size_t at : {10U, 199U, 801U, 1000U}) {
    Logs logs;
    logs.can[at].text = "can0 08D#0100000000000000";
    EXPECT_THAT(check_motion(logs.read()), testing::SizeIs(1)) << at;
  }
}

TEST(MissionChecks, FindMotionWithoutAnAcceptedStart) {
  Logs logs;
  for (auto& line : logs.mqtt)
    if (line.text.find("start_task_success") != std::string::npos)
      line.text = R"(feedback 0 {"cmd":"start_task_failse","cmd_type":"feedback","reason":"no"})";
  EXPECT_THAT(check_motion(logs.read()), Not(IsEmpty()));
}

/// A message for one joint, the velocity as the hexadecimal digits of its eight bytes.
std::string joint_command(const std::string& joint, const std::string& velocity) {
  std::string hex;
  for (const char c : joint) {
    std::array<char, 3> digits{};
    std::snprintf(digits.data(), digits.size(), "%02x", static_cast<unsigned>(c));
    hex += digits.data();
  }
  std::array<char, 16> head{};
  std::snprintf(head.data(), head.size(), "12%02x0a%02x", static_cast<unsigned>(joint.size() + 11),
                static_cast<unsigned>(joint.size()));
  return std::string(kJointCommandTopic) + " 0 02706200" + head.data() + hex + "19" + velocity;
}

TEST(MissionChecks, PermitMotionToAStreamThatBeganAtRestAndIsSound) {
  const std::string rest = "0000000000000000";
  const std::string one = "000000000000f03f";
  const std::string nan = "000000000000f87f";
  struct Case {
    std::string first, then;
    bool permitted;
  };
  for (const auto& [first, then, permitted] :
       {Case{joint_command("front_left", rest), joint_command("front_left", one), true},
        Case{joint_command("front_left", one), joint_command("front_left", one), false},
        Case{joint_command("wing", rest), joint_command("front_left", one), false},
        Case{joint_command("front_left", nan), joint_command("front_left", one), false}}) {
    Logs logs;
    logs.say(50, first);
    logs.say(90, then);
    logs.can[10].text = "can0 08D#0100000000000000";
    EXPECT_THAT(check_motion(logs.read()), testing::SizeIs(permitted ? 0 : 1)) << first << then;
  }
}

/// The same in JSON under AimRT 1.x's name.
std::string joint_command_in_json(const std::string& velocity) {
  std::string hex;
  for (const char c : R"({"joints":[{"name":"front_left","velocity":)" + velocity + "}]}") {
    std::array<char, 3> digits{};
    std::snprintf(digits.data(), digits.size(), "%02x", static_cast<unsigned>(c));
    hex += digits.data();
  }
  return std::string(kJointCommandArrayTopic) + " 0 046a736f6e00" + hex;
}

TEST(MissionChecks, PermitMotionToAStreamInJsonToo) {
  for (const auto& [first, then, permitted] : {std::tuple{"0.0", "1.0", true},
                                               {"0.0", R"("NaN")", true},
                                               {"1.0", "1.0", false},
                                               {R"("NaN")", "1.0", false}}) {
    Logs logs;
    logs.say(50, joint_command_in_json(first));
    logs.say(90, joint_command_in_json(then));
    logs.can[10].text = "can0 08D#0100000000000000";
    EXPECT_THAT(check_motion(logs.read()), testing::SizeIs(permitted ? 0 : 1)) << first << then;
  }
}

TEST(MissionChecks, FindMotionLongAfterAStreamFellSilent) {
  Logs logs;
  logs.say(50, joint_command("front_left", "0000000000000000"));
  logs.can[190].text = "can0 08D#0100000000000000";
  EXPECT_THAT(check_motion(logs.read()), testing::SizeIs(1));
}

TEST(MissionChecks, PermitMotionToASearchForTheHeadingWhileItHasTheDrives) {
  for (const bool asked : {true, false})
    for (const bool told : {true, false}) {
      Logs logs;
      if (asked) logs.tell(50, "start drover heading find");
      if (told) logs.change(0, 150, [](json& message) { message["nav"]["owner"] = "manual"; });
      logs.can[45].text = "can0 08D#0100000000000000";
      EXPECT_THAT(check_motion(logs.read()), testing::SizeIs(asked && told ? 0 : 1));
      logs.can[190].text = logs.can[45].text;  // long after it
      EXPECT_THAT(check_motion(logs.read()), testing::SizeIs(asked && told ? 1 : 2));
    }
}

TEST(MissionChecks, RefuseARecordWithAJointCommandThatIsNone) {
  Logs logs;
  logs.say(50, std::string(kJointCommandTopic) + " 0 0270620012ff");
  EXPECT_ANY_THROW((void)logs.read());
}

TEST(MissionChecks, FindMotionThatOutlivesTheGateway) {
  Logs logs;
  logs.tell(5000, "signal 9 to droverd");
  logs.drop_statuses(5000, 8000);
  EXPECT_THAT(check_motion(logs.read()), Not(IsEmpty()));
}

TEST(MissionChecks, FindANavigationAnnouncedTooEarly) {
  Logs logs;
  for (auto& line : logs.can)
    if (line.ms < 3200) line.text = "can0 02D#0000000000000000";
  EXPECT_THAT(check_motion(logs.read()), testing::SizeIs(1));
}

TEST(MissionChecks, FindEveryWrongFormOfAStatus) {
  const std::vector<std::function<void(json&)>> wrongs{
      [](json& s) { s["extra"] = json::object(); },
      [](json& s) { s.erase("bms"); },
      [](json& s) { s["sensor"].erase("imu"); },
      [](json& s) { s["sensor"]["lidar"] = true; },
      [](json& s) { s["robot"]["power"] = nullptr; },
      [](json& s) { s["robot"]["robot_status"] = 8.0; },
      [](json& s) { s["rtk"]["status"] = 3; },
      [](json& s) { s["rtk"]["angle"] = 360.0; },
      [](json& s) { s["nav"]["locate"] = "LOCATE_MAYBE"; },
      [](json& s) { s["nav"]["status"] = "NAV_PAUSED"; },
      [](json& s) { s["nav"]["why"] = "text"; },
  };
  for (std::size_t i = 0; i < wrongs.size(); ++i) {
    Logs logs;
    logs.change(5000, 5000, wrongs[i]);
    EXPECT_THAT(check_form(logs.read()), testing::SizeIs(1)) << "number " << i;
  }
}

TEST(MissionChecks, FindRetainedMessagesAndFailuresWithoutAReason) {
  Logs logs;
  logs.say(9050, R"(feedback 1 {"cmd":"cancel_task_success","cmd_type":"feedback"})");
  logs.say(9060, R"(feedback 0 {"cmd":"start_task_failse","cmd_type":"feedback"})");
  logs.say(9070, "other 0 x");
  EXPECT_THAT(check_form(logs.read()), testing::SizeIs(3));
}

TEST(MissionChecks, FindPacketsOfNoDocument) {
  const std::string joints = "/channel/%2Fjoint_state/pb%3Aaimrt.protocols.sensor.JointState";
  Logs good;
  good.say(9050, joints + " 0 027062000a02080a");
  EXPECT_THAT(check_form(good.read()), IsEmpty());
  Logs logs;
  logs.say(9050, joints + " 1 027062000a02080a");
  logs.say(9060, joints + " 0 0a02080a");
  logs.say(9070, "/channel/%2Fother/pb%3Aaimrt.protocols.sensor.JointState 0 027062000a02080a");
  EXPECT_THAT(check_form(logs.read()), testing::SizeIs(3));
}

TEST(MissionChecks, FindAGapALateBeginningAndAnEarlyEndOfTheStatus) {
  for (const auto& [begin, end] : {std::pair{5000, 5300}, {0, 2500}, {9700, 10'050}}) {
    Logs logs;
    logs.drop_statuses(begin, end);
    EXPECT_THAT(check_rate(logs.read()), Not(IsEmpty())) << begin;
  }
}

TEST(MissionChecks, FindAnotherRate) {
  Logs logs;  // nine instead of ten, without a gap
  int ms = 0;
  for (auto& line : logs.mqtt)
    if (line.text.starts_with("base_status")) line.ms = ms += 98;
  std::stable_sort(logs.mqtt.begin(), logs.mqtt.end(),
                   [](const auto& a, const auto& b) { return a.ms < b.ms; });
  logs.events.back().ms = ms + 50;
  EXPECT_THAT(check_rate(logs.read()), testing::SizeIs(1));
}

TEST(MissionChecks, AskNoStatusOfAGatewayThatIsDeadOrStopped) {
  for (const auto* how : {"signal 9 to droverd", "signal 19 to droverd"}) {
    Logs logs;
    logs.tell(5010, how);
    logs.drop_statuses(5010, 8000);
    logs.tell(8010, how[7] == '9' ? "start droverd" : "signal 18 to droverd");
    EXPECT_THAT(check_rate(logs.read()), IsEmpty()) << how;
    logs.drop_statuses(8010, 12'000);
    EXPECT_THAT(check_rate(logs.read()), Not(IsEmpty())) << how;
  }
}

TEST(MissionChecks, FindPoseAndPositionApart) {
  Logs logs;
  logs.change(5000, 5000, [](json& s) { s["pose"]["x"] = 0.01; });
  EXPECT_THAT(check_pose(logs.read()), testing::SizeIs(1));
  Logs turned;
  turned.change(5000, 5000, [](json& s) { s["rtk"]["angle"] = 91; });
  EXPECT_THAT(check_pose(turned.read()), testing::SizeIs(1));
}

TEST(MissionChecks, FindARobotThatMovesFarFromWhereItBelievesToBe) {
  Logs logs;
  logs.truth_x_m = 0.31;
  EXPECT_THAT(check_truth(logs.read(), 0.3), Not(IsEmpty()));
  logs.change(5000, 5000, [](json& s) { s["nav"]["locate"] = "LOCATE_FALSE"; });
  EXPECT_THAT(check_truth(logs.read(), 0.3), Not(IsEmpty()));
}

TEST(MissionChecks, TakeAPoorReceiverForNoBeliefWhileThePositionIsNotGood) {
  Logs logs;
  logs.change(5000, 5000, [](json& s) {
    s["nav"]["locate"] = "LOCATE_FALSE";
    s["rtk"]["latitude"] = s["rtk"]["latitude"].get<double>() + 1e-5;
  });
  EXPECT_THAT(check_truth(logs.read(), 0.3), IsEmpty());
  logs.change(5000, 5000, [](json& s) { s["pose"]["x"] = s["pose"]["x"].get<double>() + 0.4; });
  EXPECT_THAT(check_truth(logs.read(), 0.3), Not(IsEmpty()));
}

TEST(MissionChecks, MeasureTheDriveBesideTheTrack) {
  Record record;
  record.track = {{0, 0}, {10, 0}};
  record.target_id = 2;
  for (int i = 0; i <= 100; ++i)
    record.truth.push_back({Time{std::chrono::milliseconds(50 * i)}, 0.1 * i, 0.03, 0, 0, 0, 0});
  const auto figures = drive_figures(record, kNever, Time::max());
  EXPECT_NEAR(figures.distance_m, 10, 1e-9);
  EXPECT_NEAR(figures.rms_m, 0.03, 1e-9);
  EXPECT_NEAR(figures.max_m, 0.03, 1e-9);
  EXPECT_NEAR(figures.goal_m, 0.03, 1e-9);
  record.target_id = 3;
  EXPECT_TRUE(std::isnan(drive_figures(record, kNever, Time::max()).goal_m));
}

}  // namespace
}  // namespace drover::mission
