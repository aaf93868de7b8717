#include <gtest/gtest.h>

#include <cerrno>
#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "link/lines.h"

namespace drover::link {
namespace {

struct Folder {
  Folder() {
    std::string pattern = std::filesystem::temp_directory_path() / "drover-lines-XXXXXX";
    path = ::mkdtemp(pattern.data());
  }
  ~Folder() { std::filesystem::remove_all(path); }
  void set(const std::string& line, char level) const { std::ofstream(path + "/" + line) << level; }
  std::string path;
};

TEST(FileLines, NameTheLineThatIsMissing) {
  Folder folder;
  const auto opened = open_lines({"files:" + folder.path, {"estop"}});
  EXPECT_EQ(opened.link, nullptr);
  EXPECT_NE(opened.problem.find("estop"), std::string::npos) << opened.problem;
}

TEST(FileLines, FollowTheLevels) {
  Folder folder;
  folder.set("estop", '1');
  folder.set("bumper", '0');
  const auto opened = open_lines({"files:" + folder.path, {"estop", "bumper"}});
  ASSERT_NE(opened.link, nullptr) << opened.problem;
  std::array<bool, kMaxLines> levels{};
  ASSERT_TRUE(opened.link->read(levels));
  EXPECT_TRUE(levels[0]);
  EXPECT_FALSE(levels[1]);
  folder.set("estop", '0');
  ASSERT_TRUE(opened.link->read(levels));
  EXPECT_FALSE(levels[0]);
}

TEST(FileLines, AnEmptiedFileIsALostLine) {
  Folder folder;
  folder.set("estop", '1');
  const auto opened = open_lines({"files:" + folder.path, {"estop"}});
  ASSERT_NE(opened.link, nullptr) << opened.problem;
  std::filesystem::resize_file(folder.path + "/estop", 0);
  std::array<bool, kMaxLines> levels{};
  errno = EAGAIN;  // of whatever this thread did before: an end of file sets none
  EXPECT_FALSE(opened.link->read(levels));
  EXPECT_EQ(opened.link->error(), ENODATA);
}

TEST(OpenLines, NamesTheChipThatIsMissing) {
  const auto opened = open_lines({"no-such-chip", {"estop"}});
  EXPECT_EQ(opened.link, nullptr);
  EXPECT_NE(opened.problem.find("no-such-chip"), std::string::npos) << opened.problem;
}

}  // namespace
}  // namespace drover::link
