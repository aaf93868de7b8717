#include "guard/stop_set.h"

#include <fcntl.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <termios.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <utility>

namespace drover::guard {

namespace {

constexpr std::uint32_t kShortestPeriod_ms = 10;
constexpr std::uint32_t kLongestPeriod_ms = 1000;
constexpr int kForgivenPeriods = 5;
/// A line that was full for a moment takes the next round.
constexpr Duration kRunsOnFor = std::chrono::milliseconds(150);
/// A line whose other end is gone takes messages and keeps them: some 300, of one a period 3 s.
constexpr Duration kTold = std::chrono::seconds(5);
/// The guard looks each 10 ms: what is due nearer to this look than to the next goes now.
constexpr Duration kHalfACycle = std::chrono::milliseconds(5);

std::string_view text(const std::array<char, kGuardNameSize>& name) {
  return name.data();
}

/// After one of these the descriptor never works again.
bool is_dead(int error) {
  return error == EIO || error == ENXIO || error == ENODEV || error == EBADF || error == EPIPE ||
         error == ECONNRESET;
}

bool is_one_tty(int a, int b) {
  struct stat first {};
  struct stat second {};
  return a >= 0 && b >= 0 && ::fstat(a, &first) == 0 && ::fstat(b, &second) == 0 &&
         S_ISCHR(first.st_mode) && S_ISCHR(second.st_mode) && first.st_rdev == second.st_rdev;
}

/// The flag belongs to the file that both processes share: whoever cleared it must not hold us up.
bool make_non_blocking(int fd) {
  const int flags = ::fcntl(fd, F_GETFL);
  return flags >= 0 && ((flags & O_NONBLOCK) != 0 || ::fcntl(fd, F_SETFL, flags | O_NONBLOCK) == 0);
}

}  // namespace

bool is_name(const std::array<char, kGuardNameSize>& name) {
  return name[0] != '\0' && std::find(name.begin(), name.end(), '\0') != name.end();
}

void StopSet::clear() {
  for (auto& link : links_) close(link);
  leave();
}

void StopSet::leave() {
  for (auto& link : links_) {
    if (link.fd >= 0) ::close(link.fd);
    link = {};
  }
  axis_count_ = 0;
  message_count_ = 0;
}

/// The last one who closes a tty waits half a minute for what is in it: it is thrown away before.
void StopSet::close(Link& link) {
  if (link.fd < 0) return;
  if (link.kind == GuardLinkKind::tty) ::tcflush(link.fd, TCOFLUSH);
  ::close(link.fd);
  link.fd = -1;
}

void StopSet::swap(StopSet& other) {
  std::swap(links_, other.links_);
  std::swap(axes_, other.axes_);
  std::swap(messages_, other.messages_);
  std::swap(axis_count_, other.axis_count_);
  std::swap(message_count_, other.message_count_);
}

bool StopSet::add_link(const GuardMessage& message, int fd) {
  if (message.index >= links_.size() || !is_name(message.name)) return false;
  if (message.kind != GuardLinkKind::can && message.kind != GuardLinkKind::tty) return false;
  const bool absent = message.verb == GuardVerb::absent;
  if (absent && fd >= 0) return false;
  auto& link = links_[message.index];
  if (link.name[0] != '\0') return false;
  link.fd = fd;
  link.kind = message.kind;
  link.name = message.name;
  link.was_there = !absent;
  return true;
}

bool StopSet::add_axis(const GuardMessage& message) {
  if (message.index != axis_count_ || axis_count_ == axes_.size() || !is_name(message.name))
    return false;
  if (message.link >= links_.size() || !is_name(links_[message.link].name)) return false;
  if (message.rounds < 1 || message.rounds > kGuardMaxMessages ||
      message.period_ms < kShortestPeriod_ms || message.period_ms > kLongestPeriod_ms)
    return false;
  auto& axis = axes_[axis_count_++];
  axis = {};
  axis.name = message.name;
  axis.link = message.link;
  axis.rounds = message.rounds;
  axis.period = std::chrono::milliseconds(message.period_ms);
  axis.held_by_daemon = message.held_by_daemon == 1;
  axis.runs_on = message.runs_on == 1;
  return true;
}

bool StopSet::add_message(const GuardMessage& message) {
  if (message.index >= axis_count_ || message_count_ == messages_.size()) return false;
  if (message.round >= axes_[message.index].rounds || message.size == 0 ||
      message.size > kGuardMaxBytes)
    return false;
  messages_[message_count_++] = {message.index, message.round, message.size, message.bytes};
  return true;
}

bool StopSet::is_same_line(const Link& a, const Link& b) {
  return a.kind == b.kind && text(a.name) == text(b.name);
}

/// `held`: the link on which another set has this axis.
bool StopSet::has(const Axis& axis, const Link& held) const {
  for (std::size_t i = 0; i < axis_count_; ++i) {
    if (text(axes_[i].name) != text(axis.name)) continue;
    const Link& link = links_[axes_[i].link];
    const bool absent = link.fd < 0 && !link.was_there;
    const bool as_before = absent && (held.fd < 0 || is_same_line(link, held));
    const auto says_something = [i](const Message& m) { return m.axis == i; };
    return (link.fd >= 0 || as_before) &&
           std::any_of(messages_.begin(),
                       messages_.begin() + static_cast<std::ptrdiff_t>(message_count_),
                       says_something);
  }
  return false;
}

std::string_view StopSet::lacks(const StopSet& held) const {
  for (std::size_t i = 0; i < held.axis_count_; ++i)
    if (!has(held.axes_[i], held.links_[held.axes_[i].link])) return text(held.axes_[i].name);
  return {};
}

bool StopSet::covers(const StopSet& held) const {
  return lacks(held).empty();
}

void StopSet::inherit(StopSet& held) {
  for (auto& link : links_) {
    if (link.was_there || !is_name(link.name)) continue;
    for (auto& old : held.links_) {
      if (!is_same_line(link, old)) continue;
      const auto empty = link;
      link = std::exchange(old, empty);
      break;
    }
  }
}

void StopSet::go_on_from(StopSet& held) {
  for (auto& link : links_) {
    for (auto& old : held.links_) {
      if (link.kind != GuardLinkKind::tty || !is_one_tty(link.fd, old.fd)) continue;
      link.flushed = old.flushed;
      link.rest = old.rest;
      link.rest_size = old.rest_size;
      ::close(std::exchange(old.fd, -1));
    }
  }
}

std::size_t StopSet::axes() const {
  const auto was_there = [this](const Axis& axis) { return links_[axis.link].was_there; };
  return static_cast<std::size_t>(std::count_if(
      axes_.begin(), axes_.begin() + static_cast<std::ptrdiff_t>(axis_count_), was_there));
}

void StopSet::begin_hold() {
  for (auto& link : links_) {
    link.flushed = false;
    link.rest_size = 0;
  }
  for (auto& axis : axes_) {
    axis.round = 0;
    axis.due = axis.missed = axis.taken = kNever;
    axis.told = false;
  }
}

void StopSet::play(Time now, Whose whose) {
  for (std::size_t i = 0; i < axis_count_; ++i) {
    auto& axis = axes_[i];
    if (!links_[axis.link].was_there) continue;
    const Whose others = axis.held_by_daemon ? Whose::not_daemons : Whose::daemons;
    if (whose == others) {
      axis.reached = now;
      continue;
    }
    if (now + kHalfACycle < axis.due) continue;
    axis.due = now - axis.due < axis.period ? axis.due + axis.period : now + axis.period;
    auto& link = links_[axis.link];
    bool taken = link.fd >= 0;
    for (std::size_t m = 0; m < message_count_; ++m) {
      if (messages_[m].axis != i || messages_[m].round != axis.round) continue;
      if (!send(link, messages_[m])) {
        taken = false;
        ++unsent_;
      }
    }
    if (!taken) {  // the same round again: a counter in it must not jump
      if (axis.missed == kNever) axis.missed = now;
      axis.taken = kNever;
      continue;
    }
    axis.missed = kNever;
    axis.reached = now;
    if (axis.taken == kNever) axis.taken = now;
    axis.told = axis.told || now - axis.taken >= kTold;
    axis.round = (axis.round + 1) % axis.rounds;
  }
}

bool StopSet::in_command(Time now) const {
  return std::all_of(axes_.begin(), axes_.begin() + static_cast<std::ptrdiff_t>(axis_count_),
                     [this, now](const Axis& axis) {
                       return !links_[axis.link].was_there ||
                              now - axis.reached <= kForgivenPeriods * axis.period;
                     });
}

bool StopSet::runs_on(Time now) const {
  return std::any_of(axes_.begin(), axes_.begin() + static_cast<std::ptrdiff_t>(axis_count_),
                     [now](const Axis& axis) {
                       return axis.runs_on && !axis.told && axis.missed != kNever &&
                              now - axis.missed >= kRunsOnFor;
                     });
}

/// The lines that write.
bool StopSet::send(Link& link, const Message& message) {
  if (link.fd < 0) return false;
  if (link.kind == GuardLinkKind::tty) return write_packet(link, message);
  const auto n = ::send(link.fd, message.bytes.data(), message.size, MSG_DONTWAIT | MSG_NOSIGNAL);
  return n == static_cast<ssize_t>(message.size);
}

/// A packet that has begun is ended before another one: half a packet would spoil both.
bool StopSet::write_packet(Link& link, const Message& message) {
  if (!make_non_blocking(link.fd)) return false;
  if (!link.flushed) {
    // A dead daemon's bytes would go first otherwise.
    ::tcflush(link.fd, TCOFLUSH);
    link.flushed = true;
  }
  if (link.rest_size > 0) {
    const auto taken = write_some(link, link.rest.data(), link.rest_size);
    link.rest_size -= taken;
    std::copy_n(link.rest.begin() + static_cast<std::ptrdiff_t>(taken), link.rest_size,
                link.rest.begin());
    if (link.rest_size > 0) return false;
  }
  const auto taken = write_some(link, message.bytes.data(), message.size);
  if (taken == 0) return false;
  link.rest_size = message.size - taken;
  std::copy_n(message.bytes.begin() + static_cast<std::ptrdiff_t>(taken), link.rest_size,
              link.rest.begin());
  return true;
}

/// How much the line took.
std::size_t StopSet::write_some(Link& link, const std::uint8_t* bytes, std::size_t size) {
  const auto n = ::write(link.fd, bytes, size);
  if (n >= 0) return static_cast<std::size_t>(n);
  if (is_dead(errno)) {
    close(link);  // held on to, it would keep the device's name from coming back
    ++died_;
  }
  return 0;
}

int StopSet::descriptor(std::string_view name) const {
  for (const auto& link : links_)
    if (link.fd >= 0 && text(link.name) == name) return link.fd;
  return -1;
}

std::vector<std::string_view> StopSet::links() const {
  std::vector<std::string_view> names;
  for (const auto& link : links_)
    if (is_name(link.name)) names.push_back(text(link.name));
  return names;
}

std::vector<std::string_view> StopSet::links_never_there() const {
  std::vector<std::string_view> names;
  for (const auto& link : links_)
    if (is_name(link.name) && !link.was_there) names.push_back(text(link.name));
  return names;
}

void StopSet::tell(std::vector<GuardMessage>& words) const {
  for (std::size_t i = 0; i < links_.size(); ++i) {
    if (!is_name(links_[i].name)) continue;
    auto& word = words.emplace_back();
    word.verb = links_[i].was_there ? GuardVerb::link : GuardVerb::absent;
    word.index = static_cast<std::uint32_t>(i);
    word.kind = links_[i].kind;
    word.name = links_[i].name;
  }
  for (std::size_t i = 0; i < axis_count_; ++i) {
    const auto& axis = axes_[i];
    auto& word = words.emplace_back();
    word.verb = GuardVerb::axis;
    word.index = static_cast<std::uint32_t>(i);
    word.link = axis.link;
    word.rounds = axis.rounds;
    word.period_ms = static_cast<std::uint32_t>(
        std::chrono::duration_cast<std::chrono::milliseconds>(axis.period).count());
    word.held_by_daemon = axis.held_by_daemon ? 1 : 0;
    word.runs_on = axis.runs_on ? 1 : 0;
    word.name = axis.name;
  }
  for (std::size_t i = 0; i < message_count_; ++i) {
    auto& word = words.emplace_back();
    word.verb = GuardVerb::stop_message;
    word.index = messages_[i].axis;
    word.round = messages_[i].round;
    word.size = messages_[i].size;
    word.bytes = messages_[i].bytes;
  }
}

bool StopSet::let_go(std::string_view name) {
  for (auto& link : links_) {
    if (link.fd < 0 || text(link.name) != name) continue;
    close(link);
    return true;
  }
  return false;
}

}  // namespace drover::guard
