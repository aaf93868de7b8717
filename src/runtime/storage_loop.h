// The storage thread: runs the store's jobs in order, as long as the disk takes. Outside the
// heartbeat.
#pragma once

#include <atomic>

#include "drover/spsc_ring.h"
#include "runtime/wake.h"
#include "store/storage.h"

namespace drover::runtime {

/// What the storage thread shares with the publish thread.
struct StorageExchange {
  SpscRing<store::StorageJob, 64> jobs;       ///< publish → storage; full: the command is refused
  SpscRing<store::StorageReply, 64> replies;  ///< storage → publish
  Wake jobs_ready;
  Wake replies_ready;
};

void run_storage(store::Storage& storage, StorageExchange& exchange, const std::atomic<bool>& stop);

}  // namespace drover::runtime
