// Field tables of GGA, RMC, VTG, GST, HDT and THS.
#include "drivers/nmea0183/codec.h"

#include <array>
#include <cmath>

#include "drivers/nmea0183/fields.h"

namespace drover::nmea0183 {
namespace {

constexpr double kMpsPerKnot = 1852.0 / 3600.0;
constexpr double kMpsPerKmph = 1.0 / 3.6;
constexpr double kMaxKnots = 1000;
constexpr double kMaxKmph = 1852;
constexpr double kMaxHeight_m = 100e3;
constexpr double kMaxUndulation_m = 200;  // the geoid stays inside -107 m .. +86 m
constexpr double kMaxAge_s = 1e6;
constexpr double kMaxSigma_m = 1e7;
// 99.9, 99.99 and 9999.0 are receivers' words for "unknown".
constexpr double kUnknownHdop = 99;
constexpr double kMaxHdop = 1e5;
// Firmware whose week counter rolled over reports a date 1024 weeks back; this code is younger.
constexpr int kFirstPlausibleYear = 2025;

using Decoded = Result<Sentence, Defect>;

Decoded finish(const FieldReader& fields, const Sentence& sentence) {
  if (!fields.ok()) return Defect::malformed;
  return sentence;
}

FixQuality quality_of(int number) {
  // 9 is a satellite-augmented fix on NovAtel and ComNav; nothing unknown is better than single.
  return number <= 8 ? static_cast<FixQuality>(number) : FixQuality::single;
}

// A fix that its own sentence contradicts is no fix: it must not appear at 0, 0.
Oddity contradiction(const GnssPosition& position) {
  if (position.quality == FixQuality::none) return Oddity::none;
  if (std::isnan(position.latitude_deg) || std::isnan(position.longitude_deg))
    return Oddity::position_missing;
  if (position.latitude_deg == 0.0 && position.longitude_deg == 0.0) return Oddity::null_island;
  // Dead reckoning has no dilution of precision, so the marker is in place there.
  if (position.hdop >= kUnknownHdop && position.quality != FixQuality::estimated)
    return Oddity::absurd_hdop;
  return Oddity::none;
}

Decoded decode_gga(FieldReader& fields) {
  if (fields.size() < 7) return Defect::too_short;
  Gga gga;
  GnssPosition& position = gga.position;
  gga.utc = fields.time_of_day(1);
  position.latitude_deg = fields.latitude_deg(2);
  position.longitude_deg = fields.longitude_deg(4);
  const int quality = fields.integer(6, 9).value_or(0);
  position.quality = quality_of(quality);
  position.satellites = fields.integer(7, 999).value_or(0);
  position.hdop = fields.decimal(8, 0, kMaxHdop);
  position.altitude_msl_m = fields.decimal(9, -kMaxHeight_m, kMaxHeight_m);
  fields.expect_letter_or_empty(10, 'M');
  position.undulation_m = fields.decimal(11, -kMaxUndulation_m, kMaxUndulation_m);
  fields.expect_letter_or_empty(12, 'M');
  position.correction_age_s = fields.decimal(13, 0, kMaxAge_s);

  gga.oddity = contradiction(position);
  if (gga.oddity != Oddity::none) position.quality = FixQuality::none;
  if (gga.oddity == Oddity::none && quality == 9) gga.oddity = Oddity::unknown_quality;
  if (position.hdop >= kUnknownHdop) position.hdop = kAbsent;
  if (position.quality == FixQuality::none) {
    position.latitude_deg = kAbsent;
    position.longitude_deg = kAbsent;
    position.altitude_msl_m = kAbsent;
    position.undulation_m = kAbsent;
  }
  return finish(fields, gga);
}

int days_in_month(int year, int month) {
  if (month == 2) return (year % 4 == 0 && (year % 100 != 0 || year % 400 == 0)) ? 29 : 28;
  return (month == 4 || month == 6 || month == 9 || month == 11) ? 30 : 31;
}

// A wrong date leaves the rest of the sentence usable.
void decode_date(std::string_view text, Rmc& rmc) {
  if (text.empty()) return;
  rmc.oddity = Oddity::bad_date;
  if (text.size() != 6) return;
  std::array<int, 3> parts{};
  for (std::size_t i = 0; i < 6; ++i) {
    if (text[i] < '0' || text[i] > '9') return;
    parts[i / 2] = parts[i / 2] * 10 + (text[i] - '0');
  }
  const auto [day, month, short_year] = parts;
  const int year = short_year + (short_year >= 80 ? 1900 : 2000);
  if (month < 1 || month > 12 || day < 1 || day > days_in_month(year, month)) return;
  rmc.day = day;
  rmc.month = month;
  rmc.year = year;
  rmc.oddity = year < kFirstPlausibleYear ? Oddity::old_date : Oddity::none;
}

Decoded decode_rmc(FieldReader& fields) {
  if (fields.size() < 10) return Defect::too_short;
  Rmc rmc;
  rmc.utc = fields.time_of_day(1);
  const char status = fields.letter(2);
  fields.latitude_deg(3);  // not used (GGA says more), but a wrong one condemns the sentence
  fields.longitude_deg(5);
  const double speed_mps = fields.decimal(7, 0, kMaxKnots) * kMpsPerKnot;
  const double course_deg = fields.direction_deg(8);
  decode_date(fields.text(9), rmc);
  const char mode = fields.letter(12);
  if (status != 'A' && status != 'V' && status != '\0') fields.fail();
  // Field 13, nav status, is not asked: V means "not provided" there.
  rmc.valid = status == 'A' && mode != 'N';
  if (rmc.valid) rmc.velocity = {speed_mps, course_deg};
  return finish(fields, rmc);
}

Decoded decode_vtg(FieldReader& fields) {
  if (fields.size() < 5) return Defect::too_short;
  Vtg vtg;
  // Before version 2 there were four numbers without letters.
  const bool lettered = fields.size() > 5;
  const std::size_t knots = lettered ? 5 : 3;
  const std::size_t kmph = lettered ? 7 : 4;
  if (lettered) {
    fields.expect_letter_or_empty(2, 'T');
    fields.expect_letter_or_empty(6, 'N');
    fields.expect_letter_or_empty(8, 'K');
  }
  const double by_knots = fields.decimal(knots, 0, kMaxKnots) * kMpsPerKnot;
  const double by_kmph = fields.decimal(kmph, 0, kMaxKmph) * kMpsPerKmph;
  const double course_deg = fields.direction_deg(1);
  const bool invalid = fields.letter(9) == 'N';
  if (!invalid) vtg.velocity = {std::isnan(by_knots) ? by_kmph : by_knots, course_deg};
  return finish(fields, vtg);
}

double positive_sigma(FieldReader& fields, std::size_t i) {
  const double sigma_m = fields.decimal(i, 0, kMaxSigma_m);
  return sigma_m > 0 ? sigma_m : kAbsent;  // nothing is measured without error: 0 is "unknown"
}

Decoded decode_gst(FieldReader& fields) {
  if (fields.size() < 9) return Defect::too_short;
  Gst gst;
  gst.utc = fields.time_of_day(1);
  gst.sigma_north_m = positive_sigma(fields, 6);
  gst.sigma_east_m = positive_sigma(fields, 7);
  gst.sigma_up_m = positive_sigma(fields, 8);
  return finish(fields, gst);
}

Decoded decode_hdt(FieldReader& fields) {
  if (fields.size() < 3) return Defect::too_short;
  const double heading_deg = fields.direction_deg(1);
  if (fields.letter(2) != 'T') fields.fail();
  return finish(fields, Heading{heading_deg, Heading::From::hdt});
}

Decoded decode_ths(FieldReader& fields) {
  if (fields.size() < 3) return Defect::too_short;
  const double heading_deg = fields.direction_deg(1);
  const char mode = fields.letter(2);
  // E, M, S and V are estimated, typed in, simulated and invalid: numbers, but no measurement.
  return finish(fields, Heading{mode == 'A' ? heading_deg : kAbsent, Heading::From::ths});
}

}  // namespace

Result<Sentence, Defect> decode(std::string_view body) {
  FieldReader fields(body);
  const auto address = fields.text(0);
  // Two letters of talker and exactly three of type: `GNGGAH` is the second antenna. `P` begins a
  // maker's own sentence, whatever its last three letters are.
  if (address.size() != 5 || address[0] == 'P') return Sentence{Other{}};
  const auto type = address.substr(2);
  if (type == "GGA") return decode_gga(fields);
  if (type == "RMC") return decode_rmc(fields);
  if (type == "VTG") return decode_vtg(fields);
  if (type == "GST") return decode_gst(fields);
  if (type == "HDT") return decode_hdt(fields);
  if (type == "THS") return decode_ths(fields);
  return Sentence{Other{}};
}

}  // namespace drover::nmea0183
