// The command line's socket: one JSON request a line, one JSON reply a line.
//
// Open to the daemon's own user, its group and root. A request is bounded in size and clients in
// number: for one more, who has been idle longest makes room. Nobody waits for a slow one: who goes
// on asking and does not read is let go.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <utility>

#include "drover/time.h"
#include "link/unique_fd.h"
#include "publish/actions.h"

namespace drover::runtime {

class CliServer final {
 public:
  using ClientId = publish::ClientId;
  static constexpr std::size_t kMaxClients = 32;
  using OnRequest = std::function<void(ClientId, std::string_view line)>;

  /// Listens at `path` (mode 0660). A request that begins with `long_line` may be longer than
  /// others, of one client at a time; empty: none may. Throws std::runtime_error with the path and
  /// the reason.
  CliServer(const std::string& path, OnRequest on_request, std::string_view long_line = {});
  ~CliServer();
  CliServer(const CliServer&) = delete;
  CliServer& operator=(const CliServer&) = delete;

  /// Whom to tell of a client that is gone, or was let go.
  void on_gone(std::function<void(ClientId)> tell) { on_gone_ = std::move(tell); }

  /// An epoll descriptor of its own: readable when on_ready() has something to do.
  int fd() const { return epoll_.get(); }
  void on_ready();
  /// Answers a client that may be gone meanwhile; then it is not heard.
  void reply(ClientId client, const std::string& text);

 private:
  struct Client {
    link::UniqueFd fd;
    std::string in;
    std::size_t searched = 0;  ///< so many bytes of `in` have no end of a line
    std::string out;
    std::uint64_t active = 0;  ///< of all that was asked, answered or came, its last was this one
    bool asked = false;        ///< a whole line has come
  };
  void accept();
  void make_room();
  ClientId idle_longest() const;
  void read(ClientId id);
  void write(ClientId id);
  void let_go(ClientId id);
  void watch(ClientId id, bool writing);
  bool may_connect(int fd) const;
  std::size_t longest_request(ClientId id) const;

  std::string path_;
  OnRequest on_request_;
  std::function<void(ClientId)> on_gone_;
  std::string_view long_line_;
  link::UniqueFd listener_;
  link::UniqueFd epoll_;
  std::map<ClientId, Client> clients_;
  ClientId next_id_ = 1;
  std::uint64_t active_ = 0;
};

}  // namespace drover::runtime
