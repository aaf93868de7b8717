// What is wrong with the simulated receiver just now: its states, read from their text.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

#include "drover/time.h"

namespace drover::nmea0183 {

struct Offset {
  double east_m = 0;
  double north_m = 0;
};

/// Of the told position from the true one: it wanders on at a steady pace.
struct PositionDrift {
  Offset from;
  double east_mps = 0;
  double north_mps = 0;
  Time since = kNever;

  /// Before `since` it is where the one before had got to.
  Offset at(Time t) const;
};

/// The states are listed in twin.h.
struct TwinFaults {
  enum class Output : std::uint8_t { sentences, silent, garbage };

  Output output = Output::sentences;
  double bad_checksum_one_in = 0;
  double rate_Hz = 0;  ///< 0: as configured
  Duration lag{};
  double backlog_growth = 0;  ///< seconds a second
  Duration backlog_most{};
  Time backlog_since = kNever;
  Duration stamp_late{};
  Duration heading_epoch{};  ///< of the position's; zero or negative
  Offset jump;
  PositionDrift drift;
  double speed_noise_mps = 0;
  bool stuck = false;
  std::optional<Time> corrections_lost_at;
  double heading_off_deg = 0;  ///< clockwise
  bool heading_flip = false;
  bool heading_lost = false;
  bool gst_lost = false;

  /// A state that is no kind of fix. `ahead_deg` is where the robot points just now, clockwise
  /// from north. False: there is no such state, and nothing has changed.
  bool set(std::string_view text, Time now, double ahead_deg);
  /// How much longer than the configured latency bytes are on their way.
  Duration delay(Time now) const;

 private:
  bool set_word(std::string_view name, Time now);
  bool set_number(std::string_view name, double value);
  bool set_place(std::string_view name, double value, double direction_deg, Time now);
};

}  // namespace drover::nmea0183
