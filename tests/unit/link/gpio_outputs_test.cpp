#include <gtest/gtest.h>

#include <array>
#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "link/outputs.h"

namespace drover::link {
namespace {

struct Folder {
  Folder() {
    std::string pattern = std::filesystem::temp_directory_path() / "drover-outputs-XXXXXX";
    path = ::mkdtemp(pattern.data());
  }
  ~Folder() { std::filesystem::remove_all(path); }
  OutputSettings settings() const { return {"files:" + path, {{"relay"}, {"lamp", true}}, -1}; }
  std::string path;
};

TEST(FileOutputs, AreFoundAsTheyWereLeft) {
  const Folder folder;
  {
    const auto opened = open_outputs(folder.settings());
    ASSERT_NE(opened.link, nullptr) << opened.problem;
    EXPECT_FALSE(opened.link->is_on(0)) << "an empty file is no closed relay";
    ASSERT_TRUE(opened.link->write(std::array{true, true}));
  }
  const auto again = open_outputs(folder.settings());
  ASSERT_NE(again.link, nullptr) << again.problem;
  EXPECT_TRUE(again.link->is_on(0));
  EXPECT_TRUE(again.link->is_on(1)) << "electrically low";
  ASSERT_TRUE(again.link->write(std::array{false, false}));
  EXPECT_FALSE(again.link->is_on(0) || again.link->is_on(1) || again.link->is_on(2));
}

}  // namespace
}  // namespace drover::link
