// Messages of the planning scene on their way to droverd: a line each, and what droverd answers.
#pragma once

#include <cstdint>
#include <deque>
#include <string>
#include <string_view>

#include "drover/result.h"
#include "drover/time.h"
#include "ros2/read_scene.h"

namespace drover::ros2 {

/// droverd takes 64 KiB, a piece of what comes behind it among them.
inline constexpr std::size_t kMostSceneLine = 60'000;

/// `topic` and `name` say what it is; `said`: when, by the clock of this computer.
std::string scene_line(std::string_view topic, std::string_view name,
                       const Result<std::string, SceneRefusal>& message, Time said);

/// droverd's answer for the journal; empty: all is well, or it is no such line.
struct SceneAnswerTold {
  bool is_answer = false;
  bool refused = false;
  std::string words{};
};
SceneAnswerTold read_scene_answer(std::string_view line);

/// Lines until there is room for them on the way to droverd, in their order.
class SceneLines final {
 public:
  static constexpr std::size_t kMost = 200;
  static constexpr std::size_t kMostBytes = std::size_t{4} << 20;

  /// False: too many wait already, it is lost.
  bool push(std::string line);
  bool empty() const { return lines_.empty(); }
  std::string pop();

 private:
  std::deque<std::string> lines_;
  std::size_t bytes_ = 0;
};

}  // namespace drover::ros2
