#include "ros2/scene_line.h"

#include <utility>

#include "json/json_text.h"
#include "json/members.h"

namespace drover::ros2 {
namespace {

constexpr std::size_t kShownOfAThing = 100;
constexpr std::string_view kAnswer = R"({"scene_feedback":)";

json::JsonText begun(std::string_view topic, Time said) {
  json::JsonText line;
  line.open('{').key("cmd").text("scene_message").key("topic").text(topic);
  line.key("at_ns").integer(said.time_since_epoch().count());
  return line;
}

std::string refused(std::string_view topic, std::string_view name, const SceneRefusal& refusal,
                    Time said) {
  auto line = begun(topic, said);
  line.key("name").text(json::shown(name, kShownOfAThing)).key("path").text(refusal.path);
  return line.key("refused").text(refusal.why).close('}').take();
}

std::string_view advice(std::string_view topic) {
  return topic == "collision_object" ? ": send an object in parts, with APPEND"
                                     : ": take fewer constraints, or simpler regions";
}

}  // namespace

std::string scene_line(std::string_view topic, std::string_view name,
                       const Result<std::string, SceneRefusal>& message, Time said) {
  if (!message) return refused(topic, name, message.error(), said);
  auto line = begun(topic, said).key("message").text(*message).close('}').take();
  if (line.size() <= kMostSceneLine) return line;
  return refused(
      topic, name,
      {"", "it is " + std::to_string(line.size()) + " bytes long on the way to droverd, " +
               std::to_string(kMostSceneLine) + " are taken" + std::string(advice(topic))},
      said);
}

SceneAnswerTold read_scene_answer(std::string_view line) {
  if (!line.starts_with(kAnswer)) return {};
  SceneAnswerTold told{.is_answer = true};
  const auto document = json::parse(line, {.max_depth = 4});
  if (!document) return told;
  const auto& answer = *document->root.find("scene_feedback");
  told.refused = text_member(answer, "result") == "refused";
  const std::string path = text_member(answer, "path");
  std::string what =
      told.refused ? (path.empty() ? "" : path + ": ") + text_member(answer, "reason") : "";
  if (const auto* notes = answer.find("notes"); notes != nullptr && notes->list() != nullptr)
    for (const auto& note : *notes->list())
      if (note.text() != nullptr) what += (what.empty() ? "" : "; ") + *note.text();
  if (what.empty()) return told;
  const std::string name =
      text_member(answer, "id") + text_member(answer, "name");  // it has one of them
  told.words = "/" + text_member(answer, "topic") + (name.empty() ? "" : " '" + name + "'") +
               (told.refused ? " refused: " : ": ") + what;
  return told;
}

bool SceneLines::push(std::string line) {
  if (lines_.size() >= kMost || bytes_ + line.size() > kMostBytes) return false;
  bytes_ += line.size();
  lines_.push_back(std::move(line));
  return true;
}

std::string SceneLines::pop() {
  std::string line = std::move(lines_.front());
  lines_.pop_front();
  bytes_ -= line.size();
  return line;
}

}  // namespace drover::ros2
