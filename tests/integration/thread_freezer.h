// Holds one thread of another process, while its other threads run on.
#pragma once

#include <sys/types.h>

#include <string_view>

namespace drover::test {

class ThreadFreezer final {
 public:
  /// The thread of `process` with this name (as in /proc); frozen() tells whether it was found and
  /// stands. Only a child of the caller can be held.
  ThreadFreezer(pid_t process, std::string_view name);
  /// Lets it go on.
  ~ThreadFreezer();
  ThreadFreezer(const ThreadFreezer&) = delete;
  ThreadFreezer& operator=(const ThreadFreezer&) = delete;

  bool frozen() const { return thread_ > 0; }
  void thaw();

 private:
  pid_t thread_ = -1;
};

}  // namespace drover::test
