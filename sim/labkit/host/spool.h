// Copies one descriptor to another through memory, so that a slow reader never holds up the lab.
#pragma once

#include <poll.h>

#include <string>

#include "fd.h"

namespace drover::lab {

class Spool final {
 public:
  /// Does not own `to`. `limit_bytes` 0 means as much as it takes (virtual time must not wait).
  Spool(Fd from, int to, std::size_t limit_bytes)
      : from_(std::move(from)), to_(to), limit_bytes_(limit_bytes) {}

  bool reading() const {
    return from_.open() && (limit_bytes_ == 0 || pending_.size() < limit_bytes_);
  }
  bool writing() const { return !pending_.empty() && !broken_; }
  int from() const { return from_.get(); }
  int to() const { return to_; }
  /// The reader of our output went away.
  bool broken() const { return broken_; }

  void read_some();
  void write_some();
  /// Reads what is left without waiting, then writes everything, waiting for the reader.
  void finish();

 private:
  Fd from_;
  int to_;
  std::size_t limit_bytes_;
  std::string pending_;
  bool broken_ = false;
};

}  // namespace drover::lab
