// The latched stop on disk: it survives a boot of the computer.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "drover/remembered.h"
#include "store/durable_file.h"
#include "store/files.h"

namespace drover::store {

/// What is latched when nobody can tell whether something was.
inline constexpr std::string_view kUnreadableStop = "the stored stop cannot be read: drover reset";

/// Then only who stands at the robot resets it: it may have been such a stop.
Remembered unreadable_stop();

/// That part of `all` that outlives a boot: the stop and what kind it is, the power cut, what joint
/// commands wait for.
Remembered lasting(const Remembered& all);

class StopStore final {
 public:
  /// `files` is borrowed for the lifetime of this object; `folder` exists.
  StopStore(Files& files, std::string folder);

  /// Nothing is latched when none was ever stored. A file that cannot be read, or that was deleted,
  /// is reported and counts as a stop; the one stays where it is until the next save.
  Remembered load(std::vector<std::string>& report) const;
  /// Keeps room for a save on a disk that others fill. Tried again with every save.
  void keep_room();
  /// Returns nothing when it is durable.
  std::optional<Failure> save(const Remembered& remembered);

 private:
  std::optional<Failure> write(const Remembered& remembered);

  Files& files_;
  std::string folder_;
  bool has_room_ = false;
};

}  // namespace drover::store
