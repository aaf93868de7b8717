// `drover calibrate drive` at a terminal, with the whole robot behind it: real processes, in real
// time. What moves it, and that nothing that hangs, dies or comes late does.
#include <fcntl.h>
#include <gmock/gmock.h>
#include <pty.h>
#include <signal.h>
#include <sys/wait.h>
#include <termios.h>
#include <unistd.h>
#include <utmp.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <mutex>
#include <sstream>
#include <stdexcept>
#include <thread>

#include "integration/robot_rig.h"

namespace drover::test {
namespace {

using testing::HasSubstr;
using namespace std::chrono_literals;

/// A program at a terminal of its own, as after a login: nobody's child, so that it does not run
/// within the tmux that these tests run in.
class Orphan final {
 public:
  explicit Orphan(const std::vector<std::string>& words) {
    std::vector<char*> arguments;
    for (const auto& word : words) arguments.push_back(const_cast<char*>(word.c_str()));
    arguments.push_back(nullptr);
    std::array<int, 2> told{};
    int other_end = -1;
    if (::pipe2(told.data(), O_CLOEXEC) != 0 ||
        ::openpty(&terminal, &other_end, nullptr, nullptr, nullptr) != 0)
      throw std::runtime_error("no terminal");
    const pid_t between = ::fork();
    if (between == 0) {
      if (::fork() != 0) ::_exit(0);
      ::close(terminal);
      const pid_t pid = ::fork();
      if (pid == 0) {
        ::login_tty(other_end);
        ::execv(arguments[0], arguments.data());
        ::_exit(127);
      }
      ::close(other_end);
      int status = 0;
      if (::write(told[1], &pid, sizeof pid) < 0) ::_exit(1);
      ::waitpid(pid, &status, 0);
      ::_exit(::write(told[1], &status, sizeof status) < 0 ? 1 : 0);
    }
    ::waitpid(between, nullptr, 0);
    ::close(other_end);
    ::close(told[1]);
    told_ = told[0];
    if (::read(told_, &pid_, sizeof pid_) != sizeof pid_) pid_ = -1;
    ::fcntl(told_, F_SETFL, O_NONBLOCK);
  }
  ~Orphan() {
    signal(SIGKILL);
    ::close(told_);
  }
  Orphan(const Orphan&) = delete;
  Orphan& operator=(const Orphan&) = delete;

  void signal(int number) {
    if (pid_ > 0 && !status()) ::kill(pid_, number);
  }
  /// Exit code, once it has ended.
  std::optional<int> status() {
    int status = 0;
    if (!status_ && ::read(told_, &status, sizeof status) == sizeof status)
      status_ = WEXITSTATUS(status);
    return status_;
  }

  int terminal = -1;

 private:
  pid_t pid_ = -1;
  int told_ = -1;
  std::optional<int> status_;
};

/// A person at a terminal, who holds the space key or does not.
class KeyHolder final {
 public:
  explicit KeyHolder(const std::vector<std::string>& words)
      : program_(words), terminal_(program_.terminal) {
    types_ = std::thread([this] {
      while (!ends_) {
        if (held_) type(" ");
        std::this_thread::sleep_for(33ms);
      }
    });
    reads_ = std::thread([this] {
      std::array<char, 4096> buffer{};
      for (;;) {
        const auto n = ::read(terminal_, buffer.data(), buffer.size());
        if (n <= 0) return;  // its end closed
        const std::string_view shown(buffer.data(), static_cast<std::size_t>(n));
        if (shown.find("\033[5n") != std::string_view::npos && answers_after_ms_ >= 0) {
          std::this_thread::sleep_for(std::chrono::milliseconds(answers_after_ms_));
          type("\033[0n");
        }
        const std::lock_guard lock(mutex_);
        shown_.append(shown);
      }
    });
  }
  ~KeyHolder() {
    signal(SIGKILL);
    ends_ = true;
    types_.join();
    reads_.join();
    ::close(terminal_);
  }
  KeyHolder(const KeyHolder&) = delete;
  KeyHolder& operator=(const KeyHolder&) = delete;

