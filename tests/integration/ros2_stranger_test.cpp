// One on another computer who never hears an answer, but knows what DDS says on the wire, tries to
// stop the robot. As it is shipped drover-ros2 hears nothing of it; without the call that closes
// its sockets to networks it does.
#include <linux/filter.h>
#include <linux/seccomp.h>
#include <sys/prctl.h>
#include <sys/socket.h>
#include <sys/syscall.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <future>
#include <iostream>
#include <thread>

#include "integration/ros2_rig.h"
#include "integration/rtps_by_hand.h"
#include "integration/two_computers.h"

namespace drover::test {
namespace {

using namespace std::chrono_literals;

constexpr int kAttempts = 100;
constexpr std::array<std::uint8_t, 8> kTrue{0, 1, 0, 0, 1, 0, 0, 0};

/// Of everything that this thread starts no socket is closed, by a filter or by a device. `error`:
/// as it is told of that; 0: it believes that they are.
void forgo_closing(std::uint32_t error = 0) {
  constexpr auto kArgument = static_cast<std::uint32_t>(offsetof(seccomp_data, args));
  std::array<sock_filter, 10> rules{{
      BPF_STMT(BPF_LD | BPF_W | BPF_ABS, offsetof(seccomp_data, nr)),
      BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, SYS_setsockopt, 0, 7),
      BPF_STMT(BPF_LD | BPF_W | BPF_ABS, kArgument + 8),  // the lower half, little endian
      BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, SOL_SOCKET, 0, 5),
      BPF_STMT(BPF_LD | BPF_W | BPF_ABS, kArgument + 16),
      BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, SO_BINDTODEVICE, 2, 0),
      BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, SO_ATTACH_FILTER, 1, 0),
      BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, SO_LOCK_FILTER, 0, 1),
      BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_ERRNO | error),
      BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_ALLOW),
  }};
  const sock_fprog program{rules.size(), rules.data()};
  ASSERT_EQ(::prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0), 0);
  ASSERT_EQ(::prctl(PR_SET_SECCOMP, SECCOMP_MODE_FILTER, &program), 0);
}

/// One way to say it.
struct Way {
  const char* name;
  std::uint32_t from;
  std::uint32_t to;
  bool as_known;  ///< in the name of a writer that is matched already
};

constexpr std::array kWays{
    Way{"from its own address", kThere, kHere, false},
    Way{"as if from 127.0.0.1", kLoopback, kHere, false},
    Way{"to 127.0.0.1 over the wire", kThere, kLoopback, false},
    Way{"in the name of a matched writer", kThere, kHere, true},
    Way{"in the name of a matched writer as if from 127.0.0.1", kLoopback, kHere, true},
};

class Ros2Stranger : public TwoComputers, public Ros2Rig {
 protected:
  Ros2Stranger() : Ros2Rig(User::humble, R"(, "inputs": {"e_stop": true})") {}

  /// drover-ros2, and a program on its own computer that it hears.
  void start(const std::function<void()>& before) {
    open_daemon();
    before();
    known_ = stop_writer(DDS_RELIABILITY_BEST_EFFORT);
    ASSERT_TRUE(play_until([this] {
      dds_publication_matched_status_t matched{};
      (void)dds_get_publication_matched_status(known_, &matched);
      return matched.current_count > 0;
    })) << log();
    const std_msgs_msg_dds__Bool_ stop{true};
    ASSERT_TRUE(play_until([&] {
      dds_write(known_, &stop);
      return stops_ > 0;
    })) << "its own computer is not heard\n"
        << log();
    play_for(300ms);  // whatever is left of it
    ASSERT_THAT(log(), testing::HasSubstr("programs on this computer may stop this robot"));
  }

  /// How many of the attempts asked for a stop: drover-ros2 asks ten times a second at most, so of
  /// those that were accepted each fifth or so is counted.
  int accepted(const Way& way) {
    const rtps::Guid writer = writer_of(way);
    const int before = stops_;
    for (int i = 0; i < kAttempts; ++i) {
      attempt(way, writer);
      play_for(10ms);
    }
    play_for(300ms);
    return stops_ - before;
  }

