// The zones on disk, as texts of whoever draws them. What cannot be read is a fence nobody knows.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "store/named_texts.h"

namespace drover::store {

/// A zone of kMaxPointsPerZone points fits, and 100 000 points in all.
inline constexpr NamedTextsFile kZonesFile{"zones.texts", "drover-zones", 100,
                                           std::size_t{8} << 20};

/// Belongs to the storage thread: each call may block as long as the disk does.
class ZoneStore final {
 public:
  /// `files` is borrowed for the lifetime of this object; `folder` exists.
  ZoneStore(Files& files, std::string folder);

  /// Reads all and removes leftovers of interrupted saves. A file that is damaged stays where it
  /// is, so that every start finds it, until a person says forget_unreadable; so does the memory of
  /// one that was deleted.
  void load();
  /// Empty: `zones` are all there are. Else the fence is not known, for operators: nothing may
  /// start, and nothing is stored over what may come back.
  const std::string& problem() const { return problem_; }
  /// In the order of import; empty while there is a problem.
  const std::vector<NamedText>& zones() const { return zones_; }

  /// Stores or replaces; returns nothing when it is durable. Otherwise zones() is as it was; when
  /// the last sync failed the next start may find either.
  std::optional<Failure> save(const std::string& name, std::string text, double wall_s);
  /// Returns nothing when it is durably gone; fails when there is none of that name.
  std::optional<Failure> remove(const std::string& name);
  /// A person gives up what cannot be read: it is kept aside as `<file>.bad` (what was deleted is
  /// gone), and there is no zone.
  /// Refused where the file only belongs to another user: the fence is as good as ever.
  std::optional<Failure> forget_unreadable();

 private:
  std::optional<Failure> replace(std::vector<NamedText> zones);

  Files& files_;
  std::string folder_;
  std::vector<NamedText> zones_;
  bool is_foreign_ = false;
  bool is_deleted_ = false;
  std::string problem_ = "the stored zones have not been read yet";
};

}  // namespace drover::store
