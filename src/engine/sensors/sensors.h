// The robot's receivers, inertial sensors and batteries: which one it goes by, and what all of them
// said last.
#pragma once

#include <array>
#include <span>

#include "drover/snapshot.h"
#include "engine/environment.h"
#include "engine/estimate/estimator.h"
#include "engine/sensors/choice.h"

namespace drover::engine {

/// What has changed in a cycle.
struct HandOver {
  bool receiver = false;
  bool imu = false;
};

class Sensors final {
 public:
  explicit Sensors(const EngineConfig& config);

  /// Remembers it. False: the robot does not go by who said it.
  bool take(const Measurement& measurement, const Estimator& estimator);
  /// After it.
  void take_words(const Measurement& measurement, std::string_view words);
  /// Before the estimate's step. `stands`: nobody drives and no wheel turns.
  HandOver update(Time now, const Environment& environment, const Estimator& estimator,
                  bool stands);

  std::size_t receiver() const { return receivers_.in_use(); }
  std::size_t imu() const { return imus_.in_use(); }
  bool imu_trusted(std::size_t which) const { return imu_trusted_[which]; }
  /// The rules go by it: it steers, or it is a spare and none that steers is heard.
  bool battery_counts(std::size_t which) const { return battery_counts_[which]; }
  /// Of those that count and are heard the emptiest.
  std::size_t battery_shown() const { return battery_shown_; }
  /// Of each battery, by number.
  std::span<const BatterySnapshot> batteries() const { return batteries_; }
  /// Told only: a spare steers, or there is none that could; empty: all is as configured.
  const Reason& caution() const { return caution_; }
  /// The name of who is in use where there are several, else `plain`.
  Name receiver_name(const char* plain) const;
  Name imu_name(const char* plain) const;

  std::uint64_t samples(SensorKind kind, std::size_t which) const {
    return samples_[static_cast<std::size_t>(kind)][which];
  }
  void fill(Snapshot& snapshot, const Environment& environment) const;
  /// The last position of the receiver in use; kNever: none.
  const GnssPosition& position() const { return positions_[receiver()]; }
  Time position_at() const { return position_at_[receiver()]; }

 private:
  void look_at_batteries(const Environment& environment);
  void compare_imus(Time now, const Estimator& estimator);
  Reason look_at(const SensorList& all, const Choice& choice, const SensorConditions& conditions,
                 const char* what) const;

  EngineConfig config_;
  Choice receivers_;
  Choice imus_;
  std::array<GnssPosition, kMaxOfKind> positions_;
  std::array<Time, kMaxOfKind> position_at_;
  std::array<Time, kMaxOfKind> placed_at_;  ///< with a place
  std::array<Time, kMaxOfKind> imu_at_;
  std::array<BatterySnapshot, kMaxOfKind> batteries_;
  std::array<std::array<std::uint64_t, kMaxOfKind>, 3> samples_{};  ///< by SensorKind
  std::array<Agreement, kMaxOfKind> places_agree_;
  std::array<Agreement, kMaxOfKind> turns_agree_;
  std::array<bool, kMaxOfKind> imu_trusted_{};
  std::array<bool, kMaxOfKind> battery_counts_{true};
  std::size_t battery_shown_ = 0;
  Time begun_ = kNever;
  Reason caution_;
};

}  // namespace drover::engine
