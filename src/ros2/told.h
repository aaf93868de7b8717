// What a line of droverd tells of the robot: what is new since the line before. Stamps are
// wall-clock nanoseconds; numbers that are absent are NaN.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "drover/measurement.h"
#include "drover/result.h"

namespace drover::ros2 {

using Stamp_ns = std::int64_t;

struct JointTold {
  std::string name;
  double position_rad = kAbsent;
  double velocity_radps = kAbsent;
  double effort_Nm = kAbsent;
};

struct JointsTold {
  Stamp_ns at_ns = 0;
  std::vector<JointTold> each;
};

struct ImuTold {
  Stamp_ns at_ns = 0;
  std::optional<Quaternion> orientation;  ///< of base_link, ENU
  double orientation_sigma_rad = kAbsent;
  double yaw_sigma_rad = kAbsent;
  Vector3 rate_radps;
  Vector3 acceleration_mps2;
  double rate_sigma_radps = kAbsent;
  double acceleration_sigma_mps2 = kAbsent;
};

struct FixTold {
  Stamp_ns at_ns = 0;
  std::string receiver;
  GnssPosition position;
};

struct OdometryTold {
  Stamp_ns at_ns = 0;
  double x_m = 0;
  double y_m = 0;
  double yaw_rad = 0;
  double vx_mps = 0;
  double wz_radps = 0;
  double vy_mps = 0;
  double x_var = 0;
  double xy_var = 0;
  double y_var = 0;
  double x_yaw_var = 0;
  double y_yaw_var = 0;
  double yaw_var = 0;
  double vx_var = 0;
  double wz_var = 0;
  double vy_var = 0;
};

/// Of the odometry's instant, in `map`.
struct PoseTold {
  double x_m = 0;
  double y_m = 0;
  double yaw_rad = 0;
  double position_sigma_m = kAbsent;
  double yaw_sigma_rad = kAbsent;
};

struct BatteryTold {
  Stamp_ns at_ns = 0;
  bool heard = false;
  BatterySample sample;
};

struct TouchTold {
  struct One {
    std::string name;
    bool touched = true;
  };
  Stamp_ns at_ns = 0;
  std::vector<One> each;
};

struct ScanTold {
  struct Point {
    double bearing_rad = 0;
    double range_m = 0;  ///< 0: none is known there
    double intensity = 0;
  };
  std::string name;
  Stamp_ns begin_ns = 0;
  Stamp_ns end_ns = 0;
  double turn_Hz = 0;
  std::vector<Point> points;
};

struct DiagnosticTold {
  std::string name;
  int level = 0;
  std::string message;
  std::vector<std::pair<std::string, std::string>> values;
};

struct Told {
  Stamp_ns at_ns = 0;
  std::optional<JointsTold> joints;
  std::optional<ImuTold> imu;
  std::optional<FixTold> fix;
  std::optional<OdometryTold> odometry;
  std::optional<PoseTold> pose;
  std::optional<BatteryTold> battery;
  std::optional<TouchTold> touch;
  std::vector<ScanTold> scans;
  std::vector<DiagnosticTold> diagnostics;  ///< empty: none this time
};

/// Why a line is none, or what droverd has against this program; empty: the answer to a request.
struct NoTold {
  std::string reason;
  bool done = false;  ///< what was asked for
  bool stop_refused = false;
};

/// Members that are not known are left out of account: droverd may be newer.
Result<Told, NoTold> read_told(std::string_view line);

}  // namespace drover::ros2
