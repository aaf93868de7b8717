// The guard's own CAN sockets, on a real CAN interface: lab_test.sh runs this in the lab's kernel.
#include <linux/can.h>
#include <linux/can/raw.h>
#include <net/if.h>
#include <sys/socket.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "integration/guard_rig.h"
#include "integration/process.h"

namespace drover::test {
namespace {

using namespace std::chrono_literals;

/// droverd with two drives on can0 and can1, and nothing else.
constexpr const char* kDroverFile = R"({
  "paths": {"state": "@/state", "run": "@/run"},
  "links": {"one": {"can": "can0"}, "two": {"can": "can1"}},
  "devices": {
    "left": {"driver": "odrive", "link": "one", "options": {"node": 0},
             "accept": ["no_watchdog"]},
    "right": {"driver": "odrive", "link": "two", "options": {"node": 1},
              "accept": ["no_watchdog"]}},
  "groups": {"base": {"kind": "differential", "wheel_radius_m": 0.1, "track_m": 0.4,
                      "hold": "level_ground_only", "hold_again": false,
                      "left": ["left"], "right": ["right"]}},
  "guard": {"socket": "@/guard.sock"},
  "mqtt": {"enabled": false},
  "accept": ["no_estop"]
})";

class GuardInTheLab : public GuardRig {
 protected:
  void start_daemon() {
    const auto folder = std::filesystem::path(file("guard.sock")).parent_path().string();
    std::string text(kDroverFile);
    for (auto at = text.find('@'); at != std::string::npos; at = text.find('@', at))
      text.replace(at, 1, folder);
    std::ofstream(file("drover.json")) << text;
    std::filesystem::create_directories(folder + "/run");
    const auto log = file(("droverd.log" + std::to_string(++daemons_)).c_str());
    daemon_ = Process({DROVERD_PROGRAM, "-c", file("drover.json")}, log);
    ASSERT_TRUE(wait_until([this] {
      return daemon_.output().find("drover-guard watches the drives") != std::string::npos;
    })) << daemon_.output();
  }
  void kill_daemon() { daemon_ = Process(); }
  std::string daemon_output() const { return daemon_.output(); }
  void ip(std::vector<std::string> words) {
    words.insert(words.begin(), {"/usr/bin/env", "ip"});
    EXPECT_EQ(Process(words, file("ip.log")).wait(10s), 0) << words.back();
  }
  /// Somebody sends frames there soon.
  static bool is_stopped_on(const char* interface) {
    const auto fd = can_socket(interface);
    return wait_until([&] {
      can_frame frame{};
      return ::recv(fd.get(), &frame, sizeof frame, MSG_DONTWAIT) == sizeof frame;
    });
  }
  /// Copies of all CAN sockets that the guard has.
  std::vector<link::UniqueFd> can_sockets_of_the_guard() const {
    const link::UniqueFd process(static_cast<int>(::syscall(SYS_pidfd_open, pid(), 0)));
    std::vector<link::UniqueFd> sockets;
    const auto folder = "/proc/" + std::to_string(pid()) + "/fd";
    for (const auto& entry : std::filesystem::directory_iterator(folder)) {
      const int number = std::stoi(entry.path().filename().string());
      link::UniqueFd fd(static_cast<int>(::syscall(SYS_pidfd_getfd, process.get(), number, 0)));
      int domain = 0;
      socklen_t size = sizeof domain;
      if (fd && ::getsockopt(fd.get(), SOL_SOCKET, SO_DOMAIN, &domain, &size) == 0 &&
          domain == PF_CAN)
        sockets.push_back(std::move(fd));
    }
    return sockets;
  }
  /// Somebody else's frames, with each kind of identifier that there is.
  static void talk_on(const char* interface) {
    const auto fd = can_socket(interface);
    for (const canid_t id : {0x001U, 0x00DU, 0x123U | CAN_RTR_FLAG, 0x1F334455U | CAN_EFF_FLAG}) {
      can_frame frame{};
      frame.can_id = id;
      ASSERT_EQ(::write(fd.get(), &frame, sizeof frame), ssize_t{sizeof frame});
    }
  }

