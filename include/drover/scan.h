// What a scanner sees in one turn, and the face of its driver.
//
// A turn is some hundred points, too much for a Measurement, and comes as hundreds of packets a
// second, too many for the control thread: a scanner has a face and a thread of its own.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>

#include "drover/angle.h"
#include "drover/fixed_vector.h"
#include "drover/time.h"

namespace drover {

/// One beam. Seen from above, whichever side of the sensor is up.
struct ScanPoint {
  double bearing_rad = 0;  ///< counter-clockwise from the sensor's x, [-pi, pi)
  /// To an obstacle. 0: none is known there, which is not "free": nothing came back, or it came
  /// from the robot itself, or from nearer or farther than the sensor is believed.
  double range_m = 0;
  std::uint8_t intensity = 0;  ///< as the device tells it
};

/// What the absence of points in a part of the turn means.
enum class SectorState : std::uint8_t {
  unknown,    ///< nothing: too few beams come back from there
  seen_free,  ///< where no point is, there is nothing that this sensor can see
};

/// A turn of 4500 points a second at 4.4 Hz.
inline constexpr std::size_t kMaxScanPoints = 1024;
inline constexpr std::size_t kMaxScanSectors = 72;

/// One whole turn. Points in the order in which they were measured.
struct Scan {
  Time begin = kNever;  ///< its first point was measured
  Time end = kNever;    ///< its last
  double turn_Hz = 0;   ///< as the device tells its speed
  FixedVector<ScanPoint, kMaxScanPoints> points;
  /// Equal parts of the turn, counter-clockwise; the first begins at -pi.
  FixedVector<SectorState, kMaxScanSectors> sectors;
};

/// The one of `sectors` equal parts of the turn that a bearing in [-pi, pi) lies in.
inline std::size_t sector_of(double bearing_rad, std::size_t sectors) {
  const double part = (bearing_rad + kPi) / (2 * kPi) * static_cast<double>(sectors);
  const auto index = static_cast<std::size_t>(part > 0 ? part : 0);
  return index < sectors ? index : sectors - 1;
}

/// Where a scanner is in base_link (REP 103: x ahead, y left, z up). Its plane is level.
struct ScanMount {
  double x_m = 0;
  double y_m = 0;
  double z_m = 0;      ///< of the beams above the ground
  double yaw_rad = 0;  ///< of the sensor's x, counter-clockwise from ahead
};

/// What a scanner's driver says in answer to one call. The caller owns it and empties it.
struct ScanOut {
  FixedVector<Scan, 4> scans;
  std::uint32_t overflows = 0;  ///< turns that did not fit and were dropped

  void report(const Scan& scan) { overflows += scans.push_back(scan) ? 0 : 1; }
  void clear() {
    scans.clear();
    overflows = 0;
  }
};

/// Of a Device that scans, on a byte stream. The device owns its framer and gives the same result
/// for any chunking; its calls come from one thread, which is not the control thread.
class ScanFace {
 public:
  /// `first_byte` is when the first of these bytes came in. Of 4 kB no turn is dropped.
  virtual void on_bytes(std::span<const std::uint8_t> bytes, Time first_byte, ScanOut& out) = 0;
  /// Constant from construction on.
  virtual ScanMount mount() const = 0;

 protected:
  ~ScanFace() = default;
};

}  // namespace drover
