// A robot whose base takes a twist, as a configuration's text.
#pragma once

#include <gtest/gtest.h>

#include <string>
#include <string_view>

#include "config/load.h"

namespace drover::test {

inline constexpr std::string_view kCrawlerRobot = R"({
  "links": {"chassis": {"serial": "/dev/drover/chassis"}, "gnss": {"serial": "/dev/drover/gnss"},
            "panel": {"gpio": "chip0"}},
  "devices": {
    "chassis": {"driver": "crawler", "link": "chassis"},
    "gnss": {"driver": "nmea0183", "link": "gnss"},
    "estop": {"driver": "gpio_line", "link": "panel", "line": "a", "is": "estop"}},
  "groups": {"base": {"kind": "twist", "device": "chassis", "track_m": 0.6, "hold": "brake"}},
  "mqtt": {"host": "127.0.0.1", "port": 1883}
})";

/// That text with one piece replaced; a test whose piece is not there fails.
inline std::string crawler_with(std::string_view piece, std::string_view replacement) {
  std::string text(kCrawlerRobot);
  const auto at = text.find(piece);
  if (at == std::string::npos) {
    ADD_FAILURE() << "not in the text: " << piece;
    return text;
  }
  return text.replace(at, piece.size(), replacement);
}

}  // namespace drover::test
