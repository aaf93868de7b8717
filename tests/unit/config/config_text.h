// A small good configuration as text, to be changed by a test.
#pragma once

#include <gtest/gtest.h>

#include <string>
#include <string_view>

#include "config/load.h"

namespace drover::config {

/// Line 1 is the brace; a test names lines, so do not shift them.
inline constexpr std::string_view kGood = R"({
  "links": {"can0": {"can": "can0"},
            "gnss": {"serial": "/dev/drover/gnss", "baud": 115200}, "panel": {"gpio": "chip0"}},
  "devices": {
    "left": {"driver": "odrive", "link": "can0", "options": {"node": 1},)"
                                          R"( "accept": ["no_watchdog"]},
    "right": {"driver": "odrive", "link": "can0", "options": {"node": 2},)"
                                          R"( "accept": ["no_watchdog"]},
    "gnss": {"driver": "nmea0183", "link": "gnss"},
    "estop": {"driver": "gpio_line", "link": "panel", "line": "a", "is": "estop"},
    "bumper": {"driver": "gpio_line", "link": "panel", "line": "b", "is": "bumper"}
  }, "outputs": {"link": "panel", "enable_relay": {"line": "r"}},
  "groups": {"base": {"kind": "skid_steer", "wheel_radius_m": 0.165, "track_m": 0.6,)"
                                          R"( "left": ["left"], "right": ["right"],)"
                                          R"( "hold": "brake"}},
  "limits": {"max_speed_mps": 0.8},
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
