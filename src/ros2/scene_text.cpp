#include "ros2/scene_text.h"

#include <cmath>

#include "ros2/samples.h"
#include "text/utf8.h"

namespace drover::ros2 {
namespace {

bool is_utf8(std::string_view text) {
  while (!text.empty()) {
    const auto bytes = text::character_bytes(text);
    if (bytes == 0) return false;
    text.remove_prefix(bytes);
  }
  return true;
}

}  // namespace

void SceneText::number(double value) {
  if (!std::isfinite(value)) refuse("is no finite number");
  out_.number(value);
}

void SceneText::text(std::string_view name, const char* value) {
  const auto told = text_of(value);
  if (!is_utf8(told)) refuse("is no UTF-8", name);
  out_.key(name).text(told);
}

void SceneText::refuse(std::string why, std::string_view name) {
  if (refusal_) return;
  std::string path = path_;
  if (!path.empty() && !name.empty()) path += '.';
  refusal_ = SceneRefusal{path.append(name), std::move(why)};
}

Result<std::string, SceneRefusal> SceneText::take() {
  if (refusal_) return *std::exchange(refusal_, std::nullopt);
  return out_.take();
}

}  // namespace drover::ros2
