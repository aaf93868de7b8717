// What drives taught the robot of itself: kept on the disk while it drives and rests, and shown to
// the command line.
#pragma once

#include <optional>
#include <string>

#include "publish/outlet.h"
#include "store/learned_store.h"

namespace drover::publish {

/// What the learned values are beside.
struct LearnedBeside {
  std::uint64_t subject = 0;  ///< fingerprint of the configuration's part that they are beside
  std::uint8_t imu = 0;       ///< the one that steers
  std::uint8_t receiver = 0;  ///< likewise; its antennas:
  double antenna_x_m = 0;
  double antenna_y_m = 0;
  double heading_baseline_offset_deg = 0;
  double wheel_radius_m = kAbsent;  ///< absent: a base without wheels of ours
  double yaw_slip_factor = 1;
};

class LearnedOutlet final : public Outlet {
 public:
  /// `stored`: what is on the disk and was recalled; nothing when nothing was.
  LearnedOutlet(const LearnedBeside& beside, std::optional<store::KeptLearned> stored);

  Duration period() const override { return std::chrono::seconds(1); }
  bool needs_broker() const override { return false; }
  std::vector<OutMessage> on_snapshot(const Snapshot& seen, const Moment& moment,
                                      Actions& out) override;
  bool on_line(ClientId client, std::string_view line, Time now, Actions& out) override;
  /// Of a StorageJob for what was learned.
  void on_stored(const store::StorageReply& reply, Actions& out);

 private:
  /// What to keep: of where antennas are what is known now, since what was known and is not any
  /// more was refuted; of the others, too, what was known before (wheels slip, a speed that has
  /// been even for long), but for what a person had forgotten. Of another receiver or sensor
  /// nothing.
  LearnedValues wanted(const LearnedValues& now);
  std::string shown() const;

  LearnedBeside beside_;
  LearnedValues latest_;          ///< of the last snapshot
  store::KeptLearned given_;      ///< to the disk, or found on it
  std::optional<double> kept_s_;  ///< since the epoch: the disk has it since then
  std::string problem_;           ///< why it is not on the disk; empty: it is, or there is nothing
  bool under_way_ = false;        ///< to the disk
  bool forgetting_ = false;       ///< a person's word is not on the disk yet
  std::uint32_t forgotten_ = 0;
  Time given_at_ = kNever;
  std::uint64_t last_number_ = 0;
};

}  // namespace drover::publish
