// Who of many has to go, who is heard first, and what one who asks much leaves to others.
#include <gmock/gmock.h>
#include <sys/wait.h>
#include <unistd.h>

#include <filesystem>

#include "tests/unit/runtime/cli_server_fixture.h"

namespace drover::runtime {
namespace {

using testing::ElementsAre;

class CliServerCrowd : public CliServerTest {
 protected:
  CliServerCrowd() {
    server_->stops_first([](std::string_view line) { return line == "stop"; }, stops_);
  }
  /// Of another program, as far as the server can know: that one connects, and is gone.
  std::vector<link::UniqueFd> crowd(std::size_t count, uid_t user = ::getuid()) const {
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    std::strcpy(address.sun_path, "drover.sock");
    std::vector<link::UniqueFd> all;
    for (std::size_t i = 0; i < count; ++i)
      all.emplace_back(::socket(AF_UNIX, SOCK_STREAM | SOCK_NONBLOCK, 0));
    const pid_t child = ::fork();
    if (child == 0) {
      bool well = ::chdir(folder_.c_str()) == 0 && ::setuid(user) == 0;
      for (const auto& fd : all)
        well =
            ::connect(fd.get(), reinterpret_cast<sockaddr*>(&address), sizeof address) == 0 && well;
      ::_exit(well ? 0 : 1);
    }
    int status = -1;
    EXPECT_EQ(::waitpid(child, &status, 0), child);
    EXPECT_EQ(status, 0);
    return all;
  }
  static void say(const link::UniqueFd& fd, std::string_view text) {
    ASSERT_EQ(::send(fd.get(), text.data(), text.size(), MSG_NOSIGNAL),
              static_cast<ssize_t>(text.size()));
  }
  static std::string repeated(std::string_view line, int times) {
    std::string all;
    for (int i = 0; i < times; ++i) all += line;
    return all;
  }
  std::size_t place_of(std::string_view line) const {
    return static_cast<std::size_t>(std::find(lines_.begin(), lines_.end(), line) - lines_.begin());
  }

  StopRequests stops_;
};

TEST_F(CliServerCrowd, PushesItselfOutAndNobodyWhoComesAlone) {
  const auto alone = connect();
  say(alone, "follow\n");
  work();
  std::vector<link::UniqueFd> all;
  for (int round = 0; round < 8; ++round) {
    for (auto& fd : crowd(64)) {
      say(fd, "status\n");
      all.push_back(std::move(fd));
    }
    work_now();
  }
  EXPECT_EQ(read(alone), "got follow\n");
  EXPECT_TRUE(is_open(alone)) << "he has been idle longest";
  const auto another = connect();
  work_now();
  EXPECT_TRUE(is_open(alone));
  EXPECT_TRUE(is_open(another));
}

TEST_F(CliServerCrowd, OfManyProgramsOfOneUserPushesOutNobodyElses) {
  if (::geteuid() != 0) GTEST_SKIP() << "only root can be two users";
  namespace fs = std::filesystem;
  fs::permissions(folder_, fs::perms::group_exec, fs::perm_options::add);
  const auto alone = connect();
  say(alone, "follow\n");
  work();
  std::vector<link::UniqueFd> all;
  for (int i = 0; i < 60; ++i) {
    auto one = crowd(1, 65534);
    say(one[0], "status\n");
    all.push_back(std::move(one[0]));
    work_now();
  }
  EXPECT_EQ(read(alone), "got follow\n");
  EXPECT_TRUE(is_open(alone));
}

TEST_F(CliServerCrowd, IsLetInAtOnceSoThatNobodyWaitsBehindIt) {
  const auto all = crowd(100);
  const auto behind = connect();
  say(behind, "reset\n");
  server_->on_ready();
  EXPECT_EQ(read(behind), "got reset\n");
}

TEST_F(CliServerCrowd, AStopGoesBeforeAllThatWaits) {
  auto all = crowd(CliServer::kMaxClients - 2);
  const auto stopping = connect();
  const auto asking = connect();
  work_now();
  for (const auto& fd : all) say(fd, repeated("status\n", 100));
  say(asking, "one\ntwo\nstop\n");
  say(stopping, "stop\n");
  server_->on_ready();
  ASSERT_GE(lines_.size(), 2U);
  EXPECT_EQ(lines_[0], "stop");
  EXPECT_EQ(lines_[1], "stop");
  EXPECT_EQ(read(stopping), "got stop\n");
  work_now();
  EXPECT_EQ(read(asking), "got stop\ngot one\ngot two\n");
}

TEST_F(CliServerCrowd, ABurstOfOneProgramLeavesOthersTheirTurn) {
  auto all = crowd(CliServer::kMaxClients - 1);
  const auto other = connect();
  work_now();
  for (const auto& fd : all) say(fd, repeated("status\n", 200));
  server_->on_ready();
  const auto before = lines_.size();
  EXPECT_LE(before, 8U) << "a turn is short";
  say(other, "reset\n");
  server_->on_ready();
  EXPECT_EQ(read(other), "got reset\n");
  work();
  EXPECT_EQ(lines_.size(), all.size() * 200 + 1) << "nothing of it is lost";
}

TEST_F(CliServerCrowd, OfOneProgramEachClientHasItsTurn) {
  const auto first = connect();
  const auto second = connect();
  work_now();
  say(first, repeated("a\n", 100));
  say(second, "b\n");
  server_->on_ready();
  EXPECT_LT(place_of("b"), 2U);
}

TEST_F(CliServerCrowd, WhoWaitsForAnAnswerDoesNotMakeRoom) {
  CliServer::ClientId waiting = 0;
  CliServer* itself = nullptr;
  CliServer server(folder_ + "/late.sock", [&](CliServer::ClientId id, std::string_view line) {
    if (line == "reset")
      waiting = id;
    else
      itself->reply(id, "?");
  });
  itself = &server;
  const auto resetting = connect("/late.sock");
  say(resetting, "reset\n");
  server.on_ready();
  ASSERT_NE(waiting, 0U);
  std::vector<link::UniqueFd> all;
  for (int i = 0; i < 100; ++i) {
    all.push_back(connect("/late.sock"));
    say(all.back(), "status\n");
    server.on_ready();
  }
  server.reply(waiting, "done");
  EXPECT_EQ(read(resetting), "done\n");
}

/// A reset that was asked for before a stop must not end it.
TEST_F(CliServerCrowd, ALineKnowsWhichStopsWereAskedForBeforeItCame) {
  std::vector<std::pair<std::string, std::uint64_t>> heard;
  CliServer* itself = nullptr;
  CliServer server(folder_ + "/order.sock", [&](CliServer::ClientId, std::string_view line) {
    heard.emplace_back(line, itself->before().stops);
    if (line == "stop") stops_.ask_stop();
  });
  itself = &server;
  server.stops_first([](std::string_view line) { return line == "stop"; }, stops_);
  const auto fd = connect("/order.sock");
  say(fd, "early\nstop\nlate\n");
  pollfd ready{server.fd(), POLLIN, 0};
  while (::poll(&ready, 1, 20) == 1) server.on_ready();
  using Heard = std::pair<std::string, std::uint64_t>;
  EXPECT_THAT(heard, ElementsAre(Heard{"stop", 0}, Heard{"early", 0}, Heard{"late", 1}));
}

}  // namespace
}  // namespace drover::runtime
