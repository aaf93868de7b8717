#include "sim/scenario/children.h"

#include <gtest/gtest.h>
#include <poll.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "support/temp_folder.h"

namespace drover::sim {
namespace {

/// Waits until a child's descriptor says that it ended.
std::vector<Children::Ended> wait_for_end(Children& children) {
  const auto fds = children.descriptors();
  EXPECT_EQ(fds.size(), 1U);
  pollfd poll{fds.at(0), POLLIN, 0};
  while (::poll(&poll, 1, -1) != 1) {
  }
  return children.reap();
}

TEST(TheChildren, RefuseASecondOneOfTheSameName) {
  const test::TempFolder folder;
  Children children(folder.path());
  EXPECT_EQ(children.start({"sleeper", {"/bin/sleep", "1000"}}), "");
  EXPECT_NE(children.start({"sleeper", {"/bin/sleep", "1000"}}), "");
  EXPECT_TRUE(children.reap().empty());
}

TEST(TheChildren, CannotBeSignalledWhenTheyDoNotRun) {
  const test::TempFolder folder;
  Children children(folder.path());
  EXPECT_FALSE(children.signal("nobody", SIGTERM));
}

TEST(TheChildren, StandStillInOneThreadForAsLongAsItIsHeld) {
  const test::TempFolder folder;
  Children children(folder.path());
  ASSERT_EQ(children.start({"sleeper", {"/bin/sleep", "1000"}}), "");
  EXPECT_EQ(children.hold("nobody", "sleep"), nullptr);
  EXPECT_EQ(children.hold("sleeper", "no such thread"), nullptr);
  std::unique_ptr<HeldThread> held;
  for (int i = 0; i < 1000 && held == nullptr; ++i) {
    held = children.hold("sleeper", "sleep");
    ::usleep(1000);  // until it has become that program
  }
  if (held == nullptr) GTEST_SKIP() << "this system lets nobody hold a thread";
  EXPECT_TRUE(children.reap().empty());
  held.reset();
  EXPECT_TRUE(children.signal("sleeper", SIGTERM));
  EXPECT_EQ(wait_for_end(children).size(), 1U);
}

TEST(TheChildren, ThatCannotBeExecutedEndWithStatus127) {
  const test::TempFolder folder;
  Children children(folder.path());
  EXPECT_EQ(children.start({"none", {"/nowhere/program"}}), "");
  const auto ended = wait_for_end(children);
  ASSERT_EQ(ended.size(), 1U);
  EXPECT_EQ(WEXITSTATUS(ended[0].status), 127);
  EXPECT_FALSE(children.runs("none"));
}

TEST(TheChildren, AreSignalledAndTellHowTheyEnded) {
  const test::TempFolder folder;
  Children children(folder.path());
  ASSERT_EQ(children.start({"sleeper", {"/bin/sleep", "1000"}}), "");
  EXPECT_TRUE(children.runs("sleeper"));
  EXPECT_TRUE(children.signal("sleeper", SIGKILL));
  const auto ended = wait_for_end(children);
  ASSERT_EQ(ended.size(), 1U);
  EXPECT_EQ(ended[0].name, "sleeper");
  EXPECT_TRUE(WIFSIGNALED(ended[0].status));
}

TEST(TheChildren, WriteTheirOutputAndErrorsToALogThatGrowsWithEachStart) {
  const test::TempFolder folder;
  const auto& logs = folder.path();
  Children children(logs);
  for (int i = 0; i < 2; ++i) {
    ASSERT_EQ(children.start({"talker", {"/bin/sh", "-c", "echo one; echo two >&2"}}), "");
    EXPECT_EQ(WEXITSTATUS(wait_for_end(children).at(0).status), 0);
  }
  std::ostringstream text;
  text << std::ifstream(logs + "/talker.log").rdbuf();
  EXPECT_EQ(text.str(), "one\ntwo\none\ntwo\n");
}

TEST(FindProgram, LooksInTheFolderAndWhereABuildLeavesPrograms) {
  const test::TempFolder folder;
  const auto& place = folder.path();
  EXPECT_EQ(find_program(place, "droverd"), "");
  std::filesystem::create_directories(place + "/src");
  std::ofstream(place + "/src/droverd") << "#!/bin/sh\n";
  EXPECT_EQ(find_program(place, "droverd"), "") << "it cannot be executed";
  std::filesystem::permissions(place + "/src/droverd", std::filesystem::perms::owner_all);
  EXPECT_EQ(find_program(place, "droverd"), place + "/src/droverd");
}

}  // namespace
}  // namespace drover::sim
