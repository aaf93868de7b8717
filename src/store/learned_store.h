// What drives taught the robot of itself, on disk: it outlives the program and the boot.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "drover/learned.h"
#include "store/durable_file.h"
#include "store/files.h"

namespace drover::store {

struct KeptLearned {
  LearnedValues values;
  std::uint64_t subject = 0;  ///< fingerprint of what of the configuration they are beside
  double wall_s = 0;          ///< since the epoch, when they were that
};

class LearnedStore final {
 public:
  /// `files` is borrowed for the lifetime of this object; `folder` exists.
  LearnedStore(Files& files, std::string folder);

  /// Nothing when none was stored: the robot learns it again. A file that cannot be used is put
  /// aside and reported.
  std::optional<KeptLearned> load(std::vector<std::string>& report) const;
  /// Returns nothing when it is durable.
  std::optional<Failure> save(const KeptLearned& kept);

 private:
  Files& files_;
  std::string folder_;
};

}  // namespace drover::store
