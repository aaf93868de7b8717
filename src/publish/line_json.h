// What the lines of the CLI's socket have in common, whoever answers them.
#pragma once

#include <cmath>
#include <optional>
#include <string>
#include <string_view>

#include "json/json_text.h"
#include "json/located_json.h"

namespace drover::publish {

/// {"ok":true,"note":TEXT} or {"ok":false,"reason":TEXT}.
inline std::string reply_line(bool ok, std::string_view text) {
  json::JsonText reply;
  reply.open('{').key("ok").boolean(ok);
  return reply.key(ok ? "note" : "reason").text(text).close('}').take();
}

/// A member that is a text; empty where there is none.
inline std::string text_member(const json::Node& request, std::string_view key) {
  const auto* node = request.find(key);
  return node != nullptr && node->text() != nullptr ? *node->text() : std::string();
}

/// A member that is true.
inline bool flag_member(const json::Node& request, std::string_view key) {
  const auto* node = request.find(key);
  return node != nullptr && node->boolean() != nullptr && *node->boolean();
}

/// A member; null what is not known.
inline void number_or_null(json::JsonText& out, std::string_view name, std::optional<double> value,
                           int decimals) {
  out.key(name);
  value&& std::isfinite(*value) ? out.number(*value, decimals) : out.null();
}

}  // namespace drover::publish
