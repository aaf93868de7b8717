#include "ros2/scene_relay.h"

#include <utility>

#include "ros2/say.h"

namespace drover::ros2 {

void SceneRelay::give(std::string line) {
  if (!lines_.push(std::move(line))) ++lost_;
}

/// What has not left is not said again: a part of it may have, and the way is made anew.
void SceneRelay::send(const std::function<bool(const std::string&)>& send) {
  if (!lines_.empty()) ++(send(lines_.pop()) ? under_way_ : lost_);
}

void SceneRelay::way_lost() {
  lost_ += std::exchange(under_way_, 0);
}

bool SceneRelay::answered(std::string_view line, Time now) {
  const auto told = read_scene_answer(line);
  if (told.is_answer && under_way_ > 0) --under_way_;
  if (!told.words.empty() && journal_.take(now))
    say(told.refused ? Level::warning : Level::info, told.words);
  return told.is_answer;
}

void SceneRelay::beat(std::uint64_t passed_over) {
  lost_ += passed_over - std::exchange(passed_over_, passed_over);
  if (lost_ == lost_said_) return;
  say(Level::warning, std::to_string(lost_ - lost_said_) +
                          " messages of the planning scene were lost: too many came, or droverd "
                          "does not read");
  lost_said_ = lost_;
}

}  // namespace drover::ros2
