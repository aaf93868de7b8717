#include "runtime/parser_loop.h"

#include <poll.h>
#include <sys/resource.h>
#include <unistd.h>

namespace drover::runtime {

namespace {
constexpr std::size_t kMostUnderWay = 64;
constexpr int kNiceness = 10;  // whoever floods us with large messages pays for it with time
constexpr int kLongestWait_ms = 500;
}  // namespace

bool ParserLoop::give(ParseJob job) {
  const auto size = job.payload.size();
  // As many fit into each ring, so that a reply always finds room.
  if (under_way_ >= kMostUnderWay || waiting_bytes_ + size > kMostWaitingBytes) return false;
  if (!jobs_.push(std::move(job))) return false;
  ++under_way_;
  waiting_bytes_ += size;
  jobs_ready_.notify();
  return true;
}

bool ParserLoop::take(ParseReply& reply) {
  if (!replies_.pop(reply)) return false;
  --under_way_;
  waiting_bytes_ -= reply.job.payload.size();
  return true;
}

void ParserLoop::run(const std::atomic<bool>& stop) {
  ::setpriority(PRIO_PROCESS, static_cast<id_t>(::gettid()), kNiceness);
  ParseReply reply;
  while (!stop.load(std::memory_order_relaxed)) {
    pollfd wait{jobs_ready_.fd(), POLLIN, 0};
    ::poll(&wait, 1, kLongestWait_ms);
    jobs_ready_.clear();
    turns_.fetch_add(1, std::memory_order_relaxed);
    while (jobs_.pop(reply.job)) {
      reply.request.emplace(
          publish::parse_control(reply.job.payload, reply.job.arrival.retain, limits_));
      (void)replies_.push(std::move(reply));
      reply = {};
      replies_ready_.notify();
      turns_.fetch_add(1, std::memory_order_relaxed);
    }
  }
}

}  // namespace drover::runtime
