#include "runtime/cli_server.h"

#include <sys/epoll.h>
#include <sys/socket.h>
#include <sys/stat.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <stdexcept>
#include <tuple>

#include "link/opened.h"
#include "link/unix_address.h"

namespace drover::runtime {

namespace {
constexpr std::size_t kMaxRequest = 64 * 1024;
constexpr std::size_t kMaxLongRequest = std::size_t{6} << 20;  // a file, escaped as JSON
constexpr std::size_t kMaxWaiting = 64 * 1024 * 1024;          // a large track, shown
constexpr std::size_t kMaxUnread = 1024 * 1024;                // before another reply is added
constexpr std::uint64_t kListenerTag = 0;
constexpr std::uint64_t kMoreTag = ~std::uint64_t{0};
constexpr int kWaitOutside = 128;  // who finds no place there is turned away
/// Of one program, however many clients it has: then the next ones, and whatever else the thread
/// has to do.
constexpr std::size_t kLinesEachTurn = 4;

void watch_for_input(int epoll, int fd, std::uint64_t tag) {
  epoll_event event{};
  event.events = EPOLLIN;
  event.data.u64 = tag;
  ::epoll_ctl(epoll, EPOLL_CTL_ADD, fd, &event);
}
}  // namespace

CliServer::CliServer(const std::string& path, OnRequest on_request, std::string_view long_line)
    : path_(path),
      on_request_(std::move(on_request)),
      long_line_(long_line),
      listener_(::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0)),
      epoll_(::epoll_create1(EPOLL_CLOEXEC)) {
  const auto address = link::unix_address(path);
  if (!address) throw std::runtime_error(path + ": the socket's path is too long");
  ::unlink(path.c_str());  // the daemon's lock is held: a socket that lies here has no owner
  if (::bind(listener_.get(), reinterpret_cast<const sockaddr*>(&*address), sizeof *address) != 0 ||
      ::chmod(path.c_str(), 0660) != 0 || ::listen(listener_.get(), kWaitOutside) != 0)
    throw std::runtime_error(link::problem_text(path, "cannot listen", errno));
  watch_for_input(epoll_.get(), listener_.get(), kListenerTag);
  watch_for_input(epoll_.get(), more_.fd(), kMoreTag);
}

CliServer::~CliServer() {
  ::unlink(path_.c_str());
}

void CliServer::on_ready() {
  more_.clear();
  take_in();
  answer_in_turn();
}

/// All that is there, before any of it is answered: a stop among it waits for nobody.
void CliServer::take_in() {
  std::array<epoll_event, kMaxClients + 2> events{};
  const int n = ::epoll_wait(epoll_.get(), events.data(), events.size(), 0);
  bool newcomers = false;
  for (int i = 0; i < n; ++i) {
    const auto id = events[i].data.u64;
    if (id == kListenerTag) newcomers = true;
    if (id == kListenerTag || id == kMoreTag) continue;
    if ((events[i].events & EPOLLOUT) != 0) write(id);
    if ((events[i].events & (EPOLLIN | EPOLLHUP | EPOLLERR)) != 0) read(id);
  }
  if (newcomers) accept();
}

void CliServer::answer_in_turn() {
  std::map<pid_t, std::size_t> had;
  while (const auto id = next_in_turn(had)) {
    Client& client = clients_.at(*id);
    ++had[client.program];
    const Line line = std::move(client.lines.front());
    client.lines.pop_front();
    hand_over(*id, line);
  }
  for (const auto& [id, client] : clients_)
    if (!client.lines.empty()) return more_.notify();
}

/// Of those whose program has not had its share the one who was idle longest.
std::optional<CliServer::ClientId> CliServer::next_in_turn(
    const std::map<pid_t, std::size_t>& had) const {
  std::optional<ClientId> next;
  std::uint64_t active = ~std::uint64_t{0};
  for (const auto& [id, client] : clients_) {
    if (client.lines.empty() || client.active >= active) continue;
    const auto share = had.find(client.program);
    if (share != had.end() && share->second >= kLinesEachTurn) continue;
    next = id;
    active = client.active;
  }
  return next;
}

void CliServer::hand_over(ClientId id, const Line& line) {
  Client& client = clients_.at(id);
  client.active = ++active_;
  client.waits = true;
  before_ = line.before;
  on_request_(id, line.text);
}

bool CliServer::may_connect(int fd, const ucred& peer) const {
  // The socket's mode lets the group in already; this is for a folder that was opened too wide.
  struct stat info {};
  if (::stat(path_.c_str(), &info) != 0) return false;
  if (peer.uid == 0 || peer.uid == info.st_uid || peer.gid == info.st_gid) return true;
  std::array<gid_t, 64> groups{};
  socklen_t size = sizeof groups;
  if (::getsockopt(fd, SOL_SOCKET, SO_PEERGROUPS, groups.data(), &size) != 0) return false;
  for (std::size_t i = 0; i < size / sizeof(gid_t); ++i)
    if (groups[i] == info.st_gid) return true;
  return false;
}

