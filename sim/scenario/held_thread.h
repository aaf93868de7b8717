// One thread of a child process stands still, as if it hung: a debugger's stop, which the others do
// not notice.
#pragma once

#include <sys/types.h>

#include <string_view>

namespace drover::sim {

class HeldThread final {
 public:
  /// The thread of `process`, a child of the caller, with this name (as in /proc).
  HeldThread(pid_t process, std::string_view name);
  /// Lets it go on.
  ~HeldThread() { let_go(); }
  HeldThread(const HeldThread&) = delete;
  HeldThread& operator=(const HeldThread&) = delete;

  /// False: there is no such thread, or this machine lets nobody hold one.
  bool held() const { return thread_ > 0; }
  void let_go();

 private:
  pid_t thread_ = -1;
};

}  // namespace drover::sim