 private:
  static link::UniqueFd can_socket(const char* interface) {
    link::UniqueFd fd(::socket(PF_CAN, SOCK_RAW | SOCK_CLOEXEC, CAN_RAW));
    sockaddr_can address{};
    address.can_family = AF_CAN;
    address.can_ifindex = static_cast<int>(::if_nametoindex(interface));
    EXPECT_EQ(::bind(fd.get(), reinterpret_cast<sockaddr*>(&address), sizeof address), 0);
    return fd;
  }

  Process daemon_;
  int daemons_ = 0;
};

TEST_F(GuardInTheLab, HasCanSocketsWithAnEmptyFilterInWhichNothingPilesUp) {
  ASSERT_NE(::if_nametoindex("can1"), 0U) << "this test needs the lab: see lab_test.sh";
  start();
  ASSERT_NO_FATAL_FAILURE(start_daemon());
  const auto sockets = can_sockets_of_the_guard();
  ASSERT_EQ(sockets.size(), 2U) << "one for each bus";
  for (const char* interface : {"can0", "can1"}) ASSERT_NO_FATAL_FAILURE(talk_on(interface));
  for (const auto& socket : sockets) {
    std::array<can_filter, 8> filters{};
    socklen_t size = sizeof filters;
    ASSERT_EQ(::getsockopt(socket.get(), SOL_CAN_RAW, CAN_RAW_FILTER, filters.data(), &size), 0);
    EXPECT_EQ(size, 0U) << "it hears something";
    can_err_mask_t errors = 0;
    size = sizeof errors;
    ASSERT_EQ(::getsockopt(socket.get(), SOL_CAN_RAW, CAN_RAW_ERR_FILTER, &errors, &size), 0);
    EXPECT_EQ(errors, 0U) << "it hears error frames";
    can_frame frame{};
    EXPECT_EQ(::recv(socket.get(), &frame, sizeof frame, MSG_PEEK | MSG_DONTWAIT), -1)
        << "a frame waits in it that nobody reads";
    EXPECT_EQ(errno, EAGAIN);
  }
}

TEST_F(GuardInTheLab, KeepsItsWayToAnInterfaceThatIsDownWhileDroverdIsBegunAnew) {
  ASSERT_NE(::if_nametoindex("can1"), 0U) << "this test needs the lab: see lab_test.sh";
  start();
  ASSERT_NO_FATAL_FAILURE(start_daemon());
  ip({"link", "set", "can1", "down"});
  kill_daemon();
  EXPECT_TRUE(is_stopped_on("can0"));
  ASSERT_NO_FATAL_FAILURE(start_daemon());
  EXPECT_NE(daemon_output().find("two is not there, and it keeps the way there that it has"),
            std::string::npos)
      << daemon_output();
  EXPECT_NE(at_stop_socket("state").find("\"set_refused\":false"), std::string::npos);
  kill_daemon();
  EXPECT_TRUE(is_stopped_on("can0"));
  ip({"link", "set", "can1", "up"});
  EXPECT_TRUE(is_stopped_on("can1")) << "by a descriptor that no living droverd gave";
}

TEST_F(GuardInTheLab, StopsWhatIsOnAnInterfaceThatCameBackAsAnother) {
  ASSERT_NE(::if_nametoindex("can1"), 0U) << "this test needs the lab: see lab_test.sh";
  start();
  ASSERT_NO_FATAL_FAILURE(start_daemon());
  ip({"link", "del", "can1"});
  kill_daemon();
  ASSERT_NO_FATAL_FAILURE(start_daemon());
  ip({"link", "add", "dev", "can1", "type", "vcan"});
  ip({"link", "set", "can1", "up"});
  EXPECT_TRUE(wait_until([this] {
    return daemon_output().find("watches the drives (one, two)") != std::string::npos;
  })) << daemon_output();
  kill_daemon();
  EXPECT_TRUE(is_stopped_on("can0"));
  EXPECT_TRUE(is_stopped_on("can1"));
}

}  // namespace
}  // namespace drover::test
