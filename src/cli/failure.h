// How a verb says that it failed: a sentence for people, an object for programs.
#pragma once

#include <cstdio>
#include <string>
#include <string_view>

#include "json/json_text.h"

namespace drover::cli {

/// With --json {"ok":false,"reason":TEXT} on standard output, as droverd's refusals; otherwise
/// "WHO: TEXT" on standard error.
inline void tell_failure(bool json, std::string_view who, std::string_view text) {
  if (json) {
    json::JsonText out;
    out.open('{').key("ok").boolean(false).key("reason").text(text).close('}');
    std::printf("%s\n", out.take().c_str());
  } else {
    std::fprintf(stderr, "%.*s: %.*s\n", static_cast<int>(who.size()), who.data(),
                 static_cast<int>(text.size()), text.data());
  }
}

}  // namespace drover::cli
