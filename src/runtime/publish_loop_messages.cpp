// What comes from the broker, and what goes to the control thread because of it.
#include "runtime/clock.h"
#include "runtime/log.h"
#include "runtime/publish_loop.h"

namespace drover::runtime {

namespace {
constexpr std::size_t kMostAskedStops = 256;
constexpr std::string_view kOvertaken =
    "a stop came just now, and may be younger than this; try again";
constexpr Duration kDeafFor = std::chrono::seconds(5);
}  // namespace

void PublishLoop::on_message(const MqttMessage& message) {
  const Time now = monotonic_now();
  auto late = broker_->late(now);
  if (late.empty() && heard_twice_.overtook(now)) late = kOvertaken;
  const publish::Arrival arrival{message.retain, late,
                                 now.time_since_epoch() + wall_minus_monotonic()};
  if (message.topic == publish::kTopicControl) {
    on_control(message.payload, arrival, now);
    return;
  }
  const auto names = aimrt_ ? aimrt_->command_names(message.topic) : std::nullopt;
  if (names) {
    aimrt_->on_command(*names, message.payload, arrival, now, arrival.wall - now.time_since_epoch(),
                       actions_);
  }
}

/// Stops are carried out at once, everything else in the order in which it came.
void PublishLoop::on_control(std::string_view payload, const publish::Arrival& arrival, Time now) {
  if (!service_.admit(payload, now, actions_)) return;
  const auto& limits = service_.limits();
  if (payload.size() > limits.max_bytes) {  // refused for its size, without a copy
    return service_.on_parsed(payload, publish::parse_control(payload, arrival.retain, limits),
                              arrival, now, actions_);
  }
  const bool is_short = payload.size() <= publish::kShortMessageBytes;
  if (is_short && (!parser_.busy() || publish::may_stop(payload))) {
    auto request = publish::parse_control(payload, arrival.retain, limits);
    if (publish::is_stop(request) && heard_twice_.again(Way::with_others, payload, now))
      return ask_again(*request);
    if (!parser_.busy() || publish::is_stop(request))
      return service_.on_parsed(payload, std::move(request), arrival, now, actions_);
  }
  if (!parser_.give({std::string(payload), arrival})) service_.on_unparsed(payload, now, actions_);
}

/// It was answered; that it was carried out then is the more likely, twice is on the safe side.
void PublishLoop::ask_again(const publish::ControlCommand& request) {
  if (std::holds_alternative<publish::TerminateRequest>(request)) {
    (void)control_.stops.ask_stop();
  } else {
    (void)control_.stops.ask_cancel();
  }
}

void PublishLoop::take_heard_stops(Time now) {
  HeardStop heard;
  while (stops_->take(heard)) {
    if (heard_twice_.again(Way::alone, heard.payload, now)) continue;
    service_.on_parsed(heard.payload,
                       publish::parse_control(heard.payload, heard.retain, service_.limits()),
                       {heard.retain}, now, actions_);
    carry_out(actions_);
  }
}

/// A broker may refuse the second connection and nobody would miss it.
void PublishLoop::tell_whether_stops_are_heard(Time now) {
  if (stops_ == nullptr) return;
  if (stops_->connected() || !broker_->connected() || stops_heard_ == kNever) stops_heard_ = now;
  const bool deaf = now - stops_heard_ > kDeafFor;
  if (deaf && !deaf_told_)
    log(LogLevel::warning,
        "the broker takes no second connection: beside a flood a stop may come late or not at all");
  deaf_told_ = deaf;
}

void PublishLoop::take_parsed(Time now) {
  ParseReply reply;
  while (parser_.take(reply)) {
    service_.on_parsed(reply.job.payload, std::move(*reply.request), reply.job.arrival, now,
                       actions_);
    carry_out(actions_);
  }
}

/// Stops go around the ring, which a flood may have filled.
void PublishLoop::deliver(const Command& command, publish::Actions& actions) {
  const bool cancel = std::holds_alternative<CancelTask>(command.body);
  if (!cancel && !std::holds_alternative<EngageStop>(command.body)) {
    const auto* start = std::get_if<StartTask>(&command.body);
    if (control_.recorder != nullptr && start != nullptr && start->path != nullptr)
      control_.recorder->path(*start->path);
    const bool taken = control_.commands.push(QueuedCommand{command, control_.stops.asked()});
    if (!taken) service_.on_undelivered(command, actions);
    return;
  }
  const auto counts = cancel ? control_.stops.ask_cancel() : control_.stops.ask_stop();
  asked_stops_.emplace_back(counts, command);
  if (asked_stops_.size() <= kMostAskedStops) return;
  // The control thread hangs: the flag stays set for it, the answer does not wait.
  service_.on_undelivered(asked_stops_.front().second, actions);
  asked_stops_.pop_front();
}

void PublishLoop::answer_stops(Time now) {
  const auto obeyed = control_.stops.obeyed();
  while (!asked_stops_.empty() && obeyed.include(asked_stops_.front().first)) {
    service_.on_event({now, CommandAccepted{asked_stops_.front().second.id, {}}}, actions_);
    asked_stops_.pop_front();
  }
}

}  // namespace drover::runtime
