#include "sim/scenario/story.h"

#include <algorithm>

namespace drover::sim {
namespace {

// How often a condition is looked at.
constexpr Duration kConditionLook = std::chrono::milliseconds(20);

bool holds(const Condition& condition, const nlohmann::json& truth) {
  if (!truth.is_object() || !truth.contains(condition.value)) return false;
  const double value = truth.at(condition.value).get<double>();
  return condition.above ? value > condition.bound : value < condition.bound;
}

}  // namespace

std::size_t Story::happened(const std::string& event, Time now) {
  const std::size_t count = ++counts_[event];
  for (std::size_t i = 0; i < steps_->size(); ++i) {
    const auto& step = (*steps_)[i];
    if (step.after.name == event && step.after.count == count) progress_[i].due = now + step.delay;
  }
  return count;
}

bool Story::has_happened(const EventName& event) const {
  const auto count = counts_.find(event.name);
  return count != counts_.end() && count->second >= event.count;
}

bool Story::waits(std::size_t i, Time now) const {
  return !progress_[i].done && progress_[i].due <= now && (*steps_)[i].when.has_value();
}

Time Story::next(Time now) const {
  Time next = Time::max();
  for (std::size_t i = 0; i < progress_.size(); ++i) {
    if (progress_[i].done) continue;
    next = std::min(next, waits(i, now) ? now + kConditionLook : progress_[i].due);
  }
  return next;
}

bool Story::asks_for_truth(Time now) const {
  for (std::size_t i = 0; i < progress_.size(); ++i)
    if (waits(i, now)) return true;
  return false;
}

std::vector<const Step*> Story::take_due(Time now, const nlohmann::json& truth) {
  std::vector<const Step*> due;
  for (std::size_t i = 0; i < progress_.size(); ++i) {
    const auto& step = (*steps_)[i];
    if (progress_[i].done || progress_[i].due > now) continue;
    if (step.when && !holds(*step.when, truth)) continue;
    progress_[i].done = true;
    due.push_back(&step);
  }
  return due;
}

std::vector<std::string> Story::left() const {
  std::vector<std::string> left;
  for (std::size_t i = 0; i < progress_.size(); ++i) {
    const auto& name = (*steps_)[i].name;
    const auto& after = (*steps_)[i].after;
    if (progress_[i].done) continue;
    const std::string which =
        "step " + (name.empty() ? std::to_string(i + 1) : "\"" + name + "\"") + " never came: ";
    left.push_back(which + (has_happened(after) ? "its time or its condition was not there"
                                                : "\"" + after.name + "\" did not happen"));
  }
  return left;
}

}  // namespace drover::sim
