#include "ros2/asked_for.h"

#include <algorithm>
#include <utility>

#include "json/json_text.h"

namespace drover::ros2 {
namespace {

using namespace std::chrono_literals;

constexpr Duration kStopsApart = 100ms;
constexpr Duration kTwistsApart = 10ms;
constexpr Duration kRefusalsApart = 100ms;

bool too_soon(Time last, Duration apart, Time now) {
  return last != kNever && now - last < apart;
}

json::JsonText cmd_vel_line() {
  json::JsonText line;
  line.open('{').key("cmd").text("cmd_vel");
  return line;
}

}  // namespace

void AskedFor::hear(const TwistsHeard& heard) {
  if (!heard.refused.empty()) {
    twist_.reset();
    refused_ = heard.refused;
    rivals_ = rivals_ || heard.rivals;
  }
  moved_ = moved_ || heard.moved;
  if (heard.twist) twist_ = Waiting{*heard.twist, heard.said};
}

void AskedFor::answered() {
  if (unanswered_ > 0) --unanswered_;
}

void AskedFor::stop_refused() {
  answered();
  stop_waits_ = true;
  ++stops_refused_;
}

bool AskedFor::way_lost() {
  if (std::exchange(unanswered_, 0) == 0) return false;
  stop_waits_ = true;
  return true;
}

void AskedFor::forget_twists() {
  twist_.reset();
  refused_.clear();
  moved_ = rivals_ = false;
}

bool AskedFor::stop_is_due(Time now) const {
  return stop_waits_ && !too_soon(stop_tried_, kStopsApart, now);
}

std::optional<Time> AskedFor::due() const {
  std::optional<Time> first;
  const auto is_due = [&first](Time last, Duration apart) {
    const Time next = last == kNever ? kNever : last + apart;
    first = first ? std::min(*first, next) : next;
  };
  if (stop_waits_) is_due(stop_tried_, kStopsApart);
  if (!refused_.empty()) is_due(refused_told_, kRefusalsApart);
  if (twist_) is_due(handed_on_, kTwistsApart);
  return first;
}

std::string AskedFor::stop_line() const {
  json::JsonText line;
  line.open('{').key("cmd").text("stop");
  if (!name_.empty()) line.key("from").text(name_).key("number").integer(stop_number_);
  return line.close('}').take();
}

void AskedFor::tell(Time now, const std::function<bool(const std::string&)>& send) {
  if (stop_is_due(now)) {
    stop_tried_ = now;
    stop_waits_ = !send(stop_line());
    if (!stop_waits_) ++unanswered_;
  }
  if (!refused_.empty() && !too_soon(refused_told_, kRefusalsApart, now)) {
    refused_told_ = now;
    auto line = cmd_vel_line();
    line.key("refused").text(refused_).key("ends").boolean(rivals_).close('}');
    refused_.clear();
    rivals_ = false;
    (void)send(line.take());  // one of many: they are counted
  }
  if (twist_ && !too_soon(handed_on_, kTwistsApart, now)) {
    handed_on_ = now;
    auto line = cmd_vel_line();
    line.key("vx_mps").number(twist_->twist.vx_mps).key("wz_radps").number(twist_->twist.wz_radps);
    if (twist_->twist.vy_mps != 0) line.key("vy_mps").number(twist_->twist.vy_mps);
    if (moved_ && is_zero(twist_->twist)) line.key("after_motion").boolean(true);
    line.key("at_ns").integer(twist_->said.time_since_epoch().count()).close('}');
    twist_.reset();
    moved_ = false;
    (void)send(line.take());  // the next one says it again
  }
}

}  // namespace drover::ros2
