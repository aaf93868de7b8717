#include "config/findings.h"

#include <algorithm>

namespace drover::config {
namespace {

/// The member whose key `path` begins with. Names are the user's own and may hold dots: the
/// longest.
const json::Member* member_of(const json::Node& node, std::string_view path) {
  const json::Member* longest = nullptr;
  if (node.object() == nullptr) return nullptr;
  for (const auto& member : *node.object()) {
    if (!path.starts_with(member.key)) continue;
    const auto rest = path.substr(member.key.size());
    if (!rest.empty() && rest.front() != '.' && rest.front() != '[') continue;
    if (longest == nullptr || member.key.size() > longest->key.size()) longest = &member;
  }
  return longest;
}

/// The value at a path like "devices.imu.options.rate_Hz", or as much of the way as is there; what
/// is left of the path is what is not there.
const json::Node& place(const json::Node& root, std::string_view& path) {
  if (path.empty()) return root;
  if (path.starts_with('[')) {
    const auto index = static_cast<std::size_t>(std::stoul(std::string(path.substr(1))));
    if (root.list() == nullptr || index >= root.list()->size()) return root;
    path.remove_prefix(std::min(path.size(), path.find(']') + 1));
    return place((*root.list())[index], path);
  }
  const auto step = path.substr(path.starts_with('.') ? 1 : 0);
  const auto* member = member_of(root, step);
  if (member == nullptr) return root;
  path = step.substr(member->key.size());
  return place(member->node, path);
}

/// What is left of a path leads into what has no such parts.
bool is_of_another_kind(const json::Node& at, std::string_view rest) {
  if (rest.empty()) return false;
  return rest.front() == '[' ? at.list() == nullptr : at.object() == nullptr;
}

}  // namespace

void Findings::add(std::string path, std::string message, std::string hint) {
  std::string_view rest = path;
  const auto& at = place(root_, rest);
  if (is_of_another_kind(at, rest) && is_wrong(path.substr(0, path.size() - rest.size()))) return;
  loaded_.problems.push_back(
      {at.line, at.column, std::move(path), std::move(message), std::move(hint), ""});
}

void Findings::warn(const std::string& path, const std::string& message, const std::string& word,
                    const std::string& mend) {
  if (accepts(word)) return;
  hint_at(path, message,
          (mend.empty() ? "" : mend + ", or ") + "\"accept\": [\"" + word +
              "\"] at the top of the file when that is meant");
}

void Findings::hint_at(const std::string& path, const std::string& message,
                       const std::string& mend) {
  std::string_view rest = path;
  const auto& at = place(root_, rest);
  loaded_.warnings.push_back({at.line, at.column, path, message, mend, ""});
}

bool Findings::accepts(const std::string& word) const {
  const auto& accepted = loaded_.config.accept;
  return std::find(accepted.begin(), accepted.end(), word) != accepted.end();
}

bool Findings::given(std::string_view path) const {
  (void)place(root_, path);
  return path.empty();
}

bool Findings::has_problem(std::string_view path) const {
  return std::any_of(loaded_.problems.begin(), loaded_.problems.end(), [path](const auto& p) {
    if (!p.path.starts_with(path)) return false;
    const auto rest = std::string_view(p.path).substr(path.size());
    return rest.empty() || rest.front() == '.' || rest.front() == '[';
  });
}

bool Findings::is_wrong(std::string_view path) const {
  return std::any_of(loaded_.problems.begin(), loaded_.problems.end(),
                     [path](const auto& problem) { return problem.path == path; });
}

std::string device_path(const DeviceConfig& device, std::string_view key) {
  return "devices." + device.name + (key.empty() ? "" : "." + std::string(key));
}

std::string link_path(const LinkConfig& link, std::string_view key) {
  return "links." + link.name + (key.empty() ? "" : "." + std::string(key));
}

}  // namespace drover::config
