// Driver of a WitMotion inertial sensor on a serial line: one sample per output cycle.
#pragma once

#include <cstdint>

#include "drivers/witmotion/codec.h"
#include "drivers/witmotion/framer.h"
#include "drivers/witmotion/setup.h"
#include "drivers/witmotion/watch.h"
#include "drover/driver.h"
#include "drover/options.h"

namespace drover::witmotion {

/// The device tells one reading in several frames (51 acceleration, 52 rate, 53 angles, 54 magnetic
/// field, 59 quaternion), in the order of their types. The driver reports an ImuSample as soon as
/// the last frame of the cycle is in; a cycle that lost its acceleration or its rate is dropped.
///
/// Time. The device stamps nothing that could be used: a sample is as old as the first byte of its
/// cycle, and times never go back.
class WitmotionDriver final : public Device, public ByteFace {
 public:
  /// Throws std::runtime_error when options contradict each other.
  explicit WitmotionDriver(const Options& options);

  void on_bytes(std::span<const std::uint8_t> bytes, Time first_byte, DriverOut& out) override;
  void on_tick(Time now, DriverOut& out) override;
  void on_link_up(Time now) override;
  SourceHealth health(Time now) const override;

 private:
  struct Cycle {
    Time first_byte = kNever;
    std::uint16_t kinds = 0;  ///< Content bits that are in
    std::uint8_t last_type = 0;
    bool told = true;
    Acceleration acceleration;
    AngularRate rate;
    Angles angles;
    Attitude attitude;
    MagneticField field;
  };

  void on_frame(Time first_byte, Time received, DriverOut& out);
  void end_cycle(Time received, DriverOut& out);
  void add(const Report& report);
  void tell(Time received, DriverOut& out);
  bool orient(ImuSample& sample);
  Fingerprint fingerprint() const;
  void explain_silence(Time now, Reason& reason) const;
  void explain_oddity(Time now, Reason& reason) const;

  // Settings.
  Format format_;
  double rate_Hz_;
  Duration stale_;
  bool magnetic_yaw_;
  Quaternion to_base_;     ///< from the sensor's axes to base_link
  Quaternion yaw_offset_;  ///< from the device's world to east, north, up

  Framer framer_;
  Setup setup_;
  FrozenWatch frozen_;
  PaceWatch pace_;
  GravityWatch gravity_;
  Cycle cycle_;
  std::uint16_t expected_kinds_;
  std::uint16_t previous_kinds_ = 0;
  Time frame_first_byte_ = kNever;

  Time last_byte_ = kNever;
  Time noise_since_ = kNever;  ///< first byte after the latest frame
  Time last_frame_ = kNever;
  Time last_cycle_ = kNever;  ///< time of the latest sample, believed or not
  Time last_good_ = kNever;   ///< arrival of the latest sample that is believed
  Time last_saturated_ = kNever;
  Time last_bad_quaternion_ = kNever;
  std::uint64_t good_ = 0;
  std::uint64_t bad_ = 0;
};

}  // namespace drover::witmotion
