// What outlets and the command service want done, in their order.
#include "runtime/clock.h"
#include "runtime/log.h"
#include "runtime/publish_loop.h"

namespace drover::runtime {

namespace {

LogLevel log_level(Notice::Level level) {
  switch (level) {
    case Notice::Level::info: return LogLevel::info;
    case Notice::Level::warning: return LogLevel::warning;
    case Notice::Level::error: return LogLevel::error;
  }
  return LogLevel::error;
}

}  // namespace

void PublishLoop::send(const publish::PublishText& message, publish::Actions& actions) {
  if (!broker_) return;
  if (message.topic == publish::kTopicFeedback && stops_->answer(message.text)) return;
  send_with_others(message, actions);
}

void PublishLoop::send_with_others(const publish::PublishText& message, publish::Actions& actions) {
  const auto problem = broker_->publish(std::string(message.topic).c_str(), message.text);
  if (!problem.empty()) {
    if (message.topic == publish::kTopicFeedback) ++lost_answers_;
    service_.on_unsent(message, problem, actions);
  }
  service_.set_under_way(broker_->bytes_under_way());
}

/// What the second connection could not send after all.
void PublishLoop::send_unsent() {
  if (stops_ == nullptr || !broker_) return;
  for (std::string text; stops_->take_unsent(text);)
    send_with_others({publish::kTopicFeedback, text}, actions_);
}

void PublishLoop::carry_out(publish::Actions& actions) {
  // An undelivered command appends its refusal: walk by index.
  for (std::size_t i = 0; i < actions.size(); ++i) {
    auto action = std::move(actions[i]);
    if (const auto* message = std::get_if<publish::PublishText>(&action)) {
      send(*message, actions);
    } else if (const auto* answer = std::get_if<publish::Answer>(&action)) {
      for (const auto& each : outlets_)
        if (each.outlet->on_answer(*answer, actions)) break;
    } else if (const auto* reply = std::get_if<publish::Reply>(&action)) {
      cli_.reply(reply->client, reply->line);
    } else if (const auto* line = std::get_if<publish::LogLine>(&action)) {
      log(log_level(line->level), line->text);
    } else if (auto* job = std::get_if<store::StorageJob>(&action)) {
      if (storage_.jobs.push(std::move(*job))) {
        storage_.jobs_ready.notify();
      } else {
        stored({job->id,
                false,
                "the disk is too slow: too many writes wait",
                {},
                {},
                store::stored_for(*job)},
               monotonic_now(), actions);
      }
    } else if (const auto* command = std::get_if<Command>(&action)) {
      deliver(*command, actions);
    } else if (auto* of_scene = std::get_if<publish::SceneJob>(&action)) {
      give(std::move(*of_scene), actions);
    } else if (auto* text = std::get_if<publish::SceneTextJob>(&action)) {
      give(std::move(*text), actions);
    }
  }
  actions.clear();
}

}  // namespace drover::runtime
