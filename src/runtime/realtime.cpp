#include "runtime/realtime.h"

#include <pthread.h>
#include <sched.h>
#include <sys/mman.h>

#include <array>
#include <cerrno>
#include <cstring>

namespace drover::runtime {

namespace {

/// Touches the stack that the thread will use, so that no page fault comes later.
void touch_stack() {
  std::array<volatile char, 128 * 1024> stack{};
  for (std::size_t i = 0; i < stack.size(); i += 4096) stack[i] = 1;
}

}  // namespace

std::string become_real_time(int priority) {
  std::string missing;
  sched_param parameters{};
  parameters.sched_priority = priority;
  if (const int error = ::pthread_setschedparam(::pthread_self(), SCHED_FIFO, &parameters))
    missing = std::string("no real-time priority (") + std::strerror(error) +
              "; allow it with LimitRTPRIO= or an rtprio limit)";
  // On fault: locking every mapping at once would cost some 40 MB of memory that is never used.
  if (::mlockall(MCL_CURRENT | MCL_FUTURE | MCL_ONFAULT) != 0)
    missing += std::string(missing.empty() ? "" : "; ") + "memory is not locked (" +
               std::strerror(errno) + ")";
  touch_stack();
  return missing;
}

}  // namespace drover::runtime
