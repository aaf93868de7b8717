// What the lines of the CLI's socket have in common, whoever answers them.
#pragma once

#include <cmath>
#include <optional>
#include <string>
#include <string_view>

#include "json/json_text.h"
#include "json/members.h"

namespace drover::publish {

/// {"ok":true,"note":TEXT} or {"ok":false,"reason":TEXT}.
inline std::string reply_line(bool ok, std::string_view text) {
  json::JsonText reply;
  reply.open('{').key("ok").boolean(ok);
  return reply.key(ok ? "note" : "reason").text(text).close('}').take();
}

using json::flag_member;
using json::text_member;

/// A member; null what is not known.
inline void number_or_null(json::JsonText& out, std::string_view name, std::optional<double> value,
                           int decimals) {
  out.key(name);
  value&& std::isfinite(*value) ? out.number(*value, decimals) : out.null();
}

}  // namespace drover::publish