/// What one has sent already is read at once: a stop does not wait for its turn among others. Who
/// waits outside is let in, however many there are: behind a crowd may stand one who is none.
void CliServer::accept() {
  for (int i = 0; i < kWaitOutside; ++i) {
    link::UniqueFd fd(::accept4(listener_.get(), nullptr, nullptr, SOCK_CLOEXEC | SOCK_NONBLOCK));
    if (!fd) return;
    ucred peer{};
    socklen_t size = sizeof peer;
    if (::getsockopt(fd.get(), SOL_SOCKET, SO_PEERCRED, &peer, &size) != 0) continue;
    if (!may_connect(fd.get(), peer)) continue;
    if (clients_.size() >= kMaxClients) make_room();
    const auto id = next_id_++;
    watch_for_input(epoll_.get(), fd.get(), id);
    Client& client = clients_[id];
    client.fd = std::move(fd);
    client.user = peer.uid;
    client.program = peer.pid;
    client.active = ++active_;
    read(id);
  }
}

void CliServer::make_room() {
  const auto id = who_goes();
  read(id);  // a stop that has come just now
  if (clients_.contains(id)) let_go(id);
}

/// One of the user with most clients, there of the program with most: a crowd pushes itself out,
/// and nobody who comes alone. Of these one who waits for an answer goes last, and who has been
/// idle longest first. Bytes without an end of a line keep nobody here: half a line can be held for
/// ever. Half of the places are kept for those who have asked something: who connects and says
/// nothing does not push them out, nor they him who is about to ask.
CliServer::ClientId CliServer::who_goes() const {
  std::map<uid_t, std::size_t> of_user;
  std::map<pid_t, std::size_t> of_program;
  std::size_t silent = 0;
  for (const auto& [id, client] : clients_) {
    ++of_user[client.user];
    ++of_program[client.program];
    silent += client.asked ? 0 : 1;
  }
  const bool of_those_who_asked = silent <= kMaxClients / 2;
  const auto rank = [&](const Client& client) {
    return std::tuple(of_user[client.user], of_program[client.program],
                      !client.waits && client.lines.empty(), client.asked == of_those_who_asked,
                      active_ - client.active);
  };
  const auto first = std::max_element(
      clients_.begin(), clients_.end(),
      [&](const auto& one, const auto& other) { return rank(one.second) < rank(other.second); });
  return first->first;
}

void CliServer::let_go(ClientId id) {
  clients_.erase(id);
  if (on_gone_) on_gone_(id);
}

void CliServer::watch(ClientId id, bool writing) {
  epoll_event event{};
  event.events = writing ? EPOLLIN | EPOLLOUT : EPOLLIN;
  event.data.u64 = id;
  ::epoll_ctl(epoll_.get(), EPOLL_CTL_MOD, clients_.at(id).fd.get(), &event);
}

std::size_t CliServer::longest_request(ClientId id) const {
  if (long_line_.empty() || !clients_.at(id).in.starts_with(long_line_)) return kMaxRequest;
  for (const auto& [other, client] : clients_)
    if (other != id && client.in.size() > kMaxRequest) return kMaxRequest;
  return kMaxLongRequest;
}

void CliServer::read(ClientId id) {
  const auto it = clients_.find(id);
  if (it == clients_.end() || !it->second.lines.empty()) return;
  std::array<char, 4096> buffer{};
  const auto n = ::recv(it->second.fd.get(), buffer.data(), buffer.size(), 0);
  if (n < 0 && (errno == EAGAIN || errno == EINTR)) return;
  if (n <= 0 || it->second.in.size() + static_cast<std::size_t>(n) > longest_request(id)) {
    let_go(id);
    return;
  }
  it->second.in.append(buffer.data(), static_cast<std::size_t>(n));
  cut(id);
}

/// Whole lines wait for their turn, but for stops.
void CliServer::cut(ClientId id) {
  for (;;) {
    const auto it = clients_.find(id);  // a request may end its client
    if (it == clients_.end()) return;
    Client& client = it->second;
    const auto end = client.in.find('\n', client.searched);
    client.searched = end == std::string::npos ? client.in.size() : 0;
    if (end == std::string::npos) return;
    Line line{client.in.substr(0, end), stops_ != nullptr ? stops_->asked() : StopCounts{}};
    client.in.erase(0, end + 1);
    client.asked = true;
    if (is_stop_ != nullptr && is_stop_(line.text)) {
      hand_over(id, line);
    } else {
      client.lines.push_back(std::move(line));
    }
  }
}

void CliServer::reply(ClientId id, const std::string& text) {
  const auto it = clients_.find(id);
  if (it == clients_.end()) return;
  auto& out = it->second.out;
  // Who goes on asking and does not read is let go.
  if (out.size() > kMaxUnread || out.size() + text.size() >= kMaxWaiting) {
    let_go(id);
    return;
  }
  out += text + "\n";
  it->second.active = ++active_;
  it->second.waits = false;
  write(id);
}

void CliServer::write(ClientId id) {
  const auto it = clients_.find(id);
  if (it == clients_.end()) return;
  auto& out = it->second.out;
  while (!out.empty()) {
    const auto n = ::send(it->second.fd.get(), out.data(), out.size(), MSG_NOSIGNAL);
    if (n < 0 && errno == EINTR) continue;
    if (n < 0 && errno != EAGAIN) {
      let_go(id);
      return;
    }
    if (n < 0) break;
    out.erase(0, static_cast<std::size_t>(n));
  }
  watch(id, !out.empty());
}

}  // namespace drover::runtime
