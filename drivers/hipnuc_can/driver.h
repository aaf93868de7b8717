// An inertial sensor that tells accelerations and rates in frames of their own: a sample is both.
#pragma once

#include "drivers/hipnuc_can/codec.h"
#include "drover/angle.h"
#include "drover/driver.h"

namespace drover::hipnuc_can {

struct Settings {
  Address address;
  Quaternion mount;  ///< of the sensor in base_link
  /// What it measures, as its data sheet says.
  double acceleration_range_mps2 = 16 * kGravity_mps2;
  double rate_range_radps = to_rad(2000);
  /// Both halves of a sample leave the sensor back to back: what is further apart is of two
  /// samples.
  Duration pair_window = std::chrono::milliseconds(4);
  Duration stale = std::chrono::milliseconds(100);
};

class HipnucCanDriver final : public Device, public FrameFace {
 public:
  explicit HipnucCanDriver(const Settings& settings);

  void on_link_up(Time now) override;
  void on_tick(Time, DriverOut&) override {}
  SourceHealth health(Time now) const override;

  void on_frame(const CanFrame& frame, Time received, DriverOut& out) override;
  std::span<const FrameFilter> listens() const override { return listens_; }

 private:
  /// The last of one of the two, until it went into a sample.
  struct Half {
    Triple triple;
    Time received = kNever;
    bool waits = false;
  };

  void take(Half& half, const std::optional<Triple>& triple, Time received, DriverOut& out);
  void report_pair(Time received, DriverOut& out);

  Settings settings_;
  FixedVector<FrameFilter, 5> listens_;
  Half acceleration_;
  Half rates_;
  Quaternion orientation_;
  Time last_orientation_ = kNever;
  double temperature_degC_ = kAbsent;
  Time last_sample_ = kNever;  ///< good or not
  Time last_good_ = kNever;
  Time last_saturated_ = kNever;
  std::uint64_t good_ = 0;
  std::uint64_t bad_ = 0;
};

}  // namespace drover::hipnuc_can
