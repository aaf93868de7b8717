// The command line's socket: one JSON request a line, one JSON reply a line.
//
// Open to the daemon's own user, its group and root. A request is bounded in size and clients in
// number: for one more, one of the most crowded program makes room. Nobody waits for a slow one:
// who goes on asking and does not read is let go. Nor for one who asks much: stops go first, and
// each program has its share of the rest.
#pragma once

#include <sys/socket.h>
#include <sys/types.h>

#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "drover/time.h"
#include "link/unique_fd.h"
#include "publish/actions.h"
#include "runtime/stop_requests.h"
#include "runtime/wake.h"

namespace drover::runtime {

class CliServer final {
 public:
  using ClientId = publish::ClientId;
  static constexpr std::size_t kMaxClients = 32;
  using OnRequest = std::function<void(ClientId, std::string_view line)>;
  using IsStop = bool (*)(std::string_view line);

  /// Listens at `path` (mode 0660). A request that begins with `long_line` may be longer than
  /// others, of one client at a time; empty: none may. Throws std::runtime_error with the path and
  /// the reason.
  CliServer(const std::string& path, OnRequest on_request, std::string_view long_line = {});
  ~CliServer();
  CliServer(const CliServer&) = delete;
  CliServer& operator=(const CliServer&) = delete;

  /// Whom to tell of a client that is gone, or was let go.
  void on_gone(std::function<void(ClientId)> tell) { on_gone_ = std::move(tell); }

  /// Lines that stop the robot go before all others, also of the same client. What was asked for
  /// before one that has overtaken it can be known by before(), which is of `stops`.
  void stops_first(IsStop is_stop, const StopRequests& stops) {
    is_stop_ = is_stop;
    stops_ = &stops;
  }
  /// Of the line that is handed over just now: the stops that were asked for before it came.
  const StopCounts& before() const { return before_; }

  /// An epoll descriptor of its own: readable when on_ready() has something to do.
  int fd() const { return epoll_.get(); }
  void on_ready();
  /// Answers a client that may be gone meanwhile; then it is not heard.
  void reply(ClientId client, const std::string& text);

 private:
  struct Line {
    std::string text;
    StopCounts before;  ///< the stops that were asked for when it came
  };
  struct Client {
    link::UniqueFd fd;
    uid_t user = 0;
    pid_t program = 0;
    std::string in;            ///< half a line
    std::size_t searched = 0;  ///< so many bytes of it have no end of a line
    std::deque<Line> lines;    ///< whole ones that wait; while there are, no more is read
    std::string out;
    std::uint64_t active = 0;  ///< of all that was asked, answered or came, its last was this one
    bool asked = false;        ///< a whole line has come
    bool waits = false;        ///< a line was handed over, and nothing was told it since
  };
  void take_in();
  void answer_in_turn();
  std::optional<ClientId> next_in_turn(const std::map<pid_t, std::size_t>& had) const;
  void hand_over(ClientId id, const Line& line);
  void accept();
  void make_room();
  ClientId who_goes() const;
  void read(ClientId id);
  void cut(ClientId id);
  void write(ClientId id);
  void let_go(ClientId id);
  void watch(ClientId id, bool writing);
  bool may_connect(int fd, const ucred& peer) const;
  std::size_t longest_request(ClientId id) const;

  std::string path_;
  OnRequest on_request_;
  std::function<void(ClientId)> on_gone_;
  std::string_view long_line_;
  IsStop is_stop_ = nullptr;
  const StopRequests* stops_ = nullptr;
  StopCounts before_;
  link::UniqueFd listener_;
  link::UniqueFd epoll_;
  Wake more_;  ///< lines wait: what lies here wakes no descriptor
  std::map<ClientId, Client> clients_;
  ClientId next_id_ = 1;
  std::uint64_t active_ = 0;
};

}  // namespace drover::runtime
