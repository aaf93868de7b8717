// What droverd may ask of the guard.
#include <fcntl.h>
#include <poll.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <utility>

#include "guard/clock.h"
#include "guard/guard.h"
#include "guard/sockets.h"

namespace drover::guard {

namespace {

/// A file that shrinks under a mapping would kill us with SIGBUS: only a sealed one is believed.
GuardShared* map(int fd) {
  const int seals = ::fcntl(fd, F_GET_SEALS);
  struct stat info {};
  if (seals < 0 || (seals & F_SEAL_SHRINK) == 0 || ::fstat(fd, &info) != 0 ||
      info.st_size < static_cast<off_t>(sizeof(GuardShared)))
    return nullptr;
  void* memory = ::mmap(nullptr, sizeof(GuardShared), PROT_READ | PROT_WRITE, MAP_SHARED, fd, 0);
  return memory == MAP_FAILED ? nullptr : static_cast<GuardShared*>(memory);
}

/// Two descriptors of one memory.
bool is_same_file(int a, int b) {
  struct stat first {};
  struct stat second {};
  return ::fstat(a, &first) == 0 && ::fstat(b, &second) == 0 && first.st_dev == second.st_dev &&
         first.st_ino == second.st_ino;
}

bool hung_up(int fd) {
  pollfd fds{fd, 0, 0};
  return ::poll(&fds, 1, 0) > 0 && (fds.revents & POLLHUP) != 0;
}

}  // namespace

void Guard::accept_daemon() {
  uid_t uid = 0;
  const int fd = accept_from(daemon_listener_, uid);
  if (fd < 0) return;
  const bool is_daemon = uid == daemon_uid_ || uid == 0;
  if (!is_daemon)
    speech_.say("drover-guard: user %u is not droverd's and gets nothing",
                static_cast<unsigned>(uid));
  // A droverd that is started again may be here before the last words of the one before it are
  // read.
  if (is_daemon && daemon_ >= 0 && hung_up(daemon_))
    while (daemon_ >= 0) receive();
  if (!is_daemon || daemon_ >= 0) {  // one daemon at a time; the first keeps the guard
    ::close(fd);
    return;
  }
  daemon_ = fd;
}

void Guard::receive() {
  GuardMessage message;
  PassedMessage passed(&message, sizeof message);
  const auto n = ::recvmsg(daemon_, &passed.header(), MSG_CMSG_CLOEXEC | MSG_DONTWAIT);
  if (n < 0 && (errno == EAGAIN || errno == EINTR)) return;
  const int fd = n > 0 ? passed.passed() : -1;
  const bool whole = n == sizeof message && message.version == kGuardVersion;
  if (whole && obey(message, fd)) return;
  if (fd >= 0) ::close(fd);
  drop_daemon();  // acts at once, before the words
  const bool has_version = n >= static_cast<ssize_t>(sizeof message.version);
  if (has_version && message.version != kGuardVersion)
    speech_.say(
        "drover-guard: droverd speaks version %u of the guard's protocol, and this is %u: "
        "restart both, so that they are of one installation",
        message.version, kGuardVersion);
  else if (n > 0)
    speech_.say("drover-guard: a message was not understood");
}

void Guard::drop_daemon() {
  ::close(daemon_);
  daemon_ = -1;
  set_is_his_ = next_is_his_ = false;
  watch_.lost();
  cycle(now());
}

/// Takes `fd` when it returns true.
bool Guard::obey(const GuardMessage& message, int fd) {
  switch (message.verb) {
    case GuardVerb::hello: return fd >= 0 && begin_set(message, fd);
    case GuardVerb::link: return fd >= 0 && next_.add_link(message, fd);
    case GuardVerb::pulse_line: return take_line(pulse_line_, fd);
    case GuardVerb::relay_line:
      if (!is_name(message.name) || !take_line(relay_line_, fd)) return false;
      relay_name_ = message.name;
      return true;
    default: break;
  }
  if (fd >= 0) return false;  // the others bring nothing
  switch (message.verb) {
    case GuardVerb::absent: return next_.add_link(message, -1);
    case GuardVerb::axis: return next_.add_axis(message);
    case GuardVerb::stop_message: return next_.add_message(message);
    case GuardVerb::watch: end_set(); return true;
    case GuardVerb::hand_back: hand_back(); return true;
    case GuardVerb::lend: lend(message); return true;
    case GuardVerb::let_go: return let_go(message);
    default: return false;
  }
}

/// The memory counts from `watch` on, together with the set.
bool Guard::begin_set(const GuardMessage& hello, int memory) {
  auto* shared = map(memory);
  if (shared == nullptr) return false;
  if (next_shared_ != nullptr) ::munmap(next_shared_, sizeof(GuardShared));
  if (next_memory_ >= 0) ::close(next_memory_);
  next_shared_ = shared;
  next_memory_ = memory;
  next_limit_ms_ = hello.limit_ms;
  // What the daemon holds itself goes on in the line.
  next_is_his_ ? next_.leave() : next_.clear();
  next_is_his_ = daemon_ >= 0;
  offered_ = false;
  return true;
}

void Guard::end_set() {
  const bool again = memory_ >= 0 && next_memory_ >= 0 && is_same_file(memory_, next_memory_);
  if (next_shared_ != nullptr)
    use_memory(std::exchange(next_memory_, -1), std::exchange(next_shared_, nullptr));
  limit_ms_ = next_limit_ms_;
  const auto limit = std::chrono::milliseconds(limit_ms_);
  again ? watch_.begin_again(beats(), limit, now()) : watch_.begin(beats(), limit, now());
  offered_ = !next_.covers(set_);
  if (!offered_) return use_next();
  set_is_his_ = false;
  publish();  // before he is answered anything that he asks next
  const auto lacks = next_.lacks(set_);
  speech_.say("drover-guard: a new stop set lacks %.*s: the old one stays until drover reset",
              static_cast<int>(lacks.size()), lacks.data());
}

void Guard::use_next() {
  if (holding_) next_.begin_hold();
  next_.inherit(set_);
  next_.go_on_from(set_);
  set_.swap(next_);
  next_.clear();
  offered_ = false;
  set_is_his_ = true;
  act(now());
  publish();
  keep_.keep(set_, limit_ms_);
  for (const auto link : set_.links_never_there())
    speech_.say("drover-guard: %.*s is not there and never was: nothing on it can be stopped",
                static_cast<int>(link.size()), link.data());
}

/// Who asks must have made us ready to stop all that he moves.
void Guard::hand_back() {
  if (keep_.state().latched.load() == 0 && set_is_his_) watch_.hand_back(now());
}

bool Guard::take_line(int& line, int fd) {
  if (fd < 0) return false;
  if (line >= 0) ::close(line);
  line = fd;
  return true;
}

void Guard::lend(const GuardMessage& message) {
  GuardMessage answer = message;
  PassedMessage passed(&answer, sizeof answer);
  const bool named = is_name(message.name);
  const bool relay = named && relay_line_ >= 0 && message.name == relay_name_;
  passed.pass(relay ? relay_line_ : named ? set_.descriptor(message.name.data()) : -1);
  ::sendmsg(daemon_, &passed.header(), MSG_DONTWAIT | MSG_NOSIGNAL);
}

bool Guard::let_go(const GuardMessage& message) {
  if (!is_name(message.name)) return false;
  if (relay_line_ >= 0 && message.name == relay_name_) ::close(std::exchange(relay_line_, -1));
  (void)next_.let_go(message.name.data());  // of a set that was refused
  if (set_.let_go(message.name.data())) keep_.keep(set_, limit_ms_);
  return true;
}

void Guard::use_memory(int fd, GuardShared* shared) {
  if (shared_ != nullptr) ::munmap(shared_, sizeof(GuardShared));
  if (memory_ >= 0) ::close(memory_);
  shared_ = shared;
  memory_ = fd;
}

}  // namespace drover::guard
