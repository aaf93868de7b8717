#include "publish/scene_saver.h"

#include "publish/scene/stored_text.h"

namespace drover::publish {
namespace {

std::shared_ptr<store::LazyText> lazy_text(std::shared_ptr<const SceneContent> content) {
  return std::make_shared<store::LazyText>([content = std::move(content)] {
    return std::visit([](const auto& stored) { return stored_text(stored); }, *content);
  });
}

}  // namespace

SceneSaver::SceneSaver(const store::StoredScene& stored) : changed_(stored.is_unsaved) {
  for (const store::NamedText& text : stored.texts)
    texts_[{text.kind, text.name}] = {text.kind, text.name, text.arrived_s,
                                      std::make_shared<store::LazyText>(text.text)};
}

std::uint64_t SceneSaver::note(std::span<const SceneChange> changes, double arrived_s) {
  for (const SceneChange& change : changes) {
    Key key{std::string(change.kind), change.name};
    lost_.erase(key);
    given_up_.erase(key);
    if (change.content == nullptr) {
      texts_.erase(key);
    } else {
      texts_.insert_or_assign(
          key, store::SceneText{key.first, key.second, arrived_s, lazy_text(change.content)});
    }
  }
  changed_ = true;
  return last_ + 1;
}

std::uint64_t SceneSaver::note_cleared() {
  texts_.clear();
  changed_ = true;
  return last_ + 1;
}

std::optional<store::SaveScene> SceneSaver::next(Time now) {
  const bool again = !failure_.empty() && now >= retry_;
  if (running_ || !(changed_ || again) || !pace_.take(now)) return std::nullopt;
  running_ = true;
  changed_ = false;
  ++last_;
  return store::SaveScene{all_texts()};
}

std::uint64_t SceneSaver::on_saved(const std::string& failure, Time now) {
  running_ = false;
  failure_ = failure;
  retry_ = now + kRetry;
  return last_;
}

std::optional<double> SceneSaver::arrived_s(std::string_view kind, std::string_view name) const {
  const auto found = texts_.find({std::string(kind), std::string(name)});
  if (found == texts_.end()) return std::nullopt;
  return found->second.arrived_s;
}

void SceneSaver::set_lost(std::span<const SceneRestored::Lost> lost) {
  for (const auto& [kind, name] : lost)
    if (auto text = texts_.extract({kind, name})) lost_.insert(std::move(text));
}

store::AcceptLoss SceneSaver::give_up_lost() {
  given_up_.merge(lost_);
  return {all_texts()};
}

void SceneSaver::on_given_up(bool stored) {
  if (!stored && !given_up_.empty()) {
    lost_.merge(given_up_);
    changed_ = true;  // a save that was made meanwhile is without them
  }
  given_up_.clear();
}

std::vector<store::SceneText> SceneSaver::all_texts() const {
  std::vector<store::SceneText> all;
  all.reserve(texts_.size() + lost_.size());
  for (const auto* each : {&texts_, &lost_})
    for (const auto& [key, text] : *each) all.push_back(text);
  return all;
}

}  // namespace drover::publish
