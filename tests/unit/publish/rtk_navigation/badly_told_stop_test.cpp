// A stop that is plainly meant is never refused for its form.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "publish/rtk_navigation/control.h"
#include "publish/rtk_navigation/told_command.h"
#include "tests/unit/publish/examples.h"

namespace drover::publish {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

/// "cancel: <note>", "terminate: <note>", "another command", or "<feedback cmd>: <reason>".
std::string answer(std::string_view payload, Retain retain = Retain::no) {
  const auto result = parse_control(payload, retain);
  if (!result.ok()) return result.error().feedback_cmd + ": " + result.error().reason;
  if (const auto* cancel = std::get_if<CancelTaskRequest>(&*result))
    return "cancel: " + cancel->note;
  if (const auto* terminate = std::get_if<TerminateRequest>(&*result))
    return "terminate: " + terminate->note;
  return "another command";
}

TEST(BadlyToldStop, IsObeyedAndSaysWhatIsWrong) {
  const std::pair<std::string, const char*> table[] = {
      {R"({"cmd_type":"task_control","cmd":"cancel_task",})", "a comma too many"},
      {R"({"cmd_type":"task_control","cmd":"cancel_task")", "line 1, column 4"},
      {R"({"cmd_type":"task_control","cmd":"cancel_task)", "line 1"},
      {R"({"cmd_type":"task_control" "cmd":"cancel_task"})", "a comma is missing"},
      {R"({"cmd_type":"task_control","cmd":"cancel_task"}})", "line 1"},
      {R"({"cmd":"cancel_task","cmd":"cancel_task","cmd_type":"task_control"})", "twice"},
      {R"({"cmd":"start_task","cmd":"cancel_task","cmd_type":"task_control"})", "twice"},
      {R"({"cmd":"cancel_task"})", "'cmd_type' is missing"},
      {R"({"cmd":"cancel_task","cmd_type":7})", "'cmd_type' must be a text"},
      {R"({"cmd":"cancel_task","cmd_type":"manual_control"})", "the cmd_type of cancel_task is"},
      {R"({"__proto__":{},"cmd":"cancel_task","cmd_type":"task_control"})", "__proto__"},
      {R"([{"cmd_type":"task_control","cmd":"cancel_task"}])", "a command is an object"},
      {R"({'cmd_type': 'task_control', 'cmd': 'cancel_task'})", "line 1"},
      {R"({cmd_type: "task_control", cmd: cancel_task})", "line 1"},
      {R"({"cmd":"cancel_task ","cmd_type":"task_control"})", "no command 'cancel_task '"},
      {R"({"cmd":" cancel_task","cmd_type":"task_control"})", "no command ' cancel_task'"},
      {R"({"cmd":"Cancel_Task","cmd_type":"task_control"})", "no command 'Cancel_Task'"},
      {R"({"cmd":"CANCEL_TASK"})", "no command 'CANCEL_TASK'"},
      {R"({"Cmd":"cancel_task","cmd_type":"task_control"})", "'cmd' is missing"},
      {"CANCEL_TASK", "line 1"},
      {"cancel_task", "line 1"},
      {"\"cancel_task\"\n", "a command is an object"},
      {std::string("{\"cmd\":\"cancel_task\",\0}", 23), "NUL"},
      {"{\"name\":\"\xFF\",\"cmd\":\"cancel_task\"}", "line 1"},
  };
  for (const auto& [payload, problem] : table) {
    EXPECT_THAT(answer(payload), StartsWith("cancel: obeyed, though the message is wrong: "))
        << payload;
    EXPECT_THAT(answer(payload), HasSubstr(problem)) << payload;
    EXPECT_TRUE(may_stop(payload)) << payload;
  }
  EXPECT_THAT(answer(R"({"cmd":"terminate","cmd_type":"task_control"})"),
              StartsWith("terminate: obeyed, though the message is wrong: the cmd_type"));
}

TEST(BadlyToldStop, HasNoNoteWhenItIsWellTold) {
  EXPECT_EQ(answer(example("cancel_task")), "cancel: ");
  EXPECT_EQ(answer(R"({"cmd_type":"manual_control","cmd":"terminate"})"), "terminate: ");
}

TEST(BadlyToldStop, MayHaveTheEndOfAStringBehindItAsAnyCommandMay) {
  EXPECT_EQ(answer(example("cancel_task") + std::string(1, '\0')), "cancel: ");
  EXPECT_EQ(answer(example("cancel_task") + std::string(9, '\0')), "cancel: ");
  EXPECT_EQ(answer(example("start_task") + std::string(1, '\0')), "another command");
}

/// Of ASCII.
std::string in_utf16(const std::string& text, bool little_endian, bool with_mark) {
  std::string wide;
  const auto add = [&](char high, char low) {
    wide += little_endian ? low : high;
    wide += little_endian ? high : low;
  };
  if (with_mark) add('\xFE', '\xFF');
  for (const char c : text) add('\0', c);
  return wide;
}

TEST(BadlyToldStop, MayBeWrittenInUtf16) {
  for (const bool little_endian : {true, false}) {
    for (const bool with_mark : {true, false}) {
      const auto wide = [&](const std::string& text) {
        return in_utf16(text, little_endian, with_mark);
      };
      for (const auto& stop : {example("cancel_task"), std::string("cancel_task")}) {
        EXPECT_TRUE(may_stop(wide(stop)));
        EXPECT_THAT(answer(wide(stop)), StartsWith("cancel: obeyed, though the message is wrong"));
      }
      EXPECT_THAT(answer(wide(R"({"cmd_type":"manual_control","cmd":"terminate"})")),
                  StartsWith("terminate: obeyed"));
      EXPECT_FALSE(may_stop(wide(example("start_task"))));
      EXPECT_THAT(answer(wide(example("start_task"))), HasSubstr("_failse: line 1"));
      EXPECT_THAT(answer(wide(example("cancel_task")), Retain::stored),
                  StartsWith("cancel_task_failse: the message was retained"));
    }
  }
}

TEST(BadlyToldStop, IsRefusedWhenTheBrokerHadStoredIt) {
  EXPECT_EQ(answer(R"({"cmd":"cancel_task",})", Retain::stored),
            "cancel_task_failse: the message was retained by the broker: publish without retain");
  EXPECT_EQ(answer(R"({"cmd":"cancel_task"})", Retain::stored),
            "cancel_task_failse: the message was retained by the broker: publish without retain");
  EXPECT_THAT(answer(R"({"cmd":"cancel_task",})", Retain::asked), StartsWith("cancel: "));
}

TEST(BadlyToldStop, IsNoneInsideOfANameOrAnotherCommandsData) {
  const std::string save = R"({"cmd_type":"trajectory_control","cmd":"save_trajectory","data":)";
  const std::string point = R"({"longitude":1,"latitude":2,"angle":3,"x":4,"y":5,"yaw":6})";
  EXPECT_EQ(answer(save + R"({"name":"\"cmd\":\"cancel_task\"","data":[)" + point + "]}}"),
            "another command");
  // And each of these is no JSON as a whole:
  for (const std::string& payload :
       {save + R"({"name":"\"cmd\":\"cancel_task\"","data":[],}})",
        save + R"({"name":""cmd":"cancel_task"","data":[]}})",
        save + R"({"name":"x","data":[],"cmd":"cancel_task",}})",
        save + R"({"name":"cancel_task","data":[],}})",
        save + R"({"name":"x","data":["cmd","cancel_task",]}})",
        save + R"({"name":"x" /* "cmd":"cancel_task" */ "data":[]}})"}) {
    EXPECT_THAT(answer(payload), StartsWith("save_trajectory_failse: line 1")) << payload;
  }
  EXPECT_THAT(answer(R"({"cmd":"start_task","name":"cmd","id":cancel_task})"),
              StartsWith("start_task_failse: line 1"));
  EXPECT_THAT(answer(R"({"cmd":"cancel_task_success","cmd_type":"feedback",})"),
              StartsWith("unknown_failse: line 1"));
}

TEST(ToldCommands, AreReadOneAfterTheOther) {
  ToldCommands told(R"({"a":{"cmd":"x"},"cmd":"b","n":1,'cmd' : 'c' // "cmd":"y"
                       cmd:d,"cmd":"cut)");
  for (const char* cmd : {"b", "c", "d", "cut", "", ""}) EXPECT_EQ(told.next(), cmd);
}

}  // namespace
}  // namespace drover::publish
