// What the READMEs say to look for in the output of `drover status --json` is there.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <regex>
#include <string>
#include <vector>

#include "publish/status/status.h"

namespace drover::cli {
namespace {

namespace fs = std::filesystem;

struct Named {
  std::string where;  ///< file and line
  std::string path;   ///< as jq takes it
};

void read_paths(const fs::path& file, std::vector<Named>& found) {
  static const std::regex kPath("`(\\.[a-z_]+(\\.[a-z_]+)*)`");
  std::ifstream in(file);
  int number = 0;
  for (std::string line; std::getline(in, line);) {
    ++number;
    const bool of_output = line.find("`drover status --json`") != std::string::npos;
    for (std::sregex_iterator it(line.begin(), line.end(), kPath), end; it != end; ++it)
      if (of_output || it->str(1).rfind(".status.", 0) == 0)
        found.push_back({file.string() + ":" + std::to_string(number), it->str(1)});
  }
}

std::vector<Named> named_paths() {
  std::vector<Named> found;
  fs::recursive_directory_iterator it(DROVER_SOURCE_DIR);
  for (; it != fs::recursive_directory_iterator(); ++it) {
    const std::string name = it->path().filename();
    if (it->is_directory() && (name == "build" || name[0] == '.')) it.disable_recursion_pending();
    if (name == "README.md") read_paths(it->path(), found);
  }
  return found;
}

TEST(StatusPaths, ThatAReadmeNamesAreInTheOutput) {
  const auto status = nlohmann::json::parse(publish::status_json(Snapshot{}, {}));
  const nlohmann::json printed{{"ok", true}, {"status", status}};
  const std::vector<Named> paths = named_paths();
  EXPECT_GE(paths.size(), 3U);
  for (const auto& [where, path] : paths) {
    std::string pointer = path;
    for (char& c : pointer) c = c == '.' ? '/' : c;
    EXPECT_TRUE(printed.contains(nlohmann::json::json_pointer(pointer))) << where << ": " << path;
  }
}

}  // namespace
}  // namespace drover::cli
