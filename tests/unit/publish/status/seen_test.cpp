#include "publish/status/seen.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "json/located_json.h"
#include "publish/aimrt/messages.h"
#include "publish/names.h"
#include "publish/rtk_navigation/base_status.h"
#include "publish/status/status.h"

namespace drover::publish {
namespace {

using namespace std::chrono_literals;
using testing::HasSubstr;
using testing::Not;

constexpr Time kTaken{100s};

Snapshot driving() {
  Snapshot s;
  s.time = kTaken;
  s.nav.status = NavStatus::run;
  s.nav.locate = LocateState::good;
  s.nav.owner = Owner::task;
  s.pose.x_m = 3;
  s.pose.vx_mps = 0.5;
  s.worst_vx_mps = 0.5;
  s.pose.wz_radps = 0.1;
  s.pose.vy_mps = 0.2;
  s.gnss.configured = true;
  s.gnss.health = SourceState::fresh;
  s.gnss.position.quality = FixQuality::rtk_fixed;
  s.imu.configured = true;
  s.imu.health = SourceState::fresh;
  AxisSnapshot axis;
  axis.joint = "left";
  axis.health = SourceState::fresh;
  axis.state = AxisState::running;
  axis.motion.velocity_radps = 3;
  axis.last_motion = kTaken;
  EXPECT_TRUE(s.axes.push_back(axis));
  s.line_configured[0] = true;
  s.line_health[0] = SourceState::fresh;
  const auto zone = static_cast<std::size_t>(Line::zone_near);
  s.line_configured[zone] = true;
  s.line_health[zone] = SourceState::fresh;
  EXPECT_TRUE(s.why.push_back("somebody in the far zone: slowly"));
  return s;
}

json::Document base_status(const Snapshot& seen, BaseStatus& writer) {
  auto parsed = json::parse(writer.text(seen));
  EXPECT_TRUE(parsed.ok());
  return std::move(parsed.value());
}

const json::Node& at(const json::Document& document, const char* group, const char* field) {
  return *document.root.find(group)->find(field);
}

TEST(Seen, KnowsNothingOfWhatIsFreeWhenNobodyLooked) {
  Snapshot old = driving();
  old.clearance = {.configured = true, .time = kTaken, .ahead_m = 3, .first = "box1"};
  const auto seen = as_seen(old, kTaken + 3s).clearance;
  EXPECT_FALSE(std::isfinite(seen.ahead_m));
  EXPECT_TRUE(seen.first.empty());
  EXPECT_THAT(std::string(seen.unknown.view()), HasSubstr("stands still"));
}

TEST(Seen, IsTheSnapshotItselfWhileItIsFresh) {
  const auto seen = as_seen(driving(), kTaken + kSnapshotLimit);
  EXPECT_EQ(seen.nav.status, NavStatus::run);
  EXPECT_EQ(seen.pose.vx_mps, 0.5);
  EXPECT_EQ(seen.why.size(), 1U);
}

TEST(Seen, LeavesASnapshotThatWasNeverWrittenAsItIs) {
  EXPECT_TRUE(as_seen(Snapshot{}, kTaken).why.empty());
}

TEST(Seen, SaysFirstThatNobodyLooksAnyMore) {
  const auto seen = as_seen(driving(), kTaken + 2300ms);
  ASSERT_EQ(seen.why.size(), 2U);
  EXPECT_EQ(seen.why[0].view(),
            "the control thread has stood still for 2.3 s: nothing is known of the robot now");
  EXPECT_EQ(seen.why[1].view(), "somebody in the far zone: slowly");
}

TEST(Seen, TellsOperatorsAnErrorAndNoSpeedOfThePresent) {
  BaseStatus writer({});
  auto document = base_status(driving(), writer);
  EXPECT_EQ(*at(document, "robot", "valid").boolean(), true);
  EXPECT_EQ(*at(document, "sensor", "laser").boolean(), true);
  document = base_status(as_seen(driving(), kTaken + 251ms), writer);
  EXPECT_EQ(*at(document, "nav", "status").text(), "NAV_ERROR");
  EXPECT_EQ(*at(document, "nav", "locate").text(), "LOCATE_FALSE");
  EXPECT_EQ(*at(document, "robot", "valid").boolean(), false);
  EXPECT_EQ(at(document, "robot", "vx").number(), 0.5) << "the last that was known";
  EXPECT_EQ(at(document, "rtk", "status").number(), 0);
  for (const char* sensor : {"imu", "laser", "robot"})
    EXPECT_EQ(*at(document, "sensor", sensor).boolean(), false) << sensor;
}

TEST(Seen, TellsTheCommandLineThatNothingIsFresh) {
  const auto text = status_json(as_seen(driving(), kTaken + 6s), {});
  EXPECT_THAT(text, Not(HasSubstr(R"("fresh")")));
  EXPECT_THAT(text, HasSubstr(R"("vx_mps":null)"));
  EXPECT_THAT(text, HasSubstr(R"("vy_mps":null)"));
  EXPECT_THAT(text, HasSubstr("stood still for 6.0 s"));
}

TEST(AReasonToldLast, StandsBehindTheOthersAndDrivesNoneOut) {
  Snapshot snapshot;
  (void)snapshot.why.push_back("first");
  tell_last(snapshot, "last");
  tell_last(snapshot, "last");  // told already
  ASSERT_EQ(snapshot.why.size(), 2U);
  EXPECT_EQ(snapshot.why[1], "last");
  for (int i = 0; i < 20; ++i) tell_last(snapshot, "more " + std::to_string(i));
  EXPECT_EQ(snapshot.why[0], "first");
}

TEST(ReasonsWithoutRoom, AreCountedInAllThatShowsWhy) {
  Snapshot snapshot = driving();
  EXPECT_EQ(more_reasons(snapshot), "");
  EXPECT_THAT(status_json(snapshot, {}), Not(HasSubstr(" more\"")));
  for (int i = 0; i < 9; ++i) tell_last(snapshot, "reason " + std::to_string(i));
  EXPECT_EQ(more_reasons(snapshot), "2 more");
  tell_first(snapshot, "the very first");
  EXPECT_THAT(status_json(snapshot, {}), HasSubstr(R"("reason 5","and 3 more"])"));
  BaseStatus writer({});
  EXPECT_THAT(writer.text(snapshot), HasSubstr(R"("reason 5","and 3 more"])"));
  const auto later = as_seen(snapshot, kTaken + 2300ms);
  EXPECT_EQ(more_reasons(later), "4 more") << "the control thread that stands still is the first";
}

}  // namespace
}  // namespace drover::publish
