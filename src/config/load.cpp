#include "config/load.h"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <utility>

#include "config/checks.h"
#include "config/old_sections.h"
#include "config/reader.h"

namespace drover::config {

namespace {

/// One byte more than the parser accepts, so that it can refuse; 0 or an errno.
int read_file(const std::string& path, std::string& text) {
  const auto most = json::Limits{}.max_bytes + 1;
  const int fd = ::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK | O_NOCTTY);
  if (fd < 0) return errno;
  int error = 0;
  char block[4096];
  while (text.size() < most) {
    const auto n = ::read(fd, block, std::min(sizeof block, most - text.size()));
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) error = errno;
    if (n <= 0) break;
    text.append(block, static_cast<std::size_t>(n));
  }
  ::close(fd);
  return error;
}

void sort(std::vector<Problem>& problems) {
  std::stable_sort(problems.begin(), problems.end(), [](const Problem& a, const Problem& b) {
    return std::pair(a.line, a.column) < std::pair(b.line, b.column);
  });
}

/// What was found in sections that have today's form and are whole.
void keep_what_stays(std::vector<Problem>& problems) {
  std::erase_if(problems, [](const Problem& problem) {
    const auto section = problem.path.substr(0, problem.path.find('.'));
    return section == "links" || section == "devices" || section == "groups" ||
           section == "outputs" || is_old_section(section);
  });
}

Loaded one_problem(Problem problem) {
  Loaded loaded;
  loaded.problems.push_back(std::move(problem));
  return loaded;
}

}  // namespace

std::string Problem::text(std::string_view given_file) const {
  std::string out(file.empty() ? std::string(given_file) : json::shown(file, 400));
  if (line > 0) out += ":" + std::to_string(line) + ":" + std::to_string(column);
  out += ": ";
  // Keys and texts of the file are foreign: they must not forge a line.
  if (!path.empty()) out += json::shown(path, 200) + ": ";
  out += json::shown(message, 400);
  if (!suggestion.empty()) out += " (" + json::shown(suggestion, 400) + ")";
  return out;
}

Loaded load_text(std::string_view text, const std::string& folder, std::string register_map) {
  const auto document = json::parse(text);
  if (!document) {
    const auto& error = document.error();
    return one_problem({error.line, error.column, error.path, error.message, "", ""});
  }
  const auto& root = document->root;
  if (root.object() == nullptr)
    return one_problem({root.line, root.column, "", "an object is expected", "{ ... }", ""});
  Loaded loaded;
  loaded.text = text;
  loaded.register_map = std::move(register_map);
  GroupNames groups;
  groups.base.base = &loaded.config.engine.base;
  Reader reader(root, "", loaded.problems);
  visit(reader, loaded.config, groups);
  reader.finish();
  if (auto old = find_old_sections(root); !old.problems.empty()) {
    keep_what_stays(loaded.problems);
    for (auto& problem : old.problems) loaded.problems.push_back(std::move(problem));
    loaded.new_sections = std::move(old.sections);
    sort(loaded.problems);
    return loaded;
  }
  check_and_resolve(root, groups, folder, loaded);
  sort(loaded.problems);
  return loaded;
}

Loaded load_file(const std::string& path) {
  std::string text;
  if (const auto problem = read_text(path, text); !problem.empty())
    return one_problem({0, 0, "", problem, "", ""});
  return load_text(text, std::filesystem::path(path).parent_path().string());
}

std::string read_text(const std::string& path, std::string& text) {
  const int error = read_file(path, text);
  return error == 0 ? "" : std::string("cannot be read: ") + std::strerror(error);
}

}  // namespace drover::config
