// Tells whether the machine had time for this test: a robot in real time proves nothing without.
#pragma once

#include <algorithm>
#include <atomic>
#include <chrono>
#include <thread>

namespace drover::test {

/// Set by a test that failed on such a machine; main.cpp then runs it again.
inline bool machine_was_starved = false;

/// A thread that only sleeps, and notes how much too late it woke.
class StarvationWatch final {
 public:
  StarvationWatch()
      : thread_([this] {
          while (!stop_) {
            const auto before = Clock::now();
            std::this_thread::sleep_for(kNap);
            longest_ = std::max(longest_.load(), Clock::now() - before - kNap);
          }
        }) {}
  ~StarvationWatch() {
    stop_ = true;
    thread_.join();
  }
  StarvationWatch(const StarvationWatch&) = delete;
  StarvationWatch& operator=(const StarvationWatch&) = delete;

  double longest_s() const { return std::chrono::duration<double>(longest_.load()).count(); }
  /// No gateway keeps its promises on a machine that does not let it run for so long.
  bool starved() const { return longest_s() > 0.3; }

 private:
  using Clock = std::chrono::steady_clock;
  static constexpr std::chrono::milliseconds kNap{20};

  std::atomic<bool> stop_{false};
  std::atomic<Clock::duration> longest_{Clock::duration::zero()};
  std::thread thread_;
};

}  // namespace drover::test
