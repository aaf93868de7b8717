// Where the configuration wants nothing shown drover-ros2 says so and ends, before it has any
// socket.
#include <linux/filter.h>
#include <linux/seccomp.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/syscall.h>

#include <array>
#include <future>

#include "integration/ros2_rig.h"

namespace drover::test {
namespace {

using namespace std::chrono_literals;
using testing::HasSubstr;

/// Everything that this thread starts dies where it opens a socket.
void die_of_a_socket() {
  std::array<sock_filter, 4> rules{{
      BPF_STMT(BPF_LD | BPF_W | BPF_ABS, offsetof(seccomp_data, nr)),
      BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, SYS_socket, 0, 1),
      BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_KILL_PROCESS),
      BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_ALLOW),
  }};
  const sock_fprog program{rules.size(), rules.data()};
  ASSERT_EQ(::prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0), 0);
  ASSERT_EQ(::prctl(PR_SET_SECCOMP, SECCOMP_MODE_FILTER, &program), 0);
}

class Ros2Off : public Ros2Rig {
 protected:
  explicit Ros2Off(const std::string& mode = "off")
      : Ros2Rig(User::humble, R"(, "mode": ")" + mode + R"(", "inputs": {"e_stop": true})") {}

  /// Its exit status.
  std::optional<int> run(const std::vector<std::string>& options) {
    std::vector<std::string> words{DROVER_ROS2_PROGRAM};
    words.insert(words.end(), options.begin(), options.end());
    // It ends with the thread that starts it.
    return std::async(std::launch::async,
                      [&] {
                        die_of_a_socket();
                        program_ = Process(words, (folder_ / "log").string());
                        return program_.wait(10s);
                      })
        .get();
  }
  std::optional<int> run() { return run({"--config", (folder_ / "drover.json").string()}); }
};

TEST_F(Ros2Off, EndsAsAskedWithoutASocket) {
  EXPECT_EQ(run(), 0) << log();
  EXPECT_THAT(log(), HasSubstr("ros2.mode is off: nothing is shown"));
}

TEST_F(Ros2Off, IsWhatAConfigurationWithoutTheSectionIs) {
  EXPECT_EQ(run({"--config", DROVER_SOURCE_DIR "/config/examples/lidar.json"}), 0) << log();
  EXPECT_THAT(log(), HasSubstr("there is no section \"ros2\": nothing is shown"));
}

TEST_F(Ros2Off, IsOneOfTheExitCodesThatItsHelpHas) {
  EXPECT_EQ(run({"--help"}), 0);
  for (const char* code : {"0 ended as asked, or the configuration wants nothing shown",
                           "1 it could not go on", "2 wrong arguments or configuration"})
    EXPECT_THAT(log(), HasSubstr(code));
}

class Ros2On : public Ros2Off {
 protected:
  Ros2On() : Ros2Off("localhost") {}
};

// Else the tests above would show nothing.
TEST_F(Ros2On, DiesWhereItMayHaveNoSocket) {
  EXPECT_EQ(run(), 128 + SIGSYS) << log();
}

}  // namespace
}  // namespace drover::test
