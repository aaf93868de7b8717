// The folder of tracks: one file each, loaded once, then kept in step with what was acknowledged.
#include "store/track_store.h"

#include <algorithm>
#include <cerrno>

#include "store/point_texts.h"
#include "store/track_file.h"

namespace drover::store {

TrackStore::TrackStore(Files& files, std::string folder)
    : files_(files), folder_(std::move(folder)) {}

std::vector<Track> TrackStore::load(std::vector<std::string>& report) {
  std::vector<Track> tracks;
  std::vector<std::string> names;
  if (const int e = files_.list(folder_, names); e != 0) {
    report.push_back(failure_text("list", folder_, e));
    return tracks;
  }
  // The order of a folder is chance; which of two files wins must not be.
  std::sort(names.begin(), names.end());
  const auto refuse = [&](const std::string& file, const std::string& what) {
    report.push_back(path(file) + " " + what + "; " + put_aside(files_, folder_, file));
  };
  for (const std::string& file : names) {
    if (file.ends_with(kTemporaryEnding)) {
      files_.remove(path(file));
      continue;
    }
    if (!file.ends_with(kTrackEnding)) continue;
    if (entries_.size() >= kMaxTracks) {
      unread_files_.push_back(file);
      continue;
    }
    std::string content;
    if (const int e = files_.read(path(file), kMaxTrackFileBytes, content); e != 0) {
      // Only a file that can never be a track is put aside; a read error may pass.
      if (e == EFBIG || e == EINVAL || e == ELOOP) {
        refuse(file, e == EFBIG ? "is too large for a track" : "is no regular file");
      } else {
        report.push_back(failure_text("read", path(file), e));
        unread_files_.push_back(file);
      }
      continue;
    }
    auto track = decode_track(content);
    const std::size_t bytes = track.ok() ? list_bytes(*track) : 0;
    if (!track.ok()) {
      refuse(file, track.error().text);
    } else if (entries_.contains(track->name)) {
      refuse(file, "has the name of another track");
    } else if (bytes_ + bytes > kMaxListBytes) {
      unread_files_.push_back(file);
    } else {
      bytes_ += bytes;
      entries_[track->name] = {file, bytes};
      tracks.push_back(std::move(track.value()));
    }
  }
  if (!unread_files_.empty()) {
    report.push_back(std::to_string(unread_files_.size()) + " files in " + folder_ +
                     " were not read: unreadable, or more than " + std::to_string(kMaxTracks) +
                     " tracks, or tracks whose list has more than " +
                     std::to_string(kMaxListBytes) + " bytes");
  }
  return tracks;
}

bool TrackStore::taken(const std::string& file) const {
  const auto is_it = [&](const auto& entry) { return entry.second.file == file; };
  return std::any_of(entries_.begin(), entries_.end(), is_it) ||
         std::find(unread_files_.begin(), unread_files_.end(), file) != unread_files_.end();
}

std::optional<Failure> TrackStore::save(const Track& track) {
  const auto known = entries_.find(track.name);
  const std::size_t before = known == entries_.end() ? 0 : known->second.bytes;
  if (track.points.size() > kMaxPointsPerTrack) {
    return Failure{"a track has at most " + std::to_string(kMaxPointsPerTrack) + " points"};
  }
  const std::size_t used = bytes_ - before;
  const std::size_t bytes = list_bytes(track);
  if (used + bytes > kMaxListBytes) {
    return Failure{"the list of all tracks would be too long to be read: " + std::to_string(used) +
                   " bytes are used, this track has " + std::to_string(bytes) + ", the limit is " +
                   std::to_string(kMaxListBytes) + "; delete some"};
  }
  std::string file;
  if (known != entries_.end()) {
    file = known->second.file;
  } else {
    if (entries_.size() >= kMaxTracks) {
      return Failure{"there are " + std::to_string(kMaxTracks) + " tracks already"};
    }
    int attempt = 0;
    do {
      file = track_file_name(track.name, attempt++);
    } while (taken(file));
  }
  if (auto failure = write_durably(files_, folder_, file, encode_track(track))) {
    // A new track that only lacked the last sync must not appear at the next start.
    if (known == entries_.end()) files_.remove(path(file));
    return failure;
  }
  bytes_ = used + bytes;
  entries_[track.name] = {file, bytes};
  return std::nullopt;
}

/// A file that is gone already is as good as removed: an earlier try may have failed at the sync.
std::optional<Failure> TrackStore::unlink(const std::string& file) {
  const int e = files_.remove(path(file));
  if (e != 0 && e != ENOENT) return Failure{failure_text("remove", path(file), e)};
  return std::nullopt;
}

std::optional<Failure> TrackStore::remove(const std::string& name) {
  const auto known = entries_.find(name);
  if (known == entries_.end()) return Failure{"there is no track of this name"};
  if (auto failure = unlink(known->second.file)) return failure;
  if (const int e = files_.sync_folder(folder_); e != 0) {
    return Failure{failure_text("sync", folder_, e)};
  }
  bytes_ -= known->second.bytes;
  entries_.erase(known);
  return std::nullopt;
}

std::optional<Failure> TrackStore::remove_all(std::vector<std::string>& removed) {
  removed.clear();
  std::optional<Failure> failure;
  std::vector<std::string> gone;
  for (const auto& [name, entry] : entries_) {
    failure = unlink(entry.file);
    if (failure) break;
    gone.push_back(name);
  }
  if (const int e = files_.sync_folder(folder_); e != 0) {
    return failure ? failure : Failure{failure_text("sync", folder_, e)};
  }
  for (const std::string& name : gone) {
    bytes_ -= entries_[name].bytes;
    entries_.erase(name);
  }
  removed = std::move(gone);
  return failure;
}

}  // namespace drover::store
