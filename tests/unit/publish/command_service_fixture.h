// A command service with a disk and an engine that a test plays, and what it told the operators.
#pragma once

#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <vector>

#include "json/located_json.h"
#include "publish/command_service.h"
#include "tests/unit/publish/examples.h"

namespace drover::publish {

inline constexpr GeodeticPoint kOrigin{23.0, 113.0, 10.0};

/// Eastwards, a metre north of the origin, latitude and longitude as they must be there.
inline store::Track straight(const std::string& name) {
  store::Track track{name, {}, kOrigin};
  for (int i = 0; i < 5; ++i)
    track.points.push_back({113 + 0.5 * i / 102'510, 23 + 1.0 / 110'750, 90, 0.5 * i, 1, 0, 0});
  return track;
}

class CommandServiceTest : public testing::Test {
 protected:
  CommandServiceTest() { make({}, {{straight("13"), straight("other")}, kOrigin, {}}); }

  void make(const CommandServiceConfig& config, store::StoredState stored) {
    service_ = std::make_unique<CommandService>(config, std::move(stored));
    service_->begin(now_, actions_);
    answer_all_commands();
    actions_.clear();
  }
  /// As an engine that agrees with everything.
  void answer_all_commands() {
    for (const Command& command : all<Command>()) event(CommandAccepted{command.id, {}});
  }
  void control(const std::string& payload, const Arrival& arrival = {}) {
    service_->on_control(payload, arrival, now_, actions_);
  }
  void start(const std::string& name = "13", const std::string& id = "2") {
    control("{\"cmd_type\":\"task_control\",\"cmd\":\"start_task\",\"name\":\"" + name +
            "\",\"id\":" + id + ",\"speed\":0.2}");
  }
  void save(const std::string& name) {
    control(
        "{\"cmd_type\":\"trajectory_control\",\"cmd\":\"save_trajectory\",\"data\":{\"name\":\"" +
        name +
        "\",\"data\":[{\"longitude\":113,\"latitude\":23,\"angle\":0,\"x\":0,\"y\":0,\"yaw\":1.57}]"
        "}}");
  }
  template <class Body>
  void event(Body body) {
    service_->on_event({now_, std::move(body)}, actions_);
  }
  void reply(const store::StorageJob& job, bool ok, const std::string& reason = "",
             std::vector<std::string> removed = {}) {
    const auto* save = std::get_if<store::SaveTrack>(&job.what);
    service_->on_reply({job.id, ok, reason, std::move(removed),
                        save != nullptr ? std::optional(save->track) : std::nullopt},
                       now_, actions_);
  }
  template <class T>
  std::vector<T> all() const {
    std::vector<T> found;
    for (const Action& action : actions_) {
      if (const auto* one = std::get_if<T>(&action)) found.push_back(*one);
    }
    return found;
  }
  template <class T>
  T only() const {
    const auto found = all<T>();
    EXPECT_EQ(found.size(), 1U);
    return found.empty() ? T{} : found.back();
  }
  /// The `cmd` of each feedback so far, with ": reason" or " (note)"; forgets them.
  std::vector<std::string> feedback() {
    std::vector<std::string> told;
    for (const PublishText& message : all<PublishText>()) {
      if (message.topic != kTopicFeedback) continue;
      const auto parsed = json::parse(message.text);
      std::string line = *parsed->root.find("cmd")->text();
      EXPECT_EQ(*parsed->root.find("cmd_type")->text(), "feedback");
      if (const auto* reason = parsed->root.find("reason")) line += ": " + *reason->text();
      if (const auto* note = parsed->root.find("note")) line += " (" + *note->text() + ")";
      told.push_back(line);
    }
    actions_.clear();
    return told;
  }

  Time now_ = Time{from_s(100)};
  Actions actions_;
  std::unique_ptr<CommandService> service_;
};

}  // namespace drover::publish
