// From a log or a recording to what `drover calibrate` looks at. Pure.
#pragma once

#include <optional>
#include <string>

#include "calibrate/calibrate.h"
#include "cli/estimate_log.h"
#include "drover/snapshot.h"
#include "engine/config.h"
#include "engine/estimate/local_frame.h"

namespace drover::cli {

/// Why driving tells nothing of its numbers; empty: it does.
std::string rollers_of(const engine::BaseConfig& base);
calibrate::Configured configured_of(const engine::EngineConfig& config);

class DriveOfLog final {
 public:
  explicit DriveOfLog(const engine::BaseConfig& base) : base_(base) {}
  void take(const LogRow& row);
  calibrate::Drive drive;

 private:
  calibrate::RimRow rims_of(const LoggedMotion& motion, Time time) const;

  engine::BaseConfig base_;
  engine::estimate::LocalFrame frame_;
};

/// Of each cycle what is new in it.
class DriveOfRecording final {
 public:
  explicit DriveOfRecording(const engine::BaseConfig& base) : base_(base) {}
  void take(const Snapshot& snapshot);
  calibrate::Drive drive;

 private:
  void take_wheels(const Snapshot& snapshot);
  void take_base(const Snapshot& snapshot);
  /// Positions only where the base is `level`.
  void take_receiver(const GnssSnapshot& gnss, bool level);
  void take_gyro(const ImuSnapshot& imu);

  engine::BaseConfig base_;
  engine::estimate::LocalFrame frame_;
  Time rims_at_ = kNever;
  Time place_at_ = kNever;
  Time heading_at_ = kNever;
  Time speed_at_ = kNever;
  Time gyro_at_ = kNever;
};

/// Only what is `from_s` to `to_s` after the first wheel speed.
void cut(calibrate::Drive& drive, double from_s, double to_s);

}  // namespace drover::cli
