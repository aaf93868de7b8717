#include "runtime/systemd_notify.h"

#include <gtest/gtest.h>
#include <sys/socket.h>
#include <sys/un.h>

#include <array>
#include <cstdlib>
#include <cstring>

#include "runtime/clock.h"
#include "support/temp_folder.h"

namespace drover::runtime {
namespace {

using namespace std::chrono_literals;

/// Stands in for systemd: a datagram socket that reads when it is asked to.
class SystemdNotifyTest : public testing::Test {
 protected:
  SystemdNotifyTest()
      : path_(folder_.path() + "/notify"),
        socket_(::socket(AF_UNIX, SOCK_DGRAM | SOCK_NONBLOCK, 0)) {
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    std::strncpy(address.sun_path, path_.c_str(), sizeof address.sun_path - 1);
    EXPECT_EQ(::bind(socket_.get(), reinterpret_cast<sockaddr*>(&address), sizeof address), 0);
    ::setenv("NOTIFY_SOCKET", path_.c_str(), 1);
  }
  ~SystemdNotifyTest() override { ::unsetenv("NOTIFY_SOCKET"); }
  std::string heard() const {
    std::array<char, 256> text{};
    const auto n = ::recv(socket_.get(), text.data(), text.size(), 0);
    return n > 0 ? std::string(text.data(), static_cast<std::size_t>(n)) : "";
  }

  test::TempFolder folder_;
  std::string path_;
  link::UniqueFd socket_;
};

TEST_F(SystemdNotifyTest, TellsWhatItIsAsked) {
  SystemdNotify notify;
  EXPECT_TRUE(notify.tell("READY=1"));
  EXPECT_EQ(heard(), "READY=1");
}

TEST_F(SystemdNotifyTest, NeverWaitsForAReaderWhoStoppedReading) {
  SystemdNotify notify;
  const Time begin = monotonic_now();
  int taken = 0;
  while (notify.tell("WATCHDOG=1")) ASSERT_LT(++taken, 100'000);
  EXPECT_FALSE(notify.tell("READY=1"));
  EXPECT_LT(monotonic_now() - begin, 2s);
  while (!heard().empty()) {
  }
  EXPECT_TRUE(notify.tell("READY=1")) << "another try succeeds when it reads again";
}

TEST_F(SystemdNotifyTest, SaysNothingWithoutSystemd) {
  ::unsetenv("NOTIFY_SOCKET");
  EXPECT_TRUE(SystemdNotify().tell("READY=1"));
  EXPECT_EQ(heard(), "");
}

}  // namespace
}  // namespace drover::runtime
