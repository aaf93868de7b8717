// The planning scene's lines on their way to droverd, and what the journal is told of them.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>

#include "drover/time.h"
#include "publish/token_bucket.h"
#include "ros2/scene_line.h"

namespace drover::ros2 {

class SceneRelay final {
 public:
  /// Kept while droverd is away, too: it says how old a message may be.
  void give(std::string line);
  bool waits() const { return !lines_.empty(); }
  /// The next one, when there is room for it on the way, and droverd has told that it listens.
  void send(const std::function<bool(const std::string&)>& send);
  /// True: it was an answer to one of them. The journal has what was refused or taken otherwise
  /// than it was written: ten at once and one a second.
  bool answered(std::string_view line, Time now);
  /// The way is lost: what was not answered yet is, too.
  void way_lost();
  /// Once a second, with how many were not even looked at so far.
  void beat(std::uint64_t passed_over);
  /// Neither followed nor refused by droverd.
  std::uint64_t lost() const { return lost_; }

 private:
  SceneLines lines_;
  std::uint64_t under_way_ = 0;  ///< sent, and not answered
  publish::TokenBucket journal_{1, 10};
  std::uint64_t lost_ = 0;
  std::uint64_t lost_said_ = 0;
  std::uint64_t passed_over_ = 0;
};

}  // namespace drover::ros2
