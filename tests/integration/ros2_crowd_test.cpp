// droverd's socket is crowded by clients that connect and say nothing: a stop on /e_stop finds its
// way all the same.
#include <sys/socket.h>
#include <sys/un.h>

#include <cstring>

#include "integration/ros2_drive_rig.h"
#include "link/unique_fd.h"

namespace drover::test {
namespace {

using namespace std::chrono_literals;
using testing::HasSubstr;

class BesideACrowd : public MovedFromRos2, public testing::WithParamInterface<int> {
 protected:
  BesideACrowd() : MovedFromRos2(R"("e_stop": true, "cmd_vel": "twist")") {}

  void say(double vx_mps) const {
    const geometry_msgs_msg_dds__Twist_ message{{vx_mps, 0, 0}, {0, 0, 0}};
    dds_write(writer_, &message);
  }
  bool drive_until(double vx_mps, const std::function<bool()>& done) {
    return repeat_until([&] { say(vx_mps); }, 50ms, done);
  }
  void drive_off() {
    const double rest_s = now_s() + 0.8;
    (void)drive_until(0, [rest_s] { return now_s() > rest_s; });
    ASSERT_TRUE(drive_until(0.4, [this] { return true_speed_mps() > 0.2; }))
        << status() << program_.output();
  }
  /// Every second one holds half a line.
  void crowd(int clients) {
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    std::strcpy(address.sun_path, (folder() / "run/drover.sock").c_str());
    for (int i = 0; i < clients; ++i) {
      link::UniqueFd fd(::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0));
      ASSERT_EQ(::connect(fd.get(), reinterpret_cast<sockaddr*>(&address), sizeof address), 0);
      if (i % 2 == 1) (void)::send(fd.get(), "{\"cmd\":", 7, MSG_NOSIGNAL);
      crowd_.push_back(std::move(fd));
    }
  }

  std::vector<link::UniqueFd> crowd_;
};

TEST_P(BesideACrowd, AStopOnEStopStopsTheRobot) {
  ASSERT_NO_FATAL_FAILURE(start_robot(ros2::cmd_vel_kind(false)));
  const dds_entity_t stop = writer(ros2::stop_kind());
  ASSERT_TRUE(is_heard(stop));
  // It follows already, and does not lose its place.
  ASSERT_NO_FATAL_FAILURE(crowd(GetParam()));
  ASSERT_NO_FATAL_FAILURE(drive_off());
  // It comes anew, and the robot has been told to move before.
  program_.signal(SIGKILL);
  (void)program_.wait(5s);
  ASSERT_NO_FATAL_FAILURE(crowd(GetParam()));
  start_program();
  ASSERT_TRUE(is_heard(stop));
  ASSERT_NO_FATAL_FAILURE(drive_off());
  const std_msgs_msg_dds__Bool_ message{true};
  dds_write(stop, &message);
  ASSERT_TRUE(drive_until(0.4, [this] { return at_rest(); })) << status() << program_.output();
  EXPECT_THAT(status(), HasSubstr("reset the stop first"));
}

INSTANTIATE_TEST_SUITE_P(Idle, BesideACrowd, testing::Values(32, 200));

}  // namespace
}  // namespace drover::test
