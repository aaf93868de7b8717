#include "runtime/stop_listener.h"

#include <poll.h>

#include <algorithm>
#include <array>
#include <variant>

#include "publish/command_service.h"
#include "publish/rtk_navigation/control.h"
#include "runtime/clock.h"

namespace drover::runtime {

namespace {

constexpr Duration kTick = std::chrono::milliseconds(200);

}  // namespace

StopCounts ask(StopRequests& stops, const publish::ControlCommand& stop) {
  return std::holds_alternative<publish::TerminateRequest>(stop) ? stops.ask_stop()
                                                                 : stops.ask_cancel();
}

StopListener::StopListener(const config::MqttConfig& config, StopRequests& stops)
    : stops_(stops),
      broker_(
          config, {{std::string(publish::kTopicControl), 1}},
          [this](const MqttMessage& message) { on_message(message); },
          [this](bool connected, const std::string&) { connected_ = connected; },
          MqttClient::Presence::silent) {}

void StopListener::run(const std::atomic<bool>& stop) {
  Time next_tick = kNever;
  while (!stop.load(std::memory_order_relaxed)) {
    if (const Time now = monotonic_now(); now >= next_tick) {
      broker_.tick(now);
      next_tick = now + kTick;
    }
    const short events = static_cast<short>(broker_.wants_write() ? POLLIN | POLLOUT : POLLIN);
    std::array<pollfd, 2> polls{{{wake_.fd(), POLLIN, 0}, {broker_.fd(), events, 0}}};
    const auto wait = std::chrono::ceil<std::chrono::milliseconds>(next_tick - monotonic_now());
    ::poll(polls.data(), broker_.fd() < 0 ? 1 : 2, std::max(0, static_cast<int>(wait.count())));
    const Time now = monotonic_now();
    if ((polls[1].revents & POLLOUT) != 0) broker_.on_writable(now);
    if ((polls[1].revents & ~POLLOUT) != 0) broker_.on_readable(now);
    if (polls[0].revents != 0) wake_.clear();
    for (std::string text; answers_.pop(text);)
      if (!broker_.publish(publish::kTopicFeedback.data(), text).empty() &&
          !unsent_.push(std::move(text)))
        lost_answers_.fetch_add(1, std::memory_order_relaxed);
    turns_.fetch_add(1, std::memory_order_relaxed);
  }
}

bool StopListener::answer(const std::string& text) {
  if (!connected() || !answers_.push(std::string(text))) return false;
  wake_.notify();
  return true;
}

void StopListener::on_message(const MqttMessage& message) {
  const auto& text = message.payload;
  if (text.empty() || text.size() > publish::kShortMessageBytes || !publish::may_stop(text)) return;
  const auto request = publish::parse_control(text, message.retain);
  if (!publish::is_stop(request)) return;
  begun_.fetch_add(1, std::memory_order_release);
  const auto asked = ask(stops_, *request);
  if (!heard_.push(HeardStop{std::string(text), message.retain, asked}))
    lost_.fetch_add(1, std::memory_order_release);
  heard_ready_.notify();
}

}  // namespace drover::runtime
