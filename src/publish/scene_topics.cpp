#include "publish/scene_topics.h"

#include <algorithm>
#include <utility>

#include "scene/message/check.h"

namespace drover::publish {
namespace {

/// Anything longer is parsed where nobody waits for it.
constexpr std::size_t kShortPayloadBytes = 4096;
/// What each message of a list but the first takes of the rate.
constexpr double kListShare = 0.1;

std::string_view our_topic(std::string_view topic) {
  for (const std::string_view ours : {kTopicCollisionObject, kTopicPlanningConstraints})
    if (topic == ours) return ours;
  return {};
}

}  // namespace

SceneTopics::Gate SceneTopics::gate_with(const SceneTopicLimits& limits) {
  return {{limits.max_messages_Hz, limits.message_burst},
          {limits.max_refusals_Hz, limits.refusal_burst},
          {},
          0};
}

SceneTopics::SceneTopics(bool configured, JobNumbers& numbers, SceneSaver& saver,
                         const SceneTopicLimits& limits)
    : configured_(configured),
      numbers_(numbers),
      saver_(saver),
      limits_(limits),
      gates_{gate_with(limits), gate_with(limits)} {}

bool SceneTopics::on_message(std::string_view name, std::string_view payload,
                             const Arrival& arrival, Time now, Actions& out,
                             const SceneSender& sender) {
  const auto topic = our_topic(name);
  if (topic.empty()) return false;
  if (payload.empty()) return true;  // how a retained message is taken back: nobody asks
  if (const auto why = untimely(now, sender); !why.empty()) {
    refuse_flood(topic, why, now, out, sender);
    return true;
  }
  Waiting& waiting = expect(topic, arrival, now, sender);
  const bool is_unread = arrival.retain != Retain::no || payload.size() > SceneLimits{}.max_bytes;
  const bool is_short = payload.size() <= kShortPayloadBytes && parsing_ == 0;
  if (!is_unread && !is_short) {
    ++parsing_;
    append_job<SceneTextJob>(out, waiting.number, ParseMessages{topic}).payload = payload;
    return true;
  }
  if (topic == kTopicCollisionObject) {
    follow(waiting, parse_collision_objects(payload, arrival.retain), now, out);
  } else {
    follow(waiting, parse_planning_constraints(payload, arrival.retain), now, out);
  }
  answer(out);
  return true;
}

bool SceneTopics::on_refused(std::string_view name, std::string_view id, scene::Refusal refusal,
                             Time now, Actions& out, const SceneSender& sender) {
  const auto topic = our_topic(name);
  if (topic.empty()) return false;
  if (const auto why = untimely(now, sender); !why.empty()) {
    refuse_flood(topic, why, now, out, sender);
    return true;
  }
  Waiting& waiting = expect(topic, {}, now, sender);
  refuse(waiting, std::move(refusal.path), std::move(refusal.why));
  waiting.answers.front().name = id;
  answer(out);
  return true;
}

/// Empty: it may be looked at.
std::string SceneTopics::untimely(Time now, const SceneSender& sender) {
  if (!configured_) return std::string(kNoScene);
  Gate& gate = gate_of(sender);
  if (!gate.messages.take(now))
    return std::string("slow down") + (sender.client == 0 ? ", or send them as a list: " : ": ") +
           gate.messages.in_words("messages");
  if (gate.waiting >= limits_.max_waiting)
    return "slow down: " + std::to_string(limits_.max_waiting) + " messages wait already";
  return {};
}

SceneTopics::Waiting& SceneTopics::expect(std::string_view topic, const Arrival& arrival, Time now,
                                          const SceneSender& sender) {
  Waiting& waiting = waiting_.emplace_back();
  ++gate_of(sender).waiting;
  waiting.number = numbers_.next();
  waiting.client = sender.client;
  waiting.topic = topic;
  waiting.arrived = {sender.said == kNever ? now : sender.said,
                     arrival.wall - now.time_since_epoch(), std::string(arrival.late)};
  return waiting;
}

SceneTopics::Waiting* SceneTopics::find(std::uint64_t number) {
  const auto found =
      std::find_if(waiting_.begin(), waiting_.end(),
                   [number](const Waiting& waiting) { return waiting.number == number; });
  return found == waiting_.end() ? nullptr : &*found;
}

/// Those of its messages that are good go to the scene, in their order.
template <class Message>
void SceneTopics::follow(Waiting& waiting, Result<SceneMessages<Message>, scene::Refusal> read,
                         Time now, Actions& out) {
  if (!read.ok()) {
    waiting.answers = {answer_to(waiting.topic, read.error())};
    waiting.complete = true;
    return;
  }
  auto& messages = read.value().messages;
  waiting.is_list = read->is_list;
  if (messages.size() > 1)
    gate_of({waiting.client})
        .messages.charge(kListShare * static_cast<double>(messages.size() - 1), now);
  ApplyMessages job{{}, waiting.arrived};
  for (auto& message : messages) {
    waiting.answers.push_back(answer_to(message));
    if (!message.result.ok()) continue;
    waiting.followed.push_back(waiting.answers.size() - 1);
    job.messages.emplace_back(std::move(message.result.value().message));
  }
  waiting.complete = waiting.followed.empty();
  if (!waiting.complete) append_job<SceneJob>(out, waiting.number, std::move(job));
}

void SceneTopics::on_parsed(SceneTextReply& reply, Time now, Actions& out) {
  --parsing_;
  Waiting* waiting = find(reply.job.number);
  if (waiting == nullptr) return;
  if (auto* objects = std::get_if<ParsedObjects>(&*reply.result))
    follow(*waiting, std::move(*objects), now, out);
  if (auto* constraints = std::get_if<ParsedConstraints>(&*reply.result))
    follow(*waiting, std::move(*constraints), now, out);
  answer(out);
}

void SceneTopics::on_unparsed(std::uint64_t number, Actions& out) {
  --parsing_;
  if (Waiting* waiting = find(number)) refuse(*waiting, "", std::string(kTooMuchUnread));
  answer(out);
}

void SceneTopics::on_applied(std::uint64_t number, const MessagesApplied& applied, Time now,
                             Actions& out) {
  std::uint64_t save = 0;
  Waiting* waiting = find(number);
  const double arrived_s =
      waiting == nullptr
          ? 0
          : to_s(waiting->arrived.at.time_since_epoch() + waiting->arrived.wall_ahead);
  if (!applied.changes.empty()) save = saver_.note(applied.changes, arrived_s);
  if (waiting == nullptr) return;
  for (std::size_t i = 0; i < waiting->followed.size() && i < applied.results.size(); ++i) {
    SceneAnswer& answer = waiting->answers[waiting->followed[i]];
    answer.refusal = applied.results[i].refusal;
    for (const std::string& note : applied.results[i].notes) scene::check::note(answer.notes, note);
  }
  waiting->save = save;
  waiting->applied = now;
  waiting->complete = save == 0;
  answer(out);
}

void SceneTopics::on_unapplied(std::uint64_t number, Actions& out) {
  if (Waiting* waiting = find(number))
    for (const std::size_t i : std::exchange(waiting->followed, {})) {
      waiting->answers[i].refusal =
          scene::Refusal{"", "the scene is behind with earlier messages, slow down"};
      waiting->complete = true;
    }
  answer(out);
}

void SceneTopics::on_saved(std::uint64_t save, std::string_view failure, Actions& out) {
  for (Waiting& waiting : waiting_) {
    if (waiting.complete || waiting.save == 0 || waiting.save > save) continue;
    if (!failure.empty()) note_unstored(waiting, failure);
    waiting.complete = true;
  }
  answer(out);
}

void SceneTopics::on_time(Time now, Actions& out) {
  for (Waiting& waiting : waiting_) {
    if (waiting.complete || waiting.save == 0) continue;
    if (now - waiting.applied <= limits_.longest_store) continue;
    note_unstored(waiting, "the disk has not taken it yet");
    waiting.complete = true;
  }
  answer(out);
}

void SceneTopics::refuse(Waiting& waiting, std::string path, std::string why) {
  waiting.answers = {answer_to(waiting.topic, {std::move(path), std::move(why)})};
  waiting.complete = true;
}

void SceneTopics::note_unstored(Waiting& waiting, std::string_view why) {
  for (const std::size_t i : waiting.followed)
    if (SceneAnswer& answer = waiting.answers[i]; !answer.refusal)
      answer.notes.push_back("counts, but would be lost at a boot: " + std::string(why));
}

/// In its place among the others, so that who counts answers is not led astray.
void SceneTopics::refuse_flood(std::string_view topic, std::string_view why, Time now, Actions& out,
                               const SceneSender& sender) {
  Gate& gate = gate_of(sender);
  if (!gate.refusals.take(now)) {
    ++gate.counts.unanswered;
    return;
  }
  Waiting& waiting = expect(topic, {}, now, sender);
  refuse(waiting, "", std::string(why));
  answer(out);
}

/// One by one, as ROS 2 says them.
void SceneTopics::answer_ros2(const Waiting& waiting, Actions& out) {
  SceneCounts& counts = gate_of({waiting.client}).counts;
  for (const SceneAnswer& answer : waiting.answers) {
    ++(answer.refusal ? counts.refused : counts.done);
    if (answer.refusal) counts.refusal = refusal_in_words(answer);
    out.emplace_back(
        Reply{waiting.client, R"({"scene_feedback":)" + scene_feedback_text(answer) + "}"});
  }
}

void SceneTopics::answer(Actions& out) {
  for (; !waiting_.empty() && waiting_.front().complete; waiting_.pop_front()) {
    const Waiting& first = waiting_.front();
    --gate_of({first.client}).waiting;
    if (first.client != 0) {
      answer_ros2(first, out);
      continue;
    }
    if (!first.is_list && first.answers.empty()) continue;
    out.emplace_back(PublishText{kTopicSceneFeedback,
                                 first.is_list ? scene_feedback_text(first.answers)
                                               : scene_feedback_text(first.answers.front())});
  }
}

}  // namespace drover::publish
