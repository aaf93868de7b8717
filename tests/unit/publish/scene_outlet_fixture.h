// A scene's outlet with a scene's thread, a parser and a disk that a test plays.
#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <deque>
#include <string>
#include <utility>
#include <vector>

#include "publish/scene_outlet.h"

namespace drover::publish {

class SceneOutletTest : public testing::Test {
 protected:
  static constexpr Time kStart{std::chrono::seconds(1000)};
  static constexpr Duration kWall = std::chrono::hours(400'000);

  void make(bool configured, std::vector<store::NamedText> stored = {}) {
    const store::StoredScene before{.texts = std::move(stored)};
    outlet_ = std::make_unique<SceneOutlet>(configured, before, [this](Time) { return robot_; });
  }
  /// What the scene's thread tells at its start.
  void restore(SceneRestored restored = {}) {
    if (!restored.zones) restored.zones = std::make_shared<const std::vector<scene::Zone>>();
    outlet_->on_reply({0, std::move(restored)}, now_, actions_);
    sort_out();
  }

  void hear(std::string_view payload, std::string_view topic = kTopicCollisionObject,
            Retain retain = Retain::no, std::string_view late = {}) {
    const Arrival arrival{retain, late, kWall + now_.time_since_epoch()};
    EXPECT_TRUE(outlet_->on_message(topic, payload, arrival, now_, actions_));
    sort_out();
  }
  void ask(std::string_view line) {
    EXPECT_TRUE(outlet_->on_line(7, line, now_, actions_)) << line;
    sort_out();
  }
  /// What another outlet does; its actions are sorted out with the scene's.
  template <class Do>
  void act(Do what) {
    what(actions_);
    sort_out();
  }
  void pass(Duration time) {
    now_ += time;
    (void)outlet_->on_snapshot({}, {now_, kWall}, actions_);
    sort_out();
  }

  /// The scene follows all that waits: an object whose id begins with "no" is refused.
  void follow() {
    while (!jobs_.empty()) {
      const SceneJob job = std::move(jobs_.front());
      jobs_.pop_front();
      const auto* apply = std::get_if<ApplyMessages>(&job.what);
      apply != nullptr ? reply(job.number, followed(*apply)) : reply(job.number, SceneDone{});
    }
  }
  static MessagesApplied followed(const ApplyMessages& apply) {
    MessagesApplied applied;
    for (const auto& value : apply.messages) {
      if (const auto* set = std::get_if<scene::Constraints>(&value)) {
        applied.results.emplace_back();
        applied.changes.push_back(
            {store::kConstraintKind, set->name,
             std::make_shared<const SceneContent>(scene::StoredSet{*set, {}})});
        continue;
      }
      const auto& object = std::get<scene::CollisionObject>(value);
      if (object.id.starts_with("no")) {
        applied.results.push_back({scene::Refusal{"id", "is not liked"}, {}});
        continue;
      }
      applied.results.push_back({std::nullopt, {"it was followed"}});
      const bool kept = object.operation != scene::CollisionObject::REMOVE;
      applied.changes.push_back(
          {store::kObjectKind, object.id,
           kept ? std::make_shared<const SceneContent>(scene::StoredObject{{object}, {}})
                : nullptr});
    }
    return applied;
  }
  void reply(std::uint64_t number, decltype(SceneReply::what) what) {
    outlet_->on_reply({number, std::move(what)}, now_, actions_);
    sort_out();
  }
  /// The disk does all that waits; with a reason nothing of it succeeds.
  void store(const std::string& failure = "") {
    for (auto jobs = std::exchange(disk_, {}); const auto& job : jobs) {
      outlet_->on_stored({job.id, failure.empty(), failure, {}, {}, store::stored_for(job)}, now_,
                         actions_);
      sort_out();
    }
  }
  /// The parser reads all that waits.
  void parse() {
    for (auto jobs = std::exchange(texts_, {}); auto& job : jobs) {
      SceneTextReply reply{std::move(job), {}};
      do_scene_text_job(reply);
      outlet_->on_text(std::move(reply), now_, actions_);
      sort_out();
    }
  }
  std::vector<std::string> answers() { return std::exchange(answers_, {}); }
  std::vector<std::string> replies() { return std::exchange(replies_, {}); }

  std::unique_ptr<SceneOutlet> outlet_;
  RobotNow robot_{{}, {}, 1.7e9};
  Time now_ = kStart;
  std::deque<SceneJob> jobs_;
  std::vector<SceneTextJob> texts_;
  std::vector<store::StorageJob> disk_;
  std::vector<std::string> log_;

 private:
  void sort_out() {
    for (auto& action : std::exchange(actions_, {})) {
      if (auto* text = std::get_if<PublishText>(&action)) {
        EXPECT_EQ(text->topic, kTopicSceneFeedback);
        answers_.push_back(std::move(text->text));
      } else if (auto* line = std::get_if<Reply>(&action)) {
        EXPECT_EQ(line->client, 7U);
        replies_.push_back(std::move(line->line));
      } else if (auto* job = std::get_if<SceneJob>(&action)) {
        jobs_.push_back(std::move(*job));
      } else if (auto* read = std::get_if<SceneTextJob>(&action)) {
        texts_.push_back(std::move(*read));
      } else if (auto* write = std::get_if<store::StorageJob>(&action)) {
        disk_.push_back(std::move(*write));
      } else if (auto* said = std::get_if<LogLine>(&action)) {
        log_.push_back(std::move(said->text));
      }
    }
  }

  Actions actions_;
  std::vector<std::string> answers_;
  std::vector<std::string> replies_;
};

}  // namespace drover::publish
