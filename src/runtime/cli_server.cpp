#include "runtime/cli_server.h"

#include <sys/epoll.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <stdexcept>

#include "link/opened.h"

namespace drover::runtime {

namespace {
constexpr std::size_t kMaxRequest = 64 * 1024;
constexpr std::size_t kMaxLongRequest = std::size_t{6} << 20;  // a file, escaped as JSON
constexpr std::size_t kMaxWaiting = 64 * 1024 * 1024;          // a large track, shown
constexpr std::size_t kMaxUnread = 1024 * 1024;                // before another reply is added
constexpr std::uint64_t kListenerTag = 0;
constexpr int kAcceptedAtOnce = 16;  // then the others are looked at
constexpr int kWaitOutside = 128;    // who finds no place there is turned away
}  // namespace

CliServer::CliServer(const std::string& path, OnRequest on_request, std::string_view long_line)
    : path_(path),
      on_request_(std::move(on_request)),
      long_line_(long_line),
      listener_(::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0)),
      epoll_(::epoll_create1(EPOLL_CLOEXEC)) {
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  if (path.size() >= sizeof address.sun_path)
    throw std::runtime_error(path + ": the socket's path is too long");
  std::memcpy(address.sun_path, path.c_str(), path.size());
  ::unlink(path.c_str());  // the daemon's lock is held: a socket that lies here has no owner
  if (::bind(listener_.get(), reinterpret_cast<sockaddr*>(&address), sizeof address) != 0 ||
      ::chmod(path.c_str(), 0660) != 0 || ::listen(listener_.get(), kWaitOutside) != 0)
    throw std::runtime_error(link::problem_text(path, "cannot listen", errno));
  epoll_event event{};
  event.events = EPOLLIN;
  event.data.u64 = kListenerTag;
  ::epoll_ctl(epoll_.get(), EPOLL_CTL_ADD, listener_.get(), &event);
}

CliServer::~CliServer() {
  ::unlink(path_.c_str());
}

void CliServer::on_ready() {
  std::array<epoll_event, 16> events{};
  const int n = ::epoll_wait(epoll_.get(), events.data(), events.size(), 0);
  for (int i = 0; i < n; ++i) {
    const auto id = events[i].data.u64;
    if (id == kListenerTag) {
      accept();
    } else if ((events[i].events & (EPOLLIN | EPOLLHUP | EPOLLERR)) != 0) {
      read(id);
    } else {
      write(id);
    }
  }
}

bool CliServer::may_connect(int fd) const {
  ucred peer{};
  socklen_t size = sizeof peer;
  if (::getsockopt(fd, SOL_SOCKET, SO_PEERCRED, &peer, &size) != 0) return false;
  // The socket's mode lets the group in already; this is for a folder that was opened too wide.
  struct stat info {};
  if (::stat(path_.c_str(), &info) != 0) return false;
  if (peer.uid == 0 || peer.uid == info.st_uid || peer.gid == info.st_gid) return true;
  std::array<gid_t, 64> groups{};
  size = sizeof groups;
  if (::getsockopt(fd, SOL_SOCKET, SO_PEERGROUPS, groups.data(), &size) != 0) return false;
  for (std::size_t i = 0; i < size / sizeof(gid_t); ++i)
    if (groups[i] == info.st_gid) return true;
  return false;
}

/// What one has sent already is read at once: a stop does not wait for its turn among others.
void CliServer::accept() {
  for (int i = 0; i < kAcceptedAtOnce; ++i) {
    link::UniqueFd fd(::accept4(listener_.get(), nullptr, nullptr, SOCK_CLOEXEC | SOCK_NONBLOCK));
    if (!fd) return;
    if (!may_connect(fd.get())) continue;
    if (clients_.size() >= kMaxClients) make_room();
    const auto id = next_id_++;
    epoll_event event{};
    event.events = EPOLLIN;
    event.data.u64 = id;
    ::epoll_ctl(epoll_.get(), EPOLL_CTL_ADD, fd.get(), &event);
    clients_.emplace(id, Client{std::move(fd), {}, 0, {}, ++active_, false});
    read(id);
  }
}

/// Bytes without an end of a line keep nobody here: half a line can be held for ever.
void CliServer::make_room() {
  // A line that has come is done before its client goes, who is then not the one any more.
  for (std::size_t i = 0; i < kMaxClients && clients_.size() >= kMaxClients; ++i) {
    const auto id = idle_longest();
    const auto before = clients_.at(id).active;
    read(id);
    const auto client = clients_.find(id);
    if (client != clients_.end() && client->second.active == before) let_go(id);
  }
  if (clients_.size() >= kMaxClients) let_go(idle_longest());
}

/// Half of the places are kept for those who have asked something: however many connect and say
/// nothing, who follows the robot or waits for an answer stays.
CliServer::ClientId CliServer::idle_longest() const {
  const auto silent = std::count_if(clients_.begin(), clients_.end(),
                                    [](const auto& c) { return !c.second.asked; });
  const bool of_those_who_asked = static_cast<std::size_t>(silent) <= kMaxClients / 2;
  ClientId longest = 0;
  std::uint64_t active = ~std::uint64_t{0};
  for (const auto& [id, client] : clients_) {
    if (client.asked != of_those_who_asked || client.active >= active) continue;
    longest = id;
    active = client.active;
  }
  return longest;
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
  if (it == clients_.end()) return;
  std::array<char, 4096> buffer{};
  const auto n = ::recv(it->second.fd.get(), buffer.data(), buffer.size(), 0);
  if (n < 0 && (errno == EAGAIN || errno == EINTR)) return;
  if (n <= 0 || it->second.in.size() + static_cast<std::size_t>(n) > longest_request(id)) {
    let_go(id);
    return;
  }
  it->second.in.append(buffer.data(), static_cast<std::size_t>(n));
  for (;;) {
    const auto client = clients_.find(id);  // a request may end its client
    if (client == clients_.end()) return;
    auto& in = client->second.in;
    const auto end = in.find('\n', client->second.searched);
    client->second.searched = end == std::string::npos ? in.size() : 0;
    if (end == std::string::npos) return;
    const std::string line = in.substr(0, end);
    in.erase(0, end + 1);
    client->second.active = ++active_;
    client->second.asked = true;
    on_request_(id, line);
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
