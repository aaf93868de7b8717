// Numbers and texts of a message.
#include <algorithm>
#include <cmath>
#include <utility>

#include "scene/message/check.h"
#include "scene/message/validate.h"
#include "text/control.h"
#include "text/number.h"
#include "text/utf8.h"

namespace drover::scene::check {
void note(Notes& notes, std::string whole) {
  if (notes.size() >= kMaxNotes) {
    notes.back() = "and more";
    return;
  }
  notes.push_back(std::move(whole));
}

void note(Notes& notes, const std::string& path, std::string_view text) {
  note(notes, path + ": " + std::string(text));
}

std::string member(const std::string& path, std::string_view name) {
  return path.empty() ? std::string(name) : path + "." + std::string(name);
}

std::string element(const std::string& path, std::size_t index) {
  return path + "[" + std::to_string(index) + "]";
}

Problem number(const std::string& path, double value, double least, double most) {
  if (!std::isfinite(value)) return Refusal{path, "is no finite number"};
  if (value >= least && value <= most) return std::nullopt;
  return Refusal{path, "is " + text::number_text(value) + ": it must be from " +
                           text::number_text(least) + " to " + text::number_text(most)};
}

Problem text(const std::string& path, std::string_view value) {
  if (value.size() > kMaxNameBytes) {
    return Refusal{path, "has " + std::to_string(value.size()) + " bytes, at most " +
                             std::to_string(kMaxNameBytes) + " are allowed"};
  }
  while (!value.empty()) {
    const std::size_t bytes = text::character_bytes(value);
    if (bytes == 0) return Refusal{path, "is no UTF-8"};
    if (text::is_control(value.substr(0, bytes)))
      return Refusal{path, "contains a control character"};
    value.remove_prefix(bytes);
  }
  return std::nullopt;
}

Problem name(const std::string& path, std::string_view value) {
  if (value.empty()) return Refusal{path, "is empty: it must be named"};
  return text(path, value);
}

}  // namespace drover::scene::check
