// `drover calibrate drive`, but for the terminal and the socket: keys and measurements in, what is
// asked of droverd and what is on the screen out. Pure, so that a drive can be played without a
// clock.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "calibrate/recipe.h"
#include "cli/calibrate_drive.h"
#include "drover/command.h"

namespace drover::cli {

/// Why this base cannot drive the circles, or they tell nothing of it; empty: it can.
std::string not_calibrated(const engine::BaseConfig& base);

class CalibrationDrive final {
 public:
  explicit CalibrationDrive(const engine::EngineConfig& config);

  /// Each look, a hundred times a second: when the key was seen since the last one (never: it was
  /// not), and what is measured now. What to ask of droverd; nothing: nothing.
  std::optional<Twist> look(Time now, Time key, const Snapshot& seen);
  /// What droverd said to that; `text`: why not, or that it is slow yet.
  void answered(bool ok, const std::string& text);

  /// Nothing is left to be driven, or `problem` ends it.
  bool ended() const { return ended_; }
  const std::string& problem() const { return problem_; }
  const calibrate::Drive& drive() const { return taken_.drive; }
  const calibrate::Signs& signs() const { return signs_; }
  const calibrate::Recipe& recipe() const { return recipe_; }

  /// What is driven, from where to where.
  std::string intro() const;
  /// One line: the piece, how far it is, how fast, and what is to be done.
  std::string line() const;
  /// What another round is driven for; empty: none is.
  const std::vector<calibrate::Quantity>& missing() const { return missing_; }

 private:
  calibrate::Moved moved_in_gap(const Snapshot& seen, double gap_s) const;
  void follow(const Snapshot& seen);
  void judge_signs();
  void judge_all();
  void end(std::string problem);
  bool has_fix() const;
  Twist wanted(Time now) const;
  bool held(Time now) const { return key_at_ != kNever && now - key_at_ <= kKeyHeld; }

  engine::EngineConfig config_;
  calibrate::Configured configured_;
  calibrate::Recipe recipe_;
  DriveOfRecording taken_;
  calibrate::Signs signs_;
  std::vector<calibrate::Quantity> missing_;
  bool begun_ = false;
  bool ended_ = false;
  std::string problem_;
  Time now_ = kNever;
  Time key_at_ = kNever;
  Time fresh_at_ = kNever;  ///< the last key that was young enough to be sent
  Time said_at_ = kNever;
  bool let_go_ = false;   ///< the key has to be let go first
  bool slow_ = true;      ///< droverd has not seen yet that the mechanics are right
  bool refused_ = false;  ///< the last that was asked
  bool asked_to_move_ = false;
  std::string stopped_by_;  ///< what was refused last, until it moves again
  Time seen_at_ = kNever;
  Time fixed_at_ = kNever;
  Snapshot before_;  ///< the last that was seen
};

}  // namespace drover::cli
