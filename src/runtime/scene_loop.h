// The scene's thread: forty times a second it looks where the robot may go, and in between follows
// messages about what is around. What it does not answer in time stops the robot.
#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <span>

#include "config/config.h"
#include "link/unique_fd.h"
#include "runtime/late_looks.h"
#include "runtime/scan_loop.h"
#include "runtime/scene_work.h"

namespace drover::runtime {

class SceneLoop final {
 public:
  static constexpr Duration kPeriod = std::chrono::milliseconds(25);
  /// Of each period for jobs, and not much more: a single one takes some milliseconds at most.
  static constexpr Duration kWork = std::chrono::milliseconds(10);
  /// And for looks along tracks that are to be started, after the robot's own.
  static constexpr Duration kChecks = std::chrono::milliseconds(5);
  /// Standing still it stops the robot long before; then nobody can start it any more.
  static constexpr Duration kLongestTurn = std::chrono::seconds(5);

  /// `scanners`: all of the robot's.
  SceneLoop(const config::DroverConfig& config, SceneExchange& exchange,
            std::shared_ptr<const store::StoredScene> stored,
            std::span<const std::unique_ptr<ScanLink>> scanners = {});

  void run(const std::atomic<bool>& stop);
  /// Counts once a period.
  const std::atomic<std::uint64_t>& turns() const { return turns_; }

 private:
  void turn();
  void look();
  bool see();
  void look_at_scanners();

  const config::ControlConfig& control_;
  SceneExchange& exchange_;
  std::span<const std::unique_ptr<ScanLink>> scanners_;
  SceneWork work_;
  LateLooks late_;
  std::uint64_t found_ = 0;
  std::atomic<std::uint64_t> turns_{0};
};

}  // namespace drover::runtime
