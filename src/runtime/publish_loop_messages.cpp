// What comes from the broker, and what goes to the control thread because of it.
#include <thread>

#include "runtime/clock.h"
#include "runtime/log.h"
#include "runtime/publish_loop.h"

namespace drover::runtime {

namespace {
constexpr std::string_view kOvertaken =
    "a stop came just now, and may be younger than this; try again";
constexpr Duration kLongestWait =
    std::chrono::milliseconds(250);  // less than half of what the thread may
constexpr Duration kNoWait = std::chrono::seconds(1);

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
                           now.time_since_epoch() + wall_minus_monotonic(),
                           broker_->just_connected(joint_commands_.just_came(), now)};
  if (message.topic == publish::kTopicControl) {
    on_control(message.payload, arrival, now);
    return;
  }
  if (arrival.late.empty() && stop_order_.overtaken(now)) arrival.late = kOvertaken;
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
      if (const auto first = stop_order_.heard_before(payload, now))
        return ask_again(*request, *first);
    if (!parser_.busy() || publish::is_stop(request))
      return service_.on_parsed(payload, std::move(request), arrival, now, actions_);
  }
  await_other_self();
  ParseJob job{std::string(payload), arrival, control_.stops.asked()};
  if (job.arrival.late.empty() && stop_order_.overtaken(now)) job.arrival.late = kOvertaken;
  if (!parser_.give(std::move(job))) service_.on_unparsed(payload, now, actions_);
}

/// It was carried out and answered. Only what was begun since then, by the command line say, may
/// have been sent before it.
void PublishLoop::ask_again(const publish::ControlCommand& request, Time first) {
  if (last_delivered_ == kNever || last_delivered_ < first) return;
  (void)ask(control_.stops, request);
}

/// A stop that came just before a start must not end it when it is heard the second time. Who waits
/// in vain does not wait again soon: the second connection is behind.
void PublishLoop::await_other_self() {
  const Time begin = monotonic_now();
  if (stops_ == nullptr || begin < next_wait_) return;
  for (Time now = begin; now - begin < kLongestWait; now = monotonic_now()) {
    if (!stop_order_.expects_other_self(now)) return;
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  next_wait_ = begin + kNoWait;
}

void PublishLoop::take_heard_stops(Time now) {
  stop_order_.hear(now);
  while (const auto next = stop_order_.next_heard()) {
    const HeardStop& heard = *next;
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
  if (stop_order_.became_deaf(broker_ && broker_->connected(), now))
    log(LogLevel::warning,
        "the broker takes no second connection: beside a flood a stop may come late or not at all");
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
    if (is_from_broker(command) && begins_motion(command) && stop_order_.overtaken(now))
      return service_.on_undelivered(command, actions, kOvertaken);
    last_delivered_ = now;
    if (scene_ && std::holds_alternative<StartTask>(command.body))
      return check_start(command, before, now, actions);
    return push(command, before, actions);
  }
  const auto counts = asked_   ? *asked_
                      : cancel ? control_.stops.ask_cancel()
                               : control_.stops.ask_stop();
  if (const auto unanswered = stop_order_.asked(counts, command))
    service_.on_undelivered(*unanswered, actions);
}

void PublishLoop::push(const Command& command, const StopCounts& before,
                       publish::Actions& actions) {
  const auto* start = std::get_if<StartTask>(&command.body);
  if (start != nullptr || std::holds_alternative<FindHeading>(command.body))
    last_start_ = monotonic_now();
  if (control_.recorder != nullptr && start != nullptr && start->path != nullptr)
    control_.recorder->path(*start->path);
  if (control_.commands.push(QueuedCommand{command, before})) return;
  service_.on_undelivered(command, actions);
  for (const auto& each : outlets_) each.outlet->on_undelivered(command, actions);
}

void PublishLoop::answer_stops(const StopCounts& obeyed, Time now) {
  while (const auto id = stop_order_.next_obeyed(obeyed))
    service_.on_event({now, CommandAccepted{*id, {}}}, actions_);
}

}  // namespace drover::runtime
