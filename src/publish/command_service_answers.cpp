// Answers: what the engine and the disk say, and who hears of it.
#include <algorithm>
#include <utility>

#include "publish/command_service.h"

namespace drover::publish {
namespace {

bool writes_to_disk(Verb verb) {
  return verb == Verb::save_trajectory || verb == Verb::delete_trajectory ||
         verb == Verb::delete_all_trajectory;
}

}  // namespace

CommandService::Pending& CommandService::expect(RequestId id, Verb verb, std::string name) {
  Pending& pending = pending_[Key{id.source, id.number}];
  pending.id = id;
  pending.verb = verb;
  pending.name = std::move(name);
  return pending;
}

CommandService::Pending* CommandService::find(RequestId id) {
  const auto found = pending_.find(Key{id.source, id.number});
  return found == pending_.end() ? nullptr : &found->second;
}

void CommandService::send(RequestId id, Time now, decltype(Command::body) body, Actions& out) {
  out.push_back(Command{id, now, std::move(body)});
}

void CommandService::tell(RequestId id, Verb verb, bool ok, std::string_view text, Actions& out) {
  const bool last_start = id.source == last_start_id_.source && id.number == last_start_id_.number;
  if (verb == Verb::start_task && last_start) {
    if (!ok) last_start_refusal_ = text;
    // Whoever pressed twice before it was decided reads twice that it was refused.
    for (; last_start_again_ > 0; --last_start_again_) {
      if (!ok)
        out.push_back(PublishText{kTopicFeedback, feedback_text(failure_cmd(verb), text, {})});
    }
  }
  const std::string cmd = ok ? success_cmd(verb) : failure_cmd(verb);
  const std::string_view reason = ok ? std::string_view() : text;
  const std::string_view note = ok ? text : std::string_view();
  // The second answer to a start goes to the operators only: the command line had its answer.
  if (id.source == RequestId::Source::mqtt) {
    out.push_back(PublishText{kTopicFeedback, feedback_text(cmd, reason, note)});
  } else if (id.source == RequestId::Source::cli && verb != Verb::start_nav) {
    out.push_back(Answer{id, ok, std::string(text)});
  }
  // The stored origin at the start, or the first one: nobody has commanded it.
  const bool asked = id.source != RequestId::Source::internal;
  const std::string what = ok && !asked ? "the origin is in use" : cmd;
  out.push_back(LogLine{ok ? Notice::Level::info : Notice::Level::warning,
                        text.empty() ? what : what + ": " + std::string(text)});
}

void CommandService::finish(RequestId id, Verb verb, bool ok, std::string_view text, Actions& out) {
  tell(id, verb, ok, text, out);
  forget(id);
}

void CommandService::on_reply(store::StorageReply reply, Time now, Actions& out) {
  Pending* pending = find(reply.id);
  if (pending == nullptr) {
    // The old origin, written back after the engine refused the new one.
    if (!reply.ok) out.push_back(LogLine{Notice::Level::error, reply.reason});
    return;
  }
  const Verb verb = pending->verb;
  if (verb == Verb::init_rtk_data && reply.ok) {
    pending->origin_stored = true;
    return send(reply.id, now, SetOrigin{pending->origin}, out);
  }
  if (verb == Verb::save_trajectory && reply.ok && reply.track) {
    tracks_.insert_or_assign(pending->name, std::move(*reply.track));
  } else if (verb == Verb::delete_trajectory && reply.ok) {
    tracks_.erase(pending->name);
  } else if (verb == Verb::delete_all_trajectory) {
    for (const std::string& name : reply.removed) tracks_.erase(name);
  }
  finish(reply.id, verb, reply.ok, reply.reason, out);
}

void CommandService::on_event(const Event& event, Actions& out) {
  if (const auto* yes = std::get_if<CommandAccepted>(&event.body)) {
    accepted(*yes, out);
  } else if (const auto* no = std::get_if<CommandRefused>(&event.body)) {
    refused(no->id, no->reason.view(), out);
  } else if (const auto* moving = std::get_if<NavigationStarted>(&event.body)) {
    if (find(moving->id) != nullptr) tell(moving->id, Verb::start_nav, true, {}, out);
  } else if (const auto* stuck = std::get_if<NavigationNotStarted>(&event.body)) {
    ++changes_;
    if (find(stuck->id) != nullptr) {
      finish(stuck->id, Verb::start_nav, false, stuck->reason.view(), out);
    }
  } else if (const auto* ended = std::get_if<TaskEnded>(&event.body)) {
    ++changes_;
    forget(ended->id);
    // The document has no word for it: nav.status tells.
    const bool failed = ended->how == TaskEnded::How::failed;
    std::string text = failed                                    ? "task failed"
                       : ended->how == TaskEnded::How::cancelled ? "task cancelled"
                                                                 : "task done";
    if (!ended->reason.empty()) text += ": " + std::string(ended->reason.view());
    out.push_back(LogLine{failed ? Notice::Level::error : Notice::Level::info, std::move(text)});
  } else if (const auto* proposed = std::get_if<OriginProposed>(&event.body)) {
    if (Pending* pending = find(proposed->id)) {
      pending->origin = proposed->origin;
      out.push_back(store::StorageJob{proposed->id, store::SaveOrigin{proposed->origin}});
    }
  } else if (const auto* released = std::get_if<PathReleased>(&event.body)) {
    release(released->path);
  } else if (const auto* notice = std::get_if<Notice>(&event.body)) {
    out.push_back(LogLine{notice->level, std::string(notice->text.view())});
  }
}

void CommandService::accepted(const CommandAccepted& event, Actions& out) {
  Pending* pending = find(event.id);
  if (pending == nullptr) return;
  switch (pending->verb) {
    case Verb::start_task:  // waits for start_nav
      pending->answered = true;
      return tell(event.id, Verb::start_task, true, event.note.view(), out);
    case Verb::init_rtk_data:
      origin_ = pending->origin;
      origin_problem_.clear();
      return finish(event.id, Verb::init_rtk_data, true, event.note.view(), out);
    default: {
      const std::string own = std::move(pending->note);
      return finish(event.id, pending->verb, true, own.empty() ? event.note.view() : own, out);
    }
  }
}

void CommandService::refused(RequestId id, std::string_view reason, Actions& out) {
  Pending* pending = find(id);
  if (pending == nullptr) return;
  // What is on disk must be what the engine uses, or the next start would move every track.
  if (pending->origin_stored && origin_) {
    const RequestId back = next_id(RequestId::Source::internal);
    out.push_back(store::StorageJob{back, store::SaveOrigin{*origin_}});
  }
  finish(id, pending->verb, false, reason, out);
}

void CommandService::on_undelivered(const Command& command, Actions& out, std::string_view why) {
  if (const auto* start = std::get_if<StartTask>(&command.body)) release(start->path);
  // The flag of a stop is set whatever its answer: who reads this must not believe it was not told.
  const bool stop = std::holds_alternative<EngageStop>(command.body) ||
                    std::holds_alternative<CancelTask>(command.body);
  if (!why.empty()) return refused(command.id, why, out);
  refused(command.id,
          stop ? "told the control loop, which has not answered: use the e-stop if it moves"
               : "the control loop takes no command now, try again",
          out);
}

void CommandService::release(const Path* path) {
  std::erase_if(paths_, [path](const auto& owned) { return owned.get() == path; });
}

bool CommandService::being_written(const std::string& name) const {
  return std::any_of(pending_.begin(), pending_.end(), [&](const auto& entry) {
    const Pending& pending = entry.second;
    return pending.verb == Verb::delete_all_trajectory ||
           (writes_to_disk(pending.verb) && pending.name == name);
  });
}

bool CommandService::origin_pending() const {
  return std::any_of(pending_.begin(), pending_.end(),
                     [](const auto& entry) { return entry.second.verb == Verb::init_rtk_data; });
}

bool CommandService::disk_behind(std::size_t bytes) const {
  std::size_t writes = 0;
  for (const auto& [key, pending] : pending_) {
    if (!writes_to_disk(pending.verb)) continue;
    ++writes;
    bytes += pending.bytes;
  }
  return writes >= config_.max_pending_writes || bytes > config_.max_pending_bytes;
}

void CommandService::on_unsent(const PublishText& message, std::string_view why, Actions& out) {
  if (message.topic != kTopicTrajectoryData) return;
  const std::string cmd = failure_cmd(Verb::get_all_trajectory);
  out.push_back(PublishText{kTopicFeedback, feedback_text(cmd, why, {})});
  out.push_back(LogLine{Notice::Level::warning, cmd + ": " + std::string(why)});
}

}  // namespace drover::publish
