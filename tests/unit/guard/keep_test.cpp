// What a guard would find that is killed between any two words of the one before it to the service
// manager.
#include "guard/keep.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <cstdlib>
#include <cstring>
#include <deque>

#include "guard/sockets.h"
#include "support/temp_folder.h"

namespace drover::guard {
namespace {

/// The service manager: what it was told waits until the test lets it be taken.
class Manager {
 public:
  Manager() : path_(folder_.path() + "/notify") {
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    std::strcpy(address.sun_path, path_.c_str());
    fd_ = ::socket(AF_UNIX, SOCK_DGRAM | SOCK_NONBLOCK, 0);
    EXPECT_EQ(::bind(fd_, reinterpret_cast<const sockaddr*>(&address), sizeof address), 0);
    ::setenv("NOTIFY_SOCKET", path_.c_str(), 1);
  }
  ~Manager() {
    ::unsetenv("NOTIFY_SOCKET");
    ::close(fd_);
    for (const auto& one : kept_) ::close(one.fd);
  }
  /// One word; false when there is none.
  bool take() {
    std::array<char, 512> text{};
    PassedMessage message(text.data(), text.size() - 1);
    if (::recvmsg(fd_, &message.header(), MSG_DONTWAIT) <= 0) return false;
    const std::string words(text.data());
    const std::string name = words.substr(words.find("FDNAME=") + 7);
    const int fd = message.passed();
    if (words.find("FDSTORE=1") != std::string::npos) kept_.push_back({name, fd});
    if (words.find("FDSTOREREMOVE=1") == std::string::npos) return true;
    std::erase_if(kept_, [&](const Kept& one) { return one.name == name && ::close(one.fd) == 0; });
    return true;
  }
  std::vector<Kept> gives() const {
    std::vector<Kept> given = kept_;
    for (auto& one : given) one.fd = ::fcntl(one.fd, F_DUPFD_CLOEXEC, 0);
    return given;
  }

 private:
  test::TempFolder folder_;
  std::string path_;
  int fd_ = -1;
  std::vector<Kept> kept_;
};

struct Found {
  std::size_t axes = 0;
  bool latched = false;
};
Found next_guard(const Manager& manager) {
  Notify nobody;
  Keep keep(nobody);
  StopSet set;
  std::uint32_t limit_ms = 0;
  int memory = -1;
  keep.restore(manager.gives(), set, limit_ms, memory);
  return {set.axes(), keep.state().latched != 0};
}

void fill(StopSet& set, std::uint32_t axes) {
  GuardMessage link;
  link.verb = GuardVerb::link;
  std::strcpy(link.name.data(), "can0");
  ASSERT_TRUE(set.add_link(link, ::open("/dev/null", O_WRONLY | O_CLOEXEC)));
  for (std::uint32_t i = 0; i < axes; ++i) {
    GuardMessage axis;
    axis.verb = GuardVerb::axis;
    axis.index = i;
    axis.period_ms = 10;
    std::strcpy(axis.name.data(), ("can0 00" + std::to_string(i)).c_str());
    ASSERT_TRUE(set.add_axis(axis));
  }
}

/// How much the guard had said when it was told the next set.
class GuardKeep : public testing::TestWithParam<int> {};

TEST_P(GuardKeep, HasAWholeSetAndItsStateAfterEachWord) {
  Manager manager;
  Notify notify;
  Keep keep(notify);
  StopSet nothing;
  std::uint32_t limit_ms = 50;
  int memory = -1;
  ASSERT_FALSE(keep.restore({}, nothing, limit_ms, memory));

  StopSet first;
  fill(first, 1);
  keep.keep(first, limit_ms);
  for (int i = 0; i < 10; ++i) keep.step(first, -1);
  while (manager.take()) {
  }
  ASSERT_EQ(next_guard(manager).axes, 1U);
  keep.state().latched = 1;

  StopSet second;
  fill(second, 2);
  keep.keep(second, limit_ms);
  for (int i = 0; i < GetParam(); ++i) keep.step(second, -1);
  StopSet third;
  fill(third, 3);
  keep.keep(third, limit_ms);
  int words = 0;
  for (int i = 0; i < 10; ++i) {  // the queue between them is short
    keep.step(third, -1);
    while (manager.take()) {
      ++words;
      const auto found = next_guard(manager);
      EXPECT_GE(found.axes, 1U) << "after " << words << " words";
      EXPECT_TRUE(found.latched) << "after " << words << " words";
    }
  }
  EXPECT_EQ(next_guard(manager).axes, 3U);
  std::size_t recipes = 0;
  for (const auto& one : manager.gives()) {
    recipes += one.name.starts_with("recipe") ? 1 : 0;
    ::close(one.fd);
  }
  EXPECT_EQ(recipes, 1U);
}

INSTANTIATE_TEST_SUITE_P(WhenTheNextSetCame, GuardKeep, testing::Range(0, 5));

}  // namespace
}  // namespace drover::guard
