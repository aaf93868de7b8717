// A named thread that is waited for only so long: what hangs must not keep the daemon from ending.
#pragma once

#include <sys/prctl.h>

#include <atomic>
#include <thread>
#include <utility>

#include "drover/time.h"

namespace drover::runtime {

/// Names the calling thread, at most 15 letters: `top -H` and a core tell which one hangs.
inline void name_thread(const char* name) {
  ::prctl(PR_SET_NAME, name);
}

class Worker final {
 public:
  template <class Body>
  Worker(const char* name, Body body)
      : name_(name), thread_([this, body = std::move(body)] {
          name_thread(name_);
          body();
          ended_.store(true, std::memory_order_release);
        }) {}
  Worker(const Worker&) = delete;
  Worker& operator=(const Worker&) = delete;

  const char* name() const { return name_; }
  /// False: it still runs, and the object must not be destroyed.
  [[nodiscard]] bool join_within(Duration longest) {
    constexpr Duration kStep = std::chrono::milliseconds(2);
    for (Duration waited{}; !ended_.load(std::memory_order_acquire); waited += kStep) {
      if (waited >= longest) return false;
      std::this_thread::sleep_for(kStep);
    }
    thread_.join();
    return true;
  }

 private:
  const char* name_;
  std::atomic<bool> ended_{false};
  std::thread thread_;  // last: it uses the others
};

}  // namespace drover::runtime
