// A thread that reads what is large where nobody waits for it, one after the other. Two megabytes
// take longer than a stop may.
#pragma once

#include <poll.h>
#include <sys/resource.h>
#include <unistd.h>

#include <atomic>
#include <cstdint>
#include <functional>
#include <utility>

#include "drover/spsc_ring.h"
#include "drover/time.h"
#include "runtime/wake.h"

namespace drover::runtime {

/// A `Job` has a payload; a `Reply` its job, beside what was made of it.
template <class Job, class Reply>
class ParsingThread {
 public:
  /// Four of the largest: what is beyond is refused aloud rather than kept.
  static constexpr std::size_t kMostWaitingBytes = std::size_t{8} << 20;
  static constexpr std::size_t kMostUnderWay = 64;
  static constexpr Duration kLongestTurn = std::chrono::seconds(5);

  /// `parse`: what becomes of the reply's job.
  explicit ParsingThread(std::function<void(Reply&)> parse) : parse_(std::move(parse)) {}

  // Publish thread:
  /// False when too much waits; then nothing was taken.
  [[nodiscard]] bool give(Job job) {
    const auto size = job.payload.size();
    // As many fit into each ring, so that a reply always finds room.
    if (under_way_ >= kMostUnderWay || waiting_bytes_ + size > kMostWaitingBytes) return false;
    if (!jobs_.push(std::move(job))) return false;
    ++under_way_;
    waiting_bytes_ += size;
    jobs_ready_.notify();
    return true;
  }
  /// Something was given whose reply was not taken yet: what comes after it must wait for it.
  bool busy() const { return under_way_ > 0; }
  bool take(Reply& reply) {
    if (!replies_.pop(reply)) return false;
    --under_way_;
    waiting_bytes_ -= reply.job.payload.size();
    return true;
  }
  /// Readable when a reply waits.
  const Wake& replies_ready() const { return replies_ready_; }

  void run(const std::atomic<bool>& stop) {
    ::setpriority(PRIO_PROCESS, static_cast<id_t>(::gettid()), kNiceness);
    Reply reply;
    while (!stop.load(std::memory_order_relaxed)) {
      pollfd wait{jobs_ready_.fd(), POLLIN, 0};
      ::poll(&wait, 1, kLongestWait_ms);
      jobs_ready_.clear();
      turns_.fetch_add(1, std::memory_order_relaxed);
      while (jobs_.pop(reply.job)) {
        parse_(reply);
        (void)replies_.push(std::move(reply));
        reply = {};
        replies_ready_.notify();
        turns_.fetch_add(1, std::memory_order_relaxed);
      }
    }
  }
  void wake() const { jobs_ready_.notify(); }
  /// Counts at least once in kLongestTurn while the thread lives.
  const std::atomic<std::uint64_t>& turns() const { return turns_; }

 private:
  static constexpr int kNiceness = 10;  // whoever floods us pays for it with time
  static constexpr int kLongestWait_ms = 500;

  std::function<void(Reply&)> parse_;
  SpscRing<Job, kMostUnderWay> jobs_;
  SpscRing<Reply, kMostUnderWay> replies_;
  Wake jobs_ready_;
  Wake replies_ready_;
  std::size_t under_way_ = 0;      ///< publish thread's
  std::size_t waiting_bytes_ = 0;  ///< publish thread's
  std::atomic<std::uint64_t> turns_{0};
};

}  // namespace drover::runtime
