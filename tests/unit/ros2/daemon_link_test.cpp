// The line to droverd: what has left, what has not, and what is heard of it.
#include "ros2/daemon_link.h"

#include <gtest/gtest.h>
#include <sys/socket.h>
#include <sys/un.h>

#include <cstring>
#include <vector>

#include "tests/support/temp_folder.h"

namespace drover::ros2 {
namespace {

using namespace std::chrono_literals;

/// A droverd that only listens.
class TheLineToDroverd : public ::testing::Test {
 protected:
  void listen() {
    server = link::UniqueFd(::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0));
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    std::strncpy(address.sun_path, path.c_str(), sizeof address.sun_path - 1);
    ASSERT_EQ(::bind(server.get(), reinterpret_cast<sockaddr*>(&address), sizeof address), 0);
    ASSERT_EQ(::listen(server.get(), 4), 0);
  }
  void accept() {
    client = link::UniqueFd(::accept4(server.get(), nullptr, nullptr, SOCK_CLOEXEC));
    ASSERT_TRUE(client);
  }
  void write(const std::string& text) const {
    ASSERT_EQ(::send(client.get(), text.data(), text.size(), MSG_NOSIGNAL),
              static_cast<ssize_t>(text.size()));
  }
  std::vector<std::string> heard() {
    std::vector<std::string> lines;
    line.hear([&](std::string_view text) { lines.emplace_back(text); });
    return lines;
  }
  test::TempFolder folder;
  std::string path = folder.path() + "/drover.sock";
  link::UniqueFd server;
  link::UniqueFd client;
  DaemonLink line{path};
  Time now{100s};
};

TEST_F(TheLineToDroverd, SaysThatNothingLeavesWhereNobodyListens) {
  line.keep(now);
  EXPECT_FALSE(line.connected());
  EXPECT_FALSE(line.send("{}"));
  EXPECT_NE(line.problem(), "");
}
TEST_F(TheLineToDroverd, WaitsLongerAfterEachTryUnlessItIsHurried) {
  for (int i = 0; i < 10; ++i) line.keep(now += 10s);
  listen();
  line.keep(now += 1s);
  EXPECT_FALSE(line.connected()) << "it waits five seconds by now";
  line.hurry();
  line.keep(now);
  EXPECT_TRUE(line.connected());
  EXPECT_TRUE(line.send("{}"));
}
TEST_F(TheLineToDroverd, IsLostWithAWordWhereDroverdDoesNotRead) {
  listen();
  line.keep(now);
  accept();
  const std::string text(4096, 'x');
  int left = 0;
  while (left < 10000 && line.send(text)) ++left;
  EXPECT_GT(left, 0);
  EXPECT_LT(left, 10000);
  EXPECT_FALSE(line.connected()) << "half a line would be read as one";
  EXPECT_NE(line.problem().find("does not read"), std::string::npos);
}
TEST_F(TheLineToDroverd, HearsWholeLinesHoweverTheyCome) {
  listen();
  line.keep(now);
  accept();
  write("one\ntw");
  EXPECT_EQ(heard(), std::vector<std::string>{"one"});
  write("o\nthree\n");
  EXPECT_EQ(heard(), (std::vector<std::string>{"two", "three"}));
  EXPECT_TRUE(heard().empty());
}
TEST_F(TheLineToDroverd, GivesUpALineWithoutAnEnd) {
  listen();
  line.keep(now);
  accept();
  const std::string block(32768, 'x');
  for (int i = 0; i < 100 && line.connected(); ++i) {
    write(block);
    (void)heard();
  }
  EXPECT_FALSE(line.connected());
  EXPECT_NE(line.problem().find("without an end"), std::string::npos);
}
TEST_F(TheLineToDroverd, HearsWhatDroverdSaidBeforeItWent) {
  listen();
  line.keep(now);
  accept();
  write("one\ntwo\nthr");
  client.reset();
  EXPECT_FALSE(line.send("{}")) << "it is the first to notice";
  EXPECT_FALSE(line.connected());
  EXPECT_EQ(heard(), (std::vector<std::string>{"one", "two"}));
  line.keep(now += 10s);
  accept();
  write("four\n");
  EXPECT_EQ(heard(), std::vector<std::string>{"four"}) << "half a line of another droverd";
}
TEST_F(TheLineToDroverd, MaySayMoreOnEachLineThatItHears) {
  listen();
  line.keep(now);
  accept();
  write("one\ntwo\n");
  client.reset();
  std::vector<std::string> lines;
  line.hear([&](std::string_view text) {
    lines.emplace_back(text);
    (void)line.send("{}");
  });
  EXPECT_EQ(lines, (std::vector<std::string>{"one", "two"}));
}
TEST_F(TheLineToDroverd, IsGoneWhenDroverdClosesIt) {
  listen();
  line.keep(now);
  accept();
  client.reset();
  EXPECT_TRUE(heard().empty());
  EXPECT_FALSE(line.connected());
}

}  // namespace
}  // namespace drover::ros2
