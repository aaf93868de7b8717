#include "runtime/storage_loop.h"

#include <poll.h>

namespace drover::runtime {

void run_storage(store::Storage& storage, StorageExchange& exchange,
                 const std::atomic<bool>& stop) {
  store::StorageJob job;
  while (!stop.load(std::memory_order_relaxed)) {
    pollfd wait{exchange.jobs_ready.fd(), POLLIN, 0};
    ::poll(&wait, 1, -1);
    exchange.jobs_ready.clear();
    while (exchange.jobs.pop(job)) {
      const auto reply = storage.run(job);
      job = {};
      // Never lost: as many replies fit as jobs, and the publish thread empties them at every
      // wake-up.
      while (!exchange.replies.push(reply) && !stop.load()) ::poll(nullptr, 0, 1);
      exchange.replies_ready.notify();
    }
  }
}

}  // namespace drover::runtime
