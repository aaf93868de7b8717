// A small good configuration as text, to be changed by a test.
#pragma once

#include <gtest/gtest.h>

#include <string>
#include <string_view>

#include "config/load.h"

namespace drover::config {

/// Line 1 is the brace; a test names lines, so do not shift them.
inline constexpr std::string_view kGood = R"({
  "buses": [{"name": "can0", "interface": "can0"}],
  "drives": [
    {"joint": "left", "driver": "odrive", "bus": "can0", "options": {"node": 1},)"
                                          R"( "accept": ["no_watchdog"]},
    {"joint": "right", "driver": "odrive", "bus": "can0", "options": {"node": 2},)"
                                          R"( "accept": ["no_watchdog"]}
  ],
  "base": {"wheel_radius_m": 0.165, "track_m": 0.6, "left": ["left"], "right": ["right"],)"
                                          R"( "hold": "brake"},
  "limits": {"max_speed_mps": 0.8},
  "gnss": {"port": "/dev/drover/gnss", "baud": 115200},
  "lines": {"chip": "chip0", "estop": {"line": "a"}, "bumper": {"line": "b"}},
  "mqtt": {"host": "127.0.0.1", "port": 1883}
}
)";

/// kGood with one piece replaced; a test whose piece is not there fails.
inline std::string with(std::string_view piece, std::string_view replacement) {
  std::string text(kGood);
  const auto at = text.find(piece);
  if (at == std::string::npos) {
    ADD_FAILURE() << "not in the text: " << piece;
    return text;
  }
  return text.replace(at, piece.size(), replacement);
}

/// As problems(), of warnings.
inline std::string warnings(std::string_view text) {
  std::string all;
  for (const auto& warning : load_text(text).warnings) all += warning.text("f") + "\n";
  return all;
}

/// All problems, a line each, as droverd prints them for a file called "f".
inline std::string problems(std::string_view text, const std::string& folder = "") {
  std::string all;
  for (const auto& problem : load_text(text, folder).problems) all += problem.text("f") + "\n";
  return all;
}

}  // namespace drover::config
