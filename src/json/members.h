// Members of an object that need not be there.
#pragma once

#include <string>
#include <string_view>

#include "json/located_json.h"

namespace drover::json {

/// A member that is a text; empty where there is none.
inline std::string text_member(const Node& from, std::string_view key) {
  const auto* node = from.find(key);
  return node != nullptr && node->text() != nullptr ? *node->text() : std::string();
}

/// A member that is true.
inline bool flag_member(const Node& from, std::string_view key) {
  const auto* node = from.find(key);
  return node != nullptr && node->boolean() != nullptr && *node->boolean();
}

}  // namespace drover::json
