// The simulator's records: every frame as `candump -L` writes it, and the robot's true motion.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "drover/can_frame.h"
#include "drover/time.h"
#include "link/unique_fd.h"
#include "sim/robot/robot.h"

namespace drover::sim {

/// Collects text and writes it in large pieces; what a full disk refuses is dropped and counted.
class TextLog {
 public:
  /// Empty path: everything is dropped. Throws std::runtime_error when the file cannot be made.
  explicit TextLog(const std::string& path);
  ~TextLog() { flush(); }
  TextLog(TextLog&&) = default;

  bool on() const { return static_cast<bool>(fd_); }
  void append(std::string_view text);
  void flush();

 private:
  link::UniqueFd fd_;
  std::string buffer_;
};

/// "(12.345678901) ": seconds of the monotonic clock, nine digits.
void append_stamp(std::string& line, Time time);
/// "(12.345678901) can0 00D#00000000".
/// Appends one line; error frames carry candump's error flag in the id.
void append_candump(std::string& line, Time time, std::string_view bus, const CanFrame& frame);

class CanLog {
 public:
  explicit CanLog(const std::string& path) : log_(path) {}
  /// Lines never go back in time: a stamp before the last one is written as the last one.
  void write(Time time, std::string_view bus, const CanFrame& frame);
  void flush() { log_.flush(); }

 private:
  TextLog log_;
  std::string line_;
  Time last_ = kNever;
};

/// What was written to serial drives, as their lines carried it: "(12.345678901) base EDDE0000...",
/// one line a tick, cut anywhere.
class SerialLog {
 public:
  explicit SerialLog(const std::string& path) : log_(path) {}
  void write(Time time, std::string_view port, std::span<const std::uint8_t> bytes);
  void flush() { log_.flush(); }

 private:
  TextLog log_;
  std::string line_;
};

/// CSV with a header line: time_s, x_m, y_m, z_m, roll_rad, pitch_rad, yaw_rad, vx_mps, wz_radps,
/// free_ahead_m, velocity and torque of each wheel, what a perfect inertial sensor would tell, and
/// angle, velocity and torque of each joint of an arm.
class TruthLog {
 public:
  TruthLog(const std::string& path, const Robot& robot);
  void write(const Robot::Truth& truth);
  void flush() { log_.flush(); }

 private:
  TextLog log_;
};

}  // namespace drover::sim
