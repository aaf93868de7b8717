// What comes from the broker, and what goes to the control thread because of it.
#include <thread>

#include "runtime/clock.h"
#include "runtime/log.h"
#include "runtime/publish_loop.h"

namespace drover::runtime {

namespace {
constexpr std::size_t kMostAskedStops = 256;
constexpr std::string_view kOvertaken =
    "a stop came just now, and may be younger than this; try again";
constexpr Duration kLongestWait =
    std::chrono::milliseconds(250);  // less than half of what the thread may
constexpr Duration kNoWait = std::chrono::seconds(1);
constexpr Duration kDeafFor = std::chrono::seconds(5);

bool is_from_broker(const Command& command) {
  return command.id.source == RequestId::Source::mqtt ||
         command.id.source == RequestId::Source::aimrt;
}
bool begins_motion(const Command& command) {
  return std::holds_alternative<StartTask>(command.body) ||
         std::holds_alternative<JointTargets>(command.body) ||
         std::holds_alternative<FindHeading>(command.body);
}
}  // namespace

void PublishLoop::on_message(const MqttMessage& message) {
  // What came before it is delivered first: a start must be judged while the stop behind it still
  // counts as one that overtook it, and a stop be asked for before what comes next.
  carry_out(actions_);
  const Time now = monotonic_now();
  publish::Arrival arrival{message.retain, broker_->late(now),
                           now.time_since_epoch() + wall_minus_monotonic()};
  if (message.topic == publish::kTopicControl) {
    on_control(message.payload, arrival, now);
    return;
  }
  if (arrival.late.empty() && overtaken(now)) arrival.late = kOvertaken;
  for (const auto& each : outlets_)
    if (each.outlet->on_message(message.topic, message.payload, arrival, now, actions_)) return;
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
    if (publish::is_stop(request))
      if (const auto first = heard_twice_.again(Way::with_others, payload, now))
        return ask_again(*request, *first);
    if (!parser_.busy() || publish::is_stop(request))
      return service_.on_parsed(payload, std::move(request), arrival, now, actions_);
  }
  await_other_self();
  ParseJob job{std::string(payload), arrival, control_.stops.asked()};
  if (job.arrival.late.empty() && overtaken(now)) job.arrival.late = kOvertaken;
  if (!parser_.give(std::move(job))) service_.on_unparsed(payload, now, actions_);
}

/// It was carried out and answered. Only what was begun since then, by the command line say, may
/// have been sent before it.
void PublishLoop::ask_again(const publish::ControlCommand& request, Time first) {
  if (last_delivered_ == kNever || last_delivered_ < first) return;
  (void)ask(control_.stops, request);
}

/// Takes over what the second connection heard, so that overtaken() knows of it.
void PublishLoop::hear_stops(Time now) {
  if (stops_ == nullptr) return;
  HeardStop heard;
  while (stops_->take(heard))
    if (!heard_twice_.again(Way::alone, heard.payload, now))
      heard_stops_.push_back(std::move(heard));
  if (const auto lost = stops_->lost(); lost != lost_stops_) {
    lost_stops_ = lost;
    heard_twice_.lost(now);
  }
}

/// Whether what comes on the first connection may have been sent before a stop that was heard on
/// the second.
bool PublishLoop::overtaken(Time now) {
  hear_stops(now);
  return (stops_ != nullptr && stops_->knows_more()) || heard_twice_.overtook(now);
}

/// A stop that came just before a start must not end it when it is heard the second time. Who waits
/// in vain does not wait again soon: the second connection is behind.
void PublishLoop::await_other_self() {
  const Time begin = monotonic_now();
  if (stops_ == nullptr || begin < next_wait_) return;
  for (Time now = begin; stops_->connected(); now = monotonic_now()) {
    hear_stops(now);
    if (!heard_twice_.expects(now)) return;
    if (now - begin >= kLongestWait) break;
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  next_wait_ = begin + kNoWait;
}

void PublishLoop::take_heard_stops(Time now) {
  hear_stops(now);
  while (!heard_stops_.empty()) {
    const HeardStop heard = std::move(heard_stops_.front());
    heard_stops_.pop_front();
    asked_ = heard.asked;
    service_.on_parsed(heard.payload,
                       publish::parse_control(heard.payload, heard.retain, service_.limits()),
                       {heard.retain}, now, actions_);
    carry_out(actions_);
    asked_.reset();
  }
  answer_stops(told_stops_, now);  // those that were obeyed before they came to here
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
    carry_out(actions_);  // what came before it
    before_ = reply.job.before;
    service_.on_parsed(reply.job.payload, std::move(*reply.request), reply.job.arrival, now,
                       actions_);
    carry_out(actions_);
    before_.reset();
  }
}

/// Stops go around the ring, which a flood may have filled.
void PublishLoop::deliver(const Command& command, publish::Actions& actions) {
  const bool cancel = std::holds_alternative<CancelTask>(command.body);
  if (!cancel && !std::holds_alternative<EngageStop>(command.body)) {
    if (is_from_broker(command) && begins_motion(command)) await_other_self();
    // The stops of both connections: those that are not known to be older than this command end it.
    const auto before = before_.value_or(control_.stops.asked());
    const Time now = monotonic_now();
    if (is_from_broker(command) && begins_motion(command) && overtaken(now))
      return service_.on_undelivered(command, actions, kOvertaken);
    last_delivered_ = now;
    const auto* start = std::get_if<StartTask>(&command.body);
    if (control_.recorder != nullptr && start != nullptr && start->path != nullptr)
      control_.recorder->path(*start->path);
    const bool taken = control_.commands.push(QueuedCommand{command, before});
    if (!taken) service_.on_undelivered(command, actions);
    return;
  }
  const auto counts = asked_   ? *asked_
                      : cancel ? control_.stops.ask_cancel()
                               : control_.stops.ask_stop();
  asked_stops_.emplace_back(counts, command);
  if (asked_stops_.size() <= kMostAskedStops) return;
  // The control thread hangs: the flag stays set for it, the answer does not wait.
  service_.on_undelivered(asked_stops_.front().second, actions);
  asked_stops_.pop_front();
}

void PublishLoop::answer_stops(const StopCounts& obeyed, Time now) {
  while (!asked_stops_.empty() && obeyed.include(asked_stops_.front().first)) {
    service_.on_event({now, CommandAccepted{asked_stops_.front().second.id, {}}}, actions_);
    asked_stops_.pop_front();
  }
}

}  // namespace drover::runtime
