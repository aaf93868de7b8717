// AimRT's state messages: each comes as often as it should, for as long as there is what it tells.
#include <algorithm>
#include <cmath>

#include "mission/conduct.h"

namespace drover::mission {
namespace {

using namespace std::chrono_literals;

constexpr double kShare = 0.01;  // of a rate
constexpr Duration kBegin = 2s;
constexpr Duration kEnd = 200ms;
constexpr Duration kLongEnough = 5s;  // to say something about a rate

using Messages = std::vector<const MqttLine*>;

Messages messages(const Record& record, const std::string& type, const Interval& interval) {
  Messages found;
  for (const auto& line : record.mqtt)
    if (line.time >= interval.begin && line.time <= interval.end && line.topic.ends_with(type))
      found.push_back(&line);
  return found;
}

void judge_rate(const std::string& type, double rate_Hz, double wanted_Hz, Time begin,
                Problems& problems) {
  if (!(std::abs(rate_Hz - wanted_Hz) <= kShare * wanted_Hz))
    add(problems, type + " at " + std::to_string(rate_Hz) + " Hz from " + seconds(begin));
}

/// What was ready to leave when droverd was stopped leaves when it goes on.
void pass_over_what_waited(const Record& record, Time begin, Messages& list) {
  constexpr Duration kAtOnce = 100us;
  const auto woken = record.all("signal 18 to droverd");
  if (std::find(woken.begin(), woken.end(), begin) == woken.end()) return;
  if (!list.empty() && list.front()->time - begin < kAtOnce) list.erase(list.begin());
}

/// Between two messages no inertial sensor was heard, and the status says so.
bool told_missing(const Record& record, Time begin, Time end) {
  return std::any_of(record.statuses.begin(), record.statuses.end(), [&](const Status& status) {
    return status.time > begin && status.time <= end + 100ms &&
           !status.document.at("sensor").at("imu").get<bool>();
  });
}

/// Each stretch of messages without a gap has the rate; no gap but those that `permitted` knows.
template <typename Permitted>
void judge_steady(const std::string& type, const Messages& list, const Permitted& permitted,
                  Problems& problems) {
  constexpr double kRate_Hz = 50;
  constexpr Duration kGap = 60ms;
  for (std::size_t first = 0, i = 1; i <= list.size(); ++i) {
    const bool gap = i < list.size() && list[i]->time - list[i - 1]->time > kGap;
    if (gap && !permitted(list[i - 1]->time, list[i]->time))
      add(problems,
          type + ": nothing from " + seconds(list[i - 1]->time) + " to " + seconds(list[i]->time));
    if (i < list.size() && !gap) continue;
    const Duration lasted = list[i - 1]->time - list[first]->time;
    if (lasted >= kLongEnough)
      judge_rate(type, static_cast<double>(i - 1 - first) / to_s(lasted), kRate_Hz,
                 list[first]->time, problems);
    first = i;
  }
}

/// A change of a contact is told at once and begins the period anew.
void judge_touch(const std::string& type, const Messages& list, Problems& problems) {
  constexpr double kRate_Hz = 10;
  // The last 15 bytes are the three contacts.
  const auto contacts = [](const MqttLine& line) {
    return line.payload.substr(line.payload.size() -
                               std::min<std::size_t>(30, line.payload.size()));
  };
  Duration whole{};
  std::size_t count = 0;
  for (std::size_t i = 1; i < list.size(); ++i) {
    const Duration period = list[i]->time - list[i - 1]->time;
    if (contacts(*list[i]) != contacts(*list[i - 1])) continue;
    whole += period;
    ++count;
    if (period > 150ms || period < 50ms)
      add(problems, seconds(list[i]->time) + ": " + type + " after " + seconds(period));
  }
  if (whole >= kLongEnough)
    judge_rate(type, static_cast<double>(count) / to_s(whole), kRate_Hz, list[0]->time, problems);
}

}  // namespace

Problems check_aimrt_rates(const Record& record) {
  Problems problems;
  for (const auto& interval : alive(record)) {
    if (interval.end == Time::max() || interval.end - interval.begin < kLongEnough) continue;
    for (const std::string type : {".JointState", ".ImuState", ".TouchState"}) {
      auto list = messages(record, type, interval);
      pass_over_what_waited(record, interval.begin, list);
      if (type == ".TouchState" && !record.bumper) {
        if (!list.empty()) add(problems, type + " of a robot that has no contact");
        continue;
      }
      if (list.empty() || list.front()->time - interval.begin > kBegin ||
          interval.end - list.back()->time > kEnd) {
        add(problems, type + " does not last from " + seconds(interval.begin) + " to " +
                          seconds(interval.end));
      }
      const auto never = [](Time, Time) { return false; };
      const auto missing = [&](Time a, Time b) { return told_missing(record, a, b); };
      if (type == ".JointState") judge_steady(type, list, never, problems);
      if (type == ".ImuState") judge_steady(type, list, missing, problems);
      if (type == ".TouchState") judge_touch(type, list, problems);
    }
  }
  return problems;
}

}  // namespace drover::mission
