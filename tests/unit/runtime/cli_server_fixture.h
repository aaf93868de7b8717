// A server that answers each line with "got" and the line, and clients of this process.
#pragma once

#include <errno.h>
#include <gtest/gtest.h>
#include <poll.h>
#include <sys/socket.h>
#include <sys/un.h>

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "runtime/cli_server.h"

namespace drover::runtime {

class CliServerTest : public ::testing::Test {
 protected:
  CliServerTest() {
    std::string pattern = std::filesystem::temp_directory_path() / "drover-cli-XXXXXX";
    folder_ = ::mkdtemp(pattern.data());
    server_ = std::make_unique<CliServer>(folder_ + "/drover.sock",
                                          [this](CliServer::ClientId id, std::string_view line) {
                                            lines_.emplace_back(line);
                                            server_->reply(id, "got " + std::string(line));
                                          });
  }
  ~CliServerTest() override {
    server_.reset();
    std::filesystem::remove_all(folder_);
  }
  link::UniqueFd connect(const std::string& socket = "/drover.sock") const {
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    std::strcpy(address.sun_path, (folder_ + socket).c_str());
    link::UniqueFd fd(::socket(AF_UNIX, SOCK_STREAM | SOCK_NONBLOCK, 0));
    EXPECT_EQ(::connect(fd.get(), reinterpret_cast<sockaddr*>(&address), sizeof address), 0);
    return fd;
  }
  /// Lets the server work until it has nothing to do.
  void work() const {
    pollfd ready{server_->fd(), POLLIN, 0};
    while (::poll(&ready, 1, 20) == 1) server_->on_ready();
  }
  /// Likewise, without the wait.
  void work_now() const {
    pollfd ready{server_->fd(), POLLIN, 0};
    while (::poll(&ready, 1, 0) == 1) server_->on_ready();
  }
  static bool is_open(const link::UniqueFd& fd) {
    char byte = 0;
    return ::recv(fd.get(), &byte, 1, MSG_PEEK | MSG_DONTWAIT) < 0 && errno == EAGAIN;
  }
  static std::size_t open_of(const std::vector<link::UniqueFd>& all) {
    return static_cast<std::size_t>(std::count_if(all.begin(), all.end(), is_open));
  }
  /// As far as the other side takes it.
  static void send_all(const link::UniqueFd& fd, std::string_view text, CliServer& server) {
    pollfd ready{server.fd(), POLLIN, 0};
    while (!text.empty()) {
      const auto n = ::send(fd.get(), text.data(), text.size(), MSG_NOSIGNAL);
      if (n > 0) text.remove_prefix(static_cast<std::size_t>(n));
      if (n < 0 && errno != EAGAIN) break;
      while (::poll(&ready, 1, 5) == 1) server.on_ready();
    }
    while (::poll(&ready, 1, 20) == 1) server.on_ready();
  }
  static std::string read(const link::UniqueFd& fd) {
    std::string text(4096, '\0');
    const auto n = ::recv(fd.get(), text.data(), text.size(), 0);
    text.resize(n > 0 ? static_cast<std::size_t>(n) : 0);
    return text;
  }

  std::string folder_;
  std::vector<std::string> lines_;
  std::unique_ptr<CliServer> server_;
};

}  // namespace drover::runtime
