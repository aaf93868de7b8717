// Two gateways on one bus, each with a guard and a run folder of its own.
#include <csignal>
#include <fstream>
#include <iterator>

#include "integration/robot_rig.h"

namespace drover::test {
namespace {

namespace fs = std::filesystem;

class ASecondDaemon : public RobotRig {
 protected:
  std::string path(const char* name) const { return (folder() / name).string(); }

  /// As configured by mistake: the same devices, other folders. It has no broker.
  void write_second_file() const {
    std::ifstream file(path("drover.json"));
    std::string text((std::istreambuf_iterator<char>(file)), {});
    const auto replace = [&text](const std::string& mark, const std::string& by) {
      const auto at = text.find(mark);
      ASSERT_NE(at, std::string::npos) << mark;
      text.replace(at, mark.size(), by);
    };
    replace(path("state"), path("state2"));
    replace(path("run") + "\"", path("run2") + "\"");
    replace(path("run/guard.sock"), path("run2/guard.sock"));
    replace("\"port\": " + std::to_string(port()), "\"port\": 1");
    std::ofstream(path("second.json")) << text;
    fs::create_directories(path("run2"));
  }
  /// `drover` beside the second one.
  CommandResult ask_second(std::vector<std::string> words) {
    words.insert(words.begin(), {DROVER_PROGRAM, "--socket", path("run2/drover.sock")});
    const auto log = path("second_answer.txt");
    fs::remove(log);
    Process program(words, log);
    const int code = program.wait(std::chrono::seconds(20)).value_or(-1);
    return {code, program.output()};
  }

  static constexpr const char* kElse = "somebody else commands the drives: id 0x0";
  Process second_guard_;
  Process second_;
};

TEST_F(ASecondDaemon, IsRefusedWhileTheFirstHoldsTheRobotThoughThatSaysOnlyZero) {
  ASSERT_NO_FATAL_FAILURE(start_all());
  ASSERT_NO_FATAL_FAILURE(drive(5));
  control(R"({"cmd_type": "task_control", "cmd": "cancel_task"})");
  ASSERT_TRUE(wait_until([this] { return at_rest(); }));

  ASSERT_NO_FATAL_FAILURE(write_second_file());
  second_guard_ = Process({DROVER_GUARD_PROGRAM, "--socket", path("run2/guard.sock")},
                          path("second_guard.log"));
  second_ = Process({DROVERD_PROGRAM, "-c", path("second.json")}, path("second.log"));
  CommandResult told;
  EXPECT_TRUE(wait_until([&] {
    told = ask_second({"status"});
    return told.text.find(kElse) != std::string::npos;
  })) << told.text
      << second_.output();

  const auto hold = ask_second({"hold"});
  EXPECT_EQ(hold.code, 1) << hold.text;
  EXPECT_NE(hold.text.find(kElse), std::string::npos) << hold.text;
  EXPECT_EQ(ask_second({"heading", "find"}).code, 1);
  EXPECT_TRUE(at_rest());

  for (Process* process : {&second_, &second_guard_}) process->signal(SIGTERM);
  EXPECT_EQ(second_.wait(std::chrono::seconds(20)), 0) << second_.output();
  (void)second_guard_.wait(std::chrono::seconds(20));
}

}  // namespace
}  // namespace drover::test
