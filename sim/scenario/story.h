// Which step of a mission is due: events that happened, delays, conditions on the true state.
#pragma once

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "sim/scenario/mission.h"

namespace drover::sim {

/// Pure: time and the true state are arguments. Each step is due once.
class Story {
 public:
  explicit Story(const std::vector<Step>& steps) : steps_(&steps), progress_(steps.size()) {}

  /// Tells that something happened. Returns which time it is: 1 for the first.
  std::size_t happened(const std::string& event, Time now);
  bool has_happened(const EventName& event) const;

  /// When the next step is due, or its condition must be looked at; Time::max(): nothing waits.
  Time next(Time now) const;
  /// True when a step waits for a condition only.
  bool asks_for_truth(Time now) const;
  /// Steps whose time has come, in the mission's order. `truth` is the simulator's answer, or null.
  std::vector<const Step*> take_due(Time now, const nlohmann::json& truth);
  /// Steps that were not due up to now, in words: a misspelt event never happens.
  std::vector<std::string> left() const;

 private:
  struct Progress {
    Time due = Time::max();
    bool done = false;
  };
  bool waits(std::size_t i, Time now) const;

  const std::vector<Step>* steps_;
  std::vector<Progress> progress_;
  std::map<std::string, std::size_t> counts_;
};

}  // namespace drover::sim
