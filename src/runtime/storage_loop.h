// The storage thread: runs the store's jobs in order, as long as the disk takes. Outside the
// heartbeat.
#pragma once

#include <atomic>

#include "drover/spsc_ring.h"
#include "drover/triple_buffer.h"
#include "runtime/wake.h"
#include "store/storage.h"

namespace drover::runtime {

/// What the control thread wants kept on disk; `given` once there is anything.
struct KeptStop {
  bool given = false;
  Remembered remembered;
};

/// What the storage thread shares with the publish thread, and of the stop with the control thread.
struct StorageExchange {
  SpscRing<store::StorageJob, 64> jobs;       ///< publish → storage; full: the command is refused
  SpscRing<store::StorageReply, 64> replies;  ///< storage → publish
  TripleBuffer<KeptStop> stop;                ///< control → storage
  TripleBuffer<Reason> stop_trouble;          ///< storage → publish: why it is not on the disk
  Wake jobs_ready;
  Wake replies_ready;
};

/// `on_disk`: the stop that is stored already.
void run_storage(store::Storage& storage, StorageExchange& exchange, Remembered on_disk,
                 const std::atomic<bool>& stop);

}  // namespace drover::runtime
