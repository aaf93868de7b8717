#include "cli/key_terminal.h"

#include <poll.h>
#include <sys/signalfd.h>
#include <unistd.h>

#include <array>

#include "runtime/clock.h"

namespace drover::cli {

using runtime::monotonic_now;

KeyTerminal::KeyTerminal() {
  sigset_t ends;
  ::sigemptyset(&ends);
  for (const int number : {SIGTERM, SIGHUP, SIGINT}) ::sigaddset(&ends, number);
  ::sigprocmask(SIG_BLOCK, &ends, &blocked_before_);
  signals_ = link::UniqueFd(::signalfd(-1, &ends, SFD_NONBLOCK | SFD_CLOEXEC));
  ::tcgetattr(STDIN_FILENO, &before_);
  termios raw = before_;
  raw.c_lflag &= ~static_cast<tcflag_t>(ICANON | ECHO | ISIG);
  raw.c_cc[VMIN] = 0;
  raw.c_cc[VTIME] = 0;
  ::tcsetattr(STDIN_FILENO, TCSAFLUSH, &raw);  // what was typed before is no key
}

KeyTerminal::~KeyTerminal() {
  // Not after what is still to be shown: where nobody reads that it would never end.
  ::tcsetattr(STDIN_FILENO, TCSANOW, &before_);
  ::tcflush(STDIN_FILENO, TCIFLUSH);
  ::sigprocmask(SIG_SETMASK, &blocked_before_, nullptr);
}

KeyTerminal::Keys KeyTerminal::read(int wait_ms) {
  Keys keys;
  if (const auto question = watch_.ask(monotonic_now()); !question.empty())
    keys.quit = ::write(STDIN_FILENO, question.data(), question.size()) < 0;
  std::array<pollfd, 2> fds{{{STDIN_FILENO, POLLIN, 0}, {signals_.get(), POLLIN, 0}}};
  // What is there already may have come at any time since the last look.
  const bool waited = ::poll(fds.data(), fds.size(), 0) == 0;
  const Time at = waited || looked_ == kNever ? kNever : looked_;
  if (waited) ::poll(fds.data(), fds.size(), wait_ms);
  looked_ = monotonic_now();
  signalfd_siginfo told{};
  if (::read(signals_.get(), &told, sizeof told) > 0) keys.quit = true;
  if (fds[0].revents == 0) return keys;
  std::array<char, 4096> typed{};
  const auto n = ::read(STDIN_FILENO, typed.data(), typed.size());
  keys.quit = keys.quit || n <= 0;
  for (ssize_t i = 0; i < n; ++i) {
    const char key = typed[static_cast<std::size_t>(i)];
    if (watch_.take(key, looked_)) continue;
    // Otherwise it was let go, perhaps, and nobody here knows yet.
    if (key == ' ' && watch_.counts(looked_)) keys.space = at == kNever ? looked_ : at;
    keys.quit = keys.quit || key == 'q' || key == 'Q' || key == '\x03' || key == '\x04';
  }
  return keys;
}

bool KeyTerminal::is_silent() const {
  return watch_.is_silent(monotonic_now());
}
bool KeyTerminal::is_late() const {
  return watch_.is_late(monotonic_now());
}
double KeyTerminal::delay_s() const {
  return to_s(watch_.delay(monotonic_now()));
}

}  // namespace drover::cli
