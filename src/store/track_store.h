// The folder of tracks: one file each, loaded once, then kept in step with what was acknowledged.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "store/durable_file.h"
#include "store/files.h"
#include "store/track.h"

namespace drover::store {

/// Belongs to the storage thread: each call may block as long as the disk does.
class TrackStore final {
 public:
  /// `files` is borrowed for the lifetime of this object; `folder` exists.
  TrackStore(Files& files, std::string folder);

  /// Reads all tracks. What cannot be used is renamed to `<file>.bad` and reported, a sentence
  /// each; leftovers of interrupted saves are removed; what exceeds the limits stays and is
  /// reported.
  std::vector<Track> load(std::vector<std::string>& report);

  /// Stores or replaces; returns nothing when it is durable. Refused when the list of all tracks
  /// would have more than kMaxListBytes.
  std::optional<Failure> save(const Track& track);
  /// Returns nothing when the track is durably gone; fails when there is none of that name.
  std::optional<Failure> remove(const std::string& name);
  /// As remove, for all; `removed` gets the names that are durably gone, also after a failure.
  std::optional<Failure> remove_all(std::vector<std::string>& removed);

 private:
  static constexpr std::size_t kEmptyListBytes = 2;
  struct Entry {
    std::string file;
    std::size_t bytes = 0;  ///< of the list
  };
  bool taken(const std::string& file) const;
  std::optional<Failure> unlink(const std::string& file);
  std::string path(const std::string& file) const { return folder_ + "/" + file; }

  Files& files_;
  std::string folder_;
  std::map<std::string, Entry> entries_;   ///< by track name
  std::vector<std::string> unread_files_;  ///< present but beyond the limits
  std::size_t bytes_ = kEmptyListBytes;    ///< of the list of all tracks
};

}  // namespace drover::store
