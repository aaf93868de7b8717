// Another program floods droverd's socket with questions: drover-ros2 keeps its line, a stop on
// /e_stop is obeyed as soon as without them and once, and a person's reset is answered.
#include <sys/socket.h>
#include <sys/un.h>

#include <algorithm>
#include <atomic>
#include <cstdio>
#include <cstring>
#include <ostream>
#include <thread>

#include "integration/ros2_drive_rig.h"
#include "link/unique_fd.h"

namespace drover::test {
namespace {

using namespace std::chrono_literals;
using testing::HasSubstr;
using testing::Not;

struct Crowd {
  const char* name;
  std::size_t clients;
  int lines;   ///< in each send
  bool reads;  ///< what is answered
};

void PrintTo(const Crowd& crowd, std::ostream* out) {
  *out << crowd.name;
}

std::size_t count_of(std::string_view text, std::string_view what) {
  std::size_t count = 0;
  for (auto at = text.find(what); at != std::string_view::npos; at = text.find(what, at + 1))
    ++count;
  return count;
}

/// Who is let go comes again.
void ask_on_and_on(const std::string& path, const Crowd& crowd, const std::atomic<bool>& end) {
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  std::strcpy(address.sun_path, path.c_str());
  std::string lines;
  for (int i = 0; i < crowd.lines; ++i) lines += "{\"cmd\":\"status\"}\n";
  std::vector<char> answer(std::size_t{1} << 20);
  std::vector<link::UniqueFd> clients;
  while (!end) {
    std::erase_if(clients, [](const link::UniqueFd& fd) { return !fd; });
    while (clients.size() < crowd.clients) {
      link::UniqueFd fd(::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0));
      if (::connect(fd.get(), reinterpret_cast<sockaddr*>(&address), sizeof address) != 0) break;
      clients.push_back(std::move(fd));
    }
    for (auto& fd : clients) {
      bool gone = ::send(fd.get(), lines.data(), lines.size(), MSG_NOSIGNAL) < 0 && errno != EAGAIN;
      if (!gone && crowd.reads) gone = ::recv(fd.get(), answer.data(), answer.size(), 0) == 0;
      if (gone) fd = {};
    }
    std::this_thread::sleep_for(1ms);
  }
}

class BesideACrowdThatAsks : public MovedFromRos2, public testing::WithParamInterface<Crowd> {
 protected:
  BesideACrowdThatAsks() : MovedFromRos2(R"("e_stop": true, "cmd_vel": "twist")") {}
  ~BesideACrowdThatAsks() override { end_crowd(); }

  void begin_crowd() {
    crowd_ = std::thread(
        [this] { ask_on_and_on((folder() / "run/drover.sock").string(), GetParam(), end_); });
  }
  void end_crowd() {
    end_ = true;
    if (crowd_.joinable()) crowd_.join();
  }
  bool drive_until(double vx_mps, const std::function<bool()>& done,
                   std::chrono::nanoseconds longest = 20s) {
    const geometry_msgs_msg_dds__Twist_ message{{vx_mps, 0, 0}, {0, 0, 0}};
    return repeat_until([&] { dds_write(writer_, &message); }, 50ms, done, longest);
  }
  /// It begins with zero, and on a machine that has no time begins again.
  void drive_off() {
    bool drives = false;
    for (int tries = 0; tries < 5 && !drives; ++tries) {
      (void)drive_until(
          0, [] { return false; }, 800ms);
      drives = drive_until(
          0.4, [this] { return true_speed_mps() > 0.2; }, 3s);
    }
    ASSERT_TRUE(drives) << status() << program_.output();
  }
  void drive_for(std::chrono::nanoseconds time) {
    (void)drive_until(
        0.4, [] { return false; }, time);
  }
  std::size_t stops() { return count_of(daemon().output(), "terminate_success"); }
  /// Once; the robot is told to drive on meanwhile.
  double stopped_after_s(dds_entity_t stop) {
    const std_msgs_msg_dds__Bool_ message{true};
    const double begin_s = now_s();
    dds_write(stop, &message);
    EXPECT_TRUE(drive_until(0.4, [this] { return at_rest(); })) << program_.output();
    return now_s() - begin_s;
  }

  std::thread crowd_;
  std::atomic<bool> end_{false};
};

TEST_P(BesideACrowdThatAsks, AStopIsObeyedOnceAndAResetIsAnswered) {
  ASSERT_NO_FATAL_FAILURE(start_robot(ros2::cmd_vel_kind(false)));
  const dds_entity_t stop = writer(ros2::stop_kind());
  ASSERT_TRUE(is_heard(stop));
  ASSERT_NO_FATAL_FAILURE(drive_off());
  const double quiet_s = stopped_after_s(stop);
  ASSERT_EQ(drover({"reset"}).code, 0);
  ASSERT_NO_FATAL_FAILURE(drive_off());

  begin_crowd();
  drive_for(2s);
  EXPECT_GT(true_speed_mps(), 0.1) << "its twists come through, too: " << program_.output();
  const auto before = stops();
  const double crowded_s = stopped_after_s(stop);
  std::printf("at rest %.2f s after the stop, %.2f s without the crowd\n", crowded_s, quiet_s);
  EXPECT_LT(crowded_s, 3 * quiet_s + 1);
  EXPECT_TRUE(wait_until([&] { return stops() > before; }, 5s)) << daemon().output();

  const auto reset = drover({"reset"});
  EXPECT_EQ(reset.code, 0) << reset.text;
  EXPECT_THAT(reset.text, HasSubstr("the stop is over"));
  (void)wait_until([] { return false; }, 3s);
  end_crowd();
  EXPECT_EQ(stops(), before + 1) << "nobody asked again: " << program_.output();
  EXPECT_THAT(program_.output(), Not(HasSubstr("has closed the connection")));
  EXPECT_THAT(program_.output(), Not(HasSubstr("it is told again")));
  ASSERT_NO_FATAL_FAILURE(drive_off());
}

INSTANTIATE_TEST_SUITE_P(Of, BesideACrowdThatAsks,
                         testing::Values(Crowd{"NeverReads", 500, 1, false},
                                         Crowd{"Reads", 500, 1, true},
                                         Crowd{"Bursts", 32, 200, true}),
                         [](const auto& crowd) { return std::string(crowd.param.name); });

}  // namespace
}  // namespace drover::test
