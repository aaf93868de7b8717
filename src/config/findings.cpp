#include "config/findings.h"

#include <algorithm>

namespace drover::config {
namespace {

/// The value at a path like "drives[1].options.node", or as much of the way as is there.
const json::Node& place(const json::Node& root, std::string_view path) {
  const auto end = path.find_first_of(".[", 1);
  const auto step = path.substr(0, end);
  const json::Node* next = nullptr;
  if (step.starts_with('[')) {
    const auto index = static_cast<std::size_t>(std::stoul(std::string(step.substr(1))));
    if (root.list() != nullptr && index < root.list()->size()) next = &(*root.list())[index];
  } else {
    next = root.find(step.starts_with('.') ? step.substr(1) : step);
  }
  if (next == nullptr) return root;
  return end == path.npos ? *next : place(*next, path.substr(end));
}

}  // namespace

void Findings::add(std::string path, std::string message, std::string hint) {
  const auto& at = place(root_, path);
  loaded_.problems.push_back(
      {at.line, at.column, std::move(path), std::move(message), std::move(hint), ""});
}

void Findings::warn(const std::string& path, const std::string& message, const std::string& word) {
  const auto& accepted = loaded_.config.accept;
  if (std::find(accepted.begin(), accepted.end(), word) != accepted.end()) return;
  const auto& at = place(root_, path);
  loaded_.warnings.push_back(
      {at.line, at.column, path, message, "\"accept\": [\"" + word + "\"] when that is meant", ""});
}

bool Findings::given(std::string_view section, std::string_view object,
                     std::string_view key) const {
  const auto* outer = root_.find(section);
  const auto* inner = outer != nullptr ? outer->find(object) : nullptr;
  return inner != nullptr && inner->find(key) != nullptr;
}

bool Findings::has_problem(std::string_view path) const {
  return std::any_of(loaded_.problems.begin(), loaded_.problems.end(), [path](const auto& p) {
    if (!p.path.starts_with(path)) return false;
    const auto rest = std::string_view(p.path).substr(path.size());
    return rest.empty() || rest.front() == '.' || rest.front() == '[';
  });
}

std::string item(std::string_view list, std::size_t index) {
  return std::string(list) + "[" + std::to_string(index) + "]";
}

}  // namespace drover::config
