#include "runtime/storage_loop.h"

#include <poll.h>

#include "runtime/log.h"

namespace drover::runtime {

namespace {

constexpr int kRetry_ms = 1000;

/// The latched stop goes before everything else, and is tried again until it is durable.
class StopKeeper final {
 public:
  StopKeeper(store::Storage& storage, StorageExchange& exchange, const Remembered& on_disk)
      : storage_(storage), exchange_(exchange), on_disk_(on_disk) {}

  /// False: it is not on the disk yet.
  bool save() {
    const KeptStop& kept = exchange_.stop.latest();
    const Remembered wanted = store::lasting(kept.remembered);
    if (!kept.given || wanted == on_disk_) return true;
    const auto failure = storage_.save_stop(wanted);
    const std::string trouble = failure ? failure->text : "";
    if (trouble != failed_) tell(trouble);
    failed_ = trouble;
    if (!failure) on_disk_ = wanted;
    return !failure;
  }

 private:
  void tell(const std::string& trouble) {
    exchange_.stop_trouble.back().assign(trouble);
    exchange_.stop_trouble.publish();
    if (trouble.empty()) {
      log(LogLevel::info, "the stop is kept again");
    } else {
      log(LogLevel::error, "the stop is not kept: " + trouble);
    }
  }

  store::Storage& storage_;
  StorageExchange& exchange_;
  Remembered on_disk_;
  std::string failed_;
};

}  // namespace

void run_storage(store::Storage& storage, StorageExchange& exchange, Remembered on_disk,
                 const std::atomic<bool>& stop) {
  storage.keep_room_for_stop();
  StopKeeper stop_keeper(storage, exchange, on_disk);
  bool kept = true;
  store::StorageJob job;
  while (!stop.load(std::memory_order_relaxed)) {
    pollfd wait{exchange.jobs_ready.fd(), POLLIN, 0};
    ::poll(&wait, 1, kept ? -1 : kRetry_ms);
    exchange.jobs_ready.clear();
    kept = stop_keeper.save();
    while (exchange.jobs.pop(job)) {
      auto reply = storage.run(std::move(job));
      // Never lost: as many replies fit as jobs, and the publish thread empties them at every
      // wake-up.
      const auto given = [&] { return exchange.replies.push(std::move(reply)); };
      while (!given() && !stop.load()) ::poll(nullptr, 0, 1);
      exchange.replies_ready.notify();
      kept = stop_keeper.save();
    }
  }
  (void)stop_keeper.save();
}

}  // namespace drover::runtime
