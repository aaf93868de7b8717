#include "publish/rtk_navigation/control.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "tests/unit/publish/examples.h"

namespace drover::publish {
namespace {

using testing::HasSubstr;

/// "accepted", or "<feedback cmd>: <reason>".
std::string answer(std::string_view payload, Retain retain = Retain::no) {
  const auto result = parse_control(payload, retain);
  return result.ok() ? "accepted" : result.error().feedback_cmd + ": " + result.error().reason;
}

std::string start(std::string_view id, std::string_view speed = "0.5",
                  std::string_view name = "\"13\"") {
  return "{\"cmd_type\":\"task_control\",\"cmd\":\"start_task\",\"name\":" + std::string(name) +
         ",\"id\":" + std::string(id) + ",\"speed\":" + std::string(speed) + "}";
}

std::string save(std::string_view points, std::string_view name = "\"t\"") {
  return "{\"cmd_type\":\"trajectory_control\",\"cmd\":\"save_trajectory\",\"data\":{\"name\":" +
         std::string(name) + ",\"data\":" + std::string(points) + "}}";
}

const std::string kPoint =
    "{\"longitude\":113.0,\"latitude\":23.0,\"angle\":30,\"x\":1,\"y\":2.5,\"yaw\":0.1}";

TEST(Control, RefusesAPointIdThatIsNoInteger) {
  for (const char* id : {"1.9", "1e300", "-0.5", "true", "\"1\"", "null", "[]", "{}"}) {
    EXPECT_THAT(answer(start(id)), HasSubstr("start_task_failse: 'id' must be an integer")) << id;
  }
  EXPECT_THAT(answer(start("18446744073709551616")), HasSubstr("64 bits"));
  EXPECT_THAT(answer(start("18446744073709551615")), HasSubstr("'id' must be an integer"));
  EXPECT_EQ(answer("{\"cmd_type\":\"task_control\",\"cmd\":\"start_task\",\"name\":\"13\","
                   "\"speed\":0.2}"),
            "start_task_failse: 'id' is missing");
}

TEST(Control, TakesAPointIdFromAProgramThatKnowsNoIntegers) {
  for (const auto& [spelled, id] : {std::pair{"2.0", 2}, {"2e0", 2}, {"20e-1", 2}, {"-0.0", 0}}) {
    const auto result = parse_control(start(spelled), Retain::no);
    ASSERT_TRUE(result.ok()) << spelled;
    EXPECT_EQ(std::get<StartTaskRequest>(*result).id, id) << spelled;
  }
  EXPECT_EQ(answer(start("1.9")), "start_task_failse: 'id' must be an integer, not 1.9");
}

TEST(Control, DoesNotWrapALargePointId) {
  const auto result = parse_control(start("4294967297"), Retain::no);
  ASSERT_TRUE(result.ok());
  EXPECT_EQ(std::get<StartTaskRequest>(*result).id, 4294967297);
}

TEST(Control, RefusesASpeedThatIsNoNumber) {
  for (const char* speed : {"\"fast\"", "null", "true", "[0.5]"}) {
    EXPECT_THAT(answer(start("1", speed)), HasSubstr("'speed' must be a number")) << speed;
  }
  for (const char* speed : {"NaN", "Infinity", "-Infinity", "1e999"}) {
    EXPECT_THAT(answer(start("1", speed)), HasSubstr("start_task_failse: line 1")) << speed;
  }
}

TEST(Control, RefusesATrackNameThatIsNoText) {
  for (const char* name : {"13", "null", "true", "[\"13\"]", "{}"}) {
    EXPECT_THAT(answer(start("1", "0.5", name)), HasSubstr("'name' must be a text")) << name;
    EXPECT_THAT(answer(save("[]", name)), HasSubstr("save_trajectory_failse: 'name' must")) << name;
  }
}

TEST(Control, RefusesNamesThatWouldForgeALine) {
  for (const char* name : {"\"a\\u0000/../x\"", "\"a\\nb\"", "\"a\\u007fb\"", "\"\\u001b[2J\""}) {
    EXPECT_THAT(answer(save("[]", name)), HasSubstr("control character")) << name;
  }
  EXPECT_THAT(answer(save("[]", "\"" + std::string(1201, 'x') + "\"")), HasSubstr("longer than"));
}

TEST(Control, RefusesNewNamesThatAreEmptyOrShowAsSomethingElse) {
  EXPECT_EQ(answer(save("[]", "\"\"")), "save_trajectory_failse: the name is empty");
  for (const char* name : {"\"\\u202Etxt\"", "\"a\\u0085b\"", "\"a\\u009b\"", "\"\\u200f\"",
                           "\"\\u2066x\"", "\"\\u2069\"", "\"\\u061c\"", "\"\\u2028\""}) {
    EXPECT_EQ(answer(save("[]", name)),
              "save_trajectory_failse: the name contains an invisible control character")
        << name;
    EXPECT_EQ(answer(start("1", "0.5", name)), "accepted") << "an old track may be named so";
  }
}

TEST(Control, TakesAnyOtherName) {
  for (const char* name : {"\"../../etc/passwd\"", "\"园区01\"", "\"CON\"", "\".\"", "\"%2e%2e\"",
                           "\"-rf\"", "\"__proto__\""}) {
    EXPECT_EQ(answer(save("[" + kPoint + "]", name)), "accepted") << name;
  }
  EXPECT_EQ(answer(save("[" + kPoint + "]", "\"" + std::string(300, 'x') + "\"")), "accepted");
}

TEST(Control, RefusesPointsThatAreNone) {
  const std::pair<std::string, const char*> table[] = {
      {"[" + kPoint + ",7]", "point 2: is no object but an integer"},
      {"[{}]", "point 1: 'longitude' is missing"},
      {"[{\"longitude\":\"113\"}]", "point 1: 'longitude' must be a number, not a text"},
      {"[{\"longitude\":1,\"latitude\":2,\"angle\":3,\"x\":4,\"y\":5}]", "'yaw' is missing"},
      {"[{\"longitude\":1,\"latitude\":null,\"angle\":3,\"x\":4,\"y\":5,\"yaw\":6}]", "'latitude'"},
      {"[{\"longitude\":1,\"latitude\":2,\"angle\":3,\"x\":NaN,\"y\":5,\"yaw\":6}]", "line 1"},
      {"[{\"longitude\":1,\"latitude\":2,\"angle\":3,\"x\":4,\"y\":5,\"yaw\":6,\"z\":\"\"}]",
       "'z'"},
      {"[]", "'data.data' has no points, nothing is saved"},
      {"{}", "must be a list of points"},
      {"null", "must be a list of points"},
  };
  for (const auto& [points, reason] : table) {
    EXPECT_THAT(answer(save(points)), HasSubstr(reason)) << points;
  }
}

TEST(Control, RefusesMoreThanALimitOfAnything) {
  EXPECT_THAT(answer(std::string((2U << 20) + 1, ' ')), HasSubstr("bytes"));
  EXPECT_THAT(answer(std::string(1'000'000, '[')), HasSubstr("nested deeper"));
  std::string zeros = "[0";
  for (int i = 0; i < 310'000; ++i) zeros += ",0";
  EXPECT_THAT(answer(save(zeros + "]")), HasSubstr("more than 300000 values"));
}

TEST(Control, KeepsPointsThatMakeNoSenseAsTheyCame) {
  EXPECT_EQ(answer(save("[" + kPoint + "]")), "accepted");
  EXPECT_EQ(answer(save("[" + kPoint + "," + kPoint + "]")), "accepted");
  const auto result = parse_control(
      save("[{\"longitude\":188.2222333,\"latitude\":91,\"angle\":-1,\"x\":1e6,\"y\":-0,"
           "\"yaw\":230,\"z\":3.141592}]"),
      Retain::no);
  ASSERT_TRUE(result.ok());
  const auto& point = std::get<SaveTrajectory>(*result).track.points.at(0);
  EXPECT_EQ(point.longitude_deg, 188.2222333);
  EXPECT_EQ(point.latitude_deg, 91);
  EXPECT_EQ(point.x_m, 1e6);
  EXPECT_EQ(point.z_m, 3.141592);
  EXPECT_EQ(std::get<SaveTrajectory>(*result).track.numbers,
            "188.2222333,91,-1,1e6,-0,230,3.141592,");
}

TEST(Control, KeepsTheDigitsOfANumberThatNoIntegerHolds) {
  const auto result =
      parse_control(save(R"([{"longitude":1,"latitude":2,"angle":3,"x":-98765432109876543210,)"
                         R"("y":18446744073709551615,"yaw":6,"z":123456789012345678901}])"),
                    Retain::no);
  ASSERT_TRUE(result.ok()) << result.error().reason;
  const auto& track = std::get<SaveTrajectory>(*result).track;
  EXPECT_EQ(track.points.at(0).z_m, 123456789012345678901.0);
  EXPECT_EQ(track.numbers,
            "1,2,3,-98765432109876543210,18446744073709551615,6,123456789012345678901,");
}

TEST(Control, TakesTheLargestSaveWhateverItsPointsLookLike) {
  const std::string shortest = R"({"longitude":1,"latitude":1,"angle":1,"x":1,"y":1,"yaw":1})";
  const std::string longest =
      R"({"longitude":113.0196366456667001,"latitude":23.14965249651234,"angle":359.999999999999,)"
      R"("x":-1234.567890123456,"y":-1234.567890123456,"yaw":-3.14159265358979,)"
      R"("z":1.2345678901234})";
  for (const auto& point : {shortest, longest}) {
    std::string points = "[" + point;
    while (points.size() + point.size() + 200 < ControlLimits{}.max_bytes) points += "," + point;
    EXPECT_EQ(answer(save(points + "]")), "accepted") << point;
  }
}

TEST(Control, RefusesHostileText) {
  for (const std::string& payload :
       {std::string(), std::string("{"), std::string("null"), std::string("[]"),
        std::string("\"x\""), std::string("{\"cmd\":\"\xFF\"}"),
        std::string("{\"cmd\":\"\\ud800\"}"), "\xEF\xBB\xBF" + start("1"), start("1") + start("1"),
        start("1") + std::string("\0x", 2),
        std::string("{\"cmd\":7,\"cmd_type\":\"task_control\"}"),
        std::string("{\"cmd\":\"start_task\"}"), std::string("{\"cmd_type\":\"task_control\"}"),
        std::string(
            "{\"__proto__\":{},\"cmd\":\"init_rtk_data\",\"cmd_type\":\"task_control\"}")}) {
    EXPECT_NE(answer(payload), "accepted") << payload;
  }
}

TEST(Control, ObeysAStopBehindAByteOrderMark) {
  EXPECT_EQ(answer("\xEF\xBB\xBF" + example("cancel_task")), "accepted");
}

TEST(Control, RefusesADuplicateKeyInsteadOfTakingTheLast) {
  EXPECT_THAT(
      answer("{\"cmd_type\":\"task_control\",\"cmd\":\"start_task\",\"name\":\"1\",\"id\":1,"
             "\"id\":2,\"speed\":0.5}"),
      HasSubstr("(id): this key is there twice"));
}

TEST(Control, RefusesARetainedMessage) {
  for (const char* name : {"start_task", "cancel_task", "delete_all_trajectory"}) {
    EXPECT_EQ(answer(example(name), Retain::stored),
              std::string(name) +
                  "_failse: the message was retained by the broker: publish without retain");
  }
}

TEST(Control, OfLiveMessagesThatAreToBeRetainedTakesOnlyWhatStops) {
  for (const char* name : {"start_task", "delete_all_trajectory", "get_all_trajectory"}) {
    EXPECT_THAT(answer(example(name), Retain::asked), HasSubstr("publish without retain"));
  }
  EXPECT_EQ(answer(example("cancel_task"), Retain::asked), "accepted");
  EXPECT_EQ(answer("{\"cmd_type\":\"manual_control\",\"cmd\":\"terminate\"}", Retain::asked),
            "accepted");
}

TEST(Control, ReadsWhenAStartWasPressedInSecondsAndMilliseconds) {
  const auto pressed = [](const std::string& time) {
    return "{\"cmd_type\":\"task_control\",\"cmd\":\"start_task\",\"name\":\"13\",\"id\":1,"
           "\"speed\":0.5,\"time\":" +
           time + "}";
  };
  using std::chrono::milliseconds;
  for (const char* time : {"1700000000.25", "1700000000250", "1.70000000025e9"}) {
    const auto result = parse_control(pressed(time), Retain::no);
    ASSERT_TRUE(result.ok()) << time;
    EXPECT_EQ(std::chrono::round<milliseconds>(*std::get<StartTaskRequest>(*result).time),
              milliseconds(1'700'000'000'250));
  }
  for (const char* time : {"0", "-1", "1e300", "\"now\"", "true", "null"})
    EXPECT_THAT(answer(pressed(time)), HasSubstr("start_task_failse: 'time' must be")) << time;
  EXPECT_FALSE(std::get<StartTaskRequest>(*parse_control(start("1"), Retain::no)).time);
}

TEST(Control, TellsWithoutParsingThatAMessageCannotStop) {
  EXPECT_TRUE(may_stop(example("cancel_task")));
  EXPECT_TRUE(may_stop("{\"cmd\":\"terminate\""));
  EXPECT_TRUE(may_stop("{\"cmd\":\"cancel\\u005ftask\"}")) << "an escape may hide it";
  EXPECT_FALSE(may_stop(example("get_all_trajectory")));
}

TEST(Control, RefusesACommandUnderAnotherType) {
  EXPECT_EQ(answer("{\"cmd_type\":\"trajectory_control\",\"cmd\":\"start_task\"}"),
            "start_task_failse: the cmd_type of start_task is task_control, not "
            "'trajectory_control'");
}

TEST(Control, AnswersUnknownCommandsByTheirOwnNameWhereThatIsOne) {
  EXPECT_THAT(answer("{\"cmd_type\":\"manual_control\",\"cmd\":\"cmd_vel\"}"),
              HasSubstr("cmd_vel_failse: there is no command 'cmd_vel'"));
  EXPECT_THAT(answer("{\"cmd_type\":\"task_control\",\"cmd\":\"<b>x</b>\"}"),
              HasSubstr("unknown_failse: "));
  EXPECT_EQ(failure_cmd(std::string(41, 'a')), "unknown_failse");
  EXPECT_EQ(failure_cmd(""), "unknown_failse");
  EXPECT_EQ(failure_cmd("start_task_success"), "unknown_failse") << "no client may read a success";
  EXPECT_EQ(failure_cmd("start_task_success_failse"), "unknown_failse");
}

TEST(Control, RefusesABrokenMessageInTheNameOfItsCommandWhereItTellsOne) {
  const std::string head = R"({"cmd_type": "task_control", "cmd" : "start_task", )";
  for (const std::string& payload : {head, head + R"("id": 1,})", head + R"("speed": .5})",
                                     head + R"("id": 01})", R"(/* "cmd": "cancel_task" */)" + head,
                                     R"({"a": {"cmd": "cancel_task"}, )" + head.substr(1),
                                     R"({"a\": "x\"y", )" + head.substr(1), start("1") + "}"}) {
    EXPECT_THAT(answer(payload), HasSubstr("start_task_failse: line 1")) << payload;
  }
  for (const char* payload :
       {R"({"cmd": "start_task_success",})", R"({"cmd")", R"({"cmd": )", R"({"cmd": "start_ta)",
        R"({"a": {"cmd": "start_task"},})", R"({"cmd": ["start_task",]})", R"(// "cmd": "x")"}) {
    EXPECT_THAT(answer(payload), HasSubstr("unknown_failse: line 1")) << payload;
  }
}

TEST(Control, TakesEveryExampleOfTheDocument) {
  const auto parsed = [](const char* name) { return parse_control(example(name), Retain::no); };
  EXPECT_TRUE(std::holds_alternative<GetAllTrajectory>(*parsed("get_all_trajectory")));
  EXPECT_TRUE(std::holds_alternative<DeleteAllTrajectory>(*parsed("delete_all_trajectory")));
  EXPECT_TRUE(std::holds_alternative<CancelTaskRequest>(*parsed("cancel_task")));
  EXPECT_TRUE(std::holds_alternative<InitRtkData>(*parsed("init_rtk_data")));
  EXPECT_EQ(std::get<DeleteTrajectory>(*parsed("delete_trajectory")).name, "test5");
  const auto start_task = parsed("start_task");
  const auto& request = std::get<StartTaskRequest>(*start_task);
  EXPECT_EQ(request.name, "13");
  EXPECT_EQ(request.id, 2);
  EXPECT_EQ(request.speed_mps, 0.2);
  const auto saved = parsed("save_trajectory");
  const auto& track = std::get<SaveTrajectory>(*saved).track;
  EXPECT_EQ(track.name, "test1");
  ASSERT_EQ(track.points.size(), 2U);
  EXPECT_EQ(track.points[1].longitude_deg, 188.2222333);
  EXPECT_EQ(track.points[1].latitude_deg, 23.04934955);
  EXPECT_EQ(track.points[1].angle_deg, 230);
  EXPECT_EQ(track.points[1].x_m, 322100.0);
  EXPECT_EQ(track.points[1].y_m, 45220.0);
  EXPECT_EQ(track.points[1].yaw_rad, 3.141592);
  EXPECT_EQ(track.points[1].z_m, 0);
}

TEST(Control, RefusesTheExamplesOfWhatTheRobotPublishes) {
  for (const char* name : {"base_status", "trajectory_data", "feedback"}) {
    EXPECT_NE(answer(example(name)), "accepted") << name;
  }
}

TEST(Control, IgnoresMembersOfNewerClients) {
  EXPECT_EQ(answer("{\"cmd_type\":\"task_control\",\"cmd\":\"cancel_task\",\"new\":[{}]}"),
            "accepted");
}

/// What stands between the lines ```json and ```, by blocks.
std::vector<std::string> json_blocks(const std::string& file) {
  std::ifstream stream(std::string(DROVER_SOURCE_DIR) + "/" + file);
  std::vector<std::string> blocks;
  bool inside = false;
  for (std::string line; std::getline(stream, line);) {
    if (line.starts_with("```")) {
      inside = line == "```json";
      if (inside) blocks.emplace_back();
    } else if (inside) {
      blocks.back() += line + "\n";
    }
  }
  return blocks;
}

TEST(TheReadme, ShowsMessagesThatAreAccepted) {
  const auto blocks = json_blocks("src/publish/README.md");
  ASSERT_EQ(blocks.size(), 2U);
  EXPECT_EQ(answer(blocks[0]), "accepted");
  std::istringstream lines(blocks[1]);
  int count = 0;
  for (std::string line; std::getline(lines, line); ++count) EXPECT_EQ(answer(line), "accepted");
  EXPECT_EQ(count, 7);
}

}  // namespace
}  // namespace drover::publish
