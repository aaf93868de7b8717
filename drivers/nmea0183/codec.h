// Typed contents of the sentences that an RTK receiver tells its position, speed and heading with.
//
// Pure functions of the text between `$` and `*` (see framer.h). Source: NMEA 0183 as receivers
// speak it; the field tables and the deviations handled are in README.md.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>
#include <variant>

#include "drover/measurement.h"
#include "drover/result.h"
#include "drover/time.h"

namespace drover::nmea0183 {

/// What is strange in a well-formed sentence, so that a part of it is not believed.
enum class Oddity : std::uint8_t {
  none,
  position_missing,  ///< GGA claims a fix without a position: no fix
  null_island,       ///< GGA claims a fix at 0, 0: no fix
  absurd_hdop,       ///< GGA claims a fix with the HDOP that means "unknown": no fix
  unknown_quality,   ///< GGA quality 9: taken as a single fix
  bad_date,          ///< RMC date that does not exist: the date is absent
  old_date,          ///< RMC date of the past (week rollover in old firmware): not to be trusted
};

/// Position of the antenna. With quality none latitude and longitude are absent.
struct Gga {
  std::optional<Duration> utc;  ///< since midnight
  GnssPosition position;        ///< without sigmas: these are in GST
  Oddity oddity = Oddity::none;
};

struct Rmc {
  std::optional<Duration> utc;
  bool valid = false;     ///< status A and mode other than N
  GnssVelocity velocity;  ///< absent when not valid
  int year = 0;           ///< 0 when there is no valid date
  int month = 0;
  int day = 0;
  Oddity oddity = Oddity::none;
};

/// Speed over ground; without a time of its own.
struct Vtg {
  GnssVelocity velocity;  ///< absent when the mode says invalid
};

/// One sigma of the position's error.
struct Gst {
  std::optional<Duration> utc;
  double sigma_north_m = kAbsent;
  double sigma_east_m = kAbsent;
  double sigma_up_m = kAbsent;
};

/// HDT or THS: direction of the antenna baseline; without a time of its own.
struct Heading {
  double heading_deg = kAbsent;  ///< absent when the receiver has none
  enum class From : std::uint8_t { hdt, ths } from = From::hdt;
};

/// A good sentence of a type that is not read, such as GSV, or `GGAH` of the second antenna.
struct Other {};

using Sentence = std::variant<Other, Gga, Rmc, Vtg, Gst, Heading>;

/// Why a sentence with a right checksum is not used.
enum class Defect : std::uint8_t {
  too_short,  ///< required fields are missing
  malformed,  ///< a field does not follow its grammar or its range
};

/// `body` is the text between `$` and `*`.
Result<Sentence, Defect> decode(std::string_view body);

}  // namespace drover::nmea0183
