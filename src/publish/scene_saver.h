// What of the scene is on the disk, and what has to go there: one save at a time, of the newest.
//
// While one runs changes gather, and the next one takes them all; when there were many, one a
// second: who moves twenty objects ten times a second does not wear out a card of flash.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "drover/time.h"
#include "publish/scene_jobs.h"
#include "publish/token_bucket.h"
#include "store/storage.h"

namespace drover::publish {

class SceneSaver final {
 public:
  /// How long after a save that failed it is tried again, when nothing changes meanwhile.
  static constexpr Duration kRetry = std::chrono::seconds(5);

  static constexpr double kMostSaves_Hz = 1;
  static constexpr double kSaveBurst = 10;

  /// `stored`: what was found at start.
  explicit SceneSaver(const store::StoredScene& stored);

  /// Returns the number of the save that will have them.
  std::uint64_t note(std::span<const SceneChange> changes, double arrived_s);
  /// Everything is gone but what cannot be read. Returns as above.
  std::uint64_t note_cleared();
  /// The save to be given to the disk now; nothing: one runs, nothing has changed, or there were
  /// many just now.
  std::optional<store::SaveScene> next(Time now);
  /// The one that ran is over: its number. `failure` empty: it is durable.
  std::uint64_t on_saved(const std::string& failure, Time now);
  /// Why the scene is not on the disk as it is; empty: it is, or will be in a moment.
  const std::string& failure() const { return failure_; }
  /// Wall time at which it came; nothing: it is not known.
  std::optional<double> arrived_s(std::string_view kind, std::string_view name) const;

  /// What of `stored` cannot be read. It stays on the disk, until something else has its name or a
  /// person gives it up.
  void set_lost(std::span<const SceneRestored::Lost> lost);
  store::AcceptLoss give_up_lost();
  /// Whether that is durable; else it is as before.
  void on_given_up(bool stored);

 private:
  using Key = std::pair<std::string, std::string>;  ///< kind, name
  std::vector<store::SceneText> all_texts() const;

  std::map<Key, store::SceneText> texts_;
  std::map<Key, store::SceneText> lost_;      ///< beside those
  std::map<Key, store::SceneText> given_up_;  ///< of the lost ones, perhaps
  std::uint64_t last_ = 0;                    ///< number of the save that was given last
  bool changed_ = false;                      ///< since then
  bool running_ = false;
  std::string failure_;
  Time retry_ = kNever;
  TokenBucket pace_{kMostSaves_Hz, kSaveBurst};
};

}  // namespace drover::publish