  void hold() { held_ = true; }
  void let_go() { held_ = false; }
  void type(const char* keys) {
    if (::write(terminal_, keys, std::strlen(keys)) < 0) held_ = false;
  }
  /// As a terminal does at the other end of a line; below zero: it never does.
  void answer_after_ms(int ms) { answers_after_ms_ = ms; }
  void signal(int number) { program_.signal(number); }
  /// Exit code, once it has ended.
  std::optional<int> status() { return program_.status(); }
  /// Whether lines are edited, echoed, and signals made of keys: at either end of it the same.
  tcflag_t modes() const {
    termios now{};
    EXPECT_EQ(::tcgetattr(terminal_, &now), 0);
    return now.c_lflag;
  }
  std::string shown() const {
    const std::lock_guard lock(mutex_);
    return shown_;
  }

 private:
  Orphan program_;
  int terminal_;
  std::atomic<bool> held_{false};
  std::atomic<bool> ends_{false};
  std::atomic<int> answers_after_ms_{20};
  mutable std::mutex mutex_;
  std::string shown_;
  std::thread types_;
  std::thread reads_;
};

class CalibrationDriveProcess : public RobotRig {
 protected:
  /// `within`: the environment, without which it is as at a plain terminal.
  std::unique_ptr<KeyHolder> at_terminal(const std::vector<std::string>& more = {},
                                         const std::string& within = "WITHIN=nothing") {
    std::vector<std::string> words{"/usr/bin/env", "-u",   "TMUX",         "-u",
                                   "STY",          within, DROVER_PROGRAM, "--socket"};
    words.push_back((folder() / "run/drover.sock").string());
    words.insert(words.end(), {"calibrate", "drive"});
    words.insert(words.end(), more.begin(), more.end());
    return std::make_unique<KeyHolder>(words);
  }
  /// Everywhere in that file.
  void configure(const char* file_name, const std::string& was, const std::string& is) {
    std::ifstream file(folder() / file_name);
    std::string text((std::istreambuf_iterator<char>(file)), {});
    ASSERT_NE(text.find(was), std::string::npos);
    for (auto at = text.find(was); at != std::string::npos; at = text.find(was, at + is.size()))
      text.replace(at, was.size(), is);
    std::ofstream(folder() / file_name) << text;
  }
  /// A line of the result; without it nothing is near.
  static std::pair<double, double> found(const std::string& shown, const std::string& name) {
    const auto at = shown.find(name + "  ");
    double value = NAN;
    double interval = 0;
    if (at != std::string::npos)
      (void)std::sscanf(shown.c_str() + at + name.size(), " %lf +- %lf", &value, &interval);
    return {value, interval};
  }
  /// What stays on the screen: each line as it was last.
  static std::string pieces_of(const std::string& shown) {
    std::istringstream lines(shown);
    std::string all;
    for (std::string line; std::getline(lines, line);) {
      while (!line.empty() && line.back() == '\r') line.pop_back();
      all += line.substr(line.rfind('\r') + 1) + "\n";
    }
    return all;
  }
  bool moves() { return true_speed_mps() > 0.03; }
  void expect_rest_for(std::chrono::milliseconds time, const char* when) {
    ASSERT_FALSE(wait_until([&] { return !at_rest(); }, time)) << when;
  }
  void hold_until_it_moves(KeyHolder& person) {
    person.hold();
    ASSERT_TRUE(wait_until([&] { return moves(); })) << person.shown();
    ASSERT_TRUE(wait_until([&] { return status_text("nav", "owner") == "manual"; }));
  }
};

TEST_F(CalibrationDriveProcess, OnlyAKeyThatIsHeldMovesIt) {
  start_new();
  const auto person = at_terminal();
  ASSERT_TRUE(
      wait_until([&] { return person->shown().find("hold the space key") != std::string::npos; }));
  EXPECT_THAT(person->shown(), HasSubstr("m ahead of the robot"));
  expect_rest_for(1s, "before a key");

  hold_until_it_moves(*person);
  person->let_go();
  ASSERT_TRUE(wait_until([&] { return at_rest(); }));
  ASSERT_TRUE(wait_until([&] { return person->shown().find("paused") != std::string::npos; }));
  expect_rest_for(1s, "let go");

  // It hangs while the key is held on; then all of those keys arrive at once.
  hold_until_it_moves(*person);
  person->signal(SIGSTOP);
  ASSERT_TRUE(wait_until([&] { return at_rest(); }));
  person->let_go();
  expect_rest_for(1s, "hung");
  person->signal(SIGCONT);
  expect_rest_for(2s, "a burst of keys");

  hold_until_it_moves(*person);
  EXPECT_EQ(drover({"stop"}).code, 0);
  ASSERT_TRUE(wait_until([&] { return at_rest(); }));
  expect_rest_for(1s, "stopped");
  EXPECT_EQ(drover({"reset"}).code, 0);
  expect_rest_for(2s, "the key was held over the stop");
  EXPECT_THAT(person->shown(), HasSubstr("let the key go first"));
  person->let_go();
  expect_rest_for(1s, "let go");

  hold_until_it_moves(*person);
  person->signal(SIGKILL);
  ASSERT_TRUE(wait_until([&] { return at_rest(); }));
}
/// The whole drive: three minutes, in the lab where there is one.
TEST_F(CalibrationDriveProcess, FindsWhatIsConfiguredWrong) {
  // Without gears its motors are too hot for circles.
  for (const char* file : {"sim.json", "drover.json"})
    configure(file, R"("options": {"node":)", R"("options": {"gear_ratio": 10, "node":)");
  configure("drover.json", R"("wheel_radius_m": 0.165)", R"("wheel_radius_m": 0.160)");
  configure("drover.json", R"("antenna_x_m": 0.1)", R"("antenna_x_m": 0.0)");
  start_new();
  const auto out = folder() / "calibration.txt";
  const auto at_it = at_terminal({"--out", out.string()});
  KeyHolder& person = *at_it;
  person.hold();
  bool ended = false;
  // However slow the programs are: ctest ends it after 10, without a word.
  const auto longest = std::min(6min * deadline_factor(), 8min);
  ASSERT_TRUE(wait_until(
      [&] {
        // What is not seen yet after one round is refused by name, and nothing is lost.
        if (!ended && person.shown().find("not seen well enough") != std::string::npos) {
          ended = true;
          person.let_go();
          person.type("q");
        }
        return person.status().has_value();
      },
      longest))
      << pieces_of(person.shown());
  EXPECT_EQ(person.status(), 0) << person.shown();
  std::ifstream file(out);
  const std::string text{std::istreambuf_iterator<char>(file), {}};
  std::printf("%s\n%s", pieces_of(person.shown()).c_str(), text.c_str());
  for (const auto& [name, truth] :
       {std::pair{"wheel_radius_m", 0.165}, std::pair{"antenna_x_m", 0.1},
        std::pair{"antenna_y_m", 0.0}, std::pair{"gyro_scale", 1.0}}) {
    const auto [value, interval] = found(text, name);
    EXPECT_NEAR(value, truth, interval) << name;
  }
  EXPECT_THAT(text, HasSubstr(R"({"groups":{"base":{"wheel_radius_m":0.16)"));
}
TEST_F(CalibrationDriveProcess, IsRefusedWhereAnotherProgramAnswersForTheTerminal) {
  for (const char* within : {"TMUX=/tmp/tmux-0/default,7,0", "STY=7.pts-0.robot"}) {
    const auto person = at_terminal({}, within);
    ASSERT_TRUE(wait_until([&] { return person->status().has_value(); })) << within;
    EXPECT_EQ(person->status(), 1) << within;
    ASSERT_TRUE(wait_until([&] {
      return person->shown().find("run it at a plain terminal") != std::string::npos;
    })) << person->shown();
  }
  // What sets no variable is known by its name.
  const auto shell = folder() / "mosh-server";
  std::filesystem::create_symlink("/bin/sh", shell);
  KeyHolder person(
      {shell.string(), "-c", "env -u TMUX -u STY '" DROVER_PROGRAM "' calibrate drive; exit $?"});
  ASSERT_TRUE(wait_until([&] { return person.status().has_value(); }));
  EXPECT_EQ(person.status(), 1);
  ASSERT_TRUE(wait_until([&] {
    return person.shown().find("this runs within mosh-server") != std::string::npos;
  })) << person.shown();
}
TEST_F(CalibrationDriveProcess, KeysThatComeLateCountForNothing) {
  start_new();
  const auto person = at_terminal();
  hold_until_it_moves(*person);
  person->answer_after_ms(600);
  ASSERT_TRUE(wait_until([&] { return at_rest(); })) << person->shown();
  expect_rest_for(1s, "a slow line");
  EXPECT_THAT(person->shown(), HasSubstr("s late, and count for nothing"));
  person->answer_after_ms(20);
  ASSERT_TRUE(wait_until([&] { return moves(); })) << person->shown();
}
TEST_F(CalibrationDriveProcess, ATerminalThatNeverAnswersDrivesNothing) {
  start_new();
  const auto person = at_terminal();
  person->answer_after_ms(-1);
  person->hold();
  ASSERT_TRUE(wait_until([&] {
    return person->shown().find("does not tell how late your keys come") != std::string::npos;
  })) << person->shown();
  expect_rest_for(2s, "nobody knows how late its keys come");
}
TEST_F(CalibrationDriveProcess, WhoEndsItGetsHisTerminalBack) {
  start_new();
  for (const int number : {SIGTERM, SIGHUP, SIGINT}) {
    SCOPED_TRACE(number);
    const auto person = at_terminal();
    const auto before = person->modes();
    ASSERT_NE(before & (ICANON | ECHO | ISIG), 0U);
    hold_until_it_moves(*person);
    ASSERT_NE(person->modes(), before);
    person->signal(number);
    ASSERT_TRUE(wait_until([&] { return person->status().has_value(); }));
    EXPECT_EQ(person->modes(), before);
    EXPECT_EQ(person->status(), 1) << "the ordinary end";
    ASSERT_TRUE(wait_until([&] {
      return person->shown().find("positions with an RTK fix") != std::string::npos;
    })) << person->shown();
    ASSERT_TRUE(wait_until([&] { return at_rest(); }));
    ASSERT_TRUE(wait_until([&] { return status_text("nav", "owner") != "manual"; }));
  }
}
TEST_F(CalibrationDriveProcess, WhatWasMeasuredIsJudgedWhenDroverdAnswersNoMore) {
  start_new();
  const auto person = at_terminal();
  hold_until_it_moves(*person);
  stop_daemon();
  ASSERT_TRUE(wait_until([&] { return person->status().has_value(); }));
  EXPECT_EQ(person->status(), 1);
  ASSERT_TRUE(wait_until([&] {
    return person->shown().find("positions with an RTK fix") != std::string::npos;
  })) << person->shown();
  EXPECT_THAT(person->shown(), HasSubstr("the drive ends here"));
}
TEST_F(CalibrationDriveProcess, EndsWithAKeyAndSaysWhatIsMissing) {
  start_new();
  const auto person = at_terminal();
  hold_until_it_moves(*person);
  const auto second = at_terminal();
  second->hold();
  ASSERT_TRUE(wait_until(
      [&] { return second->shown().find("somebody else drives") != std::string::npos; }));
  second->let_go();
  EXPECT_TRUE(moves());
  person->let_go();
  person->type("q");
  ASSERT_TRUE(wait_until([&] { return person->status().has_value(); }));
  EXPECT_EQ(person->status(), 1);
  ASSERT_TRUE(wait_until([&] {
    return person->shown().find("positions with an RTK fix") != std::string::npos;
  })) << person->shown();
  ASSERT_TRUE(wait_until([&] { return at_rest(); }));
}

}  // namespace
}  // namespace drover::test
