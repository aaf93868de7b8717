// Large messages through a broker with the limits of the one that is shipped: saves, the list of
// all tracks, and what memory they take.
#include <gmock/gmock.h>

#include <algorithm>
#include <fstream>
#include <optional>

#include "integration/robot_rig.h"
#include "json/located_json.h"
#include "publish/rtk_navigation/control.h"
#include "store/track.h"

namespace drover::test {
namespace {

using testing::HasSubstr;

/// A save_trajectory of exactly so many bytes.
std::string save_of(std::size_t bytes, const std::string& name) {
  const std::string point =
      R"({"longitude":113.0196366456667,"latitude":23.1496524965,"angle":90,"x":1,"y":2,"yaw":0})";
  std::string text =
      R"({"cmd_type":"trajectory_control","cmd":"save_trajectory","data":{"name":")" + name +
      R"(","data":[)" + point;
  while (text.size() + point.size() + 4 < bytes) text += "," + point;
  text += "]}}";
  return text.append(bytes - text.size(), ' ');
}

/// A line of /proc/PID/status, in bytes.
std::size_t memory(const Process& process, const char* key) {
  std::ifstream file("/proc/" + std::to_string(process.pid()) + "/status");
  for (std::string line; std::getline(file, line);)
    if (line.starts_with(key)) return std::stoul(line.substr(line.find(':') + 1)) * 1024;
  ADD_FAILURE() << "no " << key;
  return 0;
}

/// MemoryMax of a shipped unit.
std::size_t memory_max(const char* unit) {
  std::ifstream file(std::string(DROVER_SOURCE_DIR "/config/systemd/") + unit);
  for (std::string line; std::getline(file, line);)
    if (line.starts_with("MemoryMax=")) return std::stoul(line.substr(10)) << 20;
  ADD_FAILURE() << unit << " has no MemoryMax";
  return 0;
}

class Large : public RobotRig {
 protected:
  /// The answer to a save of so many bytes: a word, and why not.
  std::pair<std::string, std::string> save(std::size_t bytes, const std::string& name) {
    const auto before = client().heard().size();
    control(save_of(bytes, name));
    EXPECT_TRUE(wait_until([&] { return !client().feedback(before).empty(); }))
        << bytes << " bytes: no answer";
    const auto told = json::parse(client().last("feedback"));
    const auto* reason = told ? told->root.find("reason") : nullptr;
    return {client().feedback(before).front(), reason != nullptr ? *reason->text() : ""};
  }
  /// The tracks of the list; nothing when it does not come.
  std::optional<std::size_t> tracks_in_the_list() {
    const auto before = client().heard().size();
    const auto list = [&]() -> const std::string* {
      for (std::size_t i = before; i < client().heard().size(); ++i)
        if (client().heard()[i].topic == "trajectory_data") return &client().heard()[i].text;
      return nullptr;
    };
    control(R"({"cmd_type":"trajectory_control","cmd":"get_all_trajectory"})");
    if (!wait_until([&] { return list() != nullptr; })) return std::nullopt;
    const auto parsed =
        json::parse(*list(), {.max_bytes = store::kMaxListBytes, .max_values = 1'000'000});
    EXPECT_TRUE(parsed) << parsed.error().text();
    std::printf("the list has %zu bytes\n", list()->size());
    return parsed ? std::optional(parsed->root.list()->size()) : std::nullopt;
  }
};

TEST_F(Large, ASaveOfAnySizeIsAnswered) {
  ASSERT_NO_FATAL_FAILURE(start_all());
  const auto most = publish::ControlLimits{}.max_bytes;
  EXPECT_EQ(save(1'100'000, "a").first, "save_trajectory_success");
  EXPECT_EQ(save(most, "b").first, "save_trajectory_success");
  const auto refused = save(most + 1, "c");
  EXPECT_EQ(refused.first, "save_trajectory_failse");
  EXPECT_THAT(refused.second, HasSubstr(std::to_string(most)));
  const auto far_beyond = save(2 * most, "c");
  EXPECT_EQ(far_beyond.first, "save_trajectory_failse");
}

/// The start waits behind the saves for the parser, the cancel goes around it.
TEST_F(Large, AStartThatACancelOvertookMovesNothing) {
  ASSERT_NO_FATAL_FAILURE(start_all());
  save_track("row", 3);
  wait_until_believed();
  const auto before = client().heard().size();
  for (int i = 0; i < 3; ++i)
    control(save_of(publish::ControlLimits{}.max_bytes, "large" + std::to_string(i)));
  start_task("row", 5);
  control(R"({"cmd_type":"task_control","cmd":"cancel_task"})");
  const auto answered = [&](const char* cmd) {
    const auto told = client().feedback(before);
    return std::any_of(told.begin(), told.end(),
                       [cmd](const auto& one) { return one.starts_with(cmd); });
  };
  ASSERT_TRUE(wait_until([&] { return answered("start_task") && answered("cancel_task"); }));
  double fastest_mps = 0;
  for (const double end_s = now_s() + 1.5; now_s() < end_s;)
    fastest_mps = std::max(fastest_mps, std::abs(true_speed_mps()));
  EXPECT_LT(fastest_mps, 0.02) << "by a start that a cancel came after";
}

/// Whatever is decided of each: nobody reads a start's success after that of the cancel behind it.
TEST_F(Large, StartsAndCancelsThatComeAtOnceAreAnsweredInTheirOrder) {
  ASSERT_NO_FATAL_FAILURE(start_all());
  save_track("row", 3);
  wait_until_believed();
  for (int i = 0; i < 10; ++i) {
    const auto before = client().heard().size();
    for (int k = 0; k < 2; ++k) {
      start_task("row", 5);
      control(R"({"cmd_type":"task_control","cmd":"cancel_task"})");
    }
    const auto told = [&] {
      std::string order;
      for (const auto& one : client().feedback(before)) {
        if (one.starts_with("start_task"))
          order += one.starts_with("start_task_success") ? 'S' : 's';
        if (one.starts_with("cancel_task_success")) order += 'C';
      }
      return order;
    };
    ASSERT_TRUE(wait_until([&] { return told().size() == 4; })) << i << ": " << told();
    EXPECT_NE(told().back(), 'S') << i << ": " << told();
    EXPECT_EQ(told().find("CCS"), std::string::npos) << i << ": " << told();
  }
}

TEST_F(Large, AStartThatComesRightAfterACancelIsNotEndedByIt) {
  ASSERT_NO_FATAL_FAILURE(start_new());
  save_track("row", 3);
  wait_until_believed();
  for (int i = 0; i < 12; ++i) {
    control(R"({"cmd_type":"task_control","cmd":"cancel_task"})");
    start_task("row", 5);
    ASSERT_TRUE(wait_for_status("NAV_RUN")) << i;
    const double end_s = now_s() + 0.3;
    wait_until([&] { return now_s() > end_s; });
    ASSERT_EQ(status_text("nav", "status"), "NAV_RUN") << i;
  }
}

TEST_F(Large, WhateverIsSavedCanBeReadInOneListAndTheUnitsHaveTheMemoryForIt) {
  ASSERT_NO_FATAL_FAILURE(start_all());
  std::size_t saved = 0;
  for (std::size_t bytes = publish::ControlLimits{}.max_bytes; bytes > 1000; ++saved) {
    // Each as large as fits: the last ones fill the list.
    auto answer = save(bytes, "track " + std::to_string(saved));
    for (; answer.first != "save_trajectory_success" && bytes > 1000; bytes /= 2) {
      EXPECT_THAT(answer.second, HasSubstr(std::to_string(store::kMaxListBytes)));
      answer = save(bytes / 2, "track " + std::to_string(saved));
    }
    if (answer.first != "save_trajectory_success") break;
  }
  for (int i = 0; i < 5; ++i) EXPECT_EQ(tracks_in_the_list(), saved);
  const std::pair<const char*, const Process*> programs[] = {
      {"droverd.service.in", &daemon()}, {"mosquitto.service.d/drover.conf", &broker()}};
  for (const auto& [unit, process] : programs) {
    const auto peak = memory(*process, "VmHWM");
    const auto most = memory_max(unit);
    std::printf("%s: %zu of %zu MB at most\n", unit, peak >> 20U, most >> 20U);
#ifndef DROVER_SANITIZED  // a sanitizer has memory of its own
    EXPECT_LT(peak, most * 8 / 10) << unit;
#endif
  }
}

}  // namespace
}  // namespace drover::test
