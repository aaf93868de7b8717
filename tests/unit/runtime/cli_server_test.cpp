#include "runtime/cli_server.h"

#include <cstring>
#include <filesystem>

#include "tests/unit/runtime/cli_server_fixture.h"

namespace drover::runtime {
namespace {

TEST_F(CliServerTest, TellsOfAClientThatIsGone) {
  std::vector<CliServer::ClientId> gone;
  server_->on_gone([&gone](CliServer::ClientId id) { gone.push_back(id); });
  auto first = connect();
  const auto second = connect();
  work();
  EXPECT_TRUE(gone.empty());
  first.reset();
  work();
  ASSERT_EQ(gone.size(), 1U);
  (void)!::send(second.get(), "a\n", 2, MSG_NOSIGNAL);
  work();
  EXPECT_EQ(read(second), "got a\n");
  EXPECT_EQ(gone.size(), 1U);
}

TEST_F(CliServerTest, ClosesAClientWhoseRequestNeverEnds) {
  const auto client = connect();
  work();
  const std::string flood(8192, 'x');
  for (int i = 0; i < 16; ++i) {
    (void)!::send(client.get(), flood.data(), flood.size(), MSG_NOSIGNAL);
    work();
  }
  EXPECT_TRUE(lines_.empty());
  char byte = 0;
  EXPECT_LE(::recv(client.get(), &byte, 1, 0), 0);
  const auto next = connect();  // others are served
  ASSERT_EQ(::send(next.get(), "a\n", 2, 0), 2);
  work();
  EXPECT_EQ(read(next), "got a\n");
}

TEST_F(CliServerTest, PutsRequestsTogetherHoweverTheyAreCut) {
  const auto client = connect();
  for (const char* part : {"o", "ne\ntw", "o\n"}) {
    ASSERT_GT(::send(client.get(), part, std::strlen(part), 0), 0);
    work();
  }
  EXPECT_EQ(lines_, (std::vector<std::string>{"one", "two"}));
  EXPECT_EQ(read(client), "got one\ngot two\n");
}

TEST_F(CliServerTest, TakesALongLineOnlyOfTheKindThatMayBeLong) {
  std::vector<std::size_t> sizes;
  CliServer server(
      folder_ + "/long.sock",
      [&](CliServer::ClientId, std::string_view line) { sizes.push_back(line.size()); }, "long:");
  const auto say = [&](const std::string& text) {
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    std::strcpy(address.sun_path, (folder_ + "/long.sock").c_str());
    link::UniqueFd fd(::socket(AF_UNIX, SOCK_STREAM | SOCK_NONBLOCK, 0));
    EXPECT_EQ(::connect(fd.get(), reinterpret_cast<sockaddr*>(&address), sizeof address), 0);
    send_all(fd, text, server);
    return fd;
  };
  const std::string kilobytes(200'000, 'x');
  (void)say("long:" + kilobytes + "\n");
  EXPECT_EQ(sizes, std::vector<std::size_t>{kilobytes.size() + 5});
  (void)say("other:" + kilobytes + "\n");
  EXPECT_EQ(sizes.size(), 1U);
  (void)say("long:" + std::string(std::size_t{7} << 20, 'x') + "\n");
  EXPECT_EQ(sizes.size(), 1U) << "it has an end, too";
  const auto first = say("long:" + kilobytes);
  (void)say("long:" + kilobytes + "\n");
  EXPECT_EQ(sizes.size(), 1U) << "of one client at a time";
  send_all(first, "\n", server);
  EXPECT_EQ(sizes.size(), 2U);
}

TEST_F(CliServerTest, ForgetsAClientThatIsGone) {
  {
    const auto client = connect();
    ASSERT_GT(::send(client.get(), "x\n", 2, 0), 0);
  }
  work();
  EXPECT_EQ(lines_.size(), 1U);
  server_->reply(1, "nobody hears this");
  work();
}

TEST_F(CliServerTest, LetsGoWhoAsksOnAndOnAndDoesNotRead) {
  std::size_t asked = 0;
  const std::string large(1'000'000, 'x');
  CliServer* answers = nullptr;
  CliServer server(folder_ + "/large.sock", [&](CliServer::ClientId id, std::string_view) {
    ++asked;
    answers->reply(id, large);
  });
  answers = &server;
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  std::strcpy(address.sun_path, (folder_ + "/large.sock").c_str());
  link::UniqueFd fd(::socket(AF_UNIX, SOCK_STREAM | SOCK_NONBLOCK, 0));
  EXPECT_EQ(::connect(fd.get(), reinterpret_cast<sockaddr*>(&address), sizeof address), 0);
  send_all(fd, "a\n", server);
  std::string heard;
  pollfd ready{server.fd(), POLLIN, 0};
  while (heard.size() < large.size() + 1) {
    const auto part = read(fd);
    heard += part;
    if (::poll(&ready, 1, 0) == 1) server.on_ready();
    if (part.empty() && ::poll(&ready, 1, 200) == 0) break;
  }
  EXPECT_EQ(heard.size(), large.size() + 1) << "who reads has all of it";
  for (int i = 0; i < 20; ++i) send_all(fd, "a\n", server);
  EXPECT_LE(asked, 5U);
}

TEST_F(CliServerTest, MakesRoomForOneMoreHoweverManySayNothing) {
  std::vector<link::UniqueFd> idle;
  for (int i = 0; i < 200; ++i) {
    idle.push_back(connect());
    work_now();
  }
  const auto newest = connect();
  send_all(newest, "stop\n", *server_);
  EXPECT_EQ(read(newest), "got stop\n");
  EXPECT_EQ(open_of(idle), CliServer::kMaxClients - 1);
}

TEST_F(CliServerTest, WhoIsAnsweredAllTheTimeStaysWhileOthersSayNothing) {
  const auto follower = connect();
  send_all(follower, "follow\n", *server_);
  ASSERT_EQ(read(follower), "got follow\n");
  std::vector<link::UniqueFd> idle;
  for (int i = 0; i < 200; ++i) {
    idle.push_back(connect());
    work_now();
    if (i % 100 == 50) server_->reply(1, "told");  // seldom: others come much faster
  }
  EXPECT_EQ(read(follower), "told\ntold\n");
  send_all(follower, "stop\n", *server_);
  EXPECT_EQ(read(follower), "got stop\n");
}

TEST_F(CliServerTest, AByteNowAndThenAndHalfALineKeepNobodyElseOut) {
  std::vector<link::UniqueFd> dribbling;
  for (std::size_t i = 0; i < CliServer::kMaxClients; ++i) {
    dribbling.push_back(connect());
    send_all(dribbling.back(), i % 2 == 0 ? "x" : std::string(60'000, 'x'), *server_);
  }
  std::vector<link::UniqueFd> others;
  for (int i = 0; i < 4; ++i) {
    for (const auto& fd : dribbling) (void)::send(fd.get(), "x", 1, MSG_NOSIGNAL);
    others.push_back(connect());
    send_all(others.back(), "stop\n", *server_);
    EXPECT_EQ(read(others.back()), "got stop\n");
  }
  EXPECT_EQ(open_of(others), others.size());
}

TEST_F(CliServerTest, WhoAskedBeforeMakesRoomForHimWhoAsksNow) {
  std::vector<link::UniqueFd> asking;
  for (std::size_t i = 0; i < CliServer::kMaxClients; ++i) {
    asking.push_back(connect());
    send_all(asking.back(), "status\n", *server_);
  }
  send_all(asking.front(), "status\n", *server_);  // the second has been idle longest now
  const auto newest = connect();
  send_all(newest, "stop\n", *server_);
  EXPECT_EQ(read(newest), "got stop\n");
  for (const auto& fd : asking) (void)read(fd);
  EXPECT_TRUE(is_open(asking[0]));
  EXPECT_FALSE(is_open(asking[1]));
  EXPECT_TRUE(is_open(asking[2]));
}

TEST_F(CliServerTest, AFloodOfNewOnesPushesNobodyOutUnheard) {
  std::vector<link::UniqueFd> all;
  for (int i = 0; i < 8; ++i) {
    // More than there is room for, before the server looks: his line lies between them.
    for (int k = 0; k < 40; ++k) all.push_back(connect());
    all.push_back(connect());
    ASSERT_EQ(::send(all.back().get(), "stop\n", 5, MSG_NOSIGNAL), 5);
    const auto stopping = all.size() - 1;
    for (int k = 0; k < 40; ++k) all.push_back(connect());
    work_now();
    EXPECT_EQ(lines_.size(), static_cast<std::size_t>(i + 1));
    EXPECT_EQ(read(all[stopping]), "got stop\n");
  }
}

TEST_F(CliServerTest, WhatCameOfOneWhoHasToMakeRoomIsReadFirst) {
  const auto first = connect();
  work();
  std::vector<link::UniqueFd> idle;
  for (std::size_t i = 1; i < CliServer::kMaxClients; ++i) {
    idle.push_back(connect());
    work_now();
  }
  // Nobody looks between his line and those who come.
  const auto late = connect();
  ASSERT_EQ(::send(first.get(), "stop\n", 5, MSG_NOSIGNAL), 5);
  work_now();
  EXPECT_EQ(read(first), "got stop\n");
  EXPECT_TRUE(is_open(first));
  EXPECT_FALSE(is_open(idle.front()));
}

TEST_F(CliServerTest, IsOpenToItsUserAndGroupOnly) {
  const auto mode = std::filesystem::status(folder_ + "/drover.sock").permissions();
  using std::filesystem::perms;
  EXPECT_EQ(mode & perms::others_all, perms::none);
}

}  // namespace
}  // namespace drover::runtime
