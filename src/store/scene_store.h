// The scene's objects and constraints on disk, as texts of whoever understands them.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "store/named_texts.h"
#include "store/spare_texts.h"

namespace drover::store {

inline constexpr NamedTextsFile kSceneFile{"scene.texts", "drover-scene", 2000,
                                           std::size_t{16} << 20};
/// In the run folder, which may be the same one.
inline constexpr NamedTextsFile kUnsavedSceneFile{"scene.unsaved", kSceneFile.format,
                                                  kSceneFile.max_texts, kSceneFile.max_bytes};
/// The kinds that a scene's texts have. Only objects grow old.
inline constexpr std::string_view kObjectKind = "object";
inline constexpr std::string_view kConstraintKind = "constraint";

/// Belongs to the storage thread: each call may block as long as the disk does.
class SceneStore final {
 public:
  /// `files` is borrowed for the lifetime of this object; `folder` exists. `run_folder` holds what
  /// the disk did not take, until the next boot; empty: that is lost with the program.
  SceneStore(Files& files, std::string folder, std::string run_folder = {});

  /// What was stored, without the objects that arrived more than `max_age_s` before `wall_s`: only
  /// here they grow old, never while the program runs. What arrived later than `wall_s` is kept:
  /// the clock is wrong. A file that cannot be used is put aside, but stays where it only belongs
  /// to another user, and one that was deleted is a loss, too; `report` gets a sentence of that and
  /// of what was left out.
  std::vector<NamedText> load(double wall_s, std::optional<double> max_age_s,
                              std::vector<std::string>& report);
  /// Why something that was stored is not known any more, for operators; empty: nothing is. It
  /// outlives restarts and saves.
  const std::string& problem() const { return problem_; }
  /// What was loaded is not on the disk yet: it did not take it.
  bool is_unsaved() const { return is_unsaved_; }

  /// Replaces all. Returns nothing when it is durable; else it outlives the program all the same,
  /// in the run folder. Each has one of the two kinds. Both are refused while the file belongs to
  /// another user: what is in it is as good as ever.
  std::optional<Failure> save(const std::vector<NamedText>& texts);
  /// A person knows that something is lost. The scene is `texts` now.
  std::optional<Failure> accept_loss(const std::vector<NamedText>& texts);

 private:
  Files& files_;
  std::string folder_;
  SpareTexts spare_;
  bool is_unsaved_ = false;
  bool is_foreign_ = false;
  std::string problem_;
};

}  // namespace drover::store
