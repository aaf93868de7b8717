// A scanner's thread: opens its line for ever, has its driver decode what comes, and looks at each
// turn for what is in the robot's way. Only turns and that leave it: to the scene, whole, and to
// people in short. The control thread hears none of its bytes.
#pragma once

#include <atomic>
#include <memory>
#include <string>
#include <vector>

#include "config/config.h"
#include "drover/driver.h"
#include "drover/snapshot.h"
#include "drover/triple_buffer.h"
#include "link/serial_link.h"
#include "runtime/back_off.h"
#include "runtime/wake.h"
#include "scene/sensor/near_things.h"
#include "scene/sensor/seen.h"

namespace drover::runtime {

/// For people, and when it was said: who stands still says nothing new.
struct ScanTold {
  ScannerSnapshot scanner;
  LinkSnapshot link;
  Time at = kNever;
};

struct ScanExchange {
  TripleBuffer<scene::sensor::ScanSeen> seen;        ///< → scene
  TripleBuffer<scene::sensor::SeenTurn> turn;        ///< likewise, the latest one whole
  TripleBuffer<ScanTold> told;                       ///< → publish
  TripleBuffer<scene::sensor::SeenTurn> shown_turn;  ///< likewise, the latest one whole
};

class ScanLoop final {
 public:
  /// `device` is a scanner of `config`, which has no problems.
  ScanLoop(const config::DroverConfig& config, const config::DeviceConfig& device,
           ScanExchange& exchange);
  void run(const std::atomic<bool>& stop);
  void wake() const { wake_.notify(); }
  /// Counts at least ten times a second while the thread lives, unless it opens its line.
  const std::atomic<std::uint64_t>& turns() const { return turns_; }

  /// Opening, and room for a machine that is busy. What was seen is too old long before.
  static constexpr Duration kLongestTurn = std::chrono::seconds(5);

 private:
  void open(Time now);
  void lose(const std::string& why, Time now);
  void hear();
  void decode(std::span<const std::uint8_t> bytes, Time first);
  void take(const Scan& turn);
  SourceHealth health(Time now) const;
  void publish(Time now);
  void sleep(Time now);

  ScanExchange& exchange_;
  const Name name_;
  const Name link_name_;
  const link::SerialSettings settings_;
  const Duration byte_time_;
  Made made_;
  const scene::sensor::SensorField field_;
  std::unique_ptr<link::SerialLink> link_;
  Wake wake_;
  BackOff retry_{std::chrono::milliseconds(500), std::chrono::seconds(10)};
  Reason problem_ = "not opened yet";
  std::vector<std::uint8_t> buffer_;
  ScanOut out_;
  scene::sensor::ScanSeen seen_;  ///< of the latest turn
  ScannerSnapshot shown_;         ///< likewise
  Time read_ = kNever;            ///< the line, last
  std::uint64_t received_ = 0;
  Time next_publish_ = kNever;
  std::atomic<std::uint64_t> turns_{0};
};

/// The scanners of a configuration, in its order, each with its thread.
struct ScanLink {
  ScanExchange exchange;
  std::unique_ptr<ScanLoop> loop;
};
std::vector<std::unique_ptr<ScanLink>> scan_links(const config::DroverConfig& config);

/// When a line was read before, and when it was read now.
struct ReadTimes {
  Time before = kNever;
  Time now = kNever;
};
/// When the first of the bytes that were found came in. Of what waited nobody knows for how long:
/// as early as it can have been, so that what a thread finds that stood still is not taken for
/// young.
Time came_in(const ReadTimes& read, std::size_t size, Duration byte_time);

/// What of a turn is nearest to a scanner that is mounted with this yaw; absent: it sees nothing.
void show_nearest(const Scan& turn, double yaw_rad, ScannerSnapshot& shown);

/// What a scanner's thread said of it, as it may be shown at `now`.
ScannerSnapshot as_shown(const ScanTold& told, Time now);

}  // namespace drover::runtime
