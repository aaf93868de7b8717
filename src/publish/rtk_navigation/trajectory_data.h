// The `trajectory_data` topic: all tracks in one message.
#pragma once

#include <span>
#include <string>

#include "json/json_text.h"
#include "store/track.h"

namespace drover::publish {

/// RTK navigation protocol, "轨迹反馈 trajectory_data": a list, `[]` when there is no track.
/// Numbers are written as they came (NaN, from an impossible latitude, as 0); so is the order.
class TrajectoryList final {
 public:
  /// Of about so many bytes: then nothing is copied while it grows.
  explicit TrajectoryList(std::size_t bytes);
  void add(const store::Track& track);
  /// The whole list; this is empty then.
  std::string take();

 private:
  json::JsonText out_;
};

std::string trajectory_data_text(std::span<const store::Track> tracks);

}  // namespace drover::publish