 private:
  rtps::Guid writer_of(const Way& way) {
    if (!way.as_known) return {0xd0, 0x0d, ++strangers_, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1, 3};
    rtps::Guid writer{};
    dds_guid_t guid{};
    EXPECT_EQ(dds_get_guid(known_, &guid), DDS_RETCODE_OK);
    std::copy(std::begin(guid.v), std::end(guid.v), writer.begin());
    return writer;
  }
  void attempt(const Way& way, const rtps::Guid& writer) {
    if (!way.as_known) {
      const auto there = rtps::participant(writer, domain());
      send({way.from, 7400}, {0xefff'0001, port(0)}, there);  // 239.255.0.1, all who listen
      say(way, 0, there);
      for (const int one : {10, 12, 14, 16}) {
        say(way, one, there);
        say(way, one, rtps::publication(writer, "rt/e_stop", "std_msgs::msg::dds_::Bool_"));
      }
    }
    ++number_;
    for (const int one : {11, 13, 15, 17}) say(way, one, rtps::data(writer, number_, kTrue));
  }
  std::uint16_t port(int of) const {
    return static_cast<std::uint16_t>(7400 + 250 * domain() + of);
  }
  void say(const Way& way, int to, const rtps::Bytes& datagram) {
    send({way.from, 7411}, {way.to, port(to)}, datagram);
  }

  dds_entity_t known_ = 0;
  std::uint8_t strangers_ = 0;
  std::uint32_t number_ = 1000;  ///< beyond what the matched writer has written
};

TEST_F(Ros2Stranger, IsNotHeardInLocalhostInAnyWay) {
  ASSERT_NO_FATAL_FAILURE(start([this] { start_program(); }));
  for (const Way& way : kWays) EXPECT_EQ(accepted(way), 0) << way.name << "\n" << log();
}

// Else the test above would show nothing.
TEST_F(Ros2Stranger, IsHeardInEachWayWhereNoSocketIsClosed) {
  std::promise<void> end;
  std::promise<void> started;
  // It lives as long as drover-ros2, which ends with whoever started it.
  std::thread starter([&] {
    forgo_closing();
    start_program();
    started.set_value();
    end.get_future().wait();
  });
  started.get_future().wait();
  start([] {});
  for (const Way& way : kWays) {
    const int count = HasFatalFailure() ? 0 : accepted(way);
    std::cout << kAttempts << " attempts " << way.name << ": " << count << " stops\n";
    EXPECT_GT(count, 0) << way.name << "\n" << log();
  }
  end.set_value();
  starter.join();
}

TEST_F(Ros2Stranger, FindsNothingOpenWhereTheSocketsCannotBeClosed) {
  std::promise<void> end;
  std::promise<void> started;
  std::thread starter([&] {
    forgo_closing(EPERM);
    start_program();
    started.set_value();
    end.get_future().wait();
  });
  started.get_future().wait();
  open_daemon();
  const dds_entity_t known = stop_writer(DDS_RELIABILITY_BEST_EFFORT);
  EXPECT_TRUE(play_until([this] {
    return log().find("cannot be closed to networks: Operation not permitted") != std::string::npos;
  })) << log();
  EXPECT_TRUE(play_until([this] {
    return last_request_.find("cannot be closed to networks") != std::string::npos;
  })) << "drover status does not say why";
  play_for(3s);
  dds_publication_matched_status_t matched{};
  (void)dds_get_publication_matched_status(known, &matched);
  EXPECT_EQ(matched.total_count, 0U) << "it is heard all the same";
  EXPECT_THAT(log(), testing::Not(testing::HasSubstr("see this robot")));
  end.set_value();
  starter.join();
}

}  // namespace
}  // namespace drover::test
