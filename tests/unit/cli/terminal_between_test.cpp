// Who answers for a terminal in place of the person's own.
#include "cli/terminal_between.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>

#include "cli/ancestors.h"

namespace drover::cli {
namespace {

std::string within(std::vector<std::string> ancestors) {
  return stands_between({.ancestors = std::move(ancestors)});
}

TEST(TerminalBetween, NamesTheProgramThatThisOneRunsWithin) {
  EXPECT_EQ(within({"bash", "tmux: server", "systemd"}), "tmux");
  EXPECT_EQ(within({"bash", "screen", "systemd"}), "screen");
  EXPECT_EQ(within({"bash", "SCREEN", "systemd"}), "screen");
  EXPECT_EQ(within({"sudo", "bash", "mosh-server", "systemd"}), "mosh-server");
  for (const char* name :
       {"zellij", "dtach", "abduco", "shpool", "dvtm", "byobu", "ttyd", "gotty", "vim"})
    EXPECT_EQ(within({"sh", name, "init"}), name);
}
TEST(TerminalBetween, LeavesAPlainTerminalAlone) {
  EXPECT_EQ(within({}), "");
  EXPECT_EQ(within({"bash", "sshd", "sshd", "systemd"}), "");
  EXPECT_EQ(within({"bash", "login", "systemd"}), "");
  EXPECT_EQ(within({"screenfetch", "vimdiff-all", "init"}), "");
}
TEST(TerminalBetween, TheEnvironmentIsASecondSign) {
  EXPECT_EQ(stands_between({.ancestors = {"bash"}, .tmux = "/tmp/tmux-0/default,7,0"}), "tmux");
  EXPECT_EQ(stands_between({.ancestors = {"bash"}, .screen = "7.pts-0.robot"}), "screen");
}
TEST(Ancestors, BeginWithTheParent) {
  const auto names = names_of_ancestors();
  ASSERT_TRUE(names);
  ASSERT_FALSE(names->empty());
  std::string parent;
  std::getline(std::ifstream("/proc/" + std::to_string(::getppid()) + "/comm"), parent);
  EXPECT_EQ(names->front(), parent);
}
TEST(Ancestors, ANameMayHaveAnything) {
  const auto told = process_of("41 (a) b (c)) S 17 41 41 0 -1");
  ASSERT_TRUE(told);
  EXPECT_EQ(told->name, "a) b (c)");
  EXPECT_EQ(told->parent, 17);
  for (const char* wrong : {"", "41 (a", "41 a S 17", "41 (a) S", "41 (a) S x"})
    EXPECT_FALSE(process_of(wrong)) << wrong;
}

}  // namespace
}  // namespace drover::cli
