// What `drover stop` says of drives that nobody hears, from the status as droverd writes it.
#include "cli/unheard_drives.h"

#include <gtest/gtest.h>

#include "publish/status/status.h"

namespace drover::cli {
namespace {

AxisSnapshot axis(std::string_view joint, SourceState health) {
  AxisSnapshot a;
  a.joint = joint;
  a.health = health;
  return a;
}

std::string unheard(const Snapshot& s) {
  const auto status = json::parse(publish::status_json(s, {}));
  return status ? unheard_drives(status->root) : status.error().text();
}

TEST(UnheardDrives, AreNamed) {
  Snapshot s;
  (void)s.axes.push_back(axis("left", SourceState::fresh));
  (void)s.axes.push_back(axis("right", SourceState::stale));
  (void)s.axes.push_back(axis("third", SourceState::never_heard));
  EXPECT_EQ(unheard(s), "right, third");
}

TEST(UnheardDrives, AreNoneWhileAllTalk) {
  Snapshot s;
  (void)s.axes.push_back(axis("left", SourceState::fresh));
  s.base.configured = true;
  s.base.health = SourceState::fresh;
  EXPECT_EQ(unheard(s), "");
}

TEST(UnheardDrives, MayBeABaseThatTakesATwist) {
  Snapshot s;
  s.base.configured = true;
  s.base.health = SourceState::stale;
  EXPECT_EQ(unheard(s), "the base");
}

TEST(UnheardDrives, AreNotMissedWhileTheirPowerIsOff) {
  Snapshot s;
  (void)s.axes.push_back(axis("left", SourceState::stale));
  s.output_configured[static_cast<std::size_t>(Output::enable_relay)] = true;
  EXPECT_EQ(unheard(s), "") << "the relay is open";
  s.output_on[static_cast<std::size_t>(Output::enable_relay)] = true;
  EXPECT_EQ(unheard(s), "left");
  s.line_configured[static_cast<std::size_t>(Line::estop)] = true;
  s.line_active[static_cast<std::size_t>(Line::estop)] = true;
  EXPECT_EQ(unheard(s), "") << "the emergency stop is pressed";
}

}  // namespace
}  // namespace drover::cli
