// The counting calls. They end in the next definition, which may be a sanitizer's.
#include "support/terminal_touches.h"

#include <dlfcn.h>
#include <poll.h>
#include <signal.h>
#include <unistd.h>

#include <cerrno>
#include <span>

namespace {

thread_local std::uint64_t touches = 0;

void look_at(int fd) {
  const int error = errno;
  if (::isatty(fd) == 1) ++touches;
  errno = error;
}

void look_at(const pollfd* fds, nfds_t count) {
  for (const pollfd& each : std::span(fds, count)) look_at(each.fd);
}

template <class Function>
Function* next(const char* name) {
  return reinterpret_cast<Function*>(::dlsym(RTLD_NEXT, name));
}

}  // namespace

namespace drover::test {

std::uint64_t TerminalTouches::total() {
  return touches;
}

}  // namespace drover::test

extern "C" {

ssize_t read(int fd, void* buffer, size_t size) {
  static auto* const call = next<decltype(::read)>("read");
  look_at(fd);
  return call(fd, buffer, size);
}

int poll(pollfd* fds, nfds_t count, int timeout) {
  static auto* const call = next<decltype(::poll)>("poll");
  look_at(fds, count);
  return call(fds, count, timeout);
}

int ppoll(pollfd* fds, nfds_t count, const timespec* timeout, const sigset_t* mask) {
  static auto* const call = next<decltype(::ppoll)>("ppoll");
  look_at(fds, count);
  return call(fds, count, timeout, mask);
}
}
