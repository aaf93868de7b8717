// What the lists of the scene and of the zones have in common.
#pragma once

#include <cstddef>
#include <string>

#include "cli/layout.h"

namespace drover::cli {

inline constexpr std::size_t kNameColumns = 20;

/// First of all what is not known, with the verbs that end it; empty: all is known.
inline std::string nothing_is_free(const json::Node& answer, const char* way_out) {
  const auto what = text(at(answer, "problem"));
  if (what.empty()) return "";
  return "NOTHING IS FREE, no task moves: " + what + "\n  the way out: " + way_out + "\n";
}

}  // namespace drover::cli
